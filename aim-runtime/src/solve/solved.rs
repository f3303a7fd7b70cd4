//! [`Task`]: what the joints were to do in a call, and what became of it.

use glam::{Quat, Vec3A};

use super::judge::Verdict;
use crate::kinematics::chain::{Chain, Space};
use crate::limits::RangeOfMotion;
use crate::limits::motion::wrap;
use crate::rig::{ChainRig, Memory, PerJoint};
use crate::target::goal::Goal;
use crate::{Joint, JointSet, Outcome, Settings};

/// What the eyes have to know of how their chain was solved.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub(crate) goal: Goal,
    pub(crate) space: Space,
    /// What the outcome is measured against with the turns of the joints inside the leading one taken back, in solver space, where
    /// that was found on the way.
    pub(crate) seen: Option<Vec3A>,
}

/// The joints that a solve moves, and what it writes: one element for each joint.
pub(crate) struct Moved<'a, const C: usize> {
    pub(crate) joints: &'a mut PerJoint<Joint, C>,
    pub(crate) memory: &'a mut Memory,
    pub(crate) corrections: &'a mut [Quat],
    /// Where it is noted what was found, if anyone asks.
    pub(crate) found: Option<&'a mut Option<Found>>,
}

/// What the joints were to do, and what they are judged by.
pub(crate) struct Task<'a, const C: usize> {
    pub(crate) rig: &'a ChainRig<'a, C>,
    pub(crate) motions: &'a [RangeOfMotion],
    pub(crate) goal: &'a Goal,
    pub(crate) space: Space,
    pub(crate) settings: &'a Settings,
    pub(crate) within_reach: bool,
    /// Whether no angle can be at an end of its range.
    pub(crate) well_within: bool,
}

impl<const C: usize> Task<'_, C> {
    /// [`finish`](Self::finish) by the forward kinematics of a chain, with the corrections that it makes of the joints.
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

    /// Remembers what was seen, and judges the joints as they are now by the angle that their forward kinematics leave.
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
