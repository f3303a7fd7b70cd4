//! Chains of rotations: seen from their own frames, their logarithms, interpolation; and slopes by a vector that are
//! taken forward together. The budgets are those of the rules that the functions are for.

use aim::differentiate;

#[differentiate(check = true)]
mod chains {
    use aim::glam::{DQuat, DVec3};
    /// The energy of two dipoles. With each component on its own the count is 48.
    #[differentiate(wrt(a, b), budget = 46)]
    pub(super) fn dipoles(a: DVec3, b: DVec3, place: DVec3) -> f64 {
        let r2 = place.dot(place);
        let r = r2.sqrt();
        (a.dot(b) - 3.0 * a.dot(place) * b.dot(place) / r2) / (r2 * r)
    }
}
