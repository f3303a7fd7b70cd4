//! One call: pose and target in, angles moved within range and rate, and an outcome judged by forward kinematics.

use core::ops::Range as Span;

use glam::Vec3;

use crate::chain::{self, Chain, Level};
use crate::eyes::{Call, Eyes, Solved};
use crate::goal::{Course, Goal};
use crate::joint::{Memory, Support};
use crate::limits::{self, Reach};
use crate::motion::{Motion, motions};
use crate::natural::Gaze;
use crate::pose::Animated;
use crate::settle::{Blocked, Search, search, settle, settle_from_elsewhere, settle_from_rest};
use crate::{
    AimRig, Ascent, Joint, JointInfo, Outcome, Role, Settings, Solver, Status, alone, ascent, exact, math, quick, trig,
};

/// The longest frame, seconds: after a hitch nothing leaps.
pub(crate) const LONGEST_FRAME_S: f32 = 0.1;
/// How much better the other way round has to aim before the joints turn back, radians.
const TURN_BACK_RAD: f32 = 5.0 * core::f32::consts::PI / 180.0;
/// The same for a target that has stood still for [`PATIENCE_S`].
const WORTH_WHILE_RAD: f32 = 0.4 * core::f32::consts::PI / 180.0;
const PATIENCE_S: f32 = 0.5;

/// How near the aim has to be to 1 for the supporting joints to relax, radians.
const AIMED_RAD: f32 = 1.0 * core::f32::consts::PI / 180.0;
/// An ascent that gains less than this part of what its fastest joint could is as good as stuck.
const STUCK: f32 = 0.1;

/// [`AimRig::aim_with`].
#[inline]
pub(crate) fn aim<R: AimRig>(
    rig: &mut R,
    pose_ps: &Animated<'_>,
    target_ps: Vec3,
    dt: f32,
    settings: &Settings,
) -> Outcome {
    if !(dt > 0.0) {
        return aim_with_care(rig, *pose_ps, target_ps, 0.0, settings);
    }
    let dt = dt.min(LONGEST_FRAME_S);
    if is_alone(rig, pose_ps, settings) {
        if let Some(outcome) = alone::aim(rig, pose_ps, target_ps, dt, settings) {
            return outcome;
        }
    }
    if pose_ps.pair.is_none() && solver(rig, settings) == Solver::Exact {
        if let Some(outcome) = quick::aim(rig, pose_ps, target_ps.into(), dt, settings, level(pose_ps)) {
            return outcome;
        }
    }
    aim_with_care(rig, *pose_ps, target_ps, dt, settings)
}

/// [`aim`] for every frame. The pose by value: so where it is not called, it is nowhere in memory.
#[inline(never)]
fn aim_with_care<R: AimRig>(
    rig: &mut R,
    pose_ps: Animated<'_>,
    target_ps: Vec3,
    dt: f32,
    settings: &Settings,
) -> Outcome {
    let pose_ps = &pose_ps;
    if dt > 0.0 && is_alone(rig, pose_ps, settings) {
        if let Some(outcome) = alone::aim_in_haste(rig, pose_ps, target_ps, dt, settings) {
            return outcome;
        }
    }
    let mut joints = rig.joints();
    let motions = motions(rig, pose_ps);
    let motions = motions.as_ref();
    let call = Call { target_ps, dt: Some(dt), settings };
    let outcome = both_eyes(rig, pose_ps, motions, &call, joints.as_mut(), |pose_ps, motions, joints| {
        aim_joints(rig, pose_ps, motions, target_ps, dt, settings, joints)
    });
    let outcome = outcome.unwrap_or_else(|| degenerate(rig, motions));
    if dt > 0.0 && outcome.status != Status::Degenerate {
        rig.set_joints(joints);
    }
    outcome
}

/// [`AimRig::snap_with`].
pub(crate) fn snap<R: AimRig>(rig: &mut R, pose_ps: &Animated<'_>, target_ps: Vec3, settings: &Settings) -> Outcome {
    let mut joints = rig.joints();
    let motions = motions(rig, pose_ps);
    let motions = motions.as_ref();
    let call = Call { target_ps, dt: None, settings };
    let outcome = both_eyes(rig, pose_ps, motions, &call, joints.as_mut(), |pose_ps, motions, joints| {
        snap_joints(rig, pose_ps, motions, target_ps, settings, joints)
    });
    match outcome {
        Some(outcome) => {
            rig.set_joints(joints);
            outcome
        }
        None => degenerate(rig, motions),
    }
}

