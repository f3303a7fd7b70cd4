//! [`Skin`]: the bones that move a mesh, with their inverse rest transforms.

use alloc::vec::Vec;

use aim_runtime::glam::Affine3A;
use aim_runtime::rotation::inverse;

use super::SkinError;
use crate::skeleton::Skeleton;

/// The *joints* of a mesh: the bones that move it, each with the map from mesh space to the space of the bone at rest.
///
/// ```
/// use aim_animation::glam::{Affine3A, Quat, Vec3};
/// use aim_animation::{Bone, Skeleton, Skin, Transform};
///
/// let hand = Bone::new("hand", Some(0)).with_rest(Transform::from_translation(Vec3::X));
/// let skeleton = Skeleton::new([Bone::new("arm", None), hand])?;
/// let skin = Skin::new(&skeleton, [0, 1])?;
///
/// let mut local = skeleton.rest().to_vec();
/// local[1].rotation = Quat::from_rotation_z(core::f32::consts::FRAC_PI_2);
/// let mut model = [Affine3A::IDENTITY; 2];
/// skeleton.to_model(&local, &mut model)?;
/// let mut matrices = [Affine3A::IDENTITY; 2];
/// skin.matrices(&model, &mut matrices)?;
/// // A finger tip of the mesh turns about the hand.
/// assert!(matrices[1].transform_point3(Vec3::X * 1.5).abs_diff_eq(Vec3::new(1.0, 0.5, 0.0), 1e-6));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    bones: Vec<usize>,
    inverse_rest: Vec<Affine3A>,
    /// Number of bones of the skeleton.
    skeleton: usize,
}

impl Skin {
    /// The skin of a mesh that was modelled around the skeleton at rest, in model space. Computes the inverse rest
    /// transforms.
    ///
    /// # Errors
    /// A bone does not exist, or its rest transform is singular.
    pub fn new(skeleton: &Skeleton, bones: impl Into<Vec<usize>>) -> Result<Self, SkinError> {
        let model = skeleton.rest_in_model();
        let bones = bones.into();
        let inverse_of = |(joint, &bone): (usize, &usize)| {
            let model = model.get(bone).ok_or(SkinError::Bone { joint, bone })?;
            inverse(model).ok_or(SkinError::Rest(joint))
        };
        let inverse_rest = bones.iter().enumerate().map(inverse_of).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { bones, inverse_rest, skeleton: skeleton.len() })
    }

    /// A skin with given inverse rest transforms (inverse bind matrices), as in files: bone space ← mesh space, one for
    /// each joint. The same bone may be used for several joints.
    ///
    /// # Errors
    /// A bone does not exist, the numbers of transforms and bones differ, or a transform is not finite.
    pub fn with_inverse_rest(
        skeleton: &Skeleton,
        bones: impl Into<Vec<usize>>,
        inverse_rest: impl Into<Vec<Affine3A>>,
    ) -> Result<Self, SkinError> {
        let (bones, inverse_rest) = (bones.into(), inverse_rest.into());
        check_length(bones.len(), inverse_rest.len())?;
        if let Some((joint, &bone)) = bones.iter().enumerate().find(|(_, bone)| **bone >= skeleton.len()) {
            return Err(SkinError::Bone { joint, bone });
        }
        match inverse_rest.iter().position(|inverse| !inverse.is_finite()) {
            Some(joint) => Err(SkinError::Rest(joint)),
            None => Ok(Self { bones, inverse_rest, skeleton: skeleton.len() }),
        }
    }

    /// The bone of each joint.
    #[must_use]
    pub fn bones(&self) -> &[usize] {
        &self.bones
    }

    /// Inverse rest transform of each joint, bone space ← mesh space.
    #[must_use]
    pub fn inverse_rest(&self) -> &[Affine3A] {
        &self.inverse_rest
    }

    /// The number of joints.
    #[must_use]
    pub fn len(&self) -> usize {
        self.bones.len()
    }

    /// Returns `true` if there are no joints.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.bones.is_empty()
    }

    /// Computes the joint matrices, model space ← mesh space: the model-space transform of each bone times its inverse
    /// rest transform. `model` is a pose from [`Skeleton::to_model`].
    ///
    /// # Errors
    /// `model` has another length than the skeleton, or `matrices` another length than there are joints; then nothing
    /// is written.
    pub fn matrices(&self, model: &[Affine3A], matrices: &mut [Affine3A]) -> Result<(), SkinError> {
        check_length(self.skeleton, model.len())?;
        check_length(self.len(), matrices.len())?;
        for ((matrix, inverse_rest), &bone) in matrices.iter_mut().zip(&self.inverse_rest).zip(&self.bones) {
            *matrix = model[bone] * *inverse_rest;
        }
        Ok(())
    }
}

fn check_length(expected: usize, found: usize) -> Result<(), SkinError> {
    if found == expected { Ok(()) } else { Err(SkinError::Length { expected, found }) }
}

/// Returns the three rows of an affine map, as shaders read joint matrices from a buffer or texture: 48 bytes instead
/// of 64. The coordinates of a transformed point are the dot products of (x, y, z, 1) with the rows.
///
/// ```
/// use aim_animation::glam::{Affine3A, Vec3};
/// use aim_animation::matrix_rows;
///
/// let [x, ..] = matrix_rows(&Affine3A::from_translation(Vec3::X * 5.0));
/// assert_eq!(x, [1.0, 0.0, 0.0, 5.0]);
/// ```
#[must_use]
pub fn matrix_rows(matrix: &Affine3A) -> [[f32; 4]; 3] {
    let [x, y, z, t] = matrix.to_cols_array_2d();
    [0, 1, 2].map(|row| [x[row], y[row], z[row], t[row]])
}
