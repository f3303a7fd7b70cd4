//! [`AimChain`]: the bones of a skeleton that a rig aims. Converts between its poses and the input and output of the
//! solvers.

use alloc::borrow::ToOwned;
use alloc::string::String;
use alloc::vec::Vec;
use core::fmt;

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3, Vec3A};
use aim_runtime::rotation::{angle, inverse, length, nearest_orthogonal, product, shortest, unit};
use aim_runtime::{Aimed, Pose, Rig};

use crate::pose::{PoseError, check_length};
use crate::skeleton::Skeleton;
use crate::transform::{Transform, made_unit};

/// Error of [`AimChain`]: the bones do not form a chain for the rig. Joints are numbered from the effector inward.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AimChainError {
    /// The list of joints is empty.
    Empty,
    /// The bone given for this joint does not exist.
    Joint(usize),
    /// No bone has any of the names that the rig declares for this joint, or several bones share a name and not exactly
    /// one of them forms a chain with the bones of the other joints.
    Names {
        /// The joint.
        joint: usize,
        /// The declared names, in order of preference.
        names: Vec<String>,
    },
    /// The bone of the next outer joint (index − 1) is not a descendant of this joint's bone.
    Order(usize),
    /// The bone given for the other eye does not exist, or is already a joint.
    OtherEye,
    /// The bone given for the trunk does not exist.
    Trunk,
    /// A held bone does not exist, is a joint, or is not a descendant of its joint; or its joint does not exist; or its
    /// carrier is not a joint further inward.
    Held,
}

impl fmt::Display for AimChainError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a chain needs a joint"),
            Self::Joint(joint) => write!(f, "there is no such bone for joint {joint}"),
            Self::Names { joint, names } if names.is_empty() => {
                write!(f, "the rig names no bone for joint {joint}; declare one, as in `bone = \"Head\"`")
            }
            Self::Names { joint, names } => {
                write!(f, "no bone, or more than one, is called {names:?}, as the rig calls that of joint {joint}")
            }
            Self::Order(joint) => {
                write!(f, "the bone of joint {} does not hang on that of joint {joint}", joint.saturating_sub(1))
            }
            Self::OtherEye => f.write_str("the other eye has no bone, or that of a joint"),
            Self::Trunk => f.write_str("the trunk has no bone"),
            Self::Held => f.write_str("a bone to be held does not exist, is a joint, or does not hang on its joint"),
        }
    }
}

impl core::error::Error for AimChainError {}

/// The bones of a skeleton that a rig aims, immutable and shared by all characters of a kind.
///
/// [`gather`](Self::gather) extracts the solvers' input from the animated pose; [`apply`](Self::apply) writes the
/// resulting corrections back into the pose.
///
/// ```
/// use aim_animation::glam::{Affine3A, Quat, Vec3};
/// use aim_animation::{AimChain, AimFrame, Bone, Corrections, Skeleton, Transform};
///
/// let head = Bone::new("head", Some(0)).with_rest(Transform::from_translation(Vec3::Y));
/// let skeleton = Skeleton::new([Bone::new("chest", None), head])?;
/// let chain = AimChain::new(&skeleton, [1])?;
/// let mut frame = chain.frame();
///
/// // Each frame, after the animation:
/// let mut local = skeleton.rest().to_vec();
/// let mut model = vec![Affine3A::IDENTITY; 2];
/// skeleton.to_model(&local, &mut model)?;
/// chain.gather(&mut frame, &mut local, &mut model)?;
/// assert_eq!(frame.pose().joints[0].translation, Vec3::Y.into());
/// // … `aim(&frame.pose(), target, dt, &settings)` gives corrections …
/// let corrections = Corrections { joints: &[Quat::from_rotation_y(0.3)], other_eye: None };
/// chain.apply(&frame, corrections, &mut local, &mut model)?;
/// assert!(local[1].rotation.angle_between(Quat::from_rotation_y(0.3)) < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct AimChain {
    skeleton: Skeleton,
    /// Bind pose of every bone, model space.
    bind: Vec<Affine3A>,
    joints: Vec<usize>,
    other_eye: Option<OtherEye>,
    held: Vec<HeldBone>,
    up: Option<Up>,
}

