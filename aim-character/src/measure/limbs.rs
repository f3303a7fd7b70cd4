//! The bones that arms begin with.

use aim_gltf::Skeleton;

use crate::measure::Measurement;
use crate::measure::arms::named_limbs;

/// The bones that arms begin with, of those that hang on a node, however deep. As their names or VRM tell: a clavicle with an arm
/// on it, an arm with a hand, but not the arm of a pair of glasses. Where those tell no arm at all, by the body's plan: the
/// longest pair of mirrored limbs on trunk and neck.
#[must_use]
pub fn limbs_on(skeleton: &Skeleton, measurement: &Measurement, node: usize) -> Vec<usize> {
    let hangs = |limb: &usize| skeleton.ancestry(*limb).skip(1).any(|at| at == node);
    let Some(mut arms) = measurement.nameless_arms else { return named_limbs(skeleton, Some(node)) };
    arms.sort_unstable();
    arms.into_iter().filter(hangs).collect()
}

/// The [limbs](limbs_on) on nodes that are given from the outermost inward: each with the first node that it hangs on. Nodes
/// without any are left out.
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
