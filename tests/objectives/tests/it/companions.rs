//! Companion products (`jvp`, `vjp`, `hvp`, Gauss–Newton) equal the multiplied-out derivatives.

use aim::differentiate;
use aim::glam::{DQuat, DVec3};
use aim_objectives::Random;

#[differentiate(check = true)]
mod camera {
    use super::*;

    const FOCAL: f64 = 1.3;

    /// The reprojection error: the image of a point minus its measured place.
    #[differentiate(wrt(turn, place, point), jvp, vjp, gauss_newton)]
    pub(super) fn reprojection(turn: f64, place: DVec3, point: &DVec3, seen: [f64; 2]) -> [f64; 2] {
        let local = DQuat::from_rotation_y(turn) * (*point - place);
        [FOCAL * local.x / local.z - seen[0], FOCAL * local.y / local.z - seen[1]]
    }

    /// The energy of a hanging chain: its springs and its weight.
    #[differentiate(wrt(points), hessian, hvp, vjp)]
    pub(super) fn chain(points: [[f64; 2]; 4], rest: f64) -> f64 {
        let mut energy = 0.0;
        for pair in points.windows(2) {
            let stretch = (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1]) - rest;
            energy += 0.5 * stretch * stretch + 0.1 * pair[1][1];
        }
        energy
    }

    /// A direction scaled by the light that it receives.
    #[differentiate(wrt(normal), jvp, vjp, gauss_newton)]
    pub(super) fn lit(normal: DVec3, light: DVec3) -> DVec3 {
        let unit = normal.normalize();
        unit * unit.dot(light).max(0.0)
    }
}

fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * expected.abs().max(1.0), "{found} and {expected}");
}

#[test]
fn of_several_numbers() {
    let mut random = Random::new(5);
    for _ in 0..200 {
        let n = random.numbers(13, -1.0..1.0);
        let (turn, place, point) = (n[0], DVec3::new(n[1], n[2], n[3]), DVec3::new(n[4], n[5], n[6] + 5.0));
        let seen = [n[7], n[8]];
        let (value, (by_turn, by_place, by_point)) = camera::reprojection_jacobian(turn, place, &point, seen);
        let rows: Vec<Vec<f64>> =
            (0..2).map(|i| [&[by_turn[i]][..], &by_place[i].to_array(), &by_point[i].to_array()].concat()).collect();

        let (along_turn, along_place, along_point) =
            (n[9], DVec3::new(n[10], n[11], n[12]), DVec3::new(n[0], n[5], n[9]));
        let v = [&[along_turn][..], &along_place.to_array(), &along_point.to_array()].concat();
        let (same, tangent) = camera::reprojection_jvp(turn, place, &point, seen, along_turn, along_place, along_point);
        let (also, (turned, placed, pointed)) = camera::reprojection_vjp(turn, place, &point, seen, [n[9], n[10]]);
        let pulled = [&[turned][..], &placed.to_array(), &pointed.to_array()].concat();
        let (residual, (by_turn, by_place, by_point), normal) =
            camera::reprojection_gauss_newton(turn, place, &point, seen);
        let projected = [&[by_turn][..], &by_place.to_array(), &by_point.to_array()].concat();
        for i in 0..2 {
            [same[i], also[i], residual[i]].into_iter().for_each(|found| close(found, value[i]));
            close(tangent[i], rows[i].iter().zip(&v).map(|(a, b)| a * b).sum());
        }
        for k in 0..7 {
            close(pulled[k], n[9] * rows[0][k] + n[10] * rows[1][k]);
            close(projected[k], value[0] * rows[0][k] + value[1] * rows[1][k]);
            for j in 0..7 {
                close(normal[k][j], rows[0][k] * rows[0][j] + rows[1][k] * rows[1][j]);
            }
        }
    }
}

#[test]
fn of_one_number() {
    let mut random = Random::new(6);
    for _ in 0..100 {
        let n = random.numbers(16, -1.0..1.0);
        let points: [[f64; 2]; 4] = core::array::from_fn(|i| [n[2 * i] + i as f64, n[2 * i + 1]]);
        let along: [[f64; 2]; 4] = core::array::from_fn(|i| [n[8 + 2 * i], n[9 + 2 * i]]);
        let (value, (gradient,), hessian) = camera::chain_hessian(points, 0.7);
        let (slope, (product,)) = camera::chain_hvp(points, 0.7, along);
        let (same, (weighted,)) = camera::chain_vjp(points, 0.7, 3.0);
        let (gradient, along, product) = (gradient.as_flattened(), along.as_flattened(), product.as_flattened());
        close(same, value);
        close(slope, gradient.iter().zip(along).map(|(a, b)| a * b).sum());
        for i in 0..8 {
            close(product[i], hessian[i].iter().zip(along).map(|(a, b)| a * b).sum());
            close(weighted.as_flattened()[i], 3.0 * gradient[i]);
        }
    }
}

#[test]
fn of_a_vector() {
    let mut random = Random::new(7);
    for _ in 0..100 {
        let n = random.numbers(9, -1.0..1.0);
        let vector = |k: usize| DVec3::new(n[k], n[k + 1], n[k + 2]);
        let (normal, light, other) = (vector(0) + DVec3::Z * 2.0, vector(3), vector(6));
        let (value, (matrix,)) = camera::lit_jacobian(normal, light);
        let (same, tangent) = camera::lit_jvp(normal, light, other);
        let (also, (pulled,)) = camera::lit_vjp(normal, light, other);
        let (residual, (projected,), square) = camera::lit_gauss_newton(normal, light);
        let expected = matrix.transpose() * matrix;
        for (found, expected) in [
            (same, value),
            (also, value),
            (residual, value),
            (tangent, matrix * other),
            (pulled, matrix.transpose() * other),
            (projected, matrix.transpose() * value),
        ] {
            found.to_array().into_iter().zip(expected.to_array()).for_each(|(found, expected)| close(found, expected));
        }
        for (i, row) in square.iter().enumerate() {
            row.iter().enumerate().for_each(|(k, &found)| close(found, expected.col(k)[i]));
        }
    }
}

#[differentiate(wrt(x, y), jvp, vjp)]
fn named_alike(x: f64, along_x: f64, weights: f64, y: f64) -> f64 {
    x * along_x + weights * x * x + y
}

#[test]
fn arguments_that_are_called_what_companions_take() {
    let (value, slope) = named_alike_jvp(2.0, 3.0, 0.5, 1.0, 0.25, -1.0);
    assert_eq!((value, slope), (9.0, 0.25 * 5.0 - 1.0));
    assert_eq!(named_alike_vjp(2.0, 3.0, 0.5, 1.0, 2.0), (9.0, (10.0, 2.0)));
}
