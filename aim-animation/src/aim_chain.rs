//! [`AimChain`]: the bones that a rig aims, between an animated pose and an aimed one.

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

/// Why bones are no chain of a rig. Joints are counted from the effector inward.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AimChainError {
    /// There is no joint.
    Empty,
    /// There is no such bone for this joint.
    Joint(usize),
    /// None of the names that the rig declares for this joint is the name of a bone, or of several bones more than one makes a chain
    /// with those of the other joints.
    Names {
        /// The joint.
        joint: usize,
        /// The names, best first.
        names: Vec<String>,
    },
    /// The bone of the joint before this one does not hang on this one's.
    Order(usize),
    /// There is no such bone for the other eye, or it is a joint.
    OtherEye,
    /// There is no such bone for the trunk.
    Trunk,
    /// There is no such bone to hold, or it is a joint, or it does not hang on its joint.
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

/// The bones of a skeleton that a rig aims; shared by all characters of a kind. [`gather`](Self::gather) leads from the animated
/// pose to what the solvers take, [`apply`](Self::apply) from their corrections to the pose.
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
    /// Every bone in the bind pose, in the space of the model.
    bind: Vec<Affine3A>,
    joints: Vec<usize>,
    other_eye: Option<OtherEye>,
    held: Vec<Held>,
    up: Option<Up>,
}

/// Up to this lean of the trunk what is up for a character that stands is its up: it stands, walks, or bends forward.
const STANDS_RAD: f32 = core::f32::consts::FRAC_PI_4;
/// From this lean on (75°) it lies or hangs, and its up is that of its trunk.
const LIES_RAD: f32 = 5.0 * core::f32::consts::FRAC_PI_6 / 2.0;

#[derive(Clone, Copy, Debug, PartialEq)]
struct Up {
    /// Of a character that stands, in the space of the model.
    standing: Vec3,
    /// The bone that tells how it stands.
    trunk: Option<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct OtherEye {
    bone: usize,
    /// Aimed itself; else it turns as joint 0 does.
    is_aimed: bool,
}

/// A bone that stays with what carries the joint that it hangs on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Held {
    bone: usize,
    carrier: Option<usize>,
}

/// One character's memory between [`AimChain::gather`] and [`AimChain::apply`]: made once by [`AimChain::frame`]. It keeps nothing
/// from frame to frame.
#[derive(Clone, Debug, PartialEq)]
pub struct AimFrame {
    /// The character's place in the space of the targets, set before [`AimChain::gather`]: rigid, or uniformly scaled. The identity
    /// aims in the space of the model.
    pub place: Affine3A,
    joints: Vec<Affine3A>,
    bind: Vec<Affine3A>,
    other_eye: Option<Affine3A>,
    up: Option<Vec3>,
    /// Every bone in the space of the model, animated.
    animated: Vec<Affine3A>,
}

