//! The first bones of arms.

use aim_gltf::Skeleton;

use crate::measure::Measurement;
use crate::measure::arms::named_limbs;

/// Returns the first bones of the arms among the descendants of a node.
///
/// They are found by name or VRM: a clavicle that carries an arm, an arm that carries a hand, but not the arm of a pair
/// of glasses. If names and VRM reveal no arm at all, they are found by the body plan: the longest pair of mirrored
/// limbs on trunk and neck.
#[must_use]
pub fn limbs_on(skeleton: &Skeleton, measurement: &Measurement, node: usize) -> Vec<usize> {
    let hangs = |limb: &usize| skeleton.ancestry(*limb).skip(1).any(|at| at == node);
    let Some(mut arms) = measurement.nameless_arms else { return named_limbs(skeleton, Some(node)) };
    arms.sort_unstable();
    arms.into_iter().filter(hangs).collect()
}

/// Returns the [limbs](limbs_on) on each of the given nodes, which are ordered from the outermost inward. Each limb is
/// listed only for the first node that it descends from, and nodes without limbs are omitted.
#[must_use]
pub fn limbs_on_each(
    skeleton: &Skeleton,
    measurement: &Measurement,
    nodes: impl IntoIterator<Item = usize>,
) -> Vec<(usize, Vec<usize>)> {
    let mut found: Vec<(usize, Vec<usize>)> = Vec::new();
    for node in nodes {
        let mut limbs = limbs_on(skeleton, measurement, node);
        limbs.retain(|limb| !found.iter().any(|(_, others)| others.contains(limb)));
        if !limbs.is_empty() {
            found.push((node, limbs));
        }
    }
    found
}
