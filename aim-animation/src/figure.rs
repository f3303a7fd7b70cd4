//! [`Figure`]: the current pose and place of a character, in local and model space. [`Layer`]: a step that changes
//! them.

use alloc::sync::Arc;
use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::rotation::inverse;

use crate::attach::attached;
use crate::pose::{PoseError, PosePair};
use crate::skeleton::Skeleton;
use crate::transform::Transform;

/// Pose of one character, in local and model space, and its place in the world. [`Layer`]s change it in turn.
///
/// All methods keep the two poses consistent, except for [`parts_mut`](Self::parts_mut), which leaves that to the
/// caller.
///
/// ```
/// use aim_animation::glam::{Quat, Vec3};
/// use aim_animation::{Bone, Figure, LimbLayer, PoseError, Skeleton, TipTarget, Transform};
///
/// let at = |x| Transform::from_translation(Vec3::X * x);
/// let skeleton = Skeleton::new([
///     Bone::new("upper_arm", None),
///     Bone::new("forearm", Some(0)).with_rest(Transform { rotation: Quat::from_rotation_z(0.3), ..at(0.3) }),
///     Bone::new("hand", Some(1)).with_rest(at(0.25)),
/// ])?;
/// // Once a character: its pose, and the layers that it needs, under names of your own.
/// let mut hand = LimbLayer::new(&skeleton, [0, 1, 2])?;
/// let mut figure = Figure::new(skeleton);
/// // Each frame: the animation, here a closure, and then what is to hold whatever it does.
/// figure.place = Transform::from_translation(Vec3::Z);
/// hand.set_target(TipTarget::world(Vec3::new(0.3, 0.2, 1.1)));
/// let mut raise = |figure: &mut Figure, _dt_s: f32| figure.edit(|local| {
///     local[0].rotation = Quat::from_rotation_z(0.5);
///     Ok::<(), PoseError>(())
/// });
/// figure.run(1.0 / 60.0, &mut [&mut raise, &mut hand])?;
/// assert!(figure.world(2).unwrap().translation.distance(Vec3::new(0.3, 0.2, 1.1).into()) < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// The character's transform from model to world space, without scale.
    pub place: Transform,
    skeleton: Arc<Skeleton>,
    /// Rest pose, model space; shared by clones.
    rest: Arc<[Affine3A]>,
    local: Vec<Transform>,
    model: Vec<Affine3A>,
}

/// One step of a frame: reads the pose left by the previous layers and changes it. Closures implement it too.
///
/// Layers that move the trunk must run before layers that hold on to something. The usual order:
///
/// 1. animation and blending
/// 2. feet, which lower the pelvis ([`Stance`](crate::Stance))
/// 3. aim poses ([`AimPosesLayer`](crate::AimPosesLayer))
/// 4. aim (`AimLayer`, with the feature `std`)
/// 5. hands ([`LimbLayer`](crate::LimbLayer))
/// 6. attachments
///
/// ```
/// use aim_animation::glam::Quat;
/// use aim_animation::{Bone, Figure, Layer, PoseError, Skeleton};
///
/// struct Nod {
///     head: usize,
///     angle_rad: f32,
/// }
///
/// impl Layer for Nod {
///     fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError> {
///         self.angle_rad += 0.5 * dt_s;
///         figure.turn(self.head, Quat::from_rotation_x(self.angle_rad));
///         Ok(())
///     }
/// }
///
/// let mut figure = Figure::new(Skeleton::new([Bone::new("head", None)])?);
/// let mut nod = Nod { head: 0, angle_rad: 0.0 };
/// figure.run(1.0, &mut [&mut nod])?;
/// assert!(figure.local()[0].rotation.angle_between(Quat::from_rotation_x(0.5)) < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Layer {
    /// Changes the pose of a frame that is `dt_s` seconds after the previous one.
    ///
    /// # Errors
    /// The layers of this crate fail if they were made for a skeleton with another number of bones.
    fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError>;
}

impl<F: FnMut(&mut Figure, f32) -> Result<(), PoseError>> Layer for F {
    fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError> {
        self(figure, dt_s)
    }
}

impl Figure {
    /// Creates a character at rest at the origin. To share a skeleton between characters, pass an `Arc` or clone a
    /// figure.
    #[must_use]
    pub fn new(skeleton: impl Into<Arc<Skeleton>>) -> Self {
        let skeleton = skeleton.into();
        let local = skeleton.rest().to_vec();
        let model = skeleton.rest_in_model();
        Self { place: Transform::IDENTITY, skeleton, rest: model.clone().into(), local, model }
    }

