//! Typed parts of the JSON. Everything else stays unread in the document's `Value`.

use std::collections::BTreeMap;

use serde_json::Value;
use serde_json::value::RawValue;

use crate::error::Error;
use crate::members::{FromJson, MemberError, Members};

#[derive(Default)]
pub(crate) struct Node {
    pub(crate) name: Option<String>,
    pub(crate) children: Vec<usize>,
    pub(crate) mesh: Option<usize>,
    pub(crate) skin: Option<usize>,
    pub(crate) matrix: Option<[f64; 16]>,
    pub(crate) translation: Option<[f64; 3]>,
    pub(crate) rotation: Option<[f64; 4]>,
    pub(crate) scale: Option<[f64; 3]>,
    /// An array of numbers in a valid file. Kept untyped so that a malformed one does not make the file unreadable.
    pub(crate) weights: Value,
}

impl FromJson for Node {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self {
            name: members.optional("name")?,
            children: members.or_default("children")?,
            mesh: members.optional("mesh")?,
            skin: members.optional("skin")?,
            matrix: members.optional("matrix")?,
            translation: members.optional("translation")?,
            rotation: members.optional("rotation")?,
            scale: members.optional("scale")?,
            weights: members.take("weights").unwrap_or_default(),
        })
    }
}

pub(crate) struct Skin {
    pub(crate) joints: Vec<usize>,
    pub(crate) inverse_bind_matrices: Option<usize>,
}

impl FromJson for Skin {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self {
            joints: members.required("joints")?,
            inverse_bind_matrices: members.optional("inverseBindMatrices")?,
        })
    }
}

pub(crate) struct Accessor {
    pub(crate) buffer_view: Option<usize>,
    pub(crate) byte_offset: usize,
    pub(crate) component_type: u32,
    pub(crate) normalized: bool,
    pub(crate) count: usize,
    pub(crate) shape: String,
    pub(crate) sparse: Option<Sparse>,
}

impl Accessor {
    /// Describes the first `count` elements of a buffer view as single-precision floats.
    pub(crate) fn of_floats(view: usize, count: usize, shape: &str) -> Self {
        Self {
            buffer_view: Some(view),
            byte_offset: 0,
            component_type: 5126,
            normalized: false,
            count,
            shape: shape.into(),
            sparse: None,
        }
    }
}

impl FromJson for Accessor {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self {
            buffer_view: members.optional("bufferView")?,
            byte_offset: members.or_default("byteOffset")?,
            component_type: members.required("componentType")?,
            normalized: members.or_default("normalized")?,
            count: members.required("count")?,
            shape: members.required("type")?,
            sparse: members.optional("sparse")?,
        })
    }
}

pub(crate) struct Sparse {
    pub(crate) count: usize,
    pub(crate) indices: SparseIndices,
    pub(crate) values: SparseValues,
}

impl FromJson for Sparse {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self {
            count: members.required("count")?,
            indices: members.required("indices")?,
            values: members.required("values")?,
        })
    }
}

pub(crate) struct SparseIndices {
    pub(crate) buffer_view: usize,
    pub(crate) byte_offset: usize,
    pub(crate) component_type: u32,
}

impl FromJson for SparseIndices {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self {
            buffer_view: members.required("bufferView")?,
            byte_offset: members.or_default("byteOffset")?,
            component_type: members.required("componentType")?,
        })
    }
}

pub(crate) struct SparseValues {
    pub(crate) buffer_view: usize,
    pub(crate) byte_offset: usize,
}

impl FromJson for SparseValues {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self { buffer_view: members.required("bufferView")?, byte_offset: members.or_default("byteOffset")? })
    }
}

pub(crate) struct BufferView {
    pub(crate) buffer: usize,
    pub(crate) byte_offset: usize,
    pub(crate) byte_length: usize,
    pub(crate) byte_stride: Option<usize>,
}

impl FromJson for BufferView {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self {
            buffer: members.required("buffer")?,
            byte_offset: members.or_default("byteOffset")?,
            byte_length: members.required("byteLength")?,
            byte_stride: members.optional("byteStride")?,
        })
    }
}

pub(crate) struct Buffer {
    pub(crate) byte_length: usize,
    pub(crate) uri: Option<String>,
}

impl FromJson for Buffer {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self { byte_length: members.required("byteLength")?, uri: members.optional("uri")? })
    }
}

pub(crate) struct Mesh {
    pub(crate) primitives: Vec<Primitive>,
    pub(crate) weights: Value,
    pub(crate) extras: Value,
}

impl FromJson for Mesh {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self {
            primitives: members.required("primitives")?,
            weights: members.take("weights").unwrap_or_default(),
            extras: members.take("extras").unwrap_or_default(),
        })
    }
}

pub(crate) struct Primitive {
    pub(crate) attributes: BTreeMap<String, usize>,
    /// An array of objects with accessors in a valid file. Kept untyped so that a malformed one does not make the file
    /// unreadable.
    pub(crate) targets: Value,
    pub(crate) extras: Value,
}

impl FromJson for Primitive {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self {
            attributes: members.or_default("attributes")?,
            targets: members.take("targets").unwrap_or_default(),
            extras: members.take("extras").unwrap_or_default(),
        })
    }
}

pub(crate) struct Animation {
    pub(crate) name: Option<String>,
    pub(crate) channels: Vec<Channel>,
    pub(crate) samplers: Vec<Sampler>,
}

impl FromJson for Animation {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self {
            name: members.optional("name")?,
            channels: members.required("channels")?,
            samplers: members.required("samplers")?,
        })
    }
}

