//! [`Document`]: a loaded file. Its JSON and binary chunk are kept unchanged; the parts that are understood are
//! validated and typed.

use core::fmt;
use core::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use aim_animation::Clip;
use serde_json::Value;

use crate::accessor::Data;
use crate::bones::bones_as_json;
use crate::clip::{MorphScalars, read_clips};
use crate::container;
use crate::error::Error;
use crate::morph_eyes::names_morph_eyes;
use crate::raw::Raw;
use crate::skeleton::Skeleton;
use crate::skin::{self, SkinnedPoint};
use crate::uri::{self, Uri};

/// Location of the bytes of a buffer.
pub(crate) enum Buffer {
    /// The GLB's binary chunk.
    Chunk,
    /// Decoded from a data URI, or read from a file beside the document.
    Loaded {
        bytes: Vec<u8>,
        /// `true` if the bytes were read from another file, `false` if from a data URI.
        external: bool,
    },
    /// Not available: a placeholder that a compression extension fills.
    Missing,
}

/// A glTF 2.0 document (`.glb`, `.gltf`, `.vrm`), ready to be measured, sampled and written with new clips.
///
/// Everything reachable from a document has been validated: indices exist, the nodes form a forest, data lies inside
/// its buffers, numbers are finite.
///
/// ```
/// use aim_gltf::Document;
///
/// # let folder = std::env::temp_dir();
/// # let path = folder.join("aim-gltf-example.gltf");
/// # std::fs::write(&path, r#"{ "asset": { "version": "2.0" }, "nodes": [{ "name": "hips", "children": [1] }, { "name": "head" }] }"#)?;
/// let document = Document::load(path)?;
/// let (skeleton, head) = (document.skeleton(), document.skeleton().find("head")?);
/// assert_eq!(skeleton.parents()[head], Some(skeleton.find("hips")?));
/// let pose = match document.default_clip() {
///     Some(clip) => skeleton.pose(clip, 0.5),
///     None => skeleton.rest().to_vec(),
/// };
/// # assert_eq!(pose.len(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Document {
    /// The JSON part as text, known to parse. For a document made from bones it is generated on first use.
    text: OnceLock<Vec<u8>>,
    /// The JSON part as a tree, about ten times as large as the text: parsed on first use.
    json: OnceLock<Value>,
    pub(crate) extensions: Value,
    pub(crate) chunk: Option<Vec<u8>>,
    pub(crate) buffers: Vec<Buffer>,
    pub(crate) folder: Option<PathBuf>,
    skeleton: Skeleton,
    clips: Vec<Clip>,
    pub(crate) morph_scalars: MorphScalars,
    points: Vec<SkinnedPoint>,
    names_morph_eyes: bool,
}

/// The parts of a file, before they are checked.
pub(crate) struct DocumentParts {
    pub(crate) raw: Raw,
    pub(crate) extensions: Value,
    pub(crate) text: Option<Vec<u8>>,
    pub(crate) chunk: Option<Vec<u8>>,
    pub(crate) folder: Option<PathBuf>,
}

/// Function that reads the clips. Passed as a parameter so that a program without clips does not link the clip reader.
pub(crate) type ReadClips = fn(&Data<'_>, &Skeleton) -> Result<(Vec<Clip>, MorphScalars), Error>;

/// A [`ReadClips`] that reads no clips.
pub(crate) fn no_clips(_: &Data<'_>, _: &Skeleton) -> Result<(Vec<Clip>, MorphScalars), Error> {
    Ok(Default::default())
}

impl fmt::Debug for Document {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Document")
            .field("nodes", &self.skeleton.len())
            .field("clips", &self.clips.len())
            .finish_non_exhaustive()
    }
}

