//! The facing of a character and the roles of its bones, found from the file alone: turned, lying, mirrored, in
//! centimetres, with the names of many traditions or without names.

use crate::support::{bytes_of, data_uri, put_together, take_apart};
use aim_character::{Clue, MeasuredPose, Measurement, PAPER_AXES, Role, Stated, mannequin};
use aim_gltf::Document;
use aim_runtime::glam::{DMat3, DQuat, DVec3};
use serde_json::{Value, json};

/// The mannequin with changes to its JSON.
fn changed(change: impl FnOnce(&mut Value)) -> Document {
    let (mut json, bin) = take_apart(&mannequin(|_| PAPER_AXES).unwrap());
    change(&mut json);
    Document::from_bytes(&put_together(&json, &bin)).unwrap()
}

/// Attaches the figure to a new root.
fn on_root(json: &mut Value, turn: DQuat, scale: [f64; 3]) {
    let nodes = json["nodes"].as_array_mut().unwrap();
    let root = nodes.len();
    nodes.push(json!({ "name": "root", "children": [0], "rotation": turn.to_array(), "scale": scale }));
    json["scenes"][0]["nodes"] = json!([root, root - 1]);
}

fn rename(json: &mut Value, name: impl Fn(&str) -> Option<String>) {
    for node in json["nodes"].as_array_mut().unwrap() {
        let old = node["name"].as_str().unwrap().to_owned();
        match name(&old) {
            Some(new) => node["name"] = new.into(),
            None => drop(node.as_object_mut().unwrap().remove("name")),
        }
    }
}

/// Expects the mannequin's roles, except those of the eyes, which only names reveal.
fn expect_body(measured: &Measurement, what: &str) {
    let roles: Vec<&str> = measured.bones.iter().filter_map(|bone| Some(bone.role?.as_str())).collect();
    let body: Vec<&str> = roles.into_iter().filter(|role| !role.ends_with("_eye")).collect();
    assert_eq!(body, ["hips", "spine", "spine", "spine", "spine", "neck", "head"], "{what}");
}

/// Expects the given up and forward, and the paper's axes for every bone; for mirrored bones the third axis is
/// reversed.
fn expect_axes(measured: &Measurement, up: DVec3, forward: DVec3, mirrored: bool, what: &str) {
    let near = |a: DVec3, b: DVec3| a.distance(b) < 1e-5;
    assert!(near(measured.up, up), "{what}: up {}", measured.up);
    assert!(near(measured.forward, forward), "{what}: forward {} by {:?}", measured.forward, measured.evidence);
    assert!(near(measured.left, up.cross(forward)), "{what}: left {}", measured.left);
    for bone in measured.bones.iter().filter(|bone| bone.name != "root" && bone.parent.is_some()) {
        let axes = format!("{} {} {}", bone.up, bone.forward, bone.left);
        assert_eq!(axes, if mirrored { "+X +Y -Z" } else { "+X +Y +Z" }, "{what}: {}", bone.name);
        assert!(bone.deviation_deg < 1e-3, "{what}: {} is {}° off", bone.name, bone.deviation_deg);
    }
}

#[test]
fn any_facing_any_up_any_scale_named_or_nameless() {
    let ups = [
        DQuat::IDENTITY,
        DQuat::from_rotation_x(90_f64.to_radians()),
        DQuat::from_rotation_x(-90_f64.to_radians()),
        DQuat::from_rotation_x(180_f64.to_radians()),
        DQuat::from_rotation_z(90_f64.to_radians()),
        DQuat::from_rotation_z(-90_f64.to_radians()),
    ];
    let mut is_taken = (0_usize..).map(|case| crate::in_full() || case % 7 == 0);
    for (number, stand) in ups.into_iter().enumerate() {
        for yaw in [0.0, 90.0, 180.0, 270.0, 37.0] {
            for scale in [1.0, 100.0, 0.01] {
                for named in [true, false] {
                    if is_taken.next() == Some(false) {
                        continue;
                    }
                    let turn = stand * DQuat::from_rotation_y(f64::to_radians(yaw));
                    let document = changed(|json| {
                        on_root(json, turn, [scale; 3]);
                        if !named {
                            rename(json, |_| None);
                        }
                    });
                    let measured = Measurement::of(&document);
                    let what = format!("up {number}, yaw {yaw}, scale {scale}, named {named}");
                    expect_axes(&measured, turn * DVec3::Y, turn * DVec3::Z, false, &what);
                    expect_body(&measured, &what);
                    assert!((measured.height / scale - 1.77).abs() < 0.1, "{what}: {}", measured.height);
                    assert!(measured.confidence > 0.5, "{what}: {}", measured.confidence);
                }
            }
        }
    }
}

