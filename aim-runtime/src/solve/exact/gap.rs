//! Solves that leave a gap between the gaze and the target, because the target is out of reach, beyond this frame's
//! rates, or because the linear model is too inaccurate; and solves without rate limits.

use super::dual;
use super::settle::Search;
use super::strain::LOOSE_RAD;
use super::{DisplacementCost, ENOUGH_RAD, FINE_RAD, NON_RIGID_REFINEMENTS, ROUNDS, STILL_RAD, Solver};
use crate::kinematics::chain::TOO_NEAR;
use crate::limits::reach::Reach;
use crate::rig::Memory;
use crate::{Joint, math};

/// Largest number of Jacobians for joints without rate limits.
const MOST_ROUNDS: usize = 24;
/// Largest change of an angle in one round, radians. The linear model is not valid further away.
const LONGEST_STEP_RAD: f32 = 1.2;
/// Number of times that a step is halved before it is given up.
const HALVINGS: usize = 5;
/// Time without reaching the target after which a frame takes at most [`BLOCKED_ROUNDS`] Jacobians, seconds.
const BLOCKED_S: f32 = 1.0;
/// Largest number of Jacobians in a frame of joints that have been blocked for [`BLOCKED_S`].
const BLOCKED_ROUNDS: usize = 2;
/// Step below which joints with a remaining gap count as settled, radians (6e-3°).
const SLIGHT_RAD: f32 = 1e-4;
/// Damping of joints while a gap remains, seconds: a movement Δ costs as much as a gap of `½·Δ²·INERTIA_S/dt`, so that
/// joints that would gain next to nothing do not move.
const INERTIA_S: f32 = 3.0 / 60.0;
/// Distance from the optimum below which joints move slowly if a gap remains, radians (0.34°).
const SLOW_RAD: f32 = 0.006;

/// Least distance of the target from the effector of settled joints, relative to its distance in the animation, or to
/// the rig's size if the animation puts the effector on it.
const BESIDE: f32 = 1e-3;
/// Rounding error of a remaining angle, radians.
const ROUNDING_RAD: f32 = 4e-7;

/// The result of a round.
struct Round {
    /// The remaining angle, radians.
    remaining: f32,
    /// `true` if the linear model closed its gap.
    closed: bool,
    /// The largest change of an angle, radians.
    step: f32,
    /// The number of times that the step was halved.
    halvings: usize,
}

