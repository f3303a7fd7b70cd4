//! The rate-free solve: where the joints come to rest if they have all the time they need. It serves `snap`, and tells
//! a target out of reach from one that only takes longer.
//!
//! Like the ascent it goes from the effector inward, each joint as far as it is needed and its range allows; but each
//! joint goes straight to its best angles by damped least squares on the derived residual and Jacobian, and at the end
//! all joints together take up what is left. Every step is accepted by the true forward kinematics only.

use core::ops::Range as Span;

use glam::{Affine3A, Vec2};

use crate::ascent::{OPPOSITE_RAD, rigid_effector};
use crate::chain::{self, Chain};
use crate::goal::Goal;
use crate::limits::{self, Reach};
use crate::motion::Motion;
use crate::{AimRig, Joint, math, trig};

/// The largest change of an angle in one step, radians: beyond it the linear model says nothing.
const LONGEST_STEP_RAD: f32 = 1.2;
/// Steps of one joint alone, steps of all together, and how often the joints take their turns.
const ALONE_STEPS: usize = 6;
const TOGETHER_STEPS: usize = 24;
const SWEEPS: usize = 4;
/// A sweep that leaves more than this part of the angle makes way for all joints together.
const STALLED: f32 = 0.98;
/// A step that gains less than this part of the angle is the last.
const LITTLE: f32 = 1e-3;
/// A step shorter than this is none, radians.
const STILL_RAD: f32 = 1e-6;
/// How much a step may be shortened before it is given up.
const HALVINGS: usize = 6;
/// The angle that f32 resolves with certainty, radians.
const FINEST_RAD: f32 = 1e-6;

/// Scratch of a solve.
struct Solver<'a, R: AimRig> {
    rig: &'a R,
    chain: &'a Chain<R>,
    goal: &'a Goal,
    reaches: R::Array<Reach>,
    /// The step of each joint, pitch and heading.
    steps: R::Array<[f32; 2]>,
    /// The same joints after a step.
    trial: R::Array<Joint>,
    /// Whether an angle, pitch and heading, can still move in the present step.
    free: R::Array<[bool; 2]>,
    links: R::Array<[f32; 12]>,
    sin_cos: R::Array<[f32; 4]>,
    /// The residual and its Jacobian: 2 + 2 × the number of angles.
    out: R::Array<[f32; 6]>,
    /// The Jacobian's columns, pitch and heading.
    columns: R::Array<[Vec2; 2]>,
    angles: usize,
}

/// Moves `joints` to where they aim best at the goal, from where they are, within their ranges; returns the remaining
/// angle, radians, or `None` where the aim is undefined.
///
/// Stops at a hundredth of `tolerance`. Bounded work; never worse than at the start (once within the ranges).
pub(crate) fn settle<R: AimRig>(
    rig: &R,
    chain: &Chain<R>,
    motions: &[Motion],
    goal: &Goal,
    joints: &mut [Joint],
    tolerance: f32,
) -> Option<f32> {
    let mut solver = Solver::new(rig, chain, motions, goal);
    for (joint, reach) in joints.iter_mut().zip(solver.reaches.as_ref()) {
        *joint = reach.hold(joint);
    }
    let enough = (0.01 * tolerance).max(FINEST_RAD);
    let mut remaining = solver.angle(joints)?;
    if remaining > core::f32::consts::PI - OPPOSITE_RAD {
        remaining = solver.leave_opposite(joints, remaining);
    }
    for _ in 0..SWEEPS {
        let before = remaining;
        for index in chain.first..chain.count {
            remaining = solver.improve(joints, index..index + 1, ALONE_STEPS, enough, remaining);
        }
        if remaining <= enough || remaining > STALLED * before {
            break;
        }
    }
    remaining = solver.improve(joints, chain.first..chain.count, TOGETHER_STEPS, enough, remaining);
    for (joint, motion) in joints.iter_mut().zip(motions) {
        limits::wrap(motion, joint);
    }
    Some(remaining)
}