/// Adds a node with a rigid mesh of these points; returns its index.
fn rigid_part(json: &mut Value, points: &[[f32; 3]]) -> usize {
    let bytes = bytes_of(points.as_flattened());
    let add = |json: &mut Value, key: &str, item: Value| {
        let list = json[key].as_array_mut().unwrap();
        list.push(item);
        list.len() - 1
    };
    let buffer = add(json, "buffers", json!({ "byteLength": bytes.len(), "uri": data_uri(&bytes) }));
    let view = add(json, "bufferViews", json!({ "buffer": buffer, "byteLength": bytes.len() }));
    let position = add(
        json,
        "accessors",
        json!({ "bufferView": view, "componentType": 5126, "count": points.len(), "type": "VEC3" }),
    );
    let mesh = add(json, "meshes", json!({ "primitives": [{ "attributes": { "POSITION": position } }] }));
    add(json, "nodes", json!({ "mesh": mesh }))
}

/// Reduces the skin to two points of a hand.
fn skin_of_a_hand(json: &mut Value) {
    let hand = rigid_part(json, &[[0.4, 1.0, 0.0], [0.5, 1.1, 0.0]]);
    let nodes = json["nodes"].as_array_mut().unwrap();
    let mesh = nodes[hand]["mesh"].take();
    nodes.truncate(hand);
    nodes.iter_mut().find(|node| node.get("skin").is_some()).unwrap()["mesh"] = mesh;
}

#[test]
fn rigid_parts_on_bones_count_for_the_height_and_what_stands_around_does_not() {
    let hang = |json: &mut Value, parent: &str, part: usize| {
        let nodes = json["nodes"].as_array_mut().unwrap();
        let parent = nodes.iter_mut().find(|node| node["name"] == parent).unwrap();
        match parent["children"].as_array_mut() {
            Some(children) => children.push(part.into()),
            None => parent["children"] = json!([part]),
        }
    };
    let document = changed(|json| {
        skin_of_a_hand(json);
        // In the paper's axes a bone's +X is up.
        let head = rigid_part(json, &[[0.0, 0.0, 0.0], [0.3, 0.0, 0.0]]);
        hang(json, "head", head);
        for foot in ["left_foot", "right_foot"] {
            let part = rigid_part(json, &[[-0.08, 0.0, 0.0], [0.0, 0.1, 0.0]]);
            hang(json, foot, part);
        }
        let sky = rigid_part(json, &[[0.0, -50.0, 0.0], [0.0, 50.0, 0.0]]);
        json["scenes"][0]["nodes"].as_array_mut().unwrap().push(sky.into());
    });
    let measured = Measurement::of(&document);
    let at = |name: &str| measured.bind_world[document.skeleton().find(name).unwrap()].translation.y;
    let expected = at("head") + 0.3 - (at("left_foot") - 0.08);
    assert!((measured.height - expected).abs() < 1e-6, "{} instead of {expected}", measured.height);
}

#[test]
fn bones_count_for_the_height_where_nothing_is_shown_of_them() {
    let document = changed(skin_of_a_hand);
    let measured = Measurement::of(&document);
    let at = |role: Role| measured.with_role(role).unwrap().bind_world.translation.y;
    let expected = at(Role::LeftEye) - at(Role::Hips);
    assert!((measured.height - expected).abs() < 1e-6, "{} instead of {expected}", measured.height);
}

