//! Options of `aim bake`: how it settles, its duration, frame rate, looping, the choice of the clip, solver settings
//! and effectors.

use crate::common::Place;
use crate::common::forward::{Bake, both_eyes, list, number};
use crate::common::gltf::{Local, Model};
use crate::common::rig::joints;
use aim_animation::Track;
use serde_json::{Value, json};

/// Bakes `m.glb` with `m.toml` in `place` and checks everything; returns the report.
#[track_caller]
fn bake(place: &Place, options: &str) -> Value {
    place.done(&format!("bake m.glb --rig m.toml --out out.glb --report r.json {options}"));
    let rig = String::from_utf8(place.read("m.toml")).expect("text");
    let (source, output, report) = (place.read("m.glb"), place.read("out.glb"), place.json("r.json"));
    Bake { source: &source, output: &output, report: &report, joints: Some(&joints(&rig)) }.check();
    report
}

fn angles(frame: &Value) -> Vec<f64> {
    list(&frame["joints"]).iter().flat_map(|j| [number(&j["heading_deg"]), number(&j["pitch_deg"])]).collect()
}

fn frames(report: &Value) -> (&Value, &Value, usize) {
    let frames = list(&report["frames"]);
    (&frames[0], &frames[frames.len() - 1], frames.len())
}

const ASIDE: &str = "--target 1.2,1.9,1.5";

#[test]
fn settling_by_a_snap_begins_on_the_target() {
    let report = bake(&Place::with_mannequin(), ASIDE);
    assert_eq!(frames(&report).0["status"], "reached");
    assert_eq!(report["frames"], bake(&Place::with_mannequin(), &format!("{ASIDE} --settle snap"))["frames"]);
}

#[test]
fn settling_from_the_animation_begins_at_rest() {
    let report = bake(&Place::with_mannequin(), &format!("{ASIDE} --settle animation"));
    let (first, last, _) = frames(&report);
    assert_eq!((angles(first), &first["status"]), (vec![0.0; 6], &json!("rate_limited")));
    assert_eq!(last["status"], "reached");
}

#[test]
fn a_bake_covers_the_clip_once_or_as_long_as_asked() {
    let place = Place::with_mannequin();
    for (options, seconds, count) in [
        ("", 1.2, 73),
        ("--seconds 0.5", 0.5, 31),
        ("--seconds 4.3", 4.3, 259),
        ("--seconds 2.4 --fps 24", 2.4, 59),
        ("--fps 144", 1.2, 174),
        ("--seconds 1 --fps 59.94", 1.0, 61),
        ("--seconds 0.001 --fps 1000", 0.001, 2),
        ("--seconds 0.00005 --fps 200000", 0.00005, 11),
        ("--seconds 7 --fps 0.5", 7.0, 5),
    ] {
        let report = bake(&place, &format!("{ASIDE} {options}"));
        let (first, last, found) = frames(&report);
        assert_eq!((number(&first["t"]), found), (0.0, count), "{options}");
        assert!((number(&last["t"]) - seconds).abs() < 1e-6 * seconds, "{options}: {}", last["t"]);
    }
}

#[test]
fn a_loop_ends_where_it_begins() {
    let place = Place::with_mannequin();
    // A loop too short for the joints to arrive within one round.
    let short = Place::with_mannequin();
    let document = aim_gltf::Document::from_bytes(&short.read("m.glb")).expect("a file");
    let piece = document.clip("walk").expect("its clip").cut(0.0, 0.3);
    let mended = aim_character::mended_loop(&document, &aim_character::Measurement::of(&document), &piece);
    let mended = mended.expect("it has hips").expect("it is no loop").clip;
    short.write("m.glb", &document.with_clips(&[mended]).expect("it can be written"));
    for (place, options) in [
        (&place, "--target orbit:2,0.2,2.4 --seconds 2.4"),
        (&place, "--target orbit:2,0.2,2.4 --seconds 2.4 --settle animation"),
        (&place, "--target orbit:2,0,12 --seconds 12"),
        (&short, "--target 1.5,1.9,0.5 --settle animation"),
        (&place, "--target -1.5,1.2,0.2"),
    ] {
        let report = bake(place, &format!("{options} --loop"));
        let (first, last, _) = frames(&report);
        for (a, b) in angles(first).iter().zip(angles(last)) {
            assert!((a - b).abs() < 1e-3, "{options}: {first} to {last}");
        }
    }
}

