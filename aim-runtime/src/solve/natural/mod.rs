//! A gaze as people have it: the eye leaps to the target and holds it, head and chest follow by their share, and the eye
//! returns as they arrive.
//!
//! Directions are headings and elevations about the character's up ([`Bearings`]), the joints are *regions* of the body with
//! budgets ([`region`]). A call goes in two steps:
//!
//! 1. The way from the animated gaze to the target, (Δψ, Δε), is shared out ([`allot`]): the regions make g·max(0, E − D)/E of
//!    it, E being its angle, and more where the eye could not do the rest; each by its compliance as far as its room goes,
//!    heading and elevation each for itself. So a target out of reach to the side is followed level.
//! 2. Each region, from the root outward, turns its outermost forward to the direction that it was allotted, measured in the
//!    frame that the corrected joints inside it carry: `R_heading·R_pitch` in closed form ([`body`]). Over time it glides
//!    there; the eye turns exactly to what is left ([`sight`], [`glide`]).
//!
//! Nothing here depends on how often a second it is called. Sources: Freedman and Sparks, *J. Neurophysiol.* 77 (1997) for the
//! zone and the slope of the head's part; Freedman, *Exp. Brain Res.* 190 (2008) for coordination as a whole.

mod allot;
mod body;
mod glide;
mod region;
mod sharing;
mod sight;

use core::f32::consts::PI;

use glam::{Mat3A, Vec3A};

use self::allot::Fit;
use self::body::{Body, Carried, Posture};
use self::glide::{Bounds, Glide, Pair, follow, length, saccade};
use self::region::{Region, regions};
use self::sharing::Sharing;
use self::sight::{Seen, turn_to};
use super::call::Call;
use super::solved::{Solved, Task};
use crate::kinematics::bearing::{Bearings, heading_and_pitch};
use crate::kinematics::chain::{Chain, Upright};
use crate::kinematics::rotation::is_identity;
use crate::limits::reach::Reach;
use crate::limits::{Interval, RangeOfMotion};
use crate::math::Bounded;
use crate::math::trig;
use crate::rig::{ChainRig, Led, Memory, PerJoint, PoseSlices, Support};
use crate::target::behind::Front;
use crate::target::goal::{Course, Goal, Scene};
use crate::{Joint, Role, Settings, math};

/// Angles that differ by less do so by rounding.
const SAME_RAD: f32 = 1e-5;
/// Nearer to its goal than this a region has arrived, radians (0.01°), if it is no faster than to lose as much by the time it
/// rests.
const THERE_RAD: f32 = 2e-4;
/// In a shorter time than this nothing moves, seconds.
const LEAST_S: f32 = 1e-5;

/// Moves `joints` by a natural gaze: by a frame, or with a call's `dt` of `None` at once. `None` where there is nothing to aim.
#[inline(never)]
pub(super) fn aim<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &PoseSlices<'_>,
    motions: &[RangeOfMotion],
    call: &Call<'_>,
    about: Upright,
    joints: &mut [Joint],
    memory: &mut Memory,
) -> Option<Solved<C>> {
    let settings = call.settings;
    let mut body = Body::unseen(rig);
    body.read(pose.joints, settings.effector, about)?;
    let chain = if body.is_rigid {
        None
    } else {
        let chain = Chain::new(rig, pose.joints, settings.effector, about)?;
        body.look_along(chain.animated_gaze())?;
        Some(chain)
    };
    let bearings = Bearings::of_trunk(&body.trunk, about, body.turns_round());
    let scene = Scene {
        space: body.space,
        gaze: body.gaze,
        front: Front::new(&body.frames[body.count - 1], body.gaze),
        rig: rig.description,
        first: body.first,
        motions,
        bearings: Some(&bearings),
        has_two_eyes: pose.other_eye.is_some(),
    };
    let mut before = *memory;
    // Of a snap nothing but the side is remembered: it is to depend on the past as little as it can.
    before.behind &= call.dt.is_some();
    let goal = Goal::new(&scene, call.target_ps.into(), settings, &before)?;
    let gaze = Gaze::new(&body, chain.as_ref(), motions, &goal, settings, &bearings);
    let mut posture = Posture::new(&body, joints);
    let fit = match call.dt {
        Some(dt) => gaze.move_joints(joints, memory, &mut posture, dt)?,
        None => gaze.snap(joints, memory, &mut posture)?,
    };
    joints.copy_from_slice(&posture.joints);
    for joint in 0..body.first {
        posture.correct(&body, joint);
    }
    let task = Task { rig, motions, goal: &goal, space: body.space, settings, within_reach: fit.within_reach };
    let mut solved = task.finish(joints, memory, |_| {
        let gaze = match &chain {
            Some(chain) => chain.gaze(&posture.corrections),
            None => posture.carried.gaze(&body),
        };
        (gaze, posture.corrections)
    })?;
    solved.outcome.body_turn = fit.body_turn;
    solved.outcome.out_of_reach_for = memory.blocked_s;
    Some(solved)
}

