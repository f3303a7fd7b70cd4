//! Levenberg–Marquardt from the identity, where rotation vectors are 0, works as well as from any other start.

use aim::differentiate;
use aim::glam::{DQuat, DVec3};
use aim_objectives::Random;

/// The signed distance of a scanned point from its plane.
#[differentiate(wrt(turn, shift), gauss_newton)]
fn off_plane(turn: DVec3, shift: DVec3, point: DVec3, normal: DVec3, offset: f64) -> f64 {
    normal.dot(DQuat::from_axis_angle(turn.normalize_or_zero(), turn.length()) * point + shift) - offset
}

/// The reprojection error: the image of a point minus its observed place.
#[differentiate(wrt(turn, shift, point), gauss_newton)]
fn reprojection(turn: DVec3, shift: DVec3, point: DVec3, seen: [f64; 2]) -> [f64; 2] {
    let angle = turn.length();
    let once = turn.cross(point);
    let turned = point + once * (angle.sin() / angle) + turn.cross(once) * ((1.0 - angle.cos()) / (angle * angle));
    let p = turned + shift;
    [p.x / p.z - seen[0], p.y / p.z - seen[1]]
}

/// A cost with its normal equations: half of its gradient, and `JᵀJ`.
struct Normal {
    cost: f64,
    gradient: Vec<f64>,
    matrix: Vec<Vec<f64>>,
}

impl Normal {
    fn new(size: usize) -> Self {
        Self { cost: 0.0, gradient: vec![0.0; size], matrix: vec![vec![0.0; size]; size] }
    }

    /// Adds a block of residuals whose variables have these indices.
    fn add(&mut self, residuals: &[f64], places: &[usize], gradient: &[f64], matrix: &[&[f64]]) {
        self.cost += residuals.iter().map(|r| r * r).sum::<f64>();
        for (i, &row) in places.iter().enumerate() {
            self.gradient[row] += gradient[i];
            for (k, &column) in places.iter().enumerate() {
                self.matrix[row][column] += matrix[i][k];
            }
        }
    }

    /// Returns the Levenberg–Marquardt step, by Cholesky factorisation.
    fn step(&self, damping: f64) -> Vec<f64> {
        let n = self.gradient.len();
        let mut factor = self.matrix.clone();
        let mut step: Vec<f64> = self.gradient.iter().map(|slope| -slope).collect();
        for (i, row) in factor.iter_mut().enumerate() {
            row[i] += damping * (1e-6 + row[i]);
        }
        for i in 0..n {
            for k in 0..=i {
                let dot: f64 = (0..k).map(|j| factor[i][j] * factor[k][j]).sum();
                let rest = factor[i][k] - dot;
                factor[i][k] = if i == k { rest.max(1e-300).sqrt() } else { rest / factor[k][k] };
            }
            let dot: f64 = (0..i).map(|j| factor[i][j] * step[j]).sum();
            step[i] = (step[i] - dot) / factor[i][i];
        }
        for i in (0..n).rev() {
            let dot: f64 = (i + 1..n).map(|j| factor[j][i] * step[j]).sum();
            step[i] = (step[i] - dot) / factor[i][i];
        }
        step
    }
}

/// Returns the least cost found, and the number of steps tried.
fn minimized(mut x: Vec<f64>, normal: impl Fn(&[f64]) -> Normal) -> (f64, usize) {
    let mut damping = 1e-3;
    let mut here = normal(&x);
    for iteration in 0..200 {
        let step = here.step(damping);
        let there: Vec<f64> = x.iter().zip(&step).map(|(x, step)| x + step).collect();
        let tried = normal(&there);
        let largest = step.iter().fold(0.0, |largest: f64, part| largest.max(part.abs()));
        if tried.cost <= here.cost {
            (x, here, damping) = (there, tried, damping * 0.1);
        } else {
            damping *= 10.0;
        }
        if largest < 1e-6 {
            return (here.cost, iteration + 1);
        }
    }
    (here.cost, 200)
}

/// The identity leads to the same minimum as most other start rotations, and takes at most a fifth more steps than
/// their median.
#[track_caller]
fn no_turn_is_as_good_a_start(start: impl Fn(DVec3) -> Vec<f64>, normal: impl Fn(&[f64]) -> Normal) {
    let mut random = Random::new(7);
    let mut others: Vec<(f64, usize)> =
        (0..20).map(|_| minimized(start(DVec3::from_slice(&random.vector(0.05..0.8))), &normal)).collect();
    let least = others.iter().map(|(cost, _)| *cost).fold(f64::INFINITY, f64::min);
    others.retain(|(cost, _)| *cost < least + 1e-8);
    assert!(others.len() >= 15, "only {} of 20 others find the minimum", others.len());
    let mut counts: Vec<usize> = others.iter().map(|(_, count)| *count).collect();
    counts.sort_unstable();
    let median = counts[counts.len() / 2];
    let (cost, count) = minimized(start(DVec3::ZERO), &normal);
    println!("from no turn {count} steps, from others {counts:?}");
    assert!((cost - least).abs() <= 1e-8, "cost {cost} instead of {least}");
    assert!(count * 5 <= median * 6, "{count} steps, the median of others {median}");
}

