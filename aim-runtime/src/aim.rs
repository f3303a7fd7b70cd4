//! [`Aim`], one character of a derived rig, and the methods of [`dyn Rig`](Rig), which drive any rig through slices.

use core::fmt;

use glam::{Affine3A, Quat, Vec3};

use crate::rig::{ChainRig, MOST_JOINTS, PoseSlices, StateSlices};
#[cfg(not(aim_small))]
use crate::rig::{EXACT_JOINTS, LANE_JOINTS};
use crate::solve::{self, judge};
use crate::target::blend;
use crate::{AimRig, Description, Joint, Outcome, Pose, Rig, Settings, State, Target};

/// One character of a rig known at compile time. Holds the character's state: 64 bytes, plus 24 for each joint.
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
    /// The joint angles, and the memory kept between frames.
    pub state: State<R::Array<Joint>>,
}

/// Result of a call of [`Aim`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[must_use = "the corrections are lost unless the bones are turned by them"]
#[non_exhaustive]
pub struct Aimed<A> {
    /// The measured result: status and remaining angle.
    pub outcome: Outcome,
    /// Correction of each joint, from the effector inward: multiply the bone's animated local rotation by it on the
    /// right. Unit to 1e-6; exactly the identity at rest.
    ///
    /// A correction may be multiplied onto the local *rotation* alone if the bone's own scale mirrors no axis or all
    /// three. If it mirrors one or two, multiply the whole local transform instead; as a local rotation the correction
    /// is then `S · correction · S⁻¹`, with S the diagonal matrix of the scale's signs.
    pub corrections: A,
}

impl<R: AimRig> Aim<R> {
    /// Creates a character at rest.
    #[must_use]
    pub fn new() -> Self {
        Self { state: State::new(R::array(Joint::REST)) }
    }

    /// Creates a character from joint states, for example to restore stored angles.
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

    /// Returns the joint states by name.
    #[must_use]
    pub fn joints(&self) -> R {
        R::from_joints(self.state.joints)
    }

    /// Turns the character towards the target for one frame of `dt` seconds.
    ///
    /// `pose` and `target` are in the same space, and the pose holds global transforms, not local ones. The target is a
    /// point, or several weighted [targets](Targets).
    ///
    /// - No angle changes by more than its joint's rate × `dt` (a free heading: modulo a full turn).
    /// - No angle leaves its range of motion. An angle that is already outside returns at its joint's rate.
    /// - If `dt` is zero, negative or NaN, nothing moves. Values above 0.1 s are clamped to 0.1 s.
    /// - If the call is [`Status::Degenerate`](crate::Status::Degenerate), the angles stay as they are.
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

    /// Same as [`aim`](Self::aim), but the solvers for frames that need no search are compiled into the caller for this
    /// rig, with its constants folded and its kernel inlined. The results are bit-identical.
    ///
    /// Intended for crowds. With [`Solver::Exact`](crate::Solver::Exact), a frame that follows a target costs a sixth
    /// less with three joints and nearly a third less with a single joint. Other frames cost the same as with `aim`.
    /// Each rig adds about 12 kB to the program.
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

    /// Puts the character on the target at once, within the ranges of motion but regardless of rates: for a spawn, a
    /// camera cut or scrubbing. The only call that moves joints discontinuously, together with [`reset`](Self::reset).
    ///
    /// The search starts from rest, so the result does not depend on earlier frames if the target can be reached. The
    /// status is never [`RateLimited`](crate::Status::RateLimited).
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

    /// Returns every joint to rest at once and clears the memory.
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

    /// Kept out of line so that the inlined path of `aim_inlined` has its slices and its call in registers.
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

/// Serialises [`Aim`] as its [state](State). Deserialisation requires exactly the rig's number of joints.
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

    /// Deserialised joint states of a rig.
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

/// Target of a call: a point, or several weighted points.
///
/// Several targets are blended: the direction is the weighted sum of the unit directions from the animated effector,
/// and the distance is the weighted harmonic mean. The order of the targets does not matter, and the blend is
/// continuous in points and weights except where directions cancel. In detail:
///
/// - If the weights add up to less than 1, the gaze fades towards the animation; the sum multiplies
///   [`Settings::weight`].
/// - A target that is not finite, or at the effector, is ignored.
/// - If the directions cancel, the heaviest target is aimed at, or the first of several with equal weight.
/// - Without targets, the weight is 0.
/// - A single finite target of weight 1 is equivalent to its point.
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
    /// Several weighted points, in the pose's space.
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

/// Input of a call of [`dyn Rig`](Rig), apart from state and pose.
#[derive(Clone, Copy, Debug)]
pub struct Call<'a> {
    /// The point or points to aim at.
    pub targets: Targets<'a>,
    /// Frame time in seconds. `None` puts the character on the target at once, as [`Aim::snap`] does.
    pub dt: Option<f32>,
    /// The settings of this call.
    pub settings: &'a Settings,
}

impl fmt::Debug for dyn Rig + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = (0..self.description().joints.len()).map(|joint| self.joint_name(joint).unwrap_or("?"));
        f.debug_list().entries(names).finish()
    }
}

impl dyn Rig + '_ {
    /// Performs [`Aim::aim`], or [`Aim::snap`] if [`Call::dt`] is `None`, for a rig of any number of joints: updates
    /// `state` and writes the joints' corrections.
    ///
    /// `state`, `pose` and `corrections` must hold one element for each joint of the rig, from the effector inward.
    /// Otherwise the call is [`Degenerate`](crate::Status::Degenerate) and changes nothing.
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

/// Resolves the targets of a call and runs it. Inlined because most callers know the variant of [`Targets`] at compile
/// time.
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
    // For a derived rig the number of joints is a constant, so this lookup is resolved at compile time.
    let aim_point = AIM_POINT.get(description.joints.len()).unwrap_or(&AIM_POINT[0]);
    aim_point(rig, description, state, pose, &solve::Call::new(target_ps, call.dt, settings), corrections)
}

type AimPoint =
    fn(&dyn Rig, &Description<'_>, StateSlices<'_>, &PoseSlices<'_>, &solve::Call<'_>, &mut [Quat]) -> Outcome;

/// Instances of [`aim_point`], indexed by the number of joints; index 0 serves any other number.
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

/// Runs a call for one target. Compiled once per number of joints `N` and shared by all rigs of that size, or once for
/// all rigs with `aim_small`. Rigs with another number of joints always take the general search.
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

/// Runs a call that [`solve::follow`] does not handle. Compiled for three sizes of scratch memory, or one with
/// `aim_small`.
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
        EXACT_JOINTS if solve::has_known_layout(description, call.settings) => {
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
