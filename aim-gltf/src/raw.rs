//! The parts of the JSON that are understood, typed; everything else stays in the `Value` untouched.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use serde_json::value::RawValue;

use crate::error::Error;

#[derive(Deserialize)]
pub(crate) struct Node {
    pub(crate) name: Option<String>,
    #[serde(default)]
    pub(crate) children: Vec<usize>,
    pub(crate) mesh: Option<usize>,
    pub(crate) skin: Option<usize>,
    pub(crate) matrix: Option<[f64; 16]>,
    pub(crate) translation: Option<[f64; 3]>,
    pub(crate) rotation: Option<[f64; 4]>,
    pub(crate) scale: Option<[f64; 3]>,
    /// Numbers, if it is right; they matter to eyes alone.
    #[serde(default)]
    pub(crate) weights: Value,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Skin {
    pub(crate) joints: Vec<usize>,
    pub(crate) inverse_bind_matrices: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Accessor {
    pub(crate) buffer_view: Option<usize>,
    #[serde(default)]
    pub(crate) byte_offset: usize,
    pub(crate) component_type: u32,
    #[serde(default)]
    pub(crate) normalized: bool,
    pub(crate) count: usize,
    #[serde(rename = "type")]
    pub(crate) shape: String,
    pub(crate) sparse: Option<Sparse>,
}

#[derive(Deserialize)]
pub(crate) struct Sparse {
    pub(crate) count: usize,
    pub(crate) indices: SparseIndices,
    pub(crate) values: SparseValues,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct SparseIndices {
    pub(crate) buffer_view: usize,
    #[serde(default)]
    pub(crate) byte_offset: usize,
    pub(crate) component_type: u32,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct SparseValues {
    pub(crate) buffer_view: usize,
    #[serde(default)]
    pub(crate) byte_offset: usize,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct BufferView {
    pub(crate) buffer: usize,
    #[serde(default)]
    pub(crate) byte_offset: usize,
    pub(crate) byte_length: usize,
    pub(crate) byte_stride: Option<usize>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Buffer {
    pub(crate) byte_length: usize,
    pub(crate) uri: Option<String>,
}

#[derive(Deserialize)]
pub(crate) struct Mesh {
    pub(crate) primitives: Vec<Primitive>,
    #[serde(default)]
    pub(crate) weights: Value,
    #[serde(default)]
    pub(crate) extras: Value,
}

#[derive(Deserialize)]
pub(crate) struct Primitive {
    #[serde(default)]
    pub(crate) attributes: BTreeMap<String, usize>,
    /// An array of objects with accessors, if it is right; they matter to eyes alone.
    #[serde(default)]
    pub(crate) targets: Value,
    #[serde(default)]
    pub(crate) extras: Value,
}

#[derive(Deserialize)]
pub(crate) struct Animation {
    pub(crate) name: Option<String>,
    pub(crate) channels: Vec<Channel>,
    pub(crate) samplers: Vec<Sampler>,
}

#[derive(Deserialize)]
pub(crate) struct Channel {
    pub(crate) sampler: usize,
    pub(crate) target: ChannelTarget,
}

#[derive(Deserialize)]
pub(crate) struct ChannelTarget {
    pub(crate) node: Option<usize>,
    pub(crate) path: String,
}

#[derive(Deserialize)]
pub(crate) struct Sampler {
    pub(crate) input: usize,
    pub(crate) output: usize,
    pub(crate) interpolation: Option<String>,
}

#[derive(Deserialize)]
pub(crate) struct Scene {
    #[serde(default)]
    pub(crate) nodes: Vec<usize>,
}

/// All typed parts of one document.
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

/// The top of a JSON text: its members, not looked into. Trees are an order larger than their text, so one is made of an
/// element at a time.
type Members<'a> = BTreeMap<String, &'a RawValue>;

fn syntax(error: &serde_json::Error) -> Error {
    Error::Json(error.to_string())
}

/// Levels that a tree can be made of.
const MOST_LEVELS: usize = 120;

/// Depth of nesting of a JSON text.
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

/// Types the array `key`, naming the element that does not fit.
fn array<T: DeserializeOwned>(members: &mut Members<'_>, key: &str) -> Result<Vec<T>, Error> {
    let Some(text) = members.remove(key) else { return Ok(Vec::new()) };
    if !text.get().starts_with('[') {
        return Err(Error::invalid(key, "expected an array"));
    }
    let elements: Vec<&RawValue> = serde_json::from_str(text.get()).map_err(|e| syntax(&e))?;
    let typed = |(index, element): (usize, &&RawValue)| {
        let element = tree(element)?;
        if !element.is_object() {
            return Err(Error::invalid(format!("{key}[{index}]"), "expected an object"));
        }
        T::deserialize(element).map_err(|e| Error::invalid(format!("{key}[{index}]"), e.to_string()))
    };
    elements.iter().enumerate().map(typed).collect()
}

impl Raw {
    /// The typed parts of a JSON text, and its `extensions`; all of the text is looked at.
    pub(crate) fn parse(text: &[u8]) -> Result<(Self, Value), Error> {
        let whole: &RawValue = serde_json::from_slice(text).map_err(|e| syntax(&e))?;
        if depth(text) > MOST_LEVELS {
            return Err(Error::Json(format!("it is nested deeper than {MOST_LEVELS} levels")));
        }
        if !whole.get().starts_with('{') {
            return Err(Error::Json("expected an object at the top".into()));
        }
        let mut members: Members<'_> = serde_json::from_str(whole.get()).map_err(|e| syntax(&e))?;
        let asset = members.remove("asset").map(tree).transpose()?;
        match asset.as_ref().and_then(|asset| asset.get("version")).and_then(Value::as_str) {
            Some(version) if version == "2" || version.starts_with("2.") => {}
            Some(version) => return Err(Error::Version(version.into())),
            None => return Err(Error::invalid("asset.version", "it is missing, expected \"2.0\"")),
        }
        let raw = Self {
            nodes: array(&mut members, "nodes")?,
            skins: array(&mut members, "skins")?,
            accessors: array(&mut members, "accessors")?,
            views: array(&mut members, "bufferViews")?,
            buffers: array(&mut members, "buffers")?,
            meshes: array(&mut members, "meshes")?,
            animations: array(&mut members, "animations")?,
            scenes: array(&mut members, "scenes")?,
        };
        let extensions = members.remove("extensions").map(tree).transpose()?;
        for other in members.into_values() {
            tree(other)?;
        }
        Ok((raw, extensions.unwrap_or_default()))
    }
}

/// A number in single precision: infinite where it is beyond that; `None` of what is no number.
pub(crate) fn number(value: &Value) -> Option<f32> {
    f32::deserialize(value).ok()
}
