//! [`Ground`]: the ground under a foot.

use aim_runtime::glam::Vec3;
use aim_runtime::rotation::{length, log, shortest};

/// The ground below or above a point, in the world: the result of a ray cast or a height field lookup.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Point of the ground on the vertical through the queried point.
    pub point: Vec3,
    /// Normal of the ground, of any length. If it is zero, not finite, horizontal or points downwards, the ground is
    /// assumed level.
    pub normal: Vec3,
}

impl Ground {
    /// Ground at a point with this normal.
    #[must_use]
    pub const fn new(point: Vec3, normal: Vec3) -> Self {
        Self { point, normal }
    }

    /// Returns the ground on the vertical through a point; level ground at that point itself if the ground is not
    /// finite.
    pub(super) fn below(self, at: Vec3, up: Vec3) -> Self {
        let point = at + up * (self.point - at).dot(up);
        if !point.is_finite() {
            return Self::new(at, up);
        }
        let has_normal = self.normal.is_finite() && self.normal.dot(up) > 0.0;
        Self::new(point, if has_normal { self.normal } else { up })
    }

    /// Rise of the ground plane along a displacement, computed from its normal.
    pub(super) fn rise(&self, way: Vec3, up: Vec3) -> f32 {
        let level = way - up * way.dot(up);
        -self.normal.dot(level) / self.normal.dot(up)
    }

    /// Rotation vector from up to the normal, at most `most_rad` long; zero if there is no normal.
    pub(super) fn tilt(&self, up: Vec3, most_rad: f32) -> Vec3 {
        let tilt = log(shortest(up, self.normal));
        let angle = length(tilt.into());
        let most = most_rad.max(0.0);
        if angle > most { tilt * (most / angle) } else { tilt }
    }
}
