//! Conversion of poses between local and model space.
//!
//! A *local* pose is a [`Transform`] for each bone, in its parent's space. A *model* pose is an affine map for each
//! bone, from the bone's space to model space. Both are slices owned by the caller, in the order of the [`Skeleton`].
//! No public function here allocates.

use core::fmt;

use alloc::vec::Vec;

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3A};
use aim_runtime::rotation::inverse;

use crate::skeleton::Skeleton;
use crate::transform::Transform;

/// Reason why a pose does not fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PoseError {
    /// The length of a slice differs from the number of bones.
    Length {
        /// The number of bones.
        bones: usize,
        /// The length of the slice.
        found: usize,
    },
    /// The transform of a bone with children is singular, or the transform of this bone is not finite.
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

/// Returns an error unless a slice has one element for each bone.
pub(crate) fn check_length(bones: usize, found: usize) -> Result<(), PoseError> {
    if found == bones { Ok(()) } else { Err(PoseError::Length { bones, found }) }
}

/// A pose in both local and model space.
pub(crate) struct PosePair<'a> {
    pub(crate) skeleton: &'a Skeleton,
    pub(crate) local: &'a mut [Transform],
    pub(crate) model: &'a mut [Affine3A],
}

impl Skeleton {
    /// Computes the model-space transform of each bone (forward kinematics).
    ///
    /// A transform that is not finite affects only the bone's own subtree.
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
    /// A slice has another length than the skeleton; then nothing is written.
    pub fn to_model(&self, local: &[Transform], model: &mut [Affine3A]) -> Result<(), PoseError> {
        check_length(self.len(), local.len())?;
        check_length(self.len(), model.len())?;
        for (bone, (local, parent)) in local.iter().zip(self.parents()).enumerate() {
            let local = local.to_affine();
            // Parents precede their children.
            model[bone] = parent.map_or(local, |parent| model[parent] * local);
        }
        Ok(())
    }

    /// Model-space transform of each bone at rest.
    pub(crate) fn rest_in_model(&self) -> Vec<Affine3A> {
        let mut model = alloc::vec![Affine3A::IDENTITY; self.len()];
        // Cannot fail: both lengths are equal.
        let _ = self.to_model(self.rest(), &mut model);
        model
    }

    /// Recomputes the model-space transforms of a bone and its descendants, after the bone has been turned. Those of
    /// the other bones must be up to date. Does nothing if there is no such bone.
    ///
    /// # Errors
    /// A slice has another length than the skeleton; then nothing is written.
    pub fn to_model_below(&self, bone: usize, local: &[Transform], model: &mut [Affine3A]) -> Result<(), PoseError> {
        check_length(self.len(), local.len())?;
        check_length(self.len(), model.len())?;
        for bone in self.subtree(bone) {
            let local = local[bone].to_affine();
            model[bone] = self.parents()[bone].map_or(local, |parent| model[parent] * local);
        }
        Ok(())
    }

    /// Computes each bone's transform in its parent's space from a model pose. Any [skew](crate::Skew), which rotated
    /// bones under a parent of non-uniform scale can have, is lost.
    ///
    /// # Errors
    /// A slice has another length than the skeleton, a bone is not finite, or a bone with children is singular; then
    /// nothing is written.
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
        // Check all bones before writing anything.
        (0..self.len()).try_for_each(|bone| of_bone(bone).map(|_| ()))?;
        for (bone, local) in local.iter_mut().enumerate() {
            *local = of_bone(bone)?;
        }
        Ok(())
    }

    /// Rotates a bone about its origin by a rotation in model space, as solvers return it: the bone's axes become
    /// `rotation · model`. Its translation and scale do not change.
    ///
    /// `model` is the model pose before the rotation; only the bone's parent is read from it. The bone and its
    /// descendants are updated in it by the next [`to_model`](Self::to_model) or
    /// [`to_model_below`](Self::to_model_below). The result is exact if the parent's scale is uniform, mirrored or not.
    /// Under a parent of non-uniform scale, no rotation of the bone is exact, and the nearest one is taken. Does
    /// nothing if there is no such bone, or if its parent is singular.
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
    /// A slice has another length than the skeleton; then nothing is written.
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

/// Returns a bone's local rotation after a rotation in model space; `None` if its parent is singular.
fn turned(local: Quat, parent: &Affine3A, rotation: Quat) -> Option<Quat> {
    let linear = |matrix3: Mat3A| Affine3A { matrix3, translation: Vec3A::ZERO };
    let parent = linear(parent.matrix3);
    // L' = P⁻¹ · rotation · P · L for the linear parts. The bone's own scale acts before L and cancels.
    let turned = linear(Mat3A::from_quat(rotation)) * (parent * linear(Mat3A::from_quat(local)));
    Some(Transform::from_affine(&(inverse(&parent)? * turned))?.rotation)
}
