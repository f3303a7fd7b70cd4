//! Keys of cubic tracks.

use super::value::Value;

/// A key of a Hermite spline: a value and the velocities there.
///
/// Of rotations the tangents are four numbers a second, as glTF has them: the spline is that of the components, made unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HermiteKey<T> {
    /// Velocity on arriving, in units of the value a second.
    pub into: T,
    /// The value.
    pub value: T,
    /// Velocity on leaving, in units of the value a second.
    pub out: T,
}

impl<T: Copy> HermiteKey<T> {
    /// A key that is passed smoothly: one tangent for both sides.
    pub fn smooth(value: T, tangent: T) -> Self {
        Self { into: tangent, value, out: tangent }
    }
}

/// A key of cubic Bézier segments (1−t)³F₁ + 3t(1−t)²T₁ + 3t²(1−t)T₂ + t³F₂: `value` is F₂ of the segment before it and
/// F₁ of the one after it.
///
/// Of rotations the control points are quaternions that need not be unit: the curve is that of the components, made unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BezierKey<T> {
    /// T₂ of the segment that ends here.
    pub before: T,
    /// The value.
    pub value: T,
    /// T₁ of the segment that begins here.
    pub after: T,
}

impl<T: Value> BezierKey<T> {
    /// A key whose control point before it mirrors the one after it, 2F − T₁: between segments that take the same time
    /// the curve is smooth.
    #[must_use]
    pub fn mirrored(value: T, after: T) -> Self {
        Self { before: value.times(2.0).plus(after.times(-1.0)), value, after }
    }
}
