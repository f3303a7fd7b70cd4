//! Eyes moved by morph targets: proposed, aimed, and written as weights.

use aim_runtime::glam::{DMat4, DVec3};
use serde_json::{Value, json};

use crate::common::forward::list;
use crate::common::gltf::{Model, put_together, take_apart};
use crate::common::{Place, mannequin};

const ARKIT: [&str; 9] = [
    "smile",
    "eyeLookInLeft",
    "eyeLookOutLeft",
    "eyeLookDownLeft",
    "eyeLookUpLeft",
    "eyeLookInRight",
    "eyeLookOutRight",
    "eyeLookDownRight",
    "eyeLookUpRight",
];

/// Eye centres in head space: the mean of their vertices.
struct Eyes {
    left: DVec3,
    right: DVec3,
}

fn index(value: &Value) -> usize {
    usize::try_from(value.as_u64().expect("an index")).expect("small")
}

/// Returns the mannequin with eyes that are not joints but parts of the head moved by these morph targets. Targets
/// whose names end in `Left` or `Right` move that eye, others both; `smile` moves nothing.
fn with_targets(names: &[&str]) -> (Value, Vec<u8>, Eyes) {
    let model = Model::new(&mannequin());
    let (mut json, mut bin) = take_apart(&mannequin());
    let [left, right, head] = ["left_eye", "right_eye", "head"].map(|name| model.node(name));
    // In the mannequin's bind pose, mesh space and world space are the same.
    let to_head = model.bind(head).inverse();
    let mut places = [(DVec3::ZERO, 0.0); 2];
    let mut primitives = json["meshes"][0]["primitives"].take();
    for primitive in primitives.as_array_mut().expect("primitives") {
        let accessor = |key: &str| index(&primitive["attributes"][key]);
        let positions = model.accessor(accessor("POSITION"));
        let described = model.json["accessors"][accessor("JOINTS_0")].clone();
        let view = &model.json["bufferViews"][index(&described["bufferView"])];
        let start = index(&view["byteOffset"]) + described.get("byteOffset").map_or(0, index);
        let mut sides = Vec::new();
        for (vertex, position) in positions.chunks_exact(3).enumerate() {
            let joint = &mut bin[start + 4 * vertex];
            let side = [left, right].iter().position(|eye| *eye == usize::from(*joint));
            sides.push(side);
            if let Some(side) = side {
                *joint = u8::try_from(head).expect("small");
                places[side].0 += to_head.transform_point3(DVec3::from_slice(position));
                places[side].1 += 1.0;
            }
        }
        let targets = names.iter().map(|name| {
            let moves = |side: &Option<usize>| match (name, side) {
                (_, None) | (&"smile", _) => false,
                (name, Some(0)) => !name.ends_with("Right"),
                (name, Some(_)) => !name.ends_with("Left"),
            };
            let ways: Vec<f32> =
                sides.iter().flat_map(|side| [0.0, 0.0, if moves(side) { 0.01 } else { 0.0 }]).collect();
            json!({ "POSITION": add(&mut json, &mut bin, &ways, "VEC3") })
        });
        primitive["targets"] = targets.collect();
    }
    json["meshes"][0]["primitives"] = primitives;
    for node in [left, right] {
        json["nodes"][node]["name"] = format!("socket{node}").into();
    }
    let [left, right] = places.map(|(sum, count)| sum / count);
    (json, bin, Eyes { left, right })
}

/// Appends floats to a file; returns the index of their accessor.
fn add(json: &mut Value, bin: &mut Vec<u8>, values: &[f32], shape: &str) -> usize {
    bin.resize(bin.len().next_multiple_of(4), 0);
    let mut push = |key: &str, entry: Value| {
        let list = json[key].as_array_mut().expect("a list");
        list.push(entry);
        list.len() - 1
    };
    let view = push("bufferViews", json!({ "buffer": 0, "byteOffset": bin.len(), "byteLength": 4 * values.len() }));
    let count = if shape == "VEC3" { values.len() / 3 } else { values.len() };
    let at = push("accessors", json!({ "bufferView": view, "componentType": 5126, "count": count, "type": shape }));
    bin.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    json["buffers"][0]["byteLength"] = bin.len().into();
    at
}