#[test]
fn under_a_mirrored_root_the_body_decides_and_the_names_are_told_to_contradict() {
    let document = changed(|json| on_root(json, DQuat::IDENTITY, [-1.0, 1.0, 1.0]));
    let measured = Measurement::of(&document);
    expect_axes(&measured, DVec3::Y, DVec3::Z, true, "mirrored");
    let names = measured.evidence.iter().find(|said| matches!(said.clue, Clue::Names { .. })).unwrap();
    assert!(!names.agrees, "{:?}", measured.evidence);
    assert!(measured.confidence < 0.7, "{}", measured.confidence);
}

#[test]
fn joints_that_mirror_front_to_back_do_not_make_them_the_sides() {
    // A nameless figure: a column along z with equal ends, and one leg on its left with a toe ahead.
    let column: Vec<Value> = (0..9)
        .map(|at| json!({ "translation": [0.0, if at == 0 { 1.0 } else { 0.0 }, if at == 0 { -1.0 } else { 0.25 }], "children": [at + 1] }))
        .collect();
    let mut json =
        json!({ "asset": { "version": "2.0" }, "nodes": column, "skins": [{ "joints": (0..11).collect::<Vec<_>>() }] });
    let nodes = json["nodes"].as_array_mut().unwrap();
    nodes[8].as_object_mut().unwrap().remove("children");
    nodes[4]["children"] = json!([5, 9]);
    nodes.push(json!({ "translation": [0.2, -0.9, -0.05], "children": [10] }));
    nodes.push(json!({ "translation": [0.0, -0.1, 0.1] }));
    let document = Document::from_bytes(json.to_string().as_bytes()).unwrap();
    let measured = Measurement::of(&document);
    assert_eq!(measured.forward, DVec3::Z, "{:?}", measured.evidence);
    let symmetry = measured.evidence.iter().find(|said| said.clue == Clue::Symmetry).unwrap();
    assert!(!symmetry.agrees && measured.confidence <= 0.5, "{} by {:?}", measured.confidence, measured.evidence);
}

#[test]
fn what_makes_no_front_is_no_confidence_in_it() {
    let named = Measurement::of(&changed(|_| {}));
    let nameless = Measurement::of(&changed(|json| rename(json, |_| None)));
    assert!(named.confidence > 0.85, "{}", named.confidence);
    assert!((0.5..0.65).contains(&nameless.confidence), "feet alone: {}", nameless.confidence);
}

#[test]
fn what_is_stated_overrules_every_clue() {
    let document = changed(|_| {});
    let stated = |up, forward| Measurement::stated(&document, Stated { up, forward });
    let measured = stated(None, Some(DVec3::NEG_X));
    assert_eq!((measured.up, measured.forward, measured.left), (DVec3::Y, DVec3::NEG_X, DVec3::Z));
    assert_eq!(measured.confidence.to_bits(), 1.0_f64.to_bits());
    let names = measured.evidence.iter().find(|said| matches!(said.clue, Clue::Names { .. })).unwrap();
    assert!(!names.agrees, "{:?}", measured.evidence);
    let measured = stated(Some(DVec3::Z), Some(DVec3::new(0.0, 2.0, 5.0)));
    assert_eq!((measured.up, measured.forward), (DVec3::Z, DVec3::Y));
    // A statement without a direction is ignored.
    for nothing in [DVec3::ZERO, DVec3::NAN, DVec3::Y] {
        let measured = stated(None, Some(nothing));
        assert_eq!(measured.forward, DVec3::Z, "{nothing}");
        assert!(measured.confidence < 1.0, "{nothing}");
    }
}

#[test]
fn names_of_sides_that_are_exchanged_do_not_turn_the_character_round() {
    let swap = |name: &str| {
        Some(match name.split_once('_') {
            Some(("left", rest)) => format!("right_{rest}"),
            Some(("right", rest)) => format!("left_{rest}"),
            _ => name.to_owned(),
        })
    };
    let measured = Measurement::of(&changed(|json| rename(json, swap)));
    expect_axes(&measured, DVec3::Y, DVec3::Z, false, "exchanged");
}

/// Name of the tradition; names of hips, spine, spine1, spine2, spine3, neck and head; patterns, with `*` for the side,
/// of eye, clavicle, upper arm, lower arm, hand, upper leg, lower leg, foot and toes; and the two sides.
type Tradition = (&'static str, [&'static str; 7], [&'static str; 9], [&'static str; 2]);

