//! [`Effector`]: what a bake aims, the rig's effector or one of its joints.

use aim_character::ChainNodes;
use aim_codegen::{EffectorSpec, RigSpec, Role};
use aim_gltf::Skeleton;

use crate::failure::{Failure, Result};
use crate::words::listed;

/// A joint to aim, with its origin and direction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Effector {
    /// Index of the joint, counted from the rig's effector inward: the value of
    /// [`Settings::effector`](aim_runtime::Settings::effector).
    pub(crate) joint: usize,
    /// Origin and direction, in the joint's bone space.
    pub(crate) ray: EffectorSpec,
}

impl Effector {
    /// Returns the rig's effector for joint 0, otherwise the forward direction of the joint's bone from the bone's
    /// origin.
    pub(crate) fn of(spec: &RigSpec, joint: usize) -> Self {
        let own = || EffectorSpec { frame: spec.joints[joint].frame, origin: [0.0; 3] };
        Self { joint, ray: if joint == 0 { spec.effector } else { own() } }
    }

    /// Returns the joint for a value of `--effector`: the name of a joint's bone, or a word such as `head` for the
    /// outermost joint of a role.
    ///
    /// # Errors
    /// The rig has no joint with that bone or role.
    pub(crate) fn named(word: &str, spec: &RigSpec, skeleton: &Skeleton, chain: &ChainNodes) -> Result<Self> {
        let bone = |joint: usize| skeleton.names()[chain.joints[joint]].as_str();
        let joints = 0..spec.joints.len();
        let outermost = |role| spec.joints.iter().position(|joint| joint.role == role);
        let by_name = joints.clone().find(|&joint| bone(joint) == word);
        let by_role = || ROLES.iter().find(|(_, known)| *known == word).and_then(|(role, _)| outermost(*role));
        if let Some(joint) = by_name.or_else(by_role) {
            return Ok(Self::of(spec, joint));
        }
        let roles = ROLES.iter().filter_map(|(role, word)| Some(format!("{word} ({})", bone(outermost(*role)?))));
        let bones = joints.map(|joint| bone(joint).to_owned());
        let [roles, bones] = [roles.collect::<Vec<_>>(), bones.collect()];
        let [roles, bones] = [&roles, &bones].map(|all| listed(&all.iter().map(String::as_str).collect::<Vec<_>>()));
        let or_roles = if roles.is_empty() { String::new() } else { format!("; its roles are {roles}") };
        Err(Failure::input(format!(
            "--effector {word}: the rig {} has no such joint; its bones are {bones}{or_roles}",
            spec.name
        )))
    }
}

/// Words of `--effector` for the outermost joint of each role.
const ROLES: [(Role, &str); 4] =
    [(Role::Eye, "eyes"), (Role::Head, "head"), (Role::Neck, "neck"), (Role::Chest, "chest")];
