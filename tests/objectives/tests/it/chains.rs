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