/// Lean of the trunk or of the innermost joint, radians (45°), up to which the standing up direction is used: the
/// character stands, walks, bends forward or sits.
const STANDS_RAD: f32 = core::f32::consts::FRAC_PI_4;
/// Lean of both, radians (75°), from which the up direction is fixed to the trunk: the character lies or hangs.
const LIES_RAD: f32 = 5.0 * core::f32::consts::FRAC_PI_6 / 2.0;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Up {
    /// Up direction of the standing character, model space.
    standing: Vec3,
    /// The bone whose lean decides whether the character stands; `None` if the direction is fixed.
    trunk: Option<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct OtherEye {
    bone: usize,
    /// `true` if the solver aims the eye, `false` if it copies joint 0's rotation.
    is_aimed: bool,
}

/// A bone below an aimed joint that moves with `carrier` instead, or keeps its animated model-space transform without
/// one.
#[derive(Clone, Copy, Debug, PartialEq)]
struct HeldBone {
    bone: usize,
    carrier: Option<usize>,
}

/// Scratch memory of one character, which carries data from [`AimChain::gather`] to [`AimChain::apply`].
///
/// Allocated once by [`AimChain::frame`]. Holds no state from one frame to the next, except for [`place`](Self::place).
#[derive(Clone, Debug, PartialEq)]
pub struct AimFrame {
    /// The character's transform from model space to the space of the targets, rigid or uniformly scaled. Set it before
    /// [`AimChain::gather`]. With the identity, targets are in model space.
    pub place: Affine3A,
    joints: Vec<Affine3A>,
    bind: Vec<Affine3A>,
    other_eye: Option<Affine3A>,
    up: Option<Vec3>,
    /// Animated transform of every bone, model space.
    animated: Vec<Affine3A>,
}

/// Corrections computed by a solver, as local rotations: one for each joint, and one for the other eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corrections<'a> {
    /// Correction of each joint, from the effector inward: [`Aimed::corrections`], or `DynAim::corrections`.
    pub joints: &'a [Quat],
    /// Correction of the other eye, if it is aimed:
    /// [`Outcome::other_eye_correction`](aim_runtime::Outcome::other_eye_correction).
    pub other_eye: Option<Quat>,
}

#[cfg(feature = "std")]
impl<'a, R: Rig> From<&'a aim_runtime::DynAim<R>> for Corrections<'a> {
    fn from(character: &'a aim_runtime::DynAim<R>) -> Self {
        Self { joints: character.corrections(), other_eye: character.other_eye_correction() }
    }
}

impl<'a, A: AsRef<[Quat]>> From<&'a Aimed<A>> for Corrections<'a> {
    fn from(aimed: &'a Aimed<A>) -> Self {
        Self { joints: aimed.corrections.as_ref(), other_eye: aimed.outcome.other_eye_correction }
    }
}

impl AimFrame {
    /// Returns the gathered pose as slices, for rigs known only at run time: `DynAim` or [`dyn Rig`](Rig).
    #[must_use]
    pub fn pose(&self) -> Pose<&[Affine3A]> {
        self.with_rest(Pose::new(&self.joints[..]).with_bind(&self.bind[..]))
    }

    /// Returns the gathered pose as arrays, for a derived rig of `N` joints; `None` if the chain does not have `N`
    /// joints.
    #[must_use]
    pub fn pose_of<const N: usize>(&self) -> Option<Pose<[Affine3A; N]>> {
        let joints = <[Affine3A; N]>::try_from(&self.joints[..]).ok()?;
        let bind = <[Affine3A; N]>::try_from(&self.bind[..]).ok()?;
        Some(self.with_rest(Pose::new(joints).with_bind(bind)))
    }

    /// Returns the transform of every bone as gathered, model space.
    #[must_use]
    pub fn model(&self) -> &[Affine3A] {
        &self.animated
    }

    fn with_rest<A>(&self, mut pose: Pose<A>) -> Pose<A> {
        (pose.up, pose.other_eye) = (self.up, self.other_eye);
        pose
    }
}