pub(crate) struct Channel {
    pub(crate) sampler: usize,
    pub(crate) target: ChannelTarget,
}

impl FromJson for Channel {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self { sampler: members.required("sampler")?, target: members.required("target")? })
    }
}

pub(crate) struct ChannelTarget {
    pub(crate) node: Option<usize>,
    pub(crate) path: String,
}

impl FromJson for ChannelTarget {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self { node: members.optional("node")?, path: members.required("path")? })
    }
}

pub(crate) struct Sampler {
    pub(crate) input: usize,
    pub(crate) output: usize,
    pub(crate) interpolation: Option<String>,
}

impl FromJson for Sampler {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self {
            input: members.required("input")?,
            output: members.required("output")?,
            interpolation: members.optional("interpolation")?,
        })
    }
}

pub(crate) struct Scene {
    pub(crate) nodes: Vec<usize>,
}

impl FromJson for Scene {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let mut members = Members::of(value)?;
        Ok(Self { nodes: members.or_default("nodes")? })
    }
}

/// All typed parts of one document.
#[derive(Default)]
pub(crate) struct Raw {
    pub(crate) nodes: Vec<Node>,
    pub(crate) skins: Vec<Skin>,
    pub(crate) accessors: Vec<Accessor>,
    pub(crate) views: Vec<BufferView>,
    pub(crate) buffers: Vec<Buffer>,
    pub(crate) meshes: Vec<Mesh>,
    pub(crate) animations: Vec<Animation>,
    pub(crate) scenes: Vec<Scene>,
}

/// Top-level members of a JSON text, not parsed yet. A parsed tree is about ten times as large as its text, so only one
/// element at a time is parsed.
struct Top<'a>(BTreeMap<String, &'a RawValue>);

fn syntax(error: &serde_json::Error) -> Error {
    Error::Json(error.to_string())
}

/// Maximum nesting depth; `serde_json` refuses to parse deeper than 128 levels.
const MOST_LEVELS: usize = 120;

/// Returns the nesting depth of a JSON text.
fn depth(text: &[u8]) -> usize {
    let (mut depth, mut most, mut is_text, mut is_escaped) = (0_usize, 0, false, false);
    for byte in text {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' if is_text => is_escaped = true,
            b'"' => is_text = !is_text,
            b'[' | b'{' if !is_text => depth += 1,
            b']' | b'}' if !is_text => depth = depth.saturating_sub(1),
            _ => {}
        }
        most = most.max(depth);
    }
    most
}

fn tree(text: &RawValue) -> Result<Value, Error> {
    serde_json::from_str(text.get()).map_err(|e| syntax(&e))
}

impl<'a> Top<'a> {
    fn read(text: &'a [u8]) -> Result<Self, Error> {
        let whole: &RawValue = serde_json::from_slice(text).map_err(|e| syntax(&e))?;
        if depth(text) > MOST_LEVELS {
            return Err(Error::Json(format!("it is nested deeper than {MOST_LEVELS} levels")));
        }
        if !whole.get().starts_with('{') {
            return Err(Error::Json("expected an object at the top level".into()));
        }
        serde_json::from_str(whole.get()).map(Self).map_err(|e| syntax(&e))
    }

    /// Parses a member; `Null` if there is none.
    fn tree(&mut self, key: &str) -> Result<Value, Error> {
        self.0.remove(key).map_or(Ok(Value::Null), tree)
    }

    /// Reads the array `key` as typed elements. An error names the element that does not fit.
    fn array<T: FromJson>(&mut self, key: &str) -> Result<Vec<T>, Error> {
        let mut typed = Vec::new();
        for (index, element) in self.elements(key)?.into_iter().enumerate() {
            typed.push(T::from_json(tree(element)?).map_err(|error| error.at(key, index))?);
        }
        Ok(typed)
    }

    fn elements(&mut self, key: &str) -> Result<Vec<&'a RawValue>, Error> {
        let Some(text) = self.0.remove(key) else { return Ok(Vec::new()) };
        if !text.get().starts_with('[') {
            return Err(Error::invalid(key, "expected an array"));
        }
        serde_json::from_str(text.get()).map_err(|e| syntax(&e))
    }
}

impl Raw {
    /// Parses the typed parts of a JSON text, and its `extensions`. The rest is checked to be valid JSON.
    pub(crate) fn parse(text: &[u8]) -> Result<(Self, Value), Error> {
        let mut top = Top::read(text)?;
        match top.tree("asset")?.get("version").and_then(Value::as_str) {
            Some(version) if version == "2" || version.starts_with("2.") => {}
            Some(version) => return Err(Error::Version(version.into())),
            None => return Err(Error::invalid("asset.version", "it is missing, expected \"2.0\"")),
        }
        let raw = Self {
            nodes: top.array("nodes")?,
            skins: top.array("skins")?,
            accessors: top.array("accessors")?,
            views: top.array("bufferViews")?,
            buffers: top.array("buffers")?,
            meshes: top.array("meshes")?,
            animations: top.array("animations")?,
            scenes: top.array("scenes")?,
        };
        let extensions = top.tree("extensions")?;
        for other in top.0.into_values() {
            tree(other)?;
        }
        Ok((raw, extensions))
    }
}

/// Converts a number to single precision, infinite if out of range; `None` if `value` is not a number.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "the nearest of single precision is meant"
)]
pub(crate) fn number(value: &Value) -> Option<f32> {
    match value.as_i64() {
        Some(whole) => Some(whole as f32),
        None => value.as_f64().map(|number| number as f32),
    }
}
