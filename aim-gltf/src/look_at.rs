//! How a VRM character moves its eyes: the range maps of VRM 1.0 (and 0.x), from the file, as the specification has them.
//!
//! A range map turns how far the target is to a side into how far the eyes go there, which is usually less: it is for
//! characters whose eyes are drawn large. Aiming itself is exact; of the maps it takes the ranges of the eyes.

use serde_json::Value;

use crate::document::Document;

/// What moves when a VRM character looks somewhere.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LookAtKind {
    /// The bones `leftEye` and `rightEye`.
    Bone,
    /// The expressions `lookLeft`, `lookRight`, `lookUp` and `lookDown`.
    Expression,
}

/// From how far away the target is in one direction to how far the eye goes there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RangeMap {
    /// The input, degrees, from which on the output is largest. At 0 (or below, or not a number) any input above 0 is.
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

/// An eye's turn, degrees: heading positive to the character's left, pitch positive up.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the type says it all")]
pub struct EyeAngles {
    pub heading_deg: f64,
    pub pitch_deg: f64,
}

/// The weights of the four expressions; at most one of left and right, and one of up and down, is above 0.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the names are those of the expressions")]
pub struct LookWeights {
    pub left: f64,
    pub right: f64,
    pub up: f64,
    pub down: f64,
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
    /// What the file says; `None` where it is no VRM file or says nothing. Maps that are left out go as far as their
    /// input, up to 90°, as VRM's own do.
    #[must_use]
    pub fn of(document: &Document) -> Option<Self> {
        let extension = |name: &str| document.json().get("extensions")?.get(name);
        let number = |value: Option<&Value>, key: &str| {
            value.and_then(|map| map.get(key)).and_then(Value::as_f64).filter(|x| x.is_finite())
        };
        if let Some(look) = extension("VRMC_vrm").and_then(|vrm| vrm.get("lookAt")) {
            let kind = kind(look.get("type"), "expression");
            let map = |name: &str| {
                let map = look.get(format!("rangeMap{name}"));
                range_map(kind, number(map, "inputMaxValue"), number(map, "outputScale"))
            };
            return Some(Self {
                kind,
                horizontal_inner: map("HorizontalInner"),
                horizontal_outer: map("HorizontalOuter"),
                vertical_down: map("VerticalDown"),
                vertical_up: map("VerticalUp"),
            });
        }
        // VRM 0.x; its curves are linear in all but name.
        let look = extension("VRM")?.get("firstPerson").filter(|look| look.get("lookAtTypeName").is_some())?;
        let kind = kind(look.get("lookAtTypeName"), "BlendShape");
        let map = |name: &str| {
            let map = look.get(format!("lookAt{name}"));
            range_map(kind, number(map, "xRange"), number(map, "yRange"))
        };
        Some(Self {
            kind,
            horizontal_inner: map("HorizontalInner"),
            horizontal_outer: map("HorizontalOuter"),
            vertical_down: map("VerticalDown"),
            vertical_up: map("VerticalUp"),
        })
    }

    /// The left and the right eye's turns for a target at `heading_deg` (positive to the character's left) and
    /// `pitch_deg` (positive up) from the head's forward, for [`LookAtKind::Bone`].
    #[must_use]
    pub fn bones(&self, heading_deg: f64, pitch_deg: f64) -> [EyeAngles; 2] {
        let pitch_deg = self.vertical(pitch_deg);
        let heading = |to_left: RangeMap, to_right: RangeMap| EyeAngles {
            heading_deg: to_left.apply(heading_deg) - to_right.apply(-heading_deg),
            pitch_deg,
        };
        // To its own side an eye looks away from the nose.
        [heading(self.horizontal_outer, self.horizontal_inner), heading(self.horizontal_inner, self.horizontal_outer)]
    }

    /// The expressions' weights for the same, for [`LookAtKind::Expression`].
    #[must_use]
    pub fn expressions(&self, heading_deg: f64, pitch_deg: f64) -> LookWeights {
        LookWeights {
            left: self.horizontal_outer.apply(heading_deg),
            right: self.horizontal_outer.apply(-heading_deg),
            up: self.vertical_up.apply(pitch_deg),
            down: self.vertical_down.apply(-pitch_deg),
        }
    }

    fn vertical(&self, pitch_deg: f64) -> f64 {
        self.vertical_up.apply(pitch_deg) - self.vertical_down.apply(-pitch_deg)
    }

    /// How far the left eye goes at most, degrees: to the right, to the left, down, up. `None` for expressions, whose
    /// outputs are no angles.
    #[must_use]
    pub fn left_eye_range(&self) -> Option<[f64; 4]> {
        let maps = [self.horizontal_inner, self.horizontal_outer, self.vertical_down, self.vertical_up];
        (self.kind == LookAtKind::Bone).then(|| maps.map(|map| map.output_scale))
    }
}

fn kind(value: Option<&Value>, expression: &str) -> LookAtKind {
    match value.and_then(Value::as_str) {
        Some(name) if name == expression => LookAtKind::Expression,
        _ => LookAtKind::Bone,
    }
}

fn range_map(kind: LookAtKind, input_max_value: Option<f64>, output_scale: Option<f64>) -> RangeMap {
    let whole = if kind == LookAtKind::Bone { 90.0 } else { 1.0 };
    RangeMap { input_max_value: input_max_value.unwrap_or(90.0), output_scale: output_scale.unwrap_or(whole).max(0.0) }
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
    fn every_sign_goes_through_its_own_map_for_either_eye() {
        let look = file("bone", None);
        assert_eq!(look.kind, LookAtKind::Bone);
        // Input heading and pitch; expected: left eye's and right eye's heading, pitch of both.
        for (heading, pitch, left, right, up) in [
            (30.0, 0.0, 6.0, 3.0, 0.0),
            (-30.0, 0.0, -3.0, -6.0, 0.0),
            (0.0, 45.0, 0.0, 0.0, 15.0),
            (0.0, -45.0, 0.0, 0.0, -2.5),
            (170.0, 89.0, 12.0, 8.0, 30.0 * 89.0 / 90.0),
            (-170.0, -89.0, -8.0, -12.0, -5.0 * 89.0 / 90.0),
            (0.0, 0.0, 0.0, 0.0, 0.0),
        ] {
            let [l, r] = look.bones(heading, pitch);
            for (found, expected) in
                [(l.heading_deg, left), (r.heading_deg, right), (l.pitch_deg, up), (r.pitch_deg, up)]
            {
                assert!((found - expected).abs() < 1e-12, "{heading} {pitch}: {found} instead of {expected}");
            }
        }
        assert_eq!(look.left_eye_range(), Some([8.0, 12.0, 5.0, 30.0]));
    }

    #[test]
    fn expressions_take_the_outer_map_both_ways() {
        let look = file("expression", None);
        let weights = |heading, pitch| {
            let LookWeights { left, right, up, down } = look.expressions(heading, pitch);
            [left, right, up, down]
        };
        assert_eq!(weights(30.0, 45.0), [6.0, 0.0, 15.0, 0.0]);
        assert_eq!(weights(-30.0, -45.0), [0.0, 6.0, 0.0, 2.5]);
        assert_eq!(weights(0.0, 0.0), [0.0; 4]);
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
            for (heading, pitch) in [(0.0, 0.0), (10.0, -10.0), (-10.0, 10.0), (f64::INFINITY, f64::NAN)] {
                let eyes = look.bones(heading, pitch);
                assert!(eyes.iter().all(|eye| eye.heading_deg.is_finite() && eye.pitch_deg.is_finite()), "{name}");
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