impl AimChain {
    /// Creates a chain of bones (indices into the skeleton), from the effector inward. Each must be a descendant of the
    /// next, at any depth.
    ///
    /// # Errors
    /// See [`AimChainError`].
    pub fn new(skeleton: &Skeleton, joints: impl Into<Vec<usize>>) -> Result<Self, AimChainError> {
        let joints = joints.into();
        for (joint, &bone) in joints.iter().enumerate() {
            if bone >= skeleton.len() {
                return Err(AimChainError::Joint(joint));
            }
            if joint > 0 && !is_below(skeleton, joints[joint - 1], bone) {
                return Err(AimChainError::Order(joint));
            }
        }
        if joints.is_empty() {
            return Err(AimChainError::Empty);
        }
        let bind = skeleton.rest_in_model();
        Ok(Self { skeleton: skeleton.clone(), bind, joints, other_eye: None, held: Vec::new(), up: None })
    }

    /// Creates the chain of a rig from the bone names that the rig declares, with the bones that the rig holds.
    ///
    /// - A joint without declared bone names is looked up by its own name.
    /// - A joint's first name that exactly one bone has is used. Otherwise, its first name that several bones have, and
    ///   of these bones the one that forms a chain with the other joints: a bone and the mesh that it moves often share
    ///   a name.
    /// - A held bone is skipped if its name is not the name of exactly one bone.
    ///
    /// # Errors
    /// See [`AimChainError`].
    pub fn named(skeleton: &Skeleton, rig: &dyn Rig) -> Result<Self, AimChainError> {
        let description = rig.description();
        let names = |joint: usize| {
            let declared = (0..).map_while(move |candidate| rig.bone_name(joint, candidate));
            let own = rig.bone_name(joint, 0).is_none().then(|| rig.joint_name(joint)).flatten();
            declared.chain(own)
        };
        let count = description.joints().len();
        let bones = in_a_chain(skeleton, (0..count).map(|joint| candidates(skeleton, names(joint))).collect());
        let bone = |(joint, bones): (usize, &Vec<usize>)| match bones[..] {
            [bone] => Ok(bone),
            _ => Err(AimChainError::Names { joint, names: names(joint).map(str::to_owned).collect() }),
        };
        let mut chain = Self::new(skeleton, bones.iter().enumerate().map(bone).collect::<Result<Vec<_>, _>>()?)?;
        for joint in 0..count {
            for name in (0..).map_while(|place| rig.held_bone(joint, place)) {
                if let Some(bone) = skeleton.find(name) {
                    chain = chain.with_held(bone, joint, description.carrier(joint))?;
                }
            }
        }
        Ok(chain)
    }

