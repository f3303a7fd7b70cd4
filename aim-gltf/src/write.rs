//! A document written again with further clips: old bytes first and unchanged, new ones appended.

use std::collections::{BTreeMap, HashSet};

use serde_json::{Map, Value, json};

use crate::clip::{Channel, Clip, INTERPOLATIONS, Interpolation, PROPERTIES, Property};
use crate::container;
use crate::document::{Buffer, Document, bytes_of};
use crate::error::Error;
use crate::uri::{self, Uri};

fn refuse(problem: impl Into<String>) -> Error {
    Error::Clip(problem.into())
}

impl Document {
    /// The document as a GLB, with each of `clips` in place of the clip of that name, or after all others.
    ///
    /// The binary chunk begins with the old one's bytes; members of the JSON that are not understood stay as they
    /// are and where they are. External buffers, and external images that can be read, move into the file. Of the
    /// old JSON only what must change does: array lengths, buffer 0, and the `matrix` of a node that a clip moves,
    /// which becomes translation, rotation and scale.
    ///
    /// # Errors
    /// [`Error::Clip`] when a clip names nodes that do not exist, moves a property twice, or has keys that are
    /// not finite or not in order.
    pub fn with_clips(&self, clips: &[Clip]) -> Result<Vec<u8>, Error> {
        self.write(clips, None)
    }

    /// The same with one clip; what else the file says of the clip `like` (extras, channels that are not understood), it then
    /// says of this one, too.
    ///
    /// # Errors
    /// As [`with_clips`](Self::with_clips).
    pub fn with_clip_like(&self, clip: &Clip, like: Option<&str>) -> Result<Vec<u8>, Error> {
        self.write(core::slice::from_ref(clip), like)
    }

    fn write(&self, clips: &[Clip], like: Option<&str>) -> Result<Vec<u8>, Error> {
        let mut json = self.json().clone();
        let mut data = Appended::default();
        let mut animations = Vec::with_capacity(clips.len());
        for clip in clips.iter().filter(|clip| !clip.channels.is_empty()) {
            self.check(clip)?;
            animations.push(data.animation(clip, count(&json, "accessors"), count(&json, "bufferViews")));
            for channel in &clip.channels {
                self.release_matrix(&mut json, channel);
            }
        }
        let chunk = self.embed(&mut json, data)?;
        for (clip, animation) in clips.iter().filter(|clip| !clip.channels.is_empty()).zip(animations) {
            self.place(&mut json, (&clip.name, like), animation);
        }
        let text = serde_json::to_vec(&json).map_err(|e| Error::Json(e.to_string()))?;
        container::to_glb(&text, chunk.as_deref())
    }

    /// Puts an animation where the clip of its name is, else after all others, keeping what else that one says, or the one that
    /// it is like.
    fn place(&self, json: &mut Value, (name, like): (&str, Option<&str>), animation: Value) {
        let animations = array(json, "animations");
        let find = |name: &str| self.clips().iter().position(|clip| clip.name == name);
        let (old, template) = (find(name), like.and_then(find));
        let said = old.or(template).and_then(|index| animations.get(index)?.as_object());
        let mut placed = said.cloned().unwrap_or_default();
        if let Value::Object(mut new) = animation {
            keep_foreign(&placed, &mut new);
            placed.extend(new);
        }
        match old.and_then(|index| animations.get_mut(index)) {
            Some(old) => *old = placed.into(),
            None => animations.push(placed.into()),
        }
    }

    /// The keys of a clip, checked against what a valid file may contain.
    fn check(&self, clip: &Clip) -> Result<(), Error> {
        let nodes = self.skeleton().nodes();
        let mut seen = HashSet::new();
        for channel in &clip.channels {
            let node =
                nodes.get(channel.node).filter(|_| self.skeleton().is_in_file(channel.node)).ok_or_else(|| {
                    refuse(format!("clip {:?} moves node {}, which does not exist", clip.name, channel.node))
                })?;
            let what = format!("{} of {:?} in clip {:?}", in_file(channel.property).0, node.name, clip.name);
            let (times, numbers) = (&channel.times, channel.values.len());
            let ordered = times.windows(2).all(|w| w[0] < w[1]) && times.first().is_some_and(|t| *t >= 0.0);
            let problem = if !seen.insert((channel.node, channel.property)) {
                format!("{what} is there twice")
            } else if !ordered || !times.iter().all(|t| t.is_finite()) {
                format!("key times of {what} must be finite, from 0 on and strictly increasing")
            } else if channel.width == 0 || numbers != times.len() * channel.stride() {
                format!("{what} has {numbers} numbers for {} keys", times.len())
            } else if !channel.values.iter().all(|v| v.is_finite()) {
                format!("{what} has a key that is not finite")
            } else {
                continue;
            };
            return Err(refuse(problem));
        }
        Ok(())
    }

