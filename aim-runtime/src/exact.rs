//! The whole chain at once: of all angles within reach that put the gaze on the target, those of the least
//! comfort-weighted displacement.
//!
//! Each round takes the derived residual and Jacobian at the present angles, solves the linear model to its optimum
//! within the reach ([`dual`]), and judges the result by forward kinematics. What the linear model missed is mended with
//! the same Jacobian, which costs a fraction of a new one.

use core::f32::consts::PI;

use glam::Vec3A;

use crate::chain::{self, Chain, Ray, TOO_NEAR};
use crate::dual::{self, Angle, DEAREST, NO_ANGLE};
use crate::goal::Goal;
use crate::joint::{self, Joint, Memory};
use crate::limits::Reach;
use crate::view::{Stretch, View};
use crate::{AimRig, math, trig};

/// An angle to the target that needs no mending, radians (2.6e-3°).
pub(crate) const FINE_RAD: f32 = 4.5e-5;
/// An angle to the target after which no new Jacobian is worth its while, radians (6e-3°).
pub(crate) const ENOUGH_RAD: f32 = 1e-4;
/// How often a Jacobian is used again.
const MENDINGS: usize = 3;
/// How often it is where the pose is not rigid: then it learns from each step.
const BENT_MENDINGS: usize = 8;
/// How many Jacobians a frame takes at most.
const ROUNDS: usize = 4;
/// How many Jacobians joints without rates take at most.
const MOST_ROUNDS: usize = 24;
/// The largest change of an angle in one round, radians: beyond it the linear model says nothing.
const LONGEST_STEP_RAD: f32 = 1.2;
/// Nearer than this to exactly behind, the residual has no length to speak of.
const OPPOSITE_RAD: f32 = 0.03;
/// How much a step may be shortened before it is given up.
const HALVINGS: usize = 5;
/// Nearer to the target than this a strained gaze takes its time, radians (0.095°)…
const LOOSE_RAD: f32 = 1.66e-3;
/// … and moves no joint faster than this while it is near, rad/s.
const EASY_RATE: f32 = 0.12;
/// A target that moved by less than this since the last frame may stand still, radians (6e-3°)…
const STILL_TARGET_RAD: f32 = 1e-4;
/// … and does when it goes on for so long, seconds: it does not tremble, so there is nothing to be slow for.
const CALM_S: f32 = 0.06;
/// For how long a strain is remembered, seconds.
const STRAIN_S: f32 = 0.5;
/// Joints that would all move by less than this stay where they are, radians.
pub(crate) const STILL_RAD: f32 = 1e-6;
/// Displacement of a joint from where it is costs this much of the gap it closes, radians a second and radian: where a
/// gap remains, what gains next to nothing does not move.
const INERTIA_S: f32 = 3.0 / 60.0;

/// The chain, its target, and the linear model of the gaze.
pub(crate) struct Solver<'a, R: AimRig> {
    rig: &'a R,
    chain: &'a Chain<R>,
    goal: &'a Goal,
    /// The target in the last joint's levelled space, for a rigid pose.
    target: Vec3A,
    links: R::Array<[f32; 12]>,
    /// Pitch and heading of each joint.
    model: R::Array<[Angle; 2]>,
    /// The number of declared angles.
    declared: usize,
    /// What the residual is measured along in effector space: forward, left, up.
    axes: [Vec3A; 3],
    trial: R::Array<Joint>,
}

impl<'a, R: AimRig> Solver<'a, R> {
    /// A solver for a goal, with every joint's displacement counted from the animation.
    #[inline]
    pub(crate) fn new(rig: &'a R, chain: &'a Chain<R>, goal: &'a Goal) -> Self {
        let infos = rig.joint_infos();
        let mut least = f32::INFINITY;
        let mut declared = 0;
        for info in infos {
            least = least.min(info.comfort);
            declared += usize::from(info.pitch.is_some()) + usize::from(info.heading.is_some());
        }
        let mut links = rig.array(IDENTITY_LINK);
        let mut model = rig.array([NO_ANGLE; 2]);
        for (index, info) in infos.iter().enumerate().skip(chain.first) {
            links.as_mut()[index] = chain.links.as_ref()[index].to_cols_array();
            // NaN and zero count as the most willing.
            let ease = (least / info.comfort).max(1e-6).min(1.0);
            model.as_mut()[index] = [Angle { ease, ..NO_ANGLE }; 2];
        }
        Self {
            rig,
            chain,
            goal,
            target: chain.base.matrix3.transpose() * goal.aimed,
            links,
            model,
            declared,
            axes: rig.effector().axes(&infos[0].axes),
            trial: rig.joints(),
        }
    }

