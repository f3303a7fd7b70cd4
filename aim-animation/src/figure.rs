//! [`Figure`]: a character's pose of this frame and its place, kept consistent; [`Layer`]: what changes them.

use alloc::sync::Arc;
use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::rotation::inverse;

use crate::attach::attached;
use crate::pose::{Both, PoseError};
use crate::skeleton::Skeleton;
use crate::transform::Transform;

/// One character's pose, in local space and in that of the model, and its place in the world. [`Layer`]s work on it in turn.
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
    /// The character in the world, without scale.
    pub place: Transform,
    skeleton: Arc<Skeleton>,
    /// The rest pose in the space of the model; shared by clones.
    rest: Arc<[Affine3A]>,
    local: Vec<Transform>,
    model: Vec<Affine3A>,
}

/// A step of a frame: reads the pose that the layers before it have left, and changes it. A closure is one, too.
///
/// Whatever moves the trunk comes before what is to hold on to something: animation and blending, [feet](crate::Stance), which lower the
/// pelvis, [aim poses](crate::AimPosesLayer), aim (`AimLayer`, with the feature `std`), hands, attachments.
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
    /// Changes the pose of a frame that is `dt_s` seconds after the one before.
    ///
    /// # Errors
    /// What it was made for has another number of bones than the figure.
    fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError>;
}

impl<F: FnMut(&mut Figure, f32) -> Result<(), PoseError>> Layer for F {
    fn apply(&mut self, figure: &mut Figure, dt_s: f32) -> Result<(), PoseError> {
        self(figure, dt_s)
    }
}

impl Figure {
    /// A character at rest at the origin. Give an `Arc` where several characters share their skeleton, or clone a figure.
    #[must_use]
    pub fn new(skeleton: impl Into<Arc<Skeleton>>) -> Self {
        let skeleton = skeleton.into();
        let local = skeleton.rest().to_vec();
        let model = skeleton.rest_in_model();
        Self { place: Transform::IDENTITY, skeleton, rest: model.clone().into(), local, model }
    }

    /// Runs a frame of `dt_s` seconds: begins at the rest pose and applies the layers in order. Does not allocate.
    ///
    /// # Errors
    /// That of the first layer that fails; those after it are not applied.
    pub fn run(&mut self, dt_s: f32, layers: &mut [&mut dyn Layer]) -> Result<(), PoseError> {
        self.reset();
        layers.iter_mut().try_for_each(|layer| layer.apply(self, dt_s))
    }

    /// Brings every bone back to the rest pose; the place stays.
    pub fn reset(&mut self) {
        self.local.copy_from_slice(self.skeleton.rest());
        self.model.copy_from_slice(&self.rest);
    }

    /// The skeleton.
    #[must_use]
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// Each bone in its parent's space.
    #[must_use]
    pub fn local(&self) -> &[Transform] {
        &self.local
    }

    /// Each bone in the space of the model.
    #[must_use]
    pub fn model(&self) -> &[Affine3A] {
        &self.model
    }

    /// A bone in the world; `None` if there is no such bone.
    #[must_use]
    pub fn world(&self, bone: usize) -> Option<Affine3A> {
        Some(self.place.to_affine() * *self.model.get(bone)?)
    }

    /// Edits the local pose; the space of the model follows, also after an error.
    ///
    /// # Errors
    /// That of the edit.
    pub fn edit<E>(&mut self, edit: impl FnOnce(&mut [Transform]) -> Result<(), E>) -> Result<(), E> {
        let edited = edit(&mut self.local);
        // Of equal lengths.
        let _ = self.skeleton.to_model(&self.local, &mut self.model);
        edited
    }

    /// Turns a bone about its origin by a rotation in the space of the model, with all that hangs on it: see
    /// [`Skeleton::turn_in_model`]. Nothing is done if there is no such bone.
    pub fn turn(&mut self, bone: usize, rotation: Quat) {
        // Of equal lengths.
        let _ = self.skeleton.turn_in_model(bone, rotation, &self.model, &mut self.local);
        let _ = self.skeleton.to_model_below(bone, &self.local, &mut self.model);
    }

    /// Moves a bone by a vector in the space of the model, with all that hangs on it. Nothing is done if there is no such bone, if its
    /// parent does not span space, or if the result is not finite.
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

    /// Both poses, for what keeps them consistent itself, as [`AimChain::apply`](crate::AimChain::apply) and
    /// [`Reach::apply`](crate::Reach::apply) do.
    pub fn parts_mut(&mut self) -> (&Skeleton, &mut [Transform], &mut [Affine3A]) {
        (&self.skeleton, &mut self.local, &mut self.model)
    }

    /// Moves the place so that what a bone holds, `grip` in its space, is at `held` in the world: someone hanging off a bridge. Scales
    /// play no part. False, and nothing is done, if there is no such bone or if the result is not finite.
    pub fn hang(&mut self, bone: usize, grip: &Affine3A, held: &Affine3A) -> bool {
        let place = self.model.get(bone).and_then(|bone| place_for(&attached(bone, grip), held));
        self.place = place.unwrap_or(self.place);
        place.is_some()
    }

    pub(crate) fn both(&mut self) -> Both<'_> {
        Both { skeleton: &self.skeleton, local: &mut self.local, model: &mut self.model }
    }
}

/// The rigid place at which an attachment point of the model is where something is in the world.
pub(crate) fn place_for(attachment: &Affine3A, held: &Affine3A) -> Option<Transform> {
    let place = Transform::from_affine(held)?.rigid_product(&Transform::from_affine(attachment)?.rigid_inverse());
    place.is_sound().then_some(place)
}
