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
//!    frame that the corrected joints inside it carry: `R_heading·R_pitch` in closed form ([`turn_to`]). Over time it glides
//!    there; the eye turns exactly to what is left ([`glide`]).
//!
//! Nothing here depends on how often a second it is called. Sources: Freedman and Sparks, *J. Neurophysiol.* 77 (1997) for the
//! zone and the slope of the head's part; Freedman, *Exp. Brain Res.* 190 (2008) for coordination as a whole.

mod allot;
mod glide;
mod region;
mod sharing;

use core::f32::consts::{FRAC_PI_2, PI};

use glam::{Affine3A, Mat3A, Vec3A};

use self::glide::{Bounds, Glide, Pair, follow, length, saccade};
use self::region::{Region, regions};
use self::sharing::Sharing;
use crate::kinematics::bearing::Bearings;
use crate::kinematics::chain::{Chain, Ray};
use crate::kinematics::rotation::joint_turn;
use crate::limits::reach::Reach;
use crate::limits::{Angles, Interval, RangeOfMotion};
use crate::math::trig;
use crate::rig::{ChainRig, Led, Memory, PerJoint, Support};
use crate::solve::exact::Solver;
use crate::solve::exact::settle::Search;
use crate::solve::eyes::view;
use crate::target::goal::{Course, Goal};
use crate::{Axes, Joint, Role, Settings, math};

/// Angles that differ by less do so by rounding.
const SAME_RAD: f32 = 1e-5;
/// Nearer to its goal than this a region has arrived, radians (0.01°), if it is no faster than to lose as much by the time it
/// rests.
const THERE_RAD: f32 = 2e-4;
/// In a shorter time than this nothing moves, seconds.
const LEAST_S: f32 = 1e-5;
/// How often the closed form of an effector that is not at its joint is repeated, at most.
const SIGHT_ROUNDS: usize = 24;

/// How the leading joint sees a point.
#[derive(Clone, Copy, Debug)]
struct Seen {
    /// The heading and the pitch that look there, and the nearest that the joint's range holds.
    wanted: Pair,
    held: Pair,
}

impl Seen {
    /// What the range does not hold.
    fn left(&self) -> Pair {
        [math::wrap_pi(self.wanted[0] - self.held[0]), self.wanted[1] - self.held[1]]
    }

    fn is_nothing(left: Pair) -> bool {
        length(left) < SAME_RAD
    }

    fn is_within(&self) -> bool {
        Self::is_nothing(self.left())
    }

    /// How far the point is off the middle of the range.
    fn off(&self) -> f32 {
        let [heading, pitch] = self.wanted;
        let cos = trig::sin_cos(heading).1 * trig::sin_cos(pitch).1;
        trig::atan2(math::sqrt(1.0 - cos * cos), cos)
    }
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

/// A natural gaze in one call.
pub(crate) struct Gaze<'a, const C: usize> {
    rig: &'a ChainRig<'a, C>,
    chain: &'a Chain<C>,
    motions: &'a [RangeOfMotion],
    goal: &'a Goal,
    sharing: Sharing,
    bearings: Bearings,
    /// From the innermost outward, without the eye.
    regions: PerJoint<Region, C>,
    count: usize,
    /// Whether an eye leads: a joint without inertia. Its ranges of heading and pitch.
    has_eye: bool,
    eye: [Interval; 2],
    /// The effector in the leading joint's frame.
    effector: Ray,
    /// From where the target's heading and elevation are seen: the effector, moved back along the gaze to beside the joint that
    /// turns the head, which is where it looks from once the head has turned.
    pivot: Vec3A,
}