/// [`settle`] from rest, so that the result does not depend on where the joints are.
///
/// The way that the gradient starts out on may end at a limit although another leads to the target: over the top
/// instead of round the side for a target behind, or with two hinges bent the wrong way. Where the target is nearly
/// reached, or far behind and yet not given up, the joints are also started to either side, up and down, and the best
/// result wins.
pub(crate) fn settle_from_rest<R: AimRig>(
    rig: &R,
    chain: &Chain<R>,
    motions: &[Motion],
    goal: &Goal,
    joints: &mut [Joint],
    tolerance: f32,
) -> Option<f32> {
    const ASIDE_RAD: f32 = 2.0;
    const ALOFT_RAD: f32 = 0.5;
    const NEARLY_RAD: f32 = 0.3;
    joints.fill(Joint::default());
    let mut best = settle(rig, chain, motions, goal, joints, tolerance)?;
    let far_behind = chain.animated_gaze().angle_to(goal.aimed).is_some_and(|off| off > 0.5 * core::f32::consts::PI);
    if best <= tolerance || goal.behind || !(far_behind || best < NEARLY_RAD) {
        return Some(best);
    }
    let mut started = rig.array(Joint::default());
    let started = started.as_mut();
    let aside = ASIDE_RAD * goal.side.sign();
    for [heading, pitch] in [[aside, 0.0], [-aside, 0.0], [0.0, ALOFT_RAD], [0.0, -ALOFT_RAD]] {
        started[chain.first..].fill(Joint { heading, pitch, ..Joint::default() });
        if let Some(angle) = settle(rig, chain, motions, goal, started, tolerance).filter(|&angle| angle < 0.999 * best)
        {
            best = angle;
            joints.copy_from_slice(started);
        }
        if best <= tolerance {
            break;
        }
    }
    Some(best)
}

impl<'a, R: AimRig> Solver<'a, R> {
    fn new(rig: &'a R, chain: &'a Chain<R>, motions: &[Motion], goal: &'a Goal) -> Self {
        let infos = rig.joint_infos();
        let mut reaches = rig.array(Reach::REST);
        for (reach, motion) in reaches.as_mut().iter_mut().zip(motions) {
            *reach = Reach::range(motion);
        }
        // Joints nearer the effector than the one that is aimed have no part in the chain.
        let mut links = rig.array(Affine3A::IDENTITY.to_cols_array());
        for index in chain.first..chain.count {
            links.as_mut()[index] = chain.links.as_ref()[index].to_cols_array();
        }
        Self {
            rig,
            chain,
            goal,
            reaches,
            steps: rig.array([0.0; 2]),
            trial: rig.joints(),
            free: rig.array([false; 2]),
            links,
            sin_cos: rig.array([0.0, 1.0, 0.0, 1.0]),
            out: rig.array([0.0; 6]),
            columns: rig.array([Vec2::ZERO; 2]),
            angles: infos.iter().map(|i| usize::from(i.pitch.is_some()) + usize::from(i.heading.is_some())).sum(),
        }
    }

    fn angle(&self, joints: &[Joint]) -> Option<f32> {
        self.chain.gaze(chain::turns(self.rig, joints).as_ref()).angle_to(self.goal.aimed)
    }

    /// Turns away from exactly behind, where nothing says which way: to the remembered side if a joint can.
    fn leave_opposite(&self, joints: &mut [Joint], remaining: f32) -> f32 {
        const AWAY_RAD: f32 = 0.2;
        let side = AWAY_RAD * self.goal.side.sign();
        for [pitch, heading] in [[0.0, side], [0.0, -side], [AWAY_RAD, 0.0], [-AWAY_RAD, 0.0]] {
            for index in self.chain.first..self.chain.count {
                let joint = joints[index];
                let moved = Joint { pitch: joint.pitch + pitch, heading: joint.heading + heading, ..joint };
                joints[index] = self.reaches.as_ref()[index].hold(&moved);
                match self.angle(joints) {
                    Some(angle) if angle < remaining - 0.25 * AWAY_RAD => return angle,
                    _ => joints[index] = joint,
                }
            }
        }
        remaining
    }

