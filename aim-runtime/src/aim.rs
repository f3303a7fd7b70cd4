//! [`Aim`]: one character of a derived rig; and [`dyn Rig`](Rig), which drives any rig by slices.

use core::fmt;

use glam::{Affine3A, Quat, Vec3};

use crate::rig::{ChainRig, MOST_JOINTS, PoseSlices, StateSlices};
#[cfg(not(aim_small))]
use crate::rig::{EXACT_JOINTS, LANE_JOINTS};
use crate::solve::{self, judge};
use crate::target::blend;
use crate::{AimRig, Description, Joint, Outcome, Pose, Rig, Settings, State, Target};

/// One character of a rig known at compile time: its state, 64 bytes and 24 for each joint.
///
/// ```
/// use aim_runtime::glam::{Affine3A, Quat, Vec3};
/// use aim_runtime::{Aim, Pose, Settings, Status};
/// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
/// # use turret::Turret;
///
/// let mut turret = Aim::<Turret>::new();
/// // Each frame, after the animation:
/// let pose = Pose::new([Affine3A::IDENTITY]);
/// let aimed = turret.aim(&pose, Vec3::new(1.0, 0.5, 4.0), 1.0 / 60.0, &Settings::default());
/// let mut local_rotations = [Quat::IDENTITY];
/// for (local_rotation, correction) in local_rotations.iter_mut().zip(aimed.corrections) {
///     *local_rotation *= correction;
/// }
/// assert_eq!(aimed.outcome.status, Status::RateLimited); // 3 rad/s for a sixtieth of a second
/// ```
pub struct Aim<R: AimRig> {
    /// The angles and the memory.
    pub state: State<R::Array<Joint>>,
}

/// What a call of [`Aim`] gives back.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[must_use = "the corrections are lost unless the bones are turned by them"]
#[non_exhaustive]
pub struct Aimed<A> {
    /// What became of the call.
    pub outcome: Outcome,
    /// Each joint's correction, from the effector inward: what the bone's animated local rotation is multiplied by on the
    /// right. Unit to 1e-6; the exact identity at rest.
    ///
    /// A local *rotation* may be multiplied by it where the bone's own scale mirrors no axis, or all three. With scale −1
    /// along one axis the turn is behind the mirror: about the axis mirrored, the other way round.
    pub corrections: A,
}

impl<R: AimRig> Aim<R> {
    /// A character at rest.
    #[must_use]
    pub fn new() -> Self {
        Self { state: State::new(R::array(Joint::REST)) }
    }

    /// A character with these joints: a stored state put back.
    ///
    /// ```
    /// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
    /// # use turret::Turret;
    /// use aim_runtime::{Aim, Joint};
    ///
    /// let turret = Aim::<Turret>::from_joints([Joint::from_angles(0.3, -0.1)]);
    /// assert_eq!((turret.state.joints[0].heading(), turret.state.joints[0].pitch()), (0.3, -0.1));
    /// ```
    #[must_use]
    pub fn from_joints(joints: R::Array<Joint>) -> Self {
        Self { state: State::new(joints) }
    }

    /// The joints by name.
    #[must_use]
    pub fn joints(&self) -> R {
        R::from_joints(self.state.joints)
    }