impl<'a, const C: usize> Gaze<'a, C> {
    pub(crate) fn new(
        rig: &'a ChainRig<'a, C>,
        chain: &'a Chain<C>,
        motions: &'a [RangeOfMotion],
        goal: &'a Goal,
        settings: &Settings,
        bearings: Bearings,
    ) -> Self {
        let first = chain.first;
        let has_eye = rig.joints[first].role == Role::Eye && first + 1 < chain.count;
        let gaze = chain.animated_gaze();
        let direction = math::unit(gaze.direction).unwrap_or(Vec3A::X);
        let origin = if rig.has_origin && first == 0 { chain.links[0].translation } else { Vec3A::ZERO };
        let effector = Ray { origin, direction: chain.upright[first].transpose() * direction };

        let (regions, count) = regions(rig, chain, motions, &bearings, first + usize::from(has_eye));
        let outward = |origin, index: usize| origin + chain.upright[index] * chain.links[index].translation;
        let turns = (regions[count - 1].outer + 1..chain.count).rev().fold(Vec3A::ZERO, outward);
        let pivot = gaze.origin - direction * direction.dot(gaze.origin - turns).max(0.0);
        Self {
            rig,
            chain,
            motions,
            goal,
            pivot,
            sharing: Sharing::new(&rig.sharing, settings),
            bearings,
            regions,
            count,
            has_eye,
            eye: [motions[first].heading, motions[first].pitch],
            effector,
        }
    }

    /// Moves `joints` by a frame of `dt` seconds; returns whether the goal is within reach. `None` where the aim is undefined.
    pub(crate) fn aim(&self, joints: &mut [Joint], memory: &mut Memory, reaches: &[Reach], dt: f32) -> Option<bool> {
        if !(dt > LEAST_S) {
            let mut settled = self.rig.array(Joint::REST);
            settled.copy_from_slice(joints);
            return match self.goal.course {
                Course::Aim if dt > 0.0 => Some(self.settle(self.way()?, &mut settled)?.within_reach),
                _ => Some(true),
            };
        }
        let led = (memory.support != Support::None).then(|| memory.led());
        if led.is_none() {
            for joint in &mut *joints {
                joint.velocity = [0.0; 2];
                joint.set_destination(None);
            }
        }
        let mut motion = Motion { memory, led, reaches, dt, stays: false, arrived: true, lag: 0.0 };
        let within_reach = match self.goal.course {
            Course::Aim => self.turn_to_goal(joints, &mut motion)?,
            Course::Rest => {
                self.return_to_rest(joints, &mut motion)?;
                true
            }
            Course::Stay => {
                motion.stays = true;
                self.turn_regions_to(&self.rig.array([0.0; 2]), joints, &mut motion);
                self.hold_eye(joints);
                true
            }
        };
        if motion.memory.support == Support::None {
            motion.memory.support = Support::Rests;
        }
        let led = motion.led.unwrap_or_default();
        memory.set_led(led);
        Some(within_reach)
    }