const TRADITIONS: &[Tradition] = &[
    (
        "Mixamo",
        [
            "mixamorig:Hips",
            "mixamorig:Spine",
            "mixamorig:Spine1",
            "mixamorig:Spine2",
            "mixamorig:Spine3",
            "mixamorig:Neck",
            "mixamorig:Head",
        ],
        [
            "mixamorig:*Eye",
            "mixamorig:*Shoulder",
            "mixamorig:*Arm",
            "mixamorig:*ForeArm",
            "mixamorig:*Hand",
            "mixamorig:*UpLeg",
            "mixamorig:*Leg",
            "mixamorig:*Foot",
            "mixamorig:*ToeBase",
        ],
        ["Left", "Right"],
    ),
    (
        "Ready Player Me",
        ["Hips", "Spine", "Spine1", "Spine2", "Spine3", "Neck", "Head"],
        ["*Eye", "*Shoulder", "*Arm", "*ForeArm", "*Hand", "*UpLeg", "*Leg", "*Foot", "*ToeBase"],
        ["Left", "Right"],
    ),
    (
        "Unreal",
        ["pelvis", "spine_01", "spine_02", "spine_03", "spine_04", "neck_01", "head"],
        ["FACIAL_*_Eye", "clavicle_*", "upperarm_*", "lowerarm_*", "hand_*", "thigh_*", "calf_*", "foot_*", "ball_*"],
        ["l", "r"],
    ),
    (
        "VRoid",
        [
            "J_Bip_C_Hips",
            "J_Bip_C_Spine",
            "J_Bip_C_Chest",
            "J_Bip_C_UpperChest",
            "J_Bip_C_UpperChest2",
            "J_Bip_C_Neck",
            "J_Bip_C_Head",
        ],
        [
            "J_Adj_*_FaceEye",
            "J_Bip_*_Shoulder",
            "J_Bip_*_UpperArm",
            "J_Bip_*_LowerArm",
            "J_Bip_*_Hand",
            "J_Bip_*_UpperLeg",
            "J_Bip_*_LowerLeg",
            "J_Bip_*_Foot",
            "J_Bip_*_ToeBase",
        ],
        ["L", "R"],
    ),
    (
        "3ds Max Biped",
        ["Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1", "Bip01 Spine2", "Bip01 Spine3", "Bip01 Neck", "Bip01 Head"],
        [
            "Bip01 *Eye",
            "Bip01 * Clavicle",
            "Bip01 * UpperArm",
            "Bip01 * Forearm",
            "Bip01 * Hand",
            "Bip01 * Thigh",
            "Bip01 * Calf",
            "Bip01 * Foot",
            "Bip01 * Toe0",
        ],
        ["L", "R"],
    ),
    (
        "MakeHuman",
        ["root", "spine05", "spine04", "spine03", "spine01", "neck01", "head"],
        [
            "eye.*",
            "clavicle.*",
            "upperarm01.*",
            "lowerarm01.*",
            "wrist.*",
            "upperleg01.*",
            "lowerleg01.*",
            "foot.*",
            "toe1-1.*",
        ],
        ["L", "R"],
    ),
    (
        "Rigify",
        [
            "DEF-spine",
            "DEF-spine.001",
            "DEF-spine.002",
            "DEF-spine.003",
            "DEF-spine.0035",
            "DEF-spine.004",
            "DEF-spine.006",
        ],
        [
            "DEF-eye.*",
            "DEF-shoulder.*",
            "DEF-upper_arm.*",
            "DEF-forearm.*",
            "DEF-hand.*",
            "DEF-thigh.*",
            "DEF-shin.*",
            "DEF-foot.*",
            "DEF-toe.*",
        ],
        ["L", "R"],
    ),
    (
        "Valve",
        [
            "ValveBiped.Bip01_Pelvis",
            "ValveBiped.Bip01_Spine",
            "ValveBiped.Bip01_Spine1",
            "ValveBiped.Bip01_Spine2",
            "ValveBiped.Bip01_Spine4",
            "ValveBiped.Bip01_Neck1",
            "ValveBiped.Bip01_Head1",
        ],
        [
            "ValveBiped.Bip01_*_Eye",
            "ValveBiped.Bip01_*_Clavicle",
            "ValveBiped.Bip01_*_UpperArm",
            "ValveBiped.Bip01_*_Forearm",
            "ValveBiped.Bip01_*_Hand",
            "ValveBiped.Bip01_*_Thigh",
            "ValveBiped.Bip01_*_Calf",
            "ValveBiped.Bip01_*_Foot",
            "ValveBiped.Bip01_*_Toe0",
        ],
        ["L", "R"],
    ),
    (
        "XNA's dude",
        ["Pelvis", "Spine", "Spine1", "Spine2", "Spine3", "Neck", "Head"],
        [
            "*_eyeBall_joint",
            "*_Clavicle",
            "*_UpperArm",
            "*_Forearm",
            "*_Hand",
            "*_Thigh",
            "*_Knee",
            "*_Ankle",
            "*_Ball",
        ],
        ["L", "R"],
    ),
    (
        "Quaternius",
        ["Hips", "Abdomen", "Torso", "Chest", "UpperChest", "Neck", "Head"],
        ["Eye.*", "Shoulder.*", "UpperArm.*", "LowerArm.*", "Palm.*", "UpperLeg.*", "LowerLeg.*", "Foot.*", "Toes.*"],
        ["L", "R"],
    ),
    (
        "Character Creator",
        [
            "CC_Base_Hip",
            "CC_Base_Waist",
            "CC_Base_Spine01",
            "CC_Base_Spine02",
            "CC_Base_Spine03",
            "CC_Base_NeckTwist01",
            "CC_Base_Head",
        ],
        [
            "CC_Base_*_Eye",
            "CC_Base_*_Clavicle",
            "CC_Base_*_Upperarm",
            "CC_Base_*_Forearm",
            "CC_Base_*_Hand",
            "CC_Base_*_Thigh",
            "CC_Base_*_Calf",
            "CC_Base_*_Foot",
            "CC_Base_*_ToeBase",
        ],
        ["L", "R"],
    ),
    (
        "Daz",
        ["hip", "abdomenLower", "abdomenUpper", "chestLower", "chestUpper", "neckLower", "head"],
        ["*Eye", "*Collar", "*ShldrBend", "*ForearmBend", "*Hand", "*ThighBend", "*Shin", "*Foot", "*Toe"],
        ["l", "r"],
    ),
    (
        "AutoRig Pro",
        ["root.x", "spine_01.x", "spine_02.x", "spine_03.x", "spine_04.x", "neck.x", "head.x"],
        [
            "c_eye.*",
            "shoulder.*",
            "arm_stretch.*",
            "forearm_stretch.*",
            "hand.*",
            "thigh_stretch.*",
            "leg_stretch.*",
            "foot.*",
            "toes_01.*",
        ],
        ["l", "r"],
    ),
    (
        "AdvancedSkeleton",
        ["Root_M", "Spine1_M", "Spine2_M", "Spine3_M", "Chest_M", "Neck_M", "Head_M"],
        ["Eye_*", "Scapula_*", "Shoulder_*", "Elbow_*", "Wrist_*", "Hip_*", "Knee_*", "Ankle_*", "Toes_*"],
        ["L", "R"],
    ),
    (
        "MikuMikuDance",
        ["下半身", "上半身", "上半身2", "上半身3", "上半身4", "首", "頭"],
        ["*目", "*肩", "*腕", "*ひじ", "*手首", "*足", "*ひざ", "*足首", "*つま先"],
        ["左", "右"],
    ),
];
#[test]
fn numbers_that_run_the_other_way_and_a_head_called_neck() {
    let document = changed(|json| {
        rename(json, |old| {
            Some(match old {
                "spine" | "spine1" | "spine2" | "spine3" | "hips" => format!("torso_joint_{old}").replace("hips", "0"),
                "neck" => "neck_joint_1".into(),
                "head" => "neck_joint_2".into(),
                _ => match old.split_once('_') {
                    Some(("left", limb)) if limb.contains("arm") => {
                        format!("arm_joint_L__{}_", if limb == "upper_arm" { 4 } else { 3 })
                    }
                    Some(("right", limb)) if limb.contains("arm") => {
                        format!("arm_joint_R__{}_", if limb == "upper_arm" { 1 } else { 2 })
                    }
                    _ => old.replace("eye", "x").replace("hand", "y"),
                },
            })
        });
        // Names are exchanged on the right, so that the deeper joint comes first among namesakes.
        for node in json["nodes"].as_array_mut().unwrap() {
            if node["name"] == "right_clavicle" {
                node["name"] = "arm_joint_R__0_".into();
            }
        }
    });
    let measured = Measurement::of(&document);
    expect_axes(&measured, DVec3::Y, DVec3::Z, false, "numbered");
    assert_eq!(measured.with_role(Role::Head).unwrap().name, "neck_joint_2");
    assert_eq!(measured.with_role(Role::Neck).unwrap().name, "neck_joint_1");
}

