//! Shape of the JSON output that other programs rely on: exactly these keys and types, angles in degrees.

use crate::common::Place;
use crate::common::forward::{list, number, vector};
use serde_json::{Value, json};

/// Returns the keys of an object, in their order.
fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap_or_else(|| panic!("{value} is no object")).keys().map(String::as_str).collect()
}

#[track_caller]
fn has_keys(value: &Value, expected: &str) {
    let (mut found, mut expected) = (keys(value), expected.split(' ').collect::<Vec<_>>());
    found.sort_unstable();
    expected.sort_unstable();
    assert_eq!(found, expected);
}

fn is_unit(v: &Value) -> bool {
    list(v).len() == 3 && (vector(v).length() - 1.0).abs() < 1e-6
}

fn json_of(place: &Place, arguments: &str) -> Value {
    serde_json::from_str(&place.done(arguments).stdout).expect("standard output is JSON")
}

#[test]
fn inspect() {
    let place = Place::with_mannequin();
    let found = json_of(&place, "inspect m.glb --json");
    has_keys(&found, "file up forward confidence evidence height bones clips");
    assert!((0.8..1.0).contains(&number(&found["confidence"])), "{}", found["confidence"]);
    assert!((1.7..1.8).contains(&number(&found["height"])), "{}", found["height"]);
    for said in list(&found["evidence"]) {
        has_keys(said, "clue up forward agrees weight");
        assert!(said["agrees"] == true && number(&said["weight"]) > 0.0, "{said}");
        assert!(said["up"].is_array() != said["forward"].is_array(), "it speaks of one of them: {said}");
    }
    assert_eq!((&found["file"], &found["up"]), (&json!("m.glb"), &json!([0.0, 1.0, 0.0])));
    assert!(is_unit(&found["forward"]) && found["forward"][2] == json!(1.0), "{}", found["forward"]);
    let bones = list(&found["bones"]);
    assert!(bones.len() >= 25, "{} bones", bones.len());
    for bone in bones {
        has_keys(bone, "name parent role up forward left deviation_deg handedness");
        for key in ["up", "forward", "left"] {
            let axis = bone[key].as_str().expect("a signed axis");
            assert!(["+X", "-X", "+Y", "-Y", "+Z", "-Z"].contains(&axis), "{bone}");
        }
        assert!(bone["name"].is_string() && (bone["parent"].is_string() || bone["parent"].is_null()), "{bone}");
        assert!(bone["role"].is_string() || bone["role"].is_null(), "{bone}");
        assert!((0.0..90.0).contains(&number(&bone["deviation_deg"])), "{bone}");
        assert!(bone["handedness"] == "right" || bone["handedness"] == "left", "{bone}");
    }
    let bone = |name: &str| bones.iter().find(|bone| bone["name"] == name).expect("the bone is there");
    let axes = json!({ "up": "+X", "forward": "+Y", "left": "+Z", "deviation_deg": 0.0, "handedness": "right" });
    for (name, parent, role) in
        [("left_eye", "head", "left_eye"), ("right_eye", "head", "right_eye"), ("neck", "spine3", "neck")]
    {
        let mut expected = axes.clone();
        (expected["name"], expected["parent"], expected["role"]) = (json!(name), json!(parent), json!(role));
        assert_eq!(bone(name), &expected);
    }
    assert_eq!((&bone("hips")["parent"], &bone("head")["role"]), (&Value::Null, &json!("head")));
    assert_eq!(list(&found["clips"]).len(), 1);
    has_keys(&found["clips"][0], "name seconds");
    assert_eq!(found["clips"][0]["name"], "walk");
    assert!((number(&found["clips"][0]["seconds"]) - 1.2).abs() < 1e-6, "{}", found["clips"][0]);
}

#[test]
fn inspect_tells_mirrored_bones() {
    let place = Place::new();
    let [u, f, l] = aim_character::PAPER_AXES;
    let mirrored = [u, f, l.map(|c| -c)];
    let model = aim_character::mannequin(|bone| if bone == "neck" { mirrored } else { aim_character::PAPER_AXES });
    place.write("m.glb", &model.expect("orthonormal axes"));
    let found = json_of(&place, "inspect m.glb --json");
    for bone in list(&found["bones"]) {
        let expected = if bone["name"] == "neck" { ("-Z", "left") } else { ("+Z", "right") };
        if bone["handedness"] != expected.1 {
            assert!(!["head", "neck", "left_eye"].contains(&bone["name"].as_str().unwrap_or("")), "{bone}");
        }
    }
}

