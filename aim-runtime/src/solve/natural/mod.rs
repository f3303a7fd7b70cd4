//! A gaze as people have it: the eye leaps to the target and holds it, the joints that support it follow with their
//! inertia by a share of the gaze shift, and the eye returns as they arrive.
//!
//! A frame goes in three steps. Where the supporting joints belong is found without rates ([`Gaze::goals`]): as far as
//! their share, with the least displacement, and further where the eye cannot make up the rest. They follow that with
//! braking ([`Follower`]). Then the eye solves exactly what is left of the gaze where they are now, so that their pace
//! costs the aim nothing once it has arrived. Nothing here depends on how often a second it is called.

mod follow;
mod sight;

use glam::Vec3A;

use self::follow::Follower;
use crate::kinematics::chain::{Chain, Ray};
use crate::kinematics::rotation::{is_identity, joint_turn};
use crate::limits::RangeOfMotion;
use crate::limits::motion::wrap;
use crate::limits::reach::Reach;
use crate::math::trig;
use crate::rig::{ChainRig, Memory, PerJoint, Support};
use crate::solve::exact::settle::{Search, at_rest, settle_from_rest};
use crate::solve::exact::{Solver, unhurried};
use crate::solve::eyes;
use crate::solve::turn_round::{count_blocked, is_worth_turning_back};
use crate::target::goal::{Course, Goal};
use crate::{Joint, Settings, math};

/// How much more willing an eye is than its stiffness says, where supporting joints make up for what it cannot do: they
/// are not to do more than that.
const EYE_EASE: f32 = 10.0;
/// Nearer to its goal than this a supporting joint counts as there, radians (0.06°).
const THERE_RAD: f32 = 1e-3;
/// Nearer to their share than this the supporting joints need no second search for it, radians (0.1°).
const SHARED_RAD: f32 = 1.75e-3;
/// Halvings that find where the way of an eye leaves its range: to 2e-4 of a right angle.
const HALVINGS: usize = 14;
/// What the shortest way to an end of its range is of the longest for an eye that turns about as far whichever way.
const ROUND: f32 = 1.0 / 3.0;
/// Angles that differ by less do so by rounding.
const SAME_RAD: f32 = 1e-5;

/// The settings as they count.
struct Sharing {
    eyes_only: f32,
    head_share: f32,
    engage: f32,
    release: f32,
    delay: f32,
}

impl Sharing {
    fn new<const C: usize>(rig: &ChainRig<'_, C>, settings: &Settings) -> Self {
        // `max` and `min` return the number where the other is NaN.
        let attention = settings.attention.max(0.0).min(1.0);
        let natural = settings.sharing.unwrap_or(rig.sharing);
        let share = natural.head_share.max(0.0).min(1.0);
        let left_to_eyes = 1.0 - attention;
        Self {
            eyes_only: natural.eyes_only.max(0.0) * left_to_eyes,
            head_share: share + (1.0 - share) * attention,
            engage: natural.engage.max(0.0) * left_to_eyes,
            release: natural.release.max(0.0) * left_to_eyes,
            delay: natural.delay.max(0.0),
        }
    }

    /// The part of a gaze shift that the supporting joints make.
    fn head_part(&self, shift: f32) -> f32 {
        let beyond = shift - self.eyes_only;
        if beyond > 0.0 { self.head_share * beyond / shift } else { 0.0 }
    }
}

/// What an eye sees of a point, and makes of it.
struct Look {
    /// Heading and pitch that look at it; where it is out of range, those on the way there that are not.
    angles: [f32; 2],
    within: bool,
    /// How far the point is off the middle of the eye.
    off: Off,
}

/// An angle off the middle of an eye.
enum Off {
    Rad(f32),
    /// That of this view: as long as nobody asks, it costs nothing.
    View([f32; 3]),
}

impl Off {
    fn rad(&self) -> f32 {
        match *self {
            Self::Rad(angle) => angle,
            Self::View([ahead, left, up]) => trig::atan2(math::sqrt(left * left + up * up), ahead),
        }
    }
}

/// What the joints would come to, had they the time.
struct Goals {
    /// Whether they reach the goal…
    reach: bool,
    /// … and the eye does its part exactly, with the others at their share.
    eye_reaches: bool,
}

/// A natural gaze in one call.
pub(crate) struct Gaze<'a, const C: usize> {
    rig: &'a ChainRig<'a, C>,
    chain: &'a Chain<C>,
    motions: &'a [RangeOfMotion],
    goal: &'a Goal,
    tolerance: f32,
    sharing: Sharing,
    /// The ranges of motion, as reaches.
    ranges: PerJoint<Reach, C>,
    /// Whether the eye looks along its joint's own forward from its own origin, so that a closed form turns it.
    plain_eye: bool,
}

