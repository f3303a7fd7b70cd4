//! Chains of rotations: seen from their own frames, their logarithms, interpolation; and slopes by a vector that are
//! taken forward together. The budgets are those of the rules that the functions are for.

use aim::differentiate;

#[differentiate(check = true)]
mod chains {
    use aim::glam::{DQuat, DVec3};

    /// A rotation meets its inverse within a multiple of a sum, too; without that the count is 221.
    #[differentiate(wrt(turn, rest), budget = 119)]
    pub(super) fn from_the_body(turn: DVec3, force: DVec3, fall: DVec3, to: DVec3, dt: f64, rest: DVec3) -> DVec3 {
        let q = DQuat::from_scaled_axis(turn);
        q.inverse() * (to - dt * (0.5 * (q * force + fall) + rest))
    }

    /// The energy of two dipoles. With each component on its own the count is 48.
    #[differentiate(wrt(a, b), budget = 46)]
    pub(super) fn dipoles(a: DVec3, b: DVec3, place: DVec3) -> f64 {
        let r2 = place.dot(place);
        let r = r2.sqrt();
        (a.dot(b) - 3.0 * a.dot(place) * b.dot(place) / r2) / (r2 * r)
    }
}
