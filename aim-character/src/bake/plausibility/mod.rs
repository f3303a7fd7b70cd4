//! [`Plausibility`]: how a baked animation looks, in the quantities by which an animator would judge it. They are
//! measured on the written file and compared with the source clip, independently of the solver.
//!
//! `landmarks.rs` finds the bones that are judged, and `motion.rs` measures rotations over time. This file defines the
//! criteria and their limits.

mod landmarks;
mod motion;

use std::collections::VecDeque;

use aim_runtime::glam::{DAffine3, DMat3, DVec3};
use aim_runtime::{Behind, JointInfo, LimitsFrom, Rig, Role, Status};

use crate::bake::live::Live;
use crate::bake::{Baked, Plan};
use crate::error::Error;
use crate::measure::frame::orthonormal;
use crate::measure::turn_deg;
use aim_animation::Clip;
use aim_gltf::Document;
use landmarks::Landmarks;
use motion::Turning;

/// A measured quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Criterion {
    /// Heading of the head relative to the chest, of animation and correction together, degrees. If the animation alone
    /// exceeds the limit, the frame counts only if the correction turns the head further out.
    HeadToChestHeading,
    /// Roll of the head about its forward, less that of the animation, degrees.
    HeadRoll,
    /// Elevation of the gaze less that of the target, degrees. Counted where the target's elevation is within the range
    /// of eyes, neck and head: from 0.7 s after the beginning, and from 0.7 s after every change of the target's
    /// elevation by more than 10°.
    ElevationError,
    /// Heading of the gaze less that of the target, degrees. Counted where the target's heading is within the range of
    /// eyes, neck and head, from the chest's direction and from the animated gaze: from 0.7 s after the beginning, and
    /// from 1.5 s after the target or the animation jumped or the target came within reach.
    HeadingError,
    /// Distance by which hands and clavicles move beyond what the chest's own rotation moves them, as a share of the
    /// character's height.
    LimbShift,
    /// Angular speed of the head's correction relative to the chest's, degrees per second.
    HeadSpeed,
    /// Angular acceleration of the head's correction relative to the chest's, degrees per second squared.
    HeadAcceleration,
    /// Largest number of full reversals within half a second. A full reversal is a change of the acceleration of head
    /// or chest from more than half of its budget in one direction to more than half of it in the other, within 0.1 s.
    Reversals,
}

/// Report key and limits of each criterion: for humanoids, and for all other characters (`None` if unlimited).
const MUSTS: [(Criterion, &str, Option<f64>, Option<f64>); 8] = [
    (Criterion::HeadToChestHeading, "head_to_chest_heading_deg", Some(80.0), Some(130.0)),
    (Criterion::HeadRoll, "head_roll_deg", Some(15.0), Some(25.0)),
    (Criterion::ElevationError, "elevation_error_deg", Some(15.0), Some(20.0)),
    (Criterion::HeadingError, "heading_error_deg", Some(10.0), Some(15.0)),
    (Criterion::LimbShift, "limb_shift", Some(0.02), None),
    (Criterion::HeadSpeed, "head_speed_deg_s", Some(300.0), Some(420.0)),
    (Criterion::HeadAcceleration, "head_acceleration_deg_s2", Some(3000.0), None),
    (Criterion::Reversals, "reversals", Some(2.0), Some(2.0)),
];

impl Criterion {
    /// All criteria, in the order of reports.
    pub const ALL: [Self; 8] = [
        Self::HeadToChestHeading,
        Self::HeadRoll,
        Self::ElevationError,
        Self::HeadingError,
        Self::LimbShift,
        Self::HeadSpeed,
        Self::HeadAcceleration,
        Self::Reversals,
    ];

    /// Returns the key in reports; it ends in the unit.
    #[must_use]
    pub fn key(self) -> &'static str {
        MUSTS[self as usize].1
    }

    /// Returns the largest acceptable value, in the criterion's unit, for humanoids or for all other characters
    /// (animals, machines); `None` if any value is acceptable.
    #[must_use]
    pub fn must(self, is_humanoid: bool) -> Option<f64> {
        let (.., human, other) = MUSTS[self as usize];
        if is_humanoid { human } else { other }
    }
}

/// The largest value of a criterion, and the time at which it is reached.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst {
    /// Value in the criterion's unit, never negative.
    pub value: f64,
    /// Time, seconds.
    pub t: f64,
}

