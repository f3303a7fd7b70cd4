//! A strained gaze: near the edge of reach, the free angles barely span both directions of the gaze, so that a small
//! change of the gaze takes a large movement.
//!
//! A jittering target would there make the joints jitter with a much larger amplitude, so they are slowed down as long
//! as the target may jitter. The optimum of the linear model may also be worse than the present angles, so once the
//! target stands still, each step has to reduce the cost.

use glam::Vec3A;

use super::dual::{self, MIN_GAP_PRICE};
use super::{Solver, USUAL_PART};
use crate::Joint;
use crate::kinematics::view::View;
use crate::limits::reach::Reach;
use crate::rig::Memory;

/// Angle to the target below which a strained gaze moves slowly, radians (0.095°).
pub(super) const LOOSE_RAD: f32 = 1.66e-3;
/// Largest speed of a joint in a strained gaze near its target, rad/s.
const EASY_RATE: f32 = 0.12;
/// Movement since the last frame, relative to its distance, below which a target may be standing still (6e-3°).
const STILL_TARGET: f32 = 1e-4;
/// Time without movement after which a target counts as standing still, seconds. It does not jitter, so joints need not
/// be slow.
const STILL_S: f32 = 0.06;
/// Time for which a strain is remembered, seconds.
const STRAIN_S: f32 = 0.5;
/// Largest number of times that the usual part of the way is halved to obtain a gain.
const MOST_CAUTION: u8 = 6;
/// Least gain of a step, relative to the linear model's prediction, for it to be accepted.
const FAIR: f32 = 0.25;
/// Gain of a step, relative to the linear model's prediction, above which a longer step is tried in the next frame.
const GOOD: f32 = 0.75;
/// Rounding error of the residual, radians.
const ROUNDING_RAD: f32 = 4e-7;

impl<const C: usize> Solver<'_, C> {
    /// Lets the remembered strain decay over `dt` and keeps track of the target.
    #[cold]
    pub(super) fn recover(&self, memory: &mut Memory, dt: f32) {
        memory.strain = (memory.strain - dt / STRAIN_S).max(0.0);
        if memory.strain == 0.0 {
            memory.caution = 0;
        }
        self.track_target(memory, dt);
    }

    /// Updates the time for which the target has stood still.
    pub(super) fn track_target(&self, memory: &mut Memory, dt: f32) {
        let moved = self.target - Vec3A::from(memory.target);
        let is_still = moved.dot(moved) < STILL_TARGET * STILL_TARGET * self.target.dot(self.target);
        memory.still_s = if is_still { memory.still_s + dt } else { 0.0 };
        memory.target = self.target.to_array();
    }

    /// Returns `true` if the target has stood still for [`STILL_S`].
    pub(super) fn is_target_still(memory: &Memory) -> bool {
        memory.still_s >= STILL_S
    }

    /// Adjusts the trial of a strained gaze: shortens it to a slow step, or, for a target that stands still, until it
    /// is a gain. Returns `true` if it was made slow.
    #[cold]
    #[inline(never)]
    pub(super) fn limit_strained_step(
        &mut self,
        joints: &[Joint],
        offset: [f32; 2],
        reaches: &[Reach],
        dt: f32,
        memory: &mut Memory,
        view: &mut View,
    ) -> Option<bool> {
        if Self::is_target_still(memory) {
            self.descend(joints, offset, reaches, memory, view)?;
            return Some(false);
        }
        *view = self.ease_in(joints, offset, reaches, dt, *view)?;
        Some(true)
    }

    /// Shortens the trial to a slow step while the gaze is near the target.
    pub(super) fn ease_in(
        &mut self,
        joints: &[Joint],
        offset: [f32; 2],
        reaches: &[Reach],
        dt: f32,
        view: View,
    ) -> Option<View> {
        let near = (offset[0] * offset[0] + offset[1] * offset[1]) / (LOOSE_RAD * LOOSE_RAD);
        let part = EASY_RATE * dt / (self.step(joints) * (1.0 - near * near));
        if !(part < 1.0 && near < 1.0) {
            return Some(view);
        }
        let mut goal = self.rig.array(Joint::REST);
        goal.copy_from_slice(&self.trial);
        self.try_part(joints, &goal, reaches, part);
        self.view(&self.trial)
    }

    /// Shortens the trial until it gains at least [`FAIR`] of what the linear model predicts.
    fn descend(
        &mut self,
        joints: &[Joint],
        offset: [f32; 2],
        reaches: &[Reach],
        memory: &mut Memory,
        view: &mut View,
    ) -> Option<()> {
        // A stored memory may hold any value.
        let before = memory.caution.min(MOST_CAUTION);
        let mut caution = 0;
        let mut part = USUAL_PART;
        loop {
            if caution >= before {
                let [gained, promised] = self.gain(joints, offset, part, memory.lambda, *view);
                let [x, y] = memory.lambda;
                let certain = promised > ROUNDING_RAD * (x.abs() + y.abs());
                if !certain || gained >= FAIR * promised || caution == MOST_CAUTION {
                    memory.caution = caution - u8::from(certain && gained >= GOOD * promised && caution > 0);
                    return Some(());
                }
            }
            while caution < MOST_CAUTION {
                caution += 1;
                part *= 0.5;
                if caution >= before {
                    break;
                }
            }
            let offset = self.linearise(joints, reaches)?;
            self.shift_rest_angles(joints, part);
            let solution =
                dual::solve(&self.model, self.right_hand_side(joints, offset), memory.lambda, self.gap_price);
            if !solution.closed {
                return Some(());
            }
            memory.lambda = solution.lambda;
            *view = self.try_closed(joints, reaches, &solution)?;
            self.refine(joints, offset, reaches, &mut memory.lambda, view);
        }
    }

    /// Returns the trial's actual gain over `joints` and the gain predicted by the linear model, each the reduction of
    /// the displacement cost plus the penalised residual.
    ///
    /// Both are summed from differences, to avoid the cancellation of two large sums.
    fn gain(&self, joints: &[Joint], offset: [f32; 2], part: f32, lambda: [f32; 2], view: View) -> [f32; 2] {
        let (mut gained, mut moved) = (0.0, 0.0);
        for ((angles, joint), trial) in self.model.iter().zip(joints).zip(&*self.trial) {
            let pairs = [(joint.pitch, trial.pitch), (joint.heading, trial.heading)];
            for (angle, (from, to)) in angles.iter().zip(pairs) {
                // Undo `shift_rest_angles`: the rest and weight for the whole way.
                let rest = from + (angle.rest - from) / part;
                let weight = part / angle.ease;
                gained += weight * (from - to) * (0.5 * (from + to) - rest);
                moved += weight * (from - to) * (from - to);
            }
        }
        let there = view.offset();
        for k in 0..2 {
            gained -= lambda[k] * (offset[k] - there[k]);
            gained += 0.5 * MIN_GAP_PRICE * (offset[k] * offset[k] - there[k] * there[k]);
        }
        [gained, moved / part + MIN_GAP_PRICE * (offset[0] * offset[0] + offset[1] * offset[1])]
    }
}
