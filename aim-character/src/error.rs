//! The error type of this crate.

/// Error of measuring a character, of fitting a rig to it, or of making a clip.
///
/// `Display` writes one line, without the name of the file: what is wrong and what to do about it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file cannot be read, or a name does not match exactly one node.
    #[error("{0}")]
    Model(#[from] aim_gltf::Error),
    /// No eye, head or neck was recognised by name or by shape.
    #[error(
        "no eye, head or neck found by name or shape; list the chain from the effector inward with \
         `aim rig FILE --chain a,b,c`, or give a rig file with --rig"
    )]
    NoChain,
    /// The joints of a rig do not form a chain in this document. The text says what was expected.
    #[error("{0}")]
    Chain(String),
    /// The given length, frame rate or times do not make a clip. The text says what was expected.
    #[error("cannot make the clip: {0}")]
    Clip(String),
    /// The axes given for the named bone of the mannequin are not orthonormal.
    #[error("the axes of \"{0}\" are not orthonormal; give up, forward and left as unit vectors at right angles")]
    Axes(String),
    /// A node named for the chain is not among the measured bones.
    #[error("{node:?} is not a bone of a skin; list bones with --chain")]
    NoBone {
        /// Name of the node.
        node: String,
    },
}