impl<'a, const C: usize> Gaze<'a, C> {
    /// A gaze for a chain from joint 0, which leads; there is at least one joint to support it.
    pub(crate) fn new(
        rig: &'a ChainRig<'a, C>,
        chain: &'a Chain<C>,
        motions: &'a [RangeOfMotion],
        goal: &'a Goal,
        settings: &Settings,
    ) -> Self {
        let effector = rig.effector;
        let own = effector.origin == [0.0; 3] && effector.forward == rig.joints[0].axes.forward;
        Self {
            rig,
            chain,
            motions,
            goal,
            tolerance: settings.effective_tolerance(),
            sharing: Sharing::new(rig, settings),
            ranges: unhurried(rig, motions),
            plain_eye: own && chain.is_rigid() && is_identity(chain.tilts[0]),
        }
    }

    /// Moves `joints`, which are within `reaches`, by a frame of `dt` seconds; returns whether the goal is within reach.
    /// `None` where the aim is undefined.
    pub(crate) fn aim(&self, joints: &mut [Joint], memory: &mut Memory, reaches: &[Reach], dt: f32) -> Option<bool> {
        if !(dt > 0.0) {
            return Some(true);
        }
        match self.goal.course {
            Course::Aim => self.turn_to_goal(joints, memory, reaches, dt),
            Course::Rest => {
                self.return_to_rest(joints, memory, reaches, dt);
                Some(true)
            }
            Course::Stay => {
                for index in self.supporting() {
                    joints[index] = self.follower(index, reaches, dt).stopping(&joints[index]);
                }
                Some(true)
            }
        }
    }

    fn supporting(&self) -> core::ops::Range<usize> {
        1..self.chain.count
    }

    fn follower<'b>(&'b self, index: usize, reaches: &'b [Reach], dt: f32) -> Follower<'b> {
        Follower::new(&self.rig.joints[index], &self.motions[index], &reaches[index], dt)
    }

    fn turn_to_goal(&self, joints: &mut [Joint], memory: &mut Memory, reaches: &[Reach], dt: f32) -> Option<bool> {
        let mut engages = false;
        for index in self.supporting() {
            // Bound for nowhere yet: that is to be found out.
            let joint = &mut joints[index];
            engages |= joint.destination().is_none();
            joint.set_destination(Some(joint.destination().unwrap_or(joint.angles())));
        }
        if memory.support == Support::Rests {
            let seen = self.look(joints, self.goal.aimed)?;
            if engages || self.engages(&seen) {
                (memory.support, memory.wait_s) = (Support::Waits, self.sharing.delay);
            }
        }
        let (mut aimed, mut within_reach) = (self.goal.aimed, true);
        if memory.support != Support::Rests {
            (aimed, within_reach) = self.find_goals(joints, memory, dt)?;
        }
        let (look, arrived) = self.follow_goals(joints, aimed, reaches, dt)?;
        if arrived && look.within && look.off.rad() < self.sharing.release {
            memory.support = Support::Rests;
        }
        self.turn_eye(joints, &look, reaches);
        Some(within_reach)
    }

    /// Whether the eye needs support for what it sees.
    fn engages(&self, seen: &Look) -> bool {
        !seen.within || seen.off.rad() > self.sharing.engage
    }

    /// Finds where the supporting joints belong, and sends them there once they set out. Returns what the eye is to aim
    /// at, and whether the goal is within reach.
    fn find_goals(&self, joints: &mut [Joint], memory: &mut Memory, dt: f32) -> Option<(Vec3A, bool)> {
        let mut found = self.rig.array(Joint::REST);
        found.copy_from_slice(joints);
        let goals = self.goals(&mut found, Some(dt), memory)?;
        if memory.support == Support::Waits && memory.wait_s > 0.0 {
            memory.wait_s = memory.wait_s.min(self.sharing.delay) - dt;
        } else {
            memory.support = if goals.eye_reaches { Support::Shares } else { Support::Helps };
            for index in self.supporting() {
                joints[index].set_destination(Some(found[index].angles()));
            }
        }
        let aimed = if goals.eye_reaches { self.goal.aimed } else { self.looked_at(&found) };
        Some((aimed, goals.reach))
    }