    /// Returns the chain on a reduced skeleton, and for each of its bones the index in the
    /// [full skeleton](Self::skeleton), in ascending order.
    ///
    /// The reduced skeleton has the joints, the other eye, the trunk, the held bones and their carriers, and all their
    /// ancestors.
    ///
    /// ```
    /// use aim_animation::{AimChain, Bone, Skeleton};
    ///
    /// let bones = [("chest", None), ("hand", Some(0)), ("head", Some(0)), ("hat", Some(2))];
    /// let skeleton = Skeleton::new(bones.map(|(name, parent)| Bone::new(name, parent)))?;
    /// let (chain, bones) = AimChain::new(&skeleton, [2])?.reduced();
    /// assert_eq!((chain.skeleton().len(), bones), (2, vec![0, 2]));
    /// assert_eq!(chain.joints(), [1]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn reduced(&self) -> (Self, Vec<usize>) {
        let trunk = self.up.and_then(|up| up.trunk);
        let eye = self.other_eye.map(|eye| eye.bone);
        let named = self.joints.iter().copied().chain(eye).chain(trunk).chain(self.held());
        let carriers = self.held.iter().filter_map(|held| held.carrier);
        let mut is_needed = alloc::vec![false; self.bind.len()];
        for bone in named.chain(carriers).flat_map(|bone| self.skeleton.ancestry(bone)) {
            is_needed[bone] = true;
        }
        let bones: Vec<usize> = (0..self.bind.len()).filter(|&bone| is_needed[bone]).collect();
        let to = |bone: usize| bones.binary_search(&bone).unwrap_or_default();
        let reduced = Self {
            skeleton: self.skeleton.part(&bones),
            bind: bones.iter().map(|&bone| self.bind[bone]).collect(),
            joints: self.joints.iter().map(|&bone| to(bone)).collect(),
            other_eye: self.other_eye.map(|eye| OtherEye { bone: to(eye.bone), ..eye }),
            held: self
                .held
                .iter()
                .map(|held| HeldBone { bone: to(held.bone), carrier: held.carrier.map(to) })
                .collect(),
            up: self.up.map(|up| Up { trunk: up.trunk.map(to), ..up }),
        };
        (reduced, bones)
    }

    /// Returns the skeleton of the chain.
    #[must_use]
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// Returns the bone of the other eye, aimed or following; `None` if the chain has no other eye.
    #[must_use]
    pub fn other_eye(&self) -> Option<usize> {
        self.other_eye.map(|eye| eye.bone)
    }

    /// Sets the bind pose, every bone in model space; by default it is the rest pose.
    ///
    /// The bind pose is the zero of limits declared from it, and the pose in which the eyes are parallel and the trunk
    /// is upright.
    ///
    /// # Errors
    /// Fails if the slice and the skeleton differ in length.
    pub fn with_bind(mut self, bind: &[Affine3A]) -> Result<Self, PoseError> {
        check_length(self.bind.len(), bind.len())?;
        self.bind.copy_from_slice(bind);
        Ok(self)
    }

    /// Adds the other eye, aimed by the solver as well: see [`Pose::with_other_eye`].
    ///
    /// [`gather`](Self::gather) first turns it parallel to joint 0, by the relation of the two in the bind pose.
    ///
    /// # Errors
    /// [`AimChainError::OtherEye`] if the bone does not exist or is a joint.
    pub fn with_other_eye(self, bone: usize) -> Result<Self, AimChainError> {
        self.with_eye(OtherEye { bone, is_aimed: true })
    }

    /// Adds the other eye, not aimed by the solver: it copies the model-space rotation of joint 0.
    ///
    /// # Errors
    /// [`AimChainError::OtherEye`] if the bone does not exist or is a joint.
    pub fn with_following_eye(self, bone: usize) -> Result<Self, AimChainError> {
        self.with_eye(OtherEye { bone, is_aimed: false })
    }

    fn with_eye(mut self, eye: OtherEye) -> Result<Self, AimChainError> {
        if eye.bone >= self.bind.len() || self.joints.contains(&eye.bone) {
            return Err(AimChainError::OtherEye);
        }
        self.other_eye = Some(eye);
        Ok(self)
    }

    /// Adds a held bone: a descendant of `joint`, at any depth, that does not follow the joint's correction, such as a
    /// clavicle below the neck.
    ///
    /// It moves with `carrier` instead, a joint further inward, as
    /// [`Description::carrier`](aim_runtime::Description::carrier) finds it. Without a carrier it keeps its animated
    /// model-space transform.
    ///
    /// # Errors
    /// [`AimChainError::Held`] if the bone does not exist, is a joint, or is not a descendant of the joint; if the
    /// joint does not exist; or if the carrier is not a joint further inward.
    pub fn with_held(mut self, bone: usize, joint: usize, carrier: Option<usize>) -> Result<Self, AimChainError> {
        let on = self.joints.get(joint).copied().ok_or(AimChainError::Held)?;
        if bone >= self.bind.len() || self.joints.contains(&bone) || !is_below(&self.skeleton, bone, on) {
            return Err(AimChainError::Held);
        }
        let carrier = match carrier {
            Some(inward) if inward <= joint => return Err(AimChainError::Held),
            Some(inward) => Some(*self.joints.get(inward).ok_or(AimChainError::Held)?),
            None => None,
        };
        self.held.push(HeldBone { bone, carrier });
        Ok(self)
    }

    /// Sets a fixed up direction of the character, model space: see [`Pose::with_up`].
    #[must_use]
    pub fn with_up(mut self, up: Vec3) -> Self {
        self.up = Some(Up { standing: up, trunk: None });
        self
    }

    /// Sets the up direction of a character that may lie down.
    ///
    /// `up` is a unit vector in model space, and `trunk` the bone whose lean is measured, the hips. While the trunk or
    /// the innermost joint leans by less than 45° from the bind pose, the up direction is `up`: hips that lean below an
    /// upright chest belong to a character that sits. If both lean by 75° or more, it is that direction fixed to the
    /// trunk. In between it changes smoothly from one to the other.
    ///
    /// # Errors
    /// [`AimChainError::Trunk`] if the bone does not exist.
    pub fn with_standing_up(mut self, up: Vec3, trunk: usize) -> Result<Self, AimChainError> {
        if trunk >= self.bind.len() {
            return Err(AimChainError::Trunk);
        }
        self.up = Some(Up { standing: up, trunk: Some(trunk) });
        Ok(self)
    }

    /// Returns the character's up direction in a model-space pose, as a vector in model space; `None` if none was set.
    #[must_use]
    pub fn up(&self, model: &[Affine3A]) -> Option<Vec3> {
        let Up { standing, trunk } = self.up?;
        let up_of = |bone: usize| {
            let frame = |at: &Affine3A| nearest_orthogonal(at.matrix3);
            Some(frame(model.get(bone)?)? * (frame(&self.bind[bone])?.transpose() * Vec3A::from(standing)))
        };
        let Some(own) = trunk.and_then(up_of) else { return Some(standing) };
        let lean_of = |up: Vec3A| angle(shortest(standing, up.into()));
        let mut lean = lean_of(own);
        if lean > STANDS_RAD
            && let Some(carrier) = self.joints.last().and_then(|joint| up_of(*joint))
        {
            lean = lean.min(lean_of(carrier));
        }
        let share = ((lean - STANDS_RAD) / (LIES_RAD - STANDS_RAD)).clamp(0.0, 1.0);
        // Smoothstep, so that the head's velocity does not jump at either threshold.
        let share = share * share * (3.0 - 2.0 * share);
        let up = Vec3A::from(standing) * (1.0 - share) + own * share;
        Some((up / length(up)).into())
    }

    /// Returns the held bones: see [`with_held`](Self::with_held).
    pub fn held(&self) -> impl Iterator<Item = usize> + '_ {
        self.held.iter().map(|held| held.bone)
    }

    /// Returns the bone of each joint, from the effector inward.
    #[must_use]
    pub fn joints(&self) -> &[usize] {
        &self.joints
    }

    /// Allocates the scratch memory of one character.
    #[must_use]
    pub fn frame(&self) -> AimFrame {
        AimFrame {
            place: Affine3A::IDENTITY,
            joints: alloc::vec![Affine3A::IDENTITY; self.joints.len()],
            bind: alloc::vec![Affine3A::IDENTITY; self.joints.len()],
            other_eye: None,
            up: None,
            animated: alloc::vec![Affine3A::IDENTITY; self.bind.len()],
        }
    }

    /// Reads the animated pose into `frame`; [`AimFrame::pose`] then returns it in the form that the solvers take.
    ///
    /// - `local` is the animated pose without earlier corrections, `model` the same pose in model space.
    /// - An aimed other eye is turned parallel to joint 0, in `local` and in `model`.
    /// - The own scale of a joint is removed from its gathered transform if it is non-uniform.
    /// - The gathered bind pose moves along with the parent of the innermost joint.
    ///
    /// # Errors
    /// Fails if a slice and the skeleton differ in length, or if `frame` has another number of bones or joints than the
    /// chain. Nothing is written then.
    pub fn gather(
        &self,
        frame: &mut AimFrame,
        local: &mut [Transform],
        model: &mut [Affine3A],
    ) -> Result<(), PoseError> {
        self.check(frame, local, model)?;
        let aimed_eye = self.other_eye.filter(|eye| eye.is_aimed);
        if let Some(eye) = aimed_eye {
            if let Some(turn) = self.parallel(eye.bone, model) {
                self.skeleton.turn_in_model(eye.bone, turn, model, local)?;
                self.skeleton.to_model_below(eye.bone, local, model)?;
            }
        }
        let joint = |bone: usize| frame.place * without_uneven_scale(&model[bone], local[bone].scale);
        frame.other_eye = aimed_eye.map(|eye| joint(eye.bone));
        for (at, &bone) in frame.joints.iter_mut().zip(&self.joints) {
            *at = joint(bone);
        }
        frame.up = self.up(model).map(|up| frame.place.transform_vector3(up));
        // The motion of the innermost joint's parent since the bind pose: model · bind⁻¹.
        let innermost = self.joints[self.joints.len() - 1];
        let carried = self.skeleton.parents()[innermost].and_then(|on| Some(model[on] * inverse(&self.bind[on])?));
        let carried = frame.place * carried.unwrap_or(Affine3A::IDENTITY);
        for (at, &bone) in frame.bind.iter_mut().zip(&self.joints) {
            *at = carried * without_uneven_scale(&self.bind[bone], self.skeleton.rest()[bone].scale);
        }
        frame.animated.copy_from_slice(model);
        Ok(())
    }

    /// Applies corrections to the pose that was [gathered](Self::gather): turns the joints and the other eye, moves
    /// held bones back, and updates `model`.
    ///
    /// Joints past the end of `corrections.joints` keep their rotation.
    ///
    /// # Errors
    /// Fails if a slice and the skeleton differ in length, or if `frame` has another number of bones or joints than the
    /// chain. Nothing is written then.
    pub fn apply(
        &self,
        frame: &AimFrame,
        corrections: Corrections<'_>,
        local: &mut [Transform],
        model: &mut [Affine3A],
    ) -> Result<(), PoseError> {
        self.check(frame, local, model)?;
        let eye = self.joints[0];
        let before = local[eye].rotation;
        for (&bone, correction) in self.joints.iter().zip(corrections.joints) {
            local[bone].turn(*correction);
        }
        self.skeleton.to_model_below(self.joints[self.joints.len() - 1], local, model)?;
        if let Some(other) = self.other_eye {
            match corrections.other_eye.filter(|_| other.is_aimed) {
                Some(correction) => local[other.bone].turn(correction),
                None => self.follow(other.bone, before, local, model),
            }
            self.skeleton.to_model_below(other.bone, local, model)?;
        }
        for held in &self.held {
            self.hold(held, frame, local, model);
            self.skeleton.to_model_below(held.bone, local, model)?;
        }
        Ok(())
    }

    /// Returns the other eye's bone, and the rotation from joint 0's bone space to that of the other eye in the bind
    /// pose.
    pub(crate) fn other_eye_in_bind(&self) -> Option<(usize, Mat3A)> {
        let bone = self.other_eye?.bone;
        let [eye, other] = [self.joints[0], bone].map(|bone| nearest_orthogonal(self.bind[bone].matrix3));
        Some((bone, other?.transpose() * eye?))
    }

    fn check(&self, frame: &AimFrame, local: &[Transform], model: &[Affine3A]) -> Result<(), PoseError> {
        let bones = self.bind.len();
        [local.len(), model.len(), frame.animated.len()].into_iter().try_for_each(|len| check_length(bones, len))?;
        check_length(self.joints.len(), frame.joints.len())
    }

    /// Returns the model-space rotation that restores the other eye's bind-pose orientation relative to joint 0; `None`
    /// if a transform involved is singular.
    fn parallel(&self, other: usize, model: &[Affine3A]) -> Option<Quat> {
        let eye = self.joints[0];
        let frame = |at: &Affine3A| nearest_orthogonal(at.matrix3);
        let since_bind = frame(&model[eye])? * frame(&self.bind[eye])?.transpose();
        rotation(&(since_bind * frame(&self.bind[other])? * frame(&model[other])?.transpose()))
    }

    /// Turns the other eye in model space by the rotation that joint 0 has made since its local rotation `before`.
    ///
    /// Uses only the orthogonal parts of the two parents' transforms, so that eyes on the same parent turn alike
    /// whatever its scale.
    fn follow(&self, other: usize, before: Quat, local: &mut [Transform], model: &[Affine3A]) {
        let eye = self.joints[0];
        let carrier = |bone: usize| match self.skeleton.parents()[bone] {
            Some(on) => nearest_orthogonal(model[on].matrix3),
            None => Some(Mat3A::IDENTITY),
        };
        let [before, after] = [before, local[eye].rotation].map(|of| Mat3A::from_quat(made_unit(of)));
        let across = carrier(other).zip(carrier(eye)).map(|(other, eye)| other.transpose() * eye);
        let turn = across.and_then(|across| rotation(&(across * after * before.transpose() * across.transpose())));
        if let Some(turn) = turn {
            local[other].rotation = made_unit(product(turn, local[other].rotation));
        }
    }

    /// Moves a held bone to its animated transform, carried along by its carrier:
    /// `carrier_now · carrier_animated⁻¹ · animated`. Does nothing if a scale of 0 makes a transform singular: a hidden
    /// bone.
    fn hold(&self, held: &HeldBone, frame: &AimFrame, local: &mut [Transform], model: &[Affine3A]) {
        let HeldBone { bone, carrier } = *held;
        let place = || {
            let carried = match carrier {
                Some(by) => model[by] * inverse(&frame.animated[by])?,
                None => Affine3A::IDENTITY,
            };
            let on = self.skeleton.parents()[bone].map_or(Some(Affine3A::IDENTITY), |on| inverse(&model[on]))?;
            let at = on * carried * frame.animated[bone];
            let Vec3 { x, y, z } = local[bone].scale.recip();
            let unscaled = Mat3A::from_cols(at.matrix3.x_axis * x, at.matrix3.y_axis * y, at.matrix3.z_axis * z);
            let rotation = rotation(&nearest_orthogonal(unscaled)?)?;
            at.translation.is_finite().then_some((at.translation, rotation))
        };
        if let Some((translation, rotation)) = place() {
            (local[bone].translation, local[bone].rotation) = (translation.into(), rotation);
        }
    }
}

