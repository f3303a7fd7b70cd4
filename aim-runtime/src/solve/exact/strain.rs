//! A strained gaze: near the edge of reach the free angles barely span both directions of the gaze, so that a small change of
//! the gaze takes a large movement.
//!
//! There a trembling target would set the joints trembling many times as far: they are slowed down while it may tremble. The
//! linear model's optimum may also be worse than where the joints are: once the target stands still, each step has to reduce
//! the error.

use glam::Vec3A;

use super::dual::{self, DEAREST};
use super::{Solver, USUAL_PART};
use crate::Joint;
use crate::kinematics::view::View;
use crate::limits::reach::Reach;
use crate::rig::Memory;

/// Nearer to the target than this a strained gaze takes its time, radians (0.095°)…
pub(super) const LOOSE_RAD: f32 = 1.66e-3;
/// … and moves no joint faster than this while it is near, rad/s.
const EASY_RATE: f32 = 0.12;
/// A target that moved by less than this part of its distance since the last frame may stand still (6e-3°)…
const STILL_TARGET: f32 = 1e-4;
/// … and does when it goes on for so long, seconds: it does not tremble, so there is nothing to be slow for.
const CALM_S: f32 = 0.06;
/// For how long a strain is remembered, seconds.
const STRAIN_S: f32 = 0.5;
/// How often the usual part of the way is halved at most where all of it is no gain.
const MOST_CAUTION: u8 = 6;
/// What a step has to gain of what the linear model promised, and what it gains where a longer one would do.
const FAIR: f32 = 0.25;
const GOOD: f32 = 0.75;
/// How well the residual is known, radians.
const ROUNDING_RAD: f32 = 4e-7;

impl<const C: usize> Solver<'_, C> {
    /// What is left of a strain after this time.
    #[cold]
    pub(super) fn recover(&self, memory: &mut Memory, dt: f32) {
        memory.strain = (memory.strain - dt / STRAIN_S).max(0.0);
        if memory.strain == 0.0 {
            memory.caution = 0;
        }
        self.watch(memory, dt);
    }

    /// For how long the target has stood still.
    pub(super) fn watch(&self, memory: &mut Memory, dt: f32) {
        let moved = self.target - Vec3A::from(memory.target);
        let is_still = moved.dot(moved) < STILL_TARGET * STILL_TARGET * self.target.dot(self.target);
        memory.still_s = if is_still { memory.still_s + dt } else { 0.0 };
        memory.target = self.target.to_array();
    }

    /// Whether the target stands still, as far as it has been watched.
    pub(super) fn is_calm(memory: &Memory) -> bool {
        memory.still_s >= CALM_S
    }

    /// The trial of a strained gaze made slow, or such that it is a gain. Returns whether it was made slow.
    #[cold]
    #[inline(never)]
    pub(super) fn take_care(
        &mut self,
        joints: &[Joint],
        offset: [f32; 2],
        reaches: &[Reach],
        dt: f32,
        memory: &mut Memory,
        view: &mut View,
    ) -> Option<bool> {
        if Self::is_calm(memory) {
            self.descend(joints, offset, reaches, memory, view)?;
            return Some(false);
        }
        *view = self.ease_in(joints, offset, reaches, dt, *view)?;
        Some(true)
    }

    /// The trial shortened to a slow step while the gaze is near the target.
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
        self.see(&self.trial)
    }

    /// The trial, or one that goes a smaller part of the way, such that it gains about what the linear model promised.
    fn descend(
        &mut self,
        joints: &[Joint],
        offset: [f32; 2],
        reaches: &[Reach],
        memory: &mut Memory,
        view: &mut View,
    ) -> Option<()> {
        // Whatever was stored.
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
            self.go_part_way(joints, part);
            let solution = dual::solve(&self.model, self.wanted(joints, offset), memory.lambda, self.dearest);
            if !solution.closed {
                return Some(());
            }
            memory.lambda = solution.lambda;
            *view = self.try_closed(joints, reaches, &solution)?;
            self.mend(joints, offset, reaches, &mut memory.lambda, view);
        }
    }

    /// What the trial gains over `joints`, and what the linear model says it gains, of the displacement and of the
    /// residual at its price.
    ///
    /// Both by differences: of two sums too little would be left.
    fn gain(&self, joints: &[Joint], offset: [f32; 2], part: f32, lambda: [f32; 2], view: View) -> [f32; 2] {
        let (mut gained, mut moved) = (0.0, 0.0);
        for ((angles, joint), trial) in self.model.iter().zip(joints).zip(&*self.trial) {
            let pairs = [(joint.pitch, trial.pitch), (joint.heading, trial.heading)];
            for (angle, (from, to)) in angles.iter().zip(pairs) {
                // What the whole way counts from, and its weight.
                let rest = from + (angle.rest - from) / part;
                let weight = part / angle.ease;
                gained += weight * (from - to) * (0.5 * (from + to) - rest);
                moved += weight * (from - to) * (from - to);
            }
        }
        let there = view.offset();
        for k in 0..2 {
            gained -= lambda[k] * (offset[k] - there[k]);
            gained += 0.5 * DEAREST * (offset[k] * offset[k] - there[k] * there[k]);
        }
        [gained, moved / part + DEAREST * (offset[0] * offset[0] + offset[1] * offset[1])]
    }
}