/// Measured quantities of one frame; `None` for those that are undefined in it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Appearance {
    /// Time, seconds.
    pub t: f64,
    /// Heading of the head relative to the chest, degrees, positive to the left; `None` if either is more than 60° off
    /// level.
    pub head_to_chest_heading_deg: Option<f64>,
    /// [`head_to_chest_heading_deg`](Self::head_to_chest_heading_deg) of the animation alone.
    pub animated_heading_deg: Option<f64>,
    /// Roll of the head, less that of the animation, degrees, positive to the left; `None` if head or chest is more
    /// than 60° off level.
    pub head_roll_deg: Option<f64>,
    /// Elevation of the gaze less that of the target, degrees, positive upwards; in every frame in which both are
    /// defined.
    pub elevation_off_deg: Option<f64>,
    /// `true` if the frame counts for [`Criterion::ElevationError`].
    pub elevation_counts: bool,
    /// Heading of the gaze less that of the target, degrees, positive to the left; `None` if either is more than 60°
    /// off level.
    pub heading_off_deg: Option<f64>,
    /// `true` if the frame counts for [`Criterion::HeadingError`].
    pub heading_counts: bool,
    /// Movement of the arms as in [`Criterion::LimbShift`], a share of the character's height.
    pub limb_shift: Option<f64>,
    /// Angular speed of the head since the previous frame, degrees per second, as in [`Criterion::HeadSpeed`].
    pub head_speed_deg_s: Option<f64>,
    /// Angular acceleration of the head at the previous frame, degrees per second squared, as in
    /// [`Criterion::HeadAcceleration`].
    pub head_acceleration_deg_s2: Option<f64>,
}

/// Measurement of how a baked animation looks.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Plausibility {
    /// `true` if the trunk below the head is upright in the bind pose and the limbs are neither wings nor forelegs.
    /// Humanoids have limits of their own.
    pub is_humanoid: bool,
    /// Measured quantities of each frame.
    pub frames: Vec<Appearance>,
    worst: [Option<Worst>; 8],
}

/// Elevation beyond which a direction has no meaningful heading, degrees.
const LEVEL_DEG: f64 = 60.0;
/// Time that a gaze is given to reach the target's elevation, seconds.
const ARRIVAL_S: f64 = 0.7;
/// Change of the target's elevation that restarts [`ARRIVAL_S`], degrees.
const CHANGE_DEG: f64 = 10.0;
/// Change of the target's heading within [`JUMP_S`] that is a jump rather than a movement to be followed, degrees.
const JUMP_DEG: f64 = 5.0;
/// Time over which changes of the target's heading are compared with [`JUMP_DEG`], seconds.
const JUMP_S: f64 = 0.1;
/// Time that head and chest are given after a jump to turn from one side to the other, seconds.
const TURN_S: f64 = 1.5;