    /// The solver with one joint's displacement counted from these angles, pitch and heading, at `ease` times its ease.
    pub(crate) fn prefer(&mut self, joint: usize, angles: [f32; 2], ease: f32) {
        for (angle, rest) in self.model.as_mut()[joint].iter_mut().zip(angles) {
            angle.rest = rest;
            angle.ease = (angle.ease * ease).max(1e-6);
        }
    }

    /// Moves `joints` to the optimum within `reaches`, as far as one frame needs it; returns the angle that remains.
    /// `None` where the aim is undefined.
    #[inline]
    pub(crate) fn advance(
        &mut self,
        joints: &mut [Joint],
        reaches: &[Reach],
        dt: f32,
        memory: &mut Memory,
    ) -> Option<f32> {
        self.hold(joints, reaches);
        memory.strain = (memory.strain - dt / STRAIN_S).max(0.0);
        let mut rests = self.rig.array([0.0; 2]);
        for (rest, angles) in rests.as_mut().iter_mut().zip(self.model.as_ref()) {
            *rest = angles.map(|angle| angle.rest);
        }
        for _ in 0..ROUNDS {
            let offset = self.linearise(joints, reaches)?;
            self.halve_the_way(joints, rests.as_ref());
            let solution = dual::solve(self.model.as_ref(), self.wanted(joints, offset), memory.lambda);
            if !solution.closed {
                self.forget_the_way(rests.as_ref());
                return self.advance_with_a_gap(joints, reaches, dt, memory);
            }
            memory.lambda = solution.lambda;
            self.try_dual(joints, reaches, solution.lambda);
            let Some(mut view) = self.see(self.trial.as_ref()) else {
                // The effector would come to be on the target: a shorter step does not.
                self.forget_the_way(rests.as_ref());
                return self.advance_with_a_gap(joints, reaches, dt, memory);
            };
            self.mend(joints, offset, reaches, &mut memory.lambda, &mut view);
            self.forget_the_way(rests.as_ref());
            if solution.strained {
                memory.strain = 1.0;
            }
            let is_still = offset[0] * offset[0] + offset[1] * offset[1] < STILL_TARGET_RAD * STILL_TARGET_RAD;
            memory.still_s = if is_still { memory.still_s + dt } else { 0.0 };
            let eased = memory.strain > 0.0 && memory.still_s < CALM_S;
            if eased {
                view = self.ease_in(joints, offset, reaches, dt, view)?;
            }
            self.accept(joints);
            if eased || view.is_within(ENOUGH_RAD) {
                return Some(view.angle());
            }
        }
        Some(self.see(joints)?.angle())
    }

    /// Counts displacement half from where the joints are: as far as the target leaves them free they go half of the
    /// way to the optimum in a frame. All of it would be too far where the gaze bends much (the model does not know),
    /// and joints would swing from side to side of the optimum for ever.
    #[inline]
    fn halve_the_way(&mut self, joints: &[Joint], rests: &[[f32; 2]]) {
        for ((angles, joint), rests) in self.model.as_mut().iter_mut().zip(joints).zip(rests) {
            for ((angle, now), rest) in angles.iter_mut().zip([joint.pitch, joint.heading]).zip(rests) {
                angle.rest = 0.5 * (rest + now);
                angle.ease *= 0.5;
            }
        }
    }

