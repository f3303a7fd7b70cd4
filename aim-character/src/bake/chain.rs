//! [`ChainNodes`]: the nodes of a file that the joints of a rig are.

use aim_gltf::Skeleton;
use aim_runtime::Description;

use crate::error::Error;
use crate::measure::Measurement;
use crate::measure::limbs::limbs_on;

/// A node that hangs on a joint of a chain and keeps its place on what carries the joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hold {
    /// The joint, counted from the effector inward.
    pub joint: usize,
    /// The node.
    pub node: usize,
}

/// The nodes that a rig's joints are in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChainNodes {
    /// One node a joint, from the effector inward.
    pub joints: Vec<usize>,
    /// The other eye: turned in the world as joint 0 is.
    pub other_eye: Option<usize>,
    /// The nodes that are held; `None` to find them: the arms that hang on head or neck.
    pub holds: Option<Vec<Hold>>,
}

impl ChainNodes {
    /// Finds the nodes by name: for each joint the first of `bones` that the file has.
    ///
    /// # Errors
    /// A bone or other eye that is not there or not unique; joints that are not each other's descendants; another eye
    /// that is not beside joint 0 but above or below it.
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
                "{:?} does not hang on {:?}; list the joints from the effector inward, each below the next in the node tree",
                name(pair[0]),
                name(pair[1])
            )));
        }
        let other_eye = other_eye.map(|name| skeleton.find(name)).transpose()?;
        if let Some(other) = other_eye.filter(|&other| hangs_on(joints[0], other) || hangs_on(other, joints[0])) {
            return Err(Error::Chain(format!(
                "the other eye {:?} and {:?} hang on each other; name the other eye, beside this one",
                name(other),
                name(joints[0])
            )));
        }
        Ok(Self { joints, other_eye, holds: None })
    }

    /// With these nodes held, each given by the joint that it hangs on and by name.
    ///
    /// # Errors
    /// A name that no node has, or several; a node that is named twice, that does not hang on its joint, that carries a joint
    /// or the other eye, or that hangs on another one that is held.
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
                return fail(node, format!("which does not hang on {joint:?}; name it on the joint that it hangs on"));
            }
            if let Some(turned) = self.turned().find(|&turned| skeleton.ancestry(turned).any(|at| at == node)) {
                return fail(node, format!("which carries {:?}, a bone that is turned; leave it out", name(turned)));
            }
            if found.iter().any(|other| other.node == node) {
                return Err(Error::Chain(format!("hold names {:?} twice; once is enough", name(node))));
            }
            found.push(Hold { joint, node });
        }
        for hold in &found {
            let above = |other: &&Hold| skeleton.ancestry(hold.node).skip(1).any(|at| at == other.node);
            if let Some(other) = found.iter().find(above) {
                let what = format!("which hangs on {:?} and stays with it; leave it out", name(other.node));
                return fail(hold.node, what);
            }
        }
        self.holds = Some(found);
        Ok(self)
    }

    /// The nodes to hold while a rig turns the chain's: those that were named, else the arms on the innermost joint of head and neck.
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

    /// Every node that is turned: the joints from the effector inward, then the other eye.
    pub(crate) fn turned(&self) -> impl Iterator<Item = usize> + '_ {
        self.joints.iter().copied().chain(self.other_eye)
    }
}

/// The node of the first of these names that one node has; else what is wrong with the first name.
fn find_first(skeleton: &Skeleton, names: &[String]) -> Result<usize, Error> {
    let mut found = names.iter().map(|name| Ok(skeleton.find(name)?));
    let first = found.next().unwrap_or(Err(Error::Chain("a joint without any bone name".into())));
    found.fold(first, |known, next| known.or_else(|error| next.map_err(|_| error)))
}
