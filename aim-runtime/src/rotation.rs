//! Rotations and affine transforms with the same bits on every machine, in debug and in release.
//!
//! glam's own products, sums and sines depend on the instructions that a machine has; these functions do not, and the
//! solvers use nothing else. All are total: none panics, and where a unit quaternion is promised, it is returned for
//! every input.
//!
//! ```
//! use aim_runtime::glam::{Quat, Vec3, Vec3A};
//! use aim_runtime::rotation;
//!
//! let [a, b] = [Quat::IDENTITY, Quat::from_rotation_y(1.0)];
//! assert!((rotation::angle(rotation::slerp(a, b, 0.25)) - 0.25).abs() < 1e-6);
//! assert!(rotation::exp(rotation::log(b)).abs_diff_eq(b, 1e-6));
//! let to_x = rotation::shortest(Vec3::Z, Vec3::X);
//! assert!(rotation::turned(to_x, Vec3A::Z).abs_diff_eq(Vec3A::X, 1e-6));
//! ```

use glam::{Affine3A, Mat3A, Quat, Vec3, Vec3A};

use crate::kinematics::chain;
use crate::math::trig::{atan2, half_sin_cos_within};
use crate::math::turn::{self, normalized, part};
use crate::math::{self, wrap_pi};

/// Returns the product of two unit quaternions: the rotation by `b`, then by `a`. The result is not renormalised.
#[must_use]
#[inline]
pub fn product(a: Quat, b: Quat) -> Quat {
    math::product(a, b)
}

/// Returns the dot product of two quaternions.
#[must_use]
#[inline]
pub fn dot(a: Quat, b: Quat) -> f32 {
    turn::dot(a, b)
}

/// Returns the quaternion scaled to length 1; `None` if it is zero or not finite.
#[must_use]
#[inline]
pub fn unit(rotation: Quat) -> Option<Quat> {
    turn::unit(rotation)
}

/// Returns a vector rotated by a unit quaternion.
#[must_use]
#[inline]
pub fn turned(rotation: Quat, v: Vec3A) -> Vec3A {
    math::turned(rotation, v)
}

/// Returns the cross product, with each product rounded separately (no fused multiply-add).
#[must_use]
#[inline]
pub fn cross(a: Vec3A, b: Vec3A) -> Vec3A {
    math::cross(a, b)
}

/// Returns the length of a vector, without intermediate overflow or underflow.
#[must_use]
pub fn length(v: Vec3A) -> f32 {
    math::length(v)
}

/// Returns the square root; 0 for negative numbers and NaN.
#[must_use]
pub fn square_root(x: f32) -> f32 {
    math::sqrt(x)
}

/// Returns the angle of a unit quaternion's rotation, taken the shorter way, radians, 0…π.
#[must_use]
pub fn angle(rotation: Quat) -> f32 {
    turn::angle(rotation)
}

/// Normalised linear interpolation along the shorter arc; the angular speed is not constant.
///
/// `weight` is clamped to 0…1, NaN counts as 0; a quaternion that is zero or not finite counts as the identity.
///
/// ```
/// # use aim_runtime::{glam::Quat, rotation};
/// let [a, b] = [Quat::IDENTITY, Quat::from_rotation_x(1.0)];
/// assert!(rotation::nlerp(a, -b, 0.5).abs_diff_eq(Quat::from_rotation_x(0.5), 1e-6)); // b and -b are one rotation
/// ```
#[must_use]
pub fn nlerp(a: Quat, b: Quat, weight: f32) -> Quat {
    let [a, b] = [a, b].map(|rotation| unit(rotation).unwrap_or(Quat::IDENTITY));
    let weight = clamped(weight);
    let b = if dot(a, b) < 0.0 { -b } else { b };
    // The sum of two unit quaternions in one hemisphere has a length of at least √½.
    normalized(a * (1.0 - weight) + b * weight)
}

/// Spherical linear interpolation along the shorter arc, at constant angular speed. Weight and degenerate input as in
/// [`nlerp`].
#[must_use]
pub fn slerp(a: Quat, b: Quat, weight: f32) -> Quat {
    let [a, b] = [a, b].map(|rotation| unit(rotation).unwrap_or(Quat::IDENTITY));
    normalized(product(part(normalized(product(b, a.conjugate())), clamped(weight)), a))
}

/// Returns the rotation vector of a unit quaternion: its axis times its angle, radians. The angle is taken the shorter
/// way, so the length is at most π.
///
/// Zero for a quaternion that is zero or not finite.
///
/// ```
/// # use aim_runtime::{glam::{Quat, Vec3}, rotation};
/// assert!(rotation::log(Quat::from_rotation_z(0.3)).abs_diff_eq(Vec3::new(0.0, 0.0, 0.3), 1e-6));
/// assert_eq!(rotation::log(Quat::IDENTITY), Vec3::ZERO);
/// ```
#[must_use]
pub fn log(rotation: Quat) -> Vec3 {
    let Some(rotation) = unit(rotation) else { return Vec3::ZERO };
    let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
    let axis = Vec3A::new(rotation.x, rotation.y, rotation.z);
    let sin = math::length(axis);
    // angle / sin(angle / 2), which is 2 at angle 0.
    let factor = if sin > 1e-9 { 2.0 * atan2(sin, rotation.w) / sin } else { 2.0 };
    (axis * factor).into()
}

