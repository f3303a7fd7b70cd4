//! Meshes moved by bones.
//!
//! [`Mesh`] holds vertices and their [`Influence`]s, [`Skin`] the bones and their inverse rest transforms.
//! [`deform`](Mesh::deform) applies both on the CPU. A GPU takes the joint matrices of [`Skin::matrices`] instead.

mod deform;
mod error;
mod fingerprint;
mod influence;
mod normal;
mod skin;

use alloc::vec::Vec;
use core::ops::Range;

use aim_runtime::glam::Vec3;

pub use deform::MeshPose;
pub use error::{MeshError, SkinError};
pub use influence::{Influence, Morph};
pub(crate) use normal::facet_normal;
pub use normal::normal_matrix;
pub use skin::{Skin, matrix_rows};

use crate::float::narrow;

/// Vertices, triangles, and the influences and morph targets that move them. Immutable; all characters of a kind can
/// share one.
///
/// Positions and normals are in mesh space, the space from which the [`Skin`]'s inverse rest transforms map.
///
/// ```
/// use aim_animation::glam::{Affine3A, Vec3};
/// use aim_animation::{Influence, Mesh, MeshPose};
///
/// // A strip between two joints: the middle follows both.
/// let positions = [Vec3::ZERO, Vec3::X, Vec3::X * 2.0, Vec3::new(1.0, 1.0, 0.0)];
/// let half = vec![Influence::new(0, 0.5), Influence::new(1, 0.5)];
/// let influences = [vec![Influence::new(0, 1.0)], half.clone(), vec![Influence::new(1, 1.0)], half];
/// let mesh = Mesh::new(positions, [[0, 1, 3], [1, 2, 3]], &influences)?;
///
/// let matrices = [Affine3A::IDENTITY, Affine3A::from_translation(Vec3::Z)];
/// let mut placed = [Vec3::ZERO; 4];
/// mesh.deform(&MeshPose::new(&matrices), &mut placed)?;
/// assert_eq!(placed[1], Vec3::new(1.0, 0.0, 0.5));
/// # Ok::<(), aim_animation::MeshError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    positions: Vec<Vec3>,
    /// Empty, or one for each vertex.
    normals: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    /// Grouped by vertex, heaviest first.
    influences: Vec<Influence>,
    /// One past the last influence of each vertex.
    influence_ends: Vec<u32>,
    /// Grouped by vertex, ordered by target.
    morphs: Vec<Morph>,
    /// One past the last morph of each vertex; empty if there are none.
    morph_ends: Vec<u32>,
    joints: usize,
    targets: usize,
    /// Hash of the data that a mesh's boxes depend on.
    fingerprint: u64,
}

impl Mesh {
    /// A mesh without normals and morph targets. Each vertex may have any number of influences. Their weights are
    /// normalised to sum to 1; weights of 0 are dropped, and weights of the same joint are added.
    ///
    /// Triangles are counter-clockwise seen from outside.
    ///
    /// # Errors
    /// The first of these that is found: the numbers of vertices and of influence lists differ, a vertex is not finite
    /// or has no positive weight, a weight is negative or not finite, a joint is `u32::MAX`, or a triangle refers to a
    /// vertex that does not exist.
    pub fn new(
        positions: impl Into<Vec<Vec3>>,
        triangles: impl Into<Vec<[u32; 3]>>,
        influences: &[impl AsRef<[Influence]>],
    ) -> Result<Self, MeshError> {
        let (positions, triangles) = (positions.into(), triangles.into());
        check_size(positions.len())?;
        check_size(triangles.len())?;
        check_length(positions.len(), influences.len())?;
        check_vectors(&positions)?;
        let is_beyond = |corner: &u32| *corner as usize >= positions.len();
        if let Some(triangle) = triangles.iter().position(|corners| corners.iter().any(is_beyond)) {
            return Err(MeshError::Triangle(triangle));
        }
        let mut mesh = Self { positions, triangles, ..Self::default() };
        for (vertex, influences) in influences.iter().enumerate() {
            mesh.push_influences(vertex, influences.as_ref())?;
            mesh.influence_ends.push(check_size(mesh.influences.len())?);
        }
        let last = mesh.influences.iter().map(|influence| influence.joint).max();
        mesh.joints = last.map_or(Some(0), |joint| joint.checked_add(1)).ok_or(MeshError::Size)? as usize;
        mesh.fingerprint = mesh.computed_fingerprint();
        Ok(mesh)
    }

    /// Appends the influences of a vertex, heaviest first; of equal weights, the lower joint first.
    fn push_influences(&mut self, vertex: usize, given: &[Influence]) -> Result<(), MeshError> {
        if given.iter().any(|influence| !(influence.weight >= 0.0 && influence.weight.is_finite())) {
            return Err(MeshError::Weight(vertex));
        }
        let total: f64 = given.iter().map(|influence| f64::from(influence.weight)).sum();
        let mut joints: Vec<Influence> = given.iter().copied().filter(|influence| influence.weight > 0.0).collect();
        joints.sort_unstable_by_key(|influence| influence.joint);
        let start = self.influences.len();
        for of_joint in joints.chunk_by(|a, b| a.joint == b.joint) {
            let weight: f64 = of_joint.iter().map(|influence| f64::from(influence.weight)).sum();
            let influence = Influence::new(of_joint[0].joint, narrow(weight / total));
            // A weight below the range of single precision has no effect.
            if influence.weight > 0.0 {
                self.influences.push(influence);
            }
        }
        let pushed = &mut self.influences[start..];
        pushed.sort_by(|a, b| b.weight.total_cmp(&a.weight));
        if pushed.is_empty() { Err(MeshError::Unmoved(vertex)) } else { Ok(()) }
    }