#[test]
fn a_clip_that_travels_and_repeats_is_warned_of() {
    let place = Place::with_mannequin();
    let document = aim_gltf::Document::from_bytes(&place.read("m.glb")).expect("a file");
    let hips = document.skeleton().find("hips").expect("its hips");
    let rest = document.skeleton().rest()[hips].translation;
    let ahead = |metres: f32| rest + aim_runtime::glam::Vec3::Z * metres;
    for (metres, is_warned) in [(1.3, true), (0.02, false)] {
        let path = Track::linear([0.0, 1.2], [ahead(0.0), ahead(metres)]).expect("two keys");
        let walk = document.clip("walk").expect("its clip").clone().with_translation(hips, path);
        place.write("m.glb", &document.with_clips(&[walk]).expect("it can be written"));
        let bake = format!("bake m.glb --rig m.toml {ASIDE} --out out.glb --report r.json");
        for (options, when) in [
            ("", None),
            ("--seconds 1.2 --loop", None),
            ("--seconds 0.7", None),
            ("--seconds 2", Some("at 1.2 s")),
            ("--seconds 3.6 --loop", Some("at 1.2 and 2.4 s")),
            ("--seconds 12", Some("9 times, first at 1.2 s")),
        ] {
            let ran = place.done(&format!("{bake} {options}"));
            let Some(when) = when.filter(|_| is_warned) else {
                assert_eq!(ran.stderr, "", "{options}");
                assert!(place.json("r.json").get("warnings").is_none(), "{options}");
                continue;
            };
            let words =
                "\"walk\" moves hips by 1.3 units over the ground (74 % of the height), and the body jumps back";
            assert!(ran.stderr.contains(words) && ran.stderr.contains(when), "{options}: {}", ran.stderr);
            assert_eq!(
                json!([ran.stderr.trim_start_matches("warning: ").trim_end()]),
                place.json("r.json")["warnings"]
            );
        }
    }
    // The advice is followed to the letter.
    let path = Track::linear([0.0, 1.2], [ahead(0.0), ahead(1.3)]).expect("two keys");
    let walk = document.clip("walk").expect("its clip").clone().with_translation(hips, path);
    place.write("m.glb", &document.with_clips(&[walk]).expect("it can be written"));
    let bake = format!("--rig m.toml {ASIDE} --seconds 2.4 --out out.glb --html r.html");
    let warned = place.done(&format!("bake m.glb {bake}")).stderr;
    let advice = warned.split('`').nth(1).and_then(|advice| advice.strip_prefix("aim ")).expect("a command");
    let page = String::from_utf8(place.read("r.html")).expect("text");
    assert!(page.contains("and the body jumps back by as much"), "the page warns, too");
    place.done(&advice.replace('"', ""));
    assert_eq!(place.done(&format!("bake in-place.glb {bake}")).stderr, "");
}

