//! Arms that hang on a neck stay with the trunk while the neck turns.

use aim_character::InterpretedRig;
use aim_codegen::RigSpec;
use aim_gltf::{ChainNodes, Document, Measurement, Plan, Settle, bake, limbs_on};
use aim_runtime::{DynAim, Settings};
use glam::{DAffine3, DVec3};
use serde_json::{Value, json};

const RIG: &str = include_str!("../../../rigs/mannequin.toml");

/// A column of bones from hips to eye, arms on the neck; x left, y up, z forward. The first clavicle is turned, the neck
/// larger than the rest.
fn arms_on_the_neck() -> Document {
    let bone = |name: &str, translation: [f64; 3], children: &[usize]| {
        let mut node = json!({ "name": name, "translation": translation });
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        node
    };
    let mut nodes: Vec<Value> = vec![
        bone("hips", [0.0, 0.95, 0.0], &[1]),
        bone("spine3", [0.0, 0.42, 0.0], &[2]),
        bone("neck", [0.0, 0.14, 0.0], &[3, 5, 6]),
        bone("head", [0.0, 0.09, 0.0], &[4, 9, 10]),
        bone("left_eye", [0.03, 0.06, 0.09], &[]),
        bone("left_clavicle", [0.03, -0.08, 0.0], &[7]),
        bone("right_clavicle", [-0.03, -0.08, 0.0], &[8]),
        bone("left_upper_arm", [0.155, -0.015, 0.0], &[]),
        bone("right_upper_arm", [-0.155, -0.015, 0.0], &[]),
        bone("right_eye", [-0.03, 0.06, 0.09], &[]),
        bone("glasses_arm_l", [0.07, 0.06, 0.0], &[]),
    ];
    nodes[5]["rotation"] = json!([0.0, 0.0, 0.6, 0.8]);
    nodes[2]["scale"] = json!([1.1, 1.1, 1.1]);
    let file = json!({ "asset": { "version": "2.0" }, "scenes": [{ "nodes": [0] }], "nodes": nodes });
    Document::from_bytes(&serde_json::to_vec(&file).expect("it is plain")).expect("the file is right")
}

#[test]
fn arms_that_hang_on_the_neck_stay_with_the_trunk() {
    let document = arms_on_the_neck();
    let skeleton = document.skeleton();
    let [chest, neck, arms] = [1, 2, 5];
    assert_eq!(limbs_on(skeleton, neck), [arms, arms + 1]);
    let mut spec: RigSpec = aim_codegen::declare::from_toml("mannequin.toml", RIG).expect("the rig is right");
    let (up, forward, left) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    spec.joints.iter_mut().for_each(|joint| joint.frame = aim_codegen::Frame { up, forward, left });
    spec.effector.frame = spec.joints[0].frame;
    let bones = spec.joints.iter().map(|joint| joint.bones.as_slice());
    let chain = ChainNodes::find(skeleton, bones, Some("right_eye")).expect("the bones are there");
    let plan = Plan {
        document: &document,
        clip: None,
        measurement: &Measurement::of(&document),
        chain: &chain,
        both_eyes: false,
        seconds: 1.0,
        fps: 30.0,
        settle: Settle::Animation,
        looped: false,
        settings: Settings::default(),
        target_node: None,
    };
    let target = |_: f32, _: &[DAffine3]| DVec3::new(2.0, 2.2, 0.5);
    let mut character = DynAim::new(InterpretedRig::new(&spec));
    let baked = bake(&mut character, &plan, target, |_, _| ()).expect("the plan is right");

    let rest = skeleton.world_f64(&skeleton.rest_pose());
    let on_chest = |world: &[DAffine3], node: usize| world[chest].inverse() * world[node];
    for frame in &baked.frames {
        let written = skeleton.world_f64(&skeleton.pose(&baked.clip, frame.t));
        for node in [arms, arms + 1, arms + 2, arms + 3] {
            let [now, before] = [on_chest(&written, node), on_chest(&rest, node)];
            assert!(now.abs_diff_eq(before, 1e-6), "{} at {} s", skeleton.nodes()[node].name, frame.t);
            assert!(frame.world[node].abs_diff_eq(written[node], 1e-6));
        }
    }
    // And what carries them moved, all of it.
    let end = &baked.frames.last().expect("there are frames").world;
    let turned = |node: usize| end[node].matrix3.z_axis.angle_between(rest[node].matrix3.z_axis).to_degrees();
    assert!(turned(chest) > 4.0 && turned(neck) > turned(chest) + 15.0, "{} {}", turned(chest), turned(neck));
}