    fn turn_to_goal(&self, joints: &mut [Joint], motion: &mut Motion<'_>) -> Option<bool> {
        let seen = self.engage(joints, motion)?;
        motion.stays = motion.memory.support != Support::Shares;
        // The eye does it alone.
        if let Some(seen) = seen
            && motion.stays
            && seen.is_within()
        {
            self.turn_regions_to(&self.rig.array([0.0; 2]), joints, motion);
            let seen = self.see(joints, self.goal.aimed)?;
            self.leap(&seen, joints, motion);
            self.rest(&seen, motion);
            return Some(true);
        }
        let mut before = self.rig.array(Joint::REST);
        before.copy_from_slice(joints);
        let mut way = self.way()?;
        let plain = self.allot(&mut way).filter(|plain| !motion.memory.in_rounds() || !plain.within_reach);
        if let Some(allotment) = plain {
            let led = motion.led;
            let seen = self.place(&allotment.directions, allotment.point, joints, Some(motion))?;
            // What the eye lacks, the regions are on their way to bring.
            if !allotment.within_reach || length(seen.left()) < SAME_RAD + motion.lag {
                motion.memory.set_in_rounds(false);
                self.rest(&seen, motion);
                return Some(allotment.within_reach);
            }
            (motion.led, motion.lag, motion.arrived) = (led, 0.0, true);
            joints.copy_from_slice(&before);
        }
        let (allotment, rounds) = self.settle_in_rounds(&way, &mut before)?;
        motion.memory.set_in_rounds(rounds > 0);
        let seen = self.place(&allotment.directions, allotment.point, joints, Some(motion))?;
        self.rest(&seen, motion);
        Some(allotment.within_reach)
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
                memory.wait_s = memory.wait_s.min(delay) - motion.dt;
            } else {
                memory.support = Support::Shares;
            }
        }
        Some(seen)
    }

    /// The regions return to the animation, and the eye keeps the gaze where the animation has it.
    fn return_to_rest(&self, joints: &mut [Joint], motion: &mut Motion<'_>) -> Option<()> {
        let first = self.chain.first;
        motion.memory.support = Support::Rests;
        let mut goals = self.rig.array([0.0; 2]);
        for (index, goal) in goals.iter_mut().enumerate() {
            *goal = self.held(index, &Joint::REST, [0.0; 2]).angles();
        }
        self.turn_regions_to(&goals, joints, motion);
        if self.has_eye {
            let resting = joints[first + 1..self.chain.count].iter().all(|joint| joint.angles() == [0.0; 2]);
            let seen = if resting {
                Seen { wanted: goals[first], held: goals[first] }
            } else {
                let gaze = self.chain.animated_gaze();
                self.see(joints, gaze.origin + math::unit(gaze.direction)? * self.far())?
            };
            self.leap(&seen, joints, motion);
        }
        Some(())
    }

    /// As far as the goal is.
    fn far(&self) -> f32 {
        (self.goal.aimed - self.chain.animated_gaze().origin).length().max(1.0)
    }

    /// Puts `joints` where they belong for a goal, and leaves them for none; returns whether it did. `None` where the aim
    /// is undefined.
    pub(crate) fn snap(&self, joints: &mut [Joint], memory: &mut Memory) -> Option<bool> {
        if self.goal.course != Course::Aim {
            return Some(false);
        }
        let first = self.chain.first;
        let mut found = self.rig.array(Joint::REST);
        for (index, joint) in found.iter_mut().enumerate() {
            *joint = self.held(index, &Joint::REST, [0.0; 2]);
        }
        let seen = self.see(&found, self.goal.aimed)?;
        memory.support = Support::Rests;
        if self.has_eye && seen.is_within() && seen.off() <= self.sharing.engage {
            found[first] = found[first].turned_to(seen.held[0], seen.held[1]);
        } else {
            self.settle(self.way()?, &mut found)?;
            memory.support = Support::Shares;
        }
        joints.copy_from_slice(&found);
        self.hold_eye(joints);
        let goal = self.regions[..self.count].last().map_or([0.0; 2], |head| sum(&joints[head.outer..=head.inner]));
        memory.set_led(Led { goal, ..Led::default() });
        Some(true)
    }

    /// Turns the joints from the root outward so that each region's outermost forward has its direction and the leading joint
    /// looks at `point`: at once, or by a frame's motion. Returns how the leading joint sees the point.
    fn place(
        &self,
        directions: &[Pair],
        point: Vec3A,
        joints: &mut [Joint],
        mut motion: Option<&mut Motion<'_>>,
    ) -> Option<Seen> {
        let mut frame = self.chain.base;
        let mut seen = None;
        for (number, region) in self.regions[..self.count].iter().enumerate() {
            let is_head = number + 1 == self.count;
            let direction = self.bearings.direction(directions[number]);
            let mut goals = self.rig.array([0.0; 2]);
            let infos = self.rig.joints;
            // Inner joints make their share; the outermost closes what is left, in the frame that they carry.
            let mut carried = frame;
            if region.outer < region.inner {
                let local = frame.matrix3.transpose() * direction;
                let whole = turn_to(&infos[region.inner].axes, region.forward, local);
                for index in (region.outer + 1..=region.inner).rev() {
                    let share = region.share(&infos[index]);
                    let held = self.held(index, &joints[index], [share[0] * whole[0], share[1] * whole[1]]);
                    goals[index] = held.angles();
                    carried = self.outward(&carried, index, &held);
                }
            }
            let outer = region.outer;
            let leads = is_head && !self.has_eye;
            let wanted = if leads {
                self.sight(&carried, joints, point)?
            } else {
                turn_to(&infos[outer].axes, region.bone, carried.matrix3.transpose() * direction)
            };
            let inner = add(&goals[outer + 1..=region.inner]);
            let within = [0, 1].map(|axis| region.room[axis].hold(wanted[axis] + inner[axis]) - inner[axis]);
            goals[outer] = self.held(outer, &joints[outer], within).angles();
            if leads {
                seen = Some(Seen { wanted, held: goals[outer] });
            }
            match &mut motion {
                Some(motion) => self.glide(region, is_head, &goals, joints, motion),
                None => {
                    for index in outer..=region.inner {
                        joints[index] = joints[index].turned_to(goals[index][0], goals[index][1]);
                    }
                }
            }
            if self.has_eye || !is_head {
                frame = (outer..=region.inner)
                    .rev()
                    .fold(frame, |frame, index| self.outward(&frame, index, &joints[index]));
            }
        }
        if self.has_eye {
            let first = self.chain.first;
            let eye = self.seen(&frame, joints, point)?;
            match motion {
                Some(motion) => self.leap(&eye, joints, motion),
                None => {
                    let [heading, pitch] = self.held_straight(&eye, &joints[first]);
                    joints[first] = joints[first].turned_to(heading, pitch);
                }
            }
            seen = Some(eye);
        }
        seen
    }

    /// The next joint's animated frame outward, as a corrected joint carries it.
    fn outward(&self, frame: &Affine3A, index: usize, joint: &Joint) -> Affine3A {
        let turned = frame.matrix3 * Mat3A::from_quat(joint_turn(&self.rig.joints[index], joint));
        let link = &self.chain.links[index];
        Affine3A { matrix3: turned * link.matrix3, translation: frame.translation + turned * link.translation }
    }

    /// The joint at the angles nearest to these that its range holds; a free heading the shorter way round.
    fn held(&self, index: usize, joint: &Joint, [heading, pitch]: Pair) -> Joint {
        let motion = &self.motions[index];
        let heading = if motion.heading.is_free() {
            joint.heading + math::wrap_pi(heading - joint.heading)
        } else {
            motion.heading.hold(heading)
        };
        joint.turned_to(heading, motion.pitch_at(heading).hold(pitch))
    }

    /// How the leading joint sees a point with the joints like this.
    fn see(&self, joints: &[Joint], point: Vec3A) -> Option<Seen> {
        let first = self.chain.first;
        let frame = (first + 1..self.chain.count)
            .rev()
            .fold(self.chain.base, |frame, index| self.outward(&frame, index, &joints[index]));
        self.seen(&frame, joints, point)
    }

    /// The same where its frame is at hand.
    fn seen(&self, frame: &Affine3A, joints: &[Joint], point: Vec3A) -> Option<Seen> {
        let first = self.chain.first;
        let wanted = self.sight(frame, joints, point)?;
        Some(Seen { wanted, held: self.held(first, &joints[first], wanted).angles() })
    }

    /// The heading and the pitch by which the leading joint looks at a point, standing in this frame before its added
    /// rotation. `None` where the point is on the effector.
    fn sight(&self, frame: &Affine3A, joints: &[Joint], point: Vec3A) -> Option<Pair> {
        let first = self.chain.first;
        let axes = &self.rig.joints[first].axes;
        let local = frame.matrix3.transpose() * (point - frame.translation);
        if self.effector.origin == Vec3A::ZERO && self.chain.is_rigid() {
            return Some(turn_to(axes, self.effector.direction, math::unit(local)?));
        }
        if self.chain.is_rigid() {
            self.sight_in_rounds(frame, joints, point)
        } else {
            self.sight_by_search(frame, joints, point)
        }
    }

    /// [`sight`](Self::sight) of an effector that is not at its joint: each round looks from where the last one left the
    /// effector.
    #[cold]
    fn sight_in_rounds(&self, frame: &Affine3A, joints: &[Joint], point: Vec3A) -> Option<Pair> {
        let first = self.chain.first;
        let info = &self.rig.joints[first];
        let mut joint = joints[first];
        let mut wanted = joint.angles();
        for _ in 0..SIGHT_ROUNDS {
            let origin = math::turned(joint_turn(info, &joint), self.effector.origin);
            let local = frame.matrix3.transpose() * (point - frame.translation) - origin;
            let next = turn_to(&info.axes, self.effector.direction, math::unit(local)?);
            let change = [math::wrap_pi(next[0] - wanted[0]), next[1] - wanted[1]];
            wanted = next;
            joint = self.held(first, &joints[first], wanted);
            if length(change) < 0.1 * SAME_RAD {
                break;
            }
        }
        Some(wanted)
    }

    /// [`sight`](Self::sight) in a pose that is not rigid, by the exact solver, the other joints held where they are.
    #[cold]
    fn sight_by_search(&self, frame: &Affine3A, joints: &[Joint], point: Vec3A) -> Option<Pair> {
        let first = self.chain.first;
        let mut found = self.rig.array(Joint::REST);
        found.copy_from_slice(joints);
        let mut reaches = self.rig.array(Reach::REST);
        for (reach, joint) in reaches.iter_mut().zip(joints) {
            *reach = Reach::at(joint);
        }
        // Beyond its range too: what the range does not hold is to be known.
        let info = &self.rig.joints[first];
        let all = |declared: Option<[f32; 2]>, most: f32| declared.map(|_| [-most, most]);
        let declared = Angles { heading: all(info.heading, PI), pitch: all(info.pitch, FRAC_PI_2) };
        reaches[first] = Reach::range(&RangeOfMotion::new(declared, 0.0, None));
        let goal = Goal { aimed: point, ..*self.goal };
        Solver::new(self.rig, self.chain, &goal).settle(&mut found, &reaches, Search::Thorough)?;
        // The angles that look where the rigid links would have to look; of an angle that the joint lacks, what is left.
        let rigid = self.effector.turned(joint_turn(info, &found[first])).through(frame);
        let seen = self.chain.seen_target(point, self.chain.gaze_of(self.rig, &found), rigid);
        let local = frame.matrix3.transpose() * (seen - rigid.origin);
        Some(turn_to(&info.axes, self.effector.direction, math::unit(local)?))
    }

    /// Moves every region towards its joints' goals by a frame.
    fn turn_regions_to(&self, goals: &[Pair], joints: &mut [Joint], motion: &mut Motion<'_>) {
        for number in 0..self.count {
            self.glide(&self.regions[number], number + 1 == self.count, goals, joints, motion);
        }
    }

    /// Moves a region towards its joints' goals by a frame, or to a stop. Its outermost joint remembers speed and
    /// acceleration.
    fn glide(&self, region: &Region, is_head: bool, goals: &[Pair], joints: &mut [Joint], motion: &mut Motion<'_>) {
        let (outer, inner, dt) = (region.outer, region.inner, motion.dt);
        let pace = region.pace * motion.led.unwrap_or_default().haste();
        let &Region { rate, approach, acceleration, .. } = region;
        let mut bounds = Bounds { dt, pace, rate, approach, acceleration };
        let (before, speed) = (sum(&joints[outer..=inner]), joints[outer].velocity);
        let mut glide =
            Glide { speed, acceleration: joints[outer].destination().unwrap_or_default(), ..Glide::default() };
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
        motion.arrived &= length(next.offset).max(length(next.speed) / bounds.pace) < THERE_RAD;

        let total = [goal[0] + next.offset[0], goal[1] + next.offset[1]];
        self.distribute(region, goals, goal, total, joints, motion);
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
        goal: Pair,
        total: Pair,
        joints: &mut [Joint],
        motion: &Motion<'_>,
    ) {
        let before = sum(&joints[region.outer..=region.inner]);
        let taken = 1.0 - 1.0 / (1.0 + motion.dt * region.pace);
        let mut rest = total;
        for index in (region.outer..=region.inner).rev() {
            let wanted = if index == region.outer {
                rest
            } else {
                let (share, angles) = (region.share(&self.rig.joints[index]), joints[index].angles());
                [0, 1].map(|axis| {
                    let off = angles[axis] - share[axis] * before[axis];
                    let end = if motion.stays { off } else { goals[index][axis] - share[axis] * goal[axis] };
                    share[axis] * total[axis] + off + taken * (end - off)
                })
            };
            joints[index] = motion.reaches[index].hold(&joints[index].turned_to(wanted[0], wanted[1]));
            rest = [rest[0] - joints[index].heading, rest[1] - joints[index].pitch];
        }
    }

    /// Turns the eye towards what it sees by a frame. It remembers where that was, and the speed at which it leaps.
    fn leap(&self, seen: &Seen, joints: &mut [Joint], motion: &Motion<'_>) {
        let first = self.chain.first;
        let (dt, joint, reach) = (motion.dt, joints[first], &motion.reaches[first]);
        let held = self.held_straight(seen, &joint);
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
        joints[first] = next;
    }

    /// Where the eye is held: towards what is out of its range straight, so that the gaze goes straight while the head comes and
    /// keeps its elevation where the head does not get there.
    fn held_straight(&self, seen: &Seen, joint: &Joint) -> Pair {
        if seen.is_within() {
            seen.held
        } else {
            self.held(self.chain.first, joint, self.straight(seen.wanted)).angles()
        }
    }

    /// As far as the eye gets straight towards what is out of its range.
    fn straight(&self, wanted: Pair) -> Pair {
        let part = [0, 1].into_iter().fold(1.0_f32, |part, axis| {
            let range = self.eye[axis];
            if range.is_point() || range.contains(wanted[axis]) {
                part
            } else {
                part.min((range.hold(wanted[axis]) / wanted[axis]).max(0.0))
            }
        });
        wanted.map(|angle| part * angle)
    }

    /// Keeps the eye where it is.
    fn hold_eye(&self, joints: &mut [Joint]) {
        if self.has_eye {
            let eye = &mut joints[self.chain.first];
            eye.velocity = [0.0; 2];
            eye.set_destination(Some([eye.heading, eye.pitch]));
        }
    }
}

