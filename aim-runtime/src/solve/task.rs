//! [`Task`]: the task of the joints in a call, and judging its result.

use glam::{Quat, Vec3A};

use super::judge::{Measured, Verdict, limits_met};
use crate::kinematics::chain::{Chain, Space};
use crate::limits::RangeOfMotion;
use crate::limits::motion::wrap;
use crate::rig::{ChainRig, Memory, PerJoint};
use crate::target::goal::Goal;
use crate::{Joint, JointSet, Outcome, Settings};

/// The results of a chain's solve that its eyes need.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChainSolution {
    pub(crate) goal: Goal,
    pub(crate) space: Space,
    /// The point that the outcome is measured against, with the turns of the joints inside the leading one undone,
    /// in solver space; `None` if the solver did not compute it.
    pub(crate) measured_point: Option<Vec3A>,
}

/// The state that a solve changes and the corrections that it writes, one for each joint.
pub(crate) struct SolveOutput<'a, const C: usize> {
    pub(crate) joints: &'a mut PerJoint<Joint, C>,
    pub(crate) memory: &'a mut Memory,
    pub(crate) corrections: &'a mut [Quat],
    /// Receives the results for the eyes, if requested.
    pub(crate) solution: Option<&'a mut Option<ChainSolution>>,
}

/// The task of the joints, and the inputs to judge its result.
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
    /// Calls [`finish`](Self::finish) with the forward kinematics of a chain, and writes the joints' corrections.
    #[inline(always)]
    pub(crate) fn finish_chain(
        &self,
        chain: &Chain<C>,
        SolveOutput { joints, memory, corrections, solution }: SolveOutput<'_, C>,
    ) -> Option<Outcome> {
        if let Some(solution) = solution {
            *solution = Some(ChainSolution { goal: *self.goal, space: self.space, measured_point: None });
        }
        self.finish(joints, memory, |joints| {
            let (gaze, turns) = chain.gaze_and_corrections(self.rig, joints);
            corrections.copy_from_slice(&turns);
            gaze.angle_to(self.goal.measured_point).map(Measured::of_angle)
        })
    }

    /// Updates the memory and judges the joints' present angles by the remaining angle that `measure` measures with
    /// forward kinematics.
    #[inline(always)]
    pub(crate) fn finish(
        &self,
        joints: &mut [Joint],
        memory: &mut Memory,
        measure: impl FnOnce(&[Joint]) -> Option<Measured>,
    ) -> Option<Outcome> {
        let &Self { rig, motions, goal, settings, within_reach, well_within, .. } = self;
        if !rig.has_fixed_ranges {
            for (joint, motion) in joints.iter_mut().zip(motions) {
                wrap(motion, joint);
            }
        }
        (memory.side, memory.behind) = (goal.side, goal.behind);
        let measured = measure(joints)?;
        let tolerance = settings.effective_tolerance();
        let verdict = Verdict { remaining: measured.remaining, tolerance, behind: goal.behind, within_reach };
        let outcome = if well_within {
            verdict.outcome_by(measured.aim, JointSet::EMPTY, JointSet::EMPTY)
        } else {
            let (at_limit, recovering) = limits_met(rig.joints, motions, joints);
            verdict.outcome_by(measured.aim, at_limit, recovering)
        };
        Some(outcome)
    }
}
