//! The ranges of motion that a call works with, made once a call from what was declared and, where they count from the
//! bind pose, from how the animation stands to it. Specialised solvers read declared ranges themselves where those are fixed.

use glam::{Affine3A, Mat3A, Vec3A};

use crate::limits::{Angles, Interval, RangeOfMotion};
use crate::math::trig;
use crate::rig::{ChainRig, PoseSlices};
use crate::{Joint, JointInfo, LimitsFrom, math};

/// The ranges of a joint that the animation turns by these angles out of the bind pose; `None` where they are counted from
/// the animation.
fn ranges(info: &JointInfo, animated: Option<Angles>) -> RangeOfMotion {
    RangeOfMotion::new(Angles { heading: info.heading, pitch: info.pitch }, info.pitch_taper, animated)
}

/// Brings free angles back within half a turn; leaves the others.
pub(crate) fn wrap(motion: &RangeOfMotion, joint: &mut Joint) {
    if motion.heading.is_free() {
        joint.heading = math::wrap_pi(joint.heading);
    }
    if motion.pitch.is_free() {
        joint.pitch = math::wrap_pi(joint.pitch);
    }
}

/// Finds every joint's ranges of motion in this pose. Without a bind pose, and for a joint whose animated or bind transform
/// has no rotation, absolute ranges count as relative.
#[inline(always)]
pub(crate) fn find_motions<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &PoseSlices<'_>,
    motions: &mut [RangeOfMotion],
) {
    if rig.has_fixed_ranges {
        // The declared ranges as they are.
        let ends = |range: Option<[f32; 2]>| range.map_or(Interval::REST, |[lo, hi]| Interval::from_ends(lo, hi));
        for (motion, info) in motions.iter_mut().zip(rig.joints) {
            (motion.heading, motion.pitch) = (ends(info.heading), ends(info.pitch));
        }
        return;
    }
    for (index, (motion, info)) in motions.iter_mut().zip(rig.joints).enumerate() {
        *motion = range_in_pose(info, pose, index);
    }
}

/// The ranges of motion of one joint in this pose.
pub(crate) fn range_in_pose(info: &JointInfo, pose: &PoseSlices<'_>, index: usize) -> RangeOfMotion {
    let animated = if info.limits_from == LimitsFrom::BindPose { animated_angles(info, pose, index) } else { None };
    ranges(info, animated)
}

/// The ranges of motion of joint 0's mirror image, which the animation leads in parallel with it: heading to the left
/// becomes heading to the right. `own` is joint 0's.
#[inline(always)]
pub(crate) fn mirrored<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &PoseSlices<'_>,
    own: &RangeOfMotion,
) -> RangeOfMotion {
    let mut info = rig.joints[0];
    if rig.has_fixed_ranges {
        return RangeOfMotion { heading: Interval::from_ends(-own.heading.hi(), -own.heading.lo()), ..*own };
    }
    info.heading = info.heading.map(|[lo, hi]| [-hi, -lo]);
    range_in_pose(&info, pose, 0)
}

/// The heading and pitch by which the animation turns a joint's forward out of the bind pose:
/// `bind⁻¹ · local = R_heading · R_pitch · R_roll`. Where forward points straight up or down its heading is 0.
fn animated_angles(info: &JointInfo, pose: &PoseSlices<'_>, index: usize) -> Option<Angles> {
    let local = local_rotation(pose.joints, index)?;
    let bind = local_rotation(pose.bind?, index)?;
    let axes = &info.axes;
    let forward = bind.transpose() * (local * Vec3A::from(axes.forward));
    let [ahead, left, up] = [axes.forward, axes.left, axes.up].map(|axis| forward.dot(axis.into()));
    let level = math::sqrt(ahead * ahead + left * left);
    let heading = if level > 1e-6 { trig::atan2(left, ahead) } else { 0.0 };
    let pitch = trig::atan2(up, level);
    (heading.is_finite() && pitch.is_finite()).then_some(Angles { heading, pitch })
}

/// A joint's rotation in the next joint's frame, scale taken out; the innermost one's in the pose's space.
fn local_rotation(joints: &[Affine3A], index: usize) -> Option<Mat3A> {
    let joint = math::orthonormal(joints.get(index)?.matrix3)?;
    match joints.get(index + 1) {
        Some(next) => Some(math::orthonormal(next.matrix3)?.transpose() * joint),
        None => Some(joint),
    }
}
