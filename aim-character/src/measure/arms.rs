//! Arms recognised by VRM bones or by name.

use aim_gltf::Skeleton;
use aim_model::BoneName;

use crate::measure::roles::carrying;

/// Words in the names of the bones at which arms begin.
const ARMS: &str = "clavicle clavicles clav collar collarbone shoulder upperarm arm forearm lowerarm hand 肩 腕";

/// Returns `true` if names or VRM reveal an arm anywhere in the skeleton.
pub(crate) fn has_named_limbs(skeleton: &Skeleton) -> bool {
    !named_limbs(skeleton, None).is_empty()
}

/// Returns the first bones of the named arms among the descendants of `node`; among all nodes for `None`.
pub(crate) fn named_limbs(skeleton: &Skeleton, node: Option<usize>) -> Vec<usize> {
    let parents = skeleton.parents();
    let is_named: Vec<bool> =
        (0..skeleton.len()).map(|node| BoneName::new(name_of(skeleton, node)).has(ARMS)).collect();
    let carries_more = carrying(skeleton, &is_named);
    // Parents come before children. `hangs[n]`: n is a descendant of `node`, but not part of a limb that was found.
    let (mut hangs, mut limbs) = (vec![false; parents.len()], Vec::new());
    for at in 0..skeleton.len() {
        let hangs_here = parents[at].map_or(node.is_none(), |parent| Some(parent) == node || hangs[parent]);
        if !hangs_here {
            continue;
        }
        if is_named[at] && carries_more[at] { limbs.push(at) } else { hangs[at] = true }
    }
    limbs
}

/// Returns the name that identifies a node's bone: the VRM bone if there is one, otherwise the node's own name.
pub(crate) fn name_of(skeleton: &Skeleton, node: usize) -> &str {
    skeleton.nodes()[node].vrm_bone.as_ref().unwrap_or(&skeleton.names()[node])
}
