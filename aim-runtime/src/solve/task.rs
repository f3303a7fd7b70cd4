//! [`Task`]: the task of the joints in a call, and judging its result.

use glam::Quat;

use super::eyes::{ChainResult, Eyes};
use super::judge::{Measured, Verdict, limits_met};
use crate::kinematics::chain::{Chain, Space};
use crate::limits::RangeOfMotion;
use crate::limits::motion::wrap;
use crate::rig::{ChainRig, Memory, PerJoint};
use crate::target::goal::Goal;
use crate::{Joint, JointSet, Outcome, Settings};

/// The state that a solve changes and the corrections that it writes, one for each joint.
pub(crate) struct SolveOutput<'a, const C: usize> {
    pub(crate) joints: &'a mut PerJoint<Joint, C>,
    pub(crate) memory: &'a mut Memory,
    pub(crate) corrections: &'a mut [Quat],
    /// The eyes that replace joint 0 at the end, if there are two.
    pub(crate) eyes: Option<&'a Eyes<'a, C>>,
}

/// The task of the joints, and the inputs to judge its result.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a, const C: usize> {
    pub(crate) rig: &'a ChainRig<'a, C>,
    pub(crate) motions: &'a [RangeOfMotion],
    pub(crate) goal: &'a Goal,
    pub(crate) space: Space,
    pub(crate) settings: &'a Settings,
    /// `true` if the joints could reach the goal given enough time.
    pub(crate) within_reach: bool,
    /// `true` if no angle can be at an end of its range.
    pub(crate) well_within: bool,
}

impl<const C: usize> Task<'_, C> {
    /// Judges the joints' present angles by the forward kinematics of a chain, and writes the joints' corrections.
    /// Replaces the leading eye by both eyes, if there are two.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn finish_chain(
        &self,
        chain: &Chain<C>,
        SolveOutput { joints, memory, corrections, eyes }: SolveOutput<'_, C>,
    ) -> Option<Outcome> {
        self.remember(joints, memory);
        let (gaze, turns) = chain.gaze_and_corrections(self.rig, joints);
        corrections.copy_from_slice(&turns);
        let outcome = self.judge(joints, Measured::of_angle(gaze.angle_to(self.goal.measured_point)?));
        match eyes {
            Some(eyes) => {
                let chain = ChainResult { outcome, goal: self.goal, space: self.space };
                eyes.replace_leading(&chain, joints, memory, corrections)
            }
            None => Some(outcome),
        }
    }

    /// Wraps free angles and remembers the goal.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn remember(&self, joints: &mut [Joint], memory: &mut Memory) {
        if !self.rig.has_fixed_ranges {
            for (joint, motion) in joints.iter_mut().zip(self.motions) {
                wrap(motion, joint);
            }
        }
        (memory.side, memory.behind) = (self.goal.side, self.goal.behind);
    }

    /// Judges the joints' present angles by the remaining angle that forward kinematics measured.
    #[cfg_attr(not(aim_small), inline(always))]
    pub(crate) fn judge(&self, joints: &[Joint], measured: Measured) -> Outcome {
        let &Self { rig, motions, goal, settings, within_reach, well_within, .. } = self;
        let tolerance = settings.effective_tolerance();
        let verdict = Verdict { remaining: measured.remaining, tolerance, behind: goal.behind, within_reach };
        if well_within {
            verdict.outcome_by(measured.aim, JointSet::EMPTY, JointSet::EMPTY)
        } else {
            let (at_limit, recovering) = limits_met(rig.joints, motions, joints);
            verdict.outcome_by(measured.aim, at_limit, recovering)
        }
    }
}