impl Plausibility {
    /// Measures the result of baking `plan` with `rig`, as it is stored in the document `written`.
    ///
    /// # Errors
    /// Fails if the document lacks the baked clip, or if the nodes do not form a chain of the plan's document.
    pub fn measure(rig: &dyn Rig, plan: &Plan<'_>, baked: &Baked, written: &Document) -> Result<Self, Error> {
        let clip = written.clip(baked.clip.name())?;
        let source = plan.clip.map(|clip| clip.repeated(plan.seconds));
        let skeleton = plan.document.skeleton();
        let observer = Observer::new(rig, plan)?;
        let mut frames = Vec::with_capacity(baked.frames.len());
        let (mut elevation_settling, mut heading_settling) = (ElevationSettling::default(), HeadingSettling::default());
        let budgets = *rig.description().budgets();
        let mut head = Turning::new(f64::from(budgets.head.acceleration).to_degrees(), plan.fps);
        let mut chest = Turning::new(f64::from(budgets.chest.acceleration).to_degrees(), plan.fps);
        let mut seams = LoopSeams::new(plan, &observer.landmarks);
        for frame in &baked.frames {
            let animated = skeleton.world_f64(&observer.live.pose(skeleton, source.as_ref(), frame.t));
            let aimed = observer.live.pose(written.skeleton(), Some(clip), frame.t);
            let aimed = written.skeleton().world_f64(&aimed);
            let t = f64::from(frame.t);
            let mut appearance = observer.frame(t, frame.target, &animated, &aimed);
            // The gaze is not meant to reach the target at a weight below 1, after patience has run out, or under a
            // policy for targets behind that does not follow them.
            let settings = &plan.settings;
            let is_meant = settings.weight >= 1.0
                && frame.outcome.out_of_reach_for <= settings.patience
                && (frame.outcome.status != Status::Behind
                    || matches!(settings.behind, Behind::Clip | Behind::Plane | Behind::Off));
            appearance.elevation_counts &= elevation_settling
                .has_settled(t, observer.target_elevation_deg(frame.target, &animated, &aimed))
                && is_meant;
            let is_after_seam = seams.passes_seam(frame.t);
            if is_after_seam {
                heading_settling.restart();
            }
            let of_target = observer.target_heading_deg(frame.target, &animated, &aimed);
            appearance.heading_counts =
                heading_settling.has_settled(t, of_target.filter(|_| appearance.heading_counts)) && is_meant;
            if let Some([of_head, of_chest]) = observer.turns(&animated, &aimed) {
                if is_after_seam {
                    head.restart();
                    chest.restart();
                }
                head.push(t, of_head);
                chest.push(t, of_chest);
                (appearance.head_speed_deg_s, appearance.head_acceleration_deg_s2) =
                    (head.speed(), head.acceleration());
            }
            frames.push(appearance);
        }
        let reversals = observer.landmarks.chest.map(|_| {
            let [head, chest] = [head, chest].map(|turning| turning.most_reversals());
            if chest.value > head.value { chest } else { head }
        });
        let of = |pick: &dyn Fn(&Appearance) -> Option<f64>| worst(&frames, pick);
        let worst = [
            of(&|appearance| appearance.head_to_chest_heading_deg.filter(|_| observer.heading_counts(appearance))),
            of(&|appearance| appearance.head_roll_deg),
            of(&|appearance| appearance.elevation_off_deg.filter(|_| appearance.elevation_counts)),
            of(&|appearance| appearance.heading_off_deg.filter(|_| appearance.heading_counts)),
            of(&|appearance| appearance.limb_shift),
            of(&|appearance| appearance.head_speed_deg_s),
            of(&|appearance| appearance.head_acceleration_deg_s2),
            reversals,
        ];
        Ok(Self { is_humanoid: observer.landmarks.is_humanoid, frames, worst })
    }

    /// Returns the largest value of a criterion; `None` if it is undefined in all frames: no chest under a head, no
    /// arms, or no frame counts.
    #[must_use]
    pub fn worst(&self, criterion: Criterion) -> Option<Worst> {
        self.worst[criterion as usize]
    }

    /// Returns the criteria that exceed their limits, each with its worst value and its limit.
    pub fn exceeded(&self) -> impl Iterator<Item = (Criterion, Worst, f64)> + '_ {
        Criterion::ALL.into_iter().filter_map(|criterion| {
            let (worst, must) = (self.worst(criterion)?, criterion.must(self.is_humanoid)?);
            (worst.value > must).then_some((criterion, worst, must))
        })
    }
}

fn worst(frames: &[Appearance], pick: &dyn Fn(&Appearance) -> Option<f64>) -> Option<Worst> {
    let values = frames.iter().filter_map(|appearance| Some(Worst { value: pick(appearance)?.abs(), t: appearance.t }));
    // Of equal values, the first.
    values.reduce(|most, at| if at.value > most.value { at } else { most })
}

/// Tracks when the gaze has had time to reach its target's elevation.
#[derive(Default)]
struct ElevationSettling {
    /// Time of the last change of the target's elevation, and the elevation since then.
    since: Option<(f64, f64)>,
}

impl ElevationSettling {
    /// Returns `true` if the target has kept its elevation (degrees) for long enough at `t`.
    fn has_settled(&mut self, t: f64, elevation_deg: Option<f64>) -> bool {
        let Some(elevation_deg) = elevation_deg else { return false };
        if self.since.is_none_or(|(_, before)| (elevation_deg - before).abs() > CHANGE_DEG) {
            self.since = Some((t, elevation_deg));
        }
        self.since.is_some_and(|(since, _)| t - since >= ARRIVAL_S)
    }
}

/// Tracks when the gaze has had time to turn to its target.
#[derive(Default)]
struct HeadingSettling {
    /// Time from which the gaze should be on the target; `None` while the target is out of reach.
    from: Option<f64>,
    has_begun: bool,
    /// Times and headings of the target during the last [`JUMP_S`].
    recent: VecDeque<(f64, f64)>,
}