/// What moves the joints in a frame.
struct Motion<'a> {
    memory: &'a mut Memory,
    /// What the head's goal did so far; `None` where this is the first frame.
    led: Option<Led>,
    reaches: &'a [Reach],
    dt: f32,
    /// Whether the regions are to come to rest where they are.
    stays: bool,
    /// Whether every region has arrived, and how far they are off together.
    arrived: bool,
    lag: f32,
}

/// Where regions and eye are to turn.
#[derive(Clone, Copy)]
enum Aims<'a> {
    /// Each region's outermost forward in its direction, the leading joint to the point.
    At(&'a [Pair], Vec3A),
    /// The regions nowhere, the leading joint to the point.
    EyeAt(Vec3A),
    /// Back to the animation as far as the ranges let them; the eye keeps to the point.
    Rest(Vec3A),
    /// Nowhere.
    Stay,
}

/// A natural gaze in one call.
struct Gaze<'a, const C: usize> {
    rig: &'a ChainRig<'a, C>,
    body: &'a Body<'a, C>,
    /// The true kinematics of a pose that is not rigid.
    chain: Option<&'a Chain<C>>,
    motions: &'a [RangeOfMotion],
    goal: &'a Goal,
    sharing: Sharing,
    /// After this time out of reach the gaze returns to the animation, seconds.
    patience: f32,
    bearings: &'a Bearings,
    /// From the innermost outward, without the eye.
    regions: PerJoint<Region, C>,
    count: usize,
    /// Whether an eye leads: a joint without inertia. Its ranges of heading and pitch.
    has_eye: bool,
    eye: [Interval; 2],
    /// From where the target's heading and elevation are seen: the effector, moved back along the gaze to beside the joint that
    /// turns the head, which is where it looks from once the head has turned.
    pivot: Vec3A,
}

impl<'a, const C: usize> Gaze<'a, C> {
    #[inline(always)]
    fn new(
        body: &'a Body<'a, C>,
        chain: Option<&'a Chain<C>>,
        motions: &'a [RangeOfMotion],
        goal: &'a Goal,
        settings: &Settings,
        bearings: &'a Bearings,
    ) -> Self {
        let (rig, first) = (body.rig, body.first);
        let has_eye = rig.joints[first].role == Role::Eye && first + 1 < body.count;
        let mut gaze = Self {
            rig,
            body,
            chain,
            motions,
            goal,
            sharing: Sharing::new(&rig.sharing, settings),
            patience: settings.patience.at_least(0.0),
            bearings,
            regions: rig.array(Region::NONE),
            count: 0,
            has_eye,
            eye: [motions[first].heading, motions[first].pitch],
            pivot: body.gaze.origin,
        };
        gaze.count = regions(body, motions, bearings, first + usize::from(has_eye), &mut gaze.regions);
        let turns = body.positions[gaze.regions[gaze.count - 1].outer];
        let direction = math::unit(body.gaze.direction).unwrap_or(Vec3A::X);
        gaze.pivot -= direction * direction.dot(gaze.pivot - turns).at_least(0.0);
        gaze
    }

