//! [`HermiteKey`] and [`BezierKey`]: keys of cubic tracks.

use super::value::Value;

/// A key of a Hermite spline: a value and its velocities.
///
/// For rotations, tangents are derivatives of the four components per second, as in glTF: the spline interpolates the
/// components and normalises the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HermiteKey<T> {
    /// Velocity on arriving, in units of the value per second.
    pub into: T,
    /// The value.
    pub value: T,
    /// Velocity on leaving, in units of the value per second.
    pub out: T,
}

impl<T: Copy> HermiteKey<T> {
    /// A smooth key, with the same tangent on both sides.
    pub fn smooth(value: T, tangent: T) -> Self {
        Self { into: tangent, value, out: tangent }
    }
}

/// A key of cubic Bézier segments (1−t)³F₁ + 3t(1−t)²T₁ + 3t²(1−t)T₂ + t³F₂: `value` is F₂ of the segment before the
/// key and F₁ of the segment after it.
///
/// For rotations, control points are quaternions that need not be unit: the curve interpolates the components and
/// normalises the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BezierKey<T> {
    /// Control point T₂ of the segment that ends at this key.
    pub before: T,
    /// Value at the key.
    pub value: T,
    /// Control point T₁ of the segment that begins at this key.
    pub after: T,
}

impl<T: Value> BezierKey<T> {
    /// A key whose control point before it mirrors the one after it, 2F − T₁. The curve is smooth there if both
    /// segments have the same duration.
    #[must_use]
    pub fn mirrored(value: T, after: T) -> Self {
        Self { before: value.times(2.0).plus(after.times(-1.0)), value, after }
    }
}
