//! Turns as the solvers of this module need them: total, and the same bits everywhere.

use core::f32::consts::FRAC_PI_2;

use glam::{Mat3A, Quat, Vec3A, Vec4};

use super::trig::{atan2, sin_cos};
use super::{cross, direction};

/// Directions less than this apart in sine have no plane between them.
pub(crate) const FLAT: f32 = 1e-5;

/// The unit vector of what of `v` is square to the unit vector `along`.
pub(crate) fn across(v: Vec3A, along: Vec3A) -> Option<Vec3A> {
    let v = direction(v)?;
    let across = v - along * v.dot(along);
    if across.length() > FLAT { direction(across - along * across.dot(along)) } else { None }
}

/// The turn from one pair of square unit vectors to another.
pub(crate) fn between([a, b]: [Vec3A; 2], [to_a, to_b]: [Vec3A; 2]) -> Quat {
    let (from, to) = ([a, b, cross(a, b)], [to_a, to_b, cross(to_a, to_b)]);
    let column = |i: usize| to[0] * from[0][i] + to[1] * from[1][i] + to[2] * from[2][i];
    normalized(Quat::from_mat3a(&Mat3A::from_cols(column(0), column(1), column(2))))
}

/// The shortest turn from one unit vector to another, exact to rounding also near none and near half a turn; about any
/// axis between opposites.
pub(crate) fn shortest(from: Vec3A, to: Vec3A) -> Quat {
    let axis = cross(from, to);
    let sum = from + to;
    if from.dot(to) > 0.0 {
        return normalized(Quat::from_xyzw(axis.x, axis.y, axis.z, 0.5 * sum.dot(sum)));
    }
    // Near half a turn the product's digits say little: it is made square to both.
    let axis = across(axis, from).unwrap_or_else(|| from.any_orthonormal_vector());
    across(axis, to).map_or(Quat::IDENTITY, |to_axis| between([from, axis], [to, to_axis]))
}

/// Half the angle of a unit quaternion's turn, the short way, 0…π/2, and its axis; `None` where it does not turn.
fn half_and_axis(turn: Quat) -> Option<(f32, Vec3A)> {
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let sin = Vec3A::from_vec4(Vec4::from(turn));
    Some((atan2(sin.length(), turn.w).min(FRAC_PI_2), direction(sin)?))
}

/// The angle of a turn, the short way, 0…π.
pub(crate) fn angle(turn: Quat) -> f32 {
    half_and_axis(turn).map_or(0.0, |(half, _)| 2.0 * half)
}

/// The turn about a unit axis by twice this angle.
pub(crate) fn about(axis: Vec3A, half_rad: f32) -> Quat {
    let (sin, cos) = sin_cos(half_rad);
    let axis = axis * sin;
    normalized(Quat::from_xyzw(axis.x, axis.y, axis.z, cos))
}

/// A part of a turn, the short way.
pub(crate) fn part(turn: Quat, part: f32) -> Quat {
    half_and_axis(turn).map_or(Quat::IDENTITY, |(half, axis)| about(axis, half * part))
}

/// The turn, the short way, as far as it is no larger than this, radians.
pub(crate) fn at_most(turn: Quat, most_rad: f32) -> Quat {
    match half_and_axis(turn) {
        Some((half, axis)) if 2.0 * half > most_rad => about(axis, 0.5 * most_rad),
        _ => turn,
    }
}

/// The sum of products; the same bits everywhere, where glam adds in the machine's own order.
pub(crate) fn dot(a: Quat, b: Quat) -> f32 {
    a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w
}

/// The quaternion, neither tiny nor huge, at length 1; the same bits everywhere, as [`dot`].
pub(crate) fn normalized(turn: Quat) -> Quat {
    turn * (1.0 / super::sqrt(dot(turn, turn)))
}

/// The quaternion at length 1; `None` where it has no length, or none that is finite.
pub(crate) fn unit(turn: Quat) -> Option<Quat> {
    let largest = Vec4::from(turn).abs().max_element();
    if !(largest > 0.0 && turn.is_finite()) {
        return None;
    }
    let unit = normalized(turn * (1.0 / largest));
    unit.is_finite().then_some(unit)
}