    /// Adds a normal for each vertex; zero for a vertex without one. Normals need not have length one.
    ///
    /// # Errors
    /// The numbers of normals and vertices differ, or a normal is not finite.
    pub fn with_normals(mut self, normals: impl Into<Vec<Vec3>>) -> Result<Self, MeshError> {
        let normals = normals.into();
        check_length(self.positions.len(), normals.len())?;
        check_vectors(&normals)?;
        self.normals = normals;
        Ok(self)
    }

    /// Sets the morph targets, replacing any earlier ones. The displacements may be in any order; vertices that a
    /// target does not move need none, and several for the same target and vertex are added.
    ///
    /// # Errors
    /// A displacement refers to a vertex that does not exist or to the target `u32::MAX`, or is not finite.
    pub fn with_morphs(mut self, morphs: impl Into<Vec<Morph>>) -> Result<Self, MeshError> {
        let mut morphs = morphs.into();
        check_size(morphs.len())?;
        let is_wrong = |morph: &Morph| {
            morph.vertex as usize >= self.positions.len()
                || morph.target == u32::MAX
                || !(morph.position.is_finite() && morph.normal.is_finite())
        };
        if let Some(morph) = morphs.iter().position(is_wrong) {
            return Err(MeshError::Morph(morph));
        }
        self.targets = morphs.iter().map(|morph| morph.target as usize + 1).max().unwrap_or(0);
        morphs.retain(|morph| morph.position != Vec3::ZERO || morph.normal != Vec3::ZERO);
        morphs.sort_by_key(|morph| (morph.vertex, morph.target));
        self.morph_ends = Vec::new();
        if !morphs.is_empty() {
            let ends = (0..self.positions.len()).map(|vertex| morphs.partition_point(|m| m.vertex as usize <= vertex));
            self.morph_ends = ends.map(check_size).collect::<Result<_, _>>()?;
        }
        self.morphs = morphs;
        self.fingerprint = self.computed_fingerprint();
        Ok(self)
    }

    /// Positions at rest.
    #[must_use]
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Normals at rest; empty if there are none.
    #[must_use]
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Vertex indices of each triangle, counter-clockwise seen from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Influences of a vertex, heaviest first, with weights that sum to 1; empty if there is no such vertex.
    #[must_use]
    pub fn influences(&self, vertex: usize) -> &[Influence] {
        &self.influences[range(&self.influence_ends, vertex)]
    }

    /// The `N` heaviest influences of a vertex, renormalised to sum to 1 and padded with weight 0. This is the form for
    /// a GPU; most engines use `N` = 4.
    ///
    /// ```
    /// use aim_animation::glam::Vec3;
    /// use aim_animation::{Influence, Mesh};
    ///
    /// let influences = [[Influence::new(2, 0.25), Influence::new(5, 0.5), Influence::new(7, 0.25)]];
    /// let mesh = Mesh::new([Vec3::ZERO], [], &influences)?;
    /// assert_eq!(mesh.heaviest::<1>(0), [Influence::new(5, 1.0)]);
    /// assert_eq!(mesh.heaviest::<4>(0)[1..3], [Influence::new(2, 0.25), Influence::new(7, 0.25)]);
    /// # Ok::<(), aim_animation::MeshError>(())
    /// ```
    #[must_use]
    pub fn heaviest<const N: usize>(&self, vertex: usize) -> [Influence; N] {
        let influences = self.influences(vertex);
        let heaviest = &influences[..influences.len().min(N)];
        // If all influences are used, they already sum to 1.
        let is_all = heaviest.len() == influences.len();
        let share = if is_all { 1.0 } else { heaviest.iter().map(|influence| influence.weight).sum::<f32>().recip() };
        let of = |at: usize| heaviest.get(at).map(|i| Influence { weight: i.weight * share, ..*i });
        core::array::from_fn(|at| of(at).unwrap_or_default())
    }

    /// Displacements of a vertex by the morph targets that move it, ordered by target; empty if none does, or if there
    /// is no such vertex.
    #[must_use]
    pub fn morphs(&self, vertex: usize) -> &[Morph] {
        &self.morphs[range(&self.morph_ends, vertex)]
    }

    /// Number of joint matrices that the mesh needs: the largest joint number that moves a vertex, plus one.
    #[must_use]
    pub fn joints(&self) -> usize {
        self.joints
    }

    /// Number of morph targets: the largest target number given, plus one.
    #[must_use]
    pub fn morph_targets(&self) -> usize {
        self.targets
    }

    /// Returns an error unless there is a matrix for each joint that the mesh uses.
    pub(crate) fn check_joints(&self, found: usize) -> Result<(), MeshError> {
        if found >= self.joints { Ok(()) } else { Err(MeshError::Joints { needed: self.joints, found }) }
    }
}

/// Range of the elements of one vertex.
fn range(ends: &[u32], vertex: usize) -> Range<usize> {
    let Some(&end) = ends.get(vertex) else { return 0..0 };
    let start = vertex.checked_sub(1).map_or(0, |before| ends[before]);
    start as usize..end as usize
}

fn check_size(size: usize) -> Result<u32, MeshError> {
    u32::try_from(size).map_err(|_| MeshError::Size)
}

fn check_length(vertices: usize, found: usize) -> Result<(), MeshError> {
    if found == vertices { Ok(()) } else { Err(MeshError::Length { vertices, found }) }
}

fn check_vectors(vectors: &[Vec3]) -> Result<(), MeshError> {
    vectors.iter().position(|vector| !vector.is_finite()).map_or(Ok(()), |vertex| Err(MeshError::Vertex(vertex)))
}
