//! Why no rig could be proposed.

use core::fmt;

/// Why a file has no rig of its own.
///
/// `Display` is one line without the file's name: what is wrong and what to do.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// The named bones are no chain of the file, or a name means several.
    Model(aim_gltf::Error),
    /// Nothing tells an eye, a head or a neck.
    NoChain,
    /// A named node moves nothing that is seen.
    NoBone {
        /// Its name.
        node: String,
    },
}

impl From<aim_gltf::Error> for Error {
    fn from(error: aim_gltf::Error) -> Self {
        Self::Model(error)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Model(error) => error.fmt(f),
            Self::NoChain => f.write_str(
                "has no eye, head or neck that names or shape tell; name the chain from the effector inward with \
                 `aim rig FILE --chain a,b,c`, or give a rig file with --rig",
            ),
            Self::NoBone { node } => write!(f, "{node:?} carries no bone of a skin; name bones with --chain"),
        }
    }
}

impl core::error::Error for Error {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Model(error) => Some(error),
            Self::NoChain | Self::NoBone { .. } => None,
        }
    }
}
