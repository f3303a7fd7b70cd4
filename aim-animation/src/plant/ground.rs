//! [`Ground`]: what a foot stands on.

use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::rotation::{length, log, shortest};

/// The ground below or above a point, in the world: the answer of a ray cast or of a height field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// The point of the ground on the vertical through the point that was asked for.
    pub point: Vec3,
    /// Its normal, of any length.
    pub normal: Vec3,
}

impl Ground {
    /// The ground at a point with this normal.
    #[must_use]
    pub const fn new(point: Vec3, normal: Vec3) -> Self {
        Self { point, normal }
    }

    /// The rotation vector from up to the normal, no longer than `most_rad`; none if there is no normal.
    pub(super) fn tilt(&self, up: Vec3, most_rad: f32) -> Vec3 {
        let tilt = log(if self.normal.is_finite() { shortest(up, self.normal) } else { Quat::IDENTITY });
        let angle = length(tilt.into());
        let most = most_rad.max(0.0);
        if angle > most { tilt * (most / angle) } else { tilt }
    }
}
