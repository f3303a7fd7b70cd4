//! [`Projection`]: the parallel projection used by all drawings.

use aim_runtime::glam::{DAffine3, DVec3};

/// A parallel projection onto a drawing whose y axis points down.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Projection {
    /// Unit vector that is drawn to the right.
    pub(crate) right: DVec3,
    /// Unit vector that is drawn upwards.
    pub(crate) up: DVec3,
    /// Unit vector towards the viewer.
    pub(crate) toward: DVec3,
    /// Point of space that is drawn at `middle`.
    pub(crate) centre: DVec3,
    /// Place of `centre` in the drawing, in its units.
    pub(crate) middle: [f64; 2],
    /// Units of the drawing per unit of space.
    pub(crate) scale: f64,
}

impl Projection {
    /// Creates a view from `toward`, with `upward` drawn upwards. If the two are parallel, `left` is drawn to the
    /// right.
    pub(crate) fn new(toward: DVec3, upward: DVec3, left: DVec3, middle: [f64; 2]) -> Self {
        let right = upward.cross(toward).normalize_or(left);
        Self { right, up: toward.cross(right), toward, centre: DVec3::ZERO, middle, scale: 1.0 }
    }

    /// Creates a view from the front of a character with the `axes` up, forward and left, turned by `aside_deg` towards
    /// its left and raised by `above_deg`.
    pub(crate) fn from_aside(axes: [DVec3; 3], aside_deg: f64, above_deg: f64, middle: [f64; 2]) -> Self {
        let [up, forward, left] = axes;
        let (aside, above) = (aside_deg.to_radians(), above_deg.to_radians());
        let level = forward * aside.cos() + left * aside.sin();
        Self::new(level * above.cos() + up * above.sin(), up, left, middle)
    }

    /// Returns the view after a rigid movement of the camera.
    pub(crate) fn moved(&self, by: DAffine3) -> Self {
        let [right, up, toward] = [self.right, self.up, self.toward].map(|v| by.transform_vector3(v));
        Self { right, up, toward, centre: by.transform_point3(self.centre), ..*self }
    }

    /// Returns the components of a vector to the right, up and towards the viewer.
    pub(crate) fn turn(&self, v: DVec3) -> DVec3 {
        DVec3::new(v.dot(self.right), v.dot(self.up), v.dot(self.toward))
    }

    /// Returns the vector with these components: the inverse of [`turn`](Self::turn).
    pub(crate) fn unturn(&self, v: DVec3) -> DVec3 {
        self.right * v.x + self.up * v.y + self.toward * v.z
    }

    /// Returns the place in the drawing of a point given relative to `centre`: x and y in units of the drawing, z as
    /// the nearness to the viewer in units of space.
    pub(crate) fn place(&self, from_centre: DVec3) -> DVec3 {
        let v = self.turn(from_centre);
        DVec3::new(self.middle[0] + self.scale * v.x, self.middle[1] - self.scale * v.y, v.z)
    }

    /// Returns the place in the drawing of a point of space, in the form of [`place`](Self::place).
    pub(crate) fn project(&self, point: DVec3) -> DVec3 {
        self.place(point - self.centre)
    }
}
