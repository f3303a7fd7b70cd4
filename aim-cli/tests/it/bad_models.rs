//! Unusable models: both `inspect` and `bake` exit with code 2, print one message that names the file and says what to
//! do, and neither panic nor leave a file behind.

use crate::common::gltf::{put_together, take_apart};
use crate::common::{Place, changed, mannequin};
use serde_json::{Value, json};

/// Asserts that both commands refuse `bad.glb` with a message that contains these words.
#[track_caller]
fn refused(place: &Place, words: &[&str]) {
    let words = [&["bad.glb"], words].concat();
    place.refused("inspect bad.glb", &words);
    place.refused(
        "bake bad.glb --rig m.toml --target 0,1,2 --seconds 1 --out out.glb --report r.json --html r.html",
        &words,
    );
    place.refused("bake bad.glb --target 0,1,2 --seconds 1 --out out.glb", &words);
}

#[track_caller]
fn bytes_refused(bytes: &[u8], words: &[&str]) {
    let place = Place::with_mannequin();
    place.write("bad.glb", bytes);
    refused(&place, words);
}

#[test]
fn files_that_are_not_there_or_no_files() {
    let place = Place::with_mannequin();
    refused(&place, &["cannot read", "No such file"]);
    std::fs::create_dir(place.path("bad.glb")).expect("a folder can be made");
    refused(&place, &["is a folder"]);
}

#[test]
fn files_that_are_no_models() {
    let mut old = mannequin();
    old[4] = 1;
    let mut magic = mannequin();
    magic[..4].copy_from_slice(b"FTlg");
    for (bytes, words) in [
        (&b""[..], &["empty"][..]),
        (b"hello, this is text\n", &["not a glTF file", "export"]),
        (b"Kaydara FBX Binary  \0", &["not a glTF file"]),
        (&magic, &["not a glTF file"]),
        (&old, &["version 1", "glTF 2.0"]),
        (b"{ \"asset\": ", &["JSON"]),
        (b"{}", &["asset.version"]),
        (&[0xff; 64], &["not a glTF file"]),
    ] {
        bytes_refused(bytes, words);
    }
}

#[test]
fn a_file_cut_off_anywhere() {
    let (place, whole) = (Place::with_mannequin(), mannequin());
    let cuts = [1, 4, 11, 12, 19, 20, 21, 500, whole.len() / 3, whole.len() / 2, whole.len() - 4, whole.len() - 1];
    for cut in cuts {
        place.write("bad.glb", &whole[..cut]);
        place.refused("inspect bad.glb", &["bad.glb"]);
        place.refused("bake bad.glb --rig m.toml --target 0,1,2 --out out.glb", &["bad.glb"]);
        // With a length in the header that matches the truncated file.
        if cut > 12 {
            let mut shorter = whole[..cut].to_vec();
            shorter[8..12].copy_from_slice(&u32::try_from(cut).expect("small").to_le_bytes());
            place.write("bad.glb", &shorter);
            place.refused("inspect bad.glb", &["bad.glb"]);
        }
    }
}

/// Returns a change that removes a key of the document.
fn without(key: &str) -> impl Fn(&mut Value) + '_ {
    move |json| drop(json.as_object_mut().expect("an object").remove(key))
}

