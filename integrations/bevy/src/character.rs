//! [`AimCharacter`]: declares an aimed character and its rig.

use std::fmt;
use std::sync::Arc;

use aim::glam::{Affine3A, Vec3};
use aim::{AimRig, Rig};
use bevy_ecs::component::Component;

use crate::find::Seen;
use crate::report::Reported;
use crate::{AimOutcome, AimSettings, AimTarget};

/// A rig, shared by any number of characters.
pub type SharedRig = Arc<dyn Rig + Send + Sync>;

/// A character whose bones are aimed. Insert it on the ancestor entity of the bones: the root of the character's scene.
///
/// Bones are found by the names that the rig declares, at any depth below the entity but not below another aimed
/// character, as soon as they appear. If several entities share a joint's name, the one that forms a chain with the
/// bones of the neighbouring joints is used: it descends from the next joint's bone and is an ancestor of the previous
/// one's. This separates a bone from a mesh of the same name. If more than one qualifies, give a path such as
/// `"Spine/Neck/Head"`: it matches an entity called `Head` whose parent is called `Neck` and whose grandparent is
/// called `Spine`.
///
/// Unless the rig is measured, the pose in which the bones appear is taken as the bind pose. Spawn the component
/// together with the scene, before it is animated, or set the pose with [`with_bind_pose`](Self::with_bind_pose). One
/// entity aims one chain.
///
/// ```
/// use bevy_aim::aim::{AimRig, Joint};
/// use bevy_aim::{AimCharacter, AimTarget};
/// use bevy_ecs::prelude::*;
/// use bevy_math::Vec3;
///
/// #[derive(AimRig)]
/// #[aim(crate = bevy_aim::aim, axes(up = +Y, forward = +Z, left = +X))]
/// struct Hero {
///     #[joint(bone = "Head", role = head, heading = -70deg..=70deg, pitch = -40deg..=40deg, rate = 200deg)]
///     head: Joint,
/// }
///
/// fn spawn(mut commands: Commands) {
///     commands.spawn((AimCharacter::of::<Hero>(), AimTarget::point(Vec3::new(0.0, 1.7, 5.0))));
/// }
/// ```
#[derive(Component, Clone)]
#[require(AimSettings, AimTarget, AimOutcome, Reported, Seen)]
pub struct AimCharacter {
    pub(crate) source: Source,
    pub(crate) bones: Vec<(usize, String)>,
    pub(crate) other_eye: OtherEye,
    pub(crate) held: Vec<(usize, String)>,
    pub(crate) up: Option<Vec3>,
    pub(crate) trunk: Option<String>,
    pub(crate) bind_pose: Vec<(String, Affine3A)>,
}

/// Choice of the second eye, which turns together with joint 0.
#[derive(Clone, Debug)]
pub(crate) enum OtherEye {
    /// The eye that the rig declares, if any.
    OfRig,
    None,
    Bone {
        name: String,
        is_aimed: bool,
    },
}

/// The source of a rig.
#[derive(Clone)]
pub(crate) enum Source {
    Rig(SharedRig),
    #[cfg(feature = "measure")]
    Measured,
    #[cfg(feature = "assets")]
    Asset(bevy_asset::Handle<crate::AimRigAsset>),
}

impl AimCharacter {
    /// Creates a character with the derived rig of `R`.
    #[must_use]
    pub fn of<R: AimRig + Sync>() -> Self {
        Self::new(Arc::new(R::RIG))
    }

    /// Creates a character with a rig known at run time.
    #[must_use]
    pub fn new(rig: SharedRig) -> Self {
        Self::from_source(Source::Rig(rig))
    }