#[test]
fn registration_to_planes_starts_at_no_turn() {
    let mut random = Random::new(3);
    let turn = DQuat::from_scaled_axis(DVec3::new(0.3, -0.4, 0.2));
    let shift = DVec3::new(0.2, 0.1, -0.3);
    let pairs: Vec<(DVec3, DVec3, f64)> = (0..40)
        .map(|_| {
            let normal = DVec3::from_slice(&random.vector(0.5..1.0)).normalize();
            let point = DVec3::from_slice(&random.vector(0.5..2.0));
            let noise = random.numbers(1, -0.02..0.02)[0];
            (point, normal, normal.dot(turn * point + shift) + noise)
        })
        .collect();
    let normal = |x: &[f64]| {
        let mut normal = Normal::new(6);
        for &(point, direction, offset) in &pairs {
            let (turn, shift) = (DVec3::from_slice(x), DVec3::from_slice(&x[3..]));
            let (off, (by_turn, by_shift), matrix) = off_plane_gauss_newton(turn, shift, point, direction, offset);
            let gradient = [by_turn.to_array(), by_shift.to_array()].concat();
            let rows: Vec<&[f64]> = matrix.iter().map(|row| &row[..]).collect();
            normal.add(&[off], &[0, 1, 2, 3, 4, 5], &gradient, &rows);
        }
        normal
    };
    no_turn_is_as_good_a_start(|turn| [turn.to_array(), [0.0; 3]].concat(), normal);
}

#[test]
fn bundle_adjustment_starts_at_no_turn() {
    let mut random = Random::new(5);
    let points: Vec<DVec3> =
        (0..12).map(|_| DVec3::from_slice(&random.numbers(3, -2.5..2.5)) + DVec3::new(0.0, 0.0, 6.0)).collect();
    // The first camera is fixed, so that only the scale is free.
    let cameras: Vec<(DQuat, DVec3)> = (1..4)
        .map(|i| {
            let along = f64::from(i);
            (DQuat::from_scaled_axis(DVec3::new(0.05 * along, -0.1 * along, 0.08)), DVec3::new(0.6 * along, 0.1, 0.2))
        })
        .collect();
    let seen = |(turn, shift): (DQuat, DVec3), point: DVec3, random: &mut Random| {
        let p = turn * point + shift;
        let noise = random.numbers(2, -1e-3..1e-3);
        [p.x / p.z + noise[0], p.y / p.z + noise[1]]
    };
    let all: Vec<(DQuat, DVec3)> =
        [(DQuat::IDENTITY, DVec3::ZERO)].into_iter().chain(cameras.iter().copied()).collect();
    let views: Vec<Vec<[f64; 2]>> =
        all.iter().map(|&camera| points.iter().map(|&point| seen(camera, point, &mut random)).collect()).collect();
    let guesses: Vec<f64> =
        points.iter().flat_map(|p| (*p + DVec3::from_slice(&random.numbers(3, -0.1..0.1))).to_array()).collect();
    let size = 18 + 3 * points.len();
    let normal = |x: &[f64]| {
        let mut normal = Normal::new(size);
        for (camera, views) in views.iter().enumerate() {
            for (i, &view) in views.iter().enumerate() {
                let at = 18 + 3 * i;
                let point = DVec3::from_slice(&x[at..]);
                // The fixed camera has no variables.
                let of_camera = camera.checked_sub(1).map(|camera| 6 * camera);
                let (turn, shift) = of_camera.map_or((DVec3::ZERO, DVec3::ZERO), |c| {
                    (DVec3::from_slice(&x[c..]), DVec3::from_slice(&x[c + 3..]))
                });
                let (off, (by_turn, by_shift, by_point), matrix) = reprojection_gauss_newton(turn, shift, point, view);
                let gradient = [by_turn.to_array(), by_shift.to_array(), by_point.to_array()].concat();
                let first = if of_camera.is_some() { 0 } else { 6 };
                let places: Vec<usize> = of_camera.into_iter().flat_map(|c| c..c + 6).chain(at..at + 3).collect();
                let rows: Vec<&[f64]> = matrix[first..].iter().map(|row| &row[first..]).collect();
                normal.add(&off, &places, &gradient[first..], &rows);
            }
        }
        // The distance of the second camera fixes the scale.
        let off = x[3] - 0.6;
        normal.add(&[10.0 * off], &[3], &[100.0 * off], &[&[100.0]]);
        normal
    };
    let start = |turn: DVec3| {
        let cameras = (1..4).flat_map(|i| [(0.3 * turn).to_array(), [0.6 * f64::from(i), 0.0, 0.0]].concat());
        cameras.chain(guesses.iter().copied()).collect()
    };
    no_turn_is_as_good_a_start(start, normal);
}
