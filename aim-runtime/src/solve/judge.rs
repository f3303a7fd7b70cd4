//! The one place where [`Status`] and [`Outcome`] are determined, from the angle that forward kinematics measures.

use crate::limits::reach::AT_LIMIT_RAD;
use crate::limits::{Interval, RangeOfMotion};
use crate::math::Bounded;
use crate::math::trig;
use crate::rig::ChainRig;
use crate::{Joint, JointInfo, JointSet, Outcome, Status, math};

/// The measurements from which an outcome is determined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Verdict {
    /// The angle between gaze and target by forward kinematics, radians, 0…π.
    pub(crate) remaining: f32,
    /// The angle at which the target counts as reached, radians.
    pub(crate) tolerance: f32,
    /// `true` if the policy for targets behind is active.
    pub(crate) behind: bool,
    /// `true` if the joints could reach the target given enough time.
    pub(crate) within_reach: bool,
}

/// The angle between gaze and target, and its cosine.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Measured {
    /// The angle, radians, 0…π.
    pub(crate) remaining: f32,
    /// Its cosine.
    pub(crate) aim: f32,
}

impl Measured {
    /// Creates the measurement of an angle whose cosine is not known.
    #[inline(always)]
    pub(crate) fn of_angle(remaining: f32) -> Self {
        let (sin_half, _) = trig::half_sin_cos_within(remaining);
        Self { remaining, aim: (1.0 - 2.0 * sin_half * sin_half).at_least(-1.0) }
    }
}

impl Verdict {
    /// Returns `Reached` if the angle is within the tolerance, else the first other status that applies.
    #[inline(always)]
    pub(crate) fn status(&self) -> Status {
        if self.remaining <= self.tolerance {
            Status::Reached
        } else if self.behind {
            Status::Behind
        } else if self.within_reach {
            Status::RateLimited
        } else {
            Status::AtLimit
        }
    }

    /// Returns the outcome for joints with these sets of limits met.
    #[inline(always)]
    pub(crate) fn outcome_at(&self, at_limit: JointSet, recovering: JointSet) -> Outcome {
        self.outcome_by(Measured::of_angle(self.remaining).aim, at_limit, recovering)
    }

    /// Returns the outcome, with `aim` the known cosine of the remaining angle.
    #[inline(always)]
    pub(crate) fn outcome_by(&self, aim: f32, at_limit: JointSet, recovering: JointSet) -> Outcome {
        let (remaining, status) = (self.remaining, self.status());
        Outcome {
            aim,
            remaining,
            status,
            at_limit,
            recovering,
            body_turn: 0.0,
            out_of_reach_for: 0.0,
            other_eye_remaining: None,
            other_eye_correction: None,
        }
    }
}

/// Returns the outcome of a call with nothing to aim, for joints that keep their angles.
pub(crate) fn degenerate<const C: usize>(
    rig: &ChainRig<'_, C>,
    motions: &[RangeOfMotion],
    joints: &[Joint],
) -> Outcome {
    let (at_limit, recovering) = limits_met(rig.joints, motions, joints);
    Outcome { at_limit, recovering, ..nothing_to_aim() }
}

/// Returns the outcome of a call that has no chain to aim.
pub(crate) fn nothing_to_aim() -> Outcome {
    let verdict = Verdict { remaining: math::UNDEFINED_RAD, tolerance: 0.0, behind: false, within_reach: false };
    Outcome { status: Status::Degenerate, ..verdict.outcome_by(0.0, JointSet::EMPTY, JointSet::EMPTY) }
}

/// Returns the joints with an angle at or past an end of its range, and the joints with an angle outside its range.
pub(crate) fn limits_met(infos: &[JointInfo], motions: &[RangeOfMotion], joints: &[Joint]) -> (JointSet, JointSet) {
    let (mut at_limit, mut recovering) = (JointSet::EMPTY, JointSet::EMPTY);
    let mut meet = |index: usize, is_declared: bool, range: Interval, angle: f32| {
        let margin = (angle - range.lo()).at_most(range.hi() - angle);
        if margin > AT_LIMIT_RAD {
            return;
        }
        if is_declared {
            at_limit.insert(index);
        }
        // This allows for rounding of an angle that has just returned to its range.
        if margin < -AT_LIMIT_RAD {
            recovering.insert(index);
        }
    };
    for (index, ((info, motion), joint)) in infos.iter().zip(motions).zip(joints).enumerate() {
        meet(index, info.heading.is_some(), motion.heading, joint.heading);
        meet(index, info.pitch.is_some(), motion.pitch_at(joint.heading), joint.pitch);
    }
    (at_limit, recovering)
}
