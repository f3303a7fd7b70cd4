//! Look-at range maps of a VRM file, version 1.0 or 0.x.
//!
//! A range map takes the angle to the target on one side to the angle by which the eye turns there, usually a smaller
//! one: VRM eyes are drawn large.

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
    #[must_use]
    pub fn input(&self, output: f64) -> f64 {
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

/// A number that makes no sense, and what is used instead.
pub(crate) struct Doubt<'a> {
    place: &'a str,
    value: &'a Value,
    expected: &'a str,
    used: f64,
}

impl LookAt {
    /// Reads the file's `lookAt`; `None` if it is no VRM file or has none. A number that is missing, or that makes no sense, is
    /// VRM's default: 90° of input, and 90° (for expressions 1) of output.
    #[must_use]
    pub fn of(document: &Document) -> Option<Self> {
        Self::read(&document.extensions, &mut |_| ())
    }

    /// The numbers of the file's `lookAt` that make no sense and what is used instead, a sentence each.
    #[must_use]
    pub fn doubts(document: &Document) -> Vec<String> {
        let mut doubts = Vec::new();
        Self::read(&document.extensions, &mut |Doubt { place, value, expected, used }| {
            doubts.push(format!("{place} is {value}, expected {expected}; {used} is used"));
        });
        doubts
    }

    /// The same from a document's `extensions`; `doubt` is told the numbers that make no sense.
    pub(crate) fn read(extensions: &Value, doubt: &mut dyn FnMut(Doubt<'_>)) -> Option<Self> {
        if let Some(look) = extensions.get("VRMC_vrm").and_then(|vrm| vrm.get("lookAt")) {
            let is_expression = look.get("type").and_then(Value::as_str) == Some("expression");
            let keys = ["VRMC_vrm.lookAt.rangeMap", "inputMaxValue", "outputScale"];
            return Some(Self::with_maps(look, is_expression, keys, doubt));
        }
        // Version 0.x; its curves are linear in all exported files.
        let look = extensions.get("VRM")?.get("firstPerson")?;
        let is_expression = look.get("lookAtTypeName")?.as_str() == Some("BlendShape");
        Some(Self::with_maps(look, is_expression, ["VRM.firstPerson.lookAt", "xRange", "yRange"], doubt))
    }

    /// Reads the four maps. `path` is where they are, up to the direction in their names.
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
                if is_expression { (1.0, "a weight from 0 on") } else { (90.0, "degrees from 0 on") };
            RangeMap {
                input_max_value: number(input, 90.0, "degrees above 0", |degrees| degrees > 0.0),
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
