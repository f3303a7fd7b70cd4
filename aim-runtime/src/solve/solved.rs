//! [`Task`]: the task of the joints in a call, and judging its result.

use glam::{Quat, Vec3A};

use super::judge::Verdict;
use crate::kinematics::chain::{Chain, Space};
use crate::limits::RangeOfMotion;
use crate::limits::motion::wrap;
use crate::rig::{ChainRig, Memory, PerJoint};
use crate::target::goal::Goal;
use crate::{Joint, JointSet, Outcome, Settings};

/// The results of a chain's solve that its eyes need.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub(crate) goal: Goal,
    pub(crate) space: Space,
    /// The point that the outcome is measured against, with the turns of the joints inside the leading one taken back,
    /// in solver space; `None` if the solver did not compute it.
    pub(crate) seen: Option<Vec3A>,
}

/// The state that a solve changes and the corrections that it writes, one for each joint.
pub(crate) struct Moved<'a, const C: usize> {
    pub(crate) joints: &'a mut PerJoint<Joint, C>,
    pub(crate) memory: &'a mut Memory,
    pub(crate) corrections: &'a mut [Quat],
    /// Receives the results for the eyes, if requested.
    pub(crate) found: Option<&'a mut Option<Found>>,
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
        Moved { joints, memory, corrections, found }: Moved<'_, C>,
    ) -> Option<Outcome> {
        if let Some(found) = found {
            *found = Some(Found { goal: *self.goal, space: self.space, seen: None });
        }
        self.finish(joints, memory, |joints| {
            let (gaze, posed) = chain.posed(self.rig, joints);
            corrections.copy_from_slice(&posed);
            gaze.angle_to(self.goal.wanted)
        })
    }

    /// Updates the memory and judges the joints' present angles by the remaining angle that `posed` measures with
    /// forward kinematics.
    #[inline(always)]
    pub(crate) fn finish(
        &self,
        joints: &mut [Joint],
        memory: &mut Memory,
        posed: impl FnOnce(&[Joint]) -> Option<f32>,
    ) -> Option<Outcome> {
        let &Self { rig, motions, goal, settings, within_reach, well_within, .. } = self;
        if !rig.has_fixed_ranges {
            for (joint, motion) in joints.iter_mut().zip(motions) {
                wrap(motion, joint);
            }
        }
        (memory.side, memory.behind) = (goal.side, goal.behind);
        let remaining = posed(joints)?;
        let tolerance = settings.effective_tolerance();
        let verdict = Verdict { remaining, tolerance, behind: goal.behind, within_reach };
        let outcome = if well_within {
            verdict.outcome_at(JointSet::EMPTY, JointSet::EMPTY)
        } else {
            verdict.outcome(rig, motions, joints)
        };
        Some(outcome)
    }
}
