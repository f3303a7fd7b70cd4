//! Bounding boxes of bones, and ray casts against a skinned mesh.
//!
//! [`BoneBoxes`] are computed once from a mesh. In a pose, only the boxes are transformed; [`hit`](BoneBoxes::hit)
//! deforms only the triangles whose boxes the ray meets. Boxes are in [`aabb`], the test of a ray against a triangle is
//! in [`ray`].

mod aabb;
mod heaviest;
mod hit;
mod ray;

use alloc::vec::Vec;
use core::ops::Range;

use aim_runtime::glam::{Affine3A, Mat3A, Vec3, Vec3A};
use aim_runtime::rotation::nearest_orthogonal;

pub use aabb::{Aabb, OrientedBox};
pub use hit::Hit;
pub use ray::Ray;

use crate::mesh::{Mesh, MeshError, MeshPose, Skin};

/// Bounding boxes of a mesh's bones, computed once from its vertices at rest.
///
/// A vertex moved by several joints lies in the convex hull of their boxes, not necessarily in one of them. The bounds
/// of the triangles that a joint [carries](Self::carried) therefore include the boxes of all joints that move their
/// corners. In every pose, all of these vertices are inside.
///
/// ```
/// use aim_animation::glam::{Affine3A, Vec3};
/// use aim_animation::{Bone, BoneBoxes, Influence, Mesh, MeshPose, Ray, Skeleton, Skin};
///
/// let skeleton = Skeleton::new([Bone::new("sign", None)])?;
/// let skin = Skin::new(&skeleton, [0])?;
/// let positions = [Vec3::ZERO, Vec3::X, Vec3::Y];
/// let mesh = Mesh::new(positions, [[0, 1, 2]], &[[Influence::new(0, 1.0)]; 3])?;
/// let boxes = BoneBoxes::new(&mesh, &skin)?;
///
/// let matrices = [Affine3A::from_translation(Vec3::Z * 2.0)];
/// let pose = MeshPose::new(&matrices);
/// let ray = Ray::segment(Vec3::new(0.25, 0.25, 0.0), Vec3::new(0.25, 0.25, 4.0));
/// let hit = boxes.hit(&mesh, &pose, &ray)?.unwrap();
/// assert_eq!((hit.bone, hit.triangle, hit.part), (0, 0, 0.5));
/// assert_eq!((hit.point, hit.normal), (Vec3::new(0.25, 0.25, 2.0), Vec3::Z));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct BoneBoxes {
    /// Bone of each joint.
    bones: Vec<usize>,
    /// Map from the axes of each joint at rest to mesh space. Orthogonal, so that boxes are in units of the mesh.
    axes: Vec<Mat3A>,
    /// One part for each joint that moves a vertex, with all vertices that it moves; in ascending order of joints.
    moved: Vec<Part>,
    carriers: Vec<Carrier>,
    clusters: Vec<Cluster>,
    /// Parts of all carriers and clusters, which refer to them by ranges.
    parts: Vec<Part>,
    morphs: Vec<MorphExtent>,
    /// Indices of triangles, carrier by carrier, and cluster by cluster within each.
    triangles: Vec<u32>,
    vertices: usize,
    /// Relative margin of the boxes, from [`aabb::rounding`].
    rounding: f32,
    /// Fingerprint of the mesh.
    fingerprint: u64,
}

/// The triangles assigned to one joint: those that it moves most.
#[derive(Clone, Debug, PartialEq)]
struct Carrier {
    joint: usize,
    whole: Cluster,
    /// The same triangles divided into small clusters.
    clusters: Range<usize>,
}

/// A group of triangles that are near each other at rest.
#[derive(Clone, Debug, PartialEq)]
struct Cluster {
    triangles: Range<usize>,
    /// One part for each joint that moves a corner of the triangles.
    parts: Range<usize>,
}

/// Upper limit of triangles in a cluster. Testing this many costs about as much as transforming the boxes of a few
/// clusters.
const MOST_IN_CLUSTER: usize = 16;

/// Bounds of those vertices of a set that one joint moves.
#[derive(Clone, Debug, PartialEq)]
struct Part {
    joint: usize,
    /// Box along the joint's axes at rest, without morph targets.
    aabb: Aabb,
    morphs: Range<usize>,
}

/// Range of the displacements by which a morph target moves the vertices of a part at weight 1, along the joint's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct MorphExtent {
    target: u32,
    least: Vec3,
    most: Vec3,
}