    /// Moves the supporting joints on to where they are bound for, while the eye looks at `aimed`; returns how it does
    /// then, and whether they are there.
    fn follow_goals(&self, joints: &mut [Joint], aimed: Vec3A, reaches: &[Reach], dt: f32) -> Option<(Look, bool)> {
        let mut arrived = true;
        let mut moved = self.rig.array(joints[0]);
        for index in self.supporting() {
            let joint = joints[index];
            let [heading, pitch] = joint.destination().unwrap_or_default();
            let goal = self.ranges[index].hold(&joint.turned_to(heading, pitch));
            moved[index] = self.follower(index, reaches, dt).towards(&joint, [goal.heading, goal.pitch]);
            arrived &= moved[index].is_near(&goal, THERE_RAD);
        }
        let mut look = self.look(&moved, aimed)?;
        if self.keep_in_sight(joints, &mut moved, aimed, &look, reaches, dt).is_some() {
            look = self.look(&moved, aimed)?;
        }
        joints.copy_from_slice(&moved);
        Some((look, arrived))
    }

    /// The gaze goes back to where the animation has it, and the supporting joints to rest; the eye ends there too.
    fn return_to_rest(&self, joints: &mut [Joint], memory: &mut Memory, reaches: &[Reach], dt: f32) {
        memory.support = Support::Rests;
        let mut resting = true;
        for index in self.supporting() {
            joints[index] = self.follower(index, reaches, dt).towards(&joints[index], [0.0; 2]);
            joints[index].set_destination(None);
            let Joint { heading, pitch, velocity, .. } = joints[index];
            resting &= [heading, pitch] == [0.0; 2] && velocity == [0.0; 2];
        }
        let ahead = self.ahead(self.chain.animated_gaze());
        match self.look(joints, ahead) {
            Some(look) if !resting => self.turn_eye(joints, &look, reaches),
            _ => joints[0] = reaches[0].towards_rest(&joints[0]),
        }
    }

    /// Puts `joints` where they belong for a goal within reach, and leaves them for another; returns whether it is.
    /// `None` where the aim is undefined.
    pub(crate) fn snap(&self, joints: &mut [Joint], memory: &mut Memory) -> Option<bool> {
        if self.goal.course != Course::Aim {
            return Some(false);
        }
        let mut found = self.rig.array(Joint::REST);
        found.copy_from_slice(joints);
        at_rest(&mut found);
        found.iter_mut().for_each(|joint| joint.set_destination(None));
        let mut remembered = Memory::NONE;
        let goals = self.goals(&mut found, None, &mut remembered)?;
        if !goals.reach {
            return Some(false);
        }
        let seen = self.look(&found, self.goal.aimed)?;
        for (joint, found) in joints.iter_mut().zip(&*found) {
            *joint = *found;
            joint.set_destination(Some(found.angles()));
        }
        joints[0].set_destination(None);
        remembered.support = match goals.eye_reaches {
            false => Support::Helps,
            true if self.engages(&seen) => Support::Shares,
            true => Support::Rests,
        };
        *memory = remembered;
        Some(true)
    }

    /// Moves `joints` to where they belong, had they the time: from where they are bound for by what a frame of `dt`
    /// seconds needs of it, or however far that is.
    fn goals(&self, joints: &mut [Joint], dt: Option<f32>, memory: &mut Memory) -> Option<Goals> {
        let Self { rig, chain, motions, goal, tolerance, .. } = *self;
        let ranges = &*self.ranges;
        for index in self.supporting() {
            if let Some([heading, pitch]) = joints[index].destination() {
                joints[index] = ranges[index].hold(&joints[index].turned_to(heading, pitch));
            }
        }
        let mut bound_for = rig.array([0.0; 2]);
        for (angles, joint) in bound_for.iter_mut().zip(&*joints) {
            *angles = joint.angles();
        }
        self.share(joints, dt, memory);
        let look = self.look(joints, goal.aimed)?;
        [joints[0].heading, joints[0].pitch] = look.angles;
        if look.within {
            return Some(Goals { reach: true, eye_reaches: true });
        }

        let mut shared = rig.array(Joint::REST);
        shared.copy_from_slice(joints);
        for (joint, angles) in joints.iter_mut().zip(&*bound_for) {
            [joint.heading, joint.pitch] = *angles;
        }
        // Of the rest the supporting joints take what the eye cannot.
        let mut solver = Solver::new(rig, chain, goal);
        solver.prefer(0, [0.0; 2], EYE_EASE);
        for index in self.supporting() {
            solver.prefer(index, [shared[index].pitch, shared[index].heading], 1.0);
        }
        // Where they are bound for they may put the effector on a target that it is not on now: no way leads on from there.
        let here = match dt {
            Some(dt) => solver.advance(joints, ranges, dt, memory),
            None => solver.settle(joints, ranges, Search::Thorough),
        };
        let mut here = here.unwrap_or(f32::INFINITY);
        // A frame's step goes but a part of the way to the optimum, and which part that is rounding may decide.
        if dt.is_some() {
            shared.copy_from_slice(joints);
            if let Some(settled) =
                solver.settle(&mut shared, ranges, Search::Thorough).filter(|&settled| settled <= tolerance)
            {
                joints.copy_from_slice(&shared);
                here = settled;
            }
        }
        count_blocked(memory, here <= tolerance, dt.unwrap_or(0.0));
        if here > tolerance {
            shared.copy_from_slice(joints);
            let from_rest =
                settle_from_rest(rig, chain, motions, goal, &mut shared, tolerance).unwrap_or(f32::INFINITY);
            if from_rest <= tolerance || is_worth_turning_back(memory, from_rest, here) {
                joints.copy_from_slice(&shared);
                here = from_rest;
            }
        }
        for (joint, motion) in joints.iter_mut().zip(motions) {
            wrap(motion, joint);
        }
        Some(Goals { reach: here <= tolerance, eye_reaches: false })
    }

