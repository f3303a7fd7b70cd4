//! [`Reach`]: a limb of a clip that is led through points while the clip plays. the crate's `limb.rs` is the bones and how they follow,
//! `state.rs` is one character's way, `error.rs` says what is wrong with limbs and goals.

mod error;
mod state;

use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Vec3};
use aim_runtime::ik::{CcdLimit, TwoBone};
use aim_runtime::trajectory::{Ends, Outcome, Trajectory, Waypoint};

pub use error::ReachError;
pub use state::ReachState;

use crate::clip::{Clip, sample_times};
use crate::cursor::Cursor;
use crate::limb::{Limb, TipGoal};
use crate::pose::{Both, PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::Transform;

/// A point that a bone has to pass at a time of its clip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReachGoal {
    /// Local time, seconds, within the clip.
    pub at_s: f32,
    /// The point, in the space of the model at that time.
    pub target: Vec3,
    /// The weight of being off beside changes of the way (γ): infinite, as [`new`](Self::new) makes it, for a point that
    /// has to be met; 0 or less, or NaN: not at all.
    pub weight: f32,
}

impl ReachGoal {
    /// A point that has to be met.
    #[must_use]
    pub const fn new(at_s: f32, target: Vec3) -> Self {
        Self { at_s, target, weight: f32::INFINITY }
    }

    /// Met as far as this weight is worth it.
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }
}

/// Outcome of the goals; lengths are in units of the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReachOutcome {
    /// The deformation of the way, towards the goals as far as the limb reaches them.
    pub trajectory: Outcome,
    /// The largest distance of a goal from what the limb reaches at its time; 0 where it reaches all.
    pub out_of_reach: f32,
}

/// A limb of a clip whose tip is led through points: a hand that slaps wherever the other's cheek is. Immutable; shared by all
/// characters that play the clip.
///
/// The way of the tip, seen from where the limb begins, is sampled once. [`aim`](Self::aim) deforms it as a whole, as
/// [`Trajectory`] does, when the goals are known or change: before the clip is played or in the middle of it, where the new way
/// fades in. Each frame [`apply`](Self::apply) moves the tip of the animated pose by as much as the way is deformed at that
/// time, and has the limb follow. Goals that are taken away fade out: no goals are the way as it is animated.
///
/// A limb of two bones and a tip bends in closed form, in the plane of the animation; one of more bones (clavicle, upper arm,
/// forearm; a trunk) by cyclic coordinate descent. The tip keeps its orientation, bones keep their lengths.
///
/// ```
/// use aim_animation::glam::{Affine3A, Quat, Vec3};
/// use aim_animation::{Bone, Clip, Reach, ReachGoal, Skeleton, Track, Transform};
///
/// let at = |x| Transform::from_translation(Vec3::X * x);
/// let skeleton = Skeleton::new([
///     Bone::new("upper_arm", None).with_rest(Transform::from_rotation(Quat::from_rotation_z(-1.0))),
///     Bone::new("forearm", Some(0)).with_rest(Transform { rotation: Quat::from_rotation_z(1.2), ..at(0.3) }),
///     Bone::new("hand", Some(1)).with_rest(at(0.25)),
/// ])?;
/// let swing = [-1.0, 0.2, -1.0].map(Quat::from_rotation_z);
/// let slap = Clip::new("slap").with_rotation(0, Track::catmull_rom([0.0, 0.5, 1.0], swing)?);
///
/// // Once: the limb from its first joint to its tip. Once a character: its state.
/// let reach = Reach::new(&slap, &skeleton, [0, 1, 2], 60.0)?;
/// let mut state = reach.state();
/// // When the target is known, and whenever it moves:
/// let cheek = Vec3::new(0.35, 0.15, 0.2);
/// reach.aim(&mut state, &[ReachGoal::new(0.52, cheek)], 0.0)?;
///
/// // Each frame, after the animation:
/// let (mut local, mut model) = (skeleton.rest().to_vec(), [Affine3A::IDENTITY; 3]);
/// slap.sample(0.52, &mut slap.cursor(), &mut local);
/// skeleton.to_model(&local, &mut model)?;
/// state.advance(1.0 / 60.0);
/// reach.apply(&mut state, 0.52, &mut local, &mut model)?;
/// assert!(Vec3::from(model[2].translation).distance(cheek) < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Reach {
    skeleton: Skeleton,
    limb: Limb,
    /// Of the clip only what moves the limb.
    clip: Clip,
    /// At even times.
    times: Vec<f32>,
    /// The tip as animated at these times.
    points: Vec<Vec3>,
    ends: Ends,
    smoothing: f32,
}

