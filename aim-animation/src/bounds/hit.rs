//! [`Hit`]: the nearest triangle that a ray meets.

use aim_runtime::glam::{Vec3, Vec3A};

use super::heaviest::heaviest;
use super::ray::{Crossing, Ray, Shear};
use super::{BoneBoxes, Cluster};
use crate::float::narrow;
use crate::mesh::{Mesh, MeshError, MeshPose, facet_normal};

/// The point at which a ray first meets a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hit {
    /// The bone that moves the point most, by all of its joints; of equals the lowest.
    pub bone: usize,
    /// The joint of that bone that moves the point most, as [`oriented`](BoneBoxes::oriented) takes it.
    pub joint: usize,
    /// The triangle, counted as in the mesh.
    pub triangle: usize,
    /// The part of the ray up to there, in lengths of its direction, often called *t*: the distance where that has length 1,
    /// and 0…1 of a segment. Finite.
    pub part: f32,
    /// The point, on the triangle.
    pub point: Vec3,
    /// The direction square to the triangle, to its outside, of length one; zero if it is too small to have one.
    ///
    /// Corners are counter-clockwise seen from outside, and clockwise under a mirror: where the determinant of the joint
    /// matrices is negative, blended at the point by weights and shares.
    pub normal: Vec3,
    /// The shares of the triangle's corners in the point, which sum to 1: for texture coordinates and the like.
    pub barycentric: [f32; 3],
}

impl BoneBoxes {
    /// The nearest triangle of a mesh that a ray meets in a pose, from either side; of several that meet there, as at a
    /// shared edge, the first. `None` if it meets none, or if the ray is [none](Ray::is_sound).
    ///
    /// The same as a test of all triangles of the [deformed](Mesh::deform) mesh: no ray slips through between triangles
    /// that share their vertices. Triangles of a corner that is not finite are not met, nor those that are further than
    /// `f32::MAX` lengths of the direction.
    ///
    /// # Errors
    /// Another mesh than the boxes were made of, told by its positions, triangles, influences and morph targets; or fewer
    /// matrices than it hangs on.
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

/// A ray on its way through a mesh.
struct Search<'a> {
    mesh: &'a Mesh,
    pose: &'a MeshPose<'a>,
    shear: Shear,
    /// The end of the ray, or the nearest triangle that was met.
    end: f64,
    /// That triangle, and the shares of its corners.
    nearest: Option<(u32, [f64; 3])>,
}

impl Search<'_> {
    /// The corners of a triangle in the pose.
    fn corners(&self, corners: &[u32; 3]) -> [Vec3A; 3] {
        corners.map(|corner| self.mesh.placed(corner as usize, self.pose))
    }

    fn test(&mut self, triangle: u32) {
        let corners = self.corners(&self.mesh.triangles()[triangle as usize]);
        let Some(Crossing { part, barycentric }) = self.shear.crossing(corners) else { return };
        // Of equals the first, in whichever order they are tested.
        let is_first = self.nearest.is_none_or(|(best, _)| part < self.end || triangle < best);
        if part >= 0.0 && part <= self.end && is_first {
            (self.end, self.nearest) = (part, Some((triangle, barycentric)));
        }
    }
}