/// What `solve` makes of the joints, and then of both eyes where the pose has a pair.
fn both_eyes<R: AimRig>(
    rig: &R,
    pose_ps: &Animated<'_>,
    motions: &[Motion],
    call: &Call<'_>,
    joints: &mut [Joint],
    solve: impl Fn(&Animated<'_>, &[Motion], &mut [Joint]) -> Option<Solved>,
) -> Option<Outcome> {
    if let Some(pair) = pose_ps.pair {
        return Eyes::new(rig, pose_ps, pair, motions)?.aim(call, joints, solve);
    }
    if let Some(joint) = joints.first_mut() {
        joint.pair = None;
    }
    Some(solve(pose_ps, motions, joints)?.outcome)
}

/// Moves `joints`, a copy of the rig's; `None` where there is nothing to aim.
fn aim_joints<R: AimRig>(
    rig: &R,
    pose_ps: &Animated<'_>,
    motions: &[Motion],
    target_ps: Vec3,
    dt: f32,
    settings: &Settings,
    joints: &mut [Joint],
) -> Option<Solved> {
    let chain = chain(rig, pose_ps, settings, joints)?;
    let goal = goal(rig, &chain, pose_ps, motions, target_ps, settings, &joints[chain.count - 1])?;
    let frame = Frame::new(rig, &chain, motions, &goal, dt, settings, joints);

    for (joint, reach) in joints.iter_mut().zip(frame.reaches.as_ref()) {
        *joint = reach.hold(joint);
    }
    let mut within_reach = true;
    frame.go_to_rest(joints, 0..chain.first);
    let is_natural = is_natural(rig, &chain, settings);
    match goal.course {
        _ if is_natural => {
            within_reach = Gaze::new(rig, &chain, motions, &goal, settings).aim(joints, frame.reaches.as_ref(), dt)?;
        }
        Course::Rest => frame.go_to_rest(joints, chain.first..chain.count),
        Course::Stay => {}
        Course::Aim => {
            within_reach = match solver(rig, settings) {
                Solver::Ascent => {
                    frame.relax(joints, dt);
                    frame.go_to_goal(joints)?
                }
                Solver::Exact | Solver::Natural => frame.solve(joints, dt)?,
            };
        }
    }
    if dt == 0.0 {
        // Nothing moves, and what is judged are the corrections as they still are: levelled as they were.
        for ((joint, start), old) in joints.iter_mut().zip(frame.start.as_ref()).zip(rig.joints().as_ref()) {
            *joint = *start;
            joint.set_tilt(old.tilt);
        }
    } else if !is_natural {
        joints.iter_mut().for_each(|joint| joint.velocity = [0.0; 2]);
    }
    finish(rig, &chain, motions, &goal, joints, frame.tolerance, within_reach)
}

/// Whether there is a single joint, and nothing that would want more than angles in closed form.
#[inline(always)]
fn is_alone<R: AimRig>(rig: &R, pose_ps: &Animated<'_>, settings: &Settings) -> bool {
    rig.joint_infos().len() == 1 && pose_ps.pair.is_none() && solver(rig, settings) != Solver::Ascent
}

/// The solver that moves the joints.
fn solver<R: AimRig>(rig: &R, settings: &Settings) -> Solver {
    settings.solver.unwrap_or_else(|| match rig.joint_infos().first() {
        Some(JointInfo { role: Role::Eye, .. }) => Solver::Natural,
        _ => Solver::Exact,
    })
}

/// What level headings turn about in this pose.
#[inline]
fn level(pose_ps: &Animated<'_>) -> Level {
    pose_ps.up.and_then(|up| math::direction(up.into())).map_or(Level::Innermost, Level::About)
}

/// Whether joint 0 leads others as an eye does; aimed alone, or left out, it needs no coordination.
fn is_natural<R: AimRig>(rig: &R, chain: &Chain<R>, settings: &Settings) -> bool {
    chain.first == 0 && chain.count > 1 && solver(rig, settings) == Solver::Natural
}

/// The pose made ready; the joints learn how their frames are tilted in it.
fn chain<R: AimRig>(rig: &R, pose_ps: &Animated<'_>, settings: &Settings, joints: &mut [Joint]) -> Option<Chain<R>> {
    // The paper's method knows bones only.
    let level = if solver(rig, settings) == Solver::Ascent { Level::Off } else { level(pose_ps) };
    let chain = Chain::new(rig, pose_ps.joints, settings.effector, level)?;
    for (joint, tilt) in joints.iter_mut().zip(chain.tilts.as_ref()) {
        if joint.tilt != *tilt {
            joint.set_tilt(*tilt);
        }
    }
    Some(chain)
}

/// What the steps of one frame share.
struct Frame<'a, R: AimRig> {
    rig: &'a R,
    chain: &'a Chain<R>,
    /// The ranges of motion.
    motions: &'a [Motion],
    goal: &'a Goal,
    ascent: &'a Ascent,
    tolerance: f32,
    /// How far each joint can go in this frame.
    reaches: R::Array<Reach>,
    /// The joints as the frame found them.
    start: R::Array<Joint>,
}

