//! Plain reader of rig files for tests, without any code of the command, and rig files for the mannequin in any axes.

use std::fmt::Write;

use aim_runtime::glam::DVec3;
use serde_json::Value;

/// Joint as declared in its file, angles in degrees.
#[derive(Clone, Debug)]
pub(crate) struct Joint {
    pub(crate) forward: DVec3,
    pub(crate) up: DVec3,
    pub(crate) left: DVec3,
    /// Range of the heading: `None` for a hinge without heading, infinite if free.
    pub(crate) heading: Option<[f64; 2]>,
    pub(crate) pitch: Option<[f64; 2]>,
    pub(crate) rate: f64,
    /// Fraction by which the heading axis is tilted to the character's up, 0…1.
    pub(crate) upright: f64,
}

/// Returns the joints of a rig file, from the effector inward.
pub(crate) fn joints(text: &str) -> Vec<Joint> {
    let rig: Value = toml::from_str(text).expect("the rig's TOML parses");
    let joints = rig["joint"].as_array().expect("joints").iter();
    joints
        .map(|joint| {
            let axes = joint.get("axes").unwrap_or(&rig["axes"]);
            let axis = |key: &str, opposite: &str| {
                axes.get(key).map(direction).or_else(|| axes.get(opposite).map(|axis| -direction(axis)))
            };
            let (up, forward) = (axis("up", "down").expect("up"), axis("forward", "back").expect("forward"));
            let left = axis("left", "right").unwrap_or_else(|| up.cross(forward));
            Joint {
                forward,
                up,
                left,
                heading: range(joint.get("heading")),
                pitch: range(joint.get("pitch")),
                rate: angle(&joint["rate"]),
                upright: joint
                    .get("upright")
                    .map_or_else(|| usual_upright(joint.get("role")), |part| part.as_f64().expect("0…1")),
            }
        })
        .collect()
}

/// Returns the default of `upright`: 1 for neck and head, which turn about the character's up, otherwise 0.
fn usual_upright(role: Option<&Value>) -> f64 {
    if role.is_some_and(|role| role == "neck" || role == "head") { 1.0 } else { 0.0 }
}

fn direction(axis: &Value) -> DVec3 {
    if let Some(name) = axis.as_str() {
        let unit = DVec3::AXES[["X", "Y", "Z"].iter().position(|letter| name.ends_with(letter)).expect("an axis")];
        return if name.starts_with('-') { -unit } else { unit };
    }
    let numbers: Vec<f64> = axis.as_array().expect("three numbers").iter().filter_map(Value::as_f64).collect();
    DVec3::from_slice(&numbers).normalize()
}

fn range(value: Option<&Value>) -> Option<[f64; 2]> {
    let value = value?;
    if value == "free" {
        return Some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    Some([angle(&value[0]), angle(&value[1])])
}

fn angle(value: &Value) -> f64 {
    let text = value.as_str().expect("an angle");
    match (text.strip_suffix("deg"), text.strip_suffix("rad")) {
        (Some(degrees), _) => degrees.parse().expect("degrees"),
        (_, Some(radians)) => radians.parse::<f64>().expect("radians").to_degrees(),
        _ => panic!("an angle without unit: {text}"),
    }
}

/// Up, forward and left in a bone's space.
pub(crate) type Axes = [[f32; 3]; 3];

/// Returns all 48 triples of signed axes, 24 of each handedness.
pub(crate) fn conventions() -> Vec<Axes> {
    let mut out = Vec::new();
    for order in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
        for signs in 0..8_u8 {
            let mut axes = [[0.0; 3]; 3];
            for (row, column) in order.into_iter().enumerate() {
                axes[row][column] = if signs >> row & 1 == 0 { 1.0 } else { -1.0 };
            }
            out.push(axes);
        }
    }
    out
}

/// Returns the mannequin's rig for bones in other axes.
pub(crate) fn for_mannequin(axes_of: impl Fn(&str) -> Axes) -> String {
    let mut out = String::from("name = \"Trial\"\nhandedness = \"right\"\n");
    let joints = [
        ("left_eye", "eye", [35, -25, 20, 450], "other_eye = \"right_eye\"\nstiffness = 0.5\n"),
        ("neck", "neck", [60, -40, 35, 170], ""),
        ("spine3", "chest", [20, -10, 10, 70], "stiffness = 4.0\n"),
    ];
    for (bone, role, [side, down, up, rate], more) in joints {
        let axes = axes_of(bone);
        let [u, f, l] = axes.map(|axis| DVec3::from_array(axis.map(f64::from)));
        let mirrored = if l.cross(u).dot(f) < 0.0 { "mirrored = true\n" } else { "" };
        let [u, f, l] = axes;
        let _ = write!(
            out,
            "[[joint]]\nname = \"{bone}\"\nrole = \"{role}\"\naxes = {{ up = {u:?}, forward = {f:?}, left = {l:?} }}\n{mirrored}{more}\
             heading = [\"-{side}deg\", \"{side}deg\"]\npitch = [\"{down}deg\", \"{up}deg\"]\nrate = \"{rate}deg\"\n"
        );
    }
    out
}