    /// Takes [`halve_the_way`](Self::halve_the_way) back.
    #[inline]
    fn forget_the_way(&mut self, rests: &[[f32; 2]]) {
        for (angles, rests) in self.model.as_mut().iter_mut().zip(rests) {
            for (angle, rest) in angles.iter_mut().zip(rests) {
                angle.rest = *rest;
                angle.ease *= 2.0;
            }
        }
    }

    /// The trial of a strained gaze, shortened to a slow step while the gaze is near the target. At the edge of what can be reached a target's least tremble would set the
    /// joints trembling many times as far.
    #[cold]
    #[inline(never)]
    fn ease_in(&mut self, joints: &[Joint], offset: [f32; 2], reaches: &[Reach], dt: f32, view: View) -> Option<View> {
        let near = (offset[0] * offset[0] + offset[1] * offset[1]) / (LOOSE_RAD * LOOSE_RAD);
        let part = EASY_RATE * dt / (self.step(joints) * (1.0 - near * near));
        if !(part < 1.0 && near < 1.0) {
            return Some(view);
        }
        let mut goal = self.rig.joints();
        goal.as_mut().copy_from_slice(self.trial.as_ref());
        self.try_part(joints, goal.as_ref(), reaches, part);
        self.see(self.trial.as_ref())
    }

    /// The rest of a frame in which the reach has no solution: rates or ranges end it, or the linear model is too far
    /// off to tell.
    #[cold]
    #[inline(never)]
    fn advance_with_a_gap(
        &mut self,
        joints: &mut [Joint],
        reaches: &[Reach],
        dt: f32,
        memory: &mut Memory,
    ) -> Option<f32> {
        let mut start = self.rig.joints();
        let start = start.as_mut();
        start.copy_from_slice(joints);
        // As near as it gets; there a linear model may find a solution after all.
        for _ in 0..ROUNDS {
            let ended = self.improve(joints, reaches, &mut memory.lambda, LONGEST_STEP_RAD)?;
            if ended.step < STILL_RAD || (ended.closed && ended.remaining <= ENOUGH_RAD) {
                break;
            }
        }
        let remaining = self.see(joints)?.angle();
        // What gains next to nothing does not move: a target out of reach overhead would set the head turning with
        // every tremble.
        self.linearise(start, reaches)?;
        let inertia = DEAREST * INERTIA_S / dt.max(1e-4);
        let mut kept = self.rig.array([NO_ANGLE; 2]);
        kept.as_mut().copy_from_slice(self.model.as_ref());
        for (angles, joint) in self.model.as_mut().iter_mut().zip(&*start) {
            for (angle, now) in angles.iter_mut().zip([joint.pitch, joint.heading]) {
                let weight = 1.0 / angle.ease;
                angle.rest = (weight * angle.rest + inertia * now) / (weight + inertia);
                angle.ease = 1.0 / (weight + inertia);
            }
        }
        let offset = self.offset(start)?;
        let solution = dual::solve(self.model.as_ref(), self.wanted(start, offset), [0.0; 2]);
        self.try_dual(start, reaches, solution.lambda);
        self.model.as_mut().copy_from_slice(kept.as_ref());
        let before = self.see(start)?.angle();
        let slow = self.see(self.trial.as_ref()).map_or(f32::INFINITY, |view| view.angle());
        // As near as the reach gets, or nearly: then slowly.
        if slow <= before + 0.1 * SLOW_RAD && slow - remaining < SLOW_RAD {
            self.accept(joints);
            return Some(slow);
        }
        Some(remaining)
    }

    /// Moves `joints` to the optimum within `reaches`, whatever it takes (within bounds); returns what remains.
    pub(crate) fn settle(&mut self, joints: &mut [Joint], reaches: &[Reach]) -> Option<f32> {
        self.hold(joints, reaches);
        let mut lambda = [0.0; 2];
        let mut remaining = f32::INFINITY;
        let mut longest = LONGEST_STEP_RAD;
        for _ in 0..MOST_ROUNDS {
            let ended = self.improve(joints, reaches, &mut lambda, longest)?;
            longest = if ended.halvings == 0 { LONGEST_STEP_RAD } else { 2.0 * ended.step };
            remaining = ended.remaining;
            let settled = if ended.closed && remaining <= FINE_RAD { 1e-5 } else { STILL_RAD };
            if ended.step < settled {
                break;
            }
        }
        if remaining.is_finite() { Some(remaining) } else { Some(self.see(joints)?.angle()) }
    }

