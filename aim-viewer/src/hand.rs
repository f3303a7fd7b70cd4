//! The right hand of a character, as far as it can be told.

use aim_animation::Skeleton as Bones;
use aim_character::{Measurement, limbs_on};
use aim_gltf::Skeleton;

/// The hand of the limb that is furthest to the right in the bind pose, of those that hang on `bone`.
pub(crate) fn right_hand(skeleton: &Skeleton, measurement: &Measurement, bone: usize) -> Option<usize> {
    let left = |node: &usize| measurement.bind_world[*node].translation.dot(measurement.left);
    let limb = limbs_on(skeleton, measurement, bone).into_iter().min_by(|a, b| left(a).total_cmp(&left(b)))?;
    // The first in depth-first order: its fingers often have the word, too.
    let is_named = |node: &usize| skeleton.names()[*node].to_lowercase().contains("hand");
    skeleton.subtree(limb).skip(1).find(is_named).or_else(|| end(skeleton, limb))
}

/// Where a limb of at least two bones branches or ends.
fn end(skeleton: &Bones, limb: usize) -> Option<usize> {
    let only = |bone: &usize| {
        let mut children = skeleton.children(*bone);
        children.next().filter(|_| children.next().is_none())
    };
    std::iter::successors(Some(limb), only).skip(2).last()
}
