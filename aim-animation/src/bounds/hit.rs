//! [`Hit`]: the nearest intersection of a ray with a mesh.

use aim_runtime::glam::{Vec3, Vec3A};

use super::heaviest::heaviest;
use super::ray::{Crossing, Ray, Shear};
use super::{BoneBoxes, Cluster};
use crate::float::narrow;
use crate::mesh::{Mesh, MeshError, MeshPose, facet_normal};

/// First intersection of a ray with a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hit {
    /// The bone with the largest weight at the point, summed over its joints; on a tie, the lowest.
    pub bone: usize,
    /// The joint of [`bone`](Self::bone) with the largest weight at the point, as an argument for
    /// [`oriented`](BoneBoxes::oriented).
    pub joint: usize,
    /// Index of the triangle in the mesh.
    pub triangle: usize,
    /// Ray parameter of the point, often called *t*, in lengths of the ray's direction: the distance for a unit
    /// direction, 0…1 for a [segment](Ray::segment). Finite.
    pub part: f32,
    /// The point on the triangle.
    pub point: Vec3,
    /// Unit normal of the triangle, pointing outward; zero if the triangle is too small to have one.
    ///
    /// Corners are counter-clockwise seen from outside. They are clockwise where the skin is mirrored: where the joint
    /// matrices, blended at the point by weights and barycentric coordinates, have a negative determinant.
    pub normal: Vec3,
    /// Barycentric coordinates of the point, which sum to 1: for interpolating texture coordinates, for example.
    pub barycentric: [f32; 3],
}

impl BoneBoxes {
    /// Returns the first intersection of a ray with a mesh in a pose; `None` if there is none, or if the ray is
    /// [unsound](Ray::is_sound).
    ///
    /// - Triangles are hit from either side. Of several triangles at the same distance, as at a shared edge, the one
    ///   with the lowest index is returned.
    /// - The result is the same as that of testing all triangles of the [deformed](Mesh::deform) mesh. The test is
    ///   watertight: no ray passes between triangles that share vertices.
    /// - Triangles with a corner that is not finite are never hit, nor are triangles beyond `f32::MAX` lengths of the
    ///   ray's direction.
    ///
    /// # Errors
    /// [`MeshError::OtherMesh`] if the boxes were made from another mesh, as detected by a fingerprint of positions,
    /// triangles, influences and morph targets. [`MeshError::Joints`] if the pose has fewer matrices than the mesh
    /// needs.
    pub fn hit(&self, mesh: &Mesh, pose: &MeshPose<'_>, ray: &Ray) -> Result<Option<Hit>, MeshError> {
        let is_same = mesh.fingerprint() == self.fingerprint
            && mesh.positions().len() == self.vertices
            && mesh.triangles().len() == self.triangles.len()
            && mesh.joints() <= self.bones.len();
        if !is_same {
            return Err(MeshError::OtherMesh);
        }
        self.check_pose(pose)?;
        mesh.check_joints(pose.matrices.len())?;
        if !ray.is_sound() {
            return Ok(None);
        }
        let mut search =
            Search { mesh, pose, shear: Shear::new(ray), end: f64::from(ray.end.min(f32::MAX)), nearest: None };
        for carrier in &self.carriers {
            if !self.is_met(&carrier.whole, &search, ray) {
                continue;
            }
            for cluster in &self.clusters[carrier.clusters.clone()] {
                if self.is_met(cluster, &search, ray) {
                    self.triangles[cluster.triangles.clone()].iter().for_each(|triangle| search.test(*triangle));
                }
            }
        }
        Ok(search.nearest.map(|nearest| self.described(&search, nearest)))
    }

    fn is_met(&self, cluster: &Cluster, search: &Search<'_>, ray: &Ray) -> bool {
        self.around_cluster(cluster, search.pose).is_some_and(|aabb| aabb.meets(ray, search.end))
    }

    fn described(&self, search: &Search<'_>, (triangle, barycentric): (u32, [f64; 3])) -> Hit {
        let corners = &search.mesh.triangles()[triangle as usize];
        let placed @ [a, b, c] = search.corners(corners);
        let barycentric = barycentric.map(narrow);
        let bone_of = |joint: u32| self.bones[joint as usize];
        let bone = heaviest(search.mesh, corners, barycentric, |joint| Some(bone_of(joint)));
        let joint =
            heaviest(search.mesh, corners, barycentric, |joint| (bone_of(joint) == bone).then_some(joint as usize));
        let normal = facet_normal(placed);
        let is_mirrored = search.mesh.is_mirrored(corners, barycentric, search.pose.matrices);
        Hit {
            bone,
            joint,
            triangle: triangle as usize,
            part: narrow(search.end),
            point: (a * barycentric[0] + b * barycentric[1] + c * barycentric[2]).into(),
            normal: if is_mirrored { -normal } else { normal }.into(),
            barycentric,
        }
    }
}

/// State of a search for the nearest hit.
struct Search<'a> {
    mesh: &'a Mesh,
    pose: &'a MeshPose<'a>,
    shear: Shear,
    /// Ray parameter of the nearest hit so far, or else of the end of the ray.
    end: f64,
    /// Triangle of the nearest hit so far, and its barycentric coordinates.
    nearest: Option<(u32, [f64; 3])>,
}

impl Search<'_> {
    /// Returns the corners of a triangle in the pose.
    fn corners(&self, corners: &[u32; 3]) -> [Vec3A; 3] {
        corners.map(|corner| self.mesh.placed(corner as usize, self.pose))
    }

    fn test(&mut self, triangle: u32) {
        let corners = self.corners(&self.mesh.triangles()[triangle as usize]);
        let Some(Crossing { part, barycentric }) = self.shear.crossing(corners) else { return };
        // On a tie, the lowest index wins, in whichever order the triangles are tested.
        let is_first = self.nearest.is_none_or(|(best, _)| part < self.end || triangle < best);
        if part >= 0.0 && part <= self.end && is_first {
            (self.end, self.nearest) = (part, Some((triangle, barycentric)));
        }
    }
}