/// With `--loop`, a clip that jumps at its end is mended: every bone ends where it begins, with the same velocity, and
/// the output says so.
#[test]
fn a_loop_mends_the_seam_of_its_clip() {
    let place = Place::with_mannequin();
    let document = aim_gltf::Document::from_bytes(&place.read("m.glb")).expect("a file");
    let piece = document.clip("walk").expect("its clip").cut(0.0, 0.95).with_name("piece");
    place.write("piece.glb", &document.with_clips(&[piece]).expect("it can be written"));
    let mut jumps = Vec::new();
    for looped in ["", " --loop"] {
        let options = format!("bake piece.glb --rig m.toml --clip piece {ASIDE} --out out.glb --report r.json{looped}");
        let ran = place.done(&options);
        assert_eq!(ran.stdout.contains("\"piece\" does not loop"), !looped.is_empty(), "{}", ran.stdout);
        let model = Model::new(&place.read("out.glb"));
        let clip = model.clip(model.clip_index("piece_aimed").expect("it is written"));
        let h = 1e-3;
        let at = |t: f64| model.pose(&clip, t);
        let [begin, after, before, end] = [at(0.0), at(h), at(clip.seconds - h), at(clip.seconds)];
        let place_jump = begin.iter().zip(&end).map(|(a, b)| a.difference(b)).fold(0.0, f64::max);
        // Largest difference between the angular velocities in the millisecond before and after the seam.
        let turn = |a: &Local, b: &Local| (b.rotation.normalize() * a.rotation.normalize().inverse()).xyz() * 2.0 / h;
        let kinks = (0..begin.len()).map(|node| {
            let [one, other] = [turn(&before[node], &end[node]), turn(&begin[node], &after[node])];
            // Either quaternion of the rotation.
            (one - other).length().min((one + other).length())
        });
        jumps.push((place_jump, kinks.fold(0.0, f64::max)));
    }
    let [(place_before, speed_before), (place_after, speed_after)] = jumps[..] else { unreachable!("two bakes") };
    assert!(place_before > 0.1 && speed_before > 1.0, "{place_before} {speed_before}");
    // The joints of the chain are written with 60 linear keys per second.
    assert!(place_after < 1e-4 && speed_after < 0.1 * speed_before, "{place_after} {speed_after}");
    // A clip that already closes is left alone, without a message.
    let ran = place.done(&format!("bake m.glb --rig m.toml {ASIDE} --out out.glb --loop"));
    assert!(!ran.stdout.contains("does not loop"), "{}", ran.stdout);
}

/// A loop whose length is not a whole number of the clip's rounds closes, too: every bone ends where it begins.
#[test]
fn a_loop_of_any_length_closes() {
    let place = Place::with_mannequin();
    for (seconds, told) in [("0.5", true), ("3.3", true), ("1.2", false), ("2.4", false), ("3.6", false)] {
        let ran = place.done(&format!("bake m.glb --rig m.toml {ASIDE} --out out.glb --seconds {seconds} --loop"));
        let words = format!("{seconds} s of \"walk\" do not loop");
        assert_eq!(ran.stdout.contains(&words), told, "{seconds}: {}", ran.stdout);
        let model = Model::new(&place.read("out.glb"));
        let clip = model.clip(model.clip_index("walk_aimed").expect("it is written"));
        assert!((clip.seconds - seconds.parse::<f64>().expect("a number")).abs() < 1e-6, "{seconds}: {}", clip.seconds);
        let [begin, end] = [0.0, clip.seconds].map(|t| model.pose(&clip, t));
        let jump = begin.iter().zip(&end).map(|(a, b)| a.difference(b)).fold(0.0, f64::max);
        assert!(jump < 1e-3, "{seconds}: {jump} over the seam");
    }
    // A refused command prints nothing about loops.
    place.refused(&format!("bake m.glb --rig m.toml {ASIDE} --out no.glb --seconds=1e-5 --loop"), &["0.00001 s"]);
}

