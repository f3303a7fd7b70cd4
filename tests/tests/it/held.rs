//! Arms whose bones are children of a neck stay with the trunk while the neck turns.

use aim_character::{Baked, InterpretedRig, Live, Measurement, Moment, Plan, Settle, bake, chain_nodes, limbs_on};
use aim_codegen::RigSpec;
use aim_gltf::Document;
use aim_runtime::glam::{DAffine3, DVec3};
use aim_runtime::{DynAim, Rig, Role, Settings};
use serde_json::{Value, json};

const RIG: &str = include_str!("../../../rigs/mannequin.toml");

/// A column of bones from hips to eye, with the arms under the neck; x is left, y up, z forward. The first clavicle is
/// rotated, the neck scaled up.
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

/// The mannequin's rig with the axes of [`arms_on_the_neck`]'s bones.
fn rig() -> RigSpec {
    let mut spec: RigSpec = aim_codegen::declare::from_toml("mannequin.toml", RIG).expect("the rig is right");
    let (up, forward, left) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]);
    spec.joints.iter_mut().for_each(|joint| joint.frame = aim_codegen::Frame { up, forward, left });
    spec.effector.frame = spec.joints[0].frame;
    spec
}

/// Bakes one second of aiming to the left and up.
fn baked(document: &Document, spec: &RigSpec) -> Baked {
    let chain = chain_nodes(spec, document.skeleton()).expect("the bones are there");
    let plan = Plan {
        document,
        clip: None,
        measurement: &Measurement::of(document),
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
    bake(&mut DynAim::new(InterpretedRig::new(spec)), &plan, target, |_, _| ()).expect("the plan is right")
}

#[test]
fn arms_that_hang_on_the_neck_stay_with_the_trunk() {
    let document = arms_on_the_neck();
    let skeleton = document.skeleton();
    let node = |name: &str| skeleton.find(name).expect("it is there");
    let [chest, neck] = ["spine3", "neck"].map(node);
    let clavicles = ["left_clavicle", "right_clavicle"].map(node);
    let arms = ["left_upper_arm", "right_upper_arm"].map(node);
    assert_eq!(limbs_on(skeleton, &Measurement::of(&document), neck), clavicles);
    let rest = skeleton.world_f64(skeleton.rest());
    let on_chest = |world: &[DAffine3], node: usize| world[chest].inverse() * world[node];
    let found = rig();
    let mut declared = rig();
    declared.joints[1].hold = Some(vec!["left_clavicle".into(), "right_clavicle".into()]);
    for spec in [found, declared] {
        let baked = baked(&document, &spec);
        for frame in &baked.frames {
            let written = skeleton.world_f64(&skeleton.pose(&baked.clip, frame.t));
            for node in [clavicles, arms].concat() {
                let [now, before] = [on_chest(&written, node), on_chest(&rest, node)];
                assert!(now.abs_diff_eq(before, 1e-6), "{} at {} s", skeleton.names()[node], frame.t);
                assert!(frame.world[node].abs_diff_eq(written[node], 1e-6));
            }
        }
        // The joints that carry them have moved.
        let end = &baked.frames.last().expect("there are frames").world;
        let turned = |node: usize| end[node].matrix3.z_axis.angle_between(rest[node].matrix3.z_axis).to_degrees();
        assert!(turned(chest) > 4.0 && turned(neck) > turned(chest) + 15.0, "{} {}", turned(chest), turned(neck));
    }
}

#[test]
fn what_is_declared_is_held_and_nothing_else() {
    let document = arms_on_the_neck();
    let skeleton = document.skeleton();
    let rest = skeleton.world_f64(skeleton.rest());
    let [chest, left, right, glasses] = ["spine3", "left_clavicle", "right_clavicle", "glasses_arm_l"]
        .map(|name| skeleton.find(name).expect("it is there"));
    for (hold, held) in [(&[][..], &[][..]), (&["left_clavicle"], &[left]), (&["glasses_arm_l"], &[glasses])] {
        let mut spec = rig();
        spec.joints[1].hold = Some(hold.iter().map(|name| (*name).to_owned()).collect());
        let baked = baked(&document, &spec);
        let end = &baked.frames.last().expect("there are frames").world;
        for node in [left, right, glasses] {
            let stays = (end[chest].inverse() * end[node]).abs_diff_eq(rest[chest].inverse() * rest[node], 1e-6);
            assert_eq!(stays, held.contains(&node), "{hold:?}: {}", skeleton.names()[node]);
        }
    }
}

/// At run time: the animated local transform of a bone under a neck, multiplied by the rig's held correction.
#[test]
fn a_game_holds_as_a_bake_does() {
    let document = arms_on_the_neck();
    let (skeleton, measurement) = (document.skeleton(), Measurement::of(&document));
    // A second neck in place of the eye's joint: the arms are under the inner one, the glasses under the outer.
    let mut spec = rig();
    let [eye, neck, _] = &mut spec.joints[..] else { panic!("three joints") };
    (eye.bones, eye.role, eye.other_eye) = (vec!["head".into()], Role::Neck, None);
    eye.hold = Some(vec!["glasses_arm_l".into()]);
    neck.hold = Some(vec!["left_clavicle".into()]);
    let chain = chain_nodes(&spec, skeleton).expect("the bones are there");
    let mut aim = DynAim::new(InterpretedRig::new(&spec));
    let live = Live::new(&aim.rig, &document, &measurement, &chain, false).expect("they are a chain");
    let mut pose = skeleton.rest().to_vec();
    let world = skeleton.world_f64(&pose);
    let joints = live.animated(&mut pose, &world);
    let target = DVec3::new(2.0, 2.2, 0.5);
    let outcome = aim.snap(&joints.pose(), target.as_vec3(), &Settings::default());
    let parents = skeleton.parents().iter().zip(&world);
    let locals: Vec<DAffine3> =
        parents.map(|(parent, here)| parent.map_or(*here, |parent| world[parent].inverse() * *here)).collect();
    let frame = live.aimed(
        &aim,
        skeleton,
        &mut pose,
        &Moment { t: 0.0, target, world: &world, joints: &joints, outcome, effector: 0 },
    );
    let description = aim.rig.description();
    for (joint, name) in [(0, "glasses_arm_l"), (1, "left_clavicle")] {
        let node = skeleton.find(name).expect("it is there");
        assert_eq!(aim.rig.held_bone(joint, 0), Some(name));
        assert_eq!(description.carrier(joint), Some(2));
        let correction = description.held_correction(joint, joints.pose().joints, aim.corrections());
        let correction =
            DAffine3 { matrix3: correction.matrix3.as_dmat3(), translation: correction.translation.as_dvec3() };
        let parent = skeleton.parents()[node].expect("it hangs on a joint");
        let held = frame.world[parent] * correction * locals[node];
        assert!(held.abs_diff_eq(frame.world[node], 2e-6), "{name}: {held:?} for {:?}", frame.world[node]);
        assert!(!held.abs_diff_eq(frame.world[parent] * locals[node], 0.01), "{name} would have stayed without");
    }
}

#[test]
fn what_cannot_be_held_is_told() {
    let document = arms_on_the_neck();
    for (joint, names, words) in [
        (1, &["left_clavicel"][..], "hold: no node named \"left_clavicel\"; the nearest names are left_clavicle"),
        (0, &["left_clavicle"], "hold names \"left_clavicle\", which is not below \"left_eye\""),
        (1, &["head"], "hold names \"head\", which carries \"left_eye\", a bone that is turned"),
        (2, &["left_clavicle", "left_upper_arm"], "hold names \"left_upper_arm\", which is below \"left_clavicle\""),
        (1, &["left_clavicle", "left_clavicle"], "hold names \"left_clavicle\" twice"),
    ] {
        let mut spec = rig();
        spec.joints[joint].hold = Some(names.iter().map(|name| (*name).to_owned()).collect());
        let error = chain_nodes(&spec, document.skeleton()).expect_err("it cannot be held").to_string();
        assert!(error.contains(words), "{error}");
    }
}