impl HeadingSettling {
    /// Forgets the past, at a jump of the animation.
    fn restart(&mut self) {
        self.from = None;
        self.recent.clear();
    }

    /// Returns `true` if the target has been within reach for long enough at `t` without a jump. `heading_deg` is
    /// `None` if it is out of reach.
    fn has_settled(&mut self, t: f64, heading_deg: Option<f64>) -> bool {
        let begins = !core::mem::replace(&mut self.has_begun, true);
        let Some(heading_deg) = heading_deg else {
            self.restart();
            return false;
        };
        self.recent.push_back((t, heading_deg));
        while self.recent.front().is_some_and(|(at, _)| t - at > JUMP_S + 1e-6) {
            self.recent.pop_front();
        }
        let jumps = self.recent.iter().any(|(_, before)| wrapped(heading_deg - before).abs() > JUMP_DEG);
        if jumps {
            self.from = Some(t + TURN_S);
        }
        let from = *self.from.get_or_insert(t + if begins { ARRIVAL_S } else { TURN_S });
        t >= from
    }
}

/// The times at which a repeated clip jumps from its end to its beginning. No speed is measured across them.
struct LoopSeams {
    /// Length of the clip, seconds, if it jumps; otherwise `None`.
    period: Option<f32>,
    round: f32,
}

impl LoopSeams {
    /// Least rotation of head or chest that is a jump, degrees.
    const JUMP_DEG: f64 = 2.0;

    fn new(plan: &Plan<'_>, landmarks: &Landmarks) -> Self {
        let skeleton = plan.document.skeleton();
        let jumps = |clip: &&Clip| {
            let [begin, end] = [0.0, clip.length_s()].map(|t| skeleton.world_f64(&skeleton.pose(clip, t)));
            let nodes = landmarks.head.into_iter().chain(landmarks.chest);
            nodes.into_iter().any(|node| turn_deg(&begin[node], &end[node]) > Self::JUMP_DEG)
        };
        let period = plan.clip.filter(|clip| clip.length_s() > 0.0).filter(jumps).map(Clip::length_s);
        Self { period, round: 0.0 }
    }

    /// Returns `true` if the animation has jumped between the previous frame and the one at `t`.
    fn passes_seam(&mut self, t: f32) -> bool {
        /// Tolerance, in rounds: a key on the seam belongs to the previous round.
        const NEAR: f32 = 1e-4;
        let round = self.period.map_or(0.0, |period| (t / period - NEAR).floor());
        core::mem::replace(&mut self.round, round) < round
    }
}

/// Inputs of the measurements of every frame: bones, directions and the ranges of the gaze.
struct Observer<'a> {
    landmarks: Landmarks,
    live: Live,
    effector: usize,
    bind: &'a [DAffine3],
    forward: DVec3,
    left: DVec3,
    height: f64,
    /// Least and largest correction of the gaze's elevation by eyes, neck and head, degrees.
    range_deg: [f64; 2],
    /// Least and largest elevation of the gaze relative to the chest, of animation and correction together, degrees.
    budget_deg: [f64; 2],
    /// Least and largest correction of the gaze's heading by eyes, neck and head, degrees.
    heading_range_deg: [f64; 2],
    /// Least and largest heading of the gaze relative to the chest, of animation and correction together, degrees.
    heading_budget_deg: [f64; 2],
    /// `true` if ranges are counted from the bind pose, hence from the chest's direction rather than the animated gaze.
    from_bind: bool,
}