#[test]
fn the_named_clip_is_aimed_over_and_the_others_stay() {
    let place = Place::with_mannequin();
    let (mut json, bin) = crate::common::gltf::take_apart(&place.read("m.glb"));
    let mut other = json["animations"][0].clone();
    other["name"] = json!("wälk <2>");
    other["extras"] = json!({ "kept": true });
    json["animations"].as_array_mut().expect("clips").push(other);
    place.write("m.glb", &crate::common::gltf::put_together(&json, &bin));
    // Without a choice, the first clip is used, with a message.
    let ran = place.done(&format!("bake m.glb --rig m.toml {ASIDE} --out out.glb --report r.json"));
    for word in ["m.glb has 2 clips", "\"walk\"", "--clip"] {
        assert!(ran.stderr.contains(word), "{}", ran.stderr);
    }
    assert_eq!(place.json("r.json")["clip"], "walk_aimed");
    place.done("inspect out.glb");
    let named = |more: &str| {
        let options = format!("bake m.glb --rig m.toml --target 0,1,2 --out b.glb --report r.json {more}--clip");
        let ran = place.run(options.split(' ').chain(["wälk <2>"]));
        assert_eq!((ran.code, ran.stderr.as_str()), (0, ""));
        crate::common::gltf::take_apart(&place.read("b.glb")).0["animations"].clone()
    };
    // The aimed clip is added after the others and keeps the extras of its source.
    let output = named("");
    assert_eq!((list(&output).len(), &output[0], &output[1]), (3, &json["animations"][0], &json["animations"][1]));
    assert_eq!(
        (&output[2]["name"], &output[2]["extras"]),
        (&json!("wälk <2>_aimed"), &json["animations"][1]["extras"])
    );
    // Under another name, or replacing a clip.
    let output = named("--as other ");
    assert_eq!((list(&output).len(), &output[2]["name"], &output[1]), (3, &json!("other"), &json["animations"][1]));
    let output = named("--as walk ");
    assert_eq!((list(&output).len(), &output[0]["name"], &output[1]), (2, &json!("walk"), &json["animations"][1]));
    assert_ne!(output[0], json["animations"][0]);
    let said = |name: &str| {
        place.done(&format!("bake m.glb --rig m.toml --target 0,1,2 --out b.glb --clip walk --as {name}")).stdout
    };
    assert!(said("walk").contains("saved as \"walk\", replacing the clip of that name; "), "{}", said("walk"));
    assert!(!said("other").contains("replacing"), "{}", said("other"));
    place.refused("bake m.glb --rig m.toml --target 0,1,2 --out c.glb --as=", &["--as"]);
    place.refused(
        "bake m.glb --rig m.toml --target 0,1,2 --out c.glb --clip run",
        &["m.glb", "run", "walk", "wälk <2>"],
    );
}

#[test]
fn a_character_without_clips_stands_still_and_aims() {
    let place = Place::with_mannequin();
    place.write(
        "m.glb",
        &crate::common::changed(|json| drop(json.as_object_mut().expect("an object").remove("animations"))),
    );
    place.refused(&format!("bake m.glb --rig m.toml {ASIDE} --out out.glb"), &["m.glb", "no clip", "--seconds"]);
    let report = bake(&place, &format!("{ASIDE} --seconds 0.5"));
    assert_eq!((&report["clip"], frames(&report).2), (&json!("aim"), 31));
}

#[test]
fn a_name_that_is_taken_is_counted_on() {
    let place = Place::with_mannequin();
    place.done(&format!("bake m.glb --rig m.toml {ASIDE} --out m.glb --report r.json --clip walk"));
    place.done(&format!("bake m.glb --rig m.toml {ASIDE} --out m.glb --report r.json --clip walk"));
    assert_eq!(place.json("r.json")["clip"], "walk_aimed2");
}