impl BoneBoxes {
    /// Computes the boxes of a mesh on a skin.
    ///
    /// # Errors
    /// [`MeshError::Joints`] if the mesh refers to more joints than the skin has.
    pub fn new(mesh: &Mesh, skin: &Skin) -> Result<Self, MeshError> {
        mesh.check_joints(skin.len())?;
        // The bone's axes at rest in mesh space: the columns of the rest matrix, made orthonormal.
        let axes_of = |inverse_rest: &Affine3A| {
            let inverse = aim_runtime::rotation::inverse(inverse_rest);
            inverse.and_then(|rest| nearest_orthogonal(rest.matrix3)).unwrap_or(Mat3A::IDENTITY)
        };
        let summands = |vertex: usize| mesh.influences(vertex).len() + mesh.morphs(vertex).len();
        let mut boxes = Self {
            bones: skin.bones().to_vec(),
            axes: skin.inverse_rest().iter().map(axes_of).collect(),
            moved: Vec::new(),
            carriers: Vec::new(),
            clusters: Vec::new(),
            parts: Vec::new(),
            morphs: Vec::new(),
            triangles: Vec::new(),
            vertices: mesh.positions().len(),
            rounding: aabb::rounding((0..mesh.positions().len()).map(summands).max().unwrap_or(0)),
            fingerprint: mesh.fingerprint(),
        };
        boxes.moved = boxes.measured(mesh, (0..mesh.positions().len()).collect());
        let mut carried: Vec<(usize, u32)> =
            (0..).zip(mesh.triangles()).map(|(triangle, corners)| (carrier(mesh, corners), triangle)).collect();
        carried.sort_unstable();
        for of_joint in carried.chunk_by(|a, b| a.0 == b.0) {
            let mut triangles: Vec<u32> = of_joint.iter().map(|(_, triangle)| *triangle).collect();
            let (start, clusters) = (boxes.triangles.len(), boxes.clusters.len());
            for cluster in clustered(mesh, &mut triangles) {
                let start = boxes.triangles.len();
                boxes.triangles.extend(cluster);
                let cluster = boxes.cluster(mesh, start);
                boxes.clusters.push(cluster);
            }
            let whole = boxes.cluster(mesh, start);
            boxes.carriers.push(Carrier { joint: of_joint[0].0, whole, clusters: clusters..boxes.clusters.len() });
        }
        Ok(boxes)
    }

    /// Creates the cluster of the triangles from index `start` on.
    fn cluster(&mut self, mesh: &Mesh, start: usize) -> Cluster {
        let corners = self.triangles[start..].iter().flat_map(|triangle| mesh.triangles()[*triangle as usize]);
        let mut vertices: Vec<usize> = corners.map(|corner| corner as usize).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let (parts, measured) = (self.parts.len(), self.measured(mesh, vertices));
        self.parts.extend(measured);
        Cluster { triangles: start..self.triangles.len(), parts: parts..self.parts.len() }
    }

    /// Measures some vertices: returns one part for each joint that moves any of them, in ascending order of joints.
    fn measured(&mut self, mesh: &Mesh, vertices: Vec<usize>) -> Vec<Part> {
        let joints = |vertex: usize| mesh.influences(vertex).iter().map(move |i| (i.joint as usize, vertex));
        let mut moved: Vec<(usize, usize)> = vertices.into_iter().flat_map(joints).collect();
        moved.sort_unstable();
        let mut parts = Vec::new();
        for of_joint in moved.chunk_by(|a, b| a.0 == b.0) {
            let joint = of_joint[0].0;
            let along = self.axes[joint].transpose();
            let mut aabb = Aabb { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };
            let start = self.morphs.len();
            for &(_, vertex) in of_joint {
                let position = Vec3::from(along * Vec3A::from(mesh.positions()[vertex]));
                aabb = aabb.union(&Aabb { min: position, max: position });
                for of_target in mesh.morphs(vertex).chunk_by(|a, b| a.target == b.target) {
                    let way: Vec3 = of_target.iter().map(|morph| morph.position).sum();
                    self.extend_morph(start, of_target[0].target, (along * Vec3A::from(way)).into());
                }
            }
            parts.push(Part { joint, aabb, morphs: start..self.morphs.len() });
        }
        parts
    }

    /// Extends the range of a morph target, among those from index `start` on, to a vertex's displacement `way`.
    fn extend_morph(&mut self, start: usize, target: u32, way: Vec3) {
        let of_part = &self.morphs[start..];
        let at = start + of_part.partition_point(|extent| extent.target < target);
        if self.morphs.get(at).is_none_or(|extent| extent.target != target) {
            // Begins with displacement 0, for vertices of the part that the target does not move.
            self.morphs.insert(at, MorphExtent { target, least: Vec3::ZERO, most: Vec3::ZERO });
        }
        let extent = &mut self.morphs[at];
        (extent.least, extent.most) = (extent.least.min(way), extent.most.max(way));
    }

    /// Returns the box of a part in a pose: along the joint's axes, with the morph targets, and its transform.
    fn posed(&self, part: &Part, pose: &MeshPose<'_>) -> OrientedBox {
        let mut aabb = part.aabb;
        for extent in &self.morphs[part.morphs.clone()] {
            let weight = pose.morph_weights.get(extent.target as usize).copied().unwrap_or(0.0);
            if weight != 0.0 {
                let (a, b) = (extent.least * weight, extent.most * weight);
                aabb = Aabb { min: aabb.min + a.min(b), max: aabb.max + a.max(b) };
            }
        }
        let matrix = &pose.matrices[part.joint];
        OrientedBox { aabb, place: Affine3A { matrix3: matrix.matrix3 * self.axes[part.joint], ..*matrix } }
    }