const COLUMN: [&str; 7] = ["hips", "spine", "spine1", "spine2", "spine3", "neck", "head"];
const LIMBS: [&str; 9] =
    ["eye", "clavicle", "upper_arm", "lower_arm", "hand", "upper_leg", "lower_leg", "foot", "toes"];

#[test]
fn every_tradition_of_names() {
    for (tradition, column, limbs, sides) in TRADITIONS {
        let name = |old: &str| {
            let at = |names: &[&str], name: &str| names.iter().position(|known| *known == name);
            let sided = |side: &str, limb: &str| limbs[at(&LIMBS, limb).unwrap()].replace('*', side);
            Some(match old.split_once('_') {
                Some(("left", limb)) => sided(sides[0], limb),
                Some(("right", limb)) => sided(sides[1], limb),
                _ => at(&COLUMN, old).map_or("mesh", |at| column[at]).to_owned(),
            })
        };
        let turn = DQuat::from_rotation_y(2.0);
        let document = changed(|json| {
            on_root(json, turn, [1.0; 3]);
            rename(json, |old| if old == "root" { Some("Armature".into()) } else { name(old) });
        });
        let measured = Measurement::of(&document);
        expect_body(&measured, tradition);
        expect_axes(&measured, DVec3::Y, turn * DVec3::Z, false, tradition);
        for (role, name) in [(Role::LeftEye, "left_eye"), (Role::RightEye, "right_eye")] {
            let eye = measured.with_role(role).unwrap_or_else(|| panic!("{tradition} has no {role}"));
            let side = if name == "left_eye" { 0 } else { 1 };
            assert_eq!(eye.name, limbs[0].replace('*', sides[side]), "{tradition}");
        }
        assert!(measured.confidence > 0.7, "{tradition}: {} by {:?}", measured.confidence, measured.evidence);
    }
}

