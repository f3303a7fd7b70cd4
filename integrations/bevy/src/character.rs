//! [`AimCharacter`]: an aimed character, by the rig that aims it.

use std::fmt;
use std::sync::Arc;

use aim::glam::{Affine3A, Vec3};
use aim::{AimRig, Rig};
use bevy_ecs::component::Component;

use crate::find::Seen;
use crate::report::Reported;
use crate::{AimOutcome, AimSettings, AimTarget};

/// A rig that any number of characters share.
pub type SharedRig = Arc<dyn Rig + Send + Sync>;

/// A character whose bones are aimed, on the entity under which its bones are: the root of its scene.
///
/// The bones are found by the names that the rig declares as soon as they appear below the entity, however deep, and not
/// below another aimed character. Of several bones of one name that one is meant which hangs on the next joint's bone and carries the
/// one's before, as a bone does and a mesh of the same name does not. Where that is more than one, a path tells it,
/// `"Spine/Neck/Head"`: it means the bone whose own name is the last part, and whose ancestors next to it have the other parts as
/// their names.
///
/// The pose in which the bones appear is taken for the bind pose, unless the rig is measured: spawn the component with the scene,
/// not later, when it is animated; or give the pose by [`with_bind_pose`](Self::with_bind_pose). One entity aims one chain.
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

/// The eye that turns with joint 0.
#[derive(Clone, Debug)]
pub(crate) enum OtherEye {
    /// The one that the rig names, if it names one.
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
    /// A character of a derived rig.
    #[must_use]
    pub fn of<R: AimRig + Sync>() -> Self {
        Self::new(Arc::new(R::RIG))
    }

    /// A character of a rig known at run time.
    #[must_use]
    pub fn new(rig: SharedRig) -> Self {
        Self::from_source(Source::Rig(rig))
    }

    /// A character whose rig is measured when its bones appear: facing and axes from the bind pose of its skin, or without a skin
    /// from the pose in which they appear, the chain from the bones' names, ranges and rates of people. Takes milliseconds, once
    /// for all characters of equal skeletons.
    ///
    /// `aim rig hero.glb --format bevy` prints the same rig to be compiled instead: measured from meshes, too, and checked by
    /// eye.
    #[cfg(feature = "measure")]
    #[must_use]
    pub fn measured() -> Self {
        Self::from_source(Source::Measured)
    }

    /// A character of a rig that is loaded, `hero.aim.toml`. A file that changes is taken over while the app runs, where
    /// Bevy watches files.
    #[cfg(feature = "assets")]
    #[must_use]
    pub fn from_asset(rig: bevy_asset::Handle<crate::AimRigAsset>) -> Self {
        Self::from_source(Source::Asset(rig))
    }

    fn from_source(source: Source) -> Self {
        let (bones, held, bind_pose) = (Vec::new(), Vec::new(), Vec::new());
        Self { source, bones, other_eye: OtherEye::OfRig, held, up: None, trunk: None, bind_pose }
    }

    /// With another name, or path, of a joint's bone than the rig declares. Joints are counted from the effector inward.
    #[must_use]
    pub fn with_bone(mut self, joint: usize, bone: impl Into<String>) -> Self {
        self.bones.push((joint, bone.into()));
        self
    }

    /// With the other eye, by its bone, aimed as well: see [`Pose::with_other_eye`](aim::Pose::with_other_eye). One that the rig
    /// names, by `other_eye`, is aimed anyway.
    #[must_use]
    pub fn with_other_eye(mut self, bone: impl Into<String>) -> Self {
        self.other_eye = OtherEye::Bone { name: bone.into(), is_aimed: true };
        self
    }

    /// With the other eye, by its bone, which turns as the aimed one does.
    #[must_use]
    pub fn with_following_eye(mut self, bone: impl Into<String>) -> Self {
        self.other_eye = OtherEye::Bone { name: bone.into(), is_aimed: false };
        self
    }

    /// Without the other eye that the rig names: it stays as it is animated.
    #[must_use]
    pub fn without_other_eye(mut self) -> Self {
        self.other_eye = OtherEye::None;
        self
    }

    /// With a bone that hangs on a joint and stays with what carries that joint: an arm that hangs on a neck. Those that the
    /// rig names, by `hold`, are held anyway.
    #[must_use]
    pub fn with_held(mut self, joint: usize, bone: impl Into<String>) -> Self {
        self.held.push((joint, bone.into()));
        self
    }

    /// With another up than +Y, in the space of the entity.
    #[must_use]
    pub fn with_up(mut self, up: Vec3) -> Self {
        self.up = Some(up);
        self
    }

    /// With the bone that tells how the character stands, its hips: where they lie, its up is theirs.
    #[must_use]
    pub fn with_trunk(mut self, bone: impl Into<String>) -> Self {
        self.trunk = Some(bone.into());
        self
    }

    /// With the places of bones in the bind pose, by their names, in the space of the entity; others are taken as they
    /// appeared.
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
