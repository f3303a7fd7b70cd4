//! Chains of rotations: seen from their own frames, their logarithms, interpolation; and slopes by a vector that are
//! taken forward together. The budgets are those of the rules that the functions are for.

use aim::differentiate;
use aim::glam::{DMat3, DQuat, DVec3};

#[differentiate(check = true)]
mod chains {
    use aim::glam::{DQuat, DVec3};

    /// A rotation meets its inverse within a multiple of a sum, too; without that the count is 221.
    #[differentiate(wrt(turn, rest), budget = 119)]
    pub(super) fn from_the_body(turn: DVec3, force: DVec3, fall: DVec3, to: DVec3, dt: f64, rest: DVec3) -> DVec3 {
        let q = DQuat::from_scaled_axis(turn);
        q.inverse() * (to - dt * (0.5 * (q * force + fall) + rest))
    }

    /// The motion of a chain is one angular velocity, of which the logarithm's slopes are multiples; by the formulas of
    /// the quaternions the count is 759.
    #[differentiate(wrt(tangent(start), bias), budget = 475)]
    pub(super) fn integrated(start: DQuat, bias: DVec3, rates: [DVec3; 2], end: DQuat) -> DVec3 {
        let turned = rates.iter().fold(start, |q, rate| q * DQuat::from_scaled_axis(*rate - bias));
        (turned.inverse() * end).to_scaled_axis()
    }

    /// The same logarithm with second derivatives, perturbed on either side.
    #[differentiate(wrt(tangent(a), turn), hessian)]
    pub(super) fn apart(a: DQuat, turn: DVec3, b: DQuat) -> f64 {
        (a.inverse() * DQuat::from_scaled_axis(turn) * b).to_scaled_axis().length_squared()
    }
    #[differentiate(wrt(tangent(a)), perturbation = left, hessian)]
    pub(super) fn apart_to_the_left(a: DQuat, b: DQuat) -> f64 {
        (b * a.inverse()).to_scaled_axis().dot(DVec3::new(0.3, -0.5, 0.7))
    }
    #[differentiate(wrt(a, b))]
    pub(super) fn angle(a: DQuat, b: DQuat) -> f64 {
        a.normalize().angle_between(b.normalize())
    }

    /// The energy of two dipoles. With each component on its own the count is 48.
    #[differentiate(wrt(a, b), budget = 46)]
    pub(super) fn dipoles(a: DVec3, b: DVec3, place: DVec3) -> f64 {
        let r2 = place.dot(place);
        let r = r2.sqrt();
        (a.dot(b) - 3.0 * a.dot(place) * b.dot(place) / r2) / (r2 * r)
    }

    /// From the chord of the quaternions instead of their dot product the count is 253.
    #[differentiate(wrt(tangent(a, b), t), budget = 246)]
    pub(super) fn halfway(a: DQuat, b: DQuat, t: f64, p: DVec3, wanted: DVec3) -> f64 {
        (a.slerp(b, t) * p).dot(wanted)
    }

    /// The slopes of the weights are computed once for the three numbers; with each on its own the count is 433.
    #[differentiate(wrt(tangent(a, b), t), budget = 396)]
    pub(super) fn between(a: DQuat, b: DQuat, t: f64, p: DVec3) -> DVec3 {
        a.slerp(b, t) * p
    }
}

/// Squared over and over, a rotation has a million factors. They are not taken one by one.
#[differentiate(wrt(tangent(q)))]
fn squared(q: DQuat) -> DVec3 {
    let mut q = q;
    for _ in 0..20 {
        q = q * q;
    }
    q.to_scaled_axis()
}

#[test]
fn a_rotation_squared_many_times_is_derived() {
    let (turn, (by_q,)) = squared_jacobian(DQuat::IDENTITY);
    assert_eq!(turn, DVec3::ZERO);
    assert_eq!(by_q, f64::from(1 << 20) * DMat3::IDENTITY);
}

/// A vector is not rotated factor by factor either.
#[differentiate(wrt(tangent(q), v))]
fn rotated(q: DQuat, v: DVec3) -> DVec3 {
    let mut q = q;
    for _ in 0..14 {
        q = q * q;
    }
    q * v
}
#[differentiate(wrt(turn))]
fn rotated_by_matrix(turn: DVec3, v: DVec3) -> DVec3 {
    let mut m = DMat3::from_quat(DQuat::from_scaled_axis(turn));
    for _ in 0..14 {
        m *= m;
    }
    m * v
}
/// The same rotation as `turned`, squared 5 times and in one.
#[differentiate(wrt(turn), hessian)]
fn turned_by_squares(turn: DVec3, v: DVec3) -> f64 {
    let mut q = DQuat::from_scaled_axis(turn);
    for _ in 0..5 {
        q = q * q;
    }
    (q * v).dot(DVec3::new(1.0, 2.0, -0.4))
}
#[differentiate(wrt(turn), hessian)]
fn turned(turn: DVec3, v: DVec3) -> f64 {
    (DQuat::from_scaled_axis(32.0 * turn) * v).dot(DVec3::new(1.0, 2.0, -0.4))
}

#[test]
fn a_rotation_squared_many_times_turns_a_vector() {
    let v = DVec3::new(0.25, -0.5, 0.75);
    let times = f64::from(1 << 14);
    // ∂(exp δ v) = δ × v
    let by_turn = DMat3::from_cols(DVec3::X.cross(v), DVec3::Y.cross(v), DVec3::Z.cross(v)) * times;
    assert_eq!(rotated_jacobian(DQuat::IDENTITY, v), (v, (by_turn, DMat3::IDENTITY)));
    assert_eq!(rotated_by_matrix_jacobian(DVec3::ZERO, v), (v, (by_turn,)));
    for turn in [DVec3::ZERO, DVec3::new(0.01, 0.02, -0.03)] {
        let (squared, at_once) = (turned_by_squares_hessian(turn, v), turned_hessian(turn, v));
        let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-12 * (1.0 + a.abs()), "{a} instead of {b}");
        close(squared.0, at_once.0);
        for i in 0..3 {
            close(squared.1.0[i], at_once.1.0[i]);
            (0..3).for_each(|j| close(squared.2[i][j], at_once.2[i][j]));
        }
    }
}