#[test]
fn weight_attention_and_the_policy_behind_are_the_artists() {
    let place = Place::with_mannequin();
    let aside = "--target 1.5,1.66,1.5 --seconds 1.2";
    let last = |options: &str| {
        place.done(&format!("bake m.glb --rig m.toml --out out.glb --report r.json {options}"));
        let report = place.json("r.json");
        let frame = frames(&report).1.clone();
        let headings: Vec<f64> = list(&frame["joints"]).iter().map(|joint| number(&joint["heading_deg"])).collect();
        (headings, frame["status"].clone())
    };
    let (whole, _) = last(aside);
    let (half, _) = last(&format!("{aside} --weight 0.5"));
    let sum = |headings: &[f64]| headings.iter().sum::<f64>();
    assert!((sum(&half) / sum(&whole) - 0.5).abs() < 0.05, "{half:?} of {whole:?}");
    assert_eq!(last(&format!("{aside} --weight 0")).0, [0.0; 3]);
    // The eye returns to its centre.
    let (attentive, _) = last(&format!("{aside} --attention 1"));
    assert!(whole[0].abs() > 5.0 && attentive[0].abs() < 1.0, "{attentive:?} instead of {whole:?}");
    // Targets behind: held at the limit by default, released with `--behind release`.
    let behind = "--target 0.1,1.66,-2 --seconds 1.2";
    let (clipped, status) = last(behind);
    assert!(clipped[1].abs() > 50.0 && status == "behind", "{clipped:?}, {status}");
    let (released, status) = last(&format!("{behind} --behind release"));
    assert!(released.iter().all(|heading| heading.abs() < 1e-3) && status == "behind", "{released:?}, {status}");
    let (impatient, _) = last(&format!("{behind} --patience 0.1"));
    assert!(impatient[1].abs() < 0.5 * clipped[1].abs(), "{impatient:?} after {clipped:?}");
    // The target is nearly straight behind; with `--behind plane` the chain aims nearly straight ahead.
    let (on_plane, _) = last(&format!("{behind} --behind plane"));
    assert!(sum(&on_plane).abs() < 0.5 * sum(&clipped).abs(), "{on_plane:?} instead of {clipped:?}");
    for option in ["--attention 1", "--patience 1"] {
        let told = |solver: &str| {
            place.done(&format!("bake m.glb --rig m.toml --out out.glb {aside} {option} --solver {solver}")).stderr
        };
        assert!(
            told("exact").contains("only the natural solver uses it") && !told("natural").contains("warning"),
            "{option}"
        );
    }
    for wrong in ["--weight 2", "--patience=-1", "--weight=-1", "--weight NaN", "--attention x", "--behind ignore"] {
        let option = wrong.split([' ', '=']).next().expect("a word");
        place.refused(&format!("bake m.glb --rig m.toml --out out2.glb {aside} {wrong}"), &[option]);
    }
}

#[test]
fn at_half_the_weight_words_and_errors_are_of_the_goal() {
    let place = Place::new();
    // Without animation, the goal is halfway from straight ahead to the target.
    place.write(
        "m.glb",
        &crate::common::changed(|json| drop(json.as_object_mut().expect("an object").remove("animations"))),
    );
    let aside = "bake m.glb --target 3,1.68,5 --seconds 1 --out out.glb --report r.json --html r.html";
    for (solver, both) in [("natural", ""), ("exact", ""), ("natural", "--both-eyes")] {
        let ran = place.done(&format!("{aside} --solver {solver} --weight 0.5 {both}"));
        let report = place.json("r.json");
        let (_, last, count) = frames(&report);
        let of_target = number(&last["error_deg"]);
        assert!((14.0..17.5).contains(&of_target), "{solver}: {of_target}° of 31° are left");
        let of_goal = number(&last["goal_error_deg"]);
        assert!(of_goal < 0.1 && last["status"] == "reached", "{solver}: {last}");
        assert_eq!((&report["weight"], &report["summary"]["of"]), (&json!(0.5), &json!("goal")));
        let most = number(&report["summary"]["max_error_deg_reached"]);
        assert!(most < 0.1, "{solver}: {most}° from the goal, on it");
        let words = format!("{count} on the weighted goal (error at most {most:.3}°)");
        assert!(ran.stdout.contains(&words) && !ran.stdout.contains("on target"), "{}", ran.stdout);
        let page = String::from_utf8(place.read("r.html")).expect("text");
        for words in ["frames are on the weighted goal", "angle between gaze and weighted goal", "from the target"] {
            assert!(page.contains(words), "{solver}: no {words:?} on the page");
        }
        assert!(!page.contains("on target"), "{solver}: on the page");
        assert_eq!(last.get("pair_goal_error_deg").is_some_and(|off| number(off) < 0.2), !both.is_empty());
    }
    // At weight 1, errors and words refer to the target itself.
    let ran = place.done(&format!("{aside} --weight 1"));
    let report = place.json("r.json");
    assert!(report.get("weight").is_none() && report["summary"].get("of").is_none());
    assert!(frames(&report).1.get("goal_error_deg").is_none() && ran.stdout.contains("on target (error"));
    let page = String::from_utf8(place.read("r.html")).expect("text");
    assert!(page.contains("are on target") && !page.contains("goal"), "the page is of the target");
}