    /// Moves the joints by a frame of `dt` seconds. `None` where the aim is
    /// undefined.
    #[inline(always)]
    fn move_joints(&self, joints: &mut [Joint], memory: &mut Memory, posture: &mut Posture<C>, dt: f32) -> Option<Fit> {
        let rig = self.rig;
        let mut reaches = rig.array(Reach::REST);
        for (index, joint) in joints.iter_mut().enumerate() {
            let reach = Reach::frame(&self.motions[index], rig.joints[index].rate, joint, dt);
            if index < self.body.first {
                *joint = reach.towards_rest(joint);
                joint.set_destination(None);
            } else if dt > 0.0 {
                *joint = reach.hold(joint);
            }
            reaches[index] = reach;
        }
        if !(dt > LEAST_S) {
            let fit = match self.goal.course {
                Course::Aim if dt > 0.0 => self.settle(self.way()?, joints, posture)?.fit,
                _ => Fit::WITHIN_REACH,
            };
            self.stand(joints, posture);
            return Some(self.of_wanted(fit));
        }
        let led = (memory.support != Support::None).then(|| memory.led());
        if led.is_none() {
            memory.blocked_s = 0.0;
            for joint in &mut *joints {
                joint.velocity = [0.0; 2];
                joint.set_destination(None);
            }
        }
        let gives_up = memory.blocked_s > self.patience;
        let mut motion = Motion { memory, led, reaches: &reaches, dt, stays: false, arrived: true, lag: 0.0 };
        let fit = match self.goal.course {
            Course::Rest => self.return_to_rest(joints, &mut motion, posture)?,
            _ if gives_up && self.goal.behind => self.return_to_rest(joints, &mut motion, posture)?,
            Course::Aim => self.turn_to_goal(joints, gives_up, &mut motion, posture)?,
            Course::Stay => {
                motion.stays = true;
                self.place(Aims::Stay, joints, Some(&mut motion), posture)?;
                Fit::WITHIN_REACH
            }
        };
        let fit = self.of_wanted(fit);
        let is_out_of_reach = self.goal.behind || !fit.within_reach;
        motion.memory.blocked_s = if is_out_of_reach { motion.memory.blocked_s + dt } else { 0.0 };
        if motion.memory.support == Support::None {
            motion.memory.support = Support::Rests;
        }
        let led = motion.led.unwrap_or_default();
        memory.set_led(led);
        Some(fit)
    }

    fn return_to_rest(&self, from: &[Joint], motion: &mut Motion<'_>, posture: &mut Posture<C>) -> Option<Fit> {
        motion.memory.support = Support::Rests;
        self.place(Aims::Rest(self.ahead()?), from, Some(motion), posture)?;
        Some(Fit::WITHIN_REACH)
    }

