//! Writing files: existing content is kept, new content reads back, and files are written atomically.

use std::fs;
use std::path::PathBuf;

use crate::support::{put_together, take_apart};
use aim_animation::glam::{Quat, Vec3};
use aim_animation::{Clip, HermiteKey, Track};
use aim_character::{PAPER_AXES, mannequin};
use aim_gltf::{Document, Error, write_file};
use serde_json::{Value, json};

fn mannequin_glb() -> Vec<u8> {
    mannequin(|_| PAPER_AXES).unwrap()
}

fn nod(node: usize) -> Clip {
    let turns = [Quat::IDENTITY, Quat::from_rotation_z(0.3), Quat::from_rotation_x(-0.2)];
    Clip::new("nod").with_rotation(node, Track::linear([0.0, 0.4, 1.0], turns).unwrap())
}

/// Temporary folder for one test, removed at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("aim-gltf-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[test]
fn a_written_clip_reads_back_the_same() {
    let document = Document::from_bytes(&mannequin_glb()).unwrap();
    let head = document.skeleton().find("head").unwrap();
    let nod = nod(head).bone(head).and_then(|tracks| tracks.rotation.clone()).unwrap();
    let clip = document.clips()[0].repeated(3.0).with_name("aimed").with_rotation(head, nod);
    let written = Document::from_bytes(&document.with_clips(std::slice::from_ref(&clip)).unwrap()).unwrap();
    assert_eq!(written.clips().len(), 2);
    assert_eq!(written.clips()[0], document.clips()[0]);
    let found = written.clip("aimed").unwrap();
    for k in 0..100_u8 {
        let t = f32::from(k) * 0.031;
        let (a, b) = (document.skeleton().pose(&clip, t), written.skeleton().pose(found, t));
        for (a, b) in a.iter().zip(&b) {
            assert!(a.rotation.dot(b.rotation).abs() > 1.0 - 1e-6 && (a.translation - b.translation).length() < 1e-6);
        }
    }
}

/// A cut cubic has keys that are not unit, but a file requires unit keys. The curve between them must stay the same.
#[test]
fn a_cut_rotation_is_written_as_the_same_curve() {
    let document = Document::from_bytes(&mannequin_glb()).unwrap();
    let head = document.skeleton().find("head").unwrap();
    let turns = [0.0, 2.4, 0.3, -2.0].map(Quat::from_rotation_x);
    let whole = Track::catmull_rom([0.0, 1.0, 2.0, 2.5], turns).unwrap();
    let cut = whole.cut(0.5, 2.3);
    let clip = Clip::new("cut").with_rotation(head, cut.clone());
    let written = Document::from_bytes(&document.with_clips(&[clip]).unwrap()).unwrap();
    let read = written.clip("cut").unwrap().bone(head).and_then(|tracks| tracks.rotation.clone()).unwrap();
    for k in 0..=180_u8 {
        let time = f32::from(k) * 0.01;
        let (a, b) = (cut.sample(time).as_dquat().normalize(), read.sample(time).as_dquat().normalize());
        assert!((a - b).length().min((a + b).length()) < 1e-5, "{time}: {a} {b}");
    }
}

#[test]
fn the_default_clip_is_the_first_idle_one_else_the_first() {
    let document = Document::from_bytes(&mannequin_glb()).unwrap();
    let [still] = &document.clips() else { panic!("one clip, not {}", document.clips().len()) };
    assert_eq!(document.default_clip(), Some(still));
    let named = ["Death", "Hero|IDLE_01", "idle"].map(|name| still.clone().with_name(name));
    let of = |clips: &[Clip]| {
        let written = Document::from_bytes(&document.with_clips(clips).unwrap()).unwrap();
        written.default_clip().map(|clip| clip.name().to_owned())
    };
    assert_eq!(of(&named).as_deref(), Some("Hero|IDLE_01"));
    assert_eq!(of(&named[..1]).as_deref(), Some(still.name()));
}

