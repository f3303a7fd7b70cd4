//! Writes a document with added clips: the old bytes come first, unchanged, and the new ones are appended.

mod weights;

use aim_animation::glam::Vec4;
use std::collections::BTreeMap;

use aim_animation::{Clip, Curve, Track, Value as Keyed};
use serde_json::{Map, Value, json};

use crate::clip::PATHS;
use crate::compact::drop_unused;
use crate::container;
use crate::document::{Buffer, Document, bytes_of};
use crate::error::Error;
use crate::references::accessors_of;
use crate::uri::{self, Uri};
use weights::{keys_of_weights, weights_at_rest};

fn refuse(problem: impl Into<String>) -> Error {
    Error::Clip(problem.into())
}

impl Document {
    /// Returns the document as a GLB with `clips` added. A clip replaces the clip of the same name, or else goes after
    /// all others. Clips without tracks are not written: glTF has no empty animations.
    ///
    /// The binary chunk begins with the old one's bytes. Members of the JSON that are not understood keep their content
    /// and place. External buffers, and external images that can be read, are embedded. The old JSON changes only where
    /// it must: array lengths, buffer 0, and the `matrix` of a node that a clip moves, which becomes translation,
    /// rotation and scale.
    ///
    /// Tracks keep their kind of curve. The weights of a mesh's morph targets share one sampler, which gets keys at the
    /// times of all of their tracks. Events are not written, because glTF has none: keep them beside the file, or in
    /// [`PackedClip::to_bytes`](aim_animation::PackedClip::to_bytes).
    ///
    /// # Errors
    /// [`Error::Clip`] if a clip moves nodes or morph targets that the file does not have.
    pub fn with_clips(&self, clips: &[Clip]) -> Result<Vec<u8>, Error> {
        self.write(clips, None).and_then(OutputDocument::into_glb)
    }

    /// Returns the document as a GLB like [`with_clips`](Self::with_clips), but drops the data that only replaced clips
    /// used: their keys and the accessors and buffer views that describe them. The file shrinks if the new clips are
    /// smaller.
    ///
    /// The remaining bytes keep their order, and references to them are updated. If the file has an extension that may
    /// refer to them in an unknown way, all old bytes are kept, as by [`with_clips`](Self::with_clips).
    ///
    /// # Errors
    /// As [`with_clips`](Self::with_clips).
    pub fn with_clips_compacted(&self, clips: &[Clip]) -> Result<Vec<u8>, Error> {
        let mut written = self.write(clips, None)?;
        let animations = self.json().get("animations").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
        let is_replaced = |name: &str| clips.iter().filter(has_tracks).any(|clip| clip.name() == name);
        let replaced = self.clips().iter().zip(animations).filter(|(clip, _)| is_replaced(clip.name()));
        let candidates = replaced.flat_map(|(_, animation)| accessors_of(animation)).collect();
        if let Some(chunk) = &mut written.chunk {
            drop_unused(&mut written.json, chunk, &candidates);
        }
        written.into_glb()
    }

    /// Returns the document as a GLB like [`with_clips`](Self::with_clips), with one clip. If it replaces no clip, it
    /// copies the other members of the clip named `like`: extras, and channels that are not understood.
    ///
    /// # Errors
    /// As [`with_clips`](Self::with_clips).
    pub fn with_clip_like(&self, clip: &Clip, like: Option<&str>) -> Result<Vec<u8>, Error> {
        self.write(core::slice::from_ref(clip), like).and_then(OutputDocument::into_glb)
    }

    fn write(&self, clips: &[Clip], like: Option<&str>) -> Result<OutputDocument, Error> {
        let mut json = self.json().clone();
        let mut data = Appended::default();
        let mut animations = Vec::with_capacity(clips.len());
        for clip in clips.iter().filter(has_tracks) {
            self.check(clip)?;
            animations.push(data.animation(self, clip, [count(&json, "accessors"), count(&json, "bufferViews")]));
            clip.tracks().iter().for_each(|tracks| self.release_matrix(&mut json, tracks.bone));
        }
        let chunk = self.embed(&mut json, data)?;
        for (clip, animation) in clips.iter().filter(has_tracks).zip(animations) {
            self.insert_animation(&mut json, (clip.name(), like), animation);
        }
        Ok(OutputDocument { json, chunk })
    }