    /// Up to `steps` damped steps of the joints in `moving` together; returns the remaining angle.
    fn improve(
        &mut self,
        joints: &mut [Joint],
        moving: Span<usize>,
        steps: usize,
        enough: f32,
        mut remaining: f32,
    ) -> f32 {
        let mut damping = 1e-6;
        for _ in 0..steps {
            if remaining <= enough {
                break;
            }
            let Some(residual) = self.linearise(joints) else {
                break;
            };
            self.solve(joints, moving.clone(), residual, damping);
            let steps = &self.steps.as_ref()[moving.clone()];
            if steps.as_flattened().iter().all(|step| step.abs() < STILL_RAD) {
                break;
            }
            let Some((angle, halvings)) = self.search(joints, moving.clone(), remaining) else {
                if damping > 1e-2 {
                    break;
                }
                damping = 0.1;
                continue;
            };
            for index in moving.clone() {
                joints[index] = self.trial.as_ref()[index];
            }
            let gained = remaining - angle;
            remaining = angle;
            damping = if halvings == 0 { 1e-6 } else { damping.max(1e-3) };
            if gained < LITTLE * remaining {
                break;
            }
        }
        remaining
    }

    /// The residual (left, up) at these angles; its Jacobian goes to `columns`. `None` where it is not finite.
    fn linearise(&mut self, joints: &[Joint]) -> Option<Vec2> {
        let infos = self.rig.joint_infos();
        for (index, joint) in joints.iter().enumerate().skip(self.chain.first) {
            let ((sin_p, cos_p), (sin_h, cos_h)) = (trig::sin_cos(joint.pitch), trig::sin_cos(joint.heading));
            self.sin_cos.as_mut()[index] = [sin_p, cos_p, sin_h, cos_h];
        }
        let target = math::rigid_inverse(&self.chain.base).transform_point3a(self.seen_target(joints));
        let out = &mut self.out.as_mut().as_flattened_mut()[..2 + 2 * self.angles];
        self.rig.chain_residual_jacobian::<f32>(self.links.as_ref(), &target.to_array(), self.sin_cos.as_ref(), out);
        let residual = Vec2::new(out[0], out[1]);
        let (left, up) = out[2..].split_at(self.angles);
        let mut rows = left.iter().zip(up).map(|(&left, &up)| Vec2::new(left, up));
        for (columns, info) in self.columns.as_mut().iter_mut().zip(infos) {
            for (column, declared) in columns.iter_mut().zip([info.pitch, info.heading]) {
                *column = if declared.is_some() { rows.next()? } else { Vec2::ZERO };
            }
        }
        let finite = self.columns.as_ref().iter().flatten().all(|column| column.is_finite());
        (finite && residual.is_finite()).then_some(residual)
    }

    /// The target that the rigid links are to see.
    fn seen_target(&self, joints: &[Joint]) -> glam::Vec3A {
        let (chain, target) = (self.chain, self.goal.aimed);
        if chain.is_rigid() {
            return target;
        }
        let turns = chain::turns(self.rig, joints);
        let turns = turns.as_ref();
        let mut frames = self.rig.array(Affine3A::IDENTITY);
        chain.rigid_frames(turns, frames.as_mut());
        let rigid = rigid_effector(self.rig, &chain.links.as_ref()[chain.first])
            .turned(turns[chain.first])
            .through(&frames.as_ref()[chain.first]);
        chain.seen_target(target, chain.gaze(turns), rigid)
    }