    /// One round: the optimum of the linear model, mended, and shortened until it is an improvement.
    fn improve(
        &mut self,
        joints: &mut [Joint],
        reaches: &[Reach],
        lambda: &mut [f32; 2],
        longest: f32,
    ) -> Option<Round> {
        let offset = self.linearise(joints, reaches)?;
        for (angles, joint) in self.model.as_mut().iter_mut().zip(&*joints) {
            for (angle, now) in angles.iter_mut().zip([joint.pitch, joint.heading]) {
                angle.lo = angle.lo.max(now - longest);
                angle.hi = angle.hi.min(now + longest);
            }
        }
        let before = self.merit(joints, math::sqrt(offset[0] * offset[0] + offset[1] * offset[1]));
        let mut solution = dual::solve(self.model.as_ref(), self.wanted(joints, offset), *lambda);
        self.try_dual(joints, reaches, solution.lambda);
        if !self.chain.is_rigid() {
            for _ in 0..BENT_MENDINGS {
                let Some(view) = self.see(self.trial.as_ref()) else { break };
                if view.is_within(ENOUGH_RAD) {
                    break;
                }
                self.learn(joints, offset, view.offset());
                solution = dual::solve(self.model.as_ref(), self.wanted(joints, offset), solution.lambda);
                self.try_dual(joints, reaches, solution.lambda);
            }
        }
        *lambda = solution.lambda;
        let mut goal = self.rig.joints();
        let goal = goal.as_mut();
        goal.copy_from_slice(self.trial.as_ref());
        for halvings in 0..=HALVINGS {
            #[expect(clippy::cast_precision_loss, reason = "a handful")]
            let part = 1.0 / (1_u32 << halvings) as f32;
            self.try_part(joints, goal, reaches, part);
            let Some(mut view) = self.see(self.trial.as_ref()) else { continue };
            if solution.closed && halvings == 0 {
                self.mend(joints, offset, reaches, lambda, &mut view);
            }
            let remaining = view.angle();
            let there = self.merit(self.trial.as_ref(), remaining);
            if there < before {
                let step = self.step(joints);
                self.accept(joints);
                return Some(Round { remaining, closed: solution.closed, step, halvings });
            }
        }
        let remaining = self.see(joints)?.angle();
        Some(Round { remaining, closed: solution.closed, step: 0.0, halvings: HALVINGS })
    }

    /// What a round tries to lessen: displacement, and the angle at its price.
    fn merit(&self, joints: &[Joint], remaining: f32) -> f32 {
        let mut cost = 0.0;
        for (angles, joint) in self.model.as_ref().iter().zip(joints) {
            for (angle, now) in angles.iter().zip([joint.pitch, joint.heading]) {
                let moved = if angle.column == [0.0; 2] && angle.lo == angle.hi { 0.0 } else { now - angle.rest };
                cost += moved * moved / angle.ease;
            }
        }
        0.5 * cost + DEAREST * remaining
    }

    /// The longest change of an angle from `joints` to the trial.
    fn step(&self, joints: &[Joint]) -> f32 {
        let pairs = self.trial.as_ref().iter().zip(joints);
        pairs.fold(0.0, |step, (a, b)| step.max((a.pitch - b.pitch).abs()).max((a.heading - b.heading).abs()))
    }

    #[inline]
    fn hold(&self, joints: &mut [Joint], reaches: &[Reach]) {
        for index in self.chain.first..self.chain.count {
            joints[index] = reaches[index].hold(&joints[index]);
        }
    }

    /// The joints as they will be: those of the trial, or as they are if that is no movement at all.
    #[inline]
    fn accept(&self, joints: &mut [Joint]) {
        if self.step(joints) >= STILL_RAD {
            joints.copy_from_slice(self.trial.as_ref());
        }
    }

