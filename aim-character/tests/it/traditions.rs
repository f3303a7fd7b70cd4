//! Roles found by the names of many traditions.

use aim_character::Measurement;
use aim_gltf::Document;
use serde_json::json;

/// Returns the roles of a character whose joints have these names.
fn roles(names: &[&str]) -> Vec<(String, String)> {
    let mut json = json!({
        "asset": { "version": "2.0" },
        "nodes": names.iter().map(|name| json!({ "name": name })).collect::<Vec<_>>(),
        "skins": [{ "joints": (0..names.len()).collect::<Vec<_>>() }],
    });
    json["nodes"][0]["children"] = (1..names.len()).collect::<Vec<_>>().into();
    let document = Document::from_bytes(&serde_json::to_vec(&json).unwrap()).unwrap();
    let bones = Measurement::of(&document).bones;
    bones.into_iter().filter_map(|b| Some((b.role?.to_string(), b.name))).collect()
}

#[track_caller]
fn expect(names: &[&str], expected: &[(&str, &str)]) {
    let found = roles(names);
    let found: Vec<(&str, &str)> = found.iter().map(|(role, name)| (role.as_str(), name.as_str())).collect();
    assert_eq!(found, expected);
}

#[test]
fn mixamo_names_are_recognised() {
    expect(
        &[
            "mixamorig:Hips",
            "mixamorig:Spine",
            "mixamorig:Spine2",
            "mixamorig:Neck",
            "mixamorig:Head",
            "mixamorig:HeadTop_End",
            "mixamorig:LeftEye",
            "mixamorig:RightEye",
            "mixamorig:LeftShoulder",
            "mixamorig:LeftUpLeg",
        ],
        &[
            ("hips", "mixamorig:Hips"),
            ("spine", "mixamorig:Spine"),
            ("spine", "mixamorig:Spine2"),
            ("neck", "mixamorig:Neck"),
            ("head", "mixamorig:Head"),
            ("left_eye", "mixamorig:LeftEye"),
            ("right_eye", "mixamorig:RightEye"),
        ],
    );
}

#[test]
fn unreal_names_are_recognised() {
    expect(
        &[
            "root",
            "pelvis",
            "spine_01",
            "spine_05",
            "neck_01",
            "neck_02",
            "head",
            "clavicle_l",
            "FACIAL_L_Eye",
            "FACIAL_L_EyelidUpperA",
            "FACIAL_R_Eye",
            "ik_foot_root",
            "neck_twist_01",
        ],
        &[
            ("hips", "pelvis"),
            ("spine", "spine_01"),
            ("spine", "spine_05"),
            ("neck", "neck_01"),
            ("neck", "neck_02"),
            ("head", "head"),
            ("left_eye", "FACIAL_L_Eye"),
            ("right_eye", "FACIAL_R_Eye"),
        ],
    );
}

#[test]
fn the_thug_has_lids_that_are_called_eyes() {
    expect(
        &[
            "Root",
            "Pelvis",
            "Spine3",
            "Neck",
            "Head",
            "L_eye_joint1",
            "R_eye_joint",
            "L_eyeBall_joint2",
            "R_eyeBall_joint",
        ],
        &[
            ("hips", "Pelvis"),
            ("spine", "Spine3"),
            ("neck", "Neck"),
            ("head", "Head"),
            ("left_eye", "L_eyeBall_joint2"),
            ("right_eye", "R_eyeBall_joint"),
        ],
    );
}

#[test]
fn biped_names_are_recognised() {
    expect(
        &[
            "Bip01 Pelvis",
            "Bip01 Spine1",
            "Bip01 Neck",
            "Bip01 Head",
            "Bip01 HeadNub",
            "Bip01 LEye",
            "Bip01 REye",
            "Bip01 LEyeBlinkTop",
            "Bip01 MMiddleEyebrow",
            "Bip01 L Clavicle",
        ],
        &[
            ("hips", "Bip01 Pelvis"),
            ("spine", "Bip01 Spine1"),
            ("neck", "Bip01 Neck"),
            ("head", "Bip01 Head"),
            ("left_eye", "Bip01 LEye"),
            ("right_eye", "Bip01 REye"),
        ],
    );
}

#[test]
fn rigify_numbers_its_column() {
    expect(
        &[
            "root",
            "DEF-spine",
            "DEF-spine.001",
            "DEF-spine.003",
            "DEF-spine.004",
            "DEF-spine.005",
            "DEF-spine.006",
            "DEF-eye.L",
            "DEF-eye.R",
            "DEF-lid.T.L",
            "MCH-eye.L",
            "DEF-breast.L",
        ],
        &[
            ("hips", "DEF-spine"),
            ("spine", "DEF-spine.001"),
            ("spine", "DEF-spine.003"),
            ("neck", "DEF-spine.004"),
            ("neck", "DEF-spine.005"),
            ("head", "DEF-spine.006"),
            ("left_eye", "DEF-eye.L"),
            ("right_eye", "DEF-eye.R"),
        ],
    );
}

#[test]
fn quaternius_and_vroid_names_are_recognised() {
    expect(
        &["Hips", "Abdomen", "Torso", "Neck", "Head", "UpperArm.L", "Head_end"],
        &[("hips", "Hips"), ("spine", "Abdomen"), ("spine", "Torso"), ("neck", "Neck"), ("head", "Head")],
    );
    expect(
        &["J_Bip_C_Hips", "J_Bip_C_UpperChest", "J_Bip_C_Head", "J_Adj_L_FaceEye", "J_Adj_R_FaceEye"],
        &[
            ("hips", "J_Bip_C_Hips"),
            ("spine", "J_Bip_C_UpperChest"),
            ("head", "J_Bip_C_Head"),
            ("left_eye", "J_Adj_L_FaceEye"),
            ("right_eye", "J_Adj_R_FaceEye"),
        ],
    );
}

#[test]
fn vrm_roles_of_both_versions_are_read() {
    let nodes = json!([{ "children": [1, 2] }, { "name": "Kopf" }, { "name": "Auge", "children": [] }]);
    let bones = [
        json!({ "VRM": { "humanoid": { "humanBones": [{ "bone": "head", "node": 1 }, { "bone": "leftEye", "node": 2 }, { "node": 7 }, 3] } } }),
        json!({ "VRMC_vrm": { "humanoid": { "humanBones": { "head": { "node": 1 }, "leftEye": { "node": 2 }, "jaw": {} } } } }),
    ];
    for extension in bones {
        let json = json!({ "asset": { "version": "2.0" }, "nodes": nodes, "skins": [{ "joints": [0, 1] }], "extensions": extension });
        let document = Document::from_bytes(&serde_json::to_vec(&json).unwrap()).unwrap();
        let bones = Measurement::of(&document).bones;
        let found: Vec<_> = bones.iter().filter_map(|b| Some((b.name.as_str(), b.role?.as_str()))).collect();
        assert_eq!(found, [("Kopf", "head"), ("Auge", "left_eye")]);
    }
}
