//! The VRM form of the mannequin: bones with VRM's names, and eyes that look by bones.

use aim_runtime::glam::{DMat3, DQuat, DVec3};
use serde_json::{Value, json};

use super::joints::Joint;

/// A version of the VRM format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Vrm {
    /// 0.x: characters face −Z.
    V0,
    /// 1.0: characters face +Z.
    V1,
}

/// Largest heading of the eyes, degrees: input and output of the horizontal range maps.
const LEVEL_DEG: f64 = 35.0;
/// Largest pitch of the eyes, degrees: input and output of the vertical range maps.
const UPRIGHT_DEG: f64 = 25.0;

impl Vrm {
    /// Scene ← character.
    pub(super) fn scene(self) -> DMat3 {
        match self {
            Self::V0 => DMat3::from_diagonal(DVec3::new(-1.0, 1.0, -1.0)),
            Self::V1 => DMat3::IDENTITY,
        }
    }

    /// Writes the VRM extension into the glTF JSON.
    pub(super) fn write(self, joints: &[Joint], json: &mut Value) {
        let (name, extension) = match self {
            Self::V0 => ("VRM", zero(joints)),
            Self::V1 => ("VRMC_vrm", one(joints)),
        };
        json["extensionsUsed"] = json!([name]);
        json["extensions"] = json!({ name: extension });
    }
}

/// Returns the rotation of a joint in the rest pose of a VRM file: arms level, to the sides.
pub(super) fn t_pose(joint: &str, position: impl Fn(&str) -> DVec3) -> DQuat {
    let Some((side, sign)) =
        joint.strip_suffix("_upper_arm").map(|side| (side, if side == "left" { 1.0 } else { -1.0 }))
    else {
        return DQuat::IDENTITY;
    };
    let arm = position(&format!("{side}_lower_arm")) - position(joint);
    DQuat::from_rotation_arc(arm.normalize(), DVec3::X * sign)
}

/// Returns the VRM bone name of a joint; `None` for a joint that VRM has no bone for.
fn bone(joint: &str) -> Option<String> {
    let (side, name) = match joint.split_once('_') {
        Some((side @ ("left" | "right"), name)) => (side, name),
        _ => ("", joint),
    };
    let sided = |name: &str| Some(format!("{side}{name}"));
    match name {
        "hips" | "spine" | "neck" | "head" => Some(name.to_owned()),
        "spine2" => Some("chest".to_owned()),
        "spine3" => Some("upperChest".to_owned()),
        "eye" => sided("Eye"),
        "clavicle" => sided("Shoulder"),
        "upper_arm" => sided("UpperArm"),
        "lower_arm" => sided("LowerArm"),
        "hand" => sided("Hand"),
        "upper_leg" => sided("UpperLeg"),
        "lower_leg" => sided("LowerLeg"),
        "foot" => sided("Foot"),
        "toes" => sided("Toes"),
        _ => None,
    }
}

fn bones(joints: &[Joint]) -> impl Iterator<Item = (String, usize)> + '_ {
    joints.iter().enumerate().filter_map(|(node, joint)| Some((bone(&joint.name)?, node)))
}

fn one(joints: &[Joint]) -> Value {
    let map = |degrees: f64| json!({ "inputMaxValue": degrees, "outputScale": degrees });
    json!({
        "specVersion": "1.0",
        "meta": {
            "name": "mannequin",
            "authors": ["aim"],
            "licenseUrl": "https://vrm.dev/licenses/1.0/",
        },
        "humanoid": {
            "humanBones": bones(joints).map(|(bone, node)| (bone, json!({ "node": node })))
                .collect::<serde_json::Map<_, _>>(),
        },
        // Empty, but present: readers that check whether eyes look by expressions take a missing object for missing
        // eyes.
        "expressions": { "preset": {} },
        "lookAt": {
            "type": "bone",
            "offsetFromHeadBone": [0.0, 0.06, 0.09],
            "rangeMapHorizontalInner": map(LEVEL_DEG),
            "rangeMapHorizontalOuter": map(LEVEL_DEG),
            "rangeMapVerticalDown": map(UPRIGHT_DEG),
            "rangeMapVerticalUp": map(UPRIGHT_DEG),
        },
    })
}

fn zero(joints: &[Joint]) -> Value {
    let map = |degrees: f64| json!({ "curve": [0, 0, 0, 1, 1, 1, 1, 0], "xRange": degrees, "yRange": degrees });
    let human = bones(joints).map(|(bone, node)| json!({ "bone": bone, "node": node, "useDefaultValues": true }));
    json!({
        "specVersion": "0.0",
        "exporterVersion": concat!("aim ", env!("CARGO_PKG_VERSION")),
        "meta": { "title": "mannequin", "author": "aim", "licenseName": "Other" },
        "humanoid": { "humanBones": human.collect::<Vec<_>>() },
        "firstPerson": {
            "firstPersonBone": joints.iter().position(|joint| joint.name == "head"),
            "firstPersonBoneOffset": { "x": 0.0, "y": 0.06, "z": 0.09 },
            "meshAnnotations": [],
            "lookAtTypeName": "Bone",
            "lookAtHorizontalInner": map(LEVEL_DEG),
            "lookAtHorizontalOuter": map(LEVEL_DEG),
            "lookAtVerticalDown": map(UPRIGHT_DEG),
            "lookAtVerticalUp": map(UPRIGHT_DEG),
        },
        "blendShapeMaster": { "blendShapeGroups": [] },
        "secondaryAnimation": { "boneGroups": [], "colliderGroups": [] },
        "materialProperties": [],
    })
}
