//! Characters that are scaled, mirrored or tilted, models that are not characters, hinges, turrets, and custom
//! effectors.

use crate::common::forward::{Bake, angle_between, list, number, vector};
use crate::common::rig::joints;
use crate::common::{Place, changed, mannequin};
use aim_runtime::glam::DVec3;
use serde_json::{Value, json};

/// Bakes this model with this rig and checks everything; returns the report.
#[track_caller]
fn bake(model: &[u8], rig: &str, options: &str) -> Value {
    let place = Place::new();
    place.write("m.glb", model);
    place.write("m.toml", rig);
    place.done(&format!("bake m.glb --rig m.toml --out out.glb --report r.json {options}"));
    let report = place.json("r.json");
    Bake { source: model, output: &place.read("out.glb"), report: &report, joints: Some(&joints(rig)) }.check();
    report
}

fn mannequin_rig() -> String {
    std::fs::read_to_string(crate::common::bundled_rig("mannequin")).expect("the rig is there")
}

/// Returns the mannequin with an additional root node of this transform.
fn below(transform: Value) -> Vec<u8> {
    changed(|json| {
        let nodes = json["nodes"].as_array_mut().expect("nodes");
        let mut root = transform;
        root["name"] = json!("above");
        root["children"] = json!([0]);
        nodes.push(root);
        let above = nodes.len() - 1;
        json["scenes"][0]["nodes"] = json!([above, 25]);
    })
}

