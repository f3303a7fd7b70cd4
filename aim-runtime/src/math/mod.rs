//! Floating-point functions of the solvers. Square roots and rounding come from `std` or `libm`, which agree to the
//! last bit for these; sines and arctangents are our own ([`trig`]). All functions are total: they never panic, for any
//! input.

use core::f32::consts::{PI, TAU};
use core::ops::Range;

use glam::{Affine3A, Mat3A, Quat, Vec3A, Vec3Swizzles, Vec4};

use trig::atan2;

pub(crate) mod trig;
pub(crate) mod turn;

/// Angle reported for an undefined aim, radians.
pub(crate) const UNDEFINED_RAD: f32 = core::f32::consts::FRAC_PI_2;

#[cfg(feature = "std")]
mod float {
    extern crate std;

    #[inline]
    pub(super) fn sqrt(x: f32) -> f32 {
        x.sqrt()
    }
    pub(super) fn round(x: f32) -> f32 {
        x.round()
    }
}

#[cfg(not(feature = "std"))]
mod float {
    #[inline]
    pub(super) fn sqrt(x: f32) -> f32 {
        libm::sqrtf(x)
    }
    pub(super) fn round(x: f32) -> f32 {
        libm::roundf(x)
    }
}

/// Bounds that compile to one comparison each; `f32::max` and `f32::min` take five instructions because of their NaN
/// rules.
pub(crate) trait Bounded: Sized {
    /// Returns the larger of number and bound; the bound if the number is NaN.
    fn at_least(self, bound: Self) -> Self;
    /// Returns the smaller of number and bound; the bound if the number is NaN.
    fn at_most(self, bound: Self) -> Self;
}

impl Bounded for f32 {
    #[inline(always)]
    fn at_least(self, bound: Self) -> Self {
        aim_model::Float::max(self, bound)
    }

    #[inline(always)]
    fn at_most(self, bound: Self) -> Self {
        aim_model::Float::min(self, bound)
    }
}

/// Returns the square root; 0 for negative numbers and NaN.
#[inline]
pub(crate) fn sqrt(x: f32) -> f32 {
    if x > 0.0 { float::sqrt(x) } else { 0.0 }
}

/// Returns the square root of a number that is a sum of squares, thus at least 0 or NaN.
#[inline(always)]
pub(crate) fn root(x: f32) -> f32 {
    float::sqrt(x)
}

/// Wraps an angle into ±π. For an angle too large to resolve a full turn, the result is an arbitrary angle within ±π.
#[inline]
pub(crate) fn wrap_pi(angle_rad: f32) -> f32 {
    if (-PI..=PI).contains(&angle_rad) {
        angle_rad
    } else {
        (angle_rad - TAU * float::round(angle_rad / TAU)).at_least(-PI).at_most(PI)
    }
}

/// Returns a vector's length, without intermediate overflow or underflow.
pub(crate) fn length(v: Vec3A) -> f32 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() { (v / largest).length() * largest } else { largest }
}

/// Returns the unit vector along `v`, which may have any length; `None` if it is zero or not finite.
pub(crate) fn direction(v: Vec3A) -> Option<Vec3A> {
    let largest = v.abs().max_element();
    if largest > 0.0 && v.is_finite() {
        let v = v / largest;
        let unit = v / v.length();
        // A subnormal vector may overflow its own scaling.
        unit.is_finite().then_some(unit)
    } else {
        None
    }
}

/// Returns the unit vector along a vector of solver space, whose square neither overflows nor underflows; otherwise
/// `None`.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn unit(v: Vec3A) -> Option<Vec3A> {
    let square = v.dot(v);
    (square > 1e-30 && square < f32::INFINITY).then(|| v * (1.0 / sqrt(square)))
}

/// Returns the cross product, with each product rounded separately. glam's own uses fused multiply-add on machines that
/// have it, which gives other bits.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn cross(a: Vec3A, b: Vec3A) -> Vec3A {
    (a.zxy() * b - a * b.zxy()).zxy()
}

/// Returns `v` rotated by a unit quaternion. Bit-identical on every machine, like [`cross`].
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn turned(turn: Quat, v: Vec3A) -> Vec3A {
    let (axis, w) = (Vec3A::from_vec4(Vec4::from(turn)), turn.w);
    v * (w * w - axis.dot(axis)) + axis * (v.dot(axis) * 2.0) + cross(axis, v) * (w * 2.0)
}