impl<'a> Observer<'a> {
    fn new(rig: &dyn Rig, plan: &Plan<'a>) -> Result<Self, Error> {
        let measurement = plan.measurement;
        let description = rig.description();
        let joints = description.joints();
        let has_roles = joints.iter().any(|joint| joint.role != Role::None);
        let effector = plan.settings.effector.min(joints.len().saturating_sub(1));
        // Summed ranges of the joints that look, and the head region's budget plus the ranges of the eyes.
        let room = |angle: fn(&JointInfo) -> Option<[f32; 2]>, head: [f32; 2]| {
            let sum = |counts: &dyn Fn(Role) -> bool| {
                // Joints nearer the effector than the aimed one are at rest.
                let ranges = joints[effector..].iter().filter(|joint| counts(joint.role)).filter_map(angle);
                ranges.fold([0.0_f64; 2], |[lo, hi], range| [lo + f64::from(range[0]), hi + f64::from(range[1])])
            };
            let eyes = sum(&|role| role == Role::Eye);
            let range = sum(&|role| !has_roles || matches!(role, Role::Eye | Role::Head | Role::Neck));
            let budget = if has_roles {
                [eyes[0] + f64::from(head[0]), eyes[1] + f64::from(head[1])]
            } else {
                [f64::NEG_INFINITY, f64::INFINITY]
            };
            [range, budget].map(|ends| ends.map(f64::to_degrees))
        };
        let budgets = description.budgets();
        let [range_deg, budget_deg] = room(|joint| joint.pitch, budgets.head.pitch);
        let [heading_range_deg, heading_budget_deg] = room(|joint| joint.heading, budgets.head.heading);
        Ok(Self {
            landmarks: Landmarks::find(rig, plan),
            live: Live::new(rig, plan.document, measurement, plan.chain, plan.both_eyes)?,
            effector,
            bind: &measurement.bind_world,
            forward: measurement.forward,
            left: measurement.left,
            height: measurement.height,
            range_deg,
            budget_deg,
            heading_range_deg,
            heading_budget_deg,
            from_bind: joints.iter().any(|joint| joint.limits_from == LimitsFrom::BindPose),
        })
    }

    /// Returns the rotation of a node from its bind pose, in world space.
    fn turn_from_bind(&self, world: &[DAffine3], node: usize) -> DMat3 {
        orthonormal(&world[node].matrix3).0 * orthonormal(&self.bind[node].matrix3).0.transpose()
    }

    /// Returns the rotation that the correction adds to the head relative to the chest, and the one that it adds to the
    /// chest in the chest's animated frame. The latter stays constant if the correction only moves with the animation.
    fn turns(&self, animated: &[DAffine3], aimed: &[DAffine3]) -> Option<[DMat3; 2]> {
        let nodes = [self.landmarks.head?, self.landmarks.chest?];
        let [[head_before, chest_before], [head, chest]] =
            [animated, aimed].map(|world| nodes.map(|node| orthonormal(&world[node].matrix3).0));
        // Remove the chest's correction, which carries the head along.
        let of_head = chest_before * chest.transpose() * head * head_before.transpose();
        Some([of_head, chest_before.transpose() * chest])
    }

    /// Returns `true` if the head's heading is due to the correction: the animation alone is within the limit, or less
    /// far out.
    fn heading_counts(&self, appearance: &Appearance) -> bool {
        /// Smallest visible difference, degrees.
        const SEEN_DEG: f64 = 0.5;
        let must = Criterion::HeadToChestHeading.must(self.landmarks.is_humanoid).unwrap_or(f64::INFINITY);
        let headings = appearance.head_to_chest_heading_deg.zip(appearance.animated_heading_deg);
        headings.is_some_and(|(aimed, animated)| animated.abs() <= must || aimed.abs() > animated.abs() + SEEN_DEG)
    }

    /// Returns the elevation of the target as seen from the aimed effector, degrees.
    fn target_elevation_deg(&self, target: DVec3, animated: &[DAffine3], aimed: &[DAffine3]) -> Option<f64> {
        let [eye, _] = *self.live.gazes(self.effector, aimed).first()?;
        elevation_deg(target - eye, self.live.up(animated))
    }

    /// Returns the heading of the target as seen from the aimed effector, degrees; `None` if it is nearly above or
    /// below.
    fn target_heading_deg(&self, target: DVec3, animated: &[DAffine3], aimed: &[DAffine3]) -> Option<f64> {
        let [eye, _] = *self.live.gazes(self.effector, aimed).first()?;
        self.level_heading_deg(target - eye, self.live.up(animated))
    }

    /// Returns the heading of a direction; `None` if it points nearly up or down.
    fn level_heading_deg(&self, v: DVec3, up: DVec3) -> Option<f64> {
        elevation_deg(v, up).filter(|at| at.abs() <= LEVEL_DEG)?;
        Some(heading_deg(v, up, self.forward))
    }

