//! The one place where the solvers' floating-point functions come from: `std` or `libm`, both exact to the last bit for these.
//! All total: no panic, whatever the bits. Sines are our own ([`trig`]).

use core::f32::consts::{PI, TAU};
use core::ops::Range;

use glam::{Affine3A, Mat3A, Quat, Vec3A, Vec3Swizzles, Vec4};

use trig::atan2;

pub(crate) mod trig;
pub(crate) mod turn;

/// An angle that is no angle any more: what an undefined aim is reported as.
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

/// Bounds that are one comparison each, where `max` and `min` of `f32` take five for what they do about NaN.
pub(crate) trait Bounded: Sized {
    /// The number, or the bound where that is larger or the number is NaN.
    fn at_least(self, bound: Self) -> Self;
    /// The number, or the bound where that is smaller or the number is NaN.
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

/// The square root; 0 for what has none.
#[inline]
pub(crate) fn sqrt(x: f32) -> f32 {
    if x > 0.0 { float::sqrt(x) } else { 0.0 }
}

/// The square root of a sum of squares: no less than 0, or not a number.
#[inline(always)]
pub(crate) fn root(x: f32) -> f32 {
    float::sqrt(x)
}

/// The same direction of turning within ±π; some angle within ±π for one that has no turn left in its digits.
#[inline]
pub(crate) fn wrap_pi(angle_rad: f32) -> f32 {
    if (-PI..=PI).contains(&angle_rad) {
        angle_rad
    } else {
        (angle_rad - TAU * float::round(angle_rad / TAU)).at_least(-PI).at_most(PI)
    }
}

/// A vector's length, without overflow or underflow on the way.
pub(crate) fn length(v: Vec3A) -> f32 {
    let largest = v.abs().max_element();
    if largest > 0.0 && largest.is_finite() { (v / largest).length() * largest } else { largest }
}

/// The unit vector along `v`, whatever its length; `None` for zero and for what is not finite.
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

/// The same of a vector of solver space, where nothing is so long or short that its square would not do.
#[inline(always)]
pub(crate) fn unit(v: Vec3A) -> Option<Vec3A> {
    let square = v.dot(v);
    (square > 1e-30 && square < f32::INFINITY).then(|| v * (1.0 / sqrt(square)))
}

/// The cross product, each product rounded by itself: glam's own is fused where the machine can do that, and then has
/// other bits.
#[inline(always)]
pub(crate) fn cross(a: Vec3A, b: Vec3A) -> Vec3A {
    (a.zxy() * b - a * b.zxy()).zxy()
}

/// `v` turned by a unit quaternion; the same bits everywhere, as [`cross`].
#[inline(always)]
pub(crate) fn turned(turn: Quat, v: Vec3A) -> Vec3A {
    let (axis, w) = (Vec3A::from_vec4(Vec4::from(turn)), turn.w);
    v * (w * w - axis.dot(axis)) + axis * (v.dot(axis) * 2.0) + cross(axis, v) * (w * 2.0)
}

/// The product of two rotations, `b` first; the same bits everywhere, as [`cross`].
pub(crate) fn product(a: Quat, b: Quat) -> Quat {
    let [u, v] = [a, b].map(|turn| Vec3A::from_vec4(Vec4::from(turn)));
    let axis = v * a.w + u * b.w + cross(u, v);
    Quat::from_xyzw(axis.x, axis.y, axis.z, a.w * b.w - u.dot(v))
}

/// The shortest rotation from one unit vector to another; half a turn about any axis between opposites.
pub(crate) fn arc(from: Vec3A, to: Vec3A) -> Quat {
    const ALONG: f32 = 1.0 - 2.0 * f32::EPSILON;
    let along = from.dot(to);
    if along > ALONG {
        return Quat::IDENTITY;
    }
    if along < -ALONG {
        let axis = from.any_orthonormal_vector();
        return Quat::from_xyzw(axis.x, axis.y, axis.z, 0.0);
    }
    let (axis, w) = (cross(from, to), 1.0 + along);
    let per_length = 1.0 / sqrt(axis.dot(axis) + w * w);
    let axis = axis * per_length;
    Quat::from_xyzw(axis.x, axis.y, axis.z, w * per_length)
}

/// The inverse of a matrix that spans space; the same bits everywhere, as [`cross`].
pub(crate) fn inverse(m: Mat3A) -> Mat3A {
    let Mat3A { x_axis: x, y_axis: y, z_axis: z } = m;
    let rows = [cross(y, z), cross(z, x), cross(x, y)];
    let [a, b, c] = rows.map(|row| row * (1.0 / x.dot(rows[0])));
    Mat3A::from_cols(a, b, c).transpose()
}

/// The angle between two vectors that are neither zero nor extreme, 0…π; exact to rounding also near 0 and π.
pub(crate) fn angle_between(a: Vec3A, b: Vec3A) -> f32 {
    atan2(cross(a, b).length(), a.dot(b))
}

/// The same of unit vectors: tan θ/2 = |a − b|/|a + b|.
#[inline(always)]
pub(crate) fn angle_between_units(a: Vec3A, b: Vec3A) -> f32 {
    let [apart, along] = [a - b, a + b].map(|v| v.dot(v));
    if apart < along { trig::twice_atan(root(apart / along)) } else { angle_between(a, b) }
}

/// The orthogonal matrix nearest in spirit: columns normalised, then squared to each other in their order. A mirror
/// stays in it. `None` where the columns do not span space, or span it so flatly that the order decides everything.
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

/// The inverse of an orthogonal matrix and a translation.
pub(crate) fn rigid_inverse(m: &Affine3A) -> Affine3A {
    let transposed = m.matrix3.transpose();
    Affine3A { matrix3: transposed, translation: -(transposed * m.translation) }
}

/// The unit vector a part of the way along the arc from one unit vector to another that is not its opposite.
pub(crate) fn part_of_arc(from: Vec3A, to: Vec3A, part: f32) -> Vec3A {
    let across = to - from * from.dot(to);
    let Some(across) = direction(across) else { return to };
    let (sin, cos) = trig::sin_cos(part * angle_between(from, to));
    from * cos + across * sin
}
/// Whether a number is within a range of positive numbers, its end left out. NaN is not.
///
/// Positive numbers are in the order of their bits, so that one subtraction compares with both ends.
#[inline(always)]
pub(crate) const fn is_within_positive(x: f32, range: Range<f32>) -> bool {
    let (start, end) = (range.start.to_bits(), range.end.to_bits());
    x.to_bits().wrapping_sub(start) < end - start
}
