//! Arms as names and VRM tell them.

use aim_gltf::Skeleton;
use aim_model::BoneName;

use crate::measure::roles::carrying;

/// Words of the bones that arms begin with.
const ARMS: &str = "clavicle clavicles clav collar collarbone shoulder upperarm arm forearm lowerarm hand 肩 腕";

/// True if names or VRM tell an arm anywhere.
pub(crate) fn has_named_limbs(skeleton: &Skeleton) -> bool {
    !named_limbs(skeleton, None).is_empty()
}

/// The named limbs that hang on a node, or on any.
pub(crate) fn named_limbs(skeleton: &Skeleton, node: Option<usize>) -> Vec<usize> {
    let parents = skeleton.parents();
    let is_named: Vec<bool> =
        (0..skeleton.len()).map(|node| BoneName::new(name_of(skeleton, node)).has(ARMS)).collect();
    let carries_more = carrying(skeleton, &is_named);
    // Parents come before children: what hangs on the node and is not part of a limb itself.
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

/// What tells which bone a node is: VRM where it says, else the node's own name.
pub(crate) fn name_of(skeleton: &Skeleton, node: usize) -> &str {
    skeleton.nodes()[node].vrm_bone.as_ref().unwrap_or(&skeleton.names()[node])
}
