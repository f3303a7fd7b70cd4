//! Meshes moved by their joints.

use aim_gltf::{Skeleton, SkinnedPoint, Surface, carrier};
use aim_runtime::glam::{DAffine3, DVec3};

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
}