    /// Creates a character whose rig is measured when its bones appear. Facing and axes come from the bind pose of the
    /// skin, or, without a skin, from the pose in which the bones appear; the chain comes from the bones' names; ranges
    /// and rates are those of humans. Measuring takes milliseconds, once for all characters with equal skeletons.
    ///
    /// `aim rig hero.glb --format bevy` prints the rig as code to compile instead. It also measures the meshes, and you
    /// can check the result.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn measured() -> Self {
        Self::from_source(Source::Measured)
    }

    /// Creates a character whose rig is loaded from an asset, `hero.aim.toml`. If Bevy watches files, a changed file is
    /// applied while the app runs.
    #[cfg(feature = "assets")]
    #[must_use]
    pub fn from_asset(rig: bevy_asset::Handle<crate::AimRigAsset>) -> Self {
        Self::from_source(Source::Asset(rig))
    }

    fn from_source(source: Source) -> Self {
        let (bones, held, bind_pose) = (Vec::new(), Vec::new(), Vec::new());
        Self { source, bones, other_eye: OtherEye::OfRig, held, up: None, trunk: None, bind_pose }
    }

    /// Sets the name or path of a joint's bone, instead of the names that the rig declares. Joints are counted from the
    /// effector inward.
    #[must_use]
    pub fn with_bone(mut self, joint: usize, bone: impl Into<String>) -> Self {
        self.bones.push((joint, bone.into()));
        self
    }

    /// Adds the other eye, given by the name or path of its bone, and aims it at the target as well: see
    /// [`Pose::with_other_eye`](aim::Pose::with_other_eye). An eye that the rig declares as `other_eye` is aimed
    /// without this call.
    #[must_use]
    pub fn with_other_eye(mut self, bone: impl Into<String>) -> Self {
        self.other_eye = OtherEye::Bone { name: bone.into(), is_aimed: true };
        self
    }

    /// Adds the other eye, given by the name or path of its bone, which repeats the turn of the aimed eye.
    #[must_use]
    pub fn with_following_eye(mut self, bone: impl Into<String>) -> Self {
        self.other_eye = OtherEye::Bone { name: bone.into(), is_aimed: false };
        self
    }

    /// Ignores the other eye that the rig declares: it stays as animated.
    #[must_use]
    pub fn without_other_eye(mut self) -> Self {
        self.other_eye = OtherEye::None;
        self
    }

    /// Adds a held bone: a descendant of a joint that does not follow the joint's correction, such as an arm that is
    /// parented to the neck. It moves with what carries the joint instead. Bones that the rig declares with `hold` are
    /// held without this call.
    #[must_use]
    pub fn with_held(mut self, joint: usize, bone: impl Into<String>) -> Self {
        self.held.push((joint, bone.into()));
        self
    }

    /// Sets the character's up direction, in the space of the entity; +Y unless set or measured.
    #[must_use]
    pub fn with_up(mut self, up: Vec3) -> Self {
        self.up = Some(up);
        self
    }

    /// Sets the bone, usually the hips, whose lean determines the up direction: for a character that lies down, up is
    /// fixed to this bone.
    #[must_use]
    pub fn with_trunk(mut self, bone: impl Into<String>) -> Self {
        self.trunk = Some(bone.into());
        self
    }

    /// Sets bind transforms of bones by name, in the space of the entity. Other bones keep the transforms with which
    /// they appeared.
    #[must_use]
    pub fn with_bind_pose<N: Into<String>>(mut self, bones: impl IntoIterator<Item = (N, Affine3A)>) -> Self {
        self.bind_pose.extend(bones.into_iter().map(|(name, place)| (name.into(), place)));
        self
    }
}

impl fmt::Debug for AimCharacter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let source: &dyn fmt::Debug = match &self.source {
            Source::Rig(rig) => &(rig as &dyn Rig) as _,
            #[cfg(feature = "measure")]
            Source::Measured => &"measured",
            #[cfg(feature = "assets")]
            Source::Asset(handle) => handle,
        };
        f.debug_struct("AimCharacter").field("rig", source).field("other_eye", &self.other_eye).finish_non_exhaustive()
    }
}