    /// An animated node may not have a `matrix`.
    fn release_matrix(&self, json: &mut Value, channel: &Channel) {
        let node = json.get_mut("nodes").and_then(|nodes| nodes.get_mut(channel.node)).and_then(Value::as_object_mut);
        let Some(node) = node.filter(|node| channel.property != Property::Weights && node.contains_key("matrix"))
        else {
            return;
        };
        node.shift_remove("matrix");
        let rest = &self.skeleton().nodes()[channel.node].rest;
        node.insert("translation".into(), json!(rest.translation.to_array().map(f64::from)));
        node.insert("rotation".into(), json!(rest.rotation.to_array().map(f64::from)));
        node.insert("scale".into(), json!(rest.scale.to_array().map(f64::from)));
    }

    /// Puts everything external and the new data into the file; returns the binary chunk.
    fn embed(&self, json: &mut Value, data: Appended) -> Result<Option<Vec<u8>>, Error> {
        for (index, buffer) in self.buffers.iter().enumerate().skip(1) {
            if let Buffer::Loaded { bytes, external: true } = buffer {
                array(json, "buffers")[index]["uri"] = uri::to_data("application/octet-stream", bytes).into();
            }
        }
        self.embed_images(json);
        let mut chunk = self.chunk.clone();
        // Only buffer 0 may be the chunk, and only if nothing else claims that place.
        let target = match self.buffers.first() {
            None => Some(chunk.take().unwrap_or_default()),
            Some(Buffer::Chunk) => chunk.take(),
            Some(buffer @ Buffer::Loaded { .. }) if chunk.is_none() => bytes_of(buffer, None).map(<[u8]>::to_vec),
            Some(_) => None,
        };
        let Some(mut bytes) = target else {
            // Buffer 0 is a placeholder for compressed data: the new bytes get a buffer of their own.
            if !data.bytes.is_empty() {
                let index = self.buffers.len();
                let text = uri::to_data("application/octet-stream", &data.bytes);
                array(json, "buffers").push(json!({ "byteLength": data.bytes.len(), "uri": text }));
                data.describe(json, index, 0);
            }
            return Ok(chunk);
        };
        if bytes.is_empty() && data.bytes.is_empty() {
            return Ok(None);
        }
        if !data.bytes.is_empty() {
            bytes.resize(bytes.len().next_multiple_of(4), 0);
        }
        let start = bytes.len();
        bytes.extend_from_slice(&data.bytes);
        let buffers = array(json, "buffers");
        if buffers.is_empty() {
            buffers.push(json!({}));
        }
        if let Some(buffer) = buffers[0].as_object_mut() {
            buffer.shift_remove("uri");
            // Untouched chunks keep their length: it may lie below the chunk's by padding.
            if !data.bytes.is_empty() || !matches!(self.buffers.first(), Some(Buffer::Chunk)) {
                buffer.insert("byteLength".into(), bytes.len().into());
            }
        }
        if !data.bytes.is_empty() {
            data.describe(json, 0, start);
        }
        Ok(Some(bytes))
    }

    /// External images that are there and are images become data URIs; others keep their URI.
    fn embed_images(&self, json: &mut Value) {
        let Some(folder) = &self.folder else { return };
        let images = json.get_mut("images").and_then(Value::as_array_mut);
        for image in images.into_iter().flatten().filter_map(Value::as_object_mut) {
            let Some(text) = image.get("uri").and_then(Value::as_str) else { continue };
            let Ok(Uri::Relative(path)) = uri::parse(text, "images") else { continue };
            let Ok(bytes) = uri::read_file(&folder.join(path)) else { continue };
            // Judged by content, so that no other file is ever drawn in by a URI.
            if let Some(kind) = image_type(&bytes) {
                image.insert("uri".into(), uri::to_data(kind, &bytes).into());
            }
        }
    }
}

/// Channels that move no property of a node (animation pointers) go from the old animation into the new, keys as they
/// are.
fn keep_foreign(old: &Map<String, Value>, new: &mut Map<String, Value>) {
    let list = |key: &str| old.get(key).and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    for channel in list("channels") {
        let target = &channel["target"];
        let ours = target["path"].as_str().is_some_and(|path| PROPERTIES.iter().any(|(_, known, ..)| *known == path))
            && target["node"].is_u64();
        let sampler = channel["sampler"].as_u64().and_then(|at| list("samplers").get(usize::try_from(at).ok()?));
        let (false, Some(sampler)) = (ours, sampler) else { continue };
        let (Some(samplers), mut channel) = (new["samplers"].as_array_mut(), channel.clone()) else { continue };
        channel["sampler"] = samplers.len().into();
        samplers.push(sampler.clone());
        if let Some(channels) = new["channels"].as_array_mut() {
            channels.push(channel);
        }
    }
}

