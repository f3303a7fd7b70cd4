//! [`MeshPose`], and the deformation of vertices and normals by it.

use aim_runtime::glam::{Affine3A, Mat3A, Vec3, Vec3A};

use super::normal::Cofactors;
use super::{Influence, Mesh, MeshError, check_length};

/// Everything that moves a mesh in one frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshPose<'a> {
    /// Joint matrices from [`Skin::matrices`](crate::Skin::matrices). Excess ones are ignored.
    pub matrices: &'a [Affine3A],
    /// Weights of the morph targets. Missing weights are 0, excess ones are ignored.
    pub morph_weights: &'a [f32],
}

impl<'a> MeshPose<'a> {
    /// A pose with joint matrices only; all morph targets have weight 0.
    #[must_use]
    pub const fn new(matrices: &'a [Affine3A]) -> Self {
        Self { matrices, morph_weights: &[] }
    }

    /// Sets the weights of the morph targets.
    #[must_use]
    pub const fn with_morph_weights(mut self, morph_weights: &'a [f32]) -> Self {
        self.morph_weights = morph_weights;
        self
    }
}

impl Mesh {
    /// Computes the vertex positions in a pose, in the target space of the joint matrices: adds the morph targets, then
    /// applies the weighted sum of the joint matrices (linear blend skinning).
    ///
    /// A matrix or weight that is not finite affects only the vertices that it moves.
    ///
    /// # Errors
    /// `positions` has another length than there are vertices, or there are fewer matrices than the mesh needs; then
    /// nothing is written.
    pub fn deform(&self, pose: &MeshPose<'_>, positions: &mut [Vec3]) -> Result<(), MeshError> {
        check_length(self.positions.len(), positions.len())?;
        self.check_joints(pose.matrices.len())?;
        for (vertex, position) in positions.iter_mut().enumerate() {
            *position = self.placed(vertex, pose).into();
        }
        Ok(())
    }

    /// Computes the unit normals in a pose: transforms them by the inverse transpose of the blended matrix. Only the
    /// `influences` heaviest joints of each vertex are blended, at least one. A small number hardly changes the shading
    /// and saves time; `usize::MAX` uses all.
    ///
    /// A normal is zero if its rest normal is zero, if the matrix leaves it no direction, or if the result is not
    /// finite.
    ///
    /// # Errors
    /// The mesh has no normals, `normals` has another length than there are vertices, or there are fewer matrices than
    /// the mesh needs; then nothing is written.
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
            // The weights need not sum to 1: a factor does not change the direction of a normal.
            let turn = Cofactors::new(blended(heaviest, pose.matrices).matrix3);
            let morphed = self.morphed(vertex, pose, (*rest).into(), |morph| morph.normal);
            *normal = turn.turned(morphed).into();
        }
        Ok(())
    }

    /// Returns `true` if the blended matrix at a point of a triangle, given by barycentric coordinates, is a mirror.
    pub(crate) fn is_mirrored(&self, corners: &[u32; 3], shares: [f32; 3], matrices: &[Affine3A]) -> bool {
        let blended = |corner: u32| blended(self.influences(corner as usize), matrices).matrix3;
        let sum = corners.iter().zip(shares).fold(Mat3A::ZERO, |sum, (corner, share)| sum + blended(*corner) * share);
        Cofactors::new(sum).is_mirrored
    }

    /// Returns the position of a vertex; `pose` must have all matrices that the mesh needs.
    #[inline]
    pub(crate) fn placed(&self, vertex: usize, pose: &MeshPose<'_>) -> Vec3A {
        let position = self.morphed(vertex, pose, self.positions[vertex].into(), |morph| morph.position);
        blended(self.influences(vertex), pose.matrices).transform_point3a(position)
    }

    /// Adds to `rest` the displacements of a vertex by its morph targets.
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

/// Weighted sum of joint matrices; for a single influence, the matrix itself, whatever its weight.
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