    fn turn_to_goal(
        &self,
        from: &[Joint],
        gives_up: bool,
        motion: &mut Motion<'_>,
        posture: &mut Posture<C>,
    ) -> Option<Fit> {
        let seen = self.engage(from, motion)?;
        motion.stays = motion.memory.support != Support::Shares;
        // The eye does it alone.
        if let Some(seen) = seen
            && motion.stays
            && seen.is_within()
        {
            let seen = self.place(Aims::EyeAt(self.goal.aimed), from, Some(motion), posture)?;
            self.rest(&seen, motion);
            return Some(Fit::WITHIN_REACH);
        }
        let way = self.way()?;
        let plain = self.allot(&way).filter(|plain| !motion.memory.in_rounds() || !plain.fit.within_reach);
        let led = motion.led;
        let (allotment, rounds) = match plain {
            Some(allotment) if allotment.fit.within_reach => {
                let seen = self.place(allotment.aims(), from, Some(motion), posture)?;
                // What the eye lacks, the regions are on their way to bring.
                if length(seen.left()) < SAME_RAD + motion.lag {
                    motion.memory.set_in_rounds(false);
                    self.rest(&seen, motion);
                    return Some(allotment.fit);
                }
                (motion.led, motion.lag, motion.arrived) = (led, 0.0, true);
                self.settle_in_rounds(&way, from, posture)?
            }
            Some(allotment) => (allotment, 0),
            None => self.settle_in_rounds(&way, from, posture)?,
        };
        motion.memory.set_in_rounds(rounds > 0);
        if gives_up && !allotment.fit.within_reach {
            self.return_to_rest(from, motion, posture)?;
        } else {
            let seen = self.place(allotment.aims(), from, Some(motion), posture)?;
            self.rest(&seen, motion);
        }
        Some(allotment.fit)
    }

    /// Lets the regions rest once they have arrived and the eye's angles are small.
    fn rest(&self, seen: &Seen, motion: &mut Motion<'_>) {
        if self.has_eye && motion.arrived && seen.is_within() && seen.off() < self.sharing.release {
            motion.memory.support = Support::Rests;
        }
    }

    /// Decides whether the regions take part. Returns how an eye that has done without them sees the goal.
    fn engage(&self, joints: &[Joint], motion: &mut Motion<'_>) -> Option<Option<Seen>> {
        let (memory, delay) = (&mut *motion.memory, self.sharing.delay);
        if !self.has_eye {
            memory.support = Support::Shares;
            return Some(None);
        }
        let mut seen = None;
        if matches!(memory.support, Support::None | Support::Rests) {
            let now = self.see(joints, self.goal.aimed)?;
            let engages = memory.support == Support::None || !now.is_within() || now.off() > self.sharing.engage;
            (memory.support, memory.wait_s) = (if engages { Support::Waits } else { Support::Rests }, delay);
            seen = Some(now);
        }
        if memory.support == Support::Waits {
            if memory.wait_s > 0.0 {
                memory.wait_s = memory.wait_s.at_most(delay) - motion.dt;
            } else {
                memory.support = Support::Shares;
            }
        }
        Some(seen)
    }

    /// A point where the animation looks, as far as the goal is.
    fn ahead(&self) -> Option<Vec3A> {
        let gaze = self.body.gaze;
        Some(gaze.origin + math::unit(gaze.direction)? * (self.goal.aimed - gaze.origin).length().at_least(1.0))
    }

    /// Puts the joints where they belong for a goal, whatever the rates. `None` where the aim is undefined.
    fn snap(&self, joints: &[Joint], memory: &mut Memory, posture: &mut Posture<C>) -> Option<Fit> {
        // A target on the animated effector has no direction, whatever the joints could make of it.
        self.body.gaze.angle_to(self.goal.aimed)?;
        let first = self.body.first;
        let mut found = self.rig.array(Joint::REST);
        for (index, (found, joint)) in found.iter_mut().zip(joints).enumerate() {
            let stays = self.goal.course == Course::Stay && index >= first;
            let joint = if stays { Joint::REST.turned_to(joint.heading, joint.pitch) } else { Joint::REST };
            *found = Reach::range(&self.motions[index]).hold(&joint);
        }
        let mut after = *memory;
        after.set_in_rounds(false);
        after.support = Support::None;
        after.set_led(Led::default());
        after.blocked_s = 0.0;
        let mut body_turn = 0.0;
        if self.goal.course == Course::Aim {
            let seen = self.see(&found, self.goal.aimed)?;
            after.support = Support::Rests;
            if self.has_eye && seen.is_within() && seen.off() <= self.sharing.engage {
                found[first] = found[first].turned_to(seen.held[0], seen.held[1]);
            } else {
                body_turn = self.settle(self.way()?, &found, posture)?.fit.body_turn;
                found.copy_from_slice(&posture.joints);
                after.support = Support::Shares;
            }
            self.hold_eye(&mut found);
            let head = &self.regions[self.count - 1];
            after.set_led(Led { goal: sum(&found[head.outer..=head.inner]), ..Led::default() });
        }
        self.stand(&found, posture);
        *memory = after;
        // What a snap has not reached it does not reach.
        Some(self.of_wanted(Fit { within_reach: false, body_turn }))
    }

