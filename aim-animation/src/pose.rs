//! Poses between local and model space.
//!
//! A *local* pose is a [`Transform`] for each bone, in its parent's space; a *model* pose is an affine map for each bone, to
//! the space of the model. Both are slices of the caller's, in the order of the [`Skeleton`]. Nothing public here allocates.

use core::fmt;

use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3A};
use aim_runtime::rotation::inverse;

use crate::skeleton::Skeleton;
use crate::transform::Transform;

/// Why a pose does not fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PoseError {
    /// A slice has another length than the skeleton has bones.
    Length {
        /// The number of bones.
        bones: usize,
        /// The length of the slice.
        found: usize,
    },
    /// The transform of this bone, on which others hang, does not span space, or one is not finite.
    Flat(usize),
}

impl fmt::Display for PoseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { bones, found } => write!(f, "a slice of {found} elements for {bones} bones"),
            Self::Flat(bone) => {
                write!(f, "the transform of bone {bone} is flat or not finite; its scale may not be zero")
            }
        }
    }
}

impl core::error::Error for PoseError {}

/// Fails unless a slice has one element a bone.
pub(crate) fn check_length(bones: usize, found: usize) -> Result<(), PoseError> {
    if found == bones { Ok(()) } else { Err(PoseError::Length { bones, found }) }
}

/// A pose in local and model space at once.
pub(crate) struct Both<'a> {
    pub(crate) skeleton: &'a Skeleton,
    pub(crate) local: &'a mut [Transform],
    pub(crate) model: &'a mut [Affine3A],
}

impl Skeleton {
    /// Each bone in the space of the model.
    ///
    /// A transform that is not finite makes those of its subtree not finite, and no others.
    ///
    /// ```
    /// use aim_animation::glam::{Affine3A, Quat, Vec3};
    /// use aim_animation::{Bone, Skeleton, Transform};
    ///
    /// let hand = Bone::new("hand", Some(0)).with_rest(Transform::from_translation(Vec3::X));
    /// let skeleton = Skeleton::new([Bone::new("arm", None), hand])?;
    /// let mut local = skeleton.rest().to_vec();
    /// local[0].rotation = Quat::from_rotation_z(core::f32::consts::FRAC_PI_2);
    /// let mut model = [Affine3A::IDENTITY; 2];
    /// skeleton.to_model(&local, &mut model)?;
    /// assert!(Vec3::from(model[1].translation).distance(Vec3::Y) < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A slice of another length; then nothing is written.
    pub fn to_model(&self, local: &[Transform], model: &mut [Affine3A]) -> Result<(), PoseError> {
        check_length(self.len(), local.len())?;
        check_length(self.len(), model.len())?;
        for (bone, (local, parent)) in local.iter().zip(self.parents()).enumerate() {
            let local = local.to_affine();
            // Parents stand before their children.
            model[bone] = parent.map_or(local, |parent| model[parent] * local);
        }
        Ok(())
    }

    /// Each bone in the space of the model where the skeleton is at rest.
    pub(crate) fn rest_in_model(&self) -> Vec<Affine3A> {
        let mut model = alloc::vec![Affine3A::IDENTITY; self.len()];
        // Of equal lengths.
        let _ = self.to_model(self.rest(), &mut model);
        model
    }

    /// A bone and all that hangs on it in the space of the model, where the others are already: after the bone has been
    /// turned. Nothing is done if there is no such bone.
    ///
    /// # Errors
    /// A slice of another length; then nothing is written.
    pub fn to_model_below(&self, bone: usize, local: &[Transform], model: &mut [Affine3A]) -> Result<(), PoseError> {
        check_length(self.len(), local.len())?;
        check_length(self.len(), model.len())?;
        for bone in self.subtree(bone) {
            let local = local[bone].to_affine();
            model[bone] = self.parents()[bone].map_or(local, |parent| model[parent] * local);
        }
        Ok(())
    }

    /// Each bone in its parent's space, from the bones in the space of the model. The [skew](crate::Skew) that turned
    /// bones under a parent of uneven scale may have is lost.
    ///
    /// # Errors
    /// A slice of another length, a bone that is not finite, or one that others hang on and that does not span space;
    /// then nothing is written.
    pub fn to_local(&self, model: &[Affine3A], local: &mut [Transform]) -> Result<(), PoseError> {
        check_length(self.len(), model.len())?;
        check_length(self.len(), local.len())?;
        let of_bone = |bone: usize| {
            let affine = match self.parents()[bone] {
                Some(parent) => inverse(&model[parent]).ok_or(PoseError::Flat(parent))? * model[bone],
                None => model[bone],
            };
            Transform::from_affine(&affine).ok_or(PoseError::Flat(bone))
        };
        // Judged before anything is written.
        (0..self.len()).try_for_each(|bone| of_bone(bone).map(|_| ()))?;
        for (bone, local) in local.iter_mut().enumerate() {
            *local = of_bone(bone)?;
        }
        Ok(())
    }

    /// Turns a bone about its origin by a rotation in the space of the model, as solvers give it: its axes become
    /// `rotation · model`; its translation and scale stay.
    ///
    /// `model` is the pose in the space of the model as it is before, of which only the bone's parent is read. What hangs on
    /// the bone follows by the next [`to_model`](Self::to_model), or [`to_model_below`](Self::to_model_below). Exact where
    /// the parent's scale is uniform, mirrored or not; under a parent of uneven scale, where no rotation of the bone does
    /// that, the nearest is taken. Nothing is done if there is no such bone, or if its parent does not span space.
    ///
    /// ```
    /// use aim_animation::glam::{Affine3A, Quat};
    /// use aim_animation::{Bone, Skeleton, Transform};
    ///
    /// // A neck whose bone lies on its side, turned to the left of the model.
    /// let lying = Transform::from_rotation(Quat::from_rotation_z(1.5));
    /// let skeleton = Skeleton::new([Bone::new("neck", None).with_rest(lying)])?;
    /// let (mut local, mut model) = (skeleton.rest().to_vec(), [Affine3A::IDENTITY]);
    /// skeleton.to_model(&local, &mut model)?;
    /// skeleton.turn_in_model(0, Quat::from_rotation_y(0.5), &model, &mut local)?;
    /// assert!(local[0].rotation.abs_diff_eq(Quat::from_rotation_y(0.5) * Quat::from_rotation_z(1.5), 1e-6));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A slice of another length; then nothing is written.
    pub fn turn_in_model(
        &self,
        bone: usize,
        rotation: Quat,
        model: &[Affine3A],
        local: &mut [Transform],
    ) -> Result<(), PoseError> {
        check_length(self.len(), model.len())?;
        check_length(self.len(), local.len())?;
        if let Some(transform) = local.get_mut(bone) {
            let parent = self.parents()[bone].map_or(Affine3A::IDENTITY, |parent| model[parent]);
            transform.rotation = turned(transform.rotation, &parent, rotation).unwrap_or(transform.rotation);
        }
        Ok(())
    }
}

/// A bone's rotation after a rotation in the space of the model; `None` if its parent does not span space.
fn turned(local: Quat, parent: &Affine3A, rotation: Quat) -> Option<Quat> {
    let linear = |matrix3: Mat3A| Affine3A { matrix3, translation: Vec3A::ZERO };
    let parent = linear(parent.matrix3);
    // L' = P⁻¹ · rotation · P · L, of the linear parts; the bone's own scale acts before L and plays no part.
    let turned = linear(Mat3A::from_quat(rotation)) * (parent * linear(Mat3A::from_quat(local)));
    Some(Transform::from_affine(&(inverse(&parent)? * turned))?.rotation)
}
