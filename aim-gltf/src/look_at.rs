//! Look-at range maps of a VRM file, version 1.0 or 0.x, and the eyes that turn by them.
//!
//! A range map takes the angle to the target on one side to the angle by which the eye turns there, usually a smaller
//! one: VRM eyes are drawn large. So aiming solves for the angle to the target, and [`EyeMaps`] turns the bones.

use glam::{DQuat, DVec3, Quat};
use serde_json::Value;

use crate::chain::ChainNodes;
use crate::document::Document;
use crate::measure::{BoneAxes, BoneFrame, Measurement};
use crate::roles::Role;
use crate::trs::Trs;

/// Part of a VRM character that looking moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LookAtKind {
    /// The bones `leftEye` and `rightEye`.
    Bone,
    /// The expressions `lookLeft`, `lookRight`, `lookUp` and `lookDown`.
    Expression,
}

/// A linear map from the target's angle in one direction to the eye's, constant from its largest input on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RangeMap {
    /// The input, degrees, from which on the output is largest; if it is not above 0, any positive input gives that.
    pub input_max_value: f64,
    /// The largest output: degrees for bones, a weight for expressions.
    pub output_scale: f64,
}

impl RangeMap {
    /// Whether it turns an eye (or gives an expression weight) at all.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.output_scale > 0.0
    }

    /// The output for `input` degrees; inputs below 0 (or not a number) count as 0.
    #[must_use]
    pub fn apply(&self, input: f64) -> f64 {
        // Not a number is not above 0 either.
        if input > 0.0 {
            let share = if self.input_max_value > 0.0 { (input / self.input_max_value).min(1.0) } else { 1.0 };
            share * self.output_scale
        } else {
            0.0
        }
    }

    /// The least input, degrees, that gives `output`; 0 of a map that moves nothing.
    pub(crate) fn input(&self, output: f64) -> f64 {
        let share = output / self.output_scale;
        if self.moves() { share.clamp(0.0, 1.0) * self.input_max_value.max(0.0) } else { 0.0 }
    }
}

/// A VRM file's `lookAt`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LookAt {
    /// What moves.
    pub kind: LookAtKind,
    /// Towards the nose.
    pub horizontal_inner: RangeMap,
    /// Away from the nose; for expressions, both ways.
    pub horizontal_outer: RangeMap,
    /// Downwards.
    pub vertical_down: RangeMap,
    /// Upwards.
    pub vertical_up: RangeMap,
}

impl LookAt {
    /// Reads the file's `lookAt`; `None` if it is no VRM file or has none. A number that is missing, or that makes no sense, is
    /// VRM's default: 90° of input, and 90° (for expressions 1) of output.
    #[must_use]
    pub fn of(document: &Document) -> Option<Self> {
        Self::read(document.json().get("extensions")?).map(|(look, _)| look)
    }

    /// The numbers of the file's `lookAt` that make no sense and what is used instead, a sentence each.
    #[must_use]
    pub fn doubts(document: &Document) -> Vec<String> {
        let read = document.json().get("extensions").and_then(Self::read);
        read.map_or_else(Vec::new, |(_, doubts)| doubts)
    }

    /// The same from a document's `extensions`.
    pub(crate) fn read(extensions: &Value) -> Option<(Self, Vec<String>)> {
        if let Some(look) = extensions.get("VRMC_vrm").and_then(|vrm| vrm.get("lookAt")) {
            let is_expression = look.get("type").and_then(Value::as_str) == Some("expression");
            let keys = ["VRMC_vrm.lookAt.rangeMap", "inputMaxValue", "outputScale"];
            return Some(Self::with_maps(look, is_expression, keys));
        }
        // Version 0.x; its curves are linear in all exported files.
        let look = extensions.get("VRM")?.get("firstPerson")?;
        let is_expression = look.get("lookAtTypeName")?.as_str() == Some("BlendShape");
        Some(Self::with_maps(look, is_expression, ["VRM.firstPerson.lookAt", "xRange", "yRange"]))
    }

    /// Reads the four maps. `path` is where they are, up to the direction in their names.
    fn with_maps(look: &Value, is_expression: bool, [path, input, output]: [&str; 3]) -> (Self, Vec<String>) {
        let (_, prefix) = path.rsplit_once('.').unwrap_or(("", path));
        let mut doubts = Vec::new();
        let mut map = |direction: &str| {
            let map = look.get(format!("{prefix}{direction}"));
            let mut number = |key: &str, default: f64, expected: &str, is_right: fn(f64) -> bool| {
                let Some(value) = map.and_then(|map| map.get(key)) else { return default };
                value.as_f64().filter(|number| number.is_finite() && is_right(*number)).unwrap_or_else(|| {
                    doubts.push(format!("{path}{direction}.{key} is {value}, expected {expected}; {default} is used"));
                    default
                })
            };
            let (whole, expected) = if is_expression { (1.0, "a weight") } else { (90.0, "degrees") };
            RangeMap {
                input_max_value: number(input, 90.0, "degrees above 0", |degrees| degrees > 0.0),
                output_scale: number(output, whole, &format!("{expected} from 0 on"), |output| output >= 0.0),
            }
        };
        let look = Self {
            kind: if is_expression { LookAtKind::Expression } else { LookAtKind::Bone },
            horizontal_inner: map("HorizontalInner"),
            horizontal_outer: map("HorizontalOuter"),
            vertical_down: map("VerticalDown"),
            vertical_up: map("VerticalUp"),
        };
        (look, doubts)
    }