#[test]
fn old_bytes_and_unknown_members_survive_in_place() {
    let (mut json, mut bin) = take_apart(&mannequin_glb());
    json["extras"] = json!({ "z": 1, "a": [0.1, 1e-7, 123_456_789_012_345_678_u64] });
    json["extensionsUsed"] = json!(["VENDOR_x"]);
    json["extensions"] = json!({ "VENDOR_x": { "keep": "this", "b": null } });
    json["nodes"][3]["extras"] = json!({ "note": "kept" });
    // Unreferenced bytes are kept as well.
    bin.extend_from_slice(b"unreferenced");
    json["buffers"][0]["byteLength"] = bin.len().into();
    let document = Document::from_bytes(&put_together(&json, &bin)).unwrap();
    let (new_json, new_bin) = take_apart(&document.with_clips(&[nod(6)]).unwrap());
    assert!(new_bin.starts_with(&bin));
    assert_eq!(new_json["buffers"][0]["byteLength"], new_bin.len());
    for (key, old) in json.as_object().unwrap() {
        match (old, &new_json[key]) {
            (_, new) if key == "buffers" => assert!(new.is_array()),
            (Value::Array(old), Value::Array(new)) => {
                assert_eq!(old[..], new[..old.len()], "{key}");
            }
            (old, new) => assert_eq!(old, new, "{key}"),
        }
    }
    let keys = |v: &Value| v.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(keys(&json), keys(&new_json));
    assert_eq!(keys(&new_json["extras"]), ["z", "a"]);
}

#[test]
fn without_new_clips_nothing_changes() {
    let glb = mannequin_glb();
    let document = Document::from_bytes(&glb).unwrap();
    assert_eq!(document.with_clips(&[]).unwrap(), glb);
}

#[test]
fn external_parts_move_into_the_file() {
    let folder = Folder::new("external");
    let (mut json, bin) = take_apart(&mannequin_glb());
    let split = json["bufferViews"][4]["byteOffset"].as_u64().unwrap();
    let at = usize::try_from(split).unwrap();
    for (index, view) in json["bufferViews"].as_array_mut().unwrap().iter_mut().enumerate().skip(4) {
        assert!(index >= 4);
        view["buffer"] = 1.into();
        view["byteOffset"] = (view["byteOffset"].as_u64().unwrap() - split).into();
    }
    json["buffers"] =
        json!([{ "byteLength": at, "uri": "first%20part.bin" }, { "byteLength": bin.len() - at, "uri": "second.bin" }]);
    json["images"] = json!([{ "uri": "dot.png" }, { "uri": "missing.png" }, { "uri": "secret.png" }]);
    fs::write(folder.0.join("first part.bin"), &bin[..at]).unwrap();
    fs::write(folder.0.join("second.bin"), &bin[at..]).unwrap();
    fs::write(folder.0.join("dot.png"), b"\x89PNG and so on").unwrap();
    fs::write(folder.0.join("secret.png"), b"not an image").unwrap();
    let path = folder.0.join("figure.gltf");
    fs::write(&path, serde_json::to_vec_pretty(&json).unwrap()).unwrap();
    let document = Document::load(&path).unwrap();
    let glb = document.with_clips(&[nod(6)]).unwrap();
    let (new_json, new_bin) = take_apart(&glb);
    assert!(new_bin.starts_with(&bin[..at]) && new_json["buffers"][0].get("uri").is_none());
    assert!(new_json["images"][0]["uri"].as_str().unwrap().starts_with("data:image/png;base64,"));
    assert_eq!(new_json["images"][1]["uri"], "missing.png");
    assert_eq!(new_json["images"][2]["uri"], "secret.png");
    // The written file no longer depends on the folder.
    let written = Document::from_bytes(&glb).unwrap();
    assert_eq!(written.clips()[0], document.clips()[0]);
    assert!(matches!(Document::from_bytes(&fs::read(&path).unwrap()), Err(Error::NoData { .. })));
}

#[test]
fn a_node_with_a_matrix_gets_its_parts_when_animated() {
    let json = json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "matrix": [0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1], "name": "m" }],
    });
    let document = Document::from_bytes(&serde_json::to_vec(&json).unwrap()).unwrap();
    let rest = document.skeleton().rest()[0];
    assert!((rest.scale - Vec3::splat(2.0)).length() < 1e-6 && rest.translation == Vec3::new(5.0, 6.0, 7.0));
    let (new_json, _) = take_apart(&document.with_clips(&[nod(0)]).unwrap());
    assert!(new_json["nodes"][0].get("matrix").is_none());
    let written = Document::from_bytes(&document.with_clips(&[nod(0)]).unwrap()).unwrap();
    let (a, b) = (document.skeleton().world_f64(&[])[0], written.skeleton().world_f64(&[])[0]);
    assert!(a.abs_diff_eq(b, 1e-6));
}

#[test]
fn clips_that_do_not_fit_are_refused() {
    let document = Document::from_bytes(&mannequin_glb()).unwrap();
    let refused = |clip: Clip| {
        let error = document.with_clips(&[clip]).unwrap_err();
        assert!(matches!(error, Error::Clip { .. }), "{error}");
    };
    refused(Clip::new("bad").with_rotation(999, Track::constant(Quat::IDENTITY).unwrap()));
    refused(Clip::new("bad").with_scalar(0, Track::constant(1.0).unwrap()));
}

