//! Compacted files drop the data that only replaced clips used. Checked with the tests' own reader.

use crate::support::{put_together, take_apart};
use aim_animation::glam::Quat;
use aim_animation::{Clip, Track};
use aim_character::Mannequin;
use aim_gltf::Document;
use serde_json::{Value, json};

fn index(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap_or(0)).unwrap()
}

/// Returns an accessor's properties with its elements, tightly packed, in place of its buffer view.
fn resolved_accessor(json: &Value, bin: &[u8], at: &Value) -> Value {
    let mut accessor = json["accessors"][index(at)].clone();
    let width = match accessor["type"].as_str().unwrap() {
        "SCALAR" => 1,
        "VEC2" => 2,
        "VEC3" => 3,
        "VEC4" => 4,
        "MAT4" => 16,
        other => panic!("{other}"),
    };
    let size = width
        * match accessor["componentType"].as_u64().unwrap() {
            5120 | 5121 => 1,
            5122 | 5123 => 2,
            _ => 4,
        };
    let view = &json["bufferViews"][index(&accessor["bufferView"])];
    let stride = view["byteStride"].as_u64().map_or(size, |stride| usize::try_from(stride).unwrap());
    let start = index(&view["byteOffset"]) + index(&accessor["byteOffset"]);
    assert_eq!(start % 4, 0, "aligned");
    let count = index(&accessor["count"]);
    assert!(index(&accessor["byteOffset"]) + (count - 1) * stride + size <= index(&view["byteLength"]), "in its view");
    let elements: Vec<&[u8]> = (0..count).map(|k| &bin[start + k * stride..][..size]).collect();
    accessor["bytes"] = json!(elements.concat());
    for key in ["bufferView", "byteOffset"] {
        accessor.as_object_mut().unwrap().remove(key);
    }
    accessor
}

/// Returns the document with references replaced by what they refer to, and clips by name.
fn resolved(glb: &[u8]) -> Value {
    let (json, bin) = take_apart(glb);
    let accessor = |at: &mut Value| *at = resolved_accessor(&json, &bin, at);
    let mut all = json.clone();
    let list = |value: &mut Value| value.as_array_mut().map(std::mem::take).unwrap_or_default();
    let mut meshes = list(&mut all["meshes"]);
    for primitive in meshes.iter_mut().flat_map(|mesh| mesh["primitives"].as_array_mut().unwrap()) {
        primitive["attributes"].as_object_mut().unwrap().values_mut().for_each(accessor);
        primitive.get_mut("indices").into_iter().for_each(accessor);
        let targets = primitive.get_mut("targets").and_then(Value::as_array_mut).into_iter().flatten();
        targets.for_each(|target| target.as_object_mut().unwrap().values_mut().for_each(accessor));
    }
    all["meshes"] = meshes.into();
    let mut skins = list(&mut all["skins"]);
    skins.iter_mut().for_each(|skin| accessor(&mut skin["inverseBindMatrices"]));
    all["skins"] = skins.into();
    let mut clips = serde_json::Map::new();
    for mut clip in list(&mut all["animations"]) {
        for sampler in clip["samplers"].as_array_mut().unwrap() {
            ["input", "output"].into_iter().for_each(|key| accessor(&mut sampler[key]));
        }
        clips.insert(clip["name"].as_str().unwrap().to_owned(), clip);
    }
    all["animations"] = clips.into();
    for image in all["images"].as_array_mut().into_iter().flatten() {
        let view = &json["bufferViews"][index(&image["bufferView"])];
        image["bufferView"] = json!(bin[index(&view["byteOffset"])..][..index(&view["byteLength"])]);
    }
    for key in ["accessors", "bufferViews", "buffers"] {
        all.as_object_mut().unwrap().remove(key);
    }
    all
}

/// Returns a character with two clips, and with an image of odd length between other data.
fn character() -> Vec<u8> {
    let glb = Mannequin::new().with_moves().glb(|_| aim_character::PAPER_AXES).unwrap();
    let (mut json, bin) = take_apart(&glb);
    let picture = b"\x89PNG odd";
    let split = index(&json["bufferViews"][3]["byteOffset"]);
    let mut bytes = bin[..split].to_vec();
    bytes.extend_from_slice(picture);
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let shift = bytes.len() - split;
    bytes.extend_from_slice(&bin[split..]);
    for view in json["bufferViews"].as_array_mut().unwrap() {
        if index(&view["byteOffset"]) >= split {
            view["byteOffset"] = (index(&view["byteOffset"]) + shift).into();
        }
    }
    let views = json["bufferViews"].as_array_mut().unwrap();
    views.push(json!({ "buffer": 0, "byteOffset": split, "byteLength": picture.len() }));
    json["images"] = json!([{ "bufferView": views.len() - 1, "mimeType": "image/png" }]);
    json["buffers"][0]["byteLength"] = bytes.len().into();
    put_together(&json, &bytes)
}

fn nod(document: &Document, name: &str) -> Clip {
    let turns = [Quat::IDENTITY, Quat::from_rotation_z(0.3)];
    let head = document.skeleton().find("head").unwrap();
    Clip::new(name).with_rotation(head, Track::linear([0.0, 1.0], turns).unwrap())
}

