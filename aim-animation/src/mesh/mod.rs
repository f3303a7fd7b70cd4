//! Meshes moved by bones.
//!
//! [`Mesh`] holds vertices and their [`Influence`]s, [`Skin`] the bones' rest. [`deform`](Mesh::deform) puts the two together
//! on the CPU; a GPU takes the joint matrices instead.

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

/// Vertices, triangles, and what moves them. Immutable; one serves all characters of a kind.
///
/// Positions and normals are in the space of the mesh, in which the [`Skin`]'s inverse rest starts.
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
    /// Vertex by vertex, heaviest first.
    influences: Vec<Influence>,
    /// One past the last influence of each vertex.
    influence_ends: Vec<u32>,
    /// Vertex by vertex, by target.
    morphs: Vec<Morph>,
    /// One past the last morph of each vertex; empty if there are none.
    morph_ends: Vec<u32>,
    joints: usize,
    targets: usize,
    /// Of all that boxes are made of.
    fingerprint: u64,
}

impl Mesh {
    /// A mesh without normals and morph targets. Each vertex has any number of influences; their weights are normalised
    /// to sum to 1, those of 0 are dropped, and those of one joint are added.
    ///
    /// Triangles are counter-clockwise seen from outside.
    ///
    /// # Errors
    /// Another number of influences than of vertices, a vertex that is not finite or that nothing moves, a weight that
    /// is negative or not finite, the joint `u32::MAX`, or a triangle of a vertex that does not exist; the first that is
    /// found.
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

    /// Appends a vertex's influences, heaviest first, of equal ones the lower joint.
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
            // A share below the range of single precision moves nothing.
            if influence.weight > 0.0 {
                self.influences.push(influence);
            }
        }
        let pushed = &mut self.influences[start..];
        pushed.sort_by(|a, b| b.weight.total_cmp(&a.weight));
        if pushed.is_empty() { Err(MeshError::Unmoved(vertex)) } else { Ok(()) }
    }

    /// With a normal for each vertex; zero for one that has none. They need not be of length one.
    ///
    /// # Errors
    /// Another number of normals than of vertices, or one that is not finite.
    pub fn with_normals(mut self, normals: impl Into<Vec<Vec3>>) -> Result<Self, MeshError> {
        let normals = normals.into();
        check_length(self.positions.len(), normals.len())?;
        check_vectors(&normals)?;
        self.normals = normals;
        Ok(self)
    }

    /// With morph targets, in place of those that it has: what their weights move, in any order. Vertices that a target
    /// does not move need none; those of one target and vertex are added.
    ///
    /// # Errors
    /// A vertex that does not exist, or a way that is not finite.
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

    /// The positions where nothing moves them.
    #[must_use]
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// The normals where nothing moves them; empty if there are none.
    #[must_use]
    pub fn normals(&self) -> &[Vec3] {
        &self.normals
    }

    /// Three vertices each, counter-clockwise seen from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// What moves a vertex, heaviest first, with weights that sum to 1; empty if there is no such vertex.
    #[must_use]
    pub fn influences(&self, vertex: usize) -> &[Influence] {
        &self.influences[range(&self.influence_ends, vertex)]
    }

    /// The `N` heaviest influences of a vertex, with weights that sum to 1; filled up with weight 0. As GPUs take them, with
    /// `N` = 4 in most engines.
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
        // All of them sum to 1 already.
        let is_all = heaviest.len() == influences.len();
        let share = if is_all { 1.0 } else { heaviest.iter().map(|influence| influence.weight).sum::<f32>().recip() };
        let of = |at: usize| heaviest.get(at).map(|i| Influence { weight: i.weight * share, ..*i });
        core::array::from_fn(|at| of(at).unwrap_or_default())
    }

    /// The ways of a vertex to the morph targets that move it, by target; empty if none does, or if there is no such
    /// vertex.
    #[must_use]
    pub fn morphs(&self, vertex: usize) -> &[Morph] {
        &self.morphs[range(&self.morph_ends, vertex)]
    }

    /// One more than the last joint that moves a vertex: the number of matrices that it needs.
    #[must_use]
    pub fn joints(&self) -> usize {
        self.joints
    }

    /// One more than the last morph target that was given.
    #[must_use]
    pub fn morph_targets(&self) -> usize {
        self.targets
    }

    /// Fails unless there is a matrix for each joint that the mesh hangs on.
    pub(crate) fn check_joints(&self, found: usize) -> Result<(), MeshError> {
        if found >= self.joints { Ok(()) } else { Err(MeshError::Joints { needed: self.joints, found }) }
    }
}

/// The elements of one vertex.
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
