//! The natural solver: a human-like gaze. The eye jumps to the target and fixates it, head and chest follow by their
//! share, and the eye turns back as they arrive.
//!
//! Directions are headings and elevations about the character's up ([`Bearings`]). The joints form *regions* of the
//! body with budgets ([`region`]). A call takes two steps:
//!
//! 1. The gaze shift, from the animated gaze to the target, (Δψ, Δε), is shared out ([`allot`]). The regions cover
//!    g·max(0, E − D)/E of it, where E is its angle, and more if the eye cannot cover the rest or would stay in its
//!    corner. For them, the shift starts from the eye's rest rather than from where the animation looks. Each region
//!    takes a part by its compliance, within its range and budget, separately for heading and elevation. A target out
//!    of reach to the side is therefore followed level. The further the head is turned aside, the less the trunk bends,
//!    which would tilt the head.
//! 2. Each region, from the root outward, turns its outermost forward to its allotted direction, measured in the frame
//!    carried by the corrected joints inward of it: `R_heading·R_pitch` in closed form ([`body`]). Over time it glides
//!    there ([`glide`]); the eye turns exactly to the remainder ([`sight`]).
//!
//! The result does not depend on the frame rate. Sources: Freedman and Sparks, *J. Neurophysiol.* 77 (1997) for the
//! zone and the slope of the head's part; Freedman, *Exp. Brain Res.* 190 (2008) for coordination as a whole.

mod allot;
mod body;
mod glide;
mod range;
mod region;
mod sharing;
mod sight;
mod turning;

use glam::{Quat, Vec3A, Vec4, Vec4Swizzles};

use self::allot::{FRAME_ROUNDS, Fit, ROUNDS};
use self::body::{Body, Turn, angles};
use self::glide::{Pair, pair, square, to_array};
use self::range::Range;
use self::region::{Region, find_regions};
use self::sharing::Sharing;
use self::sight::SightAngles;
use super::call::Call;
use super::eyes::{ChainResult, Eyes, LeadingFrame};
use super::judge::Measured;
use super::task::{SolveOutput, Task};
use crate::kinematics::bearing::{Bearings, FORWARD_STEEP_RAD};
use crate::kinematics::chain::{Chain, Space, Upright, true_gaze};
use crate::kinematics::rotation::{tilted, turn};
use crate::limits::RangeOfMotion;
use crate::limits::motion::animated_angles;
use crate::limits::reach::AT_LIMIT_RAD;
use crate::math::Bounded;
use crate::math::trig;
use crate::rig::{BodyPart, ChainRig, EXACT_JOINTS, HeadGoal, MOST_PARTS, Memory, PerJoint, PoseSlices, Support};
use crate::target::behind::Front;
use crate::target::goal::{Goal, Movement, Scene, Seen};
use crate::{Joint, Outcome, Role, Settings, math};

/// Difference of angles that counts as rounding, radians.
const SAME_RAD: f32 = 1e-5;
/// Distance from its goal below which a region has arrived, radians (0.01°), if its speed is at most this times the
/// pace.
const THERE_RAD: f32 = 2e-4;
/// Shortest frame in which anything moves, seconds.
const LEAST_S: f32 = 1e-5;