    /// The fit of the target itself, where what is aimed at is another point.
    fn of_wanted(&self, fit: Fit) -> Fit {
        if self.goal.behind { Fit { body_turn: self.turn_for_behind().unwrap_or(0.0), ..fit } } else { fit }
    }

    /// Leaves the joints like this.
    fn stand(&self, joints: &[Joint], posture: &mut Posture<C>) {
        *posture = Posture::new(self.body, joints);
        for joint in (self.body.first..self.body.count).rev() {
            posture.turn(self.body, joint);
        }
    }

    /// Turns the joints from the root outward: by a frame's motion, or to find out where they belong, without their corrections.
    /// Returns how the leading joint sees its point.
    fn place(
        &self,
        aims: Aims<'_>,
        from: &[Joint],
        mut motion: Option<&mut Motion<'_>>,
        posture: &mut Posture<C>,
    ) -> Option<Seen> {
        posture.carried = Carried::root(self.body);
        posture.joints.copy_from_slice(from);
        let mut goals = self.rig.array([0.0; 2]);
        let mut seen = Seen::NOTHING;
        for (number, region) in self.regions[..self.count].iter().enumerate() {
            let is_head = number + 1 == self.count;
            match aims {
                Aims::At(directions, point) => {
                    let leads = (is_head && !self.has_eye).then_some(point);
                    let wanted = self.goals(region, directions[number], leads, posture, &mut goals)?;
                    seen = Seen { wanted, held: goals[region.outer] };
                }
                Aims::Rest(_) => {
                    for index in region.outer..=region.inner {
                        goals[index] = self.held(index, &Joint::REST, [0.0; 2]);
                    }
                }
                Aims::EyeAt(_) | Aims::Stay => {}
            }
            match &mut motion {
                Some(motion) => {
                    self.glide(region, is_head, &goals, from, &mut posture.joints, motion);
                    for index in (region.outer..=region.inner).rev() {
                        posture.turn(self.body, index);
                    }
                }
                None => {
                    for index in (region.outer..=region.inner).rev() {
                        let [heading, pitch] = goals[index];
                        posture.joints[index] = from[index].turned_to(heading, pitch);
                        posture.carried = posture.carried.outward(self.body, index, trig::halves(pitch, heading));
                    }
                }
            }
        }
        if self.has_eye {
            let first = self.body.first;
            match aims {
                Aims::Stay => self.hold_eye(&mut posture.joints),
                Aims::At(_, point) | Aims::EyeAt(point) | Aims::Rest(point) => {
                    // An eye that supports nothing that has still to return is where the animation has it.
                    let rests =
                        matches!(aims, Aims::Rest(_)) && posture.joints[first + 1..].iter().all(Joint::is_at_rest);
                    seen = if rests {
                        let rest = self.held(first, &Joint::REST, [0.0; 2]);
                        Seen { wanted: rest, held: rest }
                    } else {
                        self.seen(&posture.carried, &posture.joints, point)?
                    };
                    let held = self.held_straight(&seen, &from[first], &posture.carried, point);
                    posture.joints[first] = match &motion {
                        Some(motion) => self.leap(held, &from[first], motion),
                        None => from[first].turned_to(held[0], held[1]),
                    };
                }
            }
            if motion.is_some() {
                posture.turn(self.body, first);
            }
        }
        Some(seen)
    }

