//! The mannequin's joints: names, parents before children, places in metres (x left, y up, z forward).

use glam::DVec3;

/// One joint in the bind pose.
pub(crate) struct Joint {
    pub(crate) name: &'static str,
    pub(crate) parent: Option<usize>,
    /// Relative to the ground between the feet.
    pub(crate) position: DVec3,
}

/// Column, then the left limbs, whose mirror images follow.
const COLUMN: [(&str, Option<&str>, [f64; 3]); 7] = [
    ("hips", None, [0.0, 0.95, 0.0]),
    ("spine", Some("hips"), [0.0, 1.04, 0.0]),
    ("spine1", Some("spine"), [0.0, 1.15, 0.0]),
    ("spine2", Some("spine1"), [0.0, 1.26, 0.0]),
    ("spine3", Some("spine2"), [0.0, 1.37, 0.0]),
    ("neck", Some("spine3"), [0.0, 1.51, 0.0]),
    ("head", Some("neck"), [0.0, 1.60, 0.0]),
];

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

const LEFT: [&str; 9] = [
    "left_eye",
    "left_clavicle",
    "left_upper_arm",
    "left_lower_arm",
    "left_hand",
    "left_upper_leg",
    "left_lower_leg",
    "left_foot",
    "left_toes",
];
const RIGHT: [&str; 9] = [
    "right_eye",
    "right_clavicle",
    "right_upper_arm",
    "right_lower_arm",
    "right_hand",
    "right_upper_leg",
    "right_lower_leg",
    "right_foot",
    "right_toes",
];

/// All joints; indices are the order used everywhere in the mannequin.
pub(crate) fn joints() -> Vec<Joint> {
    let mut out: Vec<Joint> = Vec::new();
    let index = |out: &[Joint], name: &str| out.iter().position(|joint| joint.name == name);
    for (name, parent, position) in COLUMN {
        let parent = parent.and_then(|parent| index(&out, parent));
        out.push(Joint { name, parent, position: position.into() });
    }
    for (names, side) in [(LEFT, 1.0), (RIGHT, -1.0)] {
        let first = out.len();
        for (k, (_, parent, [x, y, z])) in LIMBS.into_iter().enumerate() {
            let limb = LIMBS.iter().position(|(name, ..)| *name == parent).map(|at| first + at);
            let parent = limb.or_else(|| index(&out, parent));
            out.push(Joint { name: names[k], parent, position: DVec3::new(x * side, y, z) });
        }
    }
    out
}
