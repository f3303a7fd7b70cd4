//! [`Ends`]: the points of each bone at which errors are measured, and how far a bone's turn carries.

use alloc::vec::Vec;

use aim_runtime::glam::Vec3A;
use aim_runtime::rotation::length;

use crate::skeleton::Skeleton;

/// Of a skeleton that has no size, a unit.
const LENGTH_OF_A_POINT: f32 = 1.0;

/// The points at which a bone's error is measured: its origin, its children's, and on its three axes, on both sides, its length away.
#[derive(Clone, Debug)]
pub(super) struct Ends {
    /// The origins of its children at rest, in its own space.
    pub(super) children: Vec<[f64; 3]>,
    /// How far from the origin, in the bone's own units along its axes.
    pub(super) along: [f64; 3],
    /// The farthest point that hangs on the bone, in the rest pose, in units of the model.
    pub(super) reach: f32,
    /// By what the bone's translation is scaled in the space of the model, in the rest pose.
    pub(super) parent_scale: f32,
}

impl Ends {
    /// Of each bone. Its length is the distance to the farthest origin of a child; that of a leaf is its parent's, or else a
    /// tenth of the skeleton's.
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
                let along = scales(bone).map(|scale| {
                    let along = f64::from(lengths[bone]) / f64::from(scale);
                    // Of an axis that is hidden at rest.
                    if along.is_finite() { along } else { f64::from(lengths[bone]) }
                });
                let below = skeleton.subtree(bone);
                let reach = below.map(|other| distance(bone, other) + lengths[other]).fold(lengths[bone], larger);
                let parent_scale =
                    skeleton.parents()[bone].map_or(1.0, |parent| scales(parent).into_iter().fold(0.0, larger));
                let offset = |child: usize| skeleton.rest()[child].translation.to_array().map(f64::from);
                let children = skeleton.children(bone).map(offset).collect();
                Self { children, along, reach, parent_scale: if parent_scale > 0.0 { parent_scale } else { 1.0 } }
            })
            .collect()
    }
}

/// The larger number; NaN and infinity do not count.
fn larger(a: f32, b: f32) -> f32 {
    if b.is_finite() { a.max(b) } else { a }
}

/// A vector in single precision.
pub(super) fn narrowed(v: [f64; 3]) -> Vec3A {
    Vec3A::from_array(v.map(crate::float::narrow))
}
