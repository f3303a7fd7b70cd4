//! [`Motion`]: the ranges of motion that a call works with, made once a call from what was declared and, where ranges
//! are absolute, from how the animation stands to the bind pose. The one place that reads declared ranges.

use glam::{Affine3A, Mat3A, Vec3A};

use crate::limits::reach::Range;
use crate::math::trig;
use crate::rig::{ChainRig, PerJoint, PoseSlices};
use crate::{Joint, JointInfo, LimitsFrom, math};

/// A joint's ranges of motion in this call, as intervals of its added angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Motion {
    pub(crate) heading: Range,
    /// The pitch's range where the heading takes nothing of it. See [`pitch_at`](Self::pitch_at).
    pub(crate) pitch: Range,
    pub(crate) narrowing: Option<Narrowing>,
}

/// How a pitch's range narrows as the heading nears the ends of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Narrowing {
    /// What is lost of the range at either end, 0…1.
    most: f32,
    /// What is lost of it for each radian to the right and to the left.
    per_rad: [f32; 2],
    /// The range that narrows, and the heading and pitch that it is counted from.
    pitch: Range,
    animated: Option<[f32; 2]>,
}

impl Motion {
    pub(crate) const REST: Self = Self { heading: Range::REST, pitch: Range::REST, narrowing: None };

    /// The ranges of a joint that `animated` leads by this heading and pitch; `None` where ranges are relative.
    fn new(info: &JointInfo, animated: Option<[f32; 2]>) -> Self {
        let [heading, pitch] = [info.heading, info.pitch].map(Range::declared);
        let narrowing = Narrowing::new(info.pitch_taper, heading, pitch, animated);
        let mut motion = Self { heading, pitch, narrowing };
        // An angle that was not declared has no range to be counted from anywhere.
        if let Some([animated_heading, animated_pitch]) = animated {
            if info.heading.is_some() {
                motion.heading = heading.counted_from(animated_heading);
            }
            if info.pitch.is_some() {
                motion.pitch = pitch.counted_from(animated_pitch);
            }
        }
        motion
    }

    /// Brings free angles back within half a turn; leaves the others.
    pub(crate) fn wrap(&self, joint: &mut Joint) {
        if self.heading.is_free() {
            joint.heading = math::wrap_pi(joint.heading);
        }
        if self.pitch.is_free() {
            joint.pitch = math::wrap_pi(joint.pitch);
        }
    }

    /// The pitch's range at this added heading.
    pub(crate) fn pitch_at(&self, heading: f32) -> Range {
        match &self.narrowing {
            Some(narrowing) => narrowing.pitch_at(heading),
            None => self.pitch,
        }
    }
}

impl Narrowing {
    /// `None` where nothing narrows: not asked for, no pitch, no end of the heading.
    fn new(most: f32, heading: Range, pitch: Range, animated: Option<[f32; 2]>) -> Option<Self> {
        // NaN is none.
        let most = most.max(0.0).min(1.0);
        let per_rad = [-heading.lo(), heading.hi()].map(|end| if end > 0.0 { most / end } else { 0.0 });
        if pitch.is_free() || pitch == Range::REST || per_rad == [0.0; 2] {
            return None;
        }
        Some(Self { most, per_rad, pitch, animated })
    }

    /// Narrowing what is left of the range at this part of it.
    pub(crate) fn shrunk(self, part: f32) -> Self {
        Self { pitch: self.pitch.scaled(part), ..self }
    }

    pub(crate) fn pitch_at(&self, heading: f32) -> Range {
        let [animated_heading, animated_pitch] = self.animated.unwrap_or_default();
        let heading = heading + animated_heading;
        let [right, left] = self.per_rad;
        let lost = if heading < 0.0 { -heading * right } else { heading * left };
        let narrowed = self.pitch.scaled(1.0 - lost.max(0.0).min(self.most));
        match self.animated {
            Some(_) => narrowed.counted_from(animated_pitch),
            None => narrowed,
        }
    }
}

/// Every joint's ranges of motion in this pose. Without a bind pose, and for a joint whose animated or bind transform
/// has no rotation, absolute ranges count as relative.
pub(crate) fn motions<const C: usize>(rig: &ChainRig<'_, C>, pose: &PoseSlices<'_>) -> PerJoint<Motion, C> {
    let mut motions = rig.array(Motion::REST);
    for (index, (motion, info)) in motions.iter_mut().zip(rig.joints).enumerate() {
        let animated = if info.limits_from == LimitsFrom::BindPose { animated_angles(info, pose, index) } else { None };
        *motion = Motion::new(info, animated);
    }
    motions
}

/// The ranges of motion of joint 0's mirror image, which the animation leads in parallel with it: heading to the left
/// becomes heading to the right.
pub(crate) fn mirrored<const C: usize>(rig: &ChainRig<'_, C>, pose: &PoseSlices<'_>) -> Option<Motion> {
    let mut info = *rig.joints.first()?;
    info.heading = info.heading.map(|[lo, hi]| [-hi, -lo]);
    let animated = if info.limits_from == LimitsFrom::BindPose { animated_angles(&info, pose, 0) } else { None };
    Some(Motion::new(&info, animated))
}

/// The heading and pitch by which the animation turns a joint's forward out of the bind pose:
/// `bind⁻¹ · local = R_heading · R_pitch · R_roll`. Where forward points straight up or down its heading is 0.
fn animated_angles(info: &JointInfo, pose: &PoseSlices<'_>, index: usize) -> Option<[f32; 2]> {
    let local = local_rotation(pose.joints, index)?;
    let bind = local_rotation(pose.bind?, index)?;
    let axes = &info.axes;
    let forward = bind.transpose() * (local * Vec3A::from(axes.forward));
    let [ahead, left, up] = [axes.forward, axes.left, axes.up].map(|axis| forward.dot(axis.into()));
    let level = math::sqrt(ahead * ahead + left * left);
    let heading = if level > 1e-6 { trig::atan2(left, ahead) } else { 0.0 };
    let pitch = trig::atan2(up, level);
    (heading.is_finite() && pitch.is_finite()).then_some([heading, pitch])
}

/// A joint's rotation in the next joint's frame, scale taken out; the innermost one's in the pose's space.
fn local_rotation(joints: &[Affine3A], index: usize) -> Option<Mat3A> {
    let joint = math::orthonormal(joints.get(index)?.matrix3)?;
    match joints.get(index + 1) {
        Some(next) => Some(math::orthonormal(next.matrix3)?.transpose() * joint),
        None => Some(joint),
    }
}
