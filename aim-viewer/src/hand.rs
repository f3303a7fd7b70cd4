//! Finds the right hand of a character.

use aim_animation::Skeleton as Bones;
use aim_character::{Measurement, limbs_on};
use aim_gltf::Skeleton;

/// Returns the hand of the limb below `bone` that is furthest to the right in the bind pose: the first bone whose name
/// contains `hand`, otherwise the end of the limb.
pub(crate) fn right_hand(skeleton: &Skeleton, measurement: &Measurement, bone: usize) -> Option<usize> {
    let left = |node: &usize| measurement.bind_world[*node].translation.dot(measurement.left);
    let limb = limbs_on(skeleton, measurement, bone).into_iter().min_by(|a, b| left(a).total_cmp(&left(b)))?;
    // The first in depth-first order, because finger names often contain `hand`, too.
    let is_named = |node: &usize| skeleton.names()[*node].to_lowercase().contains("hand");
    skeleton.subtree(limb).skip(1).find(is_named).or_else(|| end(skeleton, limb))
}

/// Returns the bone at which a limb branches or ends; `None` if the limb has fewer than three bones.
fn end(skeleton: &Bones, limb: usize) -> Option<usize> {
    let only = |bone: &usize| {
        let mut children = skeleton.children(*bone);
        children.next().filter(|_| children.next().is_none())
    };
    std::iter::successors(Some(limb), only).skip(2).last()
}