    /// Turns the character towards the target for one frame of `dt` seconds.
    ///
    /// `pose` and target are in one common space, global and not local. No angle changes by more than its joint's rate ×
    /// `dt` (a free heading modulo a full turn), and none leaves its range of motion; one found outside goes back at its
    /// rate. With `dt` zero, negative or NaN nothing moves; above 0.1 s it counts as 0.1 s. Where there is nothing to aim
    /// ([`Status::Degenerate`](crate::Status::Degenerate)) the angles hold.
    ///
    /// The target is a point, or several weighted [targets](Targets).
    ///
    /// ```
    /// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
    /// # use turret::Turret;
    /// use aim_runtime::glam::{Affine3A, Vec3};
    /// use aim_runtime::{Aim, Pose, Settings, Status, Target};
    ///
    /// let (mut turret, pose, settings) = (Aim::<Turret>::new(), Pose::new([Affine3A::IDENTITY]), Settings::default());
    /// let frames = (0..60).map(|_| turret.aim(&pose, Vec3::new(4.0, 0.0, 4.0), 1.0 / 60.0, &settings));
    /// assert_eq!(frames.last().unwrap().outcome.status, Status::Reached);
    ///
    /// // Two targets, the left one twice as important.
    /// let targets = [Target::new(Vec3::new(1.0, 0.0, 4.0), 1.0), Target::new(Vec3::new(-1.0, 0.0, 4.0), 0.5)];
    /// let aimed = turret.aim(&pose, &targets, 1.0 / 60.0, &settings);
    /// assert!(aimed.outcome.remaining > 0.0);
    /// ```
    pub fn aim<'a>(
        &mut self,
        pose: &Pose<R::Array<Affine3A>>,
        target: impl Into<Targets<'a>>,
        dt: f32,
        settings: &Settings,
    ) -> Aimed<R::Array<Quat>> {
        self.call(pose, &Call { targets: target.into(), dt: Some(dt), settings })
    }

    /// [`aim`](Self::aim), with the solvers of frames that need no search compiled into the caller for this rig alone: its
    /// constants folded, its kernel inlined. The same bits.
    ///
    /// For crowds: a frame that follows a target costs a sixth less by [`Solver::Exact`](crate::Solver::Exact) with three
    /// joints, and nearly a third less with a single joint. The program grows by some 12 kB for each rig. Other frames cost
    /// what they cost in `aim`.
    ///
    /// ```
    /// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
    /// # use turret::Turret;
    /// use aim_runtime::glam::{Affine3A, Vec3};
    /// use aim_runtime::{Aim, Pose, Settings};
    ///
    /// let (pose, settings) = (Pose::new([Affine3A::IDENTITY]), Settings::default());
    /// let mut crowd = [Aim::<Turret>::new(); 3];
    /// for turret in &mut crowd {
    ///     let mut alike = *turret;
    ///     let aimed = turret.aim_inlined(&pose, Vec3::new(0.2, 0.1, 4.0), 1.0 / 60.0, &settings);
    ///     assert_eq!(aimed, alike.aim(&pose, Vec3::new(0.2, 0.1, 4.0), 1.0 / 60.0, &settings));
    /// }
    /// ```
    #[inline]
    pub fn aim_inlined<'a>(
        &mut self,
        pose: &Pose<R::Array<Affine3A>>,
        target: impl Into<Targets<'a>>,
        dt: f32,
        settings: &Settings,
    ) -> Aimed<R::Array<Quat>> {
        let targets = target.into();
        let Targets::Point(target_ps) = targets else {
            return self.call(pose, &Call { targets, dt: Some(dt), settings });
        };
        let call = solve::Call::new(target_ps, Some(dt), settings);
        let mut corrections = R::array(Quat::IDENTITY);
        let mut state = self.state.slices();
        match solve::follow(R::RIG, R::DESCRIPTION, &mut state, &pose.slices(), &call, corrections.as_mut()) {
            Some(outcome) => Aimed { outcome, corrections },
            None => self.search(pose, target_ps, dt, settings),
        }
    }

    /// Puts the character on the target at once, whatever the rates, within the ranges of motion: for a spawn, a camera
    /// cut, scrubbing. The only jump.
    ///
    /// Starts from rest, so that the result does not depend on what came before wherever the target can be reached.
    /// Never [`RateLimited`](crate::Status::RateLimited).
    ///
    /// ```
    /// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
    /// # use turret::Turret;
    /// use aim_runtime::glam::{Affine3A, Vec3};
    /// use aim_runtime::{Aim, Pose, Settings, Status};
    ///
    /// // It appears, looking at what is beside it; from the next frame on it follows.
    /// let (mut turret, pose, settings) = (Aim::<Turret>::new(), Pose::new([Affine3A::IDENTITY]), Settings::default());
    /// let spawned = turret.snap(&pose, Vec3::new(3.0, 0.0, 0.5), &settings);
    /// assert_eq!(spawned.outcome.status, Status::Reached);
    /// let aimed = turret.aim(&pose, Vec3::new(3.0, 0.0, 0.52), 1.0 / 60.0, &settings);
    /// assert_eq!(aimed.outcome.status, Status::Reached);
    /// ```
    pub fn snap<'a>(
        &mut self,
        pose: &Pose<R::Array<Affine3A>>,
        target: impl Into<Targets<'a>>,
        settings: &Settings,
    ) -> Aimed<R::Array<Quat>> {
        self.call(pose, &Call { targets: target.into(), dt: None, settings })
    }

    /// Puts every joint at rest at once and forgets what was seen.
    ///
    /// ```
    /// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
    /// # use turret::Turret;
    /// use aim_runtime::glam::{Affine3A, Vec3};
    /// use aim_runtime::{Aim, Pose, Settings};
    ///
    /// let mut turret = Aim::<Turret>::new();
    /// let _ = turret.snap(&Pose::new([Affine3A::IDENTITY]), Vec3::X, &Settings::default());
    /// turret.reset();
    /// assert_eq!(turret, Aim::new());
    /// ```
    pub fn reset(&mut self) {
        *self = Self::new();
    }

    #[inline]
    fn call(&mut self, pose: &Pose<R::Array<Affine3A>>, call: &Call<'_>) -> Aimed<R::Array<Quat>> {
        let mut corrections = R::array(Quat::IDENTITY);
        let outcome =
            aim_slices(R::RIG, R::DESCRIPTION, self.state.slices(), &pose.slices(), call, corrections.as_mut());
        Aimed { outcome, corrections }
    }

    /// Apart, so that a followed frame that is inlined has its slices and its call in registers.
    #[inline(never)]
    fn search(
        &mut self,
        pose: &Pose<R::Array<Affine3A>>,
        target_ps: Vec3,
        dt: f32,
        settings: &Settings,
    ) -> Aimed<R::Array<Quat>> {
        let call = solve::Call::new(target_ps, Some(dt), settings);
        let mut corrections = R::array(Quat::IDENTITY);
        let mut state = self.state.slices();
        let outcome = search(R::RIG, R::DESCRIPTION, &mut state, &pose.slices(), &call, corrections.as_mut());
        Aimed { outcome, corrections }
    }
}

