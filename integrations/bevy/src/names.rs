//! Finds bones by name or path.

use aim::Rig;

use crate::find::Node;
use crate::{AimCharacter, Unbound};

/// Returns the node with this name or path. If several match, returns the only one for which `will_do` is true, or
/// `None`.
pub(crate) fn find(below: &[Node<'_>], wanted: &str, will_do: impl Fn(usize) -> bool) -> Option<usize> {
    let nodes = named(below, wanted);
    only(&nodes).or_else(|| only(&nodes.into_iter().filter(|&node| will_do(node)).collect::<Vec<_>>()))
}

/// Returns the bone of each joint of the rig. A bone and the mesh that it moves often share a name: among several
/// matches, the one that forms a chain with the bones of the other joints is used.
pub(crate) fn joints(character: &AimCharacter, rig: &dyn Rig, below: &[Node<'_>]) -> Result<Vec<usize>, Unbound> {
    let count = rig.description().joints().len();
    let mut bones: Vec<Vec<usize>> = (0..count).map(|joint| candidates(character, rig, below, joint)).collect();
    let some_hangs = |outer: &[usize], inner: &[usize]| {
        outer.iter().any(|&outer| inner.iter().any(|&inner| hangs_on(below, outer, inner)))
    };
    // Outward pass: keep candidates that descend from a candidate of the next joint. Inward pass: keep those that are
    // an ancestor of a candidate of the previous joint. Every candidate that remains is part of a chain.
    for joint in (1..count).rev() {
        let inner = bones[joint].clone();
        retain(&mut bones[joint - 1], |&bone| some_hangs(&[bone], &inner));
    }
    for joint in 1..count {
        let outer = bones[joint - 1].clone();
        retain(&mut bones[joint], |&bone| some_hangs(&outer, &[bone]));
    }
    bones.iter().enumerate().map(|(joint, bones)| only(bones).ok_or(Unbound::Joint(joint))).collect()
}

/// Returns `true` if `on` is an ancestor of `node`.
pub(crate) fn hangs_on(below: &[Node<'_>], node: usize, on: usize) -> bool {
    std::iter::successors(below[node].parent, |&at| below[at].parent).any(|at| at == on)
}

/// Returns the candidates for a joint's bone: the bone of the first name that exactly one bone has, otherwise all bones
/// of the first name that several have.
fn candidates(character: &AimCharacter, rig: &dyn Rig, below: &[Node<'_>], joint: usize) -> Vec<usize> {
    let mut bones: Vec<Vec<usize>> = wanted(character, rig, joint).map(|name| named(below, name)).collect();
    bones.retain(|bones| !bones.is_empty());
    let first = bones.iter().position(|bones| bones.len() == 1).unwrap_or_default();
    if bones.is_empty() { Vec::new() } else { bones.swap_remove(first) }
}

/// Returns the names of a joint's bone in order of preference: the name given by the character, otherwise those
/// declared by the rig, otherwise the joint's own.
pub(crate) fn wanted<'a>(character: &'a AimCharacter, rig: &'a dyn Rig, joint: usize) -> impl Iterator<Item = &'a str> {
    let given = character.bones.iter().rev().find(|(of, _)| *of == joint).map(|(_, name)| &name[..]);
    let declared = (0..).map_while(move |candidate| rig.bone_name(joint, candidate));
    let own = rig.bone_name(joint, 0).is_none().then(|| rig.joint_name(joint)).flatten();
    let of_rig = declared.chain(own).filter(move |_| given.is_none());
    given.into_iter().chain(of_rig)
}

/// Returns the nodes with this name. If there are none and the text contains `/`, it is matched as a path.
fn named(below: &[Node<'_>], wanted: &str) -> Vec<usize> {
    let has_path = |node: &usize| {
        let mut at = Some(*node);
        wanted.rsplit('/').all(|part| {
            let Some(node) = at.map(|at| &below[at]) else { return false };
            at = node.parent;
            node.name == part
        })
    };
    let mut nodes: Vec<usize> = (0..below.len()).filter(|&node| below[node].name == wanted).collect();
    if nodes.is_empty() && wanted.contains('/') {
        nodes.extend((0..below.len()).filter(has_path));
    }
    nodes
}

/// Filters the candidates. A single candidate is kept even if it fails, so that the error can report why it does not
/// fit.
fn retain(bones: &mut Vec<usize>, will_do: impl Fn(&usize) -> bool) {
    if bones.len() > 1 {
        bones.retain(will_do);
    }
}

fn only(nodes: &[usize]) -> Option<usize> {
    if let [only] = nodes { Some(*only) } else { None }
}