#[test]
fn count() {
    let place = Place::new();
    for rig in crate::common::bundled_rigs() {
        let ran = place.run(["count".as_ref(), rig.as_os_str(), "--json".as_ref()]);
        assert_eq!((ran.code, ran.stderr.as_str()), (0, ""));
        let found: Value = serde_json::from_str(&ran.stdout).expect("JSON");
        let programs = "aim aim_pitch aim_heading aim_gradient chain_value_gradient chain_residual_jacobian";
        has_keys(&found, &format!("rig {programs}"));
        for program in programs.split(' ') {
            let counts = &found[program];
            has_keys(counts, "add mul div sqrt pow select total");
            let of = |key: &str| counts[key].as_u64().unwrap_or_else(|| panic!("{counts}"));
            let total = ["add", "mul", "div", "sqrt", "pow"].map(of).into_iter().sum::<u64>();
            assert_eq!(of("total"), total, "{program} of {}: {counts}", rig.display());
            // At most three guards, each of them a comparison and a select.
            assert!(of("select") <= 6 && of("pow") == 0, "{program} of {}: {counts}", rig.display());
        }
    }
    let thug = json_of(&place, &format!("count {} --json", crate::common::bundled_rig("thug").display()));
    let (joint, chain) = (&thug["aim_gradient"], &thug["chain_value_gradient"]);
    assert_eq!((&thug["rig"], &joint["total"], &chain["total"]), (&json!("Thug"), &json!(46), &json!(63 * 3 - 16)));
    // The README's table has the same numbers.
    assert_eq!((&joint["sqrt"], &joint["div"]), (&json!(1), &json!(1)));
}

#[test]
fn bake_report() {
    let place = Place::with_mannequin();
    place.done("bake m.glb --rig m.toml --target orbit:2,0,4 --seconds 4 --fps 30 --out o.glb --report r.json");
    let report = place.json("r.json");
    has_keys(&report, "rig solver clip fps effector frames summary plausibility");
    assert_eq!(
        (&report["rig"], &report["solver"], &report["clip"]),
        (&json!("Mannequin"), &json!("natural"), &json!("walk_aimed"))
    );
    assert_eq!(number(&report["fps"]), 30.0);
    has_keys(&report["effector"], "bone forward origin");
    assert_eq!(
        report["effector"],
        json!({ "bone": "left_eye", "forward": [0.0, 1.0, 0.0], "origin": [0.0, 0.0, 0.0] })
    );
    has_keys(
        &report["summary"],
        "frames reached max_error_deg_reached max_rate_violation_deg_s max_limit_violation_deg max_roll_deg",
    );
    for key in ["frames", "reached"] {
        assert!(report["summary"][key].is_u64(), "{}", report["summary"]);
    }
    has_keys(
        &report["plausibility"],
        "head_to_chest_heading_deg head_roll_deg elevation_error_deg heading_error_deg limb_shift head_speed_deg_s head_acceleration_deg_s2 \
         reversals",
    );
    let found = &report["plausibility"];
    assert!(found["reversals"].is_u64() && number(&found["head_to_chest_heading_deg"]) > 30.0, "{found}");
    let mut words: Vec<&str> = Vec::new();
    for frame in list(&report["frames"]) {
        has_keys(frame, "t target error_deg roll_deg status joints followers");
        assert!(frame["t"].is_number() && list(&frame["target"]).len() == 3, "{frame}");
        assert!((0.0..=180.0).contains(&number(&frame["error_deg"])), "{frame}");
        words.push(frame["status"].as_str().expect("a word"));
        for (joint, bone) in list(&frame["joints"]).iter().zip(["left_eye", "neck", "spine3"]) {
            has_keys(joint, "bone heading_deg pitch_deg at_limit recovering");
            assert_eq!(joint["bone"], bone);
            assert!(joint["at_limit"].is_boolean() && joint["recovering"] == false, "{joint}");
        }
        assert_eq!((list(&frame["joints"]).len(), &frame["followers"]), (3, &json!([{ "bone": "right_eye" }])));
    }
    words.sort_unstable();
    words.dedup();
    assert_eq!(words, ["at_limit", "behind", "rate_limited", "reached"], "the words of a whole orbit");
    // Degrees, not radians: the neck reaches its limit at 60.
    let headings = list(&report["frames"]).iter().map(|frame| number(&frame["joints"][1]["heading_deg"]).abs());
    assert!((headings.fold(0.0, f64::max) - 60.0).abs() < 1e-3, "the neck's end");
    place.done("bake m.glb --rig m.toml --target 0.03,1.66,0.09 --settle animation --out o.glb --report r.json");
    assert!(
        list(&place.json("r.json")["frames"])
            .iter()
            .all(|frame| frame["status"] != "reached" || number(&frame["error_deg"]) <= 0.1),
        "a target at the eye"
    );
}
