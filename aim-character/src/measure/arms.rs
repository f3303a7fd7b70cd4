//! Arms as names and VRM tell them.

use aim_gltf::{Node, Skeleton};
use aim_model::BoneName;

/// Words of the bones that arms begin with.
const ARMS: &str = "clavicle clavicles clav collar collarbone shoulder upperarm arm forearm lowerarm hand 肩 腕";

/// True if names or VRM tell an arm anywhere.
pub(crate) fn has_named_limbs(skeleton: &Skeleton) -> bool {
    !named_limbs(skeleton, None).is_empty()
}

/// The named limbs that hang on a node, or on any.
pub(crate) fn named_limbs(skeleton: &Skeleton, node: Option<usize>) -> Vec<usize> {
    let nodes = skeleton.nodes();
    let is_named: Vec<bool> = nodes.iter().map(|node| BoneName::new(name_of(node)).has(ARMS)).collect();
    let mut carries_more = vec![false; nodes.len()];
    for &at in skeleton.order().iter().rev() {
        if let Some(parent) = nodes[at].parent {
            carries_more[parent] |= is_named[at] || carries_more[at];
        }
    }
    // Parents come before children: what hangs on the node and is not part of a limb itself.
    let (mut hangs, mut limbs) = (vec![false; nodes.len()], Vec::new());
    for &at in skeleton.order() {
        let hangs_here = nodes[at].parent.map_or(node.is_none(), |parent| Some(parent) == node || hangs[parent]);
        if !hangs_here {
            continue;
        }
        if is_named[at] && carries_more[at] { limbs.push(at) } else { hangs[at] = true }
    }
    limbs.sort_unstable();
    limbs
}

/// What tells which bone a node is: VRM where it says, else the node's own name.
pub(crate) fn name_of(node: &Node) -> &str {
    node.vrm_bone.as_ref().unwrap_or(&node.name)
}
