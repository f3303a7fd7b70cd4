//! [`BoneEnds`]: the points of each bone at which errors are measured, and the size of the effects of its channels.

use alloc::vec::Vec;

use aim_runtime::glam::Vec3A;
use aim_runtime::rotation::length;

use crate::skeleton::Skeleton;

/// Length assumed for the bones of a skeleton without extent, model units.
const LENGTH_OF_A_POINT: f32 = 1.0;

/// Points at which the error of a bone is measured: its origin, its children's origins, and a point at the bone's
/// length on both sides of each of its axes.
#[derive(Clone, Debug)]
pub(super) struct BoneEnds {
    /// Origins of its children at rest, in the bone's space.
    pub(super) children: Vec<[f64; 3]>,
    /// Distances of the points on its axes from the origin, in the units of those axes.
    pub(super) axis_distances: [f64; 3],
    /// Distance from the bone's origin to the farthest point of its subtree at rest, model units.
    pub(super) reach: f32,
    /// Factor from the units of the bone's translation to model units, at rest.
    pub(super) parent_scale: f32,
}

impl BoneEnds {
    /// Computes the points for each bone. A bone's length is the distance to its farthest child; a leaf has its
    /// parent's length, or else a tenth of the skeleton's extent.
    pub(super) fn of(skeleton: &Skeleton) -> Vec<Self> {
        let bones = skeleton.len();
        let model = skeleton.rest_in_model();
        let origin = |bone: usize| model[bone].translation;
        let distance = |a: usize, b: usize| length(origin(a) - origin(b));
        let size = (0..bones).map(|bone| distance(0, bone)).fold(0.0, larger);
        let fallback = if size > 0.0 { 0.1 * size } else { LENGTH_OF_A_POINT };
        let mut lengths: Vec<f32> = Vec::with_capacity(bones);
        for bone in 0..bones {
            let own = skeleton.children(bone).map(|child| distance(bone, child)).fold(0.0, larger);
            let parents = skeleton.parents()[bone].map(|parent| lengths[parent]);
            lengths.push(if own > 1e-4 * size { own } else { parents.unwrap_or(fallback) });
        }
        let scales = |bone: usize| {
            let m = model[bone].matrix3;
            [m.x_axis, m.y_axis, m.z_axis].map(length)
        };
        (0..bones)
            .map(|bone| {
                let axis_distances = scales(bone).map(|scale| {
                    let along = f64::from(lengths[bone]) / f64::from(scale);
                    // An axis whose scale at rest is 0 has no finite distance.
                    if along.is_finite() { along } else { f64::from(lengths[bone]) }
                });
                let below = skeleton.subtree(bone);
                let reach = below.map(|other| distance(bone, other) + lengths[other]).fold(lengths[bone], larger);
                let parent_scale =
                    skeleton.parents()[bone].map_or(1.0, |parent| scales(parent).into_iter().fold(0.0, larger));
                let offset = |child: usize| skeleton.rest()[child].translation.to_array().map(f64::from);
                let children = skeleton.children(bone).map(offset).collect();
                Self {
                    children,
                    axis_distances,
                    reach,
                    parent_scale: if parent_scale > 0.0 { parent_scale } else { 1.0 },
                }
            })
            .collect()
    }
}

/// Returns the larger number; ignores `b` if it is not finite.
fn larger(a: f32, b: f32) -> f32 {
    if b.is_finite() { a.max(b) } else { a }
}

/// Converts a vector to single precision.
pub(super) fn narrowed(v: [f64; 3]) -> Vec3A {
    Vec3A::from_array(v.map(crate::float::narrow))
}
