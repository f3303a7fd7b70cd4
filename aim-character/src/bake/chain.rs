//! [`ChainNodes`]: the nodes of a file that correspond to the joints of a rig.

use aim_gltf::Skeleton;
use aim_runtime::Description;

use crate::error::Error;
use crate::measure::Measurement;
use crate::measure::limbs::limbs_on;

/// A node below a joint of the chain that moves with the joint's carrier (usually the chest) instead of with the joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hold {
    /// Index of the joint in the chain, counted from the effector inward.
    pub joint: usize,
    /// Index of the held node.
    pub node: usize,
}

/// The nodes of a file that correspond to the joints of a rig.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChainNodes {
    /// Node of each joint, from the effector inward.
    pub joints: Vec<usize>,
    /// Node of the other eye, which turns with joint 0 or is aimed itself.
    pub other_eye: Option<usize>,
    /// Held nodes; `None` to hold the arms that are descendants of head or neck.
    pub holds: Option<Vec<Hold>>,
}

impl ChainNodes {
    /// Finds the nodes by name: for each joint, the first of its `bones` that matches exactly one node.
    ///
    /// `bones` lists the candidate names of each joint, from the effector inward.
    ///
    /// # Errors
    /// Fails if a joint has no candidate that matches exactly one node, if the other eye does not match exactly one, if
    /// a joint is not a descendant of the next one, or if joint 0 and the other eye are ancestor and descendant.
    pub fn find<'a>(
        skeleton: &Skeleton,
        bones: impl IntoIterator<Item = &'a [String]>,
        other_eye: Option<&str>,
    ) -> Result<Self, Error> {
        let name = |node: usize| &skeleton.names()[node];
        let hangs_on = |node: usize, ancestor: usize| skeleton.ancestry(node).any(|at| at == ancestor);
        let joints = bones.into_iter().map(|names| find_first(skeleton, names)).collect::<Result<Vec<_>, _>>()?;
        let apart = |pair: &&[usize]| pair[0] == pair[1] || !hangs_on(pair[0], pair[1]);
        if let Some(pair) = joints.windows(2).find(apart) {
            return Err(Error::Chain(format!(
                "{:?} is not below {:?} in the node tree; list the joints from the effector inward, each below the next",
                name(pair[0]),
                name(pair[1])
            )));
        }
        let other_eye = other_eye.map(|name| skeleton.find(name)).transpose()?;
        if let Some(other) = other_eye.filter(|&other| hangs_on(joints[0], other) || hangs_on(other, joints[0])) {
            return Err(Error::Chain(format!(
                "the other eye {:?} and {:?} are on one branch of the node tree; name the eye on the other side",
                name(other),
                name(joints[0])
            )));
        }
        Ok(Self { joints, other_eye, holds: None })
    }

    /// Sets the held nodes, each given by the joint that it descends from and by its name.
    ///
    /// # Errors
    /// Fails if a name does not match exactly one node or occurs twice, or if a node does not descend from its joint,
    /// is an ancestor of a joint or of the other eye, or descends from another held node.
    ///
    /// # Panics
    /// Panics if a joint's index is not below the number of joints.
    pub fn with_holds<'a>(
        mut self,
        skeleton: &Skeleton,
        holds: impl IntoIterator<Item = (usize, &'a str)>,
    ) -> Result<Self, Error> {
        let name = |node: usize| &skeleton.names()[node];
        let fail = |node: usize, what: String| Err(Error::Chain(format!("hold names {:?}, {what}", name(node))));
        let mut found: Vec<Hold> = Vec::new();
        for (joint, held) in holds {
            let node = skeleton.find(held).map_err(|error| Error::Chain(format!("hold: {error}")))?;
            if !skeleton.ancestry(node).skip(1).any(|at| at == self.joints[joint]) {
                let joint = name(self.joints[joint]);
                return fail(
                    node,
                    format!("which is not below {joint:?} in the node tree; hold it on the joint that carries it"),
                );
            }
            if let Some(turned) = self.turned().find(|&turned| skeleton.ancestry(turned).any(|at| at == node)) {
                return fail(node, format!("which carries {:?}, a bone that is turned; remove it", name(turned)));
            }
            if found.iter().any(|other| other.node == node) {
                return Err(Error::Chain(format!("hold names {:?} twice; remove one of them", name(node))));
            }
            found.push(Hold { joint, node });
        }
        for hold in &found {
            let above = |other: &&Hold| skeleton.ancestry(hold.node).skip(1).any(|at| at == other.node);
            if let Some(other) = found.iter().find(above) {
                let what = format!("which is below {:?} and held with it; remove it", name(other.node));
                return fail(hold.node, what);
            }
        }
        self.holds = Some(found);
        Ok(self)
    }

    /// Returns the nodes to hold while a rig turns the chain: those that were set, otherwise the arms on the innermost
    /// joint of head and neck.
    pub(crate) fn held(
        &self,
        description: &Description<'_>,
        skeleton: &Skeleton,
        measurement: &Measurement,
    ) -> Vec<Hold> {
        let is_of_head = |joint: &usize| description.joints()[*joint].role.is_of_head();
        let found = || {
            let joint = (0..self.joints.len()).rfind(is_of_head)?;
            let limbs = limbs_on(skeleton, measurement, self.joints[joint]).into_iter();
            Some(limbs.map(|node| Hold { joint, node }).collect())
        };
        self.holds.clone().or_else(found).unwrap_or_default()
    }

    /// Returns every node that the rig turns: the joints from the effector inward, then the other eye.
    pub(crate) fn turned(&self) -> impl Iterator<Item = usize> + '_ {
        self.joints.iter().copied().chain(self.other_eye)
    }
}

/// Returns the node of the first name that matches exactly one node; otherwise the error for the first name.
fn find_first(skeleton: &Skeleton, names: &[String]) -> Result<usize, Error> {
    let mut found = names.iter().map(|name| Ok(skeleton.find(name)?));
    let first = found.next().unwrap_or(Err(Error::Chain("a joint has no bone name".into())));
    found.fold(first, |known, next| known.or_else(|error| next.map_err(|_| error)))
}
