//! `aim reach`, checked with the tests' own forward kinematics.

use std::path::Path;

use crate::common::Place;
use crate::common::forward::{list, number, vector};
use crate::common::gltf::Model;
use aim_runtime::glam::{DMat3, DMat4, DVec3};
use serde_json::Value;

/// Asserts that the file agrees with every claim of the report, and that nothing but the limb has changed.
#[track_caller]
fn check(source: &[u8], output: &[u8], report: &Value) {
    let (source, output) = (Model::new(source), Model::new(output));
    let name = report["clip"].as_str().expect("the clip's name");
    let [before, after] =
        [&source, &output].map(|model| model.clip(model.clip_index(name).expect("the clip is there")));
    let limb: Vec<usize> =
        list(&report["limb"]).iter().map(|bone| output.node(bone.as_str().expect("a name"))).collect();
    let length = number(&report["length"]);
    let place = |m: DMat4| m.transform_point3(DVec3::ZERO);
    let axes = |m: DMat4| {
        let m = DMat3::from_mat4(m);
        DMat3::from_cols(m.x_axis.normalize(), m.y_axis.normalize(), m.z_axis.normalize())
    };
    let (mut stretched, mut worst) = (0, 0.0_f64);
    for frame in list(&report["frames"]) {
        let t = single(&frame["t"]);
        let (was, is) = (source.pose(&before, t), output.pose(&after, t));
        for (node, (was, is)) in was.iter().zip(&is).enumerate() {
            let mut is = *is;
            if limb.contains(&node) {
                is.rotation = was.rotation;
            }
            assert!(was.difference(&is) < 5e-5, "t {t}: node {node} moved");
        }
        let (was, is) = (source.world(&was, limb[2]), output.world(&is, limb[2]));
        let near = |a: DVec3, b: &Value| assert!(a.distance(vector(b)) < 2e-5 * length, "t {t}: {a}, and {b} is told");
        near(place(was), &frame["before"]);
        near(place(is), &frame["after"]);
        let turned = (axes(was) - axes(is)).to_cols_array().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        assert!(turned < 1e-4, "t {t}: the hand is turned by {turned}");
        let error = place(is).distance(vector(&frame["wanted"]));
        worst = worst.max(error);
        match frame["status"].as_str() {
            Some("reached") => assert!(error < 1e-4 * length, "t {t}: {error}"),
            Some("stretched") => stretched += 1,
            other => panic!("t {t}: {other:?}"),
        }
    }
    for target in list(&report["targets"]) {
        let t = single(&target["at"]);
        let pose = output.pose(&after, t);
        let [root, middle, tip] = [0, 1, 2].map(|k| place(output.world(&pose, limb[k])));
        let error = tip.distance(vector(&target["target"]));
        assert!((error - number(&target["error"])).abs() < 2e-5 * length, "{error}, and {target} is told");
        assert!(tip.distance(vector(&target["aimed"])) < 1e-4 * length, "{tip}: {target}");
        let far = root.distance(middle) + middle.distance(tip);
        match target["status"].as_str() {
            Some("reached") => assert!(error < 1e-4 * length, "{error}: {target}"),
            // As near as the limb gets.
            Some("too_far") => {
                let least = root.distance(vector(&target["target"])) - far;
                assert!(least > 0.0 && error < least + 1e-4 * length, "{error} of {least}");
            }
            other => panic!("{other:?}"),
        }
    }
    assert_eq!(report["summary"]["stretched"], stretched);
    assert!((number(&report["summary"]["max_error"]) - worst).abs() < 2e-5 * length);
    assert_eq!(report["trajectory"]["status"], "met", "{}", report["trajectory"]);
    assert!(
        number(&report["trajectory"]["gradient"]) <= 1e-6 && report["trajectory"]["evaluations"].as_u64() <= Some(30)
    );
}

/// Returns the `f32` that a number in the report stands for.
fn single(value: &Value) -> f64 {
    #[expect(clippy::cast_possible_truncation, reason = "the report's times are single precision")]
    let single = number(value) as f32;
    single.into()
}

/// Runs `aim reach` on a file and checks everything; returns the report.
#[track_caller]
fn reach(file: &Path, options: &[&str]) -> Value {
    let place = Place::new();
    let mut arguments = vec!["reach".into(), file.as_os_str().to_owned()];
    arguments.extend(["--out", "out.glb", "--report", "r.json"].iter().chain(options).map(Into::into));
    let ran = place.run(&arguments);
    assert_eq!((ran.code, ran.stderr.as_str()), (0, ""), "{}", file.display());
    let report = place.json("r.json");
    check(&std::fs::read(file).expect("the file is there"), &place.read("out.glb"), &report);
    report
}

