//! Broken files: one clear error each, and never a panic.

use crate::mesh::drawn;
use crate::support::{put_together, take_apart};
use aim_character::{Measurement, PAPER_AXES, mannequin};
use aim_gltf::{Document, Error};
use serde_json::{Value, json};

/// Uses all accessors of a document, so that malformed data cannot go unnoticed after a successful load.
fn exercise(bytes: &[u8]) -> Result<(), Error> {
    let document = Document::from_bytes(bytes)?;
    let measured = Measurement::of(&document);
    assert!(measured.bones.iter().all(|bone| bone.deviation_deg.is_finite()));
    for clip in document.clips() {
        let _ = document.skeleton().world_f64(&document.skeleton().pose(clip, 0.3));
    }
    drawn(&document, document.skeleton().rest());
    let _ = document.with_clips(&[])?;
    Ok(())
}

/// Returns the mannequin as a GLB with its JSON changed.
fn changed(change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let (mut json, bin) = take_apart(&mannequin(|_| PAPER_AXES).unwrap());
    change(&mut json);
    put_together(&json, &bin)
}

#[track_caller]
fn says(bytes: &[u8], words: &[&str]) {
    let message = exercise(bytes).expect_err("a broken file must be refused").to_string();
    for word in words {
        assert!(message.contains(word), "{message:?} does not mention {word:?}");
    }
}

#[test]
fn truncated_anywhere() {
    let glb = mannequin(|_| PAPER_AXES).unwrap();
    for end in (0..glb.len()).step_by(97) {
        assert!(exercise(&glb[..end]).is_err(), "cut at {end}");
    }
    says(&glb[..0], &["empty"]);
    says(&glb[..10], &["12-byte header"]);
    says(&glb[..5000], &["declares", "5000"]);
    // With the header's length matching the truncated file, the chunk is too long.
    for end in (12..glb.len()).step_by(997) {
        let mut cut = glb[..end].to_vec();
        cut[8..12].copy_from_slice(&u32::try_from(end).unwrap().to_le_bytes());
        assert!(exercise(&cut).is_err(), "cut at {end}");
    }
}

#[test]
fn flipped_bytes_never_panic() {
    let glb = mannequin(|_| PAPER_AXES).unwrap();
    let (json, _) = take_apart(&glb);
    let text_end = serde_json::to_vec(&json).unwrap().len() + 20;
    // A small generator with a fixed seed. Errors may differ, but nothing may panic.
    let mut state = 0x2545_f491_u32;
    let mut next = move |limit: usize| {
        state ^= state << 13;
        state ^= state >> 17;
        state ^= state << 5;
        usize::try_from(state).unwrap() % limit
    };
    for _ in 0..400 {
        let mut broken = glb.clone();
        for _ in 0..3 {
            let at = next(text_end);
            broken[at] = b"0123456789-e.[]{}\",:truefalsn\0\xff"[next(31)];
        }
        let _ = exercise(&broken);
    }
}