impl<'a, R: AimRig> Frame<'a, R> {
    fn new(
        rig: &'a R,
        chain: &'a Chain<R>,
        motions: &'a [Motion],
        goal: &'a Goal,
        dt: f32,
        settings: &'a Settings,
        joints: &[Joint],
    ) -> Self {
        let mut start = rig.array(Joint::default());
        start.as_mut().copy_from_slice(joints);
        let mut reaches = rig.array(Reach::REST);
        let motion = motions.iter().zip(rig.joint_infos());
        for ((reach, (motion, info)), joint) in reaches.as_mut().iter_mut().zip(motion).zip(joints) {
            *reach = Reach::frame(motion, info.rate, joint, dt);
        }
        let tolerance = settings.effective_tolerance();
        Self { rig, chain, motions, goal, ascent: &settings.ascent, tolerance, reaches, start }
    }

    /// The angle between the gaze and the goal, radians; `None` where it is undefined.
    fn angle(&self, joints: &[Joint]) -> Option<f32> {
        self.chain.gaze(chain::turns(self.rig, joints).as_ref()).angle_to(self.goal.aimed)
    }

    fn go_to_rest(&self, joints: &mut [Joint], which: Span<usize>) {
        for index in which {
            joints[index] = self.reaches.as_ref()[index].towards_rest(&self.start.as_ref()[index]);
            joints[index].bound_for = None;
        }
    }

    fn relax(&self, joints: &mut [Joint], dt: f32) {
        let Some(keep) = self.ascent.relax else { return };
        if self.angle(joints).is_some_and(|angle| angle <= self.tolerance.max(AIMED_RAD)) {
            ascent::relax(self.chain.first, keep, dt, joints, self.reaches.as_ref());
        }
    }

