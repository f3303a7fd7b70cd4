//! Linear blend skinning of a document's meshes.

use aim_gltf::{Skeleton, SkinnedPoint, Surface, carrier};
use aim_runtime::glam::{DAffine3, DVec3};

/// Returns the node that moves each vertex most: its heaviest joint, or the node that shows it if it has none.
pub(crate) fn carriers(skeleton: &Skeleton, points: &[SkinnedPoint]) -> Vec<usize> {
    points.iter().map(|point| carrier(skeleton, point)).collect()
}

/// World transforms that move vertices: those of all nodes, and those of each skin's joints multiplied by their inverse
/// bind matrices.
#[derive(Clone, Debug)]
pub struct Palette<'a> {
    skeleton: &'a Skeleton,
    world: &'a [DAffine3],
    skinned: Vec<Vec<DAffine3>>,
}

impl<'a> Palette<'a> {
    /// Builds the palette from `world` ← node of every node, as [`Skeleton::world_f64`] returns it.
    #[must_use]
    pub fn new(skeleton: &'a Skeleton, world: &'a [DAffine3]) -> Self {
        let of = |skin: usize| {
            let (joints, binds) = skeleton.skin(skin);
            joints.iter().zip(binds).map(|(joint, bind)| world[*joint] * bind.unwrap_or(DAffine3::IDENTITY)).collect()
        };
        Self { skeleton, world, skinned: (0..skeleton.skin_count()).map(of).collect() }
    }

    /// Returns the vertices of a surface in world space. Skinned vertices are blended linearly.
    #[must_use]
    pub fn positions(&self, surface: &Surface) -> Vec<DVec3> {
        self.deform(surface.points())
    }

    /// Returns the given vertices in world space. Skinned vertices are blended linearly.
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
