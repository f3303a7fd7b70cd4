//! [`ChainNodes`]: the nodes of a file that the joints of a rig are.

use crate::error::Error;
use crate::skeleton::Skeleton;

/// The nodes that a rig's joints are in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChainNodes {
    /// One node a joint, from the effector inward.
    pub joints: Vec<usize>,
    /// The other eye: turned in the world as joint 0 is.
    pub other_eye: Option<usize>,
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
        let name = |node: usize| &skeleton.nodes()[node].name;
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
        Ok(Self { joints, other_eye })
    }

    /// Every node that is turned: the joints from the effector inward, then the other eye.
    pub(crate) fn turned(&self) -> impl Iterator<Item = usize> + '_ {
        self.joints.iter().copied().chain(self.other_eye)
    }
}

/// The node of the first of these names that one node has; else what is wrong with the first name.
fn find_first(skeleton: &Skeleton, names: &[String]) -> Result<usize, Error> {
    let mut found = names.iter().map(|name| skeleton.find(name));
    let first = found.next().unwrap_or(Err(Error::Chain("a joint without any bone name".into())));
    found.fold(first, |known, next| known.or_else(|error| next.map_err(|_| error)))
}