#[test]
fn the_effector_is_another_joint_and_what_is_outside_it_rests() {
    let place = Place::with_mannequin();
    let last_of = |options: &str| {
        let report = bake(&place, options);
        let frame = frames(&report).1.clone();
        (list(&frame["joints"]).iter().map(|joint| number(&joint["heading_deg"])).collect::<Vec<_>>(), report)
    };
    for solver in ["natural", "exact", "ascent"] {
        let aside = format!("--target 1,1.66,2 --seconds 3 --solver {solver}");
        let (own, report) = last_of(&aside);
        assert_eq!(report["effector"]["bone"], "left_eye");
        assert_eq!(last_of(&format!("{aside} --effector eyes")), (own.clone(), report), "{solver}");
        // The neck turns to where the eye looked, further than its own part of that turn.
        let (turned, report) = last_of(&format!("{aside} --effector neck"));
        assert_eq!(report["effector"]["bone"], "neck", "{solver}");
        assert_eq!(report["effector"]["origin"], json!([0.0, 0.0, 0.0]), "{solver}");
        assert!(turned[0] == 0.0 && turned[1] > own[1] + 1.0, "{solver}: {turned:?} after {own:?}");
        assert_eq!(frames(&report).1["status"], "reached", "{solver}");
        let (turned, report) = last_of(&format!("--target 0.2,1.4,2 --seconds 3 --solver {solver} --effector chest"));
        assert_eq!(report["effector"]["bone"], "spine3", "{solver}");
        assert!(turned[..2] == [0.0; 2] && turned[2] > 3.0, "{solver}: {turned:?}");
        assert_eq!(frames(&report).1["status"], "reached", "{solver}");
    }
}

#[test]
fn a_bake_of_another_effector_says_so() {
    let place = Place::with_mannequin();
    let ran = place.done(&format!("bake m.glb --rig m.toml {ASIDE} --effector neck --out out.glb --html r.html"));
    assert!(ran.stdout.contains("aimed with the rig Mannequin, effector \"neck\""), "{}", ran.stdout);
    let page = String::from_utf8(place.read("r.html")).expect("text");
    assert!(page.contains("neck, along ("), "the page names the effector");
    // The hand is a descendant of the chest: the chest can never catch up with it, but the eye can.
    let at_hand = "bake m.glb --rig m.toml --out out.glb --seconds 0.2 --target node:left_hand";
    assert!(place.done(&format!("{at_hand} --effector chest")).stderr.contains("moves with the gaze;"));
    assert_eq!(place.done(at_hand).stderr, "");
    // An orbit is centred on the effector: level with it, the neck needs no pitch beyond the walk's.
    let orbit = "bake m.glb --rig m.toml --seconds 1 --out out.glb --report r.json --target";
    place.done(&format!("{orbit} orbit:2,0,8 --effector neck"));
    let [neck, eye] = [&place.json("r.json"), &{
        place.done(&format!("{orbit} orbit:2,0,8"));
        place.json("r.json")
    }]
    .map(|report| number(&frames(report).0["target"][1]));
    assert!(neck < eye - 0.05, "the orbit is {neck} high, the eye's {eye}");
}

#[test]
fn an_effector_that_the_rig_has_not_is_refused() {
    let place = Place::with_mannequin();
    let refused = |more: &str, words: &[&str]| {
        place.refused(&format!("bake m.glb --rig m.toml {ASIDE} --out out.glb {more}"), words);
    };
    // The message names what was asked for, the rig, and what is possible.
    refused("--effector jaw", &["jaw", "Mannequin", "left_eye", "neck", "spine3", "eyes (left_eye)", "chest (spine3)"]);
    // This rig has no joint of that role.
    refused("--effector head", &["--effector head", "Mannequin", "neck"]);
    refused("--effector=", &["--effector"]);
    refused("--effector neck --both-eyes", &["--both-eyes", "--effector neck"]);
    place.done(&format!("bake m.glb --rig m.toml {ASIDE} --out out.glb --effector eyes --both-eyes"));
}