/// Replaces a clip and asserts that everything else is unchanged; returns the new file.
fn check(glb: &[u8], name: &str) -> Vec<u8> {
    let document = Document::from_bytes(glb).unwrap();
    let new = document.with_clips_compacted(&[nod(&document, name)]).unwrap();
    let (mut was, mut is) = (resolved(glb), resolved(&new));
    assert_ne!(was["animations"][name], is["animations"][name]);
    for all in [&mut was, &mut is] {
        all["animations"].as_object_mut().unwrap().remove(name).unwrap();
    }
    assert_eq!(was, is);
    let written = Document::from_bytes(&new).unwrap();
    let at = |document: &Document| document.clips().iter().position(|clip| clip.name() == name).unwrap();
    let [old, left] = [&document, &written].map(|document| document.clip_sizes()[at(document)].clone());
    assert_eq!(left.keys, 2 * 4 + 2 * 16);
    // If a clip shares its keys with others, replacing it saves only its JSON.
    let chunk = |glb: &[u8]| take_apart(glb).1.len();
    assert!(chunk(&new) <= chunk(glb) + left.keys, "{name}");
    assert!(old.text > left.text && new.len() < glb.len(), "{} bytes of {}", new.len(), glb.len());
    new
}

#[test]
fn only_data_of_replaced_clips_is_removed() {
    let glb = character();
    let document = Document::from_bytes(&glb).unwrap();
    assert!(document.clips().len() >= 3);
    let mut shrunk = glb.clone();
    for clip in document.clips() {
        check(&glb, clip.name());
        shrunk = check(&shrunk, clip.name());
    }
    // No data remains that only the old clips used.
    let keys = |glb: &[u8]| Document::from_bytes(glb).unwrap().clip_sizes().iter().map(|size| size.keys).sum::<usize>();
    let chunk = |glb: &[u8]| take_apart(glb).1.len();
    assert!(chunk(&glb) - chunk(&shrunk) >= keys(&glb) / 2, "{} of {}", chunk(&shrunk), chunk(&glb));
    let (json, _) = take_apart(&shrunk);
    let mut used = vec![false; json["accessors"].as_array().unwrap().len()];
    for sampler in json["animations"].as_array().unwrap().iter().flat_map(|clip| clip["samplers"].as_array().unwrap()) {
        ["input", "output"].into_iter().for_each(|key| used[index(&sampler[key])] = true);
    }
    let others = take_apart(&glb).0["animations"][0]["samplers"][0]["input"].clone();
    assert!(used[index(&others)..].iter().all(|used| *used), "accessors of animations stand last, and each is used");
}

#[test]
fn data_in_a_shared_view_stays_aligned() {
    let (mut json, bin) = take_apart(&character());
    // A single buffer view over the whole chunk.
    let views = json["bufferViews"].clone();
    let accessors = json["accessors"].as_array_mut().unwrap();
    for accessor in
        accessors.iter_mut().filter(|accessor| views[index(&accessor["bufferView"])].get("byteStride").is_none())
    {
        let offset = index(&views[index(&accessor["bufferView"])]["byteOffset"]) + index(&accessor["byteOffset"]);
        accessor["byteOffset"] = offset.into();
        accessor["bufferView"] = views.as_array().unwrap().len().into();
    }
    json["bufferViews"].as_array_mut().unwrap().push(json!({ "buffer": 0, "byteLength": bin.len() }));
    let glb = put_together(&json, &bin);
    for clip in Document::from_bytes(&glb).unwrap().clips() {
        check(&glb, clip.name());
    }
}

#[test]
fn replacing_a_clip_again_and_again_does_not_make_a_file_grow() {
    let glb = character();
    let name = Document::from_bytes(&glb).unwrap().clips()[0].name().to_owned();
    let once = check(&glb, &name);
    let again = |glb: &[u8]| {
        let document = Document::from_bytes(glb).unwrap();
        document.with_clips_compacted(&[nod(&document, &name)]).unwrap()
    };
    assert_eq!(again(&once), once);
    assert_eq!(again(&again(&once)), once);
}

#[test]
fn old_bytes_stay_where_an_extension_may_refer_to_them() {
    let (mut json, bin) = take_apart(&character());
    json["extensionsUsed"] = json!(["VENDOR_x"]);
    json["nodes"][0]["extensions"] = json!({ "VENDOR_x": { "keys": 3 } });
    let document = Document::from_bytes(&put_together(&json, &bin)).unwrap();
    let clip = nod(&document, document.clips()[0].name());
    let new = document.with_clips_compacted(std::slice::from_ref(&clip)).unwrap();
    assert_eq!(new, document.with_clips(&[clip]).unwrap());
    assert!(take_apart(&new).1.starts_with(&bin));
}

#[test]
fn a_clip_without_tracks_replaces_nothing() {
    let glb = character();
    let document = Document::from_bytes(&glb).unwrap();
    let empty = Clip::new(document.clips()[0].name());
    assert_eq!(document.with_clips_compacted(&[empty]).unwrap(), glb);
}

#[test]
fn channels_of_a_clip_add_up_to_its_keys() {
    let document = Document::from_bytes(&character()).unwrap();
    for size in document.clip_sizes() {
        let channels: f64 = size.channels.iter().map(|channel| channel.bytes).sum();
        assert!((channels - f64::from(u32::try_from(size.keys).unwrap())).abs() < 1e-6, "{channels} of {}", size.keys);
    }
}