/// Returns the product of two rotations, `b` first. Bit-identical on every machine, like [`cross`].
pub(crate) fn product(a: Quat, b: Quat) -> Quat {
    let [u, v] = [a, b].map(|turn| Vec3A::from_vec4(Vec4::from(turn)));
    let axis = v * a.w + u * b.w + cross(u, v);
    Quat::from_xyzw(axis.x, axis.y, axis.z, a.w * b.w - u.dot(v))
}

/// Returns the shortest rotation from one unit vector to another. Between opposite vectors, a half turn about an
/// arbitrary orthogonal axis.
pub(crate) fn arc(from: Vec3A, to: Vec3A) -> Quat {
    const ALONG: f32 = 1.0 - 2.0 * f32::EPSILON;
    let along = from.dot(to);
    if along < -ALONG {
        let axis = from.any_orthonormal_vector();
        return Quat::from_xyzw(axis.x, axis.y, axis.z, 0.0);
    }
    let (axis, w) = (cross(from, to), 1.0 + along);
    let per_length = 1.0 / sqrt(axis.dot(axis) + w * w);
    let axis = axis * per_length;
    Quat::from_xyzw(axis.x, axis.y, axis.z, w * per_length)
}

/// Returns the inverse of an invertible matrix. Bit-identical on every machine, like [`cross`].
pub(crate) fn inverse(m: Mat3A) -> Mat3A {
    let Mat3A { x_axis: x, y_axis: y, z_axis: z } = m;
    let rows = [cross(y, z), cross(z, x), cross(x, y)];
    let [a, b, c] = rows.map(|row| row * (1.0 / x.dot(rows[0])));
    Mat3A::from_cols(a, b, c).transpose()
}

/// Returns the angle between two vectors, 0…π, exact to rounding also near 0 and π. The vectors must be neither zero
/// nor so large or small that their squares overflow or underflow.
pub(crate) fn angle_between(a: Vec3A, b: Vec3A) -> f32 {
    atan2(cross(a, b).length(), a.dot(b))
}

/// Returns the angle between two unit vectors, 0…π, by tan θ/2 = |a − b|/|a + b|.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn angle_between_units(a: Vec3A, b: Vec3A) -> f32 {
    let [apart, along] = [a - b, a + b].map(|v| v.dot(v));
    if apart < along { trig::twice_atan(root(apart / along)) } else { PI - trig::twice_atan(root(along / apart)) }
}

/// Gram–Schmidt orthonormalisation of the columns, in order x, y, z. Keeps handedness. `None` if the columns are
/// linearly dependent to 1e-5, or not finite.
pub(crate) fn orthonormal(m: Mat3A) -> Option<Mat3A> {
    const FLAT: f32 = 1e-5;
    let longest = length(m.x_axis).max(length(m.y_axis)).max(length(m.z_axis));
    for column in [m.x_axis, m.y_axis, m.z_axis] {
        // The negation also catches NaN.
        if !(length(column) > FLAT * longest) {
            return None;
        }
    }
    let x = direction(m.x_axis)?;
    let y = direction(m.y_axis)?;
    let z = direction(m.z_axis)?;
    let y = y - x * x.dot(y);
    if !(y.length() > FLAT) {
        return None;
    }
    let y = y / y.length();
    let normal = cross(x, y);
    let height = normal.dot(z);
    if !(height.abs() > FLAT) {
        return None;
    }
    Some(Mat3A::from_cols(x, y, if height < 0.0 { -normal } else { normal }))
}

/// Returns the inverse of a transform of an orthogonal matrix and a translation.
pub(crate) fn rigid_inverse(m: &Affine3A) -> Affine3A {
    let transposed = m.matrix3.transpose();
    Affine3A { matrix3: transposed, translation: -(transposed * m.translation) }
}

/// Returns the unit vector at the fraction `part` of the arc from one unit vector to another that is not its opposite.
pub(crate) fn part_of_arc(from: Vec3A, to: Vec3A, part: f32) -> Vec3A {
    let across = to - from * from.dot(to);
    let Some(across) = direction(across) else { return to };
    let (sin, cos) = trig::sin_cos(part * angle_between(from, to));
    from * cos + across * sin
}
/// Returns `true` if a number is within a range of positive numbers, excluding its end. `false` for NaN.
///
/// Positive numbers are ordered like their bits, so one subtraction compares with both ends.
#[inline(always)]
pub(crate) const fn is_within_positive(x: f32, range: Range<f32>) -> bool {
    let (start, end) = (range.start.to_bits(), range.end.to_bits());
    x.to_bits().wrapping_sub(start) < end - start
}
