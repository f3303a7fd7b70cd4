//! Look-at range maps of a VRM file, version 1.0 or 0.x, and the eyes that turn by them.
//!
//! A range map takes the angle to the target on one side to the angle by which the eye turns there, usually a smaller
//! one: VRM eyes are drawn large. So aiming solves for the angle to the target, and [`EyeMaps`] turns the bones.

use glam::{DQuat, DVec3, Quat};
use serde_json::Value;

use crate::chain::ChainNodes;
use crate::document::Document;
use crate::measure::{BoneFrame, Measurement};
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
    /// Reads the file's `lookAt`; `None` if it is no VRM file or has none. A number that is missing is VRM's default:
    /// 90° of input, and 90° (for expressions 1) of output.
    #[must_use]
    pub fn of(document: &Document) -> Option<Self> {
        let extension = |name: &str| document.json().get("extensions")?.get(name);
        if let Some(look) = extension("VRMC_vrm").and_then(|vrm| vrm.get("lookAt")) {
            return Some(Self::read(
                look,
                look.get("type"),
                "expression",
                "rangeMap",
                ["inputMaxValue", "outputScale"],
            ));
        }
        // Version 0.x; its curves are linear in all exported files.
        let look = extension("VRM")?.get("firstPerson")?;
        Some(Self::read(look, Some(look.get("lookAtTypeName")?), "BlendShape", "lookAt", ["xRange", "yRange"]))
    }

    /// Reads the four maps, whose keys begin with `prefix`; `expression` is the word for [`LookAtKind::Expression`].
    fn read(look: &Value, kind: Option<&Value>, expression: &str, prefix: &str, [input, output]: [&str; 2]) -> Self {
        let is_expression = kind.and_then(Value::as_str) == Some(expression);
        let map = |direction: &str| {
            let map = look.get(format!("{prefix}{direction}"));
            let number = |key: &str| map.and_then(|map| map.get(key)?.as_f64()).filter(|x| x.is_finite());
            let whole = if is_expression { 1.0 } else { 90.0 };
            RangeMap {
                input_max_value: number(input).unwrap_or(90.0),
                output_scale: number(output).unwrap_or(whole).max(0.0),
            }
        };
        Self {
            kind: if is_expression { LookAtKind::Expression } else { LookAtKind::Bone },
            horizontal_inner: map("HorizontalInner"),
            horizontal_outer: map("HorizontalOuter"),
            vertical_down: map("VerticalDown"),
            vertical_up: map("VerticalUp"),
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
        let Some(look) = LookAt::of(document).filter(|look| look.kind == LookAtKind::Bone) else {
            return Self(Vec::new());
        };
        let eye = |node: usize| {
            let bone = measurement.bone(node)?;
            let maps = match bone.role? {
                Role::LeftEye => look.left_eye(),
                Role::RightEye => look.right_eye(),
                _ => return None,
            };
            Some(MappedEye { node, frame: bone.frame, maps })
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
            let gaze = before.inverse() * trs.rotation.as_dquat() * forward;
            let heading = gaze.dot(left).atan2(gaze.dot(forward));
            let pitch = gaze.dot(up).clamp(-1.0, 1.0).asin();
            let [right, to_left, down, upward] = &eye.maps;
            let mapped = |angle: f64, negative: &RangeMap, positive: &RangeMap| {
                let map = if angle < 0.0 { negative } else { positive };
                map.apply(angle.abs().to_degrees()).to_radians().copysign(angle)
            };
            let turn = |to: DVec3, angle: f64| DQuat::from_axis_angle(forward.cross(to).normalize(), angle);
            let turned = before * turn(left, mapped(heading, right, to_left)) * turn(up, mapped(pitch, down, upward));
            if turned.is_finite() {
                trs.rotation = turned.normalize().as_quat();
            }
        }
    }
}