impl<const C: usize> Solver<'_, C> {
    /// Finishes a frame in which the linear model has no solution within reach, because rates or ranges prevent one or
    /// because the model is too inaccurate.
    #[cold]
    #[inline(never)]
    pub(super) fn advance_with_a_gap(
        &mut self,
        joints: &mut [Joint],
        reaches: &[Reach],
        dt: f32,
        memory: &mut Memory,
    ) -> Option<f32> {
        if memory.strain == 0.0 {
            // A strained gaze has been watched in `recover` already.
            self.track_target(memory, dt);
        }
        let mut start = self.rig.array(Joint::REST);
        start.copy_from_slice(joints);
        // Approach the goal as far as possible; at that point the linear model may find a solution after all.
        let mut remaining = f32::INFINITY;
        // Joints that have been blocked for long have already been optimised over many frames.
        let rounds = if memory.blocked_s > BLOCKED_S { BLOCKED_ROUNDS } else { ROUNDS };
        let mut follows_limits = false;
        for _ in 0..rounds {
            let ended = self.improve(joints, reaches, &mut memory.lambda, LONGEST_STEP_RAD, follows_limits)?;
            let gained = remaining - ended.remaining;
            remaining = ended.remaining;
            self.stalled = !ended.closed && Search::Quick { below: f32::INFINITY }.is_over(gained, remaining);
            let settled = if ended.closed { STILL_RAD } else { SLIGHT_RAD };
            if ended.step < settled || (ended.closed && remaining <= ENOUGH_RAD) {
                if follows_limits || remaining <= ENOUGH_RAD {
                    break;
                }
                follows_limits = true;
            }
        }
        if Self::is_target_still(memory) {
            return Some(remaining);
        }
        // Damp movements that gain next to nothing: otherwise a jittering target out of reach overhead would keep
        // turning the head.
        let offset = self.linearise(&start, reaches)?;
        let inertia = self.gap_price * INERTIA_S / dt.max(1e-4);
        for (angles, joint) in self.model.iter_mut().zip(&*start) {
            for (angle, now) in angles.iter_mut().zip([joint.pitch, joint.heading]) {
                let weight = 1.0 / angle.ease;
                angle.rest = (weight * angle.rest + inertia * now) / (weight + inertia);
                angle.ease = 1.0 / (weight + inertia);
            }
        }
        let solution = dual::solve(&self.model, self.right_hand_side(&start, offset), memory.lambda, self.gap_price);
        self.try_dual(&start, reaches, &solution);
        let Some(slow) = self.view(&self.trial) else { return Some(remaining) };
        let Some(slow) = self.ease_in(&start, offset, reaches, dt, slow) else { return Some(remaining) };
        let (before, slow) = (length(offset), slow.angle());
        if before.max(remaining) < LOOSE_RAD {
            // The edge of reach is near.
            memory.strain = 1.0;
        }
        // At or near the best angles within reach, move slowly.
        if slow <= before + 0.1 * SLOW_RAD && slow - remaining < SLOW_RAD {
            self.accept(joints);
        }
        Some(remaining)
    }

    /// Moves `joints` to the optimum within `reaches`, in a bounded number of rounds. Returns the remaining angle, or
    /// `None` if the aim is undefined.
    pub(crate) fn settle(&mut self, joints: &mut [Joint], reaches: &[Reach], search: Search) -> Option<f32> {
        self.hold(joints, reaches);
        let mut lambda = [0.0; 2];
        let mut remaining = f32::INFINITY;
        let mut longest = LONGEST_STEP_RAD;
        let mut follows_limits = false;
        for _ in 0..MOST_ROUNDS {
            let ended = self.improve(joints, reaches, &mut lambda, longest, follows_limits)?;
            longest = if ended.halvings == 0 { LONGEST_STEP_RAD } else { 2.0 * ended.step };
            let gained = remaining - ended.remaining;
            remaining = ended.remaining;
            let settled = if ended.closed && remaining <= FINE_RAD { 1e-5 } else { STILL_RAD };
            if ended.step < settled || (!ended.closed && search.is_over(gained, remaining)) {
                if follows_limits || remaining <= ENOUGH_RAD {
                    break;
                }
                follows_limits = true;
            }
        }
        // If the effector ends up on the target, its aim has no direction.
        let view = self.view(joints)?;
        let animated = (self.goal.aim_point - self.chain.animated_gaze().origin).length();
        let usual = if animated > TOO_NEAR { animated } else { 1.0 };
        let distance = view.forward * view.forward + view.left * view.left + view.up * view.up;
        (distance > (BESIDE * usual) * (BESIDE * usual)).then_some(if remaining.is_finite() {
            remaining
        } else {
            view.angle()
        })
    }

    /// Runs one round: takes the optimum of the linear model, corrects it with the same Jacobian, and halves the step
    /// until it is an improvement. With `follows_limits`, pitches [move with the headings](Self::follow_pitch_limits)
    /// that limit them; such a round does nothing if there are none.
    fn improve(
        &mut self,
        joints: &mut [Joint],
        reaches: &[Reach],
        lambda: &mut [f32; 2],
        longest: f32,
        follows_limits: bool,
    ) -> Option<Round> {
        let offset = self.linearise(joints, reaches)?;
        if follows_limits && !self.follow_pitch_limits(joints, reaches) {
            return Some(Round { remaining: length(offset), closed: false, step: 0.0, halvings: HALVINGS });
        }
        for (angles, joint) in self.model.iter_mut().zip(&*joints) {
            for (angle, now) in angles.iter_mut().zip([joint.pitch, joint.heading]) {
                angle.lo = angle.lo.max(now - longest);
                angle.hi = angle.hi.min(now + longest);
            }
        }
        let before = (self.cost(joints), length(offset));
        let mut solution = dual::solve(&self.model, self.right_hand_side(joints, offset), *lambda, self.gap_price);
        self.try_dual(joints, reaches, &solution);
        if !self.chain.is_rigid() {
            for _ in 0..NON_RIGID_REFINEMENTS {
                let Some(view) = self.view(&self.trial) else { break };
                if view.is_within(ENOUGH_RAD) {
                    break;
                }
                self.update_jacobian(joints, offset, view.offset());
                solution =
                    dual::solve(&self.model, self.right_hand_side(joints, offset), solution.lambda, self.gap_price);
                self.try_dual(joints, reaches, &solution);
            }
        }
        *lambda = solution.lambda;
        let mut goal = self.rig.array(Joint::REST);
        goal.copy_from_slice(&self.trial);
        let whole = self.step(joints);
        for halvings in 0..=HALVINGS {
            #[expect(clippy::cast_precision_loss, reason = "a handful")]
            let part = 1.0 / (1_u32 << halvings) as f32;
            self.try_part(joints, &goal, reaches, part);
            let Some(mut view) = self.view(&self.trial) else { continue };
            if solution.closed && halvings == 0 {
                self.refine(joints, offset, reaches, lambda, &mut view);
            }
            let remaining = view.angle();
            if self.is_gain(before, (self.cost(&self.trial), remaining)) {
                let step = self.step(joints);
                self.accept(joints);
                return Some(Round { remaining, closed: solution.closed, step, halvings });
            }
            if part * whole < SLIGHT_RAD {
                break;
            }
        }
        let remaining = self.view(joints)?.angle();
        Some(Round { remaining, closed: solution.closed, step: 0.0, halvings: HALVINGS })
    }

    /// Returns `true` if a round reduced the cost: displacement plus angle times its price. Each argument is a
    /// (displacement, angle) pair. Changes of the angle below its rounding error are ignored.
    fn is_gain(&self, before: (f32, f32), there: (f32, f32)) -> bool {
        let nearer = before.1 - there.1;
        let nearer = if nearer.abs() < ROUNDING_RAD { 0.0 } else { nearer };
        before.0 - there.0 + self.gap_price * nearer > 0.0
    }

    /// Returns the displacement cost of the angles that can move.
    fn cost(&self, joints: &[Joint]) -> f32 {
        let mut cost = 0.0;
        for (index, (angles, joint)) in self.model.iter().zip(joints).enumerate() {
            let mut angles = *angles;
            if self.pitch_limit_slopes[index] != 0.0 {
                // `follow_pitch_limits` has merged the pitch's displacement into the heading's.
                let DisplacementCost { rest, ease } = self.displacement_costs[index][1];
                (angles[1].rest, angles[1].ease) = (rest, ease);
            }
            for (angle, now) in angles.iter().zip([joint.pitch, joint.heading]) {
                let moved = if angle.column == [0.0; 2] && angle.lo == angle.hi { 0.0 } else { now - angle.rest };
                cost += moved * moved / angle.ease;
            }
        }
        0.5 * cost
    }
}

fn length(offset: [f32; 2]) -> f32 {
    math::sqrt(offset[0] * offset[0] + offset[1] * offset[1])
}