    /// Moves all joints at once to the optimum within their reach, or round the other way where their ranges block the
    /// one they are on. Returns whether the goal is within reach.
    fn solve(&self, joints: &mut [Joint], dt: f32) -> Option<bool> {
        let Self { rig, chain, motions, goal, tolerance, .. } = *self;
        let mut advanced = rig.joints();
        let advanced = advanced.as_mut();
        advanced.copy_from_slice(joints);
        let mut memory = joints[chain.count - 1].memory;
        let mut solver = exact::Solver::new(rig, chain, goal);
        let remaining = match solver.advance(advanced, self.reaches.as_ref(), dt, &mut memory) {
            Some(remaining) => remaining,
            // On the way it may be undefined, and yet be reached from elsewhere.
            None => self.angle(joints).map(|_| f32::INFINITY)?,
        };
        let was_reached = memory.blocked_s == 0.0;
        memory.blocked_s = if remaining <= tolerance { 0.0 } else { memory.blocked_s + dt };
        joints[chain.count - 1].memory = memory;
        advanced[chain.count - 1].memory = memory;
        if remaining <= tolerance {
            joints.copy_from_slice(advanced);
            joints.iter_mut().for_each(|joint| joint.bound_for = None);
            return Some(true);
        }
        if let Some(within_reach) = self.keep_turning_round(joints) {
            return Some(within_reach);
        }
        // Where would the joints get from here, had they the time; and where from elsewhere?
        let mut settled = rig.joints();
        let settled = settled.as_mut();
        settled.copy_from_slice(advanced);
        let stays = advanced.iter().zip(self.start.as_ref()).all(|(new, old)| new.is_near(old, 1e-4));
        let pace = advanced.iter().zip(self.start.as_ref()).zip(self.reaches.as_ref());
        let in_haste = pace.into_iter().any(|((new, old), reach)| !new.is_near(old, 0.99 * reach.step));
        let from_here = if solver.is_spent() && !stays && !in_haste {
            // Nothing but the ranges holds them up.
            remaining
        } else {
            let quick = Search::Quick { below: f32::INFINITY };
            search(rig, chain, motions, goal, settled, quick).unwrap_or(f32::INFINITY)
        };
        joints.copy_from_slice(advanced);
        if from_here <= tolerance {
            if stays {
                self.turn_round_to(settled, joints);
            }
            return Some(true);
        }
        // For a target that stands still, joints turn back for less.
        let margin = TURN_BACK_RAD + (WORTH_WHILE_RAD - TURN_BACK_RAD) * (memory.still_s / PATIENCE_S).min(1.0);
        let below = from_here - margin;
        let blocked = Blocked { tolerance, below, is_news: was_reached };
        let from_elsewhere =
            settle_from_elsewhere(rig, chain, motions, goal, settled, blocked, &mut memory).unwrap_or(f32::INFINITY);
        joints[chain.count - 1].memory = memory;
        let within_reach = from_elsewhere <= tolerance;
        if within_reach || from_elsewhere < below {
            self.turn_round_to(settled, joints);
        }
        Some(within_reach)
    }

    /// Goes on turning round, or ascends and goes on where the ascent ends short of the goal. Returns whether the goal
    /// is within reach.
    fn go_to_goal(&self, joints: &mut [Joint]) -> Option<bool> {
        if let Some(within_reach) = self.keep_turning_round(joints) {
            return Some(within_reach);
        }
        let Self { rig, chain, motions, goal, tolerance, .. } = *self;
        let before = self.angle(joints)?;
        let remaining = ascent::ascend(rig, chain, goal, joints, self.reaches.as_ref(), tolerance, self.ascent)?;
        if remaining <= tolerance {
            return Some(true);
        }
        // Where would the joints get from here, had they the time; and where from rest?
        let mut settled = rig.joints();
        let settled = settled.as_mut();
        settled.copy_from_slice(joints);
        let from_here = settle(rig, chain, motions, goal, settled).unwrap_or(f32::INFINITY);
        if from_here <= tolerance {
            if self.ascent.finish {
                self.finish_at(settled, joints, before, remaining);
            }
            return Some(true);
        }
        let from_rest = settle_from_rest(rig, chain, motions, goal, settled, tolerance).unwrap_or(f32::INFINITY);
        let within_reach = from_rest <= tolerance;
        let turns_back = self.ascent.turn_back && from_rest + TURN_BACK_RAD < from_here;
        if turns_back || (self.ascent.finish && within_reach) {
            self.turn_round_to(settled, joints);
        }
        Some(within_reach)
    }

    /// Goes on to where the joints are bound for; returns whether the goal is within reach. `None` where they are bound
    /// for nowhere, or where going there has lost its point.
    fn keep_turning_round(&self, joints: &mut [Joint]) -> Option<bool> {
        let Self { rig, chain, motions, goal, tolerance, .. } = *self;
        let mut bound = rig.joints();
        let bound = bound.as_mut();
        let mut turning = self.ascent.finish || self.ascent.turn_back;
        for (bound, joint) in bound.iter_mut().zip(&mut *joints).skip(chain.first) {
            // Set again where it still holds.
            match joint.bound_for.take() {
                Some([heading, pitch]) => *bound = Joint { heading, pitch, ..*joint },
                None => turning = false,
            }
        }
        if !turning {
            return None;
        }
        let there = self.angle(bound)?;
        if there > tolerance && there + 0.5 * WORTH_WHILE_RAD > self.angle(joints)? {
            return None;
        }
        // The goal may have moved on since the joints set out.
        let within_reach = there <= tolerance
            || search(rig, chain, motions, goal, bound, Search::Quick { below: f32::INFINITY })? <= tolerance;
        self.turn_round_to(bound, joints);
        Some(within_reach)
    }