impl Reach {
    /// Samples the way of a limb at least `rate_hz` times a second. `limb` are its joints from the first to the tip that is
    /// led, in the skeleton's order; each hangs on the one before, by any number of bones, such as twist bones, which are
    /// carried along.
    ///
    /// Goals are in the space of the model as this clip has it: where the root motion is taken out while playing, this is to
    /// be the clip [without it](crate::Motion::removed_from).
    ///
    /// # Errors
    /// See [`ReachError`].
    pub fn new(
        clip: &Clip,
        skeleton: &Skeleton,
        limb: impl Into<Vec<usize>>,
        rate_hz: f32,
    ) -> Result<Self, ReachError> {
        let length = clip.length_s();
        if !(length > 0.0 && length.is_finite() && rate_hz > 0.0 && rate_hz.is_finite()) {
            return Err(ReachError::Length);
        }
        let limb = limb.into();
        let moving = |bone: usize| limb.last().is_some_and(|&tip| skeleton.subtree(bone).contains(&tip));
        let clip = clip.clone().with_bones_mapped(|bone| moving(bone).then_some(bone));
        let mut limb = Limb::new(skeleton, limb).map_err(ReachError::from_limb)?;
        let times = sample_times(length, rate_hz);
        let mut pose = skeleton.rest().to_vec();
        let mut model = alloc::vec![Affine3A::IDENTITY; skeleton.len()];
        posed(skeleton, &clip, 0.0, (&mut pose, &mut model));
        limb.measure(&model).map_err(ReachError::from_limb)?;
        let mut points = Vec::with_capacity(times.len());
        for &time in &times {
            posed(skeleton, &clip, time, (&mut pose, &mut model));
            points.push(limb.seen(&model, limb.tip(&model)));
        }
        if points.iter().any(|point| !point.is_finite()) {
            return Err(ReachError::Place);
        }
        let smoothing = Trajectory::new(&[]).smoothing;
        Ok(Self { skeleton: skeleton.clone(), limb, clip, times, points, ends: Ends::Fixed, smoothing })
    }

    /// With what becomes of the first and the last point of the way; [`Ends::Fixed`] by default, so that the clip begins and ends
    /// as it is animated.
    #[must_use]
    pub fn with_ends(mut self, ends: Ends) -> Self {
        self.ends = ends;
        self
    }

    /// With changes spread over this part of the clip, 0…1: see [`Trajectory::smoothing`].
    #[must_use]
    pub fn with_smoothing(mut self, smoothing: f32) -> Self {
        self.smoothing = smoothing;
        self
    }

    /// With a limit of a joint of a limb of more than two bones; a hinge's axis is in the space of the joint's bone. Nothing
    /// is done if there is no such joint; a limb of two bones knows no limits.
    #[must_use]
    pub fn with_limit(mut self, joint: usize, limit: CcdLimit) -> Self {
        self.limb.set_limit(joint, limit);
        self
    }