    /// Turns the supporting joints to their share of the gaze shift, the eye at rest.
    fn share(&self, joints: &mut [Joint], dt: Option<f32>, memory: &mut Memory) {
        let Self { rig, chain, motions, goal, .. } = *self;
        (joints[0].heading, joints[0].pitch) = (0.0, 0.0);
        let shift = chain.animated_gaze().angle_to(goal.aimed).unwrap_or(0.0);
        let part = self.sharing.head_part(shift);
        if !(part > 0.0) {
            return self.rest(joints);
        }
        let partial = goal.part_way(rig, chain, motions, part);
        let mut reaches = rig.array(Reach::REST);
        reaches.copy_from_slice(&self.ranges);
        reaches[0] = Reach::REST;
        let mut solver = Solver::new(rig, chain, &partial);
        // From where they are bound for, which takes next to nothing. Where that does not lead there, from rest: so that
        // the share depends on nothing but the target.
        let near = match dt {
            Some(_) if memory.support != Support::Shares => None,
            Some(_) if solver.advance_roughly(joints, &reaches, memory) => Some(0.0),
            Some(dt) => solver.advance(joints, &reaches, dt, memory),
            None => None,
        };
        if !near.is_some_and(|near| near <= self.tolerance.max(SHARED_RAD)) {
            self.rest(joints);
            // At rest they stay where that leads nowhere either.
            let _ = solver.settle(joints, &reaches, Search::Thorough);
        }
        for (joint, motion) in joints.iter_mut().zip(motions) {
            wrap(motion, joint);
        }
    }

    /// Puts all joints at rest, the supporting ones as near to it as their ranges let them.
    fn rest(&self, joints: &mut [Joint]) {
        at_rest(joints);
        for index in self.supporting() {
            joints[index] = self.ranges[index].hold(&joints[index]);
        }
    }

    /// A point that the effector looks at with the joints like this.
    fn looked_at(&self, joints: &[Joint]) -> Vec3A {
        self.ahead(self.chain.gaze_of(self.rig, joints))
    }

    /// A point that a gaze looks at, as far away as the goal is.
    fn ahead(&self, gaze: Ray) -> Vec3A {
        let distance = (self.goal.aimed - gaze.origin).length().max(1.0);
        gaze.origin + math::direction(gaze.direction).unwrap_or(Vec3A::X) * distance
    }

    /// Turns the eye as far as its reach lets it; both angles by one factor where its rate ends the way.
    fn turn_eye(&self, joints: &mut [Joint], look: &Look, reaches: &[Reach]) {
        let [heading, pitch] = look.angles;
        let (eye, goal) = (joints[0], Joint { heading, pitch, ..joints[0] });
        let (reach, motion) = (&reaches[0], &self.motions[0]);
        joints[0] = reach.part_way(&eye, &goal, motion, reach.part_of_way(&eye, &goal, motion));
        joints[0].velocity = [0.0; 2];
        joints[0].set_destination(None);
    }

    /// What the eye sees of a point with the supporting joints like this. `None` where it is on the eye.
    fn look(&self, joints: &[Joint], point: Vec3A) -> Option<Look> {
        if !self.plain_eye {
            return self.look_by_solving(joints, point);
        }
        let range = &self.ranges[0];
        let (view, angles) = self.bearing(joints, point)?;
        let [heading, pitch] = angles;
        if range.heading.contains(heading) && range.pitch_at(heading).contains(pitch) {
            return Some(Look { angles, within: true, off: Off::View(view) });
        }
        let angles = eyes::look(view, range);
        if is_along(angles, view) {
            return Some(Look { angles, within: true, off: Off::View(view) });
        }
        let off = Off::View(view).rad();
        Some(Look { angles: self.on_the_way(view, off).unwrap_or(angles), within: false, off: Off::Rad(off) })
    }