/// Returns the bone of the first name that exactly one bone has, or else all bones of the first name that several bones
/// have.
fn candidates<'a>(skeleton: &'a Skeleton, names: impl Iterator<Item = &'a str>) -> Vec<usize> {
    let mut found: Vec<Vec<usize>> = names.map(|name| skeleton.named(name).collect()).collect();
    found.retain(|bones| !bones.is_empty());
    let first = found.iter().position(|bones| bones.len() == 1).unwrap_or_default();
    if found.is_empty() { Vec::new() } else { found.swap_remove(first) }
}

/// Filters each joint's candidates: first, from the innermost joint outward, to descendants of a candidate of the next
/// inner joint; then, from the effector inward, to ancestors of a candidate of the next outer joint.
///
/// A sole candidate is always kept, so that [`AimChain::new`] can report what is wrong with it.
fn in_a_chain(skeleton: &Skeleton, mut bones: Vec<Vec<usize>>) -> Vec<Vec<usize>> {
    let retain = |bones: &mut Vec<usize>, will_do: &dyn Fn(usize) -> bool| {
        if bones.len() > 1 {
            bones.retain(|&bone| will_do(bone));
        }
    };
    for joint in (1..bones.len()).rev() {
        let (outer, inner) = bones.split_at_mut(joint);
        retain(&mut outer[joint - 1], &|bone| inner[0].iter().any(|&on| is_below(skeleton, bone, on)));
    }
    for joint in 1..bones.len() {
        let (outer, inner) = bones.split_at_mut(joint);
        retain(&mut inner[0], &|bone| outer[joint - 1].iter().any(|&above| is_below(skeleton, above, bone)));
    }
    bones
}

/// Returns `true` if `bone` is a descendant of `on`, at any depth.
fn is_below(skeleton: &Skeleton, bone: usize, on: usize) -> bool {
    bone != on && skeleton.subtree(on).contains(&bone)
}

/// Returns the rotation of an orthogonal matrix; `None` if it is a reflection.
fn rotation(frame: &Mat3A) -> Option<Quat> {
    if frame.determinant() > 0.5 { unit(Quat::from_mat3a(frame)) } else { None }
}

/// Returns a bone's model-space transform without its own scale if that scale is non-uniform, so that a correction is
/// applied where the bone's rotation is. A scale that is uniform to 1e-5, or has a zero, is kept.
fn without_uneven_scale(model: &Affine3A, scale: Vec3) -> Affine3A {
    let size = scale.abs();
    let is_even = (size - Vec3::splat(size.x)).abs().max_element() <= 1e-5 * size.max_element();
    if is_even || !(size.min_element() > 0.0) {
        return *model;
    }
    let Mat3A { x_axis, y_axis, z_axis } = model.matrix3;
    let matrix3 = Mat3A::from_cols(x_axis / size.x, y_axis / size.y, z_axis / size.z);
    Affine3A { matrix3, translation: model.translation }
}
