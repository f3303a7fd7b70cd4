//! [`MeshPose`], and vertices and normals moved by it.

use aim_runtime::glam::{Affine3A, Mat3A, Vec3, Vec3A};

use super::normal::Cofactors;
use super::{Influence, Mesh, MeshError, check_length};

/// What moves a mesh in one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshPose<'a> {
    /// The joint matrices that [`Skin::matrices`](crate::Skin::matrices) gives. Those past the mesh's joints are ignored.
    pub matrices: &'a [Affine3A],
    /// The weights of the morph targets. Targets past the last have 0, weights past the last target are ignored.
    pub morph_weights: &'a [f32],
}

impl<'a> MeshPose<'a> {
    /// Joint matrices alone; all morph targets have the weight 0.
    #[must_use]
    pub const fn new(matrices: &'a [Affine3A]) -> Self {
        Self { matrices, morph_weights: &[] }
    }

    /// The same with weights of morph targets.
    #[must_use]
    pub const fn with_morph_weights(mut self, morph_weights: &'a [f32]) -> Self {
        self.morph_weights = morph_weights;
        self
    }
}

impl Mesh {
    /// The vertices where the pose has them, in the space that the matrices lead to: the morph targets first, then the
    /// sum of the joint matrices by their weights (linear blend skinning).
    ///
    /// A matrix or a weight that is not finite makes the vertices that it moves not finite, and no others.
    ///
    /// # Errors
    /// A slice of another length than there are vertices, or fewer matrices than the mesh needs; then nothing is written.
    pub fn deform(&self, pose: &MeshPose<'_>, positions: &mut [Vec3]) -> Result<(), MeshError> {
        check_length(self.positions.len(), positions.len())?;
        self.check_joints(pose.matrices.len())?;
        for (vertex, position) in positions.iter_mut().enumerate() {
            *position = self.placed(vertex, pose).into();
        }
        Ok(())
    }

    /// The normals where the pose has them, of length one: moved by the inverse's transpose of the blended matrix of the
    /// `influences` heaviest joints of each vertex, one at least. Few change little of the light and save time;
    /// `usize::MAX` is all of them.
    ///
    /// Zero where the normal is, where the matrix leaves no direction, and where one is not finite.
    ///
    /// # Errors
    /// A mesh without normals, a slice of another length than there are vertices, or fewer matrices than the mesh needs;
    /// then nothing is written.
    ///
    /// ```
    /// use aim_animation::glam::{Affine3A, Quat, Vec3};
    /// use aim_animation::{Influence, Mesh, MeshPose};
    ///
    /// let influences = [[Influence::new(0, 0.75), Influence::new(1, 0.25)]];
    /// let mesh = Mesh::new([Vec3::ZERO], [], &influences)?.with_normals([Vec3::X])?;
    /// let matrices = [Affine3A::from_quat(Quat::from_rotation_z(0.5)), Affine3A::IDENTITY];
    /// let mut normals = [Vec3::ZERO];
    /// mesh.deform_normals(&MeshPose::new(&matrices), 1, &mut normals)?;
    /// assert!(normals[0].abs_diff_eq(Quat::from_rotation_z(0.5) * Vec3::X, 1e-6));
    /// # Ok::<(), aim_animation::MeshError>(())
    /// ```
    pub fn deform_normals(
        &self,
        pose: &MeshPose<'_>,
        influences: usize,
        normals: &mut [Vec3],
    ) -> Result<(), MeshError> {
        if self.normals.len() != self.positions.len() {
            return Err(MeshError::NoNormals);
        }
        check_length(self.positions.len(), normals.len())?;
        self.check_joints(pose.matrices.len())?;
        for (vertex, (normal, rest)) in normals.iter_mut().zip(&self.normals).enumerate() {
            let all = self.influences(vertex);
            let heaviest = &all[..all.len().min(influences.max(1))];
            // Their weights need not sum to 1: a factor turns no normal.
            let turn = Cofactors::new(blended(heaviest, pose.matrices).matrix3);
            let morphed = self.morphed(vertex, pose, (*rest).into(), |morph| morph.normal);
            *normal = turn.turned(morphed).into();
        }
        Ok(())
    }

    /// True if the blended matrix at a point of a triangle, by the shares of its corners, is a mirror.
    pub(crate) fn is_mirrored(&self, corners: &[u32; 3], shares: [f32; 3], matrices: &[Affine3A]) -> bool {
        let blended = |corner: u32| blended(self.influences(corner as usize), matrices).matrix3;
        let sum = corners.iter().zip(shares).fold(Mat3A::ZERO, |sum, (corner, share)| sum + blended(*corner) * share);
        Cofactors::new(sum).is_mirrored
    }

    /// A vertex in a pose that has its matrices.
    #[inline]
    pub(crate) fn placed(&self, vertex: usize, pose: &MeshPose<'_>) -> Vec3A {
        let position = self.morphed(vertex, pose, self.positions[vertex].into(), |morph| morph.position);
        blended(self.influences(vertex), pose.matrices).transform_point3a(position)
    }

    /// A vector of a vertex with its morph targets.
    #[inline]
    fn morphed(&self, vertex: usize, pose: &MeshPose<'_>, rest: Vec3A, way: impl Fn(&super::Morph) -> Vec3) -> Vec3A {
        let mut sum = rest;
        for morph in self.morphs(vertex) {
            let weight = pose.morph_weights.get(morph.target as usize).copied().unwrap_or(0.0);
            if weight != 0.0 {
                sum += Vec3A::from(way(morph)) * weight;
            }
        }
        sum
    }
}

/// The sum of joint matrices by their weights; of a single one, the matrix itself.
#[inline]
fn blended(influences: &[Influence], matrices: &[Affine3A]) -> Affine3A {
    if let [only] = influences {
        return matrices[only.joint as usize];
    }
    let mut sum = Affine3A { matrix3: Mat3A::ZERO, translation: Vec3A::ZERO };
    for influence in influences {
        let (matrix, weight) = (&matrices[influence.joint as usize], influence.weight);
        sum.matrix3 += matrix.matrix3 * weight;
        sum.translation += matrix.translation * weight;
    }
    sum
}