/// Moves `joints` by a natural gaze: by one frame, or at once if the call's `dt` is `None`. Returns `None` if there is
/// nothing to aim.
#[inline(never)]
pub(super) fn aim<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &PoseSlices<'_>,
    motions: &mut [RangeOfMotion],
    call: &Call<'_>,
    about: Upright,
    SolveOutput { joints, memory, corrections, eyes }: SolveOutput<'_, C>,
) -> Option<Outcome> {
    let settings = call.settings;
    let mut body = Body::unseen(rig);
    body.read(pose.joints, settings.effector, about)?;
    let skewed;
    let chain = if body.deviation.is_slight() {
        None
    } else {
        skewed = Chain::new(rig, pose.joints, settings.effector, about)?;
        body.set_gaze(skewed.animated_gaze())?;
        Some(&skewed)
    };
    if let Some(eyes) = eyes {
        converge(eyes, &body, motions, call, joints);
    }
    let bearings = Bearings::of_trunk(&body.trunk, about, body.turns_round());
    let scene = Scene {
        space: body.space,
        gaze: body.gaze,
        front: Front::new(&body.frames[body.count() - 1], body.gaze),
        rig: rig.description,
        first: body.first(),
        motions,
        bearings: Some(&bearings),
        has_two_eyes: pose.other_eye.is_some(),
    };
    let goal = Goal::new(&scene, call.target_ps.into(), settings, Seen::of(memory, call.dt.is_some()))?;
    let first = body.first();
    let has_eye = C == EXACT_JOINTS || rig.joints[first].role == Role::Eye && first + 1 < body.count();
    let mut own_parts = None;
    let parts = if C == EXACT_JOINTS {
        &rig.parts[..C - 1]
    } else if first == 0 && rig.part_count <= MOST_PARTS {
        &rig.parts[..rig.part_count]
    } else {
        let parts = own_parts.insert(rig.array(BodyPart::NONE));
        let count = BodyPart::find(rig.joints, first, &rig.budgets, parts);
        &parts[..count]
    };
    let motions = motions.get(..rig.count())?;
    let ranges = rig.array_of(Range::REST, |index| Range::new(&motions[index], rig.has_fixed_ranges));
    let mut regions = rig.array(Region::of_part(parts.first()?));
    find_regions(&body, pose.bind, parts, &ranges, &bearings, &mut regions);
    let count = parts.len();
    let [turns, _] = parts[count - 1].ends::<C>(count - 1);
    let direction = body.gaze.direction;
    let glance = if has_eye && pose.bind.is_some() {
        Glance::new(&body, pose, &bearings, settings.effective_weight())
    } else {
        Glance::none(direction)
    };
    let sharing = Sharing::new(&rig.sharing, settings);
    let customary = if has_eye { sharing.customary_range(&ranges[first], glance.turn) } else { [Vec4::ZERO; 2] };
    let gaze = Gaze {
        rig,
        body: &body,
        chain,
        ranges: &ranges,
        goal: &goal,
        sharing,
        patience: settings.patience.at_least(0.0),
        fade: fade_of(settings),
        bearings: &bearings,
        regions: &regions,
        count,
        has_eye,
        glance: &glance,
        customary,
        pivot: body.gaze.origin - direction * direction.dot(body.gaze.origin - body.places[turns]).at_least(0.0),
    };
    let mut before = *joints;
    let mut posture =
        Posture { joints, corrections, aim_point: goal.measured_point, measured_point: goal.measured_point };
    let fit = match call.dt {
        Some(dt) => gaze.move_joints(&mut before, memory, &mut posture, dt)?,
        None => gaze.snap(&before, memory, &mut posture)?,
    };
    let margins = ranges.iter().zip(posture.joints.iter()).map(|(range, joint)| range.margins(angles(joint)));
    let least = margins.fold(Vec4::INFINITY, Vec4::min);
    let well_within = least.cmpgt(Vec4::splat(AT_LIMIT_RAD)).bitmask() & 3 == 3;
    let within_reach = fit.within_reach;
    let task = Task { rig, motions, goal: &goal, space: body.space, settings, within_reach, well_within };
    if let Some(eyes) = eyes
        && let Some(outcome) = follow_with_both(eyes, &body, &task, memory, &mut posture)
    {
        return Some(Outcome { body_turn: fit.body_turn, out_of_reach_for: memory.blocked_s, ..outcome });
    }
    // Created where it is needed, so that it is not stored.
    let end = || End { pose, body: &body, chain, task, body_turn: fit.body_turn };
    match eyes {
        Some(eyes) => end().replace_leading(eyes, memory, posture),
        None => end().judge(memory, posture),
    }
}

/// The end of a call, after the supporting joints have turned.
#[derive(Clone, Copy)]
struct End<'a, const C: usize> {
    pose: &'a PoseSlices<'a>,
    body: &'a Body<'a, C>,
    chain: Option<&'a Chain<C>>,
    task: Task<'a, C>,
    body_turn: f32,
}