    /// Finds the angles that give a region's outermost forward this heading and elevation, or where it `leads` let it look at a
    /// point. Returns what the outermost joint would have to turn.
    #[inline(always)]
    fn goals(
        &self,
        region: &Region,
        direction: Pair,
        leads: Option<Vec3A>,
        posture: &Posture<C>,
        goals: &mut [Pair],
    ) -> Option<Pair> {
        let (body, outer) = (self.body, region.outer);
        let direction = self.bearings.direction(direction);
        // Inner joints make their share; the outermost closes what is left, in the frame that they carry.
        let (joints, mut carried, mut inner) = (&posture.joints, posture.carried, [0.0; 2]);
        if outer < region.inner {
            let local = carried.frame.transpose() * direction;
            let whole = turn_to(region.forward, local);
            for index in (outer + 1..=region.inner).rev() {
                let share = region.share(&self.rig.joints[index]);
                let held = self.held(index, &joints[index], [share[0] * whole[0], share[1] * whole[1]]);
                goals[index] = held;
                inner = [inner[0] + held[0], inner[1] + held[1]];
                carried = carried.outward(body, index, trig::halves(held[1], held[0]));
            }
        }
        let wanted = match leads {
            Some(point) => self.sight(&carried, joints, point)?,
            None if is_identity(body.tilts[outer]) => heading_and_pitch(carried.frame.transpose() * direction),
            None => {
                let forward = body.frames[outer].transpose() * body.forwards[outer];
                turn_to(forward, carried.frame.transpose() * direction)
            }
        };
        let within = [0, 1].map(|axis| region.room[axis].hold(wanted[axis] + inner[axis]) - inner[axis]);
        goals[outer] = self.held(outer, &joints[outer], within);
        Some(wanted)
    }

    /// The angles nearest to these that a joint's range holds; a free heading the shorter way round.
    #[inline(always)]
    fn held(&self, index: usize, joint: &Joint, [heading, pitch]: Pair) -> Pair {
        let motion = &self.motions[index];
        let heading = if motion.heading.is_free() {
            joint.heading + math::wrap_pi(heading - joint.heading)
        } else {
            motion.heading.hold(heading)
        };
        [heading, motion.pitch_at(heading).hold(pitch)]
    }

    /// Moves a region towards its joints' goals by a frame, or to a stop. Its outermost joint remembers speed and
    /// acceleration.
    fn glide(
        &self,
        region: &Region,
        is_head: bool,
        goals: &[Pair],
        from: &[Joint],
        joints: &mut [Joint],
        motion: &mut Motion<'_>,
    ) {
        let (outer, inner, dt) = (region.outer, region.inner, motion.dt);
        let pace = region.pace * motion.led.unwrap_or_default().haste();
        let &Region { rate, approach, acceleration, .. } = region;
        let mut bounds = Bounds { dt, pace, rate, approach, acceleration };
        let (before, speed) = (sum(&from[outer..=inner]), from[outer].velocity);
        let mut glide =
            Glide { speed, acceleration: from[outer].destination().unwrap_or_default(), ..Glide::default() };
        let mut goal = add(&goals[outer..=inner]);
        let mut begins = [0.0; 2];
        let mut led = motion.led.filter(|_| is_head).unwrap_or(Led { goal: before, ..Led::default() });
        if motion.stays {
            // Where an offset of −2·speed/ω dies away without a turn.
            glide.speed = [speed[0] + led.speed[0], speed[1] + led.speed[1]];
            glide.offset = glide.speed.map(|speed| -2.0 * speed / bounds.pace);
            goal = [before[0] - glide.offset[0], before[1] - glide.offset[1]];
            led = Led { goal, ..Led::default() };
        } else if is_head {
            begins = follow(&mut led, before, goal, &mut glide, &bounds);
        } else {
            glide.offset = [before[0] - goal[0], before[1] - goal[1]];
        }
        if is_head && !self.has_eye {
            bounds.pace *= quickness(length(glide.offset));
        }
        let carries = if is_head { led.speed } else { [0.0; 2] };
        let mut next = glide.after(&bounds, begins, carries);
        next.brake(&glide, before, &region.room, [begins, carries], &bounds);
        if next.is_over(bounds.pace) {
            next = Glide::default();
        }
        motion.lag += length(next.offset);
        motion.arrived &= length(next.offset).at_least(length(next.speed) / bounds.pace) < THERE_RAD;

        let total = [goal[0] + next.offset[0], goal[1] + next.offset[1]];
        // Where it is too late to brake, the room ends the movement.
        let held = [0, 1].map(|axis| {
            let [lo, hi] = region.room[axis].ends();
            total[axis].at_least(lo.at_most(before[axis])).at_most(hi.at_least(before[axis]))
        });
        self.distribute(region, goals, [goal, held], from, joints, motion);
        let now = sum(&joints[outer..=inner]);
        for axis in [0, 1] {
            // Range and rate come first.
            if (now[axis] - total[axis]).abs() > SAME_RAD {
                next.speed[axis] = (now[axis] - before[axis]) / dt - carries[axis];
                next.acceleration[axis] = 0.0;
            }
        }
        for joint in &mut joints[outer..=inner] {
            joint.velocity = [0.0; 2];
            joint.set_destination(None);
        }
        joints[outer].velocity = next.speed;
        joints[outer].set_destination(Some(next.acceleration));
        if is_head {
            motion.led = Some(led);
        }
    }