    /// Mends the trial, which came from `joints` and their offset, with the same Jacobian until it is fine.
    #[inline]
    fn mend(&mut self, joints: &[Joint], offset: [f32; 2], reaches: &[Reach], lambda: &mut [f32; 2], view: &mut View) {
        if !view.is_within(FINE_RAD) {
            self.mend_coarse(joints, offset, reaches, lambda, view);
        }
    }

    #[inline(never)]
    fn mend_coarse(
        &mut self,
        joints: &[Joint],
        offset: [f32; 2],
        reaches: &[Reach],
        lambda: &mut [f32; 2],
        view: &mut View,
    ) {
        let mut before = self.rig.joints();
        let before = before.as_mut();
        before.copy_from_slice(joints);
        let mut offset = offset;
        let mendings = if self.chain.is_rigid() { MENDINGS } else { BENT_MENDINGS };
        for _ in 0..mendings {
            if view.is_within(FINE_RAD) {
                return;
            }
            if !self.chain.is_rigid() {
                self.learn(before, offset, view.offset());
            }
            before.copy_from_slice(self.trial.as_ref());
            offset = view.offset();
            let solution = dual::solve(self.model.as_ref(), self.wanted(before, offset), *lambda);
            self.try_dual(before, reaches, solution.lambda);
            match self.see(self.trial.as_ref()) {
                Some(better) if solution.closed && better.angle() < view.angle() => {
                    *view = better;
                    *lambda = solution.lambda;
                }
                _ => {
                    self.trial.as_mut().copy_from_slice(before);
                    return;
                }
            }
        }
    }

    /// Bends the Jacobian so that it says what happened between `joints`, with this offset, and the trial: the least
    /// change that does (Broyden). Under shear and non-uniform scale the kernels' Jacobian is not that of the pose.
    fn learn(&mut self, joints: &[Joint], before: [f32; 2], after: [f32; 2]) {
        let trial = self.trial.as_ref();
        let mut missed = [after[0] - before[0], after[1] - before[1]];
        let mut square = 0.0;
        let changes =
            |joint: usize| [trial[joint].pitch - joints[joint].pitch, trial[joint].heading - joints[joint].heading];
        for (index, angles) in self.model.as_ref().iter().enumerate() {
            for (angle, change) in angles.iter().zip(changes(index)) {
                missed = [missed[0] - angle.column[0] * change, missed[1] - angle.column[1] * change];
                square += change * change;
            }
        }
        if !(square > STILL_RAD * STILL_RAD) {
            return;
        }
        for (index, angles) in self.model.as_mut().iter_mut().enumerate() {
            for (angle, change) in angles.iter_mut().zip(changes(index)) {
                let part = change / square;
                angle.column = [angle.column[0] + missed[0] * part, angle.column[1] + missed[1] * part];
            }
        }
    }

    /// The trial: the model's angles at a dual point, within reach.
    #[inline]
    fn try_dual(&mut self, joints: &[Joint], reaches: &[Reach], lambda: [f32; 2]) {
        let (trial, model) = (self.trial.as_mut(), self.model.as_ref());
        for index in 0..joints.len() {
            let joint = joints[index];
            trial[index] = if index < self.chain.first {
                joint
            } else {
                let [pitch, heading] = model[index].map(|angle| angle.at(lambda));
                reaches[index].hold(&Joint { pitch, heading, ..joint })
            };
        }
    }

    /// The trial: a part of the way from `joints` to `goal`, within reach.
    fn try_part(&mut self, joints: &[Joint], goal: &[Joint], reaches: &[Reach], part: f32) {
        let trial = self.trial.as_mut();
        trial.copy_from_slice(goal);
        if part < 1.0 {
            for index in self.chain.first..self.chain.count {
                let (from, to) = (joints[index], goal[index]);
                trial[index] = reaches[index].hold(&Joint {
                    pitch: from.pitch + part * (to.pitch - from.pitch),
                    heading: from.heading + part * (to.heading - from.heading),
                    ..from
                });
            }
        }
    }