    /// The maps of an eye's headings to the right and to the left, and of its pitches down and up: of an eye that looks by morph
    /// targets to their weights, of the bone of a VRM file's eye to its angles. `None` of what turns as it looks.
    #[must_use]
    pub fn maps(document: &Document, bone: &BoneAxes) -> Option<[RangeMap; 4]> {
        if let Some(eye) = document.skeleton().morph_eyes.iter().find(|eye| eye.node == bone.node) {
            return Some(eye.maps());
        }
        let look = Self::of(document).filter(|look| look.kind == LookAtKind::Bone)?;
        match bone.role? {
            Role::LeftEye => Some(look.left_eye()),
            Role::RightEye => Some(look.right_eye()),
            _ => None,
        }
    }

    /// The maps of the left eye's headings to the right and to the left, and of its pitches down and up; of the right eye the first two
    /// are exchanged.
    #[must_use]
    pub fn left_eye(&self) -> [RangeMap; 4] {
        [self.horizontal_inner, self.horizontal_outer, self.vertical_down, self.vertical_up]
    }

    /// The same of the right eye.
    #[must_use]
    pub fn right_eye(&self) -> [RangeMap; 4] {
        [self.horizontal_outer, self.horizontal_inner, self.vertical_down, self.vertical_up]
    }
}

/// The eyes of a chain that turn by the file's range maps.
#[derive(Debug, Clone)]
pub(crate) struct EyeMaps(Vec<MappedEye>);

#[derive(Debug, Clone)]
struct MappedEye {
    node: usize,
    frame: BoneFrame,
    /// To the right, to the left, down, up.
    maps: [RangeMap; 4],
}

impl EyeMaps {
    /// The mapped eyes among what the chain turns: none unless the file is a VRM file whose bones look.
    pub(crate) fn find(document: &Document, measurement: &Measurement, chain: &ChainNodes) -> Self {
        let eye = |node: usize| {
            let bone = measurement.bone(node).filter(|bone| document.skeleton().is_in_file(bone.node))?;
            Some(MappedEye { node, frame: bone.frame, maps: LookAt::maps(document, bone)? })
        };
        Self(chain.joints.first().copied().into_iter().chain(chain.other_eye).filter_map(eye).collect())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The eyes' local rotations.
    pub(crate) fn rotations(&self, pose: &[Trs]) -> Vec<Quat> {
        self.0.iter().map(|eye| pose[eye.node].rotation).collect()
    }

    /// Replaces the turn of each eye since it had the rotation `before`, which is to where it looks, by what its map makes of it.
    pub(crate) fn apply(&self, before: &[Quat], pose: &mut [Trs]) {
        for (eye, before) in self.0.iter().zip(before) {
            let trs = &mut pose[eye.node];
            let before = before.as_dquat();
            // The rotation acts outside the node's own scale.
            let sign = trs.scale.signum().as_dvec3();
            let [up, forward, left] = [eye.frame.up, eye.frame.forward, eye.frame.left].map(|axis| axis * sign);
            let frame = BoneFrame { up, forward, left };
            let [right, to_left, down, upward] = &eye.maps;
            let mapped = |angle: f64, negative: &RangeMap, positive: &RangeMap| {
                let map = if angle < 0.0 { negative } else { positive };
                map.apply(angle.abs().to_degrees()).to_radians().copysign(angle)
            };
            let [heading, pitch] = frame.angles(before.inverse() * trs.rotation.as_dquat());
            let turned = before * frame.turn([mapped(heading, right, to_left), mapped(pitch, down, upward)]);
            if turned.is_finite() {
                trs.rotation = turned.normalize().as_quat();
            }
        }
    }
}

impl BoneFrame {
    /// Heading and pitch, radians, of the direction to which `turn`, in the bone's space, brings its forward.
    pub(crate) fn angles(&self, turn: DQuat) -> [f64; 2] {
        let gaze = turn * self.forward;
        [gaze.dot(self.left).atan2(gaze.dot(self.forward)), gaze.dot(self.up).clamp(-1.0, 1.0).asin()]
    }

    /// The turn by a pitch and then a heading, radians.
    pub(crate) fn turn(&self, [heading, pitch]: [f64; 2]) -> DQuat {
        let turn = |to: DVec3, angle: f64| DQuat::from_axis_angle(self.forward.cross(to).normalize(), angle);
        turn(self.left, heading) * turn(self.up, pitch)
    }
}
