//! [`Held`]: what hangs on a joint that turns, but belongs to what carries it: the clavicles of many skeletons, which
//! hang on the neck.

use aim_model::BoneName;
use aim_runtime::{Description, Rig};
use glam::{DAffine3, DMat3, DQuat};

use crate::chain::{ChainNodes, Hold};
use crate::measure::Measurement;
use crate::skeleton::{Node, Skeleton};
use crate::trs::{Trs, orthonormal};

/// Words of the bones that arms begin with.
const ARMS: &str = "clavicle clavicles clav collar collarbone shoulder upperarm arm forearm lowerarm hand 肩 腕";

/// A node that keeps its place on the carrier of the joint that it hangs on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Held {
    pub(crate) node: usize,
    /// The [carrier](Description::carrier); `None` for what is not turned.
    carrier: Option<usize>,
}

impl Held {
    /// The nodes to hold while a rig turns those of the chain: those that the chain names, else the arms on head and neck.
    pub(crate) fn find(rig: &dyn Rig, skeleton: &Skeleton, measurement: &Measurement, chain: &ChainNodes) -> Vec<Self> {
        let description = rig.description();
        let holds = chain.holds.clone().unwrap_or_else(|| found(&description, skeleton, measurement, chain));
        let carrier = |joint: usize| description.carrier(joint).and_then(|carrier| chain.joints.get(carrier));
        holds.iter().map(|hold| Self { node: hold.node, carrier: carrier(hold.joint).copied() }).collect()
    }

    /// Moves it back to where its carrier has it. `animated` are the nodes in the world before anything was turned, and
    /// `turned` after it.
    pub(crate) fn hold(&self, skeleton: &Skeleton, pose: &mut [Trs], animated: &[DAffine3], turned: &[DAffine3]) {
        let node = self.node;
        let carried = self.carrier.map_or(DAffine3::IDENTITY, |by| turned[by] * animated[by].inverse());
        let Some(parent) = skeleton.nodes()[node].parent else { return };
        let local = turned[parent].inverse() * carried * animated[node];
        let unscaled = DMat3::from_diagonal(pose[node].scale.as_dvec3().recip());
        let rotation = DQuat::from_mat3(&orthonormal(&(local.matrix3 * unscaled)).0);
        // Hidden by a scale of 0, it has no place to keep.
        if local.is_finite() && unscaled.is_finite() && rotation.is_finite() {
            pose[node].rotation = rotation.normalize().as_quat();
            pose[node].translation = local.translation.as_vec3();
        }
    }
}

/// The arms that hang on the innermost joint of head and neck.
fn found(
    description: &Description<'_>,
    skeleton: &Skeleton,
    measurement: &Measurement,
    chain: &ChainNodes,
) -> Vec<Hold> {
    let is_of_head = |joint: &usize| description.joints()[*joint].role.is_of_head();
    let Some(joint) = (0..chain.joints.len()).rfind(is_of_head) else { return Vec::new() };
    limbs_on(skeleton, measurement, chain.joints[joint]).into_iter().map(|node| Hold { joint, node }).collect()
}

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

/// True if names or VRM tell an arm anywhere.
pub(crate) fn has_named_limbs(skeleton: &Skeleton) -> bool {
    !named_limbs(skeleton, None).is_empty()
}

/// The named limbs that hang on a node, or on any.
fn named_limbs(skeleton: &Skeleton, node: Option<usize>) -> Vec<usize> {
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