/// A solver's result: the correction of each joint, from the effector inward, and of the other eye.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corrections<'a> {
    /// Of each joint: [`Aimed::corrections`], or those of a `DynAim`.
    pub joints: &'a [Quat],
    /// Of the other eye: [`Outcome::other_eye_correction`](aim_runtime::Outcome::other_eye_correction).
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
    /// The pose for rigs known at run time: `DynAim`, or [`dyn Rig`](Rig) by slices.
    #[must_use]
    pub fn pose(&self) -> Pose<&[Affine3A]> {
        self.with_rest(Pose::new(&self.joints[..]).with_bind(&self.bind[..]))
    }

    /// The pose for a derived rig of `N` joints: `None` if the chain has another number.
    #[must_use]
    pub fn pose_of<const N: usize>(&self) -> Option<Pose<[Affine3A; N]>> {
        let joints = <[Affine3A; N]>::try_from(&self.joints[..]).ok()?;
        let bind = <[Affine3A; N]>::try_from(&self.bind[..]).ok()?;
        Some(self.with_rest(Pose::new(joints).with_bind(bind)))
    }

    /// Every bone in the space of the model, as it was gathered.
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
    /// A chain of these bones, from the effector inward, in the skeleton's order; each hangs on the next, by any number of bones.
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

    /// The chain of a rig by the names that it declares for its bones, with the bones that the rig holds. A joint's own name counts
    /// where the rig declares none. A name that one bone has goes before one that several have; of these the one counts that makes a
    /// chain with the bones of the other joints: a bone and the mesh that it moves often share their name.
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

    /// The same chain on the fewest bones: those that are aimed, held or tell how the character stands, and what they hang on. Beside it
    /// each bone's number in the [whole skeleton](Self::skeleton), in ascending order.
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
            held: self.held.iter().map(|held| Held { bone: to(held.bone), carrier: held.carrier.map(to) }).collect(),
            up: self.up.map(|up| Up { trunk: up.trunk.map(to), ..up }),
        };
        (reduced, bones)
    }

    /// The skeleton.
    #[must_use]
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// The bone of the other eye, aimed or following; `None` where there is none.
    #[must_use]
    pub fn other_eye(&self) -> Option<usize> {
        self.other_eye.map(|eye| eye.bone)
    }

    /// With another bind pose than the rest pose, every bone in the space of the model: ranges from the bind pose count from it,
    /// and in it the eyes are parallel and the trunk upright.
    ///
    /// # Errors
    /// A slice of another length than the skeleton.
    pub fn with_bind(mut self, bind: &[Affine3A]) -> Result<Self, PoseError> {
        check_length(self.bind.len(), bind.len())?;
        self.bind.copy_from_slice(bind);
        Ok(self)
    }

    /// With the other eye, aimed too: see [`Pose::with_other_eye`]. It is first turned parallel to joint 0, as both are in the bind
    /// pose.
    ///
    /// # Errors
    /// There is no such bone, or it is a joint.
    pub fn with_other_eye(self, bone: usize) -> Result<Self, AimChainError> {
        self.with_eye(OtherEye { bone, is_aimed: true })
    }

    /// With an eye that is not aimed itself: it turns in the space of the model as joint 0 does.
    ///
    /// # Errors
    /// There is no such bone, or it is a joint.
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

    /// With a bone that hangs on a joint, by any number of bones, and stays with another joint farther in, the
    /// [carrier](aim_runtime::Description::carrier): a clavicle on a neck that turns. Without a carrier it stays as it is animated.
    ///
    /// # Errors
    /// There is no such bone, it is a joint, or does not hang on the joint; or the carrier is not farther in.
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
        self.held.push(Held { bone, carrier });
        Ok(self)
    }

    /// With the direction that is up for the character, in the space of the model: see [`Pose::with_up`].
    #[must_use]
    pub fn with_up(mut self, up: Vec3) -> Self {
        self.up = Some(Up { standing: up, trunk: None });
        self
    }

    /// With the up of a character that may lie down: `up`, a unit vector in the space of the model, as long as `trunk`, its hips,
    /// leans by less than 45° from the bind pose, from 75° on the same direction fixed to the trunk, and between them from the one
    /// to the other without a jump.
    ///
    /// # Errors
    /// There is no such bone.
    pub fn with_standing_up(mut self, up: Vec3, trunk: usize) -> Result<Self, AimChainError> {
        if trunk >= self.bind.len() {
            return Err(AimChainError::Trunk);
        }
        self.up = Some(Up { standing: up, trunk: Some(trunk) });
        Ok(self)
    }

    /// The character's up in a pose in the space of the model; `None` unless one was given.
    #[must_use]
    pub fn up(&self, model: &[Affine3A]) -> Option<Vec3> {
        let Up { standing, trunk } = self.up?;
        let own = trunk.and_then(|trunk| {
            let frame = |at: &Affine3A| nearest_orthogonal(at.matrix3);
            Some(frame(model.get(trunk)?)? * (frame(&self.bind[trunk])?.transpose() * Vec3A::from(standing)))
        });
        let Some(own) = own else { return Some(standing) };
        let lean = angle(shortest(standing, own.into()));
        let share = ((lean - STANDS_RAD) / (LIES_RAD - STANDS_RAD)).clamp(0.0, 1.0);
        // Smoothstep: no kink in the head's motion.
        let share = share * share * (3.0 - 2.0 * share);
        let up = Vec3A::from(standing) * (1.0 - share) + own * share;
        Some((up / length(up)).into())
    }

    /// The bones that are held: see [`with_held`](Self::with_held).
    pub fn held(&self) -> impl Iterator<Item = usize> + '_ {
        self.held.iter().map(|held| held.bone)
    }

    /// The bone of each joint, from the effector inward.
    #[must_use]
    pub fn joints(&self) -> &[usize] {
        &self.joints
    }

    /// Memory for a character.
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

    /// Reads the animated pose: after it [`AimFrame::pose`] is what the solvers take.
    ///
    /// `local` is the pose as it was animated, without earlier corrections, and `model` the same in the space of the model. An other
    /// eye that is aimed is turned in both. A joint's own uneven scale is taken out; the bind pose is carried along by what the
    /// chain hangs on.
    ///
    /// # Errors
    /// A slice has another length than the skeleton, or `frame` is of another chain; then nothing is written.
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
        // The bind pose, but moved along by what the chain hangs on.
        let innermost = self.joints[self.joints.len() - 1];
        let carried = self.skeleton.parents()[innermost].and_then(|on| Some(model[on] * inverse(&self.bind[on])?));
        let carried = frame.place * carried.unwrap_or(Affine3A::IDENTITY);
        for (at, &bone) in frame.bind.iter_mut().zip(&self.joints) {
            *at = carried * without_uneven_scale(&self.bind[bone], self.skeleton.rest()[bone].scale);
        }
        frame.animated.copy_from_slice(model);
        Ok(())
    }

    /// Writes corrections into the pose that was [gathered](Self::gather): joints and the other eye are turned, what is held is moved
    /// back, and `model` follows. Joints without a correction stay.
    ///
    /// # Errors
    /// A slice has another length than the skeleton, or `frame` is of another chain; then nothing is written.
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

    /// The other eye's bone, and what leads from joint 0's space into its own where both are in the bind pose.
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

    /// The turn in the space of the model after which the other eye is to joint 0 as both are in the bind pose.
    fn parallel(&self, other: usize, model: &[Affine3A]) -> Option<Quat> {
        let eye = self.joints[0];
        let frame = |at: &Affine3A| nearest_orthogonal(at.matrix3);
        let since_bind = frame(&model[eye])? * frame(&self.bind[eye])?.transpose();
        rotation(&(since_bind * frame(&self.bind[other])? * frame(&model[other])?.transpose()))
    }

    /// Turns the other eye in the space of the model as joint 0 was turned from its rotation `before`: between the orthogonal parts of
    /// what carries them, so that on one bone of any scale both turn alike.
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

    /// Moves a bone back to where its carrier has it. What is hidden by a scale of 0 has no place to keep.
    fn hold(&self, held: &Held, frame: &AimFrame, local: &mut [Transform], model: &[Affine3A]) {
        let Held { bone, carrier } = *held;
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

/// The bones of the first of several names that one bone has; else of the first that several have.
fn candidates<'a>(skeleton: &'a Skeleton, names: impl Iterator<Item = &'a str>) -> Vec<usize> {
    let mut found: Vec<Vec<usize>> = names.map(|name| skeleton.named(name).collect()).collect();
    found.retain(|bones| !bones.is_empty());
    let first = found.iter().position(|bones| bones.len() == 1).unwrap_or_default();
    if found.is_empty() { Vec::new() } else { found.swap_remove(first) }
}

/// Leaves of each joint's candidates those that hang on one of the next joint's, and then those of them that carry one of the joint's
/// before. A single one stays, so that it is told why it does not.
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

/// True if a bone hangs on another one, by any number of bones.
fn is_below(skeleton: &Skeleton, bone: usize, on: usize) -> bool {
    bone != on && skeleton.subtree(on).contains(&bone)
}

/// The rotation of an orthogonal matrix; `None` if it mirrors.
fn rotation(frame: &Mat3A) -> Option<Quat> {
    if frame.determinant() > 0.5 { unit(Quat::from_mat3a(frame)) } else { None }
}

/// A bone in the space of the model without its own scale if that is uneven, so that a correction acts where its rotation does.
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