    /// Returns the axis-aligned box around some parts in a pose; `None` if there are no parts.
    fn around(&self, parts: &[Part], pose: &MeshPose<'_>) -> Option<Aabb> {
        let placed = |part| {
            let OrientedBox { aabb, place } = self.posed(part, pose);
            aabb.placed(&place, self.rounding)
        };
        parts.iter().map(placed).reduce(|a, b| a.union(&b))
    }

    fn around_cluster(&self, cluster: &Cluster, pose: &MeshPose<'_>) -> Option<Aabb> {
        self.around(&self.parts[cluster.parts.clone()], pose)
    }

    /// Returns the box, along the bone's own axes, of all vertices that a joint moves, as if no other joint moved them.
    ///
    /// It is tight around vertices moved by this joint alone, and suited for drawing a character's boxes; for bounds
    /// that hold in every pose, use [`carried`](Self::carried). `None` if the joint moves no vertex or the pose has no
    /// matrix for it.
    #[must_use]
    pub fn oriented(&self, joint: usize, pose: &MeshPose<'_>) -> Option<OrientedBox> {
        let part = self.moved.binary_search_by_key(&joint, |part| part.joint).ok()?;
        (joint < pose.matrices.len()).then(|| self.posed(&self.moved[part], pose))
    }

    /// Returns an axis-aligned box that contains the triangles assigned to a joint: those whose corners it moves most.
    ///
    /// The box accounts for all other joints that move the corners, and is not tight. It is infinite if a matrix or
    /// morph weight that it depends on is not finite. `None` if no triangles are assigned to the joint.
    ///
    /// # Errors
    /// [`MeshError::Joints`] if the pose has fewer matrices than the mesh needs.
    pub fn carried(&self, joint: usize, pose: &MeshPose<'_>) -> Result<Option<Aabb>, MeshError> {
        self.check_pose(pose)?;
        let carrier = self.carriers.binary_search_by_key(&joint, |carrier| carrier.joint).ok();
        Ok(carrier.and_then(|at| self.around_cluster(&self.carriers[at].whole, pose)))
    }

    /// Returns an axis-aligned box that contains the whole mesh, for culling.
    ///
    /// The box is not tight: it is the union of the boxes of all joints, each around all vertices that the joint moves.
    /// For the exact extent, [deform](Mesh::deform) the mesh. It is infinite if a matrix or morph weight that it
    /// depends on is not finite. `None` if the mesh has no vertices.
    ///
    /// # Errors
    /// [`MeshError::Joints`] if the pose has fewer matrices than the mesh needs.
    pub fn whole(&self, pose: &MeshPose<'_>) -> Result<Option<Aabb>, MeshError> {
        self.check_pose(pose)?;
        Ok(self.around(&self.moved, pose))
    }

    /// Returns the triangles assigned to a joint: those whose corners it moves most. Each triangle is assigned to one
    /// joint.
    #[must_use]
    pub fn triangles(&self, joint: usize) -> &[u32] {
        let carrier = self.carriers.binary_search_by_key(&joint, |carrier| carrier.joint);
        carrier.map_or(&[], |at| &self.triangles[self.carriers[at].whole.triangles.clone()])
    }

    /// Fails unless the pose has a matrix for each joint that moves a vertex.
    fn check_pose(&self, pose: &MeshPose<'_>) -> Result<(), MeshError> {
        let (needed, found) = (self.moved.last().map_or(0, |part| part.joint + 1), pose.matrices.len());
        if found >= needed { Ok(()) } else { Err(MeshError::Joints { needed, found }) }
    }
}

/// Returns the joint with the largest total weight over three corners; on a tie, the lowest.
fn carrier(mesh: &Mesh, corners: &[u32; 3]) -> usize {
    heaviest::heaviest(mesh, corners, [1.0; 3], |joint| Some(joint as usize))
}

/// Divides triangles into clusters of at most [`MOST_IN_CLUSTER`], by halving them recursively along the longest side
/// of their extent.
fn clustered<'a>(mesh: &Mesh, triangles: &'a mut [u32]) -> Vec<&'a [u32]> {
    if triangles.len() <= MOST_IN_CLUSTER {
        return alloc::vec![triangles];
    }
    // Three quarters of the centroid: a factor of 1/4 keeps the sum finite, and only the order matters.
    let middle = |triangle: u32| -> Vec3 {
        mesh.triangles()[triangle as usize].iter().map(|corner| mesh.positions()[*corner as usize] * 0.25).sum()
    };
    let (least, most) = triangles
        .iter()
        .map(|triangle| middle(*triangle))
        .fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(least, most), middle| (least.min(middle), most.max(middle)));
    let axis = (most - least).max_position();
    triangles.sort_unstable_by(|a, b| middle(*a)[axis].total_cmp(&middle(*b)[axis]).then(a.cmp(b)));
    let (low, high) = triangles.split_at_mut(triangles.len() / 2);
    let mut clusters = clustered(mesh, low);
    clusters.extend(clustered(mesh, high));
    clusters
}
