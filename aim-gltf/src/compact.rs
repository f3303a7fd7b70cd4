//! Removes the accessors, buffer views and bytes that only replaced clips used from a written document.

use core::ops::Range;
use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use crate::document::Document;
use crate::references::{self, index, list};

/// Bytes that a clip takes in a file.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ClipSize {
    /// Bytes of the keys, times and values. Each accessor is counted once, even if other clips share it.
    pub keys: usize,
    /// Bytes of the JSON text that describes the keys: the animation and its accessors.
    pub text: usize,
    /// Bytes of the keys by channel.
    pub channels: Vec<ChannelSize>,
}

/// Bytes of the keys of one channel.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ChannelSize {
    /// The bone that the channel moves.
    pub bone: usize,
    /// The property: `translation`, `rotation`, `scale` or `weights`.
    pub path: String,
    /// The bytes. An accessor that several channels of the clip share, such as times, is divided equally among them.
    pub bytes: f64,
}

impl Document {
    /// Returns the bytes that each of the [clips](Self::clips) takes in the file.
    #[must_use]
    pub fn clip_sizes(&self) -> Vec<ClipSize> {
        let json = self.json();
        let [accessors, animations] = ["accessors", "animations"]
            .map(|key| json.get(key).and_then(Value::as_array).map_or(&[][..], Vec::as_slice));
        // The clips of a document made from bones are not animations in its JSON.
        let size = |animation| self.clip_size(animation, accessors);
        (0..self.clips().len()).map(|clip| animations.get(clip).map_or_else(ClipSize::default, size)).collect()
    }

    fn clip_size(&self, animation: &Value, accessors: &[Value]) -> ClipSize {
        let bytes = |at: usize| accessors.get(at).map_or(0, |accessor| number(accessor, "count") * element(accessor));
        let list = |key: &str| animation.get(key).and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
        let accessors_of = |channel: &Value| {
            let sampler = index(channel.get("sampler")).and_then(|at| list("samplers").get(at));
            ["input", "output"].map(|key| sampler.and_then(|sampler| index(sampler.get(key))))
        };
        let mut uses = BTreeMap::<usize, f64>::new();
        for at in list("channels").iter().flat_map(accessors_of).flatten() {
            *uses.entry(at).or_default() += 1.0;
        }
        #[expect(clippy::cast_precision_loss, reason = "files have less than 2^52 bytes")]
        let channel = |channel: &Value| {
            let target = channel.get("target")?;
            Some(ChannelSize {
                bone: self.skeleton().bone_of(index(target.get("node"))?)?,
                path: target.get("path")?.as_str()?.to_owned(),
                bytes: accessors_of(channel).into_iter().flatten().map(|at| bytes(at) as f64 / uses[&at]).sum(),
            })
        };
        let used = references::accessors_of(animation);
        let text = used.iter().filter_map(|at| accessors.get(*at)).map(|accessor| accessor.to_string().len());
        ClipSize {
            keys: used.iter().map(|at| bytes(*at)).sum(),
            text: animation.to_string().len() + text.sum::<usize>(),
            channels: list("channels").iter().filter_map(channel).collect(),
        }
    }
}

/// Removes the accessors among `candidates` that are no longer referenced from a document, and their buffer views and
/// bytes from its chunk, buffer 0. Everything else keeps its order and its bytes; indices and offsets are updated.
///
/// Changes nothing if the document has an extension that may refer to accessors or views in an unknown way.
pub(crate) fn drop_unused(json: &mut Value, chunk: &mut Vec<u8>, candidates: &BTreeSet<usize>) {
    let is_chunk = json["buffers"].get(0).is_some_and(|buffer| buffer.get("uri").is_none());
    if !is_chunk || !references::are_known(json) {
        return;
    }
    let unused = UnusedData::find(json, candidates);
    let cuts = unused.cuts(json, chunk.len());
    move_offsets(json, &cuts);
    let mut compacted = Vec::with_capacity(chunk.len());
    let mut at = 0;
    for cut in &cuts {
        compacted.extend_from_slice(&chunk[at..cut.start]);
        at = cut.end;
    }
    compacted.extend_from_slice(&chunk[at..]);
    *chunk = compacted;
    unused.remove(json);
}

/// Indices of the accessors and buffer views that nothing refers to.
struct UnusedData {
    accessors: BTreeSet<usize>,
    views: BTreeSet<usize>,
}

impl UnusedData {
    fn find(json: &mut Value, candidates: &BTreeSet<usize>) -> Self {
        let mut accessors = candidates.clone();
        references::visit_accessors(json, &mut |reference| {
            index(Some(reference)).map(|index| accessors.remove(&index));
        });
        let (mut views, mut used) = (BTreeSet::new(), BTreeSet::new());
        for (at, accessor) in list(json, "accessors").enumerate() {
            let of = if accessors.contains(&at) { &mut views } else { &mut used };
            references::visit_views_of(accessor, &mut |view| of.extend(index(Some(view))));
        }
        references::visit_other_views(json, &mut |view| used.extend(index(Some(view))));
        Self { accessors, views: views.difference(&used).copied().collect() }
    }

