//! Bones by the names, or paths, that rigs and users give.

use aim::Rig;

use crate::find::Node;
use crate::{AimCharacter, Unbound};

/// The node of a name, or of a path that ends with it. Of several the only one that will do.
pub(crate) fn find(below: &[Node<'_>], wanted: &str, will_do: impl Fn(usize) -> bool) -> Option<usize> {
    let nodes = named(below, wanted);
    only(&nodes).or_else(|| only(&nodes.into_iter().filter(|&node| will_do(node)).collect::<Vec<_>>()))
}

/// The bone of each joint of the rig. Of several bones of a name the one counts that makes a chain with the others': a bone and the
/// mesh that it moves often share theirs.
pub(crate) fn joints(character: &AimCharacter, rig: &dyn Rig, below: &[Node<'_>]) -> Result<Vec<usize>, Unbound> {
    let count = rig.description().joints().len();
    let mut bones: Vec<Vec<usize>> = (0..count).map(|joint| candidates(character, rig, below, joint)).collect();
    let some_hangs = |outer: &[usize], inner: &[usize]| {
        outer.iter().any(|&outer| inner.iter().any(|&inner| hangs_on(below, outer, inner)))
    };
    // Those that hang on one of the next joint's; then those of them that carry one of the joint's before. What remains is in a chain.
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

/// True if a node hangs on another one, by any number of nodes.
pub(crate) fn hangs_on(below: &[Node<'_>], node: usize, on: usize) -> bool {
    std::iter::successors(below[node].parent, |&at| below[at].parent).any(|at| at == on)
}

/// The bones of the first of the joint's names that one bone has; else of the first that several have.
fn candidates(character: &AimCharacter, rig: &dyn Rig, below: &[Node<'_>], joint: usize) -> Vec<usize> {
    let mut bones: Vec<Vec<usize>> = wanted(character, rig, joint).map(|name| named(below, name)).collect();
    bones.retain(|bones| !bones.is_empty());
    let first = bones.iter().position(|bones| bones.len() == 1).unwrap_or_default();
    if bones.is_empty() { Vec::new() } else { bones.swap_remove(first) }
}

/// The names of a joint's bone, best first: the one that the character gives, else those that the rig declares, else the joint's own.
pub(crate) fn wanted<'a>(character: &'a AimCharacter, rig: &'a dyn Rig, joint: usize) -> impl Iterator<Item = &'a str> {
    let given = character.bones.iter().rev().find(|(of, _)| *of == joint).map(|(_, name)| &name[..]);
    let declared = (0..).map_while(move |candidate| rig.bone_name(joint, candidate));
    let own = rig.bone_name(joint, 0).is_none().then(|| rig.joint_name(joint)).flatten();
    let of_rig = declared.chain(own).filter(move |_| given.is_none());
    given.into_iter().chain(of_rig)
}

/// The nodes of a name; where there is none, those of a path.
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

/// Leaves those of several that will do; a single one stays, so that it is told why it does not.
fn retain(bones: &mut Vec<usize>, will_do: impl Fn(&usize) -> bool) {
    if bones.len() > 1 {
        bones.retain(will_do);
    }
}

fn only(nodes: &[usize]) -> Option<usize> {
    if let [only] = nodes { Some(*only) } else { None }
}