#[test]
fn a_rest_pose_that_is_not_the_bind_pose_is_told_by_how_much() {
    // The head of a widely used robot model is turned by 173° in its rest pose.
    let document = changed(|json| {
        let head = json["nodes"].as_array_mut().unwrap().iter_mut().find(|node| node["name"] == "head").unwrap();
        let rest = DQuat::from_slice(&[0, 1, 2, 3].map(|i| head["rotation"][i].as_f64().unwrap()));
        head["rotation"] = json!((rest * DQuat::from_rotation_x(173_f64.to_radians())).to_array());
    });
    let measured = Measurement::of(&document);
    assert_eq!(measured.pose, MeasuredPose::Bind);
    expect_axes(&measured, DVec3::Y, DVec3::Z, false, "bind pose");
    let turned = measured.bones.iter().filter(|bone| bone.rest_deg > 0.01);
    let turned: Vec<_> = turned.map(|bone| (bone.name.as_str(), bone.rest_deg.round())).collect();
    assert_eq!(turned, [("head", 173.0), ("left_eye", 173.0), ("right_eye", 173.0)]);
    let rest = Measurement::in_pose(&document, MeasuredPose::Rest);
    let head = rest.with_role(Role::Head).unwrap();
    assert_eq!((rest.pose, head.forward.as_str()), (MeasuredPose::Rest, "-Y"));
    assert!((head.deviation_deg - 7.0).abs() < 1e-3, "{}", head.deviation_deg);
}