/// Returns the model with `ARKit` targets and, if given, a clip that fades to these weights: a smile, and eyes that
/// look slightly to the left.
fn arkit(animated: Option<[f32; 9]>) -> (Vec<u8>, Eyes) {
    let (mut json, mut bin, eyes) = with_targets(&ARKIT);
    json["meshes"][0]["extras"] = json!({ "targetNames": ARKIT });
    if let Some(last) = animated {
        let mut first = last;
        first[0] = 0.0;
        let input = add(&mut json, &mut bin, &[0.0, 1.2], "SCALAR");
        let output = add(&mut json, &mut bin, &[first, last].concat(), "SCALAR");
        let body = json["nodes"].as_array().expect("nodes").len() - 1;
        let clip = &mut json["animations"][0];
        let sampler = clip["samplers"].as_array().expect("samplers").len();
        clip["samplers"].as_array_mut().expect("samplers").push(json!({ "input": input, "output": output }));
        let channel = json!({ "sampler": sampler, "target": { "node": body, "path": "weights" } });
        clip["channels"].as_array_mut().expect("channels").push(channel);
    }
    (put_together(&json, &bin), eyes)
}

/// Returns the keys of the only weights channel of a clip: each time with all weights.
fn weights(model: &Model, clip: &str) -> Vec<(f64, Vec<f64>)> {
    let clip = &model.json["animations"][model.clip_index(clip).expect("the clip")];
    let channels = list(&clip["channels"]).iter().filter(|channel| channel["target"]["path"] == "weights");
    let [channel] = channels.collect::<Vec<_>>()[..] else { panic!("one channel of weights") };
    assert_eq!(model.json["nodes"][index(&channel["target"]["node"])]["name"], "body");
    let sampler = &clip["samplers"][index(&channel["sampler"])];
    let [times, values] = ["input", "output"].map(|key| model.accessor(index(&sampler[key])));
    times.iter().copied().zip(values.chunks_exact(values.len() / times.len()).map(<[f64]>::to_vec)).collect()
}

/// Returns heading and pitch of a target from an eye on the head, degrees, by the file's own forward kinematics. In the
/// paper's axes up is +X, forward +Y, left +Z.
fn seen(model: &Model, clip: &str, t: f64, eye: DVec3, target: DVec3) -> [f64; 2] {
    let clip = model.clip(model.clip_index(clip).expect("the clip"));
    let head: DMat4 = model.world(&model.pose(&clip, t), model.node("head"));
    let way = head.inverse().transform_point3(target) - eye;
    [way.z.atan2(way.y).to_degrees(), (way.x / way.length()).asin().to_degrees()]
}

/// Returns the weights of the negative and the positive direction for an angle: its fractions of the full angles, at
/// most 1.
fn shares(degrees: f64, [negative, positive]: [f64; 2]) -> [f64; 2] {
    [(-degrees / negative).clamp(0.0, 1.0), (degrees / positive).clamp(0.0, 1.0)]
}

const TARGETS: [DVec3; 3] = [DVec3::new(1.0, 2.1, 2.0), DVec3::new(-0.7, 1.2, 1.5), DVec3::new(0.1, 1.7, 2.0)];

#[test]
fn targets_of_arkit_have_the_weights_of_where_each_eye_looks() {
    let place = Place::new();
    // A clip that turns the eyes itself, aside or not, does not change where they look in the end.
    let aside = [0.8, 0.0, 0.2, 0.0, 0.1, 0.2, 0.0, 0.0, 0.1];
    for (target, animated) in TARGETS.into_iter().flat_map(|target| [(target, None), (target, Some(aside))]) {
        let (file, eyes) = arkit(animated);
        place.write("m.glb", &file);
        let [x, y, z] = target.to_array();
        place.done(&format!(
            "bake m.glb --both-eyes --target={x},{y},{z} --seconds 1.2 --fps 15 --out o.glb --report r.json"
        ));
        let (report, output) = (place.json("r.json"), Model::new(&place.read("o.glb")));
        let bones: Vec<_> = list(&report["frames"][0]["joints"]).iter().map(|joint| &joint["bone"]).collect();
        assert_eq!(bones[..3], ["left eye (morph targets)", "head", "neck"], "{report}");
        assert_eq!(report["summary"]["reached"], report["summary"]["frames"], "{}", report["summary"]);
        for (t, found) in weights(&output, "walk_aimed") {
            let [left, right] = [eyes.left, eyes.right].map(|eye| seen(&output, "walk_aimed", t, eye, target));
            let [[in_left, out_left], [down_left, up_left]] =
                [shares(left[0], [35.0; 2]), shares(left[1], [25.0, 20.0])];
            let [[out_right, in_right], [down_right, up_right]] =
                [shares(right[0], [35.0; 2]), shares(right[1], [25.0, 20.0])];
            let smile = animated.map_or(0.0, |weights| f64::from(weights[0]) * t / 1.2);
            let expected = [smile, in_left, out_left, down_left, up_left, in_right, out_right, down_right, up_right];
            for ((name, found), expected) in ARKIT.iter().zip(&found).zip(expected) {
                // A tenth of a degree of 20°.
                assert!((found - expected).abs() < 5e-3, "{name} at {t} s for {target}: {found}, not {expected}");
            }
        }
    }
}

