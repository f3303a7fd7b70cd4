//! [`TreeError`]: reasons why nodes do not form a tree.

use core::fmt;

/// Reason why nodes do not form a tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TreeError {
    /// A mask or a reference pose does not fit the skeleton.
    Length {
        /// The number of bones.
        bones: usize,
        /// The length of the mask or the pose.
        found: usize,
    },
    /// The numbers of places and nodes of a blend space differ.
    Places {
        /// The number of places.
        places: usize,
        /// The number of nodes.
        nodes: usize,
    },
    /// The transform of this bone in a reference pose is not finite, or its rotation is not a unit quaternion.
    Reference(usize),
    /// A mask was given to a node that is neither a blend nor an addition, or a reference pose to one that is not an
    /// addition.
    Mistaken,
    /// Nodes are nested more than 64 deep.
    Deep,
}

impl fmt::Display for TreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length { bones, found } => {
                write!(f, "a mask or a reference pose of {found} bones in a tree for {bones} bones")
            }
            Self::Places { places, nodes } => write!(f, "{nodes} nodes for the {places} places of a blend space"),
            Self::Reference(bone) => write!(
                f,
                "the transform of bone {bone} in a reference pose is not finite, or its rotation is no unit quaternion"
            ),
            Self::Mistaken => f.write_str(
                "a mask was given to what is neither a blend nor an addition, or a reference to what is no addition",
            ),
            Self::Deep => f.write_str("more than 64 blends one within the other"),
        }
    }
}

impl core::error::Error for TreeError {}