    /// The damped least-squares step to `steps`: as near to zero residual as the ranges let the linear model come.
    /// Angles that would leave their range stop at its end, and the others make up for them.
    fn solve(&mut self, joints: &[Joint], moving: Span<usize>, residual: Vec2, damping: f32) {
        let infos = self.rig.joint_infos();
        let alone = moving.len() == 1;
        let ease = |index: usize| {
            let comfort = infos[index].comfort;
            if alone || !(comfort > 1e-3 && comfort < 1e3) { 1.0 } else { 1.0 / comfort }
        };
        let (columns, reaches) = (self.columns.as_ref(), self.reaches.as_ref());
        let (steps, free) = (self.steps.as_mut(), self.free.as_mut());
        for index in moving.clone() {
            steps[index] = [0.0; 2];
            free[index] = columns[index].map(|column| column != Vec2::ZERO);
        }
        let mut left_over = -residual;
        // Each round stops at least one angle.
        for _ in 0..=2 * moving.len() {
            let (mut ll, mut lu, mut uu) = (0.0, 0.0, 0.0);
            for index in moving.clone() {
                for (column, _) in columns[index].iter().zip(free[index]).filter(|(_, free)| *free) {
                    let eased = *column * ease(index);
                    ll += eased.x * column.x;
                    lu += eased.x * column.y;
                    uu += eased.y * column.y;
                }
            }
            let mu = damping * (ll + uu) + 1e-12;
            let (ll, uu) = (ll + mu, uu + mu);
            let determinant = ll * uu - lu * lu;
            if !(determinant > 0.0) {
                return;
            }
            let dual =
                Vec2::new(uu * left_over.x - lu * left_over.y, ll * left_over.y - lu * left_over.x) / determinant;
            let mut stopped = false;
            for index in moving.clone() {
                let reach = &reaches[index];
                let angles = [
                    (joints[index].pitch, reach.pitch_at(joints[index].heading)),
                    (joints[index].heading, reach.heading),
                ];
                for (which, (angle, range)) in angles.into_iter().enumerate() {
                    if !free[index][which] {
                        continue;
                    }
                    let column = columns[index][which];
                    let wanted = ease(index) * column.dot(dual);
                    let within = wanted.max(-LONGEST_STEP_RAD).min(LONGEST_STEP_RAD);
                    let within = range.hold(angle + within) - angle;
                    steps[index][which] = within;
                    if (wanted - within).abs() > 1e-6 + 1e-3 * wanted.abs() {
                        free[index][which] = false;
                        left_over -= column * within;
                        stopped = true;
                    }
                }
            }
            if !stopped {
                return;
            }
        }
    }

    /// Shortens the step until it improves the true aim; leaves the joints in `trial`, and returns the new angle and
    /// how often it was halved.
    fn search(&mut self, joints: &[Joint], moving: Span<usize>, remaining: f32) -> Option<(f32, usize)> {
        let mut length = 1.0;
        let mut found = None;
        for halvings in 0..=HALVINGS {
            let angle = self.try_step(joints, moving.clone(), length);
            match (angle.filter(|&angle| angle < remaining), found) {
                (Some(angle), None) => {
                    found = Some((angle, halvings));
                    // Where the linear model holds, a full step leaves little. Under non-uniform scale it may be
                    // twice too long, and would swing from one side to the other.
                    if self.chain.is_rigid() || angle < 0.5 * remaining {
                        return found;
                    }
                }
                (Some(angle), Some((best, _))) if angle < best => return Some((angle, halvings)),
                (_, Some(_)) => {
                    self.try_step(joints, moving, 2.0 * length);
                    return found;
                }
                (None, None) => {}
            }
            length *= 0.5;
        }
        if found.is_some() {
            self.try_step(joints, moving, 2.0 * length);
        }
        found
    }

    /// The joints with this part of the step, left in `trial`; the true angle there.
    fn try_step(&mut self, joints: &[Joint], moving: Span<usize>, length: f32) -> Option<f32> {
        let trial = self.trial.as_mut();
        trial[..joints.len()].copy_from_slice(joints);
        for index in moving {
            let [pitch, heading] = self.steps.as_ref()[index];
            let joint = joints[index];
            let moved =
                Joint { pitch: joint.pitch + length * pitch, heading: joint.heading + length * heading, ..joint };
            trial[index] = self.reaches.as_ref()[index].hold(&moved);
        }
        self.angle(self.trial.as_ref())
    }
}
