//! [`TreeError`]: why nodes do not make a tree.

use core::fmt;

/// Why nodes are no tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TreeError {
    /// A mask or a reference pose is not of this skeleton.
    Length {
        /// The number of bones.
        bones: usize,
        /// The length of the mask or the pose.
        found: usize,
    },
    /// A blend space has another number of places than of nodes.
    Places {
        /// The number of places.
        places: usize,
        /// The number of nodes.
        nodes: usize,
    },
    /// A transform of a reference pose is not finite, or its rotation is no unit quaternion.
    Reference(usize),
    /// A mask was given to a node that is neither a blend nor an addition, or a reference to one that is no addition.
    Mistaken,
    /// There are more than 64 nodes one within the other.
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