#[test]
fn wrong_containers() {
    let glb = mannequin(|_| PAPER_AXES).unwrap();
    says(b"GLTF and more", &["not a glTF file", "export"]);
    says(b"\x00\x01", &["not a glTF file"]);
    says(b"   ", &["not a glTF file"]);
    let mut old = glb.clone();
    old[4] = 1;
    says(&old, &["version 1", "glTF 2.0"]);
    let mut long_chunk = glb.clone();
    long_chunk[12..16].copy_from_slice(&u32::MAX.to_le_bytes());
    says(&long_chunk, &["chunk 0", "declares 4294967295"]);
    let mut swapped = glb.clone();
    swapped[16..20].copy_from_slice(b"BIN\0");
    says(&swapped, &["first chunk is not JSON"]);
    says(&glb[..12].iter().copied().chain([0; 8]).collect::<Vec<_>>(), &["declares"]);
    says(b"{", &["JSON", "the JSON is invalid"]);
    says(b"{}", &["asset.version"]);
    says(br#"{"asset":{"version":"1.0"}}"#, &["glTF 1.0"]);
    says("[".repeat(100_000).as_bytes(), &["not a glTF file"]);
    says(format!("{{\"a\":{}", "[".repeat(100_000)).as_bytes(), &["JSON"]);
}

#[test]
fn missing_files_and_folders() {
    let error = Document::load("no/such/file.glb").unwrap_err();
    assert!(matches!(error, Error::Read { .. }) && error.to_string().contains("no/such/file.glb"), "{error}");
    let error = Document::load(std::env::temp_dir()).unwrap_err();
    assert!(matches!(error, Error::NotAFile { .. }), "{error}");
}

#[test]
fn nodes_that_are_no_forest() {
    says(&changed(|j| j["nodes"][6]["children"] = json!([0])), &["its own ancestor"]);
    says(&changed(|j| j["nodes"][6]["children"] = json!([6])), &["nodes[6]"]);
    says(&changed(|j| j["nodes"][6]["children"] = json!([4])), &["already a child"]);
    says(&changed(|j| j["nodes"][6]["children"] = json!([4000])), &["nodes[4000] does not exist"]);
    says(&changed(|j| j["nodes"][6]["children"] = json!(["neck"])), &["nodes[6]"]);
    says(&changed(|j| j["nodes"] = json!({})), &["nodes", "array"]);
    says(&changed(|j| j["nodes"][2] = json!([1, 2])), &["nodes[2]", "object"]);
    says(&changed(|j| j["scenes"][0]["nodes"] = json!([77])), &["scenes[0]", "nodes[77]"]);
    // A chain of nodes too deep for recursion.
    let nodes: Vec<Value> =
        (1..=50_000).map(|i| if i < 50_000 { json!({ "children": [i] }) } else { json!({}) }).collect();
    let deep = json!({ "asset": { "version": "2.0" }, "nodes": nodes });
    exercise(&serde_json::to_vec(&deep).unwrap()).unwrap();
}

#[test]
fn indices_that_point_nowhere() {
    says(&changed(|j| j["nodes"][25]["mesh"] = json!(9)), &["nodes[25].mesh"]);
    says(&changed(|j| j["nodes"][25]["skin"] = json!(9)), &["nodes[25].skin"]);
    says(&changed(|j| j["skins"][0]["joints"][3] = json!(900)), &["skins[0]", "nodes[900]"]);
    says(&changed(|j| j["skins"][0]["inverseBindMatrices"] = json!(900)), &["accessors[900]"]);
    says(&changed(|j| j["animations"][0]["channels"][0]["sampler"] = json!(900)), &["sampler 900"]);
    says(&changed(|j| j["animations"][0]["channels"][0]["target"]["node"] = json!(900)), &["nodes[900]"]);
    says(&changed(|j| j["animations"][0]["samplers"][0]["input"] = json!(900)), &["accessors[900]"]);
    says(&changed(|j| j["animations"][0]["samplers"][0]["output"] = json!(-1)), &["animations[0]"]);
    says(&changed(|j| j["bufferViews"][0]["buffer"] = json!(5)), &["buffers[5]"]);
    says(&changed(|j| j["accessors"][0]["bufferView"] = json!(500)), &["bufferViews[500]"]);
    says(&changed(|j| drop(j.as_object_mut().unwrap().remove("accessors"))), &["accessors["]);
    says(&changed(|j| drop(j.as_object_mut().unwrap().remove("skins"))), &["nodes[25].skin"]);
    says(&changed(|j| j["skins"][0]["joints"] = json!([0, 1, 2])), &["joint"]);
}

#[test]
fn sizes_beyond_reason() {
    let huge = u64::MAX;
    says(&changed(|j| j["accessors"][0]["count"] = json!(huge)), &["accessors[0]"]);
    says(&changed(|j| j["accessors"][0]["count"] = json!(4_000_000_000_u64)), &["accessors[0]", "do not fit"]);
    says(&changed(|j| j["accessors"][0]["byteOffset"] = json!(huge)), &["accessors[0]"]);
    says(&changed(|j| j["bufferViews"][0]["byteLength"] = json!(huge)), &["bufferViews[0]"]);
    says(&changed(|j| j["bufferViews"][0]["byteOffset"] = json!(huge)), &["bufferViews[0]"]);
    says(&changed(|j| j["buffers"][0]["byteLength"] = json!(huge)), &["buffers[0]", "cut off"]);
    says(&changed(|j| j["bufferViews"][0]["byteStride"] = json!(1)), &["byteStride"]);
    let no_view = |j: &mut Value| {
        j["accessors"][0].as_object_mut().unwrap().remove("bufferView");
        j["accessors"][0]["count"] = json!(9_000_000_000_u64);
    };
    says(&changed(no_view), &["accessors[0]", "implausibly many"]);
    says(&changed(|j| j["accessors"][0]["componentType"] = json!(1)), &["component type 1"]);
    says(&changed(|j| j["accessors"][0]["type"] = json!("VEC9")), &["accessors[0]", "VEC9"]);
}

#[test]
fn clips_that_make_no_sense() {
    let input = |j: &Value| usize::try_from(j["animations"][0]["samplers"][0]["input"].as_u64().unwrap()).unwrap();
    says(
        &changed(|j| j["animations"][0]["samplers"][0]["interpolation"] = json!("BEZIER")),
        &["BEZIER", "CUBICSPLINE"],
    );
    says(&changed(|j| j["animations"][0]["samplers"][0]["interpolation"] = json!("CUBICSPLINE")), &["output"]);
    says(
        &changed(|j| {
            let i = input(j);
            j["accessors"][i]["count"] = json!(0);
        }),
        &["times"],
    );
    says(
        &changed(|j| {
            let i = input(j);
            j["accessors"][i]["count"] = json!(5);
        }),
        &["5 keys"],
    );
    says(&changed(|j| j["animations"][0]["channels"][0]["target"]["path"] = json!("rotation")), &["VEC4"]);
    // Channels with unknown targets are not an error.
    exercise(&changed(|j| {
        j["animations"][0]["channels"][0]["target"] = json!({ "path": "pointer" });
    }))
    .unwrap();
}

#[test]
fn numbers_that_are_none() {
    says(&changed(|j| j["nodes"][1]["translation"] = json!([1e300, 0, 0])), &["nodes[1]", "single precision"]);
    let (json, mut bin) = take_apart(&mannequin(|_| PAPER_AXES).unwrap());
    bin[..4].copy_from_slice(&f32::NAN.to_le_bytes());
    says(&put_together(&json, &bin), &["accessors[0]", "not a finite number"]);
    exercise(&changed(|j| {
        j["nodes"][1]["rotation"] = json!([0, 0, 0, 0]);
    }))
    .unwrap();
    exercise(&changed(|j| j["nodes"][1]["scale"] = json!([0, 0, 0]))).unwrap();
}

#[test]
fn transforms_that_grow_beyond_all_numbers() {
    let nodes: Vec<Value> = (1..=40)
        .map(|i| json!({ "name": if i == 40 { "Head" } else { "L arm" }, "scale": [1e30, 1e30, 1e30], "translation": [1e38, 0, 3e38], "children": if i < 40 { vec![i] } else { vec![] } }))
        .collect();
    exercise(&serde_json::to_vec(&json!({ "asset": { "version": "2.0" }, "nodes": nodes })).unwrap()).unwrap();
    let apart =
        json!([{ "name": "L arm", "translation": [3e38, 0, 0] }, { "name": "R arm", "translation": [-3e38, 0, 0] }]);
    exercise(&serde_json::to_vec(&json!({ "asset": { "version": "2.0" }, "nodes": apart })).unwrap()).unwrap();
}

#[test]
fn small_files_do_not_grow_without_bound() {
    // Huge accessors of zeros without a buffer view, used by thousands of channels.
    let many = |j: &mut Value| {
        let zeros = j["accessors"].as_array().unwrap().len();
        let accessor = |shape: &str| json!({ "componentType": 5126, "count": 5_000_000, "type": shape });
        j["accessors"].as_array_mut().unwrap().extend([accessor("SCALAR"), accessor("VEC3")]);
        let channel = json!({ "sampler": 0, "target": { "node": 0, "path": "scale" } });
        j["animations"][0]["channels"] = vec![channel; 3_000].into();
        j["animations"][0]["samplers"][0] = json!({ "input": zeros, "output": zeros + 1 });
    };
    says(&changed(many), &["would not fit into memory"]);
    // A mesh that is used fifty times is valid and read once.
    let crowd = |j: &mut Value| {
        let body = j["nodes"][25].clone();
        j["nodes"].as_array_mut().unwrap().extend(vec![body; 50]);
    };
    exercise(&changed(crowd)).unwrap();
}

#[test]
fn plain_files_without_skin_clips_or_anything() {
    exercise(br#"{"asset":{"version":"2.0"}}"#).unwrap();
    let bare =
        Document::from_bytes(br#"{"asset":{"version":"2.0"},"nodes":[{"name":"Head"},{},{"name":"Head"}]}"#).unwrap();
    assert!(bare.clips().is_empty() && !bare.skeleton().has_skin());
    assert_eq!(Measurement::of(&bare).bones.len(), 3);
    assert_eq!(bare.skeleton().find("node1").unwrap(), 1);
    let twice = bare.skeleton().find("Head").unwrap_err();
    assert!(matches!(&twice, Error::AmbiguousNode { nodes, .. } if nodes[..] == [0, 2]), "{twice}");
    let error = bare.clip("walk").unwrap_err();
    assert!(error.to_string().contains("no clips"), "{error}");
}

#[test]
fn unknown_names_are_answered_with_the_nearest() {
    let document = Document::from_bytes(&mannequin(|_| PAPER_AXES).unwrap()).unwrap();
    let error = document.skeleton().find("Left_Eye ").unwrap_err().to_string();
    assert!(error.contains("nearest names are left_eye"), "{error}");
    assert!(document.clip("wlak").unwrap_err().to_string().contains("walk"));
}

#[test]
fn uris_that_lead_nowhere() {
    let with = |uri: &str| {
        let json = json!({ "asset": { "version": "2.0" }, "buffers": [{ "byteLength": 4, "uri": uri }] });
        serde_json::to_vec(&json).unwrap()
    };
    says(&with("https://example.com/a.bin"), &["buffers[0]", "nothing is fetched"]);
    says(&with("data:application/octet-stream;base64,%%%"), &["base64"]);
    says(&with("data:application/octet-stream;base64,AAA="), &["only 2"]);
    says(&with("data:nothing"), &["comma"]);
    says(&with("/etc/hostname"), &["relative"]);
    says(&with(""), &["relative"]);
    exercise(&with("data:application/octet-stream;base64,AAAAAA")).unwrap();
    exercise(&with("data:,%00%01ab")).unwrap();
}

#[test]
fn what_is_nested_without_end_is_refused_and_brackets_in_names_do_not_count() {
    let nested = |levels: usize| {
        let (open, close) = ("[".repeat(levels), "]".repeat(levels));
        format!(r#"{{"asset":{{"version":"2.0"}},"extras":{open}{close},"nodes":[{{"name":"a\"[[{{"}}]}}"#)
    };
    let shallow = Document::from_bytes(nested(119).as_bytes()).unwrap();
    assert!(shallow.json()["extras"].is_array() && shallow.skeleton().find("a\"[[{").is_ok());
    for levels in [120, 127, 128, 100_000] {
        let error = Document::from_bytes(nested(levels).as_bytes()).unwrap_err();
        assert!(matches!(error, Error::Json { .. }), "{levels}: {error}");
    }
}
