//! Rotation that a joint adds: heading and pitch about its bone's axes, as a quaternion.

use glam::{Mat3A, Quat, Vec3A, Vec4, Vec4Swizzles};

use crate::math::trig::{self, Halves};
use crate::{Axes, Joint, JointInfo, math};

/// Rotation axes of heading and pitch, padded to vectors of four.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Planes {
    /// Matrix with forward, left and up as columns.
    pub(crate) basis: Mat3A,
    /// Each entry of `basis` as a vector of four equal numbers, by columns.
    splats: [[Vec3A; 3]; 3],
    by_heading: Vec4,
    by_pitch: Vec4,
    by_both: Vec4,
    /// Result of [`are_square`](Self::are_square).
    square: bool,
}

impl Planes {
    /// Derives the axes from the planes forward–left and forward–up, not from handedness. This is correct for mirrored
    /// and left-handed triples too.
    pub(crate) const fn new(axes: &Axes) -> Self {
        const OFF: f32 = 2e-7;
        const fn cross(a: [f32; 4], b: [f32; 4]) -> [f32; 4] {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0.0]
        }
        const fn padded([x, y, z]: [f32; 3]) -> [f32; 4] {
            [x, y, z, 0.0]
        }
        const fn splat([x, y, z]: [f32; 3]) -> [Vec3A; 3] {
            [Vec3A::splat(x), Vec3A::splat(y), Vec3A::splat(z)]
        }
        const fn is_zero(a: [f32; 4], b: [f32; 4], less: f32) -> bool {
            let dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] - less;
            -OFF <= dot && dot <= OFF
        }
        let (up, forward, left) = (padded(axes.up), padded(axes.forward), padded(axes.left));
        let (by_heading, by_pitch) = (cross(forward, left), cross(forward, up));
        let unit = is_zero(up, up, 1.0) && is_zero(forward, forward, 1.0) && is_zero(left, left, 1.0);
        let square = unit && is_zero(forward, up, 0.0) && is_zero(forward, left, 0.0);
        let by_both = Vec4::from_array(cross(by_heading, by_pitch));
        let (by_heading, by_pitch) = (Vec4::from_array(by_heading), Vec4::from_array(by_pitch));
        let basis =
            Mat3A::from_cols(Vec3A::from_array(axes.forward), Vec3A::from_array(axes.left), Vec3A::from_array(axes.up));
        let splats = [splat(axes.forward), splat(axes.left), splat(axes.up)];
        Self { basis, splats, by_heading, by_pitch, by_both, square }
    }

    /// Returns the forward, left and up of a joint with this matrix: its product with the basis. The entries need no
    /// copying to all lanes.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn frame(&self, Mat3A { x_axis, y_axis, z_axis }: &Mat3A) -> Mat3A {
        let [forward, left, up] = &self.splats;
        let axis = |[x, y, z]: &[Vec3A; 3]| *x_axis * *x + *y_axis * *y + *z_axis * *z;
        Mat3A::from_cols(axis(forward), axis(left), axis(up))
    }

    /// Returns `true` if the axes are unit and orthogonal to the precision that a correction needs.
    pub(crate) const fn are_square(&self) -> bool {
        self.square
    }
}

/// Returns the rotation that a joint adds at its angles, in its upright frame.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn joint_turn(info: &JointInfo, joint: &Joint) -> Quat {
    turn(&info.axes, &info.planes, trig::halves_of(Vec4::new(joint.heading, joint.pitch, 0.0, 0.0)).to_array())
}

/// Returns the correction of a joint: the bone's animated local rotation is multiplied by it on the right,
/// `local' = local · R_heading · R_pitch` (pitch acts first). `tilt` is the orientation of the joint's upright frame in
/// its bone's space.
///
/// Unit to 1e-6 for orthonormal axes, and exactly the identity if both angles are 0.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn correction(info: &JointInfo, joint: &Joint, tilt: Quat) -> Quat {
    tilted(joint_turn(info, joint), tilt)
}

/// Converts a rotation of the upright frame to one of the bone, tilt · turn · tilt⁻¹.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn tilted(turn: Quat, tilt: Quat) -> Quat {
    if is_identity(tilt) {
        return turn;
    }
    let axis = math::turned(tilt, Vec3A::new(turn.x, turn.y, turn.z));
    Quat::from_xyzw(axis.x, axis.y, axis.z, turn.w)
}

/// Returns the rotation from sines and cosines of half the pitch and half the heading, in the bone or its upright
/// frame.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn turn(axes: &Axes, planes: &Planes, halves: [f32; 4]) -> Quat {
    if !planes.square {
        return turn_by_planes(axes, halves);
    }
    let products = half_products(Vec4::from_array(halves));
    let [by_heading, by_pitch, by_both, _] = products.to_array();
    let axis = planes.by_heading * by_heading + planes.by_pitch * by_pitch + planes.by_both * by_both;
    Quat::from_vec4(axis + Vec4::W * products)
}

/// Returns sin h cos p, cos h sin p, sin h sin p, cos h cos p of half a heading h and half a pitch p. The rotation of a
/// frame (f, l, u), if it is not mirrored, is the quaternion with the vector part u·sin h cos p − l·cos h sin p +
/// f·sin h sin p and w = cos h cos p.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn half_products(halves: Halves) -> Vec4 {
    halves.zwzw() * halves.yxxy()
}

/// [`turn`] for axes that are not orthonormal: each angle turns in its own plane, or not at all if the plane is
/// degenerate.
#[cold]
fn turn_by_planes(axes: &Axes, [sin_p, cos_p, sin_h, cos_h]: [f32; 4]) -> Quat {
    let [up, forward, left] = [axes.up, axes.forward, axes.left].map(Vec3A::from);
    let turn = |to: Vec3A, sin: f32, cos: f32| {
        let axis = math::direction(math::cross(forward, to)).unwrap_or(Vec3A::ZERO) * sin;
        if axis == Vec3A::ZERO { Quat::IDENTITY } else { Quat::from_xyzw(axis.x, axis.y, axis.z, cos) }
    };
    math::product(turn(left, sin_h, cos_h), turn(up, sin_p, cos_p))
}

#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn is_identity(turn: Quat) -> bool {
    turn.x == 0.0 && turn.y == 0.0 && turn.z == 0.0
}
