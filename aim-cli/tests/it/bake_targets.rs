//! Positions of the four kinds of targets, recomputed by the tests.

use crate::common::Place;
use crate::common::forward::{Bake, list, number, vector};
use crate::common::gltf::Model;
use crate::common::rig::joints;
use crate::common::{bundled_rig, changed};
use aim_runtime::glam::{DQuat, DVec3};
use serde_json::{Value, json};

#[track_caller]
fn bake(place: &Place, options: &str) -> Value {
    place.done(&format!("bake m.glb --rig m.toml --out out.glb --report r.json {options}"));
    let rig = String::from_utf8(place.read("m.toml")).expect("text");
    let (source, output, report) = (place.read("m.glb"), place.read("out.glb"), place.json("r.json"));
    Bake { source: &source, output: &output, report: &report, joints: Some(&joints(&rig)) }.check();
    report
}

#[track_caller]
fn targets_are(report: &Value, expected: impl Fn(f64) -> DVec3) {
    for frame in list(&report["frames"]) {
        let (t, found) = (number(&frame["t"]), vector(&frame["target"]));
        assert!((found - expected(t)).length() < 1e-5, "t {t}: {found} instead of {}", expected(t));
    }
}

#[test]
fn a_point() {
    targets_are(&bake(&Place::with_mannequin(), "--target -0.5,1.25,3e0"), |_| DVec3::new(-0.5, 1.25, 3.0));
    targets_are(&bake(&Place::with_mannequin(), "--target=0,1,2"), |_| DVec3::new(0.0, 1.0, 2.0));
}

#[test]
fn an_orbit_goes_from_the_front_to_the_left_in_metres_of_the_characters_size() {
    let place = Place::with_mannequin();
    let model = Model::new(&place.read("m.glb"));
    let primitives = list(&model.json["meshes"]).iter().flat_map(|mesh| list(&mesh["primitives"]));
    let heights: Vec<f64> = primitives
        .flat_map(|part| {
            model.accessor(usize::try_from(part["attributes"]["POSITION"].as_u64().expect("one")).expect("small"))
        })
        .skip(1)
        .step_by(3)
        .collect();
    let height = heights.iter().copied().fold(f64::MIN, f64::max) - heights.iter().copied().fold(f64::MAX, f64::min);
    let (metre, eye) = (height / 1.7, DVec3::new(0.03, 1.66, 0.09));
    assert!((0.9..1.1).contains(&metre), "the mannequin is {height} m high");
    // The mannequin faces +Z; its left is +X.
    let report = bake(&place, "--target orbit:2,0.25,8 --seconds 8");
    targets_are(&report, |t| {
        let (sin, cos) = (std::f64::consts::TAU * t / 8.0).sin_cos();
        eye + metre * DVec3::new(2.0 * sin, 0.25, 2.0 * cos)
    });
    // In the other direction.
    let report = bake(&place, "--target orbit:1,0,-4");
    targets_are(&report, |t| {
        let (sin, cos) = (std::f64::consts::TAU * t / 4.0).sin_cos();
        eye + metre * DVec3::new(-sin, 0.0, cos)
    });
}

#[test]
fn a_node_where_the_animation_puts_it() {
    let place = Place::with_mannequin();
    let model = Model::new(&place.read("m.glb"));
    let (clip, foot) = (model.clip(0), model.node("left_foot"));
    let report = bake(&place, "--target node:left_foot");
    targets_are(&report, |t| model.world(&model.pose(&clip, t), foot).transform_point3(DVec3::ZERO));
}

#[test]
fn a_node_that_aiming_moves_where_it_is_then() {
    let place = Place::with_mannequin();
    let m = place.read("m.glb");
    for (hand, solver) in
        [("left_hand", "natural"), ("right_hand", "natural"), ("left_hand", "exact"), ("right_hand", "ascent")]
    {
        // Hold the arm out to the side and slightly forward, so that a large turn of the chest carries the hand away.
        let (mut json, bin) = crate::common::gltf::take_apart(&m);
        let arm = json["nodes"]
            .as_array()
            .expect("nodes")
            .iter()
            .position(|node| node["name"] == hand.replace("hand", "upper_arm"));
        let side = if hand == "left_hand" { 1.0 } else { -1.0 };
        let channels = json["animations"][0]["channels"].as_array_mut().expect("channels");
        channels.retain(|channel| channel["target"]["node"].as_u64() != arm.map(|arm| arm as u64));
        let out = DQuat::from_rotation_x(-side * 0.6) * DQuat::from_rotation_y(side * 1.4);
        json["nodes"][arm.expect("an arm")]["rotation"] = serde_json::json!(out.to_array());
        place.write("m.glb", &crate::common::gltf::put_together(&json, &bin));
        let ran = place.done(&format!(
            "bake m.glb --rig m.toml --target node:{hand} --solver {solver} --out out.glb --report r.json"
        ));
        assert_eq!(ran.stderr, "", "nothing to warn of");
        let (report, model) = (place.json("r.json"), Model::new(&place.read("out.glb")));
        let name = report["clip"].as_str().expect("a name");
        let (clip, node) = (model.clip(model.clip_index(name).expect("the clip")), model.node(hand));
        let mut reached = 0;
        for frame in list(&report["frames"]) {
            let world = model.pose(&clip, number(&frame["t"]));
            let [hand, eye, ahead] =
                [(node, DVec3::ZERO), (model.node("left_eye"), DVec3::ZERO), (model.node("left_eye"), DVec3::Y)]
                    .map(|(node, point)| model.world(&world, node).transform_point3(point));
            let off = (hand - eye).angle_between(ahead - eye).to_degrees();
            if frame["status"] == "reached" {
                reached += 1;
                assert!(off < 0.12, "{hand} {solver}, t {}: {off}° off", frame["t"]);
            }
        }
        assert!(reached > 60, "{hand}, {solver}: only {reached} of 73");
    }
}