#[test]
fn a_lamp_and_a_turret_face_where_they_point() {
    for (name, reach) in [("barrel", DVec3::new(0.8, 0.0, 0.0)), ("Lamp_Shade", DVec3::new(0.0, 0.1, -0.5))] {
        let json = json!({ "asset": { "version": "2.0" }, "nodes": [
            { "name": "base", "children": [1] },
            { "name": "arm", "children": [2], "translation": [0.0, 1.0, 0.0] },
            { "name": name, "children": [3] },
            { "name": "end", "translation": reach.to_array() },
        ]});
        let measured = Measurement::of(&Document::from_bytes(&serde_json::to_vec(&json).unwrap()).unwrap());
        let level = DVec3 { y: 0.0, ..reach }.normalize();
        assert!(measured.forward.distance(level) < 1e-9, "{name}: {}", measured.forward);
        assert!(measured.evidence.iter().any(|said| said.clue == Clue::Reach { node: 2 }), "{:?}", measured.evidence);
    }
}

#[test]
fn without_any_clue_the_formats_word_is_taken_and_not_trusted() {
    let json = json!({ "asset": { "version": "2.0" }, "nodes": [{ "name": "thing" }] });
    let measured = Measurement::of(&Document::from_bytes(&serde_json::to_vec(&json).unwrap()).unwrap());
    assert_eq!((measured.up, measured.forward), (DVec3::Y, DVec3::Z));
    assert!(measured.confidence < 0.5 && measured.pose == MeasuredPose::Rest);
    assert!(DMat3::from_cols(measured.left, measured.up, measured.forward).determinant() > 0.99);
}

#[test]
fn large_and_hostile_trees_take_no_longer_than_their_size() {
    // A thousand limbs on a long column, all with the same shape and name.
    let mut nodes: Vec<Value> = (0..1000)
        .map(|at| json!({ "name": format!("arm_l.{at}"), "children": [at + 1], "translation": [0.0, 0.01, 0.0] }))
        .collect();
    let first = nodes.len() + 1;
    let limbs: Vec<usize> = (0..1000).map(|limb| first + 2 * limb).collect();
    nodes.push(json!({ "name": "thigh_r", "children": limbs }));
    for limb in limbs {
        let side = if limb % 4 == 1 { 1.0 } else { -1.0 };
        nodes.push(json!({ "name": "leg.R", "children": [limb + 1], "translation": [side, 0.0, 0.0] }));
        nodes.push(json!({ "name": "toe.L", "translation": [0.0, 0.1, 0.0] }));
    }
    let joints: Vec<usize> = (0..nodes.len()).collect();
    let json = json!({ "asset": { "version": "2.0" }, "nodes": nodes, "skins": [{ "joints": joints }] });
    let measured = Measurement::of(&Document::from_bytes(&serde_json::to_vec(&json).unwrap()).unwrap());
    assert_eq!(measured.bones.len(), 3001);
    assert!(measured.forward.is_finite() && measured.confidence.is_finite());
}

#[test]
fn nameless_bones_of_a_tree_that_hangs_collarbones_on_the_neck() {
    let document = changed(|json| {
        let nodes = json["nodes"].as_array_mut().unwrap();
        let at = |nodes: &Vec<Value>, name: &str| nodes.iter().position(|node| node["name"] == name).unwrap();
        let (chest, neck) = (at(nodes, "spine3"), at(nodes, "neck"));
        for side in ["left", "right"] {
            let collar = at(nodes, &format!("{side}_clavicle"));
            nodes[chest]["children"].as_array_mut().unwrap().retain(|child| *child != collar);
            nodes[neck]["children"].as_array_mut().unwrap().push(collar.into());
            // In the paper's axes the first component is the height, here relative to the neck's joint.
            nodes[collar]["translation"] = json!([-0.01, 0.0, nodes[collar]["translation"][2]]);
        }
        rename(json, |_| None);
    });
    let rest = Measurement::in_pose(&document, MeasuredPose::Rest);
    expect_body(&rest, "collarbones on the neck");
}