    /// Puts an animation in the place of the clip of its name, or else after all others. Keeps the other members of
    /// that clip, or else of the one named `like`.
    fn insert_animation(&self, json: &mut Value, (name, like): (&str, Option<&str>), animation: Value) {
        let animations = array(json, "animations");
        let find = |name: &str| self.clips().iter().position(|clip| clip.name() == name);
        let (old, template) = (find(name), like.and_then(find));
        let members_to_keep = old.or(template).and_then(|index| animations.get(index)?.as_object());
        let mut merged = members_to_keep.cloned().unwrap_or_default();
        if let Value::Object(mut new) = animation {
            keep_foreign(&merged, &mut new);
            merged.extend(new);
        }
        match old.and_then(|index| animations.get_mut(index)) {
            Some(old) => *old = merged.into(),
            None => animations.push(merged.into()),
        }
    }

    /// Checks that everything that a clip moves is in the file.
    fn check(&self, clip: &Clip) -> Result<(), Error> {
        let skeleton = self.skeleton();
        if let Some(tracks) = clip.tracks().iter().find(|tracks| !skeleton.is_in_file(tracks.bone)) {
            return Err(refuse(format!("clip {:?} moves node {}, which does not exist", clip.name(), tracks.bone)));
        }
        let targets = self.morph_scalars.values().map(|scalars| scalars.end).max().unwrap_or(0);
        match clip.scalars().iter().find(|(scalar, _)| *scalar >= targets) {
            Some((scalar, _)) => Err(refuse(format!(
                "clip {:?} moves scalar {scalar}, which is not the weight of a morph target",
                clip.name()
            ))),
            None => Ok(()),
        }
    }

    /// Replaces the `matrix` of an animated node, where glTF forbids it, by translation, rotation and scale.
    fn release_matrix(&self, json: &mut Value, bone: usize) {
        let index = self.skeleton().nodes()[bone].index;
        let node = index.and_then(|index| json.get_mut("nodes")?.get_mut(index)?.as_object_mut());
        let Some(node) = node.filter(|node| node.contains_key("matrix")) else { return };
        node.shift_remove("matrix");
        let rest = &self.skeleton().rest()[bone];
        node.insert("translation".into(), json!(rest.translation.to_array().map(f64::from)));
        node.insert("rotation".into(), json!(rest.rotation.to_array().map(f64::from)));
        node.insert("scale".into(), json!(rest.scale.to_array().map(f64::from)));
    }

    /// Embeds external buffers, images and the new data; returns the binary chunk.
    fn embed(&self, json: &mut Value, data: Appended) -> Result<Option<Vec<u8>>, Error> {
        for (index, buffer) in self.buffers.iter().enumerate().skip(1) {
            if let Buffer::Loaded { bytes, external: true } = buffer {
                array(json, "buffers")[index]["uri"] = uri::to_data("application/octet-stream", bytes).into();
            }
        }
        self.embed_images(json);
        let mut chunk = self.chunk.clone();
        // Only buffer 0 can be the chunk, and only if nothing else occupies that place.
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
            // An untouched chunk keeps its stated length, which may be smaller than the chunk because of padding.
            if !data.bytes.is_empty() || !matches!(self.buffers.first(), Some(Buffer::Chunk)) {
                buffer.insert("byteLength".into(), bytes.len().into());
            }
        }
        if !data.bytes.is_empty() {
            data.describe(json, 0, start);
        }
        Ok(Some(bytes))
    }

    /// Turns external images that exist and have a known format into data URIs; other images keep their URI.
    fn embed_images(&self, json: &mut Value) {
        let Some(folder) = &self.folder else { return };
        let images = json.get_mut("images").and_then(Value::as_array_mut);
        for image in images.into_iter().flatten().filter_map(Value::as_object_mut) {
            let Some(text) = image.get("uri").and_then(Value::as_str) else { continue };
            let Ok(Uri::Relative(path)) = uri::parse(text, "images") else { continue };
            let Ok(bytes) = uri::read_file(&folder.join(path)) else { continue };
            // The content decides, so that a URI cannot embed a file that is not an image.
            if let Some(kind) = image_type(&bytes) {
                image.insert("uri".into(), uri::to_data(kind, &bytes).into());
            }
        }
    }
}