fn image_type(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => Some("image/png"),
        [0xff, 0xd8, 0xff, ..] => Some("image/jpeg"),
        [0xab, b'K', b'T', b'X', ..] => Some("image/ktx2"),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => Some("image/webp"),
        _ => None,
    }
}

/// A property's path and accessor type in a file, and the numbers of one value there.
fn in_file(property: Property) -> (&'static str, &'static str, usize) {
    let known = PROPERTIES.into_iter().find(|(known, ..)| *known == property);
    known.map_or(("", "", 1), |(_, path, shape, width)| (path, shape, width))
}

fn count(json: &Value, key: &str) -> usize {
    json.get(key).and_then(Value::as_array).map_or(0, Vec::len)
}

/// The array `key` of the document, made if it is not there. Loading has seen that what is there is an array.
fn array<'a>(json: &'a mut Value, key: &str) -> &'a mut Vec<Value> {
    if !json.get(key).is_some_and(Value::is_array) {
        json[key] = Value::Array(Vec::new());
    }
    match &mut json[key] {
        Value::Array(array) => array,
        _ => unreachable!("it was made an array just above"),
    }
}

/// New bytes and the accessors on them.
#[derive(Default)]
struct Appended {
    bytes: Vec<u8>,
    accessors: Vec<Value>,
    /// Key times written already, by their bits.
    times: BTreeMap<Vec<u32>, usize>,
}

impl Appended {
    fn accessor(&mut self, values: &[f32], shape: &str, width: usize, view: usize, bounds: bool) -> usize {
        let mut accessor = Map::new();
        accessor.insert("bufferView".into(), view.into());
        if !self.bytes.is_empty() {
            accessor.insert("byteOffset".into(), self.bytes.len().into());
        }
        accessor.insert("componentType".into(), 5126.into());
        accessor.insert("count".into(), (values.len() / width).into());
        accessor.insert("type".into(), shape.into());
        if let (true, Some(first), Some(last)) = (bounds, values.first(), values.last()) {
            accessor.insert("min".into(), json!([f64::from(*first)]));
            accessor.insert("max".into(), json!([f64::from(*last)]));
        }
        self.bytes.extend(values.iter().flat_map(|v| v.to_le_bytes()));
        self.accessors.push(accessor.into());
        self.accessors.len() - 1
    }

    /// One animation's JSON; `first` is the index its first new accessor will have, `view` that of the new view.
    fn animation(&mut self, clip: &Clip, first: usize, view: usize) -> Value {
        let (mut channels, mut samplers) = (Vec::new(), Vec::new());
        for channel in &clip.channels {
            let bits: Vec<u32> = channel.times.iter().map(|t| t.to_bits()).collect();
            let known = self.times.get(&bits).copied();
            let input = known.unwrap_or_else(|| self.accessor(&channel.times, "SCALAR", 1, view, true));
            self.times.insert(bits, input);
            let (path, shape, width) = in_file(channel.property);
            let output = self.accessor(&unit_keys(channel), shape, width, view, false);
            let interpolation = INTERPOLATIONS.into_iter().find(|(known, _)| *known == channel.interpolation);
            let interpolation = interpolation.map_or("LINEAR", |(_, word)| word);
            channels.push(json!({ "sampler": samplers.len(), "target": { "node": channel.node, "path": path } }));
            samplers.push(json!({ "input": first + input, "output": first + output, "interpolation": interpolation }));
        }
        json!({ "name": clip.name, "channels": channels, "samplers": samplers })
    }

    /// Adds the buffer view and the accessors to the document.
    fn describe(self, json: &mut Value, buffer: usize, start: usize) {
        let mut view = Map::new();
        view.insert("buffer".into(), buffer.into());
        if start > 0 {
            view.insert("byteOffset".into(), start.into());
        }
        view.insert("byteLength".into(), self.bytes.len().into());
        array(json, "bufferViews").push(view.into());
        array(json, "accessors").extend(self.accessors);
    }
}

/// The keys, rotations made unit to single precision (integers and cut splines are a little off).
fn unit_keys(channel: &Channel) -> Vec<f32> {
    let mut values = channel.values.clone();
    if channel.property == Property::Rotation {
        let cubic = channel.interpolation == Interpolation::CubicSpline;
        for (k, four) in values.chunks_exact_mut(4).enumerate() {
            if !cubic || k % 3 == 1 {
                four.copy_from_slice(&crate::clip::quat(four).to_array());
            }
        }
    }
    values
}