/// How much quicker a head that leads makes up for a small offset, which takes little acceleration: what the animation does in
/// jerks leaves it no lag that could be seen.
fn quickness(offset: f32) -> f32 {
    const SMALL_RAD: f32 = 3.0 * PI / 180.0;
    math::sqrt(SMALL_RAD / offset.max(SMALL_RAD / 9.0)).max(1.0)
}

/// The sums of headings and of pitches.
fn add(angles: &[Pair]) -> Pair {
    angles.iter().fold([0.0; 2], |[heading, pitch], own| [heading + own[0], pitch + own[1]])
}

/// The sums of the joints' headings and pitches.
fn sum(joints: &[Joint]) -> Pair {
    joints.iter().fold([0.0; 2], |[heading, pitch], joint| [heading + joint.heading, pitch + joint.pitch])
}

/// The heading and the pitch that turn `from` to `to`, unit vectors of a joint's frame: pitch lifts `from` to the height of `to`,
/// or as near as it gets, then heading brings it there.
fn turn_to(axes: &Axes, from: Vec3A, to: Vec3A) -> Pair {
    /// Nearer to square to the bone's forward than this, a direction can be lifted to either side.
    const ACROSS: f32 = 0.5;
    let [[ahead, left, up], [to_ahead, to_left, to_up]] = [view(axes, from), view(axes, to)];
    let level = math::sqrt(ahead * ahead + up * up - to_up * to_up);
    // Differences of angles, each by one arctangent.
    let turn = |level: f32| {
        [
            trig::atan2(to_left * level - to_ahead * left, to_ahead * level + to_left * left),
            trig::atan2(to_up * ahead - level * up, level * ahead + to_up * up),
        ]
    };
    let angles = turn(if ahead < -ACROSS { -level } else { level });
    if ahead.abs() <= ACROSS {
        let other = turn(-level);
        if other[0].abs() < angles[0].abs() {
            return other;
        }
    }
    angles
}
