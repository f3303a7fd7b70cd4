//! [`Ground`]: what a foot stands on.

use aim_runtime::glam::Vec3;
use aim_runtime::rotation::{length, log, shortest};

/// The ground below or above a point, in the world: the answer of a ray cast or of a height field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// The point of the ground on the vertical through the point that was asked for.
    pub point: Vec3,
    /// Its normal, of any length. One that is zero, not finite, level or points downward is none: the ground is level there.
    pub normal: Vec3,
}

impl Ground {
    /// The ground at a point with this normal.
    #[must_use]
    pub const fn new(point: Vec3, normal: Vec3) -> Self {
        Self { point, normal }
    }

    /// The ground on the vertical through a point; the point itself, level, where this is not finite.
    pub(super) fn below(self, at: Vec3, up: Vec3) -> Self {
        let point = at + up * (self.point - at).dot(up);
        if !point.is_finite() {
            return Self::new(at, up);
        }
        let has_normal = self.normal.is_finite() && self.normal.dot(up) > 0.0;
        Self::new(point, if has_normal { self.normal } else { up })
    }

    /// Its rise over a way, after its normal.
    pub(super) fn rise(&self, way: Vec3, up: Vec3) -> f32 {
        let level = way - up * way.dot(up);
        -self.normal.dot(level) / self.normal.dot(up)
    }

    /// The rotation vector from up to the normal, no longer than `most_rad`; none if there is no normal.
    pub(super) fn tilt(&self, up: Vec3, most_rad: f32) -> Vec3 {
        let tilt = log(shortest(up, self.normal));
        let angle = length(tilt.into());
        let most = most_rad.max(0.0);
        if angle > most { tilt * (most / angle) } else { tilt }
    }
}
