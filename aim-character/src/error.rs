//! Why no rig could be proposed.

/// Why a file has no rig of its own.
///
/// `Display` is one line without the file's name: what is wrong and what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The named bones are no chain of the file, or a name means several.
    #[error("{0}")]
    Model(#[from] aim_gltf::Error),
    /// Nothing tells an eye, a head or a neck.
    #[error(
        "has no eye, head or neck that names or shape tell; name the chain from the effector inward with \
         `aim rig FILE --chain a,b,c`, or give a rig file with --rig"
    )]
    NoChain,
    /// A named node moves nothing that is seen.
    #[error("{node:?} carries no bone of a skin; name bones with --chain")]
    NoBone {
        /// Its name.
        node: String,
    },
}
