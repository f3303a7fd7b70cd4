//! The error type: every way in which a file can be unusable, what was expected, and what to do about it.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Reason why a file could not be read, understood or written.
///
/// `Display` gives one line: what is wrong, what was expected, what to do. A path appears only if the failure concerns
/// a file other than the one the caller named, or if it comes from the file system.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be read from the file system.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// A file could not be written; what was at its path before is unchanged.
    #[error("cannot write {}: {source}; nothing was changed there; {}", .path.display(), remedy(.source))]
    Write {
        /// The path that was to be written.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// The path is a folder, a pipe or a device, but a file is needed.
    #[error("{} is a folder or a device; give the path of a file", .0.display())]
    NotAFile(PathBuf),
    /// The file has no bytes.
    #[error("the file is empty; expected a .glb, .gltf or .vrm file")]
    Empty,
    /// The file is neither a GLB container nor JSON text; holds its first bytes, at most four.
    #[error(
        "not a glTF file: it starts with the bytes {0:02x?}, but a .glb or .vrm starts with \"glTF\" and a .gltf with \"{{\"; \
         export the character as glTF 2.0"
    )]
    NotGltf(Vec<u8>),
    /// The header or the chunks of a GLB container contradict the length of the file; holds what was expected.
    #[error("the GLB container is damaged: {0}; export or download the file again")]
    Container(String),
    /// The file is of another version than glTF 2; holds the version it states.
    #[error("this is glTF {0}, but only version 2 is supported; convert the file to glTF 2.0")]
    Version(String),
    /// The JSON does not parse; holds the parser's message, with line and column.
    #[error("the JSON is invalid: {0}; export or download the file again")]
    Json(String),
    /// A part of the document contradicts the glTF 2.0 specification.
    #[error("{place}: {problem}; the file violates the glTF 2.0 specification, export it again")]
    Invalid {
        /// The place, such as `nodes[3].children[0]`.
        place: String,
        /// The contradiction, and what was expected.
        problem: String,
    },
    /// The bytes of a buffer are needed but not available.
    #[error("{place}: {problem}")]
    NoData {
        /// The place, such as `buffers[1]`.
        place: String,
        /// The reason and a remedy.
        problem: String,
    },
    /// No node has this name.
    #[error("no node named \"{name}\"; {}", list_names(.nearest, "the nearest names are", "nodes"))]
    UnknownNode {
        /// The name asked for.
        name: String,
        /// The most similar names of the file, best first.
        nearest: Vec<String>,
    },
    /// Several nodes have this name, and not exactly one of them is a joint.
    #[error("{} nodes are named \"{name}\" (node indices {nodes:?}); rename all but one", .nodes.len())]
    AmbiguousNode {
        /// The name asked for.
        name: String,
        /// Indices of these nodes in the file.
        nodes: Vec<usize>,
    },
    /// No clip has this name.
    #[error("no clip named \"{name}\"; {}", list_names(.available, "the file has", "clips"))]
    UnknownClip {
        /// The name asked for.
        name: String,
        /// The names of the file's clips.
        available: Vec<String>,
    },
    /// A clip to be written does not fit the document; holds what was expected.
    #[error("cannot write the clip: {0}")]
    Clip(String),
    /// The bones given cannot be made into a document; holds what was expected.
    #[error("cannot make a document from the bones: {0}")]
    Bones(String),
}

impl Error {
    /// The message prefixed with the name of the file that was read, unless the message already contains it.
    #[must_use]
    pub fn in_file(&self, file: &Path) -> String {
        match self {
            Self::Read { path, .. } | Self::NotAFile(path) if path == file => self.to_string(),
            _ => format!("{}: {self}", file.display()),
        }
    }

    pub(crate) fn invalid(place: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Invalid { place: place.into(), problem: problem.into() }
    }
}

/// Formats `introduction a, b, c`, cut after eight names; for an empty list, says that the file has no `plural`.
fn list_names(names: &[String], introduction: &str, plural: &str) -> String {
    match names {
        [] => format!("the file has no {plural}"),
        _ if names.len() > 8 => format!("{introduction} {} and {} more", names[..8].join(", "), names.len() - 8),
        _ => format!("{introduction} {}", names.join(", ")),
    }
}

/// Remedy for a file that cannot be written.
fn remedy(error: &io::Error) -> &'static str {
    if error.kind() == io::ErrorKind::NotFound { "create its folder first" } else { "choose another path" }
}