    /// The direction of a point along an eye's forward, left and up, and the heading and pitch that look there, with the
    /// supporting joints like this. `None` where the point is on the eye.
    fn bearing(&self, joints: &[Joint], point: Vec3A) -> Option<([f32; 3], [f32; 2])> {
        let view = eyes::view(&self.rig.joints[0].axes, math::direction(self.seen(joints, point))?);
        let [ahead, left, up] = view;
        let level = math::sqrt(ahead * ahead + left * left);
        Some((view, [trig::atan2(left, ahead), trig::atan2(up, level)]))
    }

    /// The angles on the arc to a view so far off the middle, as far as the eye's range goes: so the gaze stays on that
    /// arc while the head still moves. `None` for an eye that can do much less one way than another.
    fn on_the_way(&self, [_, left, up]: [f32; 3], eccentricity: f32) -> Option<[f32; 2]> {
        let aside = math::sqrt(left * left + up * up);
        let range = &self.ranges[0];
        let ends = [-range.heading.lo(), range.heading.hi(), -range.pitch.lo(), range.pitch.hi()];
        let (least, most) = ends.iter().fold((f32::INFINITY, 0.0_f32), |(a, b), end| (a.min(*end), b.max(*end)));
        if !(aside > 0.0 && least > ROUND * most) {
            return None;
        }
        let (mut inside, mut outside) = (0.0, eccentricity);
        let mut angles = [0.0; 2];
        for _ in 0..HALVINGS {
            let angle = 0.5 * (inside + outside);
            let (sin, cos) = trig::sin_cos(angle);
            let view = [cos, sin * left / aside, sin * up / aside];
            let there = eyes::look(view, range);
            if is_along(there, view) {
                (inside, angles) = (angle, there);
            } else {
                outside = angle;
            }
        }
        Some(angles)
    }

    /// A point in the eye's space, before its added rotation; for a rigid chain.
    fn seen(&self, joints: &[Joint], point: Vec3A) -> Vec3A {
        let (infos, links) = (self.rig.joints, &self.chain.links);
        let mut seen = self.chain.base.matrix3.transpose() * point;
        for index in self.supporting().rev() {
            let turn = joint_turn(&infos[index], &joints[index]);
            seen = math::turned(turn.conjugate(), seen);
            let link = &links[index];
            seen = link.matrix3.transpose() * (seen - link.translation);
        }
        seen
    }

    /// [`look`](Self::look) for an eye without a closed form: by the exact solver, the others held where they are.
    #[cold]
    fn look_by_solving(&self, joints: &[Joint], point: Vec3A) -> Option<Look> {
        let mut eye = self.rig.array(Joint::REST);
        eye.copy_from_slice(joints);
        let mut reaches = self.rig.array(Reach::REST);
        reaches.copy_from_slice(&self.ranges);
        for index in self.supporting() {
            reaches[index] = Reach::at(&joints[index]);
        }
        let goal = Goal { aimed: point, ..*self.goal };
        let mut solver = Solver::new(self.rig, self.chain, &goal);
        let enough = SAME_RAD.max(self.tolerance);
        let mut remaining = solver.settle(&mut eye, &reaches, Search::Thorough)?;
        if remaining > enough {
            let here = eye[0];
            (eye[0].heading, eye[0].pitch) = (0.0, 0.0);
            match solver.settle(&mut eye, &reaches, Search::Thorough) {
                Some(from_rest) if from_rest < remaining => remaining = from_rest,
                _ => eye[0] = here,
            }
        }
        let Joint { heading, pitch, .. } = eye[0];
        let (within, off) = (remaining <= enough, math::sqrt(heading * heading + pitch * pitch));
        Some(Look { angles: [heading, pitch], within, off: Off::Rad(if within { off } else { off + remaining }) })
    }
}

/// Whether these angles look along a view, to rounding.
fn is_along([heading, pitch]: [f32; 2], [ahead, left, up]: [f32; 3]) -> bool {
    let ((sin_h, cos_h), (sin_p, cos_p)) = (trig::sin_cos(heading), trig::sin_cos(pitch));
    let level = ahead * cos_h + left * sin_h;
    let (beside, above) = (left * cos_h - ahead * sin_h, up * cos_p - level * sin_p);
    level > -SAME_RAD && beside.abs() < SAME_RAD && above.abs() < SAME_RAD
}
