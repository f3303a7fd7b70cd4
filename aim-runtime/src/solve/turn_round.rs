//! When joints that are blocked by their ranges go the other way round, and how: the one policy of the solvers
//! that search.
//!
//! Round the other way the aim gets worse before it gets better, so joints that turn round remember where they are bound
//! for until they arrive.

use core::f32::consts::PI;

use super::exact::settle::settle;
use super::frame::Frame;
use crate::Joint;

/// How much better the other way round has to aim before the joints turn back, radians.
pub(crate) const TURN_BACK_RAD: f32 = 5.0 * PI / 180.0;
/// The same after [`PATIENCE_S`].
const WORTH_WHILE_RAD: f32 = 0.4 * PI / 180.0;
const PATIENCE_S: f32 = 0.5;

/// How much better the other way round has to aim after this time without a change, radians.
pub(crate) fn turn_back_margin(waited_s: f32) -> f32 {
    TURN_BACK_RAD + (WORTH_WHILE_RAD - TURN_BACK_RAD) * (waited_s / PATIENCE_S).min(1.0)
}

impl<const C: usize> Frame<'_, C> {
    /// Continues a turn-round begun in an earlier frame. Returns whether the goal is within reach; `None` if none is in
    /// progress, or if its end no longer aims better than the present angles by [`WORTH_WHILE_RAD`] / 2.
    pub(crate) fn keep_turning_round(&self, joints: &mut [Joint]) -> Option<bool> {
        let Self { rig, chain, motions, goal, tolerance, .. } = *self;
        let mut bound = rig.array(Joint::REST);
        let mut turning = true;
        for (bound, joint) in bound.iter_mut().zip(&mut *joints).skip(chain.first) {
            match joint.destination() {
                Some([heading, pitch]) => *bound = joint.turned_to(heading, pitch),
                None => turning = false,
            }
            // Set again where it still holds.
            joint.set_destination(None);
        }
        if !turning {
            return None;
        }
        let there = self.angle(&bound)?;
        if there > tolerance && there + 0.5 * WORTH_WHILE_RAD > self.angle(joints)? {
            return None;
        }
        // The goal may have moved on since the joints set out. Searched to the end: many poses aim nearly as well, and joints
        // that are there already would follow a search that ends now at this and now at that one.
        let within_reach = there <= tolerance || settle(rig, chain, motions, goal, &mut bound)? <= tolerance;
        self.turn_round_to(&bound, joints);
        Some(within_reach)
    }

    /// Moves each joint towards `settled` at its rate, and binds it for there until all arrive.
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