    /// The end of an ascent that stopped short of a goal within reach: all the way if this frame is enough for it, or
    /// towards it where the ascent is stuck.
    fn finish_at(&self, settled: &mut [Joint], joints: &mut [Joint], before: f32, remaining: f32) {
        let (reaches, start, motions) = (self.reaches.as_ref(), self.start.as_ref(), self.motions);
        let chain = self.chain.first..self.chain.count;
        let part = chain
            .clone()
            .map(|index| reaches[index].part_of_way(&start[index], &settled[index], &motions[index]))
            .fold(1.0, f32::min);
        let stuck = self.is_stuck(before, remaining);
        if part < 1.0 && !stuck {
            return;
        }
        let mut straight = self.rig.array(Joint::default());
        let straight = straight.as_mut();
        for index in chain.clone() {
            // The same part of its way for each, so that what makes up for each other moves together.
            straight[index] = reaches[index].part_way(&start[index], &settled[index], &motions[index], part);
        }
        if self.angle(straight).is_some_and(|angle| angle < remaining) {
            joints[chain.clone()].copy_from_slice(&straight[chain]);
        } else if stuck {
            self.turn_round_to(settled, joints);
        }
    }

    /// Whether the ascent gained next to nothing of what it could.
    fn is_stuck(&self, before: f32, remaining: f32) -> bool {
        let reaches = &self.reaches.as_ref()[self.chain.first..];
        let fastest = reaches.iter().fold(0.0_f32, |step, reach| step.max(reach.step));
        before - remaining < STUCK * fastest.min(before)
    }

    /// Each joint towards `settled` at its rate, and bound for there until it arrives: round the other way it has to get
    /// worse before it gets better, and an ascent would go back.
    fn turn_round_to(&self, settled: &[Joint], joints: &mut [Joint]) {
        let (reaches, start, motions) = (self.reaches.as_ref(), self.start.as_ref(), self.motions);
        let mut arrived = true;
        for index in self.chain.first..self.chain.count {
            let goal = &settled[index];
            joints[index] = reaches[index].towards(&start[index], goal, &motions[index]);
            joints[index].bound_for = Some([goal.heading, goal.pitch]);
            arrived &= reaches[index].part_of_way(&start[index], goal, &motions[index]) >= 1.0;
        }
        if arrived {
            for joint in joints {
                joint.bound_for = None;
            }
        }
    }
}

fn snap_joints<R: AimRig>(
    rig: &R,
    pose_ps: &Animated<'_>,
    motions: &[Motion],
    target_ps: Vec3,
    settings: &Settings,
    joints: &mut [Joint],
) -> Option<Solved> {
    let chain = chain(rig, pose_ps, settings, joints)?;
    let tolerance = settings.effective_tolerance();
    // Nothing but the side is remembered: the result is to depend on the past as little as it can.
    let before = Joint { behind: false, ..joints[chain.count - 1] };
    let goal = goal(rig, &chain, pose_ps, motions, target_ps, settings, &before)?;
    for joint in &mut *joints {
        (joint.velocity, joint.memory.support) = ([0.0; 2], Support::Rests);
    }

    let mut from_here = rig.joints();
    let from_here = from_here.as_mut();
    from_here.copy_from_slice(joints);
    for joint in from_here[..chain.first].iter_mut().chain(&mut *joints) {
        (joint.heading, joint.pitch, joint.bound_for) = (0.0, 0.0, None);
    }
    if goal.course == Course::Stay {
        joints.copy_from_slice(from_here);
    }
    for (joint, motion) in joints.iter_mut().zip(motions) {
        *joint = Reach::range(motion).hold(joint);
    }
    let snapped = is_natural(rig, &chain, settings)
        && Gaze::new(rig, &chain, motions, &goal, settings).snap(joints) == Some(true);
    if goal.course == Course::Aim && !snapped {
        // The aim may be undefined at rest and yet defined here, or the reverse.
        let from_rest = settle_from_rest(rig, &chain, motions, &goal, joints, tolerance).unwrap_or(f32::INFINITY);
        if from_rest > tolerance {
            let from_here_rad = settle(rig, &chain, motions, &goal, from_here);
            if from_here_rad.is_some_and(|from_here_rad| from_here_rad < 0.999 * from_rest) {
                joints.copy_from_slice(from_here);
            }
        }
        // Joints that have no part rest, as far as their ranges let them.
        for (joint, motion) in joints[..chain.first].iter_mut().zip(motions) {
            *joint = Reach::range(motion).hold(joint);
        }
    }
    finish(rig, &chain, motions, &goal, joints, tolerance, false)
}