    /// Turns a region's joints so that their angles add up to `total`, where those of their goals add up to `goal`.
    ///
    /// An inner joint makes its share of the sum, and by and by takes on what its goal is off that; the outermost makes the
    /// rest.
    fn distribute(
        &self,
        region: &Region,
        goals: &[Pair],
        [goal, total]: [Pair; 2],
        from: &[Joint],
        joints: &mut [Joint],
        motion: &Motion<'_>,
    ) {
        let before = sum(&from[region.outer..=region.inner]);
        let taken = 1.0 - 1.0 / (1.0 + motion.dt * region.pace);
        let mut rest = total;
        for index in (region.outer..=region.inner).rev() {
            let wanted = if index == region.outer {
                rest
            } else {
                let (share, angles) = (region.share(&self.rig.joints[index]), from[index].angles());
                [0, 1].map(|axis| {
                    let off = angles[axis] - share[axis] * before[axis];
                    let end = if motion.stays { off } else { goals[index][axis] - share[axis] * goal[axis] };
                    share[axis] * total[axis] + off + taken * (end - off)
                })
            };
            joints[index] = motion.reaches[index].hold(&from[index].turned_to(wanted[0], wanted[1]));
            rest = [rest[0] - joints[index].heading, rest[1] - joints[index].pitch];
        }
        // What the outermost has no room for, the others make.
        for (index, joint) in joints.iter_mut().enumerate().take(region.inner + 1).skip(region.outer + 1) {
            if length(rest) <= SAME_RAD {
                break;
            }
            let [heading, pitch] = joint.angles();
            *joint = motion.reaches[index].hold(&joint.turned_to(heading + rest[0], pitch + rest[1]));
            rest = [rest[0] - (joint.heading - heading), rest[1] - (joint.pitch - pitch)];
        }
    }

    /// Turns the eye towards what it sees by a frame. It remembers where that was, and the speed at which it leaps.
    fn leap(&self, held: Pair, joint: &Joint, motion: &Motion<'_>) -> Joint {
        let (dt, reach) = (motion.dt, &motion.reaches[self.body.first]);
        let before = joint.destination().unwrap_or(joint.angles());
        let rate = reach.step / dt;
        let change = [0, 1].map(|axis| held[axis] - before[axis]);
        // Half of its speed is for what the goal does smoothly; what it does faster is made up for by a leap.
        let change = if length(change) <= 0.5 * reach.step { change } else { [0.0; 2] };
        let offset = [0, 1].map(|axis| joint.angles()[axis] + change[axis] - held[axis]);
        let (offset, speed) = saccade(offset, joint.velocity, dt, rate);
        let mut next = reach.hold(&joint.turned_to(held[0] + offset[0], held[1] + offset[1]));
        next.velocity = speed;
        next.set_destination(Some(held));
        next
    }