#[test]
fn contradictions_inside() {
    type Change<'a> = &'a dyn Fn(&mut Value);
    let huge = json!(u64::MAX);
    let cases: [(Change<'_>, &[&str]); 17] = [
        (&|j| j["nodes"][6]["children"] = json!([0]), &["its own ancestor"]),
        (&|j| j["nodes"][6]["children"] = json!([6]), &["nodes[6]"]),
        (&|j| j["nodes"][6]["children"] = json!([4]), &["already a child"]),
        (&|j| j["nodes"][6]["children"] = json!([4000]), &["nodes[4000] does not exist"]),
        (&|j| j["nodes"][6]["children"] = json!(["neck"]), &["nodes[6]"]),
        (&|j| j["nodes"] = json!({}), &["nodes", "array"]),
        (&|j| j["nodes"][25]["skin"] = json!(9), &["nodes[25].skin"]),
        (&|j| j["skins"][0]["joints"][3] = json!(900), &["skins[0]", "nodes[900]"]),
        (&|j| j["animations"][0]["channels"][0]["target"]["node"] = json!(900), &["nodes[900]"]),
        (&|j| j["animations"][0]["samplers"][0]["output"] = json!(-1), &["animations[0]"]),
        (&|j| j["bufferViews"][0]["buffer"] = json!(5), &["buffers[5]"]),
        (&|j| j["accessors"][0]["count"] = huge.clone(), &["accessors[0]"]),
        (&|j| j["accessors"][0]["count"] = json!(4_000_000_000_u64), &["accessors[0]", "do not fit"]),
        (&|j| j["buffers"][0]["byteLength"] = huge.clone(), &["buffers[0]", "cut off"]),
        (&without("accessors"), &["accessors["]),
        (&without("bufferViews"), &["bufferViews["]),
        (&|j| j["buffers"][0]["uri"] = json!("gone.bin"), &["gone.bin"]),
    ];
    for (change, words) in cases {
        bytes_refused(&changed(change), words);
    }
}

#[test]
fn numbers_that_are_none() {
    let (json, mut bin) = take_apart(&mannequin());
    bin[..4].copy_from_slice(&f32::NAN.to_le_bytes());
    bytes_refused(&put_together(&json, &bin), &["accessors[0]", "not a finite number"]);
    bytes_refused(&changed(|j| j["nodes"][1]["translation"] = json!([1e300, 0, 0])), &["nodes[1]"]);
}

#[test]
fn characters_without_skin_names_or_roles() {
    let place = Place::with_mannequin();
    let bake = "bake bad.glb --target 0,1,2 --seconds 1 --out out.glb";
    let nameless = |j: &mut Value| {
        for node in j["nodes"].as_array_mut().expect("nodes") {
            without("name")(node);
        }
    };
    place.write("bad.glb", &changed(nameless));
    place.refused(&format!("{bake} --rig m.toml"), &["bad.glb", "left_eye", "nearest", "node"]);
    place.done("inspect bad.glb");
    // The head is recognised by its shape.
    place.done(bake);

    place.write("bad.glb", r#"{"asset":{"version":"2.0"},"nodes":[{"children":[1,2]},{},{}]}"#);
    place.done("inspect bad.glb");
    place.refused(bake, &["bad.glb", "no eye, head or neck", "--rig"]);

    place.write("bad.glb", r#"{"asset":{"version":"2.0"}}"#);
    place.done("inspect bad.glb");
    place.refused(bake, &["bad.glb", "--rig"]);
    place.refused(&format!("{bake} --rig m.toml"), &["bad.glb", "no nodes"]);

    let skinless = |j: &mut Value| {
        without("skins")(j);
        without("skin")(&mut j["nodes"][25]);
    };
    place.write("skinless.glb", &changed(skinless));
    place.done("bake skinless.glb --rig m.toml --target 0,1.6,2 --out out.glb");
    place.done("bake skinless.glb --target 0,1.6,2 --out out.glb");
}

#[test]
fn bones_that_do_not_fit_the_rig() {
    let place = Place::with_mannequin();
    let bake = "bake bad.glb --rig m.toml --target 0,1,2 --seconds 1 --out out.glb";
    let neck =
        |j: &Value| j["nodes"].as_array().expect("nodes").iter().position(|n| n["name"] == "neck").expect("a neck");

    let renamed = |j: &mut Value| {
        let neck = neck(j);
        j["nodes"][neck]["name"] = json!("Neck_01");
    };
    place.write("bad.glb", &changed(renamed));
    place.refused(bake, &["bad.glb", "\"neck\"", "nearest", "Neck_01"]);

    place.write("bad.glb", &changed(|j| j["nodes"][6]["name"] = json!("neck")));
    place.refused(bake, &["bad.glb", "2 nodes are named \"neck\"", "rename"]);

    // A node with the same name that is not a joint is ignored.
    place.write("twin.glb", &changed(|j| j["nodes"][25]["name"] = json!("neck")));
    place.done("bake twin.glb --rig m.toml --target 0,1,2 --out out.glb");

    let rig = String::from_utf8(place.read("m.toml")).expect("text");
    for (from, to, words) in [
        ("bone = \"neck\"", "bone = \"left_hand\"", &["left_eye", "left_hand", "from the effector inward"][..]),
        ("bone = \"spine3\"", "bone = \"head\"", &["neck", "head", "from the effector inward"]),
        ("other_eye = \"right_eye\"", "other_eye = \"rigth_eye\"", &["rigth_eye", "right_eye"]),
        ("bone = \"left_eye\"", "bone = [\"eye.L\", \"lefteye\"]", &["eye.L"]),
        ("other_eye = \"right_eye\"", "other_eye = \"head\"", &["head", "left_eye", "other eye"]),
        ("other_eye = \"right_eye\"", "other_eye = \"hips\"", &["hips", "left_eye", "other eye"]),
    ] {
        assert!(rig.contains(from), "{from}");
        place.write("other.toml", &rig.replace(from, to));
        let arguments = "bake m.glb --rig other.toml --target 0,1,2 --out out2.glb";
        place.refused(arguments, &[&["m.glb"], words].concat());
    }
}

#[test]
fn a_target_node_that_is_not_there() {
    let place = Place::with_mannequin();
    let ran = place.refused("bake m.glb --rig m.toml --target node:left_hnad --out out.glb", &["m.glb", "left_hnad"]);
    assert!(ran.stderr.contains("left_hand"), "the nearest name is not told: {}", ran.stderr);
}
