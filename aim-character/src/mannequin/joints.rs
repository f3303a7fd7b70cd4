//! The mannequin's joints: names, parents before children, positions in metres (x left, y up, z forward).

use aim_runtime::glam::{DMat3, DQuat, DVec3};

/// One joint in the bind pose.
pub(crate) struct Joint {
    pub(crate) name: String,
    pub(crate) parent: Option<usize>,
    /// Position relative to the ground between the feet, metres.
    pub(crate) position: DVec3,
}

/// Frame and position of one joint, from which its local transforms are computed.
pub(crate) struct Bone {
    /// Character ← bone, orthonormal, mirrored or not.
    pub(crate) frame: DMat3,
    /// Parent bone ← character.
    pub(crate) to_parent: DMat3,
    /// Offset from the parent joint, in the character's space.
    pub(crate) offset: DVec3,
    /// Local scale: one axis is negative if bone and parent differ in handedness.
    pub(crate) mirror: DVec3,
}

impl Bone {
    /// Returns the local translation for an additional offset in the character's space.
    pub(crate) fn translation(&self, extra: DVec3) -> DVec3 {
        self.to_parent * (self.offset + extra)
    }

    /// Returns the local rotation that turns the bone by `turn`, given in the character's axes.
    pub(crate) fn rotation(&self, turn: DQuat) -> DQuat {
        let local = self.to_parent * DMat3::from_quat(turn) * self.frame * DMat3::from_diagonal(self.mirror);
        DQuat::from_mat3(&local).normalize()
    }
}

/// Joints of the column: name, parent, position.
const COLUMN: [(&str, Option<&str>, [f64; 3]); 7] = [
    ("hips", None, [0.0, 0.95, 0.0]),
    ("spine", Some("hips"), [0.0, 1.04, 0.0]),
    ("spine1", Some("spine"), [0.0, 1.15, 0.0]),
    ("spine2", Some("spine1"), [0.0, 1.26, 0.0]),
    ("spine3", Some("spine2"), [0.0, 1.37, 0.0]),
    ("neck", Some("spine3"), [0.0, 1.51, 0.0]),
    ("head", Some("neck"), [0.0, 1.60, 0.0]),
];

/// Joints of the left limbs: name, parent, position. The right limbs are their mirror images.
const LIMBS: [(&str, &str, [f64; 3]); 9] = [
    ("eye", "head", [0.03, 1.66, 0.09]),
    ("clavicle", "spine3", [0.03, 1.43, 0.0]),
    ("upper_arm", "clavicle", [0.185, 1.415, -0.005]),
    ("lower_arm", "upper_arm", [0.235, 1.14, -0.015]),
    ("hand", "lower_arm", [0.265, 0.895, 0.02]),
    ("upper_leg", "hips", [0.09, 0.92, 0.0]),
    ("lower_leg", "upper_leg", [0.095, 0.50, 0.01]),
    ("foot", "lower_leg", [0.095, 0.085, -0.02]),
    ("toes", "foot", [0.1, 0.025, 0.09]),
];

/// Returns all joints. Their order gives the indices used throughout the mannequin.
pub(crate) fn joints() -> Vec<Joint> {
    let mut out: Vec<Joint> = Vec::new();
    let index = |out: &[Joint], name: &str| out.iter().position(|joint| joint.name == name);
    for (name, parent, position) in COLUMN {
        let parent = parent.and_then(|parent| index(&out, parent));
        out.push(Joint { name: name.to_owned(), parent, position: position.into() });
    }
    for (side, sign) in [("left", 1.0), ("right", -1.0)] {
        let first = out.len();
        for (name, parent, [x, y, z]) in LIMBS {
            let limb = LIMBS.iter().position(|(name, ..)| *name == parent).map(|at| first + at);
            let parent = limb.or_else(|| index(&out, parent));
            out.push(Joint { name: format!("{side}_{name}"), parent, position: DVec3::new(x * sign, y, z) });
        }
    }
    out
}