    /// The way of the tip as it is animated, from which α and β can be [read](Trajectory::place): seen from the first joint, in
    /// lengths of the limb.
    #[must_use]
    pub fn trajectory(&self) -> Trajectory<'_> {
        Trajectory::new(&self.points).with_times(&self.times).with_ends(self.ends).with_smoothing(self.smoothing)
    }

    /// Memory for a character whose limb goes as it is animated.
    #[must_use]
    pub fn state(&self) -> ReachState {
        ReachState::new(&self.times, &self.limb)
    }

    /// Leads the tip through these goals, and through no earlier ones. The way that is shown goes over into the new one within
    /// `fade_s` seconds of [`ReachState::advance`]; at once where that is not positive and finite.
    ///
    /// A goal that the limb does not reach counts as the nearest point that it does. Does not allocate; the cost is linear in
    /// the samples of the clip.
    ///
    /// # Errors
    /// A goal outside the clip, or within a sample of another one or of an end that it is not on, or a state of another limb;
    /// then nothing changes.
    pub fn aim(&self, state: &mut ReachState, goals: &[ReachGoal], fade_s: f32) -> Result<ReachOutcome, ReachError> {
        let ReachState { times, rest, waypoints, pose, model, .. } = state;
        if times.len() != self.times.len() || check_length(self.limb.bones(), model.len()).is_err() {
            return Err(ReachError::State);
        }
        waypoints.clear();
        times.copy_from_slice(&self.times);
        rest.copy_from_slice(&self.points);
        let mut out_of_reach: f32 = 0.0;
        for (number, goal) in goals.iter().enumerate() {
            let frame = self.frame_at(goal.at_s).ok_or(ReachError::Time(number))?;
            if waypoints.iter().any(|other: &Waypoint| other.frame == frame) {
                return Err(ReachError::Together(number));
            }
            // The sample nearest to the goal is moved to its time.
            posed(&self.skeleton, &self.clip, goal.at_s, (pose, model));
            let (point, beyond) = self.limb.within_reach(model, self.limb.seen(model, goal.target));
            times[frame] = goal.at_s;
            rest[frame] = self.limb.seen(model, self.limb.tip(model));
            waypoints.push(Waypoint::new(frame, point).with_weight(goal.weight));
            out_of_reach = out_of_reach.max(beyond);
        }
        let size = f64::from(self.limb.length());
        let mut trajectory = state.deform(&self.trajectory(), fade_s);
        trajectory.missed *= size;
        trajectory.distortion *= size * size;
        Ok(ReachOutcome { trajectory, out_of_reach: out_of_reach * self.limb.length() })
    }

    /// Moves the tip of an animated pose by what the way is deformed by at a local time of the clip, times the state's weight;
    /// the limb follows. Gives the distance that the tip is then off, in units of the model: more than rounding where the limb
    /// does not reach that far.
    ///
    /// `local` and `model` are one pose, of the clip alone or of a blend with it. Of the limb rotations are changed; what has
    /// no effect changes no bit.
    ///
    /// # Errors
    /// A slice or the state has another length; then nothing is written.
    pub fn apply(
        &self,
        state: &mut ReachState,
        time_s: f32,
        local: &mut [Transform],
        model: &mut [Affine3A],
    ) -> Result<f32, PoseError> {
        let bones = self.limb.bones();
        [local.len(), model.len(), state.model.len()].into_iter().try_for_each(|len| check_length(bones, len))?;
        check_length(self.times.len(), state.times.len())?;
        let offset = state.offset(time_s) * self.limb.length();
        if !(offset != Vec3::ZERO && offset.is_finite()) {
            return Ok(0.0);
        }
        let goal = TipGoal { point: self.limb.tip(model) + offset, turn: None, two_bone: &TwoBone::new() };
        self.limb.follow(&goal, &mut state.joints, &mut Both { skeleton: &self.skeleton, local, model })
    }

    /// The sample that is moved to a time: the nearest, but the ends stay.
    fn frame_at(&self, at_s: f32) -> Option<usize> {
        let last = self.times.len() - 1;
        if !(at_s >= 0.0 && at_s <= self.times[last]) {
            return None;
        }
        let after = self.times.partition_point(|&time| time < at_s);
        if self.times[after] == at_s {
            return Some(after);
        }
        let nearest = if at_s - self.times[after - 1] < self.times[after] - at_s { after - 1 } else { after };
        (last > 1).then(|| nearest.clamp(1, last - 1))
    }
}

/// Writes the clip at a time, in local space and in that of the model.
fn posed(skeleton: &Skeleton, clip: &Clip, time_s: f32, (local, model): (&mut [Transform], &mut [Affine3A])) {
    local.copy_from_slice(skeleton.rest());
    clip.sample(time_s, &mut Cursor::default(), local);
    // Of equal lengths.
    let _ = skeleton.to_model(local, model);
}