#[test]
fn a_measured_rig_has_the_name_of_its_file() {
    let place = Place::with_mannequin();
    place.write("my hero.v2.glb", &place.read("m.glb"));
    let ran = place.run(["bake", "my hero.v2.glb", "--target", "0,1.6,2", "--out", "o.glb", "--report", "r.json"]);
    assert!(ran.code == 0 && ran.stdout.contains("aimed with the rig my hero.v2, saved as"), "{ran:?}");
    assert_eq!(place.json("r.json")["rig"], "my hero.v2");
}

#[test]
fn bones_whose_names_repeat_have_their_node_in_the_report() {
    let place = Place::with_mannequin();
    let mut nodes = 0;
    place.write(
        "m.glb",
        &crate::common::changed(|json| {
            let all = json["nodes"].as_array_mut().expect("nodes");
            nodes = all.len();
            all.push(json!({ "name": "neck" }));
            json["scenes"][0]["nodes"].as_array_mut().expect("roots").push(json!(nodes));
        }),
    );
    place.done(&format!("bake m.glb --rig m.toml {ASIDE} --out out.glb --report r.json"));
    let report = place.json("r.json");
    let joints = &report["frames"][0]["joints"];
    assert_eq!((&joints[1]["bone"], &joints[1]["node"]), (&json!("neck"), &json!(5)));
    assert!(joints[0].get("node").is_none() && report["effector"].get("node").is_none(), "one name, one node");
}

#[test]
fn the_output_may_take_the_place_of_the_input() {
    let place = Place::with_mannequin();
    place.done(&format!("bake m.glb --rig m.toml {ASIDE} --out apart.glb"));
    place.done(&format!("bake m.glb --rig m.toml {ASIDE} --out m.glb"));
    assert_eq!(place.read("m.glb"), place.read("apart.glb"));
    assert_eq!(place.names(), ["apart.glb", "m.glb", "m.toml"]);
}

#[test]
fn the_same_bake_twice_is_the_same_file() {
    let place = Place::with_mannequin();
    bake(&place, ASIDE);
    let first = (place.read("out.glb"), place.read("r.json"));
    bake(&place, ASIDE);
    assert_eq!(first, (place.read("out.glb"), place.read("r.json")));
}

#[test]
fn the_solver_is_the_one_asked_for_else_the_one_that_suits_the_rig() {
    let place = Place::with_mannequin();
    for solver in ["natural", "exact", "ascent"] {
        assert_eq!(bake(&place, &format!("{ASIDE} --seconds 0.2 --solver {solver}"))["solver"], solver);
    }
    assert_eq!(bake(&place, &format!("{ASIDE} --seconds 0.2"))["solver"], "natural");
    let whole = String::from_utf8(place.read("m.toml")).expect("text");
    let at = whole.find("[[joint]]").expect("a joint");
    let neck = at + 1 + whole[at + 1..].find("[[joint]]").expect("a second joint");
    let eyeless = format!("{}{}", &whole[..at], &whole[neck..]);
    place.write("m.toml", &eyeless);
    assert_eq!(bake(&place, &format!("{ASIDE} --seconds 0.2"))["solver"], "natural");
    let without_roles = eyeless.lines().filter(|line| !line.starts_with("role")).collect::<Vec<_>>().join("\n");
    place.write("m.toml", &without_roles);
    assert_eq!(bake(&place, &format!("{ASIDE} --seconds 0.2"))["solver"], "exact");
    place.refused(
        &format!("bake m.glb --rig m.toml {ASIDE} --out out2.glb --solver newton"),
        &["newton", "natural", "exact", "ascent"],
    );
}