impl<const C: usize> End<'_, C> {
    /// Corrects the leading joint, and returns the outcome.
    #[cfg_attr(not(aim_small), inline(always))]
    fn judge(self, memory: &mut Memory, mut posture: Posture<'_, C>) -> Option<Outcome> {
        let Self { pose, body, chain, task, body_turn } = self;
        let (goal, first) = (task.goal, body.first());
        let mut leading = Turn::NONE;
        for joint in 0..first + 1 {
            leading = posture.correct(body, joint);
        }
        let Posture { joints, corrections, measured_point, .. } = posture;
        task.remember(joints, memory);
        let measured = match chain {
            Some(chain) => Measured::of_angle(chain.gaze(corrections).angle_to(goal.measured_point)?),
            None if body.deviation.is_negligible() => body.measure(body.view(measured_point), &leading)?,
            // Undoing a rotation in skewed axes is inexact by the skew, so use true kinematics.
            None => {
                let gaze = true_gaze(task.rig, pose.joints, first, body.space, corrections)?;
                Measured::of_angle(gaze.angle_to(goal.measured_point)?)
            }
        };
        Some(Outcome { body_turn, out_of_reach_for: memory.blocked_s, ..task.judge(joints, measured) })
    }

    /// Turns both eyes instead of the leading one, and returns the outcome.
    #[cold]
    #[inline(never)]
    fn replace_leading(self, eyes: &Eyes<'_, C>, memory: &mut Memory, posture: Posture<'_, C>) -> Option<Outcome> {
        let Posture { joints, corrections, aim_point, measured_point } = posture;
        let leading = Posture { joints, corrections, aim_point, measured_point };
        let outcome = self.judge(memory, leading)?;
        let chain = ChainResult { outcome, goal: self.task.goal, space: self.task.space };
        eyes.replace_leading(&chain, joints, memory, corrections)
    }
}

/// Turns both eyes if they follow their target in a rigid pose and no joint is at a limit.
#[cfg_attr(not(aim_small), inline(always))]
fn follow_with_both<const C: usize>(
    eyes: &Eyes<'_, C>,
    body: &Body<'_, C>,
    task: &Task<'_, C>,
    memory: &mut Memory,
    Posture { joints, corrections, measured_point, .. }: &mut Posture<'_, C>,
) -> Option<Outcome> {
    if !(task.well_within && body.first() == 0 && body.deviation.is_negligible()) {
        return None;
    }
    let leading = LeadingFrame { frame: &body.frames[0], rows: &body.rows[0], per_size: body.space.per_size };
    let outcome = eyes.follow(task.goal, body.view(*measured_point), &leading, joints, memory, corrections)?;
    task.remember(joints, memory);
    Some(outcome)
}

/// Sets the ranges of the eye that leads two in this frame.
#[cfg_attr(not(aim_small), inline(always))]
fn converge<const C: usize>(
    eyes: &Eyes<'_, C>,
    body: &Body<'_, C>,
    motions: &mut [RangeOfMotion],
    call: &Call<'_>,
    joints: &[Joint],
) {
    let distance = || {
        if body.first() > 0 || !body.deviation.is_slight() {
            return eyes.distance(joints);
        }
        let Space { origin, per_size } = body.space;
        let target = (Vec3A::from(call.target_ps) - origin) * per_size;
        (body.unturned(joints, target) - body.places[0]).length() / per_size
    };
    if call.dt.is_some() {
        eyes.converge(motions, distance);
    }
}

/// The animation's turn of the leading eye out of the bind pose, times the weight. Where the animation looks is replaced
/// by the target, so it must not move the head.
struct Glance {
    /// The eye's heading and pitch.
    turn: Pair,
    /// The change of the gaze's heading and elevation.
    change: Pair,
    /// The direction of the gaze with the turn undone.
    rest: Vec3A,
}

impl Glance {
    /// Returns the glance of an eye that counts as at rest, because there is no bind pose.
    #[cfg_attr(not(aim_small), inline(always))]
    fn none(gaze: Vec3A) -> Self {
        Self { turn: Vec4::ZERO, change: Vec4::ZERO, rest: gaze }
    }