    /// What the model has to come to so that the offset at `joints` is gone.
    #[inline]
    fn wanted(&self, joints: &[Joint], offset: [f32; 2]) -> [f32; 2] {
        let mut wanted = [-offset[0], -offset[1]];
        for (angles, joint) in self.model.as_ref().iter().zip(joints) {
            for (angle, now) in angles.iter().zip([joint.pitch, joint.heading]) {
                wanted = [wanted[0] + angle.column[0] * now, wanted[1] + angle.column[1] * now];
            }
        }
        wanted
    }

    /// Makes the linear model at `joints`; returns the offset of the target there: its angle, left and up.
    #[inline]
    fn linearise(&mut self, joints: &[Joint], reaches: &[Reach]) -> Option<[f32; 2]> {
        let mut sin_cos = self.rig.array([0.0, 1.0, 0.0, 1.0]);
        for index in self.chain.first..self.chain.count {
            sin_cos.as_mut()[index] = trig::doubled(trig::halves(&joints[index]));
        }
        let mut out = self.rig.array([0.0; 6]);
        let out = &mut out.as_mut().as_flattened_mut()[..2 + 2 * self.declared];
        let target = self.target_seen(joints)?;
        let mut kernel = |target: Vec3A| {
            self.rig.chain_residual_jacobian::<f32>(self.links.as_ref(), &target.to_array(), sin_cos.as_ref(), out);
            [out[0], out[1]]
        };
        let mut residual = kernel(target);
        // None at all: straight ahead, or so far behind that the kernel sees nothing.
        let far = residual[0] * residual[0] + residual[1] * residual[1] > FAR_RESIDUAL;
        if far || residual == [0.0; 2] {
            if let Some(aside) = self.aside(joints) {
                residual = kernel(aside);
            }
        }
        let (offset, stretch) = Stretch::of(residual);
        let (left, up) = out[2..].split_at(self.declared);
        let mut row = 0;
        for (index, info) in self.rig.joint_infos().iter().enumerate() {
            let Some(reach) = reaches.get(index) else { break };
            let joint = &joints[index];
            let ranges = [reach.pitch_at(joint.heading), reach.heading];
            let now = [joint.pitch, joint.heading];
            for (which, is_declared) in [info.pitch.is_some(), info.heading.is_some()].into_iter().enumerate() {
                if !is_declared {
                    continue;
                }
                let column = [left[row], up[row]];
                row += 1;
                if index < self.chain.first {
                    continue;
                }
                let angle = &mut self.model.as_mut()[index][which];
                angle.column = match &stretch {
                    Some(stretch) => stretch.derivative(column),
                    None => column,
                };
                (angle.lo, angle.hi) = (ranges[which].lo(), ranges[which].hi());
                if ranges[which].is_free() {
                    angle.rest = now[which];
                    (angle.lo, angle.hi) = (now[which] - PI, now[which] + PI);
                }
            }
        }
        // A target nearly on the effector makes derivatives large, and the first step would leave it. Also catches NaN.
        let largest = out.iter().fold(0.0, |largest: f32, x| largest + x.abs());
        if !(largest < SUSPICIOUS) {
            self.see(joints)?;
        }
        largest.is_finite().then_some(offset)
    }

    /// The offset of the target at `joints`, as the last linear model has it.
    fn offset(&self, joints: &[Joint]) -> Option<[f32; 2]> {
        Some(self.see(joints)?.offset())
    }

    /// The target that the rigid links are to see, in the last joint's levelled space.
    #[inline]
    fn target_seen(&self, joints: &[Joint]) -> Option<Vec3A> {
        if self.chain.is_rigid() { Some(self.target) } else { self.target_seen_bent(joints) }
    }

    #[cold]
    #[inline(never)]
    fn target_seen_bent(&self, joints: &[Joint]) -> Option<Vec3A> {
        let gaze = self.chain.gaze(chain::turns(self.rig, joints).as_ref());
        gaze.angle_to(self.goal.aimed)?;
        let rigid = self.rigid_gaze(joints);
        let seen = self.chain.seen_target(self.goal.aimed, gaze, rigid);
        Some(self.chain.base.matrix3.transpose() * seen)
    }