    /// Runs a frame of `dt_s` seconds: resets to the rest pose, then applies the layers in order. Does not allocate.
    ///
    /// # Errors
    /// Returns the error of the first layer that fails. The layers after it are not applied.
    pub fn run(&mut self, dt_s: f32, layers: &mut [&mut dyn Layer]) -> Result<(), PoseError> {
        self.reset();
        layers.iter_mut().try_for_each(|layer| layer.apply(self, dt_s))
    }

    /// Resets every bone to the rest pose. The place is unchanged.
    pub fn reset(&mut self) {
        self.local.copy_from_slice(self.skeleton.rest());
        self.model.copy_from_slice(&self.rest);
    }

    /// Returns the skeleton.
    #[must_use]
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// Returns the local pose: each bone in its parent's space.
    #[must_use]
    pub fn local(&self) -> &[Transform] {
        &self.local
    }

    /// Returns the pose in model space.
    #[must_use]
    pub fn model(&self) -> &[Affine3A] {
        &self.model
    }

    /// Returns the world transform of a bone; `None` if the bone does not exist.
    #[must_use]
    pub fn world(&self, bone: usize) -> Option<Affine3A> {
        Some(self.place.to_affine() * *self.model.get(bone)?)
    }

    /// Edits the local pose, then updates the model-space pose, even if the edit fails.
    ///
    /// # Errors
    /// Returns the error of the edit.
    pub fn edit<E>(&mut self, edit: impl FnOnce(&mut [Transform]) -> Result<(), E>) -> Result<(), E> {
        let edited = edit(&mut self.local);
        // Cannot fail: both slices have the skeleton's length.
        let _ = self.skeleton.to_model(&self.local, &mut self.model);
        edited
    }

    /// Turns a bone, with its descendants, about its origin by a model-space rotation: see [`Skeleton::turn_in_model`].
    /// Does nothing if the bone does not exist.
    pub fn turn(&mut self, bone: usize, rotation: Quat) {
        // Cannot fail: both slices have the skeleton's length.
        let _ = self.skeleton.turn_in_model(bone, rotation, &self.model, &mut self.local);
        let _ = self.skeleton.to_model_below(bone, &self.local, &mut self.model);
    }

    /// Moves a bone, with its descendants, by a model-space vector. Does nothing if the bone does not exist, if its
    /// parent's transform is singular, or if the result is not finite.
    pub fn shift(&mut self, bone: usize, by: Vec3) {
        let Some(parent) = self.skeleton.parents().get(bone) else { return };
        let to_parent = parent.map_or(Some(Affine3A::IDENTITY), |parent| inverse(&self.model[parent]));
        let Some(local) = to_parent.map(|to_parent| to_parent.transform_vector3(by)) else { return };
        let moved = self.local[bone].translation + local;
        if moved.is_finite() {
            self.local[bone].translation = moved;
            let _ = self.skeleton.to_model_below(bone, &self.local, &mut self.model);
        }
    }

    /// Returns the skeleton, the local pose and the model-space pose, for functions that keep the two poses consistent
    /// themselves, such as [`AimChain::apply`](crate::AimChain::apply) and [`Reach::apply`](crate::Reach::apply).
    pub fn parts_mut(&mut self) -> (&Skeleton, &mut [Transform], &mut [Affine3A]) {
        (&self.skeleton, &mut self.local, &mut self.model)
    }

    /// Moves the place so that an attachment point on a bone coincides with `held`: someone hanging off a bridge.
    ///
    /// `grip` is the attachment point in bone space, `held` its transform in world space. Scales are ignored. Returns
    /// `false` and changes nothing if the bone does not exist or the result is not finite.
    pub fn hang(&mut self, bone: usize, grip: &Affine3A, held: &Affine3A) -> bool {
        let place = self.model.get(bone).and_then(|bone| place_for(&attached(bone, grip), held));
        self.place = place.unwrap_or(self.place);
        place.is_some()
    }

    pub(crate) fn pose_pair(&mut self) -> PosePair<'_> {
        PosePair { skeleton: &self.skeleton, local: &mut self.local, model: &mut self.model }
    }
}

/// Returns the rigid place, model to world space, that brings the model-space `attachment` to the world-space `held`;
/// `None` if it is not finite.
pub(crate) fn place_for(attachment: &Affine3A, held: &Affine3A) -> Option<Transform> {
    let place = Transform::from_affine(held)?.rigid_product(&Transform::from_affine(attachment)?.rigid_inverse());
    place.is_sound().then_some(place)
}