    #[cold]
    fn new<const C: usize>(body: &Body<'_, C>, pose: &PoseSlices<'_>, bearings: &Bearings, weight: f32) -> Self {
        let (gaze, eye) = (body.gaze.direction, body.first());
        let Some(turn) = animated_angles(&body.infos()[eye], pose, eye) else { return Self::none(gaze) };
        let turn = pair([turn.heading, turn.pitch]) * weight;
        let (undone, up) = (Turn::new(turn), body.own_up(eye));
        let rest = body.frames[eye] * undone.undo(body.effector.direction);
        let mut both = bearings.angles_of_both([gaze, rest]);
        if both.y.abs() > FORWARD_STEEP_RAD || both.w.abs() > FORWARD_STEEP_RAD {
            let rest_up = body.frames[eye] * undone.undo(body.rows[eye] * up);
            let steep = |angles: Vec4, up: Vec3A| {
                if angles.y.abs() > FORWARD_STEEP_RAD { bearings.steep_angles(angles, up) } else { angles }
            };
            both = Vec4::from((steep(both, up).xy(), steep(both.zwzw(), rest_up).xy()));
        }
        let [heading, elevation, rest_heading, rest_elevation] = both.to_array();
        Self { turn, change: pair([math::wrap_pi(heading - rest_heading), elevation - rest_elevation]), rest }
    }
}

/// Returns a hash of weight and attention, to detect their changes: the upper eight bits of a product.
fn fade_of(settings: &Settings) -> u8 {
    let bits = settings.weight.to_bits() ^ settings.attention.to_bits().rotate_left(4);
    bits.wrapping_mul(0x9e37_79b1).to_be_bytes()[0]
}

/// The joints' turns in a call, assigned from the root outward. The leading joint is corrected last, by [`aim`].
struct Posture<'a, const C: usize> {
    joints: &'a mut PerJoint<Joint, C>,
    /// The correction of each joint, in its bone.
    corrections: &'a mut [Quat],
    /// The point that is looked at, with the turns of the joints assigned so far undone.
    aim_point: Vec3A,
    /// The point that the outcome is measured against, with the turns of the joints assigned so far undone.
    measured_point: Vec3A,
}

impl<const C: usize> Posture<'_, C> {
    /// Writes a joint's correction and returns its turn.
    #[cfg_attr(not(aim_small), inline(always))]
    fn correct(&mut self, body: &Body<'_, C>, joint: usize) -> Turn {
        let (info, halves) = (&body.infos()[joint], trig::halves_of(angles(&self.joints[joint])));
        let turn = turn(&info.axes, &info.planes, halves.to_array());
        self.corrections[joint] = if body.is_tilted(joint) { tilted(turn, body.tilts[joint]) } else { turn };
        Turn::of_halves(halves)
    }
}

/// The inputs and the results of one frame's movement.
struct Motion<'a, const C: usize> {
    memory: &'a mut Memory,
    /// `true` in the first frame of a natural gaze.
    is_first: bool,
    /// The angles that each joint can reach in this frame.
    reaches: &'a PerJoint<Range<'a>, C>,
    dt: f32,
    per_dt: f32,
    /// `true` if the regions come to a stop.
    stays: bool,
    /// `true` while the goal moves because weight or attention changes.
    fades: bool,
    /// `true` if every region has arrived.
    arrived: bool,
    /// The sum of the regions' distances from their goals, radians.
    lag: f32,
}

/// The goals of the regions and the eye.
#[derive(Clone, Copy)]
enum Aims<'a> {
    /// Each region's outermost forward turns to its direction, the leading joint to the point.
    At(&'a [Pair], Vec3A),
    /// The leading joint turns to the point, the regions keep their angles.
    EyeAt(Vec3A),
    /// The regions return to the animation as far as their ranges allow; the eye keeps looking at the point.
    Rest(Vec3A),
    /// Nothing moves.
    Stay,
}

/// A natural gaze in one call.
struct Gaze<'a, const C: usize> {
    rig: &'a ChainRig<'a, C>,
    body: &'a Body<'a, C>,
    /// The true kinematics of a pose that is not rigid.
    chain: Option<&'a Chain<C>>,
    ranges: &'a PerJoint<Range<'a>, C>,
    goal: &'a Goal,
    sharing: Sharing<'a>,
    /// Time out of reach after which the gaze returns to the animation, seconds.
    patience: f32,
    /// A hash of weight and attention, to detect their changes.
    fade: u8,
    bearings: &'a Bearings,
    /// See [`regions`](Self::regions).
    regions: &'a PerJoint<Region<'a>, C>,
    /// See [`count`](Self::count).
    count: usize,
    /// See [`has_eye`](Self::has_eye).
    has_eye: bool,
    glance: &'a Glance,
    /// The least and the greatest turn of the eye while the regions have room.
    customary: [Pair; 2],
    /// The point from which the target's heading and elevation are measured: the effector, moved back along the gaze to
    /// beside the joint that turns the head. The effector will look from there once the head has turned.
    pivot: Vec3A,
}

