//! Look-at range maps of a VRM file, version 1.0 or 0.x.
//!
//! A range map takes the angle to the target on one side to the angle by which the eye turns there, usually a smaller
//! one: VRM eyes are drawn large. Aiming is exact and takes only the eyes' ranges of motion from the maps.

use serde_json::Value;

use crate::document::Document;

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

    /// The left eye's range of motion, degrees: to the right, to the left, down, up. `None` for expressions, whose
    /// outputs are weights.
    #[must_use]
    pub fn left_eye_range(&self) -> Option<[f64; 4]> {
        let maps = [self.horizontal_inner, self.horizontal_outer, self.vertical_down, self.vertical_up];
        (self.kind == LookAtKind::Bone).then(|| maps.map(|map| map.output_scale))
    }
}
