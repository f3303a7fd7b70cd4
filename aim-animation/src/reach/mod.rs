//! [`Reach`]: moves the tip of a limb through points while a clip plays. The crate's `limb.rs` has the bones and the
//! solver, `state.rs` the path of one character, and `error.rs` the errors of limbs and goals.

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
use crate::pose::{PoseError, PosePair, check_length};
use crate::skeleton::Skeleton;
use crate::transform::Transform;

/// A point that the tip of a limb has to pass at a time of the clip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReachGoal {
    /// Local time of the clip, seconds.
    pub at_s: f32,
    /// The point, in model space at that time.
    pub target: Vec3,
    /// Weight γ of missing the point, relative to that of changing the path. Infinite, the default of
    /// [`new`](Self::new), for a point that must be met; the goal is ignored if the weight is 0 or less, or NaN.
    pub weight: f32,
}

impl ReachGoal {
    /// A point that must be met.
    #[must_use]
    pub const fn new(at_s: f32, target: Vec3) -> Self {
        Self { at_s, target, weight: f32::INFINITY }
    }

    /// Sets the weight: a finite one trades missing the point against changing the path.
    #[must_use]
    pub const fn with_weight(mut self, weight: f32) -> Self {
        self.weight = weight;
        self
    }
}

/// Result of setting the goals; lengths are in model units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReachOutcome {
    /// The deformation of the path, towards the goals clamped to the limb's reach.
    pub trajectory: Outcome,
    /// Largest distance of a goal from the limb's reach at its time; 0 if all goals can be reached.
    pub out_of_reach: f32,
}

/// A limb of a clip whose tip is moved through points: a hand that slaps a cheek wherever it is. Immutable; shared by
/// all characters that play the clip.
///
/// The path of the tip relative to the first joint is sampled once. [`aim`](Self::aim) deforms it as a whole, as
/// [`Trajectory`] does, when the goals become known or change: before the clip is played, or in the middle of it, where
/// the new path is faded in. Each frame [`apply`](Self::apply) adds the deformation at that time to the tip of the
/// animated pose, and solves for the limb. Removed goals fade out; without goals the path is the animated one.
///
/// A limb of two bones and a tip is solved in closed form, in the plane of the animation. One with more bones
/// (clavicle, upper arm, forearm; a trunk) is solved by cyclic coordinate descent. The tip keeps its orientation, and
/// bones keep their lengths.
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
    /// The part of the clip that moves the limb.
    clip: Clip,
    /// Sample times, evenly spaced.
    times: Vec<f32>,
    /// Animated positions of the tip at these times.
    points: Vec<Vec3>,
    ends: Ends,
    smoothing: f32,
}

impl Reach {
    /// Samples the path of a limb at least `rate_hz` times a second. `limb` lists its joints from the first to the tip,
    /// in the skeleton's order. Each must be a descendant of the one before; bones in between, such as twist bones, are
    /// carried along.
    ///
    /// Goals are in model space as in this clip. If root motion is removed during playback, pass the clip [without
    /// it](crate::Motion::removed_from).
    ///
    /// # Errors
    /// See [`ReachError`] for the conditions.
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
            points.push(limb.to_limb_units(&model, limb.tip(&model)));
        }
        if points.iter().any(|point| !point.is_finite()) {
            return Err(ReachError::Place);
        }
        let smoothing = Trajectory::new(&[]).smoothing;
        Ok(Self { skeleton: skeleton.clone(), limb, clip, times, points, ends: Ends::Fixed, smoothing })
    }

    /// Sets the treatment of the first and last point of the path. The default, [`Ends::Fixed`], keeps the animated
    /// beginning and end.
    #[must_use]
    pub fn with_ends(mut self, ends: Ends) -> Self {
        self.ends = ends;
        self
    }

    /// Sets the fraction of the clip over which changes are spread, 0…1; see [`Trajectory::smoothing`].
    #[must_use]
    pub fn with_smoothing(mut self, smoothing: f32) -> Self {
        self.smoothing = smoothing;
        self
    }

    /// Sets the limit of a joint of a limb with more than two bones; a hinge's axis is in the space of the joint's
    /// bone. Does nothing if there is no such joint, or if the limb has two bones, which ignores limits.
    #[must_use]
    pub fn with_limit(mut self, joint: usize, limit: CcdLimit) -> Self {
        self.limb.set_limit(joint, limit);
        self
    }

    /// The animated path of the tip, from which α and β can be [read](Trajectory::place): relative to the first joint,
    /// in units of the limb's length.
    #[must_use]
    pub fn trajectory(&self) -> Trajectory<'_> {
        Trajectory::new(&self.points).with_times(&self.times).with_ends(self.ends).with_smoothing(self.smoothing)
    }

    /// Creates the state of a character whose limb follows the animation.
    #[must_use]
    pub fn state(&self) -> ReachState {
        ReachState::new(&self.times, &self.limb)
    }

    /// Sets the goals, which replace all earlier ones. The displayed path fades to the new one within `fade_s` seconds
    /// of [`ReachState::advance`], or changes at once if `fade_s` is not positive and finite.
    ///
    /// A goal out of reach is replaced by the nearest reachable point. Does not allocate; the cost is linear in the
    /// number of samples of the clip.
    ///
    /// # Errors
    /// A goal is outside the clip or shares its nearest sample with another goal, a clip sampled only at its ends has a
    /// goal between them, or the state belongs to another limb or clip; then the displayed path does not change.
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
            // Move the nearest sample to the time of the goal.
            posed(&self.skeleton, &self.clip, goal.at_s, (pose, model));
            let (point, beyond) = self.limb.within_reach(model, self.limb.to_limb_units(model, goal.target));
            times[frame] = goal.at_s;
            rest[frame] = self.limb.to_limb_units(model, self.limb.tip(model));
            waypoints.push(Waypoint::new(frame, point).with_weight(goal.weight));
            out_of_reach = out_of_reach.max(beyond);
        }
        let size = f64::from(self.limb.length());
        let mut trajectory = state.deform(&self.trajectory(), fade_s);
        trajectory.missed *= size;
        trajectory.distortion *= size * size;
        Ok(ReachOutcome { trajectory, out_of_reach: out_of_reach * self.limb.length() })
    }

    /// Adds the deformation of the path at a local time of the clip, times the state's weight, to the tip of an
    /// animated pose, and solves for the limb. Returns the remaining distance of the tip from that point, in model
    /// units: more than rounding if the limb does not reach it.
    ///
    /// `local` and `model` are the same pose, of the clip alone or of a blend that contains it. Of the limb, only
    /// rotations change. Without a deformation at that time, the pose is bit-identical afterwards.
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
        self.limb.follow(&goal, &mut state.joints, &mut PosePair { skeleton: &self.skeleton, local, model })
    }

    /// Returns the index of the sample to move to a time: the nearest one, except for the ends, which stay.
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

/// Evaluates the clip at a time, in local and in model space.
fn posed(skeleton: &Skeleton, clip: &Clip, time_s: f32, (local, model): (&mut [Transform], &mut [Affine3A])) {
    local.copy_from_slice(skeleton.rest());
    clip.sample(time_s, &mut Cursor::default(), local);
    // Cannot fail: the lengths are equal.
    let _ = skeleton.to_model(local, model);
}