    /// The effector as the rigid links have it, in solver space.
    fn rigid_gaze(&self, joints: &[Joint]) -> Ray {
        let (infos, links) = (self.rig.joint_infos(), self.chain.links.as_ref());
        let mut ray = crate::ascent::rigid_effector(self.rig, &links[self.chain.first]);
        for index in self.chain.first..self.chain.count {
            ray = ray.turned(joint::turn(&infos[index].axes, &infos[index].planes, trig::halves(&joints[index])));
            ray = match links.get(index + 1) {
                Some(link) => ray.through(link),
                None => ray.through(&self.chain.base),
            };
        }
        ray
    }

    /// The target as the effector sees it; `None` where it has no direction.
    #[inline]
    pub(crate) fn see(&self, joints: &[Joint]) -> Option<View> {
        let mut target = self.target_seen(joints)?;
        let (infos, links) = (self.rig.joint_infos(), self.chain.links.as_ref());
        for index in (self.chain.first..self.chain.count).rev() {
            let turn = joint::turn(&infos[index].axes, &infos[index].planes, trig::halves(&joints[index]));
            target = math::turned(turn.conjugate(), target);
            let link = &links[index];
            target = link.matrix3.transpose() * (target - link.translation);
        }
        let distance = target.dot(target);
        if !(distance > TOO_NEAR * TOO_NEAR && distance.is_finite()) {
            return None;
        }
        let [forward, left, up] = self.axes.map(|axis| target.dot(axis));
        Some(View { forward, left, up })
    }

    /// A target to the side for one exactly behind, where neither residual nor derivative says which way: on the side
    /// that it is remembered on. `None` where it is not behind.
    #[cold]
    #[inline(never)]
    fn aside(&self, joints: &[Joint]) -> Option<Vec3A> {
        let view = self.see(joints)?;
        let angle = view.angle();
        if angle < PI - OPPOSITE_RAD {
            return None;
        }
        let gaze = self.rigid_gaze(joints);
        let seen = self.chain.base.matrix3 * self.target_seen(joints)?;
        let to_target = seen - gaze.origin;
        let forward = math::direction(gaze.direction)?;
        let lateral = to_target - forward * forward.dot(to_target);
        let distance = to_target.length();
        let front = self.chain.base.matrix3 * Vec3A::from(self.rig.joint_infos()[self.chain.count - 1].axes.left);
        let side = front - forward * forward.dot(front);
        // Near the opposite the lateral part is noise; the remembered side is not.
        let lateral = math::direction(lateral * 1e-3 + side * (self.goal.side.sign() * distance))
            .or_else(|| math::direction(forward.any_orthonormal_vector()))?;
        let (sin, cos) = trig::sin_cos(PI - OPPOSITE_RAD);
        let aside = gaze.origin + (forward * cos + lateral * sin) * distance;
        Some(self.chain.base.matrix3.transpose() * aside)
    }
}

/// How a round ended.
struct Round {
    remaining: f32,
    closed: bool,
    /// The longest change of an angle, radians.
    step: f32,
    halvings: usize,
}

/// Nearer to the best than this the joints move slowly where a gap remains, radians (0.34°).
const SLOW_RAD: f32 = 0.006;

/// Derivatives that only a target near the effector, or behind it, has.
const SUSPICIOUS: f32 = 1e3;

/// The square of the residual of a target at [`OPPOSITE_RAD`] from exactly behind.
const FAR_RESIDUAL: f32 = 17_000.0;

/// What stands in for the links of joints that have no part in the chain.
const IDENTITY_LINK: [f32; 12] = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];

/// The reaches of joints that have all the time they need.
pub(crate) fn unhurried<R: AimRig>(rig: &R, motions: &[crate::motion::Motion]) -> R::Array<Reach> {
    let mut reaches = rig.array(Reach::REST);
    for (reach, motion) in reaches.as_mut().iter_mut().zip(motions) {
        *reach = Reach::range(motion);
    }
    reaches
}
