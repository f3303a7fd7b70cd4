//! Look-at settings of VRM files: the ranges of their eyes.

use aim_gltf::{Document, LookAt, LookAtKind, RangeMap};

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
    let json = serde_json::json!({ "asset": { "version": "2.0" }, "extensions": { "VRMC_vrm": { "lookAt": look } } });
    let document = Document::from_bytes(json.to_string().as_bytes()).expect("a small but right file");
    LookAt::of(&document).expect("it has a lookAt")
}

#[test]
fn each_direction_has_a_map_of_its_own() {
    let look = file("bone", None);
    assert_eq!(look.kind, LookAtKind::Bone);
    assert_eq!(look.left_eye().map(|map| map.output_scale), [8.0, 12.0, 5.0, 30.0]);
    assert_eq!(look.right_eye().map(|map| map.output_scale), [12.0, 8.0, 5.0, 30.0]);
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
fn look_at_by_expressions_is_recognised() {
    let look = file("expression", None);
    assert_eq!(look.kind, LookAtKind::Expression);
}

#[test]
fn an_input_of_zero_is_a_step_without_nan() {
    let map = RangeMap { input_max_value: 0.0, output_scale: 8.0 };
    for (input, expected) in [(0.0, 0.0), (-1.0, 0.0), (1e-9, 8.0), (500.0, 8.0), (f64::NAN, 0.0)] {
        assert_eq!(map.apply(input).to_bits(), f64::to_bits(expected), "at {input}");
    }
}

#[test]
fn an_input_of_zero_in_a_file_is_replaced() {
    for (name, _, output) in MAPS {
        let look = file("bone", Some(name));
        let maps = [look.horizontal_inner, look.horizontal_outer, look.vertical_down, look.vertical_up];
        let at = MAPS.iter().position(|map| map.0 == name).expect("one of the four");
        assert_eq!(maps[at], RangeMap { input_max_value: 90.0, output_scale: output }, "{name}");
    }
}

#[test]
fn version_0_is_read_like_version_1() {
    let json = r#"{"asset":{"version":"2.0"},"extensions":{"VRM":{"firstPerson":{"lookAtTypeName":"Bone",
        "lookAtHorizontalInner":{"xRange":90,"yRange":10},"lookAtHorizontalOuter":{"xRange":90,"yRange":12},
        "lookAtVerticalDown":{"xRange":90,"yRange":8},"lookAtVerticalUp":{"curve":[]}}}}}"#;
    let document = Document::from_bytes(json.as_bytes()).expect("a small but right file");
    let look = LookAt::of(&document).expect("it has a lookAt");
    assert_eq!(look.left_eye().map(|map| map.output_scale), [10.0, 12.0, 8.0, 90.0]);
}
