//! Operations on rotations for the solvers: total, and with the same bits on every machine.

use core::f32::consts::FRAC_PI_2;

use glam::{Mat3A, Quat, Vec3A, Vec4};

use super::trig::{atan2, sin_cos};
use super::{cross, direction};

/// Sine of the angle below which two directions span no plane.
pub(crate) const FLAT: f32 = 1e-5;

/// Returns the unit vector along the component of `v` orthogonal to the unit vector `along`. `None` if the two are
/// parallel, or if `v` has no direction.
pub(crate) fn across(v: Vec3A, along: Vec3A) -> Option<Vec3A> {
    let v = direction(v)?;
    let across = v - along * v.dot(along);
    if across.length() > FLAT { direction(across - along * across.dot(along)) } else { None }
}

/// Returns the rotation from one pair of orthogonal unit vectors to another.
pub(crate) fn between([a, b]: [Vec3A; 2], [to_a, to_b]: [Vec3A; 2]) -> Quat {
    let (from, to) = ([a, b, cross(a, b)], [to_a, to_b, cross(to_a, to_b)]);
    let column = |i: usize| to[0] * from[0][i] + to[1] * from[1][i] + to[2] * from[2][i];
    normalized(Quat::from_mat3a(&Mat3A::from_cols(column(0), column(1), column(2))))
}

/// Returns the shortest rotation from one unit vector to another, exact to rounding also near 0 and near a half turn.
/// Between opposite vectors, about an arbitrary orthogonal axis.
pub(crate) fn shortest(from: Vec3A, to: Vec3A) -> Quat {
    let axis = cross(from, to);
    let sum = from + to;
    if from.dot(to) > 0.0 {
        return normalized(Quat::from_xyzw(axis.x, axis.y, axis.z, 0.5 * sum.dot(sum)));
    }
    // Near a half turn the cross product has few significant digits: make it orthogonal to both vectors.
    let axis = across(axis, from).unwrap_or_else(|| from.any_orthonormal_vector());
    across(axis, to).map_or(Quat::IDENTITY, |to_axis| between([from, axis], [to, to_axis]))
}

/// Returns half the angle of a unit quaternion's rotation, taken the shorter way, 0…π/2, and its axis. `None` for the
/// identity.
fn half_and_axis(turn: Quat) -> Option<(f32, Vec3A)> {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let sin = Vec3A::from_vec4(Vec4::from(turn));
    Some((atan2(sin.length(), turn.w).min(FRAC_PI_2), direction(sin)?))
}

/// Returns the angle of a rotation, taken the shorter way, 0…π.
pub(crate) fn angle(turn: Quat) -> f32 {
    half_and_axis(turn).map_or(0.0, |(half, _)| 2.0 * half)
}

/// Returns the rotation about a unit axis by twice this angle, radians.
pub(crate) fn about(axis: Vec3A, half_rad: f32) -> Quat {
    let (sin, cos) = sin_cos(half_rad);
    let axis = axis * sin;
    normalized(Quat::from_xyzw(axis.x, axis.y, axis.z, cos))
}

/// Returns a fraction of a rotation, taken the shorter way.
pub(crate) fn part(turn: Quat, part: f32) -> Quat {
    half_and_axis(turn).map_or(Quat::IDENTITY, |(half, axis)| about(axis, half * part))
}

/// Returns a rotation with its angle, taken the shorter way, clamped to at most this, radians.
pub(crate) fn at_most(turn: Quat, most_rad: f32) -> Quat {
    match half_and_axis(turn) {
        Some((half, axis)) if 2.0 * half > most_rad => about(axis, 0.5 * most_rad),
        _ => turn,
    }
}

/// Returns the dot product. Bit-identical on every machine; glam adds in an order that depends on the machine.
pub(crate) fn dot(a: Quat, b: Quat) -> f32 {
    a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w
}

/// Returns the quaternion scaled to length 1; it must be neither tiny nor huge. Bit-identical on every machine, like
/// [`dot`].
pub(crate) fn normalized(turn: Quat) -> Quat {
    turn * (1.0 / super::sqrt(dot(turn, turn)))
}

/// Returns the quaternion scaled to length 1; `None` if it is zero or not finite.
pub(crate) fn unit(turn: Quat) -> Option<Quat> {
    let largest = Vec4::from(turn).abs().max_element();
    if !(largest > 0.0 && turn.is_finite()) {
        return None;
    }
    let unit = normalized(turn * (1.0 / largest));
    unit.is_finite().then_some(unit)
}