impl<R: AimRig> Default for Aim<R> {
    fn default() -> Self {
        Self::new()
    }
}

impl<R: AimRig> Clone for Aim<R> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<R: AimRig> Copy for Aim<R> {}

impl<R: AimRig> PartialEq for Aim<R> {
    fn eq(&self, other: &Self) -> bool {
        (self.state.joints.as_ref(), self.state.memory) == (other.state.joints.as_ref(), other.state.memory)
    }
}

impl<R: AimRig> fmt::Debug for Aim<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut angles = f.debug_map();
        for (index, joint) in self.state.joints.as_ref().iter().enumerate() {
            let [heading, pitch] = joint.angles().map(f32::to_degrees);
            angles.entry(&R::RIG.joint_name(index).unwrap_or("?"), &format_args!("{heading:.1}°, {pitch:.1}°"));
        }
        angles.finish()
    }
}

/// Stored as its [state](State) is, and read from a stored state of as many joints.
#[cfg(feature = "serde")]
mod stored {
    use core::fmt;
    use core::marker::PhantomData;

    use serde::de::{self, SeqAccess, Visitor};
    use serde::ser::SerializeSeq;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::Aim;
    use crate::{AimRig, Joint, State};

    struct Joints<A>(A);

    impl<A: AsRef<[Joint]>> Serialize for Joints<A> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            let joints = self.0.as_ref();
            let mut sequence = serializer.serialize_seq(Some(joints.len()))?;
            joints.iter().try_for_each(|joint| sequence.serialize_element(joint))?;
            sequence.end()
        }
    }

    /// The joints of a rig, read.
    struct JointsOf<R: AimRig>(R::Array<Joint>);

    struct Sequence<R>(PhantomData<R>);

    impl<'de, R: AimRig> Visitor<'de> for Sequence<R> {
        type Value = JointsOf<R>;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            write!(f, "{} joints", R::DESCRIPTION.joints().len())
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<JointsOf<R>, A::Error> {
            let mut joints = R::array(Joint::REST);
            for (index, joint) in joints.as_mut().iter_mut().enumerate() {
                *joint = sequence.next_element()?.ok_or_else(|| de::Error::invalid_length(index, &self))?;
            }
            let count = joints.as_ref().len();
            match sequence.next_element::<de::IgnoredAny>()? {
                None => Ok(JointsOf(joints)),
                Some(_) => Err(de::Error::invalid_length(count + 1, &self)),
            }
        }
    }

    impl<'de, R: AimRig> Deserialize<'de> for JointsOf<R> {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            deserializer.deserialize_seq(Sequence(PhantomData))
        }
    }

    impl<R: AimRig> Serialize for Aim<R> {
        fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
            State { joints: Joints(self.state.joints), memory: self.state.memory }.serialize(serializer)
        }
    }

    impl<'de, R: AimRig> Deserialize<'de> for Aim<R> {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            let State { joints: JointsOf::<R>(joints), memory } = State::deserialize(deserializer)?;
            Ok(Self { state: State { joints, memory } })
        }
    }
}

