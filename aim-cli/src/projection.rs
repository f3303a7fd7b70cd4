//! [`Projection`]: the one way in which space is drawn on a plane.

use aim_runtime::glam::DVec3;

/// A parallel projection onto a drawing whose y axis points down.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection {
    /// The direction that is drawn to the right, of length one.
    pub(crate) right: DVec3,
    /// The direction that is drawn upwards, of length one.
    pub(crate) up: DVec3,
    /// The direction to the viewer, of length one.
    pub(crate) toward: DVec3,
    /// The point of space that is drawn in the middle.
    pub(crate) centre: DVec3,
    /// The middle of the drawing, in its units.
    pub(crate) middle: [f64; 2],
    /// Units of the drawing for a unit of space.
    pub(crate) scale: f64,
}

impl Projection {
    /// Looks against `toward`, with `upward` upright in the drawing, or to the viewer's left if the two are parallel.
    pub(crate) fn new(toward: DVec3, upward: DVec3, left: DVec3, middle: [f64; 2]) -> Self {
        let right = upward.cross(toward).normalize_or(left);
        Self { right, up: toward.cross(right), toward, centre: DVec3::ZERO, middle, scale: 1.0 }
    }

    /// Looks from the front, turned by `aside_deg` to the left and raised by `above_deg`.
    pub(crate) fn from_aside(axes: [DVec3; 3], aside_deg: f64, above_deg: f64, middle: [f64; 2]) -> Self {
        let [up, forward, left] = axes;
        let (aside, above) = (aside_deg.to_radians(), above_deg.to_radians());
        let level = forward * aside.cos() + left * aside.sin();
        Self::new(level * above.cos() + up * above.sin(), up, left, middle)
    }

    /// The components of a vector to the right, up and towards the viewer.
    pub(crate) fn turn(&self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.right), v.dot(self.up), v.dot(self.toward))
    }

    /// The inverse of [`turn`](Self::turn).
    pub(crate) fn unturn(&self, v: DVec3) -> DVec3 {
        self.right * v.x + self.up * v.y + self.toward * v.z
    }

    /// A point given from the centre: x and y in units of the drawing, z how near it is in units of space.
    pub(crate) fn place(&self, from_centre: DVec3) -> DVec3 {
        let v = self.turn(from_centre);
        DVec3::new(self.middle[0] + self.scale * v.x, self.middle[1] - self.scale * v.y, v.z)
    }

    /// A point of space, as [`place`](Self::place) gives it.
    pub(crate) fn project(&self, point: DVec3) -> DVec3 {
        self.place(point - self.centre)
    }
}