/// Returns the unit quaternion of a rotation vector: the rotation about its direction by its length, radians. Inverse
/// of [`log`].
///
/// Returns the identity if the vector is not finite.
#[must_use]
pub fn exp(vector: Vec3) -> Quat {
    let angle = math::length(vector.into());
    if !angle.is_finite() {
        return Quat::IDENTITY;
    }
    let (sin, cos) = half_sin_cos_within(wrap_pi(angle));
    // sin(angle / 2) / angle, which is ½ at angle 0.
    let axis = if angle > 1e-9 { vector / angle * sin } else { vector * 0.5 };
    unit(Quat::from_xyzw(axis.x, axis.y, axis.z, cos)).unwrap_or(Quat::IDENTITY)
}

/// Returns the shortest rotation from one direction to another; between opposite directions, about an arbitrary
/// orthogonal axis. The vectors may have any length. Returns the identity if one is zero or not finite.
///
/// ```
/// # use aim_runtime::{glam::Vec3, rotation};
/// let turn = rotation::shortest(Vec3::X, Vec3::NEG_X);
/// assert!((turn * Vec3::X).abs_diff_eq(Vec3::NEG_X, 1e-6) && (rotation::angle(turn) - core::f32::consts::PI).abs() < 1e-6);
/// ```
#[must_use]
pub fn shortest(from: Vec3, to: Vec3) -> Quat {
    let (Some(from), Some(to)) = (math::direction(from.into()), math::direction(to.into())) else {
        return Quat::IDENTITY;
    };
    turn::shortest(from, to)
}

/// Gram–Schmidt orthonormalisation of the columns, in order x, y, z. Keeps handedness. `None` if the columns are
/// linearly dependent to 1e-5, or not finite.
///
/// ```
/// # use aim_runtime::{glam::{Mat3A, Vec3A}, rotation};
/// let skewed = Mat3A::from_cols(2.0 * Vec3A::X, Vec3A::new(0.2, 1.0, 0.0), Vec3A::Z);
/// assert_eq!(rotation::gram_schmidt(skewed), Some(Mat3A::IDENTITY)); // the first column keeps its direction
/// assert_ne!(rotation::nearest_orthogonal(skewed), Some(Mat3A::IDENTITY)); // none does more than the others
/// ```
#[must_use]
pub fn gram_schmidt(m: Mat3A) -> Option<Mat3A> {
    math::orthonormal(m)
}

/// Returns the orthogonal matrix nearest to the normalised columns: the orthogonal factor of their polar decomposition,
/// which favours no column. Keeps handedness. `None` if the columns are linearly dependent to 1e-5, or not finite.
#[must_use]
pub fn nearest_orthogonal(m: Mat3A) -> Option<Mat3A> {
    math::orthonormal(m)?;
    let [x, y, z] = [m.x_axis, m.y_axis, m.z_axis].map(math::direction);
    let mut frame = Mat3A::from_cols(x?, y?, z?);
    // Newton's iteration F ← (F + F⁻ᵀ) / 2: halves large singular values, then converges quadratically.
    for _ in 0..40 {
        let next = (frame + math::inverse(frame).transpose()) * 0.5;
        let change = next - frame;
        let most = change.x_axis.abs().max(change.y_axis.abs()).max(change.z_axis.abs()).max_element();
        frame = next;
        if !(most > 3e-7) {
            break;
        }
    }
    // Only removes rounding errors.
    math::orthonormal(frame)
}

/// Returns the inverse of an affine transform. `None` if its columns are linearly dependent to 1e-5, or if it or its
/// inverse is not finite.
///
/// ```
/// # use aim_runtime::{glam::{Affine3A, Vec3}, rotation};
/// let twice = Affine3A::from_scale(Vec3::splat(2.0));
/// assert_eq!(rotation::inverse(&twice), Some(Affine3A::from_scale(Vec3::splat(0.5))));
/// assert_eq!(rotation::inverse(&Affine3A::from_scale(Vec3::new(1.0, 1.0, 0.0))), None);
/// ```
#[must_use]
pub fn inverse(transform: &Affine3A) -> Option<Affine3A> {
    math::orthonormal(transform.matrix3)?;
    let inverse = chain::inverse(transform);
    inverse.is_finite().then_some(inverse)
}

/// Clamps a weight to 0…1; NaN counts as 0.
fn clamped(weight: f32) -> f32 {
    weight.max(0.0).min(1.0)
}
