//! The ranges of motion of a call, evaluated once per call from the declared ranges and, for ranges that are measured
//! from the bind pose, from the angles of the animated pose relative to it. Specialised solvers use the declared ranges
//! directly if those are fixed.

use glam::{Affine3A, Mat3A, Vec3A};

use crate::limits::{Angles, Interval, RangeOfMotion};
use crate::math::trig;
use crate::rig::{ChainRig, LANE_JOINTS, PerJoint, PoseSlices};
use crate::{Joint, JointInfo, LimitsFrom, math};

/// Returns the ranges of a joint that the animation turns by `animated` out of the bind pose; `None` if they are
/// measured from the animation.
fn ranges(info: &JointInfo, animated: Option<Angles>) -> RangeOfMotion {
    RangeOfMotion::new(Angles { heading: info.heading, pitch: info.pitch }, info.pitch_taper, animated)
}

/// Wraps free angles to ±π; leaves the others unchanged.
pub(crate) fn wrap(motion: &RangeOfMotion, joint: &mut Joint) {
    if motion.heading.is_free() {
        joint.heading = math::wrap_pi(joint.heading);
    }
    if motion.pitch.is_free() {
        joint.pitch = math::wrap_pi(joint.pitch);
    }
}

/// Evaluates every joint's ranges of motion in this pose. Ranges relative to the bind pose count as relative to the
/// animation if the pose has no bind pose or if the joint's animated or bind transform contains no rotation.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn find_motions<const C: usize>(rig: &ChainRig<'_, C>, pose: &PoseSlices<'_>) -> PerJoint<RangeOfMotion, C> {
    if rig.has_fixed_ranges && C <= LANE_JOINTS {
        // Fixed ranges do not depend on the pose.
        return rig.array_of(RangeOfMotion::REST, |index| rig.lanes[index / 2].motion(index % 2));
    }
    rig.array_of(RangeOfMotion::REST, |index| range_in_pose(&rig.joints[index], pose, index))
}

/// Returns the ranges of motion of one joint in this pose.
pub(crate) fn range_in_pose(info: &JointInfo, pose: &PoseSlices<'_>, index: usize) -> RangeOfMotion {
    let animated = if info.limits_from == LimitsFrom::BindPose { animated_angles(info, pose, index) } else { None };
    ranges(info, animated)
}

/// Changes joint 0's ranges of motion to those of its mirror image, whose animated direction is parallel to joint 0's:
/// the heading range is reflected.
#[cfg_attr(not(aim_small), inline(always))]
pub(crate) fn mirror<const C: usize>(rig: &ChainRig<'_, C>, pose: &PoseSlices<'_>, motion: &mut RangeOfMotion) {
    if rig.has_fixed_ranges {
        motion.heading = Interval::ordered(-motion.heading.hi(), -motion.heading.lo());
        return;
    }
    let mut info = rig.joints[0];
    info.heading = info.heading.map(|[lo, hi]| [-hi, -lo]);
    *motion = range_in_pose(&info, pose, 0);
}

/// Returns the heading and pitch by which the animation turns a joint's forward out of the bind pose:
/// `bind⁻¹ · local = R_heading · R_pitch · R_roll`. The heading is 0 if forward points straight up or down.
pub(crate) fn animated_angles(info: &JointInfo, pose: &PoseSlices<'_>, index: usize) -> Option<Angles> {
    let bind = local_rotation(pose.bind?, index)?;
    let local = local_rotation(pose.joints, index)?;
    let axes = &info.axes;
    let forward = bind.transpose() * (local * Vec3A::from(axes.forward));
    let [ahead, left, up] = [axes.forward, axes.left, axes.up].map(|axis| forward.dot(axis.into()));
    let level = math::sqrt(ahead * ahead + left * left);
    let heading = if level > 1e-6 { trig::atan2(left, ahead) } else { 0.0 };
    let pitch = trig::atan2(up, level);
    (heading.is_finite() && pitch.is_finite()).then_some(Angles { heading, pitch })
}

/// Returns a joint's rotation in the next joint's frame, without scale; the innermost joint's in the pose's space.
fn local_rotation(joints: &[Affine3A], index: usize) -> Option<Mat3A> {
    let joint = math::orthonormal(joints.get(index)?.matrix3)?;
    match joints.get(index + 1) {
        Some(next) => Some(math::orthonormal(next.matrix3)?.transpose() * joint),
        None => Some(joint),
    }
}