#[test]
fn a_near_target_past_which_the_other_eye_looks_is_warned_of() {
    let place = Place::with_mannequin();
    let document = aim_gltf::Document::from_bytes(&place.read("m.glb")).expect("a file");
    let measurement = aim_character::Measurement::of(&document);
    let eye = measurement.with_role(aim_character::Role::LeftEye).expect("its eye").bind_world.translation;
    for (metres, options, is_warned) in
        [(0.35, "", true), (0.35, "--both-eyes", false), (0.35, "--effector neck", false), (2.0, "", false)]
    {
        let [x, y, z] = (eye + measurement.forward * metres).to_array();
        let bake = format!("bake m.glb --rig m.toml --target {x},{y},{z} --out out.glb --report r.json");
        let ran = place.done(&format!("{bake} {options}"));
        let words = ["right_eye turns as left_eye does", "past the near target", "--both-eyes"];
        assert_eq!(
            words.iter().all(|word| ran.stderr.contains(word)),
            is_warned,
            "{metres}, {options}: {}",
            ran.stderr
        );
        assert_eq!(place.json("r.json").get("warnings").is_some(), is_warned, "{metres}, {options}");
    }
}

#[test]
fn both_eyes_are_aimed_where_there_are_two() {
    let place = Place::with_mannequin();
    let near = "--target 0.05,1.6,0.35 --seconds 0.2";
    let one = bake(&place, near);
    assert!(list(&one["frames"]).iter().all(|frame| frame.get("pair_error_deg").is_none()), "one eye, one error");
    assert_eq!(frames(&one).0["followers"], json!([{ "bone": "right_eye" }]), "it turns as the first one does");
    for (target, apart_deg) in [("0.05,1.68,0.4", [5.0, 20.0]), ("0,1.68,50", [0.0, 0.1])] {
        place.done(&format!("bake m.glb --rig m.toml --target {target} --both-eyes --out out.glb --report r.json"));
        let (source, output, report) = (place.read("m.glb"), place.read("out.glb"), place.json("r.json"));
        let found = both_eyes(&source, &output, &report, ["left_eye", "right_eye"]);
        assert!(apart_deg[0] < found && found < apart_deg[1], "{target}: the eyes are {found}° apart");
        assert_eq!(report["summary"]["frames"], report["summary"]["reached"], "{target}");
        // Eyes that are parallel at rest are apart by the difference of their added angles.
        let apart = list(&report["frames"]).iter().map(|frame| {
            let [own, other] = [&frame["joints"][0], &frame["followers"][0]];
            assert_eq!((&own["bone"], &other["bone"]), (&json!("left_eye"), &json!("right_eye")));
            let apart = |key: &str| number(&own[key]) - number(&other[key]);
            apart("heading_deg").hypot(apart("pitch_deg"))
        });
        let apart = apart.fold(0.0, f64::max);
        assert!((apart - found).abs() < 0.02 * found + 0.01, "{target}: {apart}° instead of {found}°");
    }
    let single = String::from_utf8(place.read("m.toml")).expect("text").replace("other_eye = \"right_eye\"\n", "");
    place.write("m.toml", &single);
    place.refused(
        &format!("bake m.glb --rig m.toml {near} --both-eyes --out out2.glb"),
        &["Mannequin", "no other eye", "other_eye", "--both-eyes"],
    );
}

#[test]
fn ranges_that_narrow_or_count_from_the_bind_pose_hold() {
    let place = Place::with_mannequin();
    let rig = String::from_utf8(place.read("m.toml")).expect("text");
    for more in ["pitch_taper = 0.6", "limits_from = \"bind_pose\"", "pitch_taper = 0.6\nlimits_from = \"bind_pose\""] {
        let rig = rig.replace("rate = ", &format!("{more}\nrate = "));
        place.write("m.toml", &rig);
        place.done("bake m.glb --rig m.toml --target orbit:2,0.4,4 --seconds 4 --out out.glb --report r.json");
        let report = place.json("r.json");
        let violation = number(&report["summary"]["max_limit_violation_deg"]);
        assert!(violation < 1e-3, "{more}: a range is left by {violation}°");
        let limited = |frame: &Value| list(&frame["joints"]).iter().any(|joint| joint["at_limit"] == true);
        assert!(list(&report["frames"]).iter().any(limited), "{more}: no range is reached");
    }
}