/// What is aimed at: a point, or several weighted ones.
///
/// Several targets are blended by their directions as the animated effector sees them (the weighted sum of unit vectors),
/// and by how near they are; their order does not matter, and where no directions cancel the blend is continuous in
/// points and weights. Weights that add up to less than 1 fade towards the animation as
/// [`Settings::weight`] does, which multiplies them. A target that is not finite, or on the effector, is left out. Where
/// directions cancel the heaviest target is aimed at, and of equals the first. No target at all is weight 0. A single
/// finite target of weight 1 is its point.
///
/// ```
/// use aim_runtime::glam::Vec3;
/// use aim_runtime::{Target, Targets};
///
/// assert_eq!(Targets::from(Vec3::X), Targets::Point(Vec3::X));
/// let faces = [Target::new(Vec3::X, 0.7), Target::new(Vec3::Z, 0.3)];
/// assert_eq!(Targets::from(&faces), Targets::Weighted(&faces));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Targets<'a> {
    /// A point, in the pose's space.
    Point(Vec3),
    /// Several points.
    Weighted(&'a [Target]),
}

impl From<Vec3> for Targets<'_> {
    fn from(point: Vec3) -> Self {
        Self::Point(point)
    }
}

impl<'a> From<&'a [Target]> for Targets<'a> {
    fn from(targets: &'a [Target]) -> Self {
        Self::Weighted(targets)
    }
}

impl<'a, const N: usize> From<&'a [Target; N]> for Targets<'a> {
    fn from(targets: &'a [Target; N]) -> Self {
        Self::Weighted(targets)
    }
}

/// A call of [`dyn Rig`](Rig).
#[derive(Clone, Copy, Debug)]
pub struct Call<'a> {
    /// What is aimed at.
    pub targets: Targets<'a>,
    /// The frame's length, seconds; `None` puts the character on the target at once, as [`Aim::snap`] does.
    pub dt: Option<f32>,
    /// How it is aimed.
    pub settings: &'a Settings,
}

impl fmt::Debug for dyn Rig + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = (0..self.description().joints.len()).map(|joint| self.joint_name(joint).unwrap_or("?"));
        f.debug_list().entries(names).finish()
    }
}

impl dyn Rig + '_ {
    /// Serves a call of [`Aim::aim`] or [`Aim::snap`] for a rig of any number of joints: moves `state` and writes the
    /// joints' corrections.
    ///
    /// `state`, `pose` and `corrections` hold one element for each joint of the rig, from the effector inward; with
    /// another number the call is [`Degenerate`](crate::Status::Degenerate) and changes nothing.
    ///
    /// ```
    /// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
    /// # use turret::Turret;
    /// use aim_runtime::glam::{Affine3A, Quat, Vec3};
    /// use aim_runtime::{Call, Joint, Pose, Rig, Settings, State, Status};
    ///
    /// // Without a heap, and without the type of the rig.
    /// let rig: &dyn Rig = &Turret;
    /// let (mut state, mut corrections) = (State::new([Joint::REST]), [Quat::IDENTITY]);
    /// let call = Call { targets: Vec3::new(0.1, 0.0, 3.0).into(), dt: Some(0.1), settings: &Settings::default() };
    /// let outcome = rig.aim(&mut state, &Pose::new([Affine3A::IDENTITY]), &call, &mut corrections);
    /// assert_eq!(outcome.status, Status::Reached);
    /// ```
    pub fn aim<J: AsMut<[Joint]>, A: AsRef<[Affine3A]>>(
        &self,
        state: &mut State<J>,
        pose: &Pose<A>,
        call: &Call<'_>,
        corrections: &mut [Quat],
    ) -> Outcome {
        aim_slices(self, &self.description(), state.slices(), &pose.slices(), call, corrections)
    }
}