/// glTF allows only one key per time, tracks allow two: a jump is written as steeply as possible.
#[test]
fn jumps_are_written_with_increasing_times() {
    let document = Document::from_bytes(&mannequin_glb()).unwrap();
    let jump = Track::linear([0.0, 0.5, 0.5, 1.0], [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Y]).unwrap();
    let glb = document.with_clips(&[Clip::new("jump").with_translation(0, jump.clone())]).unwrap();
    let (json, bin) = take_apart(&glb);
    let input =
        &json["accessors"][usize::try_from(json["animations"][1]["samplers"][0]["input"].as_u64().unwrap()).unwrap()];
    let view = &json["bufferViews"][usize::try_from(input["bufferView"].as_u64().unwrap()).unwrap()];
    let offset = |value: &Value| usize::try_from(value["byteOffset"].as_u64().unwrap_or(0)).unwrap();
    let (times, _) = bin[offset(input) + offset(view)..][..16].as_chunks::<4>();
    let times: Vec<f32> = times.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
    assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
    let written = Document::from_bytes(&glb).unwrap();
    let track = written.clip("jump").unwrap().bone(0).and_then(|tracks| tracks.translation.as_ref()).unwrap();
    for time in [0.25, 0.49, 0.51, 0.9] {
        assert!((track.sample(time) - jump.sample(time)).length() < 1e-5, "at {time}");
    }
}

/// At a jump, a track read back has the second value at that time, as before, also at the first and last key.
#[test]
fn a_written_jump_keeps_its_time() {
    let document = Document::from_bytes(&mannequin_glb()).unwrap();
    let jump =
        Track::linear([0.0, 0.0, 0.5, 0.5, 1.0, 1.0], [Vec3::X, Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE])
            .unwrap();
    let glb = document.with_clips(&[Clip::new("jump").with_translation(0, jump.clone())]).unwrap();
    let written = Document::from_bytes(&glb).unwrap();
    let read = written.clip("jump").unwrap();
    assert_eq!(read.length_s().to_bits(), 1.0_f32.to_bits(), "it is no longer than it was");
    let track = read.bone(0).and_then(|tracks| tracks.translation.as_ref()).unwrap();
    for time in [0.0, 0.25, 0.49999, 0.5, 0.75, 0.99999, 1.0, 2.0] {
        assert!((track.sample(time) - jump.sample(time)).length() < 1e-5, "{} at {time}", track.sample(time));
    }
}

/// Returns a node that shows a triangle with one morph target per weight.
fn face(weights: &[f32]) -> Document {
    let positions = json!({ "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0] });
    let targets: Vec<Value> = weights.iter().map(|_| json!({ "POSITION": 0 })).collect();
    let json = json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "name": "face", "mesh": 0 }],
        "meshes": [{ "weights": weights, "primitives": [{ "attributes": { "POSITION": 0 }, "targets": targets }] }],
        "accessors": [positions],
    });
    Document::from_bytes(&serde_json::to_vec(&json).unwrap()).unwrap()
}

/// Returns a cubic through keys given as time, incoming velocity, value, outgoing velocity.
fn cubic(keys: &[[f32; 4]]) -> Track<f32> {
    let times: Vec<f32> = keys.iter().map(|key| key[0]).collect();
    let keys: Vec<HermiteKey<f32>> =
        keys.iter().map(|&[_, into, value, out]| HermiteKey { into, value, out }).collect();
    Track::hermite(times, &keys).unwrap()
}

/// A track for each weight of a mesh, or `None`.
type Weights<'a> = &'a [Option<Track<f32>>];

