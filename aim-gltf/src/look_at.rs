//! [`LookAt`]: the look-at range maps of a VRM file, version 1.0 or 0.x.
//!
//! A range map converts the angle to the target on one side into the angle by which the eye turns there. That is
//! usually smaller, because VRM eyes are drawn large.

use serde_json::Value;

use crate::document::Document;

/// Part of a VRM character that gaze moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LookAtKind {
    /// Bones `leftEye` and `rightEye`.
    Bone,
    /// Expressions `lookLeft`, `lookRight`, `lookUp` and `lookDown`.
    Expression,
}

/// Linear map from the target's angle in one direction to the output for the eye, clamped at the largest input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RangeMap {
    /// Input at which the output reaches its maximum, degrees. If it is not above 0, every positive input gives the
    /// maximum.
    pub input_max_value: f64,
    /// Largest output: degrees for bones, a weight for expressions.
    pub output_scale: f64,
}

impl RangeMap {
    /// Returns `true` if the map has any effect: its output is not always 0.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.output_scale > 0.0
    }

    /// Returns the output for `input` degrees; an input below 0 or NaN is treated as 0.
    #[must_use]
    pub fn apply(&self, input: f64) -> f64 {
        // This comparison is also false for NaN.
        if input > 0.0 {
            let share = if self.input_max_value > 0.0 { (input / self.input_max_value).min(1.0) } else { 1.0 };
            share * self.output_scale
        } else {
            0.0
        }
    }

    /// Returns the smallest input, degrees, that gives `output`; 0 if the map moves nothing.
    #[must_use]
    pub fn input(&self, output: f64) -> f64 {
        let share = output / self.output_scale;
        if self.moves() { share.clamp(0.0, 1.0) * self.input_max_value.max(0.0) } else { 0.0 }
    }
}

/// The `lookAt` of a VRM file: one range map for each direction of gaze.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct LookAt {
    /// The part that gaze moves.
    pub kind: LookAtKind,
    /// Map for looking towards the nose.
    pub horizontal_inner: RangeMap,
    /// Map for looking away from the nose; for expressions, to either side.
    pub horizontal_outer: RangeMap,
    /// Map for looking down.
    pub vertical_down: RangeMap,
    /// Map for looking up.
    pub vertical_up: RangeMap,
}

/// An invalid number and the value used instead.
pub(crate) struct Doubt<'a> {
    place: &'a str,
    value: &'a Value,
    expected: &'a str,
    used: f64,
}

impl LookAt {
    /// Reads the file's `lookAt`; `None` if the document is not a VRM file or has none. Missing or invalid numbers are
    /// replaced by VRM's defaults: 90° of input, and 90° (for expressions, weight 1) of output.
    #[must_use]
    pub fn of(document: &Document) -> Option<Self> {
        Self::read(&document.extensions, &mut |_| ())
    }

    /// Returns a sentence for each invalid number in the file's `lookAt`, with the value used instead.
    #[must_use]
    pub fn doubts(document: &Document) -> Vec<String> {
        let mut doubts = Vec::new();
        Self::read(&document.extensions, &mut |Doubt { place, value, expected, used }| {
            doubts.push(format!("{place} is {value}, expected {expected}; using {used}"));
        });
        doubts
    }

    /// Reads the `lookAt` from a document's `extensions`; calls `doubt` for each invalid number.
    pub(crate) fn read(extensions: &Value, doubt: &mut dyn FnMut(Doubt<'_>)) -> Option<Self> {
        if let Some(look) = extensions.get("VRMC_vrm").and_then(|vrm| vrm.get("lookAt")) {
            let is_expression = look.get("type").and_then(Value::as_str) == Some("expression");
            let keys = ["VRMC_vrm.lookAt.rangeMap", "inputMaxValue", "outputScale"];
            return Some(Self::with_maps(look, is_expression, keys, doubt));
        }
        // Version 0.x. Its curves are linear in all exported files.
        let look = extensions.get("VRM")?.get("firstPerson")?;
        let is_expression = look.get("lookAtTypeName")?.as_str() == Some("BlendShape");
        Some(Self::with_maps(look, is_expression, ["VRM.firstPerson.lookAt", "xRange", "yRange"], doubt))
    }

    /// Reads the four maps. `path` is their common path, up to the direction at the end of their names.
    fn with_maps(
        look: &Value,
        is_expression: bool,
        [path, input, output]: [&str; 3],
        doubt: &mut dyn FnMut(Doubt<'_>),
    ) -> Self {
        let (_, prefix) = path.rsplit_once('.').unwrap_or(("", path));
        let mut map = |direction: &str| {
            let map = look.get(format!("{prefix}{direction}"));
            let mut number = |key: &str, used: f64, expected: &str, is_right: fn(f64) -> bool| {
                let Some(value) = map.and_then(|map| map.get(key)) else { return used };
                value.as_f64().filter(|number| number.is_finite() && is_right(*number)).unwrap_or_else(|| {
                    doubt(Doubt { place: &format!("{path}{direction}.{key}"), value, expected, used });
                    used
                })
            };
            let (whole, expected) =
                if is_expression { (1.0, "a weight of at least 0") } else { (90.0, "at least 0 degrees") };
            RangeMap {
                input_max_value: number(input, 90.0, "more than 0 degrees", |degrees| degrees > 0.0),
                output_scale: number(output, whole, expected, |output| output >= 0.0),
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

    /// Maps for the left eye: headings to the right and to the left, pitches down and up. The right eye has the first
    /// two exchanged.
    #[must_use]
    pub fn left_eye(&self) -> [RangeMap; 4] {
        [self.horizontal_inner, self.horizontal_outer, self.vertical_down, self.vertical_up]
    }

    /// Maps for the right eye: headings to the right and to the left, pitches down and up.
    #[must_use]
    pub fn right_eye(&self) -> [RangeMap; 4] {
        [self.horizontal_outer, self.horizontal_inner, self.vertical_down, self.vertical_up]
    }
}
