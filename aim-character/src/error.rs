//! Why something cannot be done with a character.

/// Why a character has no rig of its own, or a rig is none of its, or nothing can be baked.
///
/// `Display` is one line without the file's name: what is wrong and what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file, or names that no node has or several have.
    #[error("{0}")]
    Model(#[from] aim_gltf::Error),
    /// Nothing tells an eye, a head or a neck.
    #[error(
        "has no eye, head or neck that names or shape tell; name the chain from the effector inward with \
         `aim rig FILE --chain a,b,c`, or give a rig file with --rig"
    )]
    NoChain,
    /// A rig's joints that are no chain in this document, and what was expected.
    #[error("the rig does not fit the file: {0}")]
    Chain(String),
    /// A length, a rate or times of which no clip can be made, and what was expected.
    #[error("the clip cannot be written: {0}")]
    Clip(String),
    /// The bone of the mannequin whose given axes are no orthonormal triple.
    #[error("the axes of \"{0}\" are not three unit vectors at right angles; give up, forward and left so")]
    Axes(String),
    /// A named node moves nothing that is seen.
    #[error("{node:?} carries no bone of a skin; name bones with --chain")]
    NoBone {
        /// Its name.
        node: String,
    },
}