/// Writes a clip of the mesh's weights. Returns the interpolation, the number of key times, and the largest error of
/// any weight, sampled densely and at, just before and just after each key.
fn written_weights(at_rest: &[f32], tracks: Weights<'_>) -> (String, usize, f32) {
    let document = face(at_rest);
    let mut clip = Clip::new("face");
    for (scalar, track) in tracks.iter().enumerate() {
        if let Some(track) = track {
            clip = clip.with_scalar(scalar, track.clone());
        }
    }
    let glb = document.with_clips(&[clip]).unwrap();
    let (json, _) = take_apart(&glb);
    let sampler = &json["animations"][0]["samplers"][0];
    let input = &json["accessors"][usize::try_from(sampler["input"].as_u64().unwrap()).unwrap()];
    let written = Document::from_bytes(&glb).unwrap();
    let read = written.clip("face").unwrap();
    let mut times: Vec<f32> = (0..=1000_u16).map(|k| f32::from(k) * 2.2e-3).collect();
    for track in tracks.iter().flatten() {
        times.extend(track.times().iter().flat_map(|t| [*t, t.next_down().max(0.0), t.next_up()]));
    }
    let mut off = 0.0_f32;
    for (scalar, track) in tracks.iter().enumerate() {
        let found = &read.scalars().iter().find(|(known, _)| *known == scalar).expect("a weight of the mesh").1;
        for &t in &times {
            let was = track.as_ref().map_or(at_rest[scalar], |track| track.sample(t));
            off = off.max((found.sample(t) - was).abs());
        }
    }
    let count = usize::try_from(input["count"].as_u64().unwrap()).unwrap();
    (sampler["interpolation"].as_str().unwrap().to_owned(), count, off)
}

/// glTF has one sampler for all weights of a mesh, while each track has its own keys and curve.
#[test]
fn morph_weights_of_different_curves_are_preserved() {
    let step = |times: &[f32], values: &[f32]| Some(Track::step(times, values).unwrap());
    let linear = |times: &[f32], values: &[f32]| Some(Track::linear(times, values).unwrap());
    let wave =
        || Some(cubic(&[[0.1, 0.0, 0.2, 3.0], [0.7, -1.5, 0.9, 0.5], [1.3, 0.3, 0.4, -2.0], [2.0, 1.0, 1.0, 0.0]]));
    let other = || Some(cubic(&[[0.0, 0.0, 1.0, -0.4], [0.9, 0.8, 0.1, 0.8], [1.6, -2.0, 0.3, 0.0]]));
    let blink = || step(&[0.0, 0.5, 0.8], &[0.0, 1.0, 0.0]);
    let line = || linear(&[0.0, 0.33, 1.9], &[0.0, 1.0, 0.5]);
    let jump = || linear(&[0.2, 0.8, 0.8, 1.5], &[0.0, 1.0, 0.25, 0.5]);
    let cubic_jump =
        Some(cubic(&[[0.3, 0.0, 0.0, 1.0], [1.1, 2.0, 1.0, 0.0], [1.1, 0.0, 0.2, -1.0], [1.7, 0.0, 0.0, 0.0]]));
    let cases: [(&str, Weights<'_>, &str, usize); 11] = [
        ("steps", &[blink(), step(&[0.0, 1.5], &[0.0, 1.0])], "STEP", 4),
        ("steps with a jump before the first key", &[step(&[0.5, 0.5, 1.0], &[0.3, 0.6, 0.0]), None], "STEP", 3),
        ("lines", &[line(), linear(&[0.1, 1.0], &[0.5, 0.0])], "LINEAR", 5),
        ("lines that jump", &[line(), jump()], "LINEAR", 7),
        ("cubics", &[wave(), other()], "CUBICSPLINE", 7),
        ("a cubic and a line", &[wave(), line()], "CUBICSPLINE", 7),
        ("a cubic that jumps", &[cubic_jump, wave()], "CUBICSPLINE", 8),
        ("a cubic and a weight at rest", &[wave(), None], "CUBICSPLINE", 4),
        ("a cubic and a constant", &[wave(), step(&[0.0], &[0.7])], "CUBICSPLINE", 5),
        ("steps and lines", &[blink(), line()], "LINEAR", 7),
        ("steps, lines that jump and cubics", &[blink(), jump(), wave()], "CUBICSPLINE", 11),
    ];
    for (what, tracks, interpolation, keys) in cases {
        let (word, count, off) = written_weights(&[0.25, 0.5, 0.75][..tracks.len()], tracks);
        assert!(off < 2e-6, "{what}: {off} off, {word}, {count} keys");
        assert_eq!((&*word, count), (interpolation, keys), "{what}");
    }
}

#[test]
fn files_appear_whole_or_not_at_all() {
    let folder = Folder::new("atomic");
    let path = folder.0.join("out.glb");
    write_file(&path, b"first").unwrap();
    write_file(&path, b"second").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"second");
    assert_eq!(fs::read_dir(&folder.0).unwrap().count(), 1, "no temporary file is left");
    assert!(matches!(write_file(folder.0.join("no/such/folder.glb"), b""), Err(Error::Write { .. })));
    assert!(matches!(write_file(&folder.0, b""), Err(Error::NotAFile { .. })));
}