/// Copies channels that move no property of a node (animation pointers) from the old animation to the new one, with
/// their keys unchanged.
fn keep_foreign(old: &Map<String, Value>, new: &mut Map<String, Value>) {
    let list = |key: &str| old.get(key).and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    for channel in list("channels") {
        let target = &channel["target"];
        let ours = target["path"].as_str().is_some_and(|path| PATHS.contains(&path)) && target["node"].is_u64();
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

/// A document with its new clips, before the GLB is assembled.
struct OutputDocument {
    json: Value,
    chunk: Option<Vec<u8>>,
}

impl OutputDocument {
    fn into_glb(self) -> Result<Vec<u8>, Error> {
        let text = serde_json::to_vec(&self.json).map_err(|e| Error::Json(e.to_string()))?;
        container::to_glb(&text, self.chunk.as_deref())
    }
}

/// Returns `true` if a clip has tracks: glTF does not allow an animation without channels.
#[expect(clippy::trivially_copy_pass_by_ref, reason = "filters hand out references")]
fn has_tracks(clip: &&Clip) -> bool {
    !(clip.tracks().is_empty() && clip.scalars().is_empty())
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

fn count(json: &Value, key: &str) -> usize {
    json.get(key).and_then(Value::as_array).map_or(0, Vec::len)
}

/// Returns the array `key` of the document, created if missing. Loading has checked that an existing member is an
/// array.
fn array<'a>(json: &'a mut Value, key: &str) -> &'a mut Vec<Value> {
    if !json.get(key).is_some_and(Value::is_array) {
        json[key] = Value::Array(Vec::new());
    }
    match &mut json[key] {
        Value::Array(array) => array,
        _ => unreachable!("it was made an array just above"),
    }
}

/// New bytes and the accessors that describe them.
#[derive(Default)]
struct Appended {
    bytes: Vec<u8>,
    accessors: Vec<Value>,
    /// Accessors of key times written so far, by the bits of the times.
    times: BTreeMap<Vec<u32>, usize>,
}

impl Appended {
    fn accessor(&mut self, values: &[f32], (shape, width): (&str, usize), view: usize, bounds: bool) -> usize {
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

    /// Appends the keys of one animation and returns its JSON. `first` is the index of the first new accessor, `view`
    /// that of the new buffer view.
    fn animation(&mut self, document: &Document, clip: &Clip, [first, view]: [usize; 2]) -> Value {
        let mut animation = Animation { data: self, first, view, channels: Vec::new(), samplers: Vec::new() };
        let nodes = document.skeleton().nodes();
        for tracks in clip.tracks() {
            // `check` has verified that the bone is a node of the file.
            let Some(node) = nodes[tracks.bone].index else { continue };
            if let Some(track) = &tracks.translation {
                animation.channel(node, ("translation", "VEC3"), &keys(&[track], |vector| vector.to_array()));
            }
            if let Some(track) = &tracks.rotation {
                let mut rotations = keys(&[&track.with_unit_keys()], |rotation| rotation.to_array());
                let cubic = rotations.curve == Curve::Cubic;
                // Normalise to full single precision.
                for (_, four) in rotations.values.chunks_exact_mut(4).enumerate().filter(|(k, _)| !cubic || k % 3 == 1)
                {
                    four.copy_from_slice(&Vec4::from_slice(four).as_dvec4().normalize().as_vec4().to_array());
                }
                animation.channel(node, ("rotation", "VEC4"), &rotations);
            }
            if let Some(track) = &tracks.scale {
                animation.channel(node, ("scale", "VEC3"), &keys(&[track], |vector| vector.to_array()));
            }
        }
        let weights_of: BTreeMap<usize, &Track<f32>> =
            clip.scalars().iter().map(|(scalar, track)| (*scalar, track)).collect();
        for (bone, scalars) in &document.morph_scalars {
            let Some(node) = nodes[*bone].index else { continue };
            let tracks: Vec<Option<&Track<f32>>> =
                scalars.clone().map(|scalar| weights_of.get(&scalar).copied()).collect();
            if tracks.iter().any(Option::is_some) {
                let at_rest = weights_at_rest(document.json(), node);
                animation.channel(node, ("weights", "SCALAR"), &keys_of_weights(&tracks, &at_rest));
            }
        }
        json!({ "name": clip.name(), "channels": animation.channels, "samplers": animation.samplers })
    }

    /// Adds the buffer view and the accessors to the document's JSON.
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

/// An animation being built.
struct Animation<'a> {
    data: &'a mut Appended,
    first: usize,
    view: usize,
    channels: Vec<Value>,
    samplers: Vec<Value>,
}

impl Animation<'_> {
    fn channel(&mut self, node: usize, (path, shape): (&str, &str), keys: &Keys) {
        let bits: Vec<u32> = keys.times.iter().map(|t| t.to_bits()).collect();
        let known = self.data.times.get(&bits).copied();
        let input = known.unwrap_or_else(|| self.data.accessor(&keys.times, ("SCALAR", 1), self.view, true));
        self.data.times.insert(bits, input);
        let width = if shape == "SCALAR" { 1 } else { keys.width };
        let output = self.data.accessor(&keys.values, (shape, width), self.view, false);
        let interpolation = match keys.curve {
            Curve::Step => "STEP",
            Curve::Cubic => "CUBICSPLINE",
            _ => "LINEAR",
        };
        let (input, output) = (self.first + input, self.first + output);
        self.channels.push(json!({ "sampler": self.samplers.len(), "target": { "node": node, "path": path } }));
        self.samplers.push(json!({ "input": input, "output": output, "interpolation": interpolation }));
    }
}

/// The keys of a channel. Times increase; each has a value, or for cubic splines in-tangent, value and out-tangent.
struct Keys {
    curve: Curve,
    times: Vec<f32>,
    values: Vec<f32>,
    width: usize,
}

/// Returns the keys of tracks with the same times and the same curve, interleaved: for each key the numbers of all
/// tracks.
fn keys<T: Keyed, const N: usize>(tracks: &[&Track<T>], numbers: impl Fn(T) -> [f32; N]) -> Keys {
    let (curve, times) = (tracks[0].curve(), tracks[0].times());
    // If two keys are at time 0 (a jump), the first is never sampled: drop it.
    let first = usize::from(times.get(1).is_some_and(|second| *second <= 0.0));
    let mut values = Vec::new();
    for k in first..times.len() {
        let tangents = |side: usize| tracks.iter().map(move |track| track.tangents()[k][side]);
        let of_key = tracks.iter().map(|track| track.values()[k]);
        if curve == Curve::Cubic {
            values.extend(tangents(0).chain(of_key).chain(tangents(1)).flat_map(&numbers));
        } else {
            values.extend(of_key.flat_map(&numbers));
        }
    }
    // A track jumps with two keys at the same time, and has the second value from that time on; glTF needs increasing
    // times. Move the first key to the preceding float, or, if that is taken, the second key to the following one.
    let mut times = times[first..].to_vec();
    for k in 1..times.len() {
        if times[k] <= times[k - 1] {
            let before = times[k].next_down();
            let is_free = k.checked_sub(2).is_none_or(|k| times[k] < before);
            if is_free { times[k - 1] = before } else { times[k] = times[k - 1].next_up() }
        }
    }
    Keys { curve, times, values, width: N * tracks.len() }
}