fn all_reached(report: &Value) -> bool {
    list(&report["targets"]).iter().all(|target| target["status"] == "reached")
}

#[test]
fn the_mannequin_reaches_several_points() {
    let place = Place::with_mannequin();
    let file = place.path("m.glb");
    let one = reach(&file, &["--bone", "right_hand", "--at", "0.5", "--target=-0.3,1.2,0.3"]);
    assert!(all_reached(&one), "{}", one["targets"]);
    let both = ["--at", "0.3", "--target=-0.35,1.2,0.25", "--at", "0.8", "--target=-0.25,1.05,0.3"];
    let report = reach(&file, &[&["--bone", "right_hand", "--clip", "walk", "--fps", "30"], &both[..]].concat());
    assert!(all_reached(&report) && list(&report["targets"]).len() == 2, "{}", report["targets"]);
}

#[test]
fn out_of_reach_is_as_near_as_it_gets_and_said() {
    let place = Place::with_mannequin();
    let report = reach(&place.path("m.glb"), &["--bone", "left_hand", "--at", "0.4", "--target", "0.5,2.5,1"]);
    assert_eq!(report["targets"][0]["status"], "too_far");
    let ran = place.done("reach m.glb --bone left_hand --at 0.4 --target 0.5,2.5,1 --out o.glb");
    assert!(ran.stdout.contains("cannot reach its target") && ran.stdout.contains("too far"), "{}", ran.stdout);
}

#[test]
fn a_page_draws_both_ways() {
    let place = Place::with_mannequin();
    place.done("reach m.glb --bone left_hand --at 0.4 --target 0.3,1.2,0.3 --out o.glb --html r.html");
    let text = String::from_utf8(place.read("r.html")).expect("a page is text");
    let page = scraper::Html::parse_document(&text);
    assert!(page.errors.is_empty(), "{:?}", page.errors);
    let all = |selector: &str| -> Vec<_> {
        page.select(&scraper::Selector::parse(selector).expect("a selector")).map(|at| at.value().clone()).collect()
    };
    let count = |selector: &str| all(selector).len();
    assert_eq!((count("figure:not(.chart) > svg > .series"), count("figure > svg > .target")), (6 + 5 * 3, 3 + 5 * 2));
    // The character before and after, at five times.
    let pictures = all(".takes li image");
    assert_eq!((count(".takes li"), pictures.len()), (5, 10));
    let [was, is] = [4, 5].map(|k| pictures[k].attr("href").expect("a picture"));
    assert_ne!(was, is, "the arm is somewhere else at the target's time");
    assert!(text.len() < 2_000_000, "{} bytes", text.len());
    // Charts of error, movement, speed of the hand, angle and speed of the elbow, each with the target's time marked.
    assert_eq!((count(".chart"), count(".chart .moment")), (5, 5));
    assert_eq!(count(".facts table"), 2);
    assert_eq!(count("svg"), count("svg[aria-label], svg[aria-hidden]"), "every drawing is named or an ornament");
}

#[test]
fn a_page_shades_where_the_limb_is_at_its_limit() {
    let place = Place::with_mannequin();
    place.done("reach m.glb --bone left_hand --at 0.4 --target 0.3,3.2,0.3 --out o.glb --report r.json --html r.html");
    let text = String::from_utf8(place.read("r.html")).expect("a page is text");
    let page = scraper::Html::parse_document(&text);
    assert!(page.errors.is_empty(), "{:?}", page.errors);
    let selector = scraper::Selector::parse(".chart .bound title").expect("a selector");
    let shaded: Vec<String> = page.select(&selector).map(|title| title.text().collect()).collect();
    let frames = place.json("r.json")["frames"].as_array().expect("frames").clone();
    let time = |frame: &Value| frame["t"].as_f64().expect("a time");
    let stretched: Vec<f64> = frames.iter().filter(|frame| frame["status"] == "stretched").map(time).collect();
    assert!(stretched.len() >= 3, "{stretched:?}");
    // Shaded in the charts of the elbow's angle and speed, from the first such frame on.
    let [angle, speed] = &shaded[..] else { panic!("one stretch in two charts: {shaded:?}") };
    assert_eq!(angle, speed);
    let (from, to) =
        angle.strip_prefix("at a limit, ").and_then(|t| t.strip_suffix(" s")?.split_once('–')).expect("times");
    let [from, to] = [from, to].map(|t| t.parse::<f64>().expect("a time"));
    assert!((from - stretched[0]).abs() < 0.006, "{from} {stretched:?}");
    assert!((to - stretched[stretched.len() - 1] - 1.0 / 60.0).abs() < 0.006, "{to} {stretched:?}");
}