    /// Where the eye is held: towards what is out of its range straight, so that the gaze goes straight while the head comes and
    /// keeps its elevation where the head does not get there; towards what is far aside level, as straight would lead over the
    /// other way round.
    fn held_straight(&self, seen: &Seen, joint: &Joint, carried: &Carried, point: Vec3A) -> Pair {
        /// From the first of these headings on the eye keeps to the point's elevation, wholly from the second.
        const ASIDE_RAD: [f32; 2] = [50.0 * PI / 180.0, 100.0 * PI / 180.0];
        if seen.is_within() {
            return seen.held;
        }
        let [heading, pitch] = self.straight(seen.wanted);
        let aside = (seen.wanted[0].abs() - ASIDE_RAD[0]) / (ASIDE_RAD[1] - ASIDE_RAD[0]);
        let aside = aside.at_least(0.0).at_most(1.0);
        let level = if aside > 0.0 { self.level_pitch(carried, heading, point - carried.at) } else { pitch };
        self.held(self.body.first, joint, [heading, pitch + aside * (level - pitch)])
    }

    /// The pitch at which the eye, at this heading, looks as high as `to_point` goes: of a·cos p + b·sin p = sin ε, a and b being
    /// how high its forward and its up go.
    fn level_pitch(&self, carried: &Carried, heading: f32, to_point: Vec3A) -> f32 {
        let up = self.bearings.up();
        let (sin, cos) = trig::sin_cos(heading);
        let Mat3A { x_axis: forward, y_axis: left, z_axis: own_up } = carried.frame;
        let (a, b) = ((forward * cos + left * sin).dot(up), own_up.dot(up));
        let sin_elevation = to_point.dot(up) / to_point.length().at_least(f32::MIN_POSITIVE);
        let sin = (sin_elevation / math::sqrt(a * a + b * b).at_least(1e-3)).at_least(-1.0).at_most(1.0);
        trig::atan2(sin, math::sqrt(1.0 - sin * sin)) - trig::atan2(a, b)
    }

    /// As far as the eye gets straight towards what is out of its range.
    fn straight(&self, wanted: Pair) -> Pair {
        let part = [0, 1].into_iter().fold(1.0_f32, |part, axis| {
            let range = self.eye[axis];
            if range.is_point() || range.contains(wanted[axis]) {
                part
            } else {
                part.at_most((range.hold(wanted[axis]) / wanted[axis]).at_least(0.0))
            }
        });
        wanted.map(|angle| part * angle)
    }

    /// Keeps the eye where it is.
    fn hold_eye(&self, joints: &mut [Joint]) {
        if self.has_eye {
            let eye = &mut joints[self.body.first];
            eye.velocity = [0.0; 2];
            eye.set_destination(Some([eye.heading, eye.pitch]));
        }
    }
}

/// How much quicker a head that leads makes up for a small offset, which takes little acceleration: what the animation does in
/// jerks leaves it no lag that could be seen.
fn quickness(offset: f32) -> f32 {
    const SMALL_RAD: f32 = 3.0 * PI / 180.0;
    math::sqrt(SMALL_RAD / offset.at_least(SMALL_RAD / 9.0)).at_least(1.0)
}

/// The sums of headings and of pitches.
fn add(angles: &[Pair]) -> Pair {
    angles.iter().fold([0.0; 2], |[heading, pitch], own| [heading + own[0], pitch + own[1]])
}

/// The sums of the joints' headings and pitches.
fn sum(joints: &[Joint]) -> Pair {
    joints.iter().fold([0.0; 2], |[heading, pitch], joint| [heading + joint.heading, pitch + joint.pitch])
}
