//! The error type: each way in which a file can be unusable, with what was expected and what to do.

use core::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a file could not be read, understood or written.
///
/// `Display` is one line: what is wrong, what was expected, what to do. Paths appear only where the
/// failure belongs to a file other than the one that the caller named, or to the file system.
#[derive(Debug)]
#[non_exhaustive]
pub enum Error {
    /// The file system refused to hand out a file.
    Read {
        /// The file.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// The file system refused to take a file; nothing was left behind.
    Write {
        /// The file that should have appeared.
        path: PathBuf,
        /// The operating system's error.
        source: io::Error,
    },
    /// A folder, a pipe or a device at this path, where a file is needed.
    NotAFile(PathBuf),
    /// No bytes at all.
    Empty,
    /// Neither a GLB container nor JSON text; its first bytes, at most four.
    NotGltf(Vec<u8>),
    /// A GLB container whose header or chunks contradict the file's length, and what was expected.
    Container(String),
    /// A version other than glTF 2, as the file states it.
    Version(String),
    /// JSON that does not parse; the parser's message, with line and column.
    Json(String),
    /// A part of the document contradicts the glTF 2.0 specification.
    Invalid {
        /// The place, such as `nodes[3].children[0]`.
        place: String,
        /// The contradiction, and what was expected.
        problem: String,
    },
    /// A buffer's bytes are needed and not at hand.
    NoData {
        /// The place, such as `buffers[1]`.
        place: String,
        /// The reason, and a remedy.
        problem: String,
    },
    /// No node of that name.
    UnknownNode {
        /// The name asked for.
        name: String,
        /// The most similar names of the file, best first.
        nearest: Vec<String>,
    },
    /// Several nodes of that name, and not exactly one of them is a joint.
    AmbiguousNode {
        /// The name asked for.
        name: String,
        /// Their node indices.
        nodes: Vec<usize>,
    },
    /// No clip of that name.
    UnknownClip {
        /// The name asked for.
        name: String,
        /// The names of the file's clips.
        available: Vec<String>,
    },
    /// A clip handed over for writing that does not fit the document, and what was expected.
    Clip(String),
    /// A rig's joints that are no chain in this document, and what was expected.
    Chain(String),
    /// The bone of the mannequin whose given axes are no orthonormal triple.
    Axes(String),
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

/// `a, b, c`, cut after eight names.
fn list(names: &[String]) -> String {
    let mut text = names.iter().take(8).map(String::as_str).collect::<Vec<_>>().join(", ");
    if names.len() > 8 {
        text.push_str(&format!(" and {} more", names.len() - 8));
    }
    text
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Read { path, source } => write!(f, "cannot read {}: {source}", path.display()),
            Self::Write { path, source } => {
                let hint = match source.kind() {
                    io::ErrorKind::NotFound => "make its folder first",
                    _ => "choose another place",
                };
                write!(f, "cannot write {}: {source}; nothing was changed, {hint}", path.display())
            }
            Self::NotAFile(path) => {
                write!(f, "{} is a folder or a device; give the path of a file", path.display())
            }
            Self::Empty => write!(f, "the file is empty; expected a .glb, .gltf or .vrm file"),
            Self::NotGltf(found) => write!(
                f,
                "not a glTF file: it starts with the bytes {found:02x?}, but a .glb or .vrm starts with \"glTF\" \
                 and a .gltf with \"{{\"; export the character as glTF 2.0"
            ),
            Self::Container(problem) => {
                write!(f, "the GLB container is damaged: {problem}; export or download the file again")
            }
            Self::Version(found) => {
                write!(f, "this is glTF {found}, and only version 2 is understood; convert it to glTF 2.0")
            }
            Self::Json(message) => {
                write!(f, "the JSON part does not parse: {message}; export or download the file again")
            }
            Self::Invalid { place, problem } => {
                write!(f, "{place}: {problem}; the file breaks the glTF 2.0 specification, export it again")
            }
            Self::NoData { place, problem } => write!(f, "{place}: {problem}"),
            Self::UnknownNode { name, nearest } if nearest.is_empty() => {
                write!(f, "no node is called \"{name}\"; the file has no nodes")
            }
            Self::UnknownNode { name, nearest } => {
                write!(f, "no node is called \"{name}\"; the nearest names are {}", list(nearest))
            }
            Self::AmbiguousNode { name, nodes } => write!(
                f,
                "{} nodes are called \"{name}\" (node indices {nodes:?}); rename all but one of them",
                nodes.len()
            ),
            Self::UnknownClip { name, available } if available.is_empty() => {
                write!(f, "no clip is called \"{name}\"; the file has no clips")
            }
            Self::UnknownClip { name, available } => {
                write!(f, "no clip is called \"{name}\"; the file has {}", list(available))
            }
            Self::Clip(problem) => write!(f, "the clip cannot be written: {problem}"),
            Self::Chain(problem) => write!(f, "the rig does not fit the file: {problem}"),
            Self::Axes(bone) => write!(
                f,
                "the axes of \"{bone}\" are not three unit vectors at right angles; give up, forward and left so"
            ),
        }
    }
}

impl core::error::Error for Error {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Read { source, .. } | Self::Write { source, .. } => Some(source),
            _ => None,
        }
    }
}