    /// Returns the ranges of the chunk that hold only unused data. They consist of whole 4-byte words, which keeps all
    /// other data aligned.
    fn cuts(&self, json: &mut Value, length: usize) -> Vec<Range<usize>> {
        let mut is_unused = vec![false; length / 4];
        let mut mark = |range: Range<usize>, unused: bool| {
            let words =
                if unused { range.start.div_ceil(4)..range.end / 4 } else { range.start / 4..range.end.div_ceil(4) };
            let end = words.end.min(length / 4);
            is_unused[words.start.min(end)..end].fill(unused);
        };
        let views = views(json);
        let mut by_accessors = BTreeSet::new();
        for is_cut in [true, false] {
            for (at, accessor) in list(json, "accessors").enumerate() {
                let view = index(accessor.get("bufferView"));
                if let (true, Some(view)) =
                    (self.accessors.contains(&at) == is_cut, view.and_then(|view| views.get(view)))
                {
                    mark(place(accessor, view), is_cut);
                }
                by_accessors.extend(view);
            }
            for view in self.views.iter().filter_map(|view| views.get(*view)).filter(|_| is_cut) {
                mark(view.range.clone(), true);
            }
        }
        // Views also hold other used data: images, sparse accessors, and views that no accessor refers to.
        let mut whole: BTreeSet<usize> = (0..views.len()).filter(|view| !by_accessors.contains(view)).collect();
        references::visit_other_views(json, &mut |view| whole.extend(index(Some(view))));
        for (at, accessor) in
            list(json, "accessors").enumerate().filter(|(_, accessor)| accessor.get("sparse").is_some())
        {
            if !self.accessors.contains(&at) {
                references::visit_views_of(accessor, &mut |view| whole.extend(index(Some(view))));
            }
        }
        for view in whole.difference(&self.views).filter_map(|view| views.get(*view)) {
            mark(view.range.clone(), false);
        }
        let mut start = 0;
        let runs = is_unused.chunk_by(|a, b| a == b).map(|run| {
            let from = start;
            start += run.len();
            (run[0], 4 * from..4 * start)
        });
        runs.filter(|(unused, _)| *unused).map(|(_, range)| range).collect()
    }

    /// Removes the unused entries from their lists and renumbers the references to the others.
    fn remove(&self, json: &mut Value) {
        let renumber = |unused: &BTreeSet<usize>, reference: &mut Value| {
            if let Some(at) = index(Some(reference)) {
                *reference = (at - unused.range(..at).count()).into();
            }
        };
        references::visit_accessors(json, &mut |reference| renumber(&self.accessors, reference));
        references::visit_other_views(json, &mut |view| renumber(&self.views, view));
        for accessor in list(json, "accessors") {
            references::visit_views_of(accessor, &mut |view| renumber(&self.views, view));
        }
        for (key, unused) in [("accessors", &self.accessors), ("bufferViews", &self.views)] {
            if let Some(all) = json.get_mut(key).and_then(Value::as_array_mut) {
                let mut number = 0;
                all.retain(|_| {
                    number += 1;
                    !unused.contains(&(number - 1))
                });
            }
        }
    }
}

/// Moves the offsets of buffer views, and of accessors in them, to where their bytes are after the cuts.
fn move_offsets(json: &mut Value, cuts: &[Range<usize>]) {
    let moved = |at: usize| {
        let before = cuts.iter().take_while(|cut| cut.start < at);
        at - before.map(|cut| cut.end.min(at) - cut.start).sum::<usize>()
    };
    let views = views(json);
    for accessor in list(json, "accessors") {
        if let Some(view) =
            index(accessor.get("bufferView")).and_then(|view| views.get(view)).filter(|view| view.is_chunk)
        {
            let start = view.range.start;
            let from = start.saturating_add(number(accessor, "byteOffset"));
            set(accessor, "byteOffset", moved(from) - moved(start));
        }
    }
    for (view, json) in views.iter().zip(list(json, "bufferViews")).filter(|(view, _)| view.is_chunk) {
        let Range { start, end } = view.range;
        set(json, "byteOffset", moved(start));
        json["byteLength"] = (moved(end) - moved(start)).into();
    }
    let length = number(&json["buffers"][0], "byteLength");
    json["buffers"][0]["byteLength"] = moved(length).into();
}

/// Sets an offset; leaves it out if it is 0, the default, and not yet present.
fn set(json: &mut Value, key: &str, offset: usize) {
    if offset > 0 || json.get(key).is_some() {
        json[key] = json!(offset);
    }
}

/// A buffer view: its byte range (empty outside the chunk), its stride (0 if tightly packed), and whether it is in the
/// chunk.
struct View {
    range: Range<usize>,
    stride: usize,
    is_chunk: bool,
}

fn views(json: &mut Value) -> Vec<View> {
    let view = |view: &mut Value| {
        let start = number(view, "byteOffset");
        let is_chunk = index(view.get("buffer")) == Some(0);
        let end = if is_chunk { start.saturating_add(number(view, "byteLength")) } else { start };
        View { range: start..end, stride: number(view, "byteStride"), is_chunk }
    };
    list(json, "bufferViews").map(view).collect()
}

/// Returns the byte range of an accessor in the chunk; empty if it is in another buffer.
fn place(accessor: &Value, view: &View) -> Range<usize> {
    let size = element(accessor);
    let stride = if view.stride > 0 { view.stride } else { size };
    let start = view.range.start.saturating_add(number(accessor, "byteOffset")).min(view.range.end);
    let length = match number(accessor, "count") {
        0 => 0,
        count => (count - 1).saturating_mul(stride).saturating_add(size),
    };
    start..start.saturating_add(length).min(view.range.end)
}

/// Returns the size of one element of an accessor, bytes.
fn element(accessor: &Value) -> usize {
    let shape = accessor.get("type").and_then(Value::as_str).and_then(crate::accessor::components);
    let part = accessor.get("componentType").and_then(Value::as_u64).and_then(|kind| u32::try_from(kind).ok());
    shape.unwrap_or(0) * part.and_then(crate::accessor::size_of).unwrap_or(0)
}

/// Returns a count of bytes or elements; 0 if the member is missing.
fn number(json: &Value, key: &str) -> usize {
    index(json.get(key)).unwrap_or(0)
}
