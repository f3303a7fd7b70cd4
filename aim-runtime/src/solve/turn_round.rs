//! The policy for turning round, shared by the solvers that search: when joints blocked by their ranges turn the other
//! way round, and how.
//!
//! On the way round the aim gets worse before it gets better, so the joints remember their destinations until they
//! arrive.

use core::f32::consts::PI;

use super::exact::settle::settle;
use super::frame::Frame;
use crate::Joint;

/// Improvement of the aim, radians, that makes joints turn back the other way round at once.
pub(crate) const TURN_BACK_RAD: f32 = 5.0 * PI / 180.0;
/// Improvement of the aim, radians, that makes joints turn back after [`PATIENCE_S`].
const WORTH_WHILE_RAD: f32 = 0.4 * PI / 180.0;
/// Time over which the required improvement falls to [`WORTH_WHILE_RAD`], seconds.
const PATIENCE_S: f32 = 0.5;

/// Returns the improvement of the aim, radians, required to turn back after `waited_s` seconds without change.
pub(crate) fn turn_back_margin(waited_s: f32) -> f32 {
    TURN_BACK_RAD + (WORTH_WHILE_RAD - TURN_BACK_RAD) * (waited_s / PATIENCE_S).min(1.0)
}

impl<const C: usize> Frame<'_, C> {
    /// Continues a turn-round begun in an earlier frame. Returns whether the goal is within reach; `None` if none is in
    /// progress, or if its destination no longer aims better than the present angles by [`WORTH_WHILE_RAD`] / 2.
    pub(crate) fn keep_turning_round(&self, joints: &mut [Joint]) -> Option<bool> {
        let Self { rig, chain, motions, goal, tolerance, .. } = *self;
        let mut bound = rig.array(Joint::REST);
        let mut turning = true;
        for (bound, joint) in bound.iter_mut().zip(&mut *joints).skip(chain.first) {
            match joint.destination() {
                Some([heading, pitch]) => *bound = joint.turned_to(heading, pitch),
                None => turning = false,
            }
            // `turn_round_to` sets it again if the turn goes on.
            joint.set_destination(None);
        }
        if !turning {
            return None;
        }
        let there = self.angle(&bound)?;
        if there > tolerance && there + 0.5 * WORTH_WHILE_RAD > self.angle(joints)? {
            return None;
        }
        // The goal may have moved since the turn began, so the destination is searched anew, and thoroughly: many poses
        // aim nearly as well, and joints already there would follow a partial search from one such pose to another.
        let within_reach = there <= tolerance || settle(rig, chain, motions, goal, &mut bound)? <= tolerance;
        self.turn_round_to(&bound, joints);
        Some(within_reach)
    }

    /// Moves each joint towards `settled` at its rate, and keeps it as the joints' destination until all have arrived.
    pub(crate) fn turn_round_to(&self, settled: &[Joint], joints: &mut [Joint]) {
        let mut arrived = true;
        for index in self.chain.first..self.chain.count {
            let (start, goal, reach, motion) =
                (&self.start[index], &settled[index], &self.reaches[index], &self.motions[index]);
            joints[index] = reach.towards(start, goal, motion);
            joints[index].set_destination(Some(goal.angles()));
            arrived &= reach.part_of_way(start, goal, motion) >= 1.0;
        }
        if arrived {
            joints.iter_mut().for_each(|joint| joint.set_destination(None));
        }
    }
}