impl<'a, const C: usize> Gaze<'a, C> {
    /// Returns `true` if the leading joint is an eye, which has no inertia.
    #[cfg_attr(not(aim_small), inline(always))]
    fn has_eye(&self) -> bool {
        C == EXACT_JOINTS || self.has_eye
    }

    /// Returns the number of regions.
    #[cfg_attr(not(aim_small), inline(always))]
    fn count(&self) -> usize {
        if C == EXACT_JOINTS { C - 1 } else { self.count }
    }

    /// Returns the regions from the innermost outward, without the eye.
    #[cfg_attr(not(aim_small), inline(always))]
    fn regions(&self) -> &'a [Region<'a>] {
        &self.regions[..self.count()]
    }

    /// Moves the joints by a frame of `dt` seconds. `None` if the aim is undefined.
    #[cfg_attr(not(aim_small), inline(always))]
    fn move_joints(
        &self,
        from: &mut PerJoint<Joint, C>,
        memory: &mut Memory,
        posture: &mut Posture<'_, C>,
        dt: f32,
    ) -> Option<Fit> {
        let rig = self.rig;
        let infos = self.body.infos();
        // A NaN or negative rate does not move.
        let step = |index: usize| (infos[index].rate * dt).at_least(0.0);
        let within = |index: usize| self.ranges[index].within(angles(&posture.joints[index]), step(index));
        let reaches = rig.array_of(Range::REST, within);
        for (index, joint) in posture.joints[..self.body.first()].iter_mut().enumerate() {
            *joint = at(joint, reaches[index].towards_rest(angles(joint), step(index)));
            joint.set_destination(None);
        }
        if !(dt > LEAST_S) {
            if dt > 0.0 {
                for (joint, reach) in from.iter_mut().zip(&*reaches).skip(self.body.first()) {
                    *joint = at(joint, reach.hold(angles(joint)));
                }
            }
            let fit = match self.goal.movement {
                Movement::Aim if dt > 0.0 => self.settle(self.gaze_shift()?, from, posture, &mut { Vec4::ZERO })?.fit,
                _ => Fit::WITHIN_REACH,
            };
            self.set_joints(from, posture);
            return Some(self.fit_of_target(fit));
        }
        let is_first = memory.support == Support::None;
        if is_first {
            memory.blocked_s = 0.0;
            memory.set_head_goal(HeadGoal::default());
            for joint in from.iter_mut() {
                joint.velocity = [0.0; 2];
                joint.set_destination(None);
            }
        }
        let gives_up = memory.blocked_s > self.patience;
        let fades = memory.caution != self.fade;
        memory.caution = self.fade;
        let mut motion = Motion {
            memory,
            is_first,
            reaches: &reaches,
            dt,
            per_dt: 1.0 / dt,
            stays: false,
            fades,
            arrived: true,
            lag: 0.0,
        };
        let fit = match self.goal.movement {
            Movement::Rest => self.return_to_rest(from, &mut motion, posture)?,
            _ if gives_up && self.goal.behind => self.return_to_rest(from, &mut motion, posture)?,
            Movement::Aim => self.turn_to_goal(from, gives_up, &mut motion, posture)?,
            Movement::Stay => {
                motion.stays = true;
                self.turn_joints(Aims::Stay, from, Some(&mut motion), posture)?;
                Fit::WITHIN_REACH
            }
        };
        let fit = self.fit_of_target(fit);
        let is_out_of_reach = self.goal.behind || !fit.within_reach;
        motion.memory.blocked_s = if is_out_of_reach { motion.memory.blocked_s + dt } else { 0.0 };
        if motion.memory.support == Support::None {
            motion.memory.support = Support::Rests;
        }
        Some(fit)
    }

    #[cold]
    fn return_to_rest(
        &self,
        from: &PerJoint<Joint, C>,
        motion: &mut Motion<'_, C>,
        posture: &mut Posture<'_, C>,
    ) -> Option<Fit> {
        motion.memory.support = Support::Rests;
        self.turn_joints(Aims::Rest(self.ahead()), from, Some(motion), posture)?;
        Some(Fit::WITHIN_REACH)
    }

    #[cfg_attr(not(aim_small), inline(always))]
    fn turn_to_goal(
        &self,
        from: &PerJoint<Joint, C>,
        gives_up: bool,
        motion: &mut Motion<'_, C>,
        posture: &mut Posture<'_, C>,
    ) -> Option<Fit> {
        let sight = self.engage(from, motion)?;
        motion.stays = motion.memory.support != Support::Shares;
        // The eye alone reaches the target.
        if let Some(sight) = sight
            && motion.stays
            && sight.is_within()
        {
            let sight = self.turn_joints(Aims::EyeAt(self.goal.aim_point), from, Some(motion), posture)?;
            self.rest_if_arrived(&sight, motion);
            return Some(Fit::WITHIN_REACH);
        }
        let gaze_shift = self.gaze_shift()?;
        let mut extra = pair(motion.memory.extra_turn());
        let plain = self.allot(&gaze_shift, extra);
        let is_plain = plain.is_ok();
        let allotment = match plain {
            Ok(allotment) => allotment,
            Err(shared) if self.has_eye() => {
                self.iterate_allotment(&gaze_shift, shared, from, posture, (&mut extra, FRAME_ROUNDS))?
            }
            Err(shared) => {
                // Near the zenith, a head lacks only heading, and `extra` would accumulate it from frame to frame.
                let mut made = Vec4::ZERO;
                let allotment = self.iterate_allotment(&gaze_shift, shared, from, posture, (&mut made, ROUNDS))?;
                // If nothing helps, keep the last value, so that the next frame does not take the plain path.
                extra = if allotment.fit.within_reach || square(made) > 0.0 { made } else { extra };
                allotment
            }
        };
        if gives_up && !allotment.fit.within_reach {
            extra = Vec4::ZERO;
            self.return_to_rest(from, motion, posture)?;
        } else {
            let sight = self.turn_joints(allotment.aims(), from, Some(motion), posture)?;
            self.rest_if_arrived(&sight, motion);
            if is_plain {
                // From the next frame on, the regions have to cover what the eye lacks and their current movement will
                // not bring.
                let left = sight.excess();
                let brought = SAME_RAD + motion.lag;
                let lacks = allotment.fit.within_reach && square(left) >= brought * brought;
                extra = if lacks { left } else { Vec4::ZERO };
            }
        }
        motion.memory.set_extra_turn(to_array(extra));
        Some(allotment.fit)
    }

    /// Lets the regions rest once they have arrived and the eye is near the middle of its range.
    #[cfg_attr(not(aim_small), inline(always))]
    fn rest_if_arrived(&self, sight: &SightAngles, motion: &mut Motion<'_, C>) {
        if self.has_eye()
            && motion.arrived
            && sight.is_within()
            && sight.eccentricity(self.glance.turn) < self.sharing.release()
        {
            motion.memory.support = Support::Rests;
        }
    }

    /// Decides whether the regions take part. If they have rested so far, returns the eye's view of the goal.
    #[cfg_attr(not(aim_small), inline(always))]
    fn engage(&self, joints: &[Joint], motion: &mut Motion<'_, C>) -> Option<Option<SightAngles>> {
        let (memory, delay) = (&mut *motion.memory, self.sharing.delay());
        if !self.has_eye() {
            memory.support = Support::Shares;
            return Some(None);
        }
        let mut sight = None;
        if matches!(memory.support, Support::None | Support::Rests) {
            let now = self.sight_angles_at(joints, self.goal.aim_point)?;
            let engages = memory.support == Support::None
                || !now.is_within()
                || now.eccentricity(self.glance.turn) > self.sharing.engage();
            (memory.support, memory.wait_s) = (if engages { Support::Waits } else { Support::Rests }, delay);
            sight = Some(now);
        }
        if memory.support == Support::Waits {
            if memory.wait_s > 0.0 {
                memory.wait_s = memory.wait_s.at_most(delay) - motion.dt;
            } else {
                memory.support = Support::Shares;
            }
        }
        Some(sight)
    }

    /// Returns a point on the animated gaze at the goal's distance.
    fn ahead(&self) -> Vec3A {
        let gaze = self.body.gaze;
        gaze.origin + gaze.direction * (self.goal.aim_point - gaze.origin).length().at_least(1.0)
    }

    /// Puts the joints at their final angles for a goal, regardless of rates. `None` if the aim is undefined.
    fn snap(&self, joints: &PerJoint<Joint, C>, memory: &mut Memory, posture: &mut Posture<'_, C>) -> Option<Fit> {
        // A target on the animated effector has no direction, even if the joints could give it one.
        self.body.gaze.angle_to(self.goal.aim_point)?;
        let first = self.body.first();
        let mut found = self.rig.array(Joint::REST);
        for (index, (found, joint)) in found.iter_mut().zip(&**joints).enumerate() {
            let stays = self.goal.movement == Movement::Stay && index >= first;
            let joint = if stays { Joint::REST.turned_to(joint.heading, joint.pitch) } else { Joint::REST };
            *found = at(&joint, self.ranges[index].hold(angles(&joint)));
        }
        posture.joints[..first].copy_from_slice(&found[..first]);
        let mut after = *memory;
        after.set_extra_turn([0.0; 2]);
        after.support = Support::None;
        after.set_head_goal(HeadGoal::default());
        after.blocked_s = 0.0;
        let mut body_turn = 0.0;
        if self.goal.movement == Movement::Aim {
            let sight = self.sight_angles_at(&found, self.goal.aim_point)?;
            after.support = Support::Rests;
            if self.has_eye() && sight.is_within() && sight.eccentricity(self.glance.turn) <= self.sharing.engage() {
                found[first] = at(&found[first], sight.clamped);
            } else {
                let mut extra = Vec4::ZERO;
                body_turn = self.settle(self.gaze_shift()?, &found, posture, &mut extra)?.fit.body_turn;
                after.set_extra_turn(to_array(extra));
                found[first..].copy_from_slice(&posture.joints[first..]);
                after.support = Support::Shares;
            }
            self.hold_eye(&mut found);
            let head = &self.regions()[self.count() - 1];
            after.set_head_goal(HeadGoal {
                angles: to_array(sum(&found, head.part.ends::<C>(self.count() - 1))),
                ..HeadGoal::default()
            });
        }
        self.set_joints(&found, posture);
        *memory = after;
        // A snap is final: what it did not reach is out of reach.
        Some(self.fit_of_target(Fit { within_reach: false, body_turn }))
    }

    /// Returns the fit of the target itself if the joints aim at a substitute for it.
    fn fit_of_target(&self, fit: Fit) -> Fit {
        if self.goal.behind { Fit { body_turn: self.turn_for_behind().unwrap_or(0.0), ..fit } } else { fit }
    }

    /// Sets the joints to these angles.
    #[cold]
    fn set_joints(&self, joints: &[Joint], posture: &mut Posture<'_, C>) {
        let first = self.body.first();
        posture.joints[first..].copy_from_slice(&joints[first..]);
        posture.measured_point = self.goal.measured_point;
        for joint in (first + 1..self.body.count()).rev() {
            let turn = posture.correct(self.body, joint);
            posture.measured_point = self.body.undo_turn_at(joint, &turn, posture.measured_point);
        }
    }
}

/// Returns the joint at other angles.
#[cfg_attr(not(aim_small), inline(always))]
fn at(joint: &Joint, angles: Pair) -> Joint {
    joint.turned_to(angles.x, angles.y)
}

/// Returns the sums of headings and pitches of a part's joints, given its outermost and its innermost.
#[cfg_attr(not(aim_small), inline(always))]
fn sum(joints: &[Joint], [outer, inner]: [usize; 2]) -> Pair {
    let mut sum = angles(&joints[outer]);
    for joint in &joints[outer + 1..inner + 1] {
        sum += angles(joint);
    }
    sum
}