/// Serves a call. What is aimed at is known to most callers when they are compiled.
#[inline(always)]
fn aim_slices(
    rig: &dyn Rig,
    description: &Description<'_>,
    state: StateSlices<'_>,
    pose: &PoseSlices<'_>,
    call: &Call<'_>,
    corrections: &mut [Quat],
) -> Outcome {
    let faded;
    let (target_ps, settings) = match call.targets {
        Targets::Point(point) => (point, call.settings),
        Targets::Weighted(targets) => {
            let (point, weight) = blend::blended(description, pose, targets, call.settings.effector);
            faded = call.settings.with_weight(call.settings.effective_weight() * weight);
            (point, &faded)
        }
    };
    // The number of joints is known, too, where the rig is.
    let aim_point = AIM_POINT.get(description.joints.len()).unwrap_or(&AIM_POINT[0]);
    aim_point(rig, description, state, pose, &solve::Call::new(target_ps, call.dt, settings), corrections)
}

type AimPoint =
    fn(&dyn Rig, &Description<'_>, StateSlices<'_>, &PoseSlices<'_>, &solve::Call<'_>, &mut [Quat]) -> Outcome;

/// [`aim_point`] by the number of joints.
#[cfg(not(aim_small))]
const AIM_POINT: [AimPoint; LANE_JOINTS + 1] = [
    aim_point::<0>,
    aim_point::<1>,
    aim_point::<2>,
    aim_point::<3>,
    aim_point::<4>,
    aim_point::<5>,
    aim_point::<6>,
    aim_point::<7>,
    aim_point::<8>,
];
#[cfg(aim_small)]
const AIM_POINT: [AimPoint; 1] = [aim_point::<0>];

/// Serves a call for one target; compiled once for all rigs of so many joints, or for all rigs where the program is to be
/// small. Where it is another number, it is searched.
#[inline(never)]
fn aim_point<const N: usize>(
    rig: &dyn Rig,
    description: &Description<'_>,
    mut state: StateSlices<'_>,
    pose: &PoseSlices<'_>,
    call: &solve::Call<'_>,
    corrections: &mut [Quat],
) -> Outcome {
    let count = if cfg!(aim_small) { description.joints.len() } else { N };
    if description.joints.len() == count
        && state.joints.len() == count
        && pose.joints.len() == count
        && corrections.len() == count
        && let Some(outcome) = solve::follow(rig, description, &mut state, pose, call, corrections)
    {
        return outcome;
    }
    search(rig, description, &mut state, pose, call, corrections)
}

/// Serves a call that [`solve::follow`] does not, for three sizes of scratch memory; for one where the program is to be small.
#[inline(never)]
fn search(
    kernels: &dyn Rig,
    description: &Description<'_>,
    state: &mut StateSlices<'_>,
    pose: &PoseSlices<'_>,
    call: &solve::Call<'_>,
    corrections: &mut [Quat],
) -> Outcome {
    let count = description.joints.len();
    if state.joints.len() != count || pose.joints.len() != count || corrections.len() != count {
        return judge::nothing_to_aim();
    }
    match count {
        #[cfg(not(aim_small))]
        EXACT_JOINTS => {
            solve::solve(&ChainRig::<EXACT_JOINTS> { kernels, description }, state, pose, call, corrections)
        }
        #[cfg(not(aim_small))]
        1..=LANE_JOINTS => {
            solve::solve(&ChainRig::<LANE_JOINTS> { kernels, description }, state, pose, call, corrections)
        }
        1..=MOST_JOINTS => {
            solve::solve(&ChainRig::<MOST_JOINTS> { kernels, description }, state, pose, call, corrections)
        }
        _ => judge::nothing_to_aim(),
    }
}
