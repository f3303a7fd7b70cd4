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

#[cfg(test)]
mod tests {
    use super::*;

    const MAPS: [(&str, f64, f64); 4] = [
        ("rangeMapHorizontalInner", 80.0, 8.0),
        ("rangeMapHorizontalOuter", 60.0, 12.0),
        ("rangeMapVerticalDown", 90.0, 5.0),
        ("rangeMapVerticalUp", 90.0, 30.0),
    ];

    fn file(kind: &str, zero: Option<&str>) -> LookAt {
        let mut look = serde_json::json!({ "type": kind });
        for (name, input, output) in MAPS {
            let input = if zero == Some(name) { 0.0 } else { input };
            look[name] = serde_json::json!({ "inputMaxValue": input, "outputScale": output });
        }
        let json =
            serde_json::json!({ "asset": { "version": "2.0" }, "extensions": { "VRMC_vrm": { "lookAt": look } } });
        let document = Document::from_bytes(json.to_string().as_bytes()).expect("a small but right file");
        LookAt::of(&document).expect("it has a lookAt")
    }

    #[test]
    fn each_direction_has_a_map_of_its_own() {
        let look = file("bone", None);
        assert_eq!(look.kind, LookAtKind::Bone);
        assert_eq!(look.left_eye_range(), Some([8.0, 12.0, 5.0, 30.0]));
        for (map, input, expected) in [
            (look.horizontal_outer, 30.0, 6.0),
            (look.horizontal_inner, 30.0, 3.0),
            (look.horizontal_outer, 170.0, 12.0),
            (look.horizontal_inner, 170.0, 8.0),
            (look.vertical_up, 45.0, 15.0),
            (look.vertical_down, 45.0, 2.5),
            (look.vertical_up, 89.0, 30.0 * 89.0 / 90.0),
            (look.vertical_down, 89.0, 5.0 * 89.0 / 90.0),
        ] {
            let found = map.apply(input);
            assert!((found - expected).abs() < 1e-12, "{map:?} at {input}: {found} instead of {expected}");
        }
    }

    #[test]
    fn expressions_have_weights_and_no_range() {
        let look = file("expression", None);
        assert_eq!(look.kind, LookAtKind::Expression);
        assert_eq!(look.left_eye_range(), None);
    }

    #[test]
    fn an_input_of_zero_is_a_step_and_nothing_is_no_number() {
        for (name, _, output) in MAPS {
            let look = file("bone", Some(name));
            let maps = [look.horizontal_inner, look.horizontal_outer, look.vertical_down, look.vertical_up];
            let at = MAPS.iter().position(|map| map.0 == name).expect("one of the four");
            for (input, expected) in [(0.0, 0.0), (-1.0, 0.0), (1e-9, output), (500.0, output), (f64::NAN, 0.0)] {
                assert_eq!(maps[at].apply(input).to_bits(), f64::to_bits(expected), "{name} at {input}");
            }
        }
    }

    #[test]
    fn version_0_says_the_same_in_other_words() {
        let json = r#"{"asset":{"version":"2.0"},"extensions":{"VRM":{"firstPerson":{"lookAtTypeName":"Bone",
            "lookAtHorizontalInner":{"xRange":90,"yRange":10},"lookAtHorizontalOuter":{"xRange":90,"yRange":12},
            "lookAtVerticalDown":{"xRange":90,"yRange":8},"lookAtVerticalUp":{"curve":[]}}}}}"#;
        let document = Document::from_bytes(json.as_bytes()).expect("a small but right file");
        let look = LookAt::of(&document).expect("it has a lookAt");
        assert_eq!(look.left_eye_range(), Some([10.0, 12.0, 8.0, 90.0]));
    }
}