#[test]
fn a_node_of_the_chain_itself_is_answered_truthfully() {
    // Nodes that hang on the chain, and nodes that it hangs on, have a direction.
    for node in ["right_eye", "head", "neck", "spine3", "hips"] {
        bake(&Place::with_mannequin(), &format!("--target node:{node}"));
    }
}

#[test]
fn a_node_at_the_place_of_the_effector_is_refused() {
    let place = Place::new();
    // A child of the eye at the eye, and one beside it.
    place.write(
        "m.glb",
        &changed(|json| {
            let nodes = json["nodes"].as_array_mut().expect("nodes");
            let count = nodes.len();
            let eye = nodes.iter_mut().find(|node| node["name"] == "left_eye").expect("an eye");
            eye["children"] = json!([count, count + 1]);
            nodes.push(json!({ "name": "eye_end" }));
            nodes.push(json!({ "name": "iris", "translation": [0.0, 0.01, 0.0] }));
        }),
    );
    place.write("m.toml", &std::fs::read(bundled_rig("mannequin")).expect("the rig is there"));
    let bake = "bake m.glb --rig m.toml --out out.glb --target";
    for solver in ["natural", "exact", "ascent"] {
        for (target, problem) in [
            ("node:left_eye", "left_eye itself is aimed"),
            ("node:neck --effector neck", "neck itself is aimed"),
            ("node:right_eye --both-eyes", "right_eye itself is aimed"),
            ("node:eye_end", "eye_end is at the place of left_eye, which is aimed, in every frame"),
        ] {
            let node = target.split(' ').next().expect("a word");
            place
                .refused(&format!("{bake} {target} --solver {solver}"), &["--target", node, problem, "such as a hand"]);
        }
    }
    // What moves with the gaze is only warned of, but is no success.
    for node in ["iris", "head"] {
        let bake = format!("{bake} node:{node}");
        assert!(place.done(&bake).stderr.contains("moves with the gaze;"), "{node}");
    }
    let ran = place.aim(&format!("{bake} node:head --strict"));
    let words = "out.glb: written, but no frame is on target: head moves with the gaze";
    assert!(ran.code == 1 && ran.stderr.contains(words), "{ran:?}");
}

#[test]
fn a_path_is_linear_between_rows_and_stands_still_outside() {
    let place = Place::with_mannequin();
    place.write("path.csv", "t,x,y,z\n0.25,0,1.6,2\n0.5, 0.5 ,1.6,2\n1.0,0.5,1.1,1.5\n");
    let report = bake(&place, "--target file:path.csv");
    targets_are(&report, |t| match t {
        t if t <= 0.25 => DVec3::new(0.0, 1.6, 2.0),
        t if t <= 0.5 => DVec3::new((t - 0.25) * 2.0, 1.6, 2.0),
        t if t <= 1.0 => DVec3::new(0.5, 1.6 - (t - 0.5), 2.0 - (t - 0.5)),
        _ => DVec3::new(0.5, 1.1, 1.5),
    });
}

#[test]
fn paths_as_spreadsheets_write_them() {
    let place = Place::with_mannequin();
    for text in [
        "\u{feff}t,x,y,z\r\n0,0,1.6,2\r\n1,1,1.6,2\r\n",
        "t, x, y, z\n0,0,1.6,2\n1,1,1.6,2",
        "t,x,y,z\n\n0,0,1.6,2\n\n1,1,1.6,2\n\n",
    ] {
        place.write("path.csv", text);
        targets_are(&bake(&place, "--target file:path.csv --seconds 1"), |t| DVec3::new(t, 1.6, 2.0));
    }
}

#[test]
fn targets_without_a_direction_or_beyond_all_sense() {
    let place = Place::with_mannequin();
    for target in ["0.03,1.66,0.09", "0,1.66,-5", "0,1e30,0", "1e-30,1.6,1e-30", "0,0,0", "0,200,0", "3e38,3e38,3e38"] {
        bake(&place, &format!("--target {target}"));
        bake(&place, &format!("--target {target} --settle animation"));
    }
}