/// Returns the largest difference of the angles in two reports, degrees.
fn difference(a: &Value, b: &Value) -> f64 {
    let angles = |report: &Value| -> Vec<f64> {
        let joints = list(&report["frames"]).iter().flat_map(|frame| list(&frame["joints"]));
        joints.flat_map(|joint| [number(&joint["heading_deg"]), number(&joint["pitch_deg"])]).collect()
    };
    angles(a).iter().zip(&angles(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

const TARGET: [f64; 3] = [1.1, 1.9, 1.4];

fn at(x: f64, y: f64, z: f64) -> String {
    format!("--target {x},{y},{z} --settle animation")
}

#[test]
fn the_size_of_the_file_changes_nothing() {
    let [x, y, z] = TARGET;
    let expected = bake(&mannequin(), &mannequin_rig(), &at(x, y, z));
    for s in [100.0, 0.01, 1e4] {
        let report = bake(&below(json!({ "scale": [s, s, s] })), &mannequin_rig(), &at(x * s, y * s, z * s));
        let off = difference(&expected, &report);
        assert!(off < 0.02, "scale {s}: the angles are {off}° off");
    }
}

#[test]
fn a_mirrored_or_turned_root_changes_nothing_but_the_place() {
    let [x, y, z] = TARGET;
    let expected = bake(&mannequin(), &mannequin_rig(), &at(x, y, z));
    let half = std::f64::consts::FRAC_1_SQRT_2;
    for (root, target) in [
        (json!({ "scale": [-1, 1, 1] }), at(-x, y, z)),
        (json!({ "scale": [-2, -2, -2] }), at(-2.0 * x, -2.0 * y, -2.0 * z)),
        // +Z is up, as some exporters leave it.
        (json!({ "rotation": [half, 0, 0, half] }), at(x, -z, y)),
        (json!({ "matrix": [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 5, 0, -3, 1] }), at(z + 5.0, y, -x - 3.0)),
    ] {
        let report = bake(&below(root.clone()), &mannequin_rig(), &target);
        let off = difference(&expected, &report);
        assert!(off < 0.02, "{root}: the angles are {off}° off");
    }
}

#[test]
fn uneven_scale_is_aimed_truthfully() {
    for root in [json!({ "scale": [1, 1.4, 1] }), json!({ "scale": [0.7, 1, -1.2] })] {
        let report = bake(&below(root), &mannequin_rig(), "--target orbit:2,0.2,6 --seconds 6");
        assert!(number(&report["summary"]["reached"]) > 50.0, "{}", report["summary"]);
    }
    for bone in [3, 4, 5, 6, 7] {
        let model = changed(|json| json["nodes"][bone]["scale"] = json!([1.3, 0.8, -1.1]));
        let report = bake(&model, &mannequin_rig(), "--target orbit:2,0.2,6 --seconds 6");
        assert!(number(&report["summary"]["reached"]) > 50.0, "node {bone}: {}", report["summary"]);
    }
}

#[test]
fn a_hidden_bone_has_no_direction_and_says_so() {
    for bone in [4, 5, 6] {
        let model = changed(|json| json["nodes"][bone]["scale"] = json!([0, 0, 0]));
        let report = bake(&model, &mannequin_rig(), "--target 1,1.6,2");
        let frames = list(&report["frames"]);
        assert!(frames.iter().all(|frame| frame["status"] == "degenerate"), "node {bone}: {}", frames[0]);
    }
}

/// Returns a model of two nodes and a clip that nods the barrel.
fn turret() -> Vec<u8> {
    let times: [f32; 3] = [0.0, 0.5, 1.0];
    let nods: [[f32; 4]; 3] = [[0.0, 0.0, 0.0, 1.0], [0.05, 0.0, 0.0, 0.998_749_2], [0.0, 0.0, 0.0, 1.0]];
    let bin: Vec<u8> = times.iter().chain(nods.as_flattened()).flat_map(|v| v.to_le_bytes()).collect();
    let json = json!({
        "asset": { "version": "2.0" },
        "nodes": [
            { "name": "base", "children": [1], "translation": [3, 1, 0] },
            { "name": "barrel", "translation": [0, 0.4, -0.1] },
        ],
        "animations": [{
            "channels": [{ "sampler": 0, "target": { "node": 1, "path": "rotation" } }],
            "samplers": [{ "input": 0, "output": 1 }],
        }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "SCALAR", "min": [0], "max": [1] },
            { "bufferView": 0, "byteOffset": 12, "componentType": 5126, "count": 3, "type": "VEC4" },
        ],
        "bufferViews": [{ "buffer": 0, "byteLength": bin.len() }],
        "buffers": [{ "byteLength": bin.len() }],
    });
    crate::common::gltf::put_together(&json, &bin)
}

#[test]
fn a_turret_turns_round_and_round() {
    let rig = std::fs::read_to_string(crate::common::bundled_rig("turret")).expect("the rig is there");
    let report = bake(&turret(), &rig, "--target orbit:20,4,5 --seconds 15");
    assert_eq!((&report["clip"], &report["rig"]), (&json!("clip0_aimed"), &json!("Turret")));
    assert_eq!(report["effector"]["origin"], json!([0.0, 0.05, -0.8]));
    assert!(list(&report["frames"]).iter().all(|frame| number(&frame["error_deg"]) < 0.3), "{}", report["summary"]);
    let headings: Vec<f64> =
        list(&report["frames"]).iter().map(|frame| number(&frame["joints"][1]["heading_deg"])).collect();
    assert!(headings.iter().any(|h| *h > 150.0) && headings.iter().any(|h| *h < -150.0), "{headings:?}");
    assert!(list(&report["frames"]).iter().all(|frame| number(&frame["joints"][0]["heading_deg"]) == 0.0));
}

#[test]
fn a_hinge_alone() {
    let rig = "name = \"Lid\"\nhandedness = \"right\"\naxes = { up = \"+Y\", forward = \"-Z\" }\n[[joint]]\n\
               name = \"barrel\"\npitch = [\"-10deg\", \"80deg\"]\nrate = \"0.5rad\"\n";
    let report = bake(&turret(), rig, "--target 3,6,-5 --settle animation --seconds 3");
    assert_eq!(list(&report["frames"]).last().expect("frames")["status"], "reached");
}

#[test]
fn an_effector_of_its_own() {
    let rig = mannequin_rig().replace(
        "[[joint]]\nname = \"left_eye\"",
        "effector = { forward = [0.2, 0.96, 0.196], origin = [0.02, 0.3, -0.05] }\n\n[[joint]]\nname = \"left_eye\"",
    );
    let report = bake(&mannequin(), &rig, "--target 0.5,1.7,2");
    let forward = vector(&report["effector"]["forward"]);
    assert!(angle_between(forward, DVec3::new(0.2, 0.96, 0.196)) < 1e-4, "{forward}");
    assert_eq!(report["frames"][0]["status"], "reached");
}

#[test]
fn the_other_eye_leads() {
    let rig = mannequin_rig().replace("left_eye", "swap").replace("right_eye", "left_eye").replace("swap", "right_eye");
    let report = bake(&mannequin(), &rig, "--target orbit:2,0,4 --seconds 4");
    assert_eq!(report["effector"]["bone"], "right_eye");
    assert_eq!(report["frames"][0]["followers"], json!([{ "bone": "left_eye" }]));
}

#[test]
fn eyes_on_bones_of_their_own_turn_alike() {
    for socket in
        [json!({ "rotation": [0.5, 0.5, -0.5, 0.5] }), json!({ "rotation": [0.28, 0, 0.96, 0], "scale": [2, 2, -2] })]
    {
        let model = changed(|json| {
            let nodes = json["nodes"].as_array_mut().expect("nodes");
            let at = |name: &str| nodes.iter().position(|node| node["name"] == name).expect("the bone");
            let (head, eye, mut socket) = (at("head"), at("right_eye"), socket.clone());
            socket["children"] = json!([eye]);
            let children = nodes[head]["children"].as_array().expect("children");
            let others = children.iter().filter(|child| **child != json!(eye)).cloned();
            nodes[head]["children"] = others.chain([json!(nodes.len())]).collect();
            nodes.push(socket);
        });
        let report = bake(&model, &mannequin_rig(), "--target orbit:2,0.3,6 --seconds 3");
        assert_eq!(report["frames"][0]["status"], "reached");
    }
}

#[test]
fn a_chain_with_bones_left_out_between() {
    let rig = mannequin_rig().replace("bone = \"spine3\"", "bone = [\"nowhere\", \"hips\"]");
    let report = bake(&mannequin(), &rig, "--target orbit:2,0,4 --seconds 4");
    assert_eq!(report["frames"][0]["joints"][2]["bone"], "hips");
}