#[test]
fn eyes_alone_turn_as_far_as_they_are_declared_and_weights_end_at_1() {
    let place = Place::new();
    let (file, eyes) = arkit(None);
    place.write("m.glb", &file);
    let ran = place.run(["rig", "m.glb", "--chain", "left eye (morph targets)"]);
    assert!(ran.code == 0 && ran.stdout.contains("`aim bake` writes their weights"), "{ran:?}");
    assert!(ran.stdout.contains(r#"heading = ["-35deg", "35deg"]"#), "{}", ran.stdout);
    place.write("r.toml", &ran.stdout.replace("35deg", "80deg"));
    place.done("check m.glb --rig r.toml");
    // At rest the head is in its bind pose, so the eye's world position follows from the bound head.
    let source = Model::new(&file);
    let eye = source.world(source.rest(), source.node("head")).transform_point3(eyes.left);
    for heading in [-70.0_f64, -12.0, 7.0, 34.0] {
        let (sin, cos) = heading.to_radians().sin_cos();
        let [x, y, z] = (eye + DVec3::new(sin, 0.0, cos) * 3.0).to_array();
        // Without a clip, the rest pose is aimed over.
        let mut json = source.json.clone();
        drop(json.as_object_mut().expect("an object").remove("animations"));
        place.write("m.glb", &put_together(&json, &source.bin));
        place.done(&format!("bake m.glb --rig r.toml --target={x},{y},{z} --seconds 0.1 --out o.glb"));
        let output = Model::new(&place.read("o.glb"));
        let [inward, outward] = shares(heading, [35.0; 2]);
        for (t, found) in weights(&output, "aim") {
            let off = (found[1] - inward).abs().max((found[2] - outward).abs());
            assert!(off < 5e-3 && found[3..5].iter().all(|w| *w < 5e-3), "{heading}° at {t} s: {found:?}");
            // The other eye follows.
            assert!((found[5] - outward).abs().max((found[6] - inward).abs()) < 5e-3, "{heading}° at {t} s: {found:?}");
        }
    }
}

#[test]
fn a_gaze_without_weight_leaves_the_weights_as_they_are() {
    let place = Place::new();
    // Weights in opposite directions at once, and outside 0…1.
    let odd = [0.8, 0.3, 0.4, 1.2, 0.0, 0.0, 0.0, -0.1, 0.0];
    place.write("m.glb", &arkit(Some(odd)).0);
    place.done("bake m.glb --weight 0 --target 1,2,2 --seconds 1.2 --out o.glb");
    let output = Model::new(&place.read("o.glb"));
    for (t, found) in weights(&output, "walk_aimed") {
        for (at, (found, odd)) in found.iter().zip(odd).enumerate() {
            let expected = if at == 0 { 0.8 * t / 1.2 } else { f64::from(odd) };
            assert!((found - expected).abs() < 1e-6, "{} at {t} s: {found}, not {expected}", ARKIT[at]);
        }
    }
}

/// Returns a VRM file of either version that looks by expressions, with the left eye's position. Left, right, up and
/// down are bound to one target each with the weight `bound`; sideways, `input` degrees map to `output`.
fn vrm(version: u8, [input, output]: [Value; 2], bound: f64) -> (Vec<u8>, DVec3) {
    let (mut json, bin, eyes) = with_targets(&["smile", "l", "r", "u", "d"]);
    let node = json["nodes"].as_array().expect("nodes").len() - 1;
    let words = ["lookLeft", "lookRight", "lookUp", "lookDown"];
    json["extensions"] = if version == 1 {
        let map = |[input, output]: [&Value; 2]| json!({ "inputMaxValue": input, "outputScale": output });
        let presets: serde_json::Map<String, Value> = (1..)
            .zip(words)
            .map(|(at, word)| {
                let binds =
                    json!([{ "node": node, "index": at, "weight": bound }, { "node": 999, "index": 0, "weight": 1 }]);
                (word.to_owned(), json!({ "morphTargetBinds": binds }))
            })
            .collect();
        json!({ "VRMC_vrm": { "expressions": { "preset": presets }, "lookAt": {
            "type": "expression", "rangeMapHorizontalInner": map([&json!(1), &json!(1)]), "rangeMapHorizontalOuter": map([&input, &output]),
            "rangeMapVerticalDown": map([&json!(30), &json!(1)]), "rangeMapVerticalUp": map([&json!(40), &json!(0.5)]),
        } } })
    } else {
        let map = |[input, output]: [&Value; 2]| json!({ "xRange": input, "yRange": output });
        let group = |(at, word): (usize, &str)| {
            let binds =
                json!([{ "mesh": 0, "index": at, "weight": 100.0 * bound }, { "mesh": 0, "index": 99, "weight": 100 }]);
            json!({ "presetName": word.to_lowercase(), "binds": binds })
        };
        let groups: Value = (1..).zip(words).map(group).collect();
        json!({ "VRM": { "blendShapeMaster": { "blendShapeGroups": groups }, "firstPerson": {
            "lookAtTypeName": "BlendShape", "lookAtHorizontalInner": map([&json!(1), &json!(1)]), "lookAtHorizontalOuter": map([&input, &output]),
            "lookAtVerticalDown": map([&json!(30), &json!(1)]), "lookAtVerticalUp": map([&json!(40), &json!(0.5)]),
        } } })
    };
    (put_together(&json, &bin), (eyes.left + eyes.right) * 0.5)
}

#[test]
fn expressions_of_vrm_files_have_the_weights_of_their_maps() {
    let place = Place::new();
    for (version, target) in [0, 1].into_iter().flat_map(|version| TARGETS.map(|target| (version, target))) {
        let (file, eye) = vrm(version, [json!(60), json!(0.9)], 0.8);
        place.write("v.vrm", &file);
        let [x, y, z] = target.to_array();
        place.done(&format!("bake v.vrm --target={x},{y},{z} --seconds 0.6 --fps 15 --out o.glb --report r.json"));
        let (report, output) = (place.json("r.json"), Model::new(&place.read("o.glb")));
        assert_eq!(report["frames"][0]["joints"][0]["bone"], "eyes (morph targets)");
        assert_eq!(report["summary"]["reached"], report["summary"]["frames"], "{}", report["summary"]);
        for (t, found) in weights(&output, "walk_aimed") {
            let [heading, pitch] = seen(&output, "walk_aimed", t, eye, target);
            let [right, left] = shares(heading, [60.0; 2]).map(|share| 0.8 * 0.9 * share);
            let [down, up] = shares(pitch, [30.0, 40.0]);
            for (found, expected) in found.iter().zip([0.0, left, right, 0.8 * 0.5 * up, 0.8 * down]) {
                assert!((found - expected).abs() < 4e-3, "VRM {version}, {t} s: {found}, not {expected}");
            }
        }
    }
    let text = place.done("rig v.vrm").stdout;
    assert!(text.contains(r#"name = "eyes""#) && text.contains(r#"pitch = ["-25deg", "20deg"]"#), "{text}");
}

#[test]
fn maps_that_make_no_sense_are_named_and_not_believed() {
    let place = Place::new();
    let bake = "bake v.vrm --target 1,2.1,2 --seconds 0.1 --out o.glb";
    for (version, path) in
        [(1, "VRMC_vrm.lookAt.rangeMapHorizontalOuter"), (0, "VRM.firstPerson.lookAtHorizontalOuter")]
    {
        let [input, output] = if version == 1 { ["inputMaxValue", "outputScale"] } else { ["xRange", "yRange"] };
        let weights = || weights(&Model::new(&place.read("o.glb")), "walk_aimed");
        place.write("v.vrm", &vrm(version, [json!(90), json!(1)], 1.0).0);
        assert_eq!(place.done(bake).stderr, "");
        let by_default = weights();
        for (maps, key, expected) in [
            ([json!(0), json!(1)], input, "more than 0 degrees; using 90"),
            ([json!("NaN"), json!(1)], input, "more than 0 degrees; using 90"),
            ([json!(90), json!(-1)], output, "a weight of at least 0; using 1"),
        ] {
            place.write("v.vrm", &vrm(version, maps, 1.0).0);
            let warned = place.done(bake).stderr;
            assert_eq!(warned.lines().count(), 1, "{warned}");
            assert!(warned.contains(&format!("v.vrm: {path}.{key} is ")) && warned.contains(expected), "{warned}");
            assert_eq!(weights(), by_default);
        }
        assert!(place.done("rig v.vrm").stderr.contains(path));
    }
}
