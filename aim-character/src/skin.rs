//! Meshes moved by their joints.

use aim_gltf::{Skeleton, SkinnedPoint, Surface, carrier};
use aim_runtime::glam::{Affine3A, DAffine3, DVec3, Mat3A, Vec3, Vec3A};

/// The node that moves each vertex most: its heaviest joint, or the node that shows it.
pub(crate) fn carriers(skeleton: &Skeleton, points: &[SkinnedPoint]) -> Vec<usize> {
    points.iter().map(|point| carrier(skeleton, point)).collect()
}

/// Transforms that move vertices: world transforms of all nodes, and of each skin's joints after their inverse binds.
#[derive(Clone, Debug)]
pub struct Palette<'a> {
    skeleton: &'a Skeleton,
    world: &'a [DAffine3],
    skinned: Vec<Vec<DAffine3>>,
}

impl<'a> Palette<'a> {
    /// For `world` ← node of every node: what [`Skeleton::world_f64`] gives.
    #[must_use]
    pub fn new(skeleton: &'a Skeleton, world: &'a [DAffine3]) -> Self {
        let of = |skin: usize| {
            let (joints, binds) = skeleton.skin(skin);
            joints.iter().zip(binds).map(|(joint, bind)| world[*joint] * bind.unwrap_or(DAffine3::IDENTITY)).collect()
        };
        Self { skeleton, world, skinned: (0..skeleton.skin_count()).map(of).collect() }
    }

    /// The vertices of a surface in the world; skinned ones by linear blending.
    #[must_use]
    pub fn positions(&self, surface: &Surface) -> Vec<DVec3> {
        self.deform(surface.points())
    }

    /// The same of any vertices.
    pub(crate) fn deform(&self, points: &[SkinnedPoint]) -> Vec<DVec3> {
        let place = |point: &SkinnedPoint| {
            let position = point.position().as_dvec3();
            let total: f64 = point.joints().iter().map(|(_, w)| f64::from(*w)).sum();
            match self.skeleton.nodes()[point.node()].skin {
                Some(skin) if total > 0.0 => {
                    let part = |(joint, weight): &(u16, f32)| {
                        if *weight == 0.0 {
                            DVec3::ZERO
                        } else {
                            self.skinned[skin][usize::from(*joint)].transform_point3(position) * f64::from(*weight)
                        }
                    };
                    point.joints().iter().map(part).sum::<DVec3>() / total
                }
                _ => self.world[point.node()].transform_point3(position),
            }
        };
        points.iter().map(place).collect()
    }

    /// The vertices of a surface in the world and their normals of length one, in single precision into buffers that are
    /// emptied first.
    pub fn pose(&self, surface: &Surface, placed: &mut Vec<Vec3>, turned: &mut Vec<Vec3>) {
        let (points, normals) = (surface.points(), surface.normals());
        let motion = |affine: &DAffine3| Motion::new(affine.as_affine3a());
        let skinned: Vec<Vec<Motion>> = self.skinned.iter().map(|joints| joints.iter().map(motion).collect()).collect();
        placed.clear();
        turned.clear();
        placed.reserve(points.len());
        turned.reserve(points.len());
        let mut move_by = |motion: &Motion, point: &SkinnedPoint, normal: Vec3| {
            placed.push(motion.place.transform_point3(point.position()));
            turned.push(motion.turn(normal));
        };
        // One blended matrix for both. Points come node by node: what is the same for a node is looked up once.
        let mut normals = normals.iter();
        for of_node in points.chunk_by(|a, b| a.node() == b.node()) {
            let node = of_node[0].node();
            let rigid = motion(&self.world[node]);
            let joints = self.skeleton.nodes()[node].skin.map_or(&[][..], |skin| &skinned[skin]);
            for (point, normal) in of_node.iter().zip(normals.by_ref()) {
                let total: f32 = point.joints().iter().map(|(_, weight)| weight).sum();
                match point.joints() {
                    _ if total <= 0.0 || joints.is_empty() => move_by(&rigid, point, *normal),
                    [(only, _), (_, 0.0), (_, 0.0), (_, 0.0)] => move_by(&joints[usize::from(only)], point, *normal),
                    several => move_by(&Motion::blended(joints, several, total), point, *normal),
                }
            }
        }
    }
}

/// A transform of points with its transform of normals.
struct Motion {
    place: Affine3A,
    /// The inverse's transpose times the determinant's size: right for scales that differ, and for mirrors.
    normals: Mat3A,
}

impl Motion {
    fn new(place: Affine3A) -> Self {
        let Mat3A { x_axis: x, y_axis: y, z_axis: z } = place.matrix3;
        let cofactors = Mat3A::from_cols(y.cross(z), z.cross(x), x.cross(y));
        let is_mirror = x.dot(cofactors.x_axis) < 0.0;
        Self { place, normals: if is_mirror { -cofactors } else { cofactors } }
    }

    /// The mean of joints' motions by their weights, which sum up to `total`.
    fn blended(joints: &[Self], weights: [(u16, f32); 4], total: f32) -> Self {
        let (mut matrix3, mut translation) = (Mat3A::ZERO, Vec3A::ZERO);
        let scale = total.recip();
        for (joint, weight) in weights {
            if weight != 0.0 {
                let (share, joint) = (weight * scale, &joints[usize::from(joint)].place);
                matrix3 += joint.matrix3 * share;
                translation += joint.translation * share;
            }
        }
        Self::new(Affine3A { matrix3, translation })
    }

    /// Of length one; up where nothing is left of it.
    fn turn(&self, normal: Vec3) -> Vec3 {
        let turned = self.normals * Vec3A::from(normal);
        // What is as small as this has lost its direction.
        let is_there = (1e-30..f32::MAX).contains(&turned.length_squared());
        if is_there { turned.normalize().into() } else { Vec3::Y }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_stay_square_to_what_they_stand_on() {
        let (tangent, normal) = (Vec3::new(1.0, 1.0, 0.0), Vec3::new(1.0, -1.0, 0.5).normalize());
        for scale in [Vec3::ONE, Vec3::new(1.0, 3.0, 0.2), Vec3::new(-1.0, 2.0, 1.0), Vec3::splat(1e-6)] {
            let matrix = Mat3A::from_rotation_z(0.3) * Mat3A::from_diagonal(scale);
            let (turned, along) = (Motion::new(Affine3A::from_mat3(matrix.into())).turn(normal), matrix * tangent);
            assert!((turned.length() - 1.0).abs() < 1e-5, "{scale}: {turned}");
            assert!(turned.dot(along.normalize()).abs() < 1e-5, "{scale}: {turned} on {along}");
            assert!(turned.dot(matrix * normal) > 0.0, "{scale}: it points to the same side");
        }
        assert_eq!(Motion::new(Affine3A::ZERO).turn(normal), Vec3::Y, "nothing is left of it");
    }
}