#[test]
fn a_page_of_many_targets_at_the_ends_of_a_clip_is_not_large() {
    let place = Place::with_mannequin();
    let goals: String = (0..=11).map(|k| format!(" --at {} --target 0.3,1.2,0.3", f64::from(k) * 0.1)).collect();
    place.done(&format!("reach m.glb --bone left_hand --out o.glb --html r.html{goals}"));
    let text = String::from_utf8(place.read("r.html")).expect("a page is text");
    assert!(text.contains("The first 8 targets are drawn"));
    assert!(text.len() < 2_000_000, "{} bytes", text.len());
}

#[test]
fn what_cannot_be_used_is_said() {
    let place = Place::with_mannequin();
    let with = |rest: &str| format!("reach m.glb --out o.glb {rest}");
    for (rest, words) in [
        ("--bone right_hand --at 0.5", &["--target"][..]),
        ("--bone right_hand --at 0.5 --target 1,2", &["--target", "0.3,1.5,0.6"]),
        ("--bone right_hand --at 0.5 --at 0.6 --target 0,1,0", &["--at", "2 times", "once for each point"]),
        ("--bone right_hand --at 99 --target 0,1,0", &["m.glb", "99", "walk"]),
        ("--bone right_hand --at NaN --target 0,1,0", &["m.glb", "NaN"]),
        ("--bone right_hand --at 0.5 --at 0.501 --target 0,1,0 --target 0,1,1", &["0.501", "--fps"]),
        ("--bone right_hnd --at 0.5 --target 0,1,0", &["right_hnd", "right_hand"]),
        ("--bone right_hand --clip run --at 0.5 --target 0,1,0", &["run", "walk"]),
        ("--bone right_hand --fps 0 --at 0.5 --target 0,1,0", &["--fps", "keys per second"]),
        ("--bone right_hand --at 0.5 --target 0,1,0 --report o.glb", &["used twice"]),
        ("--bone right_hand --at 0.5 --target 0,1,0 --report m.glb", &["used twice"]),
        ("--bone right_hand --at 0.5 --target 0,1,0 --report r --html r", &["used twice"]),
    ] {
        place.refused(&with(rest), words);
    }
    let root = crate::common::changed(|_| ());
    let (json, _) = crate::common::gltf::take_apart(&root);
    let parents = Model::new(&root);
    let nodes = json["nodes"].as_array().expect("nodes");
    let top = (0..nodes.len()).find(|&node| parents.parent(node).is_none()).expect("a root");
    place.refused(
        &with(&format!("--bone {} --at 0.5 --target 0,1,0", nodes[top]["name"].as_str().expect("a name"))),
        &["parent and grandparent"],
    );
    place.write(
        "still.glb",
        &crate::common::changed(|json| {
            json.as_object_mut().expect("an object").remove("animations");
        }),
    );
    place.refused("reach still.glb --bone right_hand --at 0 --target 0,1,0 --out o.glb", &["still.glb", "clip"]);
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn a_robot_punches_and_waves_where_it_is_told() {
    let folder = crate::common::real_rigs();
    let file = folder.join("quaternius_robot.glb");
    for (clip, at, target) in [
        ("Robot_Punch", "0.25", "-0.75,2.4,2.3"),
        ("Robot_Punch", "0.3", "-0.9,2.4,2.2"),
        ("Robot_Punch", "0.35", "-1.0,2.0,2.3"),
        ("Robot_Wave", "0.9", "-2.0,3.4,0.3"),
    ] {
        let report = reach(&file, &["--clip", clip, "--bone", "Palm2.R", "--at", at, &format!("--target={target}")]);
        assert!(all_reached(&report), "{clip}: {}", report["targets"]);
    }
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn an_arm_of_a_scanned_man_goes_where_it_is_told() {
    let folder = crate::common::real_rigs();
    let file = folder.join("pab_arnaud.glb");
    for (at, target) in [("0.9", "-0.2,1.3,1.2"), ("0.5", "-0.25,1.15,0.6"), ("1.31", "-0.35,1.2,1.5")] {
        let report =
            reach(&file, &["--clip", "walk", "--bone", "RightHand", "--at", at, &format!("--target={target}")]);
        assert!(all_reached(&report), "{}", report["targets"]);
    }
}
