//! The error type: each way in which a file can be unusable, with what was expected and what to do.

use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Why a file could not be read, understood or written.
///
/// `Display` is one line: what is wrong, what was expected, what to do. Paths appear only where the
/// failure belongs to a file other than the one that the caller named, or to the file system.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The file system refused to hand out a file.
    #[error("cannot read {}: {source}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// The file system refused to take a file; nothing was left behind.
    #[error("cannot write {}: {source}; nothing was changed, {}", .path.display(), remedy(.source))]
    Write {
        /// The file that should have appeared.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// A folder, a pipe or a device at this path, where a file is needed.
    #[error("{} is a folder or a device; give the path of a file", .0.display())]
    NotAFile(PathBuf),
    /// No bytes at all.
    #[error("the file is empty; expected a .glb, .gltf or .vrm file")]
    Empty,
    /// Neither a GLB container nor JSON text; its first bytes, at most four.
    #[error(
        "not a glTF file: it starts with the bytes {0:02x?}, but a .glb or .vrm starts with \"glTF\" and a .gltf with \"{{\"; \
         export the character as glTF 2.0"
    )]
    NotGltf(Vec<u8>),
    /// A GLB container whose header or chunks contradict the file's length, and what was expected.
    #[error("the GLB container is damaged: {0}; export or download the file again")]
    Container(String),
    /// A version other than glTF 2, as the file states it.
    #[error("this is glTF {0}, and only version 2 is understood; convert it to glTF 2.0")]
    Version(String),
    /// JSON that does not parse; the parser's message, with line and column.
    #[error("the JSON part does not parse: {0}; export or download the file again")]
    Json(String),
    /// A part of the document contradicts the glTF 2.0 specification.
    #[error("{place}: {problem}; the file breaks the glTF 2.0 specification, export it again")]
    Invalid {
        /// The place, such as `nodes[3].children[0]`.
        place: String,
        /// The contradiction, and what was expected.
        problem: String,
    },
    /// A buffer's bytes are needed and not at hand.
    #[error("{place}: {problem}")]
    NoData {
        /// The place, such as `buffers[1]`.
        place: String,
        /// The reason, and a remedy.
        problem: String,
    },
    /// No node of that name.
    #[error("no node is called \"{name}\"; {}", known(.nearest, "the nearest names are", "nodes"))]
    UnknownNode {
        /// The name asked for.
        name: String,
        /// The most similar names of the file, best first.
        nearest: Vec<String>,
    },
    /// Several nodes of that name, and not exactly one of them is a joint.
    #[error("{} nodes are called \"{name}\" (node indices {nodes:?}); rename all but one of them", .nodes.len())]
    AmbiguousNode {
        /// The name asked for.
        name: String,
        /// Their indices in the file.
        nodes: Vec<usize>,
    },
    /// No clip of that name.
    #[error("no clip is called \"{name}\"; {}", known(.available, "the file has", "clips"))]
    UnknownClip {
        /// The name asked for.
        name: String,
        /// The names of the file's clips.
        available: Vec<String>,
    },
    /// A clip handed over for writing that does not fit the document, and what was expected.
    #[error("the clip cannot be written: {0}")]
    Clip(String),
    /// Bones handed over that cannot be made a document, and what was expected.
    #[error("the bones cannot be made a document: {0}")]
    Bones(String),
}

impl Error {
    /// The message after the name of the file that was read, unless it names that already.
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

/// `introduction a, b, c`, cut after eight names; without names, that the file has no `things`.
fn known(names: &[String], introduction: &str, things: &str) -> String {
    match names {
        [] => format!("the file has no {things}"),
        _ if names.len() > 8 => format!("{introduction} {} and {} more", names[..8].join(", "), names.len() - 8),
        _ => format!("{introduction} {}", names.join(", ")),
    }
}

/// What to do about a file that cannot be written.
fn remedy(error: &io::Error) -> &'static str {
    if error.kind() == io::ErrorKind::NotFound { "make its folder first" } else { "choose another place" }
}