impl Document {
    /// Loads a file. Paths of external buffers are relative to its folder.
    ///
    /// # Errors
    /// Any [`Error`] that makes the file unreadable or contradictory.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let bytes = uri::read_file(path)?;
        Self::parse(bytes, Some(path.parent().unwrap_or(Path::new(""))), read_clips)
    }

    /// Reads a document from memory. External buffers are an error, because there is no folder to look in.
    ///
    /// # Errors
    /// Any [`Error`] that makes the file unreadable or contradictory.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        Self::parse(bytes.to_vec(), None, read_clips)
    }

    /// Reads a document from memory without its clips, which are not validated either. For characters that are only
    /// measured, or that are animated by another program.
    ///
    /// # Errors
    /// As [`from_bytes`](Self::from_bytes), except for errors in clips.
    pub fn without_clips(bytes: &[u8]) -> Result<Self, Error> {
        Self::parse(bytes.to_vec(), None, no_clips)
    }

    fn parse(mut bytes: Vec<u8>, folder: Option<&Path>, read: ReadClips) -> Result<Self, Error> {
        let parts = container::split(&bytes)?;
        let text = parts.json.to_vec();
        let (raw, extensions) = Raw::parse(&text)?;
        // Reuse the allocation for the chunk, so that a large file is in memory only once.
        let chunk = parts.bin.map(|bin| {
            bytes.truncate(bin.end);
            bytes.drain(..bin.start);
            bytes.shrink_to_fit();
            bytes
        });
        Self::of_parts(
            DocumentParts { raw, extensions, text: Some(text), chunk, folder: folder.map(Path::to_path_buf) },
            read,
        )
    }

    pub(crate) fn of_parts(parts: DocumentParts, read: ReadClips) -> Result<Self, Error> {
        let DocumentParts { raw, extensions, text, chunk, folder } = parts;
        let buffers = load_buffers(&raw, chunk.as_deref(), folder.as_deref())?;
        let slices: Vec<_> = buffers.iter().map(|b| bytes_of(b, chunk.as_deref())).collect();
        let data = Data::new(&raw, &slices);
        let skeleton = Skeleton::read(&data, &extensions)?;
        let (clips, morph_scalars) = read(&data, &skeleton)?;
        let points = skin::read_points(&data, &skeleton)?;
        Ok(Self {
            text: text.map(OnceLock::from).unwrap_or_default(),
            json: OnceLock::new(),
            names_morph_eyes: raw.meshes.iter().any(names_morph_eyes),
            extensions,
            chunk,
            buffers,
            folder,
            skeleton,
            clips,
            morph_scalars,
            points,
        })
    }

    /// The nodes, with their rest pose and bind pose.
    #[must_use]
    pub fn skeleton(&self) -> &Skeleton {
        &self.skeleton
    }

    /// The animation clips, in the file's order. Their bones are those of the [skeleton](Self::skeleton); their scalars
    /// are the weights of morph targets, numbered by [`morph_scalars`](Self::morph_scalars).
    #[must_use]
    pub fn clips(&self) -> &[Clip] {
        &self.clips
    }

    /// Returns the range of scalars that are the weights of a node's morph targets; empty if the node has none.
    #[must_use]
    pub fn morph_scalars(&self, node: usize) -> Range<usize> {
        self.morph_scalars.get(&node).cloned().unwrap_or_default()
    }

    /// Returns the clip with this name; the first one, if several share it.
    ///
    /// # Errors
    /// [`Error::UnknownClip`], which lists the names of the file's clips.
    pub fn clip(&self, name: &str) -> Result<&Clip, Error> {
        self.clips.iter().find(|clip| clip.name() == name).ok_or_else(|| Error::UnknownClip {
            name: name.into(),
            available: self.clips.iter().map(|clip| clip.name().to_owned()).collect(),
        })
    }

    /// Returns the clip to show when none was chosen: the first whose name contains `idle` (in any case), else the
    /// first.
    ///
    /// Files often list clips alphabetically, and the first of those tends to be an attack, a dance or a death.
    #[must_use]
    pub fn default_clip(&self) -> Option<&Clip> {
        let is_idle = |clip: &&Clip| clip.name().to_ascii_lowercase().contains("idle");
        self.clips.iter().find(is_idle).or(self.clips.first())
    }

    /// The JSON part as it is in the file, with its members in the file's order.
    #[must_use]
    pub fn json(&self) -> &Value {
        self.json.get_or_init(|| serde_json::from_slice(self.text()).unwrap_or_default())
    }

    /// The JSON part as text.
    pub(crate) fn text(&self) -> &[u8] {
        self.text.get_or_init(|| bones_as_json(self).to_string().into_bytes())
    }

    /// Returns `true` if a mesh names morph targets of `ARKit` that turn the eyes (`eyeLookInLeft` etc.), even if it
    /// lacks the targets themselves.
    #[must_use]
    pub fn names_morph_eyes(&self) -> bool {
        self.names_morph_eyes
    }

    /// Paths of the files that this document refers to: buffers and images. Empty for a document read from memory.
    #[must_use]
    pub fn external_files(&self) -> Vec<PathBuf> {
        let Some(folder) = &self.folder else { return Vec::new() };
        let entries = ["buffers", "images"].iter().filter_map(|list| self.json().get(list)?.as_array()).flatten();
        let uris = entries.filter_map(|entry| entry.get("uri")?.as_str());
        uris.filter_map(|text| match uri::parse(text, "") {
            Ok(Uri::Relative(path)) => Some(folder.join(path)),
            _ => None,
        })
        .collect()
    }

    /// The GLB's binary chunk as it is in the file, including its padding.
    #[must_use]
    pub fn binary_chunk(&self) -> Option<&[u8]> {
        self.chunk.as_deref()
    }

    /// The vertices of every mesh, with the joints that they are bound to.
    #[must_use]
    pub fn points(&self) -> &[SkinnedPoint] {
        &self.points
    }
}

/// Returns the bytes of a buffer; `None` if they are missing.
pub(crate) fn bytes_of<'a>(buffer: &'a Buffer, chunk: Option<&'a [u8]>) -> Option<&'a [u8]> {
    match buffer {
        Buffer::Chunk => chunk,
        Buffer::Loaded { bytes, .. } => Some(bytes),
        Buffer::Missing => None,
    }
}

fn load_buffers(raw: &Raw, chunk: Option<&[u8]>, folder: Option<&Path>) -> Result<Vec<Buffer>, Error> {
    let mut out = Vec::with_capacity(raw.buffers.len());
    for (index, buffer) in raw.buffers.iter().enumerate() {
        let place = format!("buffers[{index}]");
        let loaded = match (&buffer.uri, index, chunk) {
            (None, 0, Some(_)) => Buffer::Chunk,
            (None, ..) => Buffer::Missing,
            (Some(uri), ..) => match uri::parse(uri, &place)? {
                Uri::Data(bytes) => Buffer::Loaded { bytes, external: false },
                Uri::Relative(path) => {
                    let Some(folder) = folder else {
                        return Err(Error::NoData {
                            place,
                            problem: format!("its data is in {}; load the document from its file", path.display()),
                        });
                    };
                    Buffer::Loaded { bytes: uri::read_file(&folder.join(path))?, external: true }
                }
            },
        };
        if let Some(bytes) = bytes_of(&loaded, chunk) {
            if bytes.len() < buffer.byte_length {
                let (claimed, there) = (buffer.byte_length, bytes.len());
                let problem =
                    format!("it declares {claimed} bytes, but only {there} are present (is the file cut off?)");
                return Err(Error::invalid(place, problem));
            }
        }
        out.push(loaded);
    }
    Ok(out)
}