/// Counts for how long a target has been out of reach.
pub(crate) fn wait(memory: &mut Memory, reached: bool, dt: f32) {
    memory.blocked_s = if reached { 0.0 } else { (memory.blocked_s + dt).min(PATIENCE_S) };
}

/// Whether to turn round from where the joints would come as near as `here` to where they would come as near as `there`,
/// radians. Joints that have been blocked for long turn back for less, but only if that has been better all the time: a
/// target that trembles behind would set them turning.
pub(crate) fn is_worth_turning_back(memory: &mut Memory, there: f32, here: f32) -> bool {
    let better = here - there;
    if !(better > WORTH_WHILE_RAD) {
        memory.blocked_s = 0.0;
        return false;
    }
    better > TURN_BACK_RAD + (WORTH_WHILE_RAD - TURN_BACK_RAD) * (memory.blocked_s / PATIENCE_S)
}

/// What to turn to. At weight 0 that is the animation, whatever the target.
fn goal<R: AimRig>(
    rig: &R,
    chain: &Chain<R>,
    pose_ps: &Animated<'_>,
    motions: &[Motion],
    target_ps: Vec3,
    settings: &Settings,
    before: &Joint,
) -> Option<Goal> {
    let weight = settings.effective_weight();
    let goal = if weight == 0.0 {
        Goal::animation(chain, before)
    } else {
        Goal::new(rig, chain, motions, chain.to_solver(target_ps.into())?, settings, before)
    };
    Some(if pose_ps.pair.is_some() && weight < 1.0 { goal.receding(chain, weight) } else { goal })
}

/// Remembers what was seen, and judges the joints as they are now.
fn finish<R: AimRig>(
    rig: &R,
    chain: &Chain<R>,
    motions: &[Motion],
    goal: &Goal,
    joints: &mut [Joint],
    tolerance: f32,
    within_reach: bool,
) -> Option<Solved> {
    let infos = rig.joint_infos();
    for ((joint, motion), info) in joints.iter_mut().zip(motions).zip(infos) {
        limits::wrap(motion, joint);
        joint.halve(info);
    }
    let innermost = &mut joints[chain.count - 1];
    (innermost.side, innermost.behind) = (goal.side, goal.behind);
    let remaining = chain.gaze(chain::turns(rig, joints).as_ref()).angle_to(goal.wanted)?;
    let status = if remaining <= tolerance {
        Status::Reached
    } else if goal.behind {
        Status::Behind
    } else if within_reach {
        Status::RateLimited
    } else {
        Status::AtLimit
    };
    let (at_limit, recovering) = limits::limits_met(infos, motions, joints);
    let (_, aim) = trig::sin_cos(remaining);
    let outcome = Outcome { aim, remaining, pair_remaining: None, status, at_limit, recovering };
    let [wanted_ps, aimed_ps] = [goal.wanted, goal.aimed].map(|point| chain.to_pose(point));
    Some(Solved { outcome, wanted_ps, aimed_ps, course: goal.course, behind: goal.behind })
}

/// The outcome where there is nothing to aim: the angles hold.
fn degenerate<R: AimRig>(rig: &R, motions: &[Motion]) -> Outcome {
    let (at_limit, recovering) = limits::limits_met(rig.joint_infos(), motions, rig.joints().as_ref());
    let (aim, remaining) = (0.0, math::UNDEFINED_RAD);
    Outcome { aim, remaining, pair_remaining: None, status: Status::Degenerate, at_limit, recovering }
}
