//! Variants of the mannequin, each baked with its proposed rig: the result must look human.

use aim_animation::Track;
use aim_character::{Criterion, Plausibility};
use aim_runtime::glam::{DVec3, Quat};
use serde_json::{Value, json};

use crate::common::character::Character;
use crate::common::{changed, gltf, mannequin};

/// Headings of the targets in a form's bakes, degrees.
const JUMPS_DEG: [f64; 4] = [10.0, 30.0, 60.0, 95.0];

/// Bakes every case and compares each with the limits for people.
#[track_caller]
fn looks_human(model: &[u8]) {
    let character = Character::new(model);
    let mut problems = Vec::new();
    let mut judge = |case: &str, measured: &Plausibility| {
        assert!(measured.is_humanoid, "a figure with an upright trunk");
        for criterion in Criterion::ALL {
            let Some(worst) = measured.worst(criterion) else {
                // An overhead target exceeds the elevation budgets, and without a heading there is no roll.
                let is_overhead = case == "overhead";
                assert!(is_overhead && criterion != Criterion::HeadSpeed, "{case}: {} is not told", criterion.key());
                continue;
            };
            let limit = criterion.must(true).expect("people have limits for all");
            if worst.value > limit {
                problems.push(format!("{case}: {} {:.4} at {:.2} s", criterion.key(), worst.value, worst.t));
            }
        }
    };
    let ahead = character.seen_at(5.0, 0.0, 0.0);
    judge("orbit", &character.bake(10.0, |t| character.seen_at(3.0, 36.0 * t, 0.0)));
    for degrees in JUMPS_DEG {
        let aside = character.seen_at(5.0, degrees, 0.0);
        judge(
            &format!("{degrees}° and back"),
            &character.bake(4.5, |t| if (1.5..3.0).contains(&t) { aside } else { ahead }),
        );
    }
    let to = |target: DVec3| character.bake(4.5, move |t| if t < 1.5 { ahead } else { target });
    judge("150° level", &to(character.seen_at(5.0, 150.0, 0.0)));
    judge("overhead", &to(character.seen_at(5.0, 0.0, 90.0)));
    assert!(problems.is_empty(), "{}", problems.join("\n"));
}

/// Returns the index of a node.
fn node(json: &Value, name: &str) -> usize {
    let nodes = json["nodes"].as_array().expect("nodes");
    nodes.iter().position(|node| node["name"] == name).expect("the bone is there")
}

fn translation(json: &Value, node: usize) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|i| json["nodes"][node]["translation"][i].as_f64().expect("a number")))
}

/// Inserts a new bone between a bone and its parent, at the fraction `part` of the distance from the parent.
pub(crate) fn insert(json: &mut Value, name: &str, above: &str, part: f64) {
    let (child, new) = (node(json, above), json["nodes"].as_array().expect("nodes").len());
    let way = translation(json, child);
    let nodes = json["nodes"].as_array_mut().expect("nodes");
    let parent =
        nodes.iter().position(|node| node["children"].as_array().is_some_and(|all| all.contains(&json!(child))));
    let parent = parent.expect("a parent");
    for slot in nodes[parent]["children"].as_array_mut().expect("children") {
        if *slot == json!(child) {
            *slot = json!(new);
        }
    }
    nodes[child]["translation"] = json!((way * part).to_array());
    nodes.push(json!({ "name": name, "translation": (way * (1.0 - part)).to_array(), "children": [child] }));
}

/// Returns the model with its hips below a new root node with these properties.
fn on_root(model: &[u8], root: &Value) -> Vec<u8> {
    let (mut json, bin) = gltf::take_apart(model);
    let hips = node(&json, "hips");
    let nodes = json["nodes"].as_array_mut().expect("nodes");
    let at = nodes.len();
    let mut root = root.clone();
    (root["name"], root["children"]) = (json!("armature"), json!([hips]));
    nodes.push(root);
    json["scenes"][0]["nodes"] = json!([at, at - 1]);
    gltf::put_together(&json, &bin)
}