    fn frame(&self, t: f64, target: DVec3, animated: &[DAffine3], aimed: &[DAffine3]) -> Appearance {
        let up = self.live.up(animated);
        let mut appearance = Appearance { t, ..Appearance::default() };
        let gaze = |world| self.live.gazes(self.effector, world).first().map(|[_, gaze]| *gaze);
        let of_gaze = gaze(aimed).and_then(|gaze| elevation_deg(gaze, up));
        let of_target = self.target_elevation_deg(target, animated, aimed);
        appearance.elevation_off_deg = of_gaze.zip(of_target).map(|(gaze, target)| gaze - target);
        let of_chest = self
            .landmarks
            .chest
            .and_then(|chest| elevation_deg(self.turn_from_bind(animated, chest) * self.forward, up));
        let of_animation = gaze(animated).and_then(|gaze| elevation_deg(gaze, up));
        appearance.elevation_counts = of_target.zip(of_animation).is_some_and(|(target, animation)| {
            let chest = of_chest.unwrap_or(0.0);
            let is_within = |[lo, hi]: [f64; 2], from: f64| (lo..=hi).contains(&(target - from));
            is_within(self.range_deg, if self.from_bind { chest } else { animation })
                && is_within(self.budget_deg, chest)
        });
        let heading = |v: DVec3| self.level_heading_deg(v, up);
        let of_gaze = gaze(aimed).and_then(heading);
        let of_target = self.target_heading_deg(target, animated, aimed);
        appearance.heading_off_deg = of_gaze.zip(of_target).map(|(gaze, target)| wrapped(gaze - target));
        let of_animation = gaze(animated).and_then(heading);
        appearance.heading_counts = of_target.zip(of_animation).is_some_and(|(target, animation)| {
            let chest = self.landmarks.chest.map(|chest| heading(self.turn_from_bind(aimed, chest) * self.forward));
            // Without a chest direction, the animation alone decides what is within reach.
            let chest = chest.flatten().unwrap_or(animation);
            let is_within = |[lo, hi]: [f64; 2], from: f64| (lo..=hi).contains(&wrapped(target - from));
            is_within(self.heading_range_deg, if self.from_bind { chest } else { animation })
                && is_within(self.heading_budget_deg, chest)
                && is_within(self.heading_budget_deg, animation)
        });
        let (Some(head), Some(chest)) = (self.landmarks.head, self.landmarks.chest) else { return appearance };
        let [head_turn, chest_turn, before, chest_before] =
            [(aimed, head), (aimed, chest), (animated, head), (animated, chest)]
                .map(|(world, node)| self.turn_from_bind(world, node));
        let is_level = |turn: &DMat3| elevation_deg(*turn * self.forward, up).is_some_and(|at| at.abs() <= LEVEL_DEG);
        if [head_turn, chest_turn, before, chest_before].iter().all(is_level) {
            let heading = |turn: DMat3| heading_deg(turn * self.forward, up, self.forward);
            let roll = |turn: DMat3| roll_deg(turn * self.forward, turn * self.left, up);
            appearance.head_to_chest_heading_deg = Some(wrapped(heading(head_turn) - heading(chest_turn)));
            appearance.animated_heading_deg = Some(wrapped(heading(before) - heading(chest_before)));
            appearance.head_roll_deg = Some(wrapped(roll(head_turn) - roll(before)));
        }
        if self.height > 0.0 {
            let carried = aimed[chest] * animated[chest].inverse();
            let moved =
                self.landmarks.limbs.iter().map(|&node| {
                    aimed[node].translation.distance(carried.transform_point3(animated[node].translation))
                });
            let moved = moved.filter(|moved| moved.is_finite());
            appearance.limb_shift = moved.reduce(f64::max).map(|moved| moved / self.height);
        }
        appearance
    }
}

/// Returns the elevation of a direction, degrees above level; `None` for the zero vector.
fn elevation_deg(v: DVec3, up: DVec3) -> Option<f64> {
    let v = v.try_normalize()?;
    Some(v.dot(up).clamp(-1.0, 1.0).asin().to_degrees())
}

/// Returns the heading about `up`, degrees, from `forward`, positive to the left.
fn heading_deg(v: DVec3, up: DVec3, forward: DVec3) -> f64 {
    let left = up.cross(forward);
    v.dot(left).atan2(v.dot(left.cross(up))).to_degrees()
}

/// Returns the roll about `forward`, degrees: the elevation of `left`, negated, so that a head tilted to its left is
/// positive.
fn roll_deg(forward: DVec3, left: DVec3, up: DVec3) -> f64 {
    let level = up.cross(forward).normalize_or_zero();
    -left.dot(forward.cross(level)).atan2(left.dot(level)).to_degrees()
}

/// Wraps an angle to −180…180°.
fn wrapped(angle_deg: f64) -> f64 {
    angle_deg - 360.0 * (angle_deg / 360.0).round()
}