fn without_eyes(json: &mut Value) {
    for (eye, cheek) in [("left_eye", "left_cheek"), ("right_eye", "right_cheek")] {
        let at = node(json, eye);
        json["nodes"][at]["name"] = json!(cheek);
    }
}

#[test]
fn one_neck_bone_and_eyes() {
    looks_human(&mannequin());
}

#[test]
fn three_neck_bones() {
    looks_human(&changed(|json| {
        insert(json, "neck1", "head", 0.667);
        insert(json, "neck2", "head", 0.5);
    }));
}

fn clavicles_on_the_neck_of(json: &mut Value) {
    let (chest, neck) = (node(json, "spine3"), node(json, "neck"));
    let up = translation(json, neck);
    for name in ["left_clavicle", "right_clavicle"] {
        let arm = node(json, name);
        // No change of basis is needed: all bones have the same axes in the bind pose.
        json["nodes"][arm]["translation"] = json!((translation(json, arm) - up).to_array());
        json["nodes"][chest]["children"].as_array_mut().expect("children").retain(|child| *child != json!(arm));
        json["nodes"][neck]["children"].as_array_mut().expect("children").push(json!(arm));
    }
}

#[test]
fn clavicles_on_the_neck() {
    looks_human(&changed(clavicles_on_the_neck_of));
}

/// Renames all bones like a converter that numbers them, so that names say nothing about them.
pub(crate) fn nameless(json: &mut Value) {
    for (at, node) in json["nodes"].as_array_mut().expect("nodes").iter_mut().enumerate() {
        node["name"] = json!(format!("Bone.{at:03}"));
    }
}

#[test]
fn names_that_say_nothing() {
    looks_human(&changed(nameless));
}

#[test]
fn names_that_say_nothing_and_clavicles_on_the_neck() {
    looks_human(&changed(|json| {
        clavicles_on_the_neck_of(json);
        nameless(json);
    }));
}

#[test]
fn no_eyes() {
    looks_human(&changed(without_eyes));
}

#[test]
fn three_neck_bones_and_no_eyes() {
    looks_human(&changed(|json| {
        without_eyes(json);
        insert(json, "neck1", "head", 0.667);
        insert(json, "neck2", "head", 0.5);
    }));
}

#[test]
fn a_leaning_torso() {
    // The head stays level: 25° forward in the spine, 25° back in the neck.
    let model = mannequin();
    let document = aim_gltf::Document::from_bytes(&model).expect("a sound model");
    let mut clip = document.clips()[0].clone();
    for (bone, degrees) in [("spine", 25_f32), ("neck", -25.0)] {
        let node = document.skeleton().find(bone).expect("a bone");
        let walk = clip.bone(node).and_then(|tracks| tracks.rotation.as_ref()).expect("the walk moves it");
        let lean = Quat::from_rotation_z(degrees.to_radians());
        let keys = walk.values().iter().map(|&key| key * lean).collect::<Vec<_>>();
        let leaning = Track::linear(walk.times(), keys).expect("a key at each time");
        clip = clip.with_rotation(node, leaning);
    }
    looks_human(&document.with_clips(&[clip]).expect("a clip"));
}

#[test]
fn a_long_neck() {
    looks_human(&changed(|json| {
        let head = node(json, "head");
        json["nodes"][head]["translation"] = json!((translation(json, head) * 3.0).to_array());
        // Without inverse bind matrices, the bind pose has the same length.
        let skins = json["skins"].as_array_mut().expect("skins");
        drop(skins[0].as_object_mut().expect("a skin").remove("inverseBindMatrices"));
    }));
}

#[test]
fn mirrored_as_a_whole() {
    looks_human(&on_root(&mannequin(), &json!({ "scale": [-1.0, 1.0, 1.0] })));
}

#[test]
fn bones_that_are_left_handed() {
    let [u, f, l] = aim_character::PAPER_AXES;
    let model = aim_character::mannequin(|_| [u, f, l.map(|c| -c)]).expect("orthonormal axes");
    looks_human(&model);
}

#[test]
fn centimetres() {
    looks_human(&on_root(&mannequin(), &json!({ "scale": [100.0, 100.0, 100.0] })));
}
