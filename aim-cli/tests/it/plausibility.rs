//! `plausibility` in a report, measured for movements of known size.

use std::f64::consts::FRAC_PI_2;

use aim_animation::{Clip, Track};
use aim_character::{Criterion, Plausibility, Settle};
use aim_runtime::Settings;
use aim_runtime::glam::{DQuat, DVec3, Quat, Vec3};

use crate::common::Place;
use crate::common::changed;
use crate::common::character::{Character, Order};

/// Returns the mannequin without a clip, in its bind pose.
fn statue() -> Character {
    Character::new(&changed(|json| drop(json.as_object_mut().expect("an object").remove("animations"))))
}

/// A bone with its heading, pitch and roll over time, degrees.
type Moved<'a> = (&'a str, &'a dyn Fn(f64) -> [f64; 3]);

/// Measures two seconds of the statue with bones turned by hand over time, in degrees: to the left about its own up
/// (+X), up about its left (+Z), and tilted to its left about its own forward (+Y).
fn moved(bones: &[Moved<'_>]) -> Plausibility {
    let character = statue();
    let order = Order { settle: Settle::Animation, settings: Settings::default().with_weight(0.0), ..Order::of(2.0) };
    let (_, measured) = character.measure(
        order,
        |_| character.seen_at(2.0, 0.0, 0.0),
        |clip| {
            let times = times(clip);
            for (bone, angles_at) in bones {
                let node = character.node(bone);
                let rest = character.document.skeleton().rest()[node].rotation.as_dquat();
                let keys = times.iter().map(|&t| {
                    let [heading, pitch, roll] = angles_at(t.into()).map(f64::to_radians);
                    let turn = DQuat::from_rotation_x(heading) * DQuat::from_rotation_z(-pitch);
                    (rest * turn * DQuat::from_rotation_y(-roll)).as_quat()
                });
                turn(clip, node, keys.collect());
            }
        },
    );
    measured
}

/// Returns the key times of a baked clip.
fn times(clip: &Clip) -> Vec<f32> {
    clip.tracks().iter().find_map(|tracks| tracks.rotation.as_ref()).expect("rotations").times().to_vec()
}

/// Replaces a bone's rotation in a baked clip, key by key.
fn turn(clip: &mut Clip, node: usize, keys: Vec<Quat>) {
    *clip = clip.clone().with_rotation(node, Track::linear(times(clip), keys).expect("a key at each time"));
}

#[track_caller]
fn is(measured: &Plausibility, criterion: Criterion, expected: f64, near: f64) {
    let found = measured.worst(criterion).expect("it can be told").value;
    assert!((found - expected).abs() <= near, "{}: {found} instead of {expected}", criterion.key());
}

#[test]
fn a_head_is_seen_from_the_chest() {
    let measured = moved(&[("neck", &|_| [50.0, 0.0, 0.0]), ("spine3", &|_| [-20.0, 0.0, 0.0])]);
    is(&measured, Criterion::HeadToChestHeading, 50.0, 1e-3);
    is(&measured, Criterion::HeadRoll, 0.0, 1e-3);
    is(&measured, Criterion::HeadSpeed, 0.0, 1e-3);
    // The arms follow the chest.
    is(&measured, Criterion::LimbShift, 0.0, 1e-6);
    let measured = moved(&[("neck", &|_| [0.0, 10.0, -22.0])]);
    is(&measured, Criterion::HeadRoll, 22.0, 1e-3);
    is(&measured, Criterion::HeadToChestHeading, 0.0, 1e-3);
    assert!(measured.frames[0].head_roll_deg.is_some_and(|roll| roll < 0.0), "tilted to its right");
}

#[test]
fn a_clip_that_turns_the_head_too_far_is_not_the_bakes_fault() {
    let character = statue();
    let neck = character.node("neck");
    let rest = character.document.skeleton().rest()[neck].rotation;
    let turned = |degrees: f32| rest * Quat::from_rotation_x(degrees.to_radians());
    let clip = Clip::new("owl").with_rotation(neck, Track::linear([0.0, 1.0], [turned(110.0); 2]).expect("two keys"));
    let owl = character.document.with_clips(&[clip]).expect("a clip");
    let owl = Character::new(&owl);
    let order = Order { settings: Settings::default().with_weight(0.0), ..Order::of(1.0) };
    let turned_by = |degrees: f32| {
        let change = |clip: &mut Clip| turn(clip, neck, vec![turned(degrees); times(clip).len()]);
        owl.measure(order, |_| owl.seen_at(2.0, 0.0, 0.0), change).1
    };
    assert_eq!(turned_by(110.0).worst(Criterion::HeadToChestHeading), None);
    assert_eq!(turned_by(95.0).exceeded().count(), 0);
    is(&turned_by(115.0), Criterion::HeadToChestHeading, 115.0, 1e-2);
}

#[test]
fn speed_and_acceleration_are_those_of_neck_and_head_together() {
    use std::f64::consts::TAU;
    // 20°·sin(2πt) in the same direction in two bones; the chest's own rotation does not count.
    let swing = |t: f64| [20.0 * (TAU * t).sin(), 0.0, 0.0];
    let measured = moved(&[("neck", &swing), ("head", &swing), ("spine3", &|t| [15.0 * (3.0 * t).sin(), 0.0, 0.0])]);
    is(&measured, Criterion::HeadSpeed, 40.0 * TAU, 0.5);
    is(&measured, Criterion::HeadAcceleration, 40.0 * TAU * TAU, 5.0);
    is(&measured, Criterion::Reversals, 0.0, 0.0);
    // A tremor at 8 Hz reverses every sixteenth of a second: eight times in half a second.
    let tremor = |t: f64| [0.5 * (8.0 * TAU * t).sin(), 0.0, 0.0];
    is(&moved(&[("neck", &tremor)]), Criterion::Reversals, 8.0, 1.0);
    is(&moved(&[("spine3", &tremor)]), Criterion::Reversals, 8.0, 1.0);
    // Eyes may tremble.
    is(&moved(&[("left_eye", &tremor)]), Criterion::Reversals, 0.0, 0.0);
}

#[test]
fn arms_that_leave_their_chest_are_told_in_parts_of_the_height() {
    let character = statue();
    let height = character.measurement.height;
    let order = Order { settings: Settings::default().with_weight(0.0), ..Order::of(1.0) };
    let (_, measured) = character.measure(
        order,
        |_| character.seen_at(2.0, 0.0, 0.0),
        |clip| {
            let node = character.node("left_clavicle");
            let rest = character.document.skeleton().rest()[node].translation;
            let times = times(clip);
            let keys: Vec<Vec3> =
                times.iter().map(|_| (rest.as_dvec3() + DVec3::Y * (0.07 * height)).as_vec3()).collect();
            *clip = clip.clone().with_translation(node, Track::linear(times, keys).expect("a key at each time"));
        },
    );
    is(&measured, Criterion::LimbShift, 0.07, 1e-4);
    let measured = moved(&[("left_upper_arm", &|_| [0.0, 0.0, 60.0])]);
    let found = measured.worst(Criterion::LimbShift).expect("arms").value;
    // A straight arm of 0.52 m swings by 60°, together with its hand.
    assert!((found - 0.52 / height).abs() < 0.02, "{found}");
}

#[test]
fn a_gaze_above_its_target_is_told_once_it_had_the_time_to_come() {
    let character = statue();
    // Weight 1 and a target ahead; then the eye is lifted by hand.
    let lifted = |from: f64, target: &dyn Fn(f64) -> DVec3| {
        let (_, measured) = character.measure(Order::of(2.0), target, |clip| {
            let node = character.node("left_eye");
            let rest = character.document.skeleton().rest()[node].rotation;
            let times = times(clip);
            let key =
                |&t: &f32| if f64::from(t) < from { rest } else { rest * Quat::from_rotation_z(-17_f32.to_radians()) };
            turn(clip, node, times.iter().map(key).collect());
        });
        measured.worst(Criterion::ElevationError).map(|worst| (worst.value, worst.t))
    };
    let ahead = |_: f64| character.seen_at(2.0, 0.0, 0.0);
    let (found, when) = lifted(0.0, &ahead).expect("frames");
    assert!((found - 17.0).abs() < 1e-2 && (0.7..0.72).contains(&when), "{found} at {when}");
    // The target rises late: nothing is reported until 0.7 s later.
    let late = |t: f64| character.seen_at(2.0, 0.0, if t < 1.5 { 0.0 } else { 17.0 });
    let (found, _) = lifted(1.5, &late).expect("frames");
    assert!(found < 1e-2, "{found}");
    // Nothing is reported if the target is out of reach or the weight is 0.
    assert_eq!(lifted(0.0, &|_| character.seen_at(2.0, 0.0, 89.0)), None);
    assert_eq!(moved(&[]).worst(Criterion::ElevationError), None);
}

#[test]
fn people_are_told_from_animals_by_their_trunk() {
    assert!(statue().bake(0.2, |_| DVec3::Z).is_humanoid);
    let rotated = |json: &mut serde_json::Value| {
        // On all fours: everything above the hips is turned level, unlike the legs.
        let nodes = json["nodes"].as_array_mut().expect("nodes");
        assert_eq!(nodes[1]["name"], "spine");
        drop(json.as_object_mut().expect("an object").remove("skins"));
        json["nodes"][1]["rotation"] = serde_json::json!(DQuat::from_rotation_z(-FRAC_PI_2).to_array());
        drop(json.as_object_mut().expect("an object").remove("animations"));
        json["nodes"][25].as_object_mut().expect("the body").remove("skin");
    };
    let animal = Character::new(&changed(rotated)).bake(0.2, |_| DVec3::Z);
    assert!(!animal.is_humanoid);
    // A bird may stand upright.
    let winged = |json: &mut serde_json::Value| {
        drop(json.as_object_mut().expect("an object").remove("animations"));
        for node in json["nodes"].as_array_mut().expect("nodes") {
            let name = node["name"].as_str().expect("a name").to_owned();
            if let Some(part) = ["clavicle", "upper_arm", "forearm", "hand"].iter().find(|part| name.contains(**part)) {
                node["name"] = name.replace(part, &format!("wing_{}", part.len())).into();
            }
        }
    };
    assert!(!Character::new(&changed(winged)).bake(0.2, |_| DVec3::Z).is_humanoid);
    assert_eq!(Criterion::LimbShift.must(animal.is_humanoid), None);
}

#[test]
fn the_help_tells_the_limits() {
    let help = Place::new().done("bake --help").stdout;
    let section = help.split("Plausibility").last().expect("its last section");
    for criterion in Criterion::ALL {
        for limit in [true, false].into_iter().filter_map(|is_humanoid| criterion.must(is_humanoid)) {
            let limit = if criterion == Criterion::LimbShift { 100.0 * limit } else { limit };
            assert!(section.contains(&format!("{limit}")), "{}: {limit} is not in {section}", criterion.key());
        }
    }
}

#[test]
fn strict_fails_on_what_is_too_much_and_names_it() {
    let place = Place::with_mannequin();
    let rig = String::from_utf8(place.read("m.toml")).expect("text").replace("rate = \"170deg\"", "rate = \"2000deg\"");
    place.write("quick.toml", &rig);
    place.write("jump.csv", "t,x,y,z\n0,0,1.66,2\n0.5,0,1.66,2\n0.501,2,1.66,1\n");
    let bake = "bake m.glb --seconds 1 --target file:jump.csv --out o.glb --report r.json --strict";
    let calm = place.done(&format!("{bake} --rig m.toml"));
    let looks = calm.stdout.lines().nth(1).expect("a second line");
    assert!(looks.starts_with("plausibility: all values within their limits; nearest to its limit: head "), "{looks}");
    let ran = place.aim(&format!("{bake} --rig quick.toml --solver exact --html r.html"));
    assert_eq!(ran.code, 1, "{ran:?}");
    for word in ["o.glb", "written", "head speed", "limit 300°/s", "head acceleration", "at 0.5"] {
        assert!(ran.stderr.contains(word), "{word}: {}", ran.stderr);
    }
    // The value is still in the report, and on the page.
    let found = &place.json("r.json")["plausibility"];
    assert!(found["head_speed_deg_s"].as_f64().expect("a number") > 300.0, "{found}");
    let page = String::from_utf8(place.read("r.html")).expect("text");
    assert!(page.contains("Head acceleration") && page.contains("(limit 300°/s)"), "the page");
    // Without --strict, all values are printed, and those beyond their limits once more.
    let told = place.done(&format!("{} --rig quick.toml --solver exact", bake.replace(" --strict", ""))).stdout;
    for words in [
        "plausibility: head relative to chest ",
        ", hand and clavicle shift beyond the chest's turn 0 % of the height, head speed ",
        "\nexceeds plausible limits: head speed ",
    ] {
        assert!(told.contains(words), "{words}: {told}");
    }
}

#[test]
fn what_is_outside_the_effector_lifts_no_gaze() {
    let character = statue();
    // Beyond the neck's 60°, but within reach of neck and eyes together.
    let counts = |effector: usize| {
        let order = Order { settings: Settings::default().with_effector(effector), ..Order::of(1.0) };
        let (_, measured) = character.measure(order, |_| character.seen_at(5.0, 0.0, 68.0), |_| {});
        measured.frames.last().expect("frames").elevation_counts
    };
    assert_eq!([counts(0), counts(1)], [true, false]);
}

/// Returns the statue without eyes: it looks with its head.
fn eyeless_statue(change: impl FnOnce(&mut serde_json::Value)) -> Character {
    Character::new(&changed(|json| {
        drop(json.as_object_mut().expect("an object").remove("animations"));
        for node in json["nodes"].as_array_mut().expect("nodes") {
            if node["name"].as_str().is_some_and(|name| name.ends_with("_eye")) {
                node["name"] = serde_json::json!("cheek");
            }
        }
        change(json);
    }))
}

#[test]
fn a_gaze_beside_its_target_counts_once_it_had_the_time() {
    let character = statue();
    let neck = character.node("neck");
    let rest = character.document.skeleton().rest()[neck].rotation;
    // A neck turned aside by hand from a given time, whatever the target.
    let beside = |from: f64, target_deg: &dyn Fn(f64) -> f64| {
        let target = |t: f64| character.seen_at(50.0, target_deg(t), 0.0);
        let aside = |clip: &mut Clip| {
            let times = times(clip);
            let keys = times.iter().map(|&t| {
                let degrees = if f64::from(t) < from { 0.0 } else { 14.0_f32 };
                rest * Quat::from_rotation_x(degrees.to_radians())
            });
            turn(clip, neck, keys.collect());
        };
        character.measure(Order::of(4.0), target, aside).1
    };
    let worst = |measured: &Plausibility| measured.worst(Criterion::HeadingError).map(|worst| (worst.value, worst.t));
    let (value, t) = worst(&beside(2.0, &|_| 0.0)).expect("it can be told");
    assert!((value - 14.0).abs() < 0.2 && (t - 2.0).abs() < 0.02, "{value}° at {t} s");
    // The first 0.7 s do not count, nor do the 1.5 s after a jump of the target.
    let (_, t) = worst(&beside(0.0, &|_| 0.0)).expect("it can be told");
    assert!((t - 0.7).abs() < 0.02, "{t} s");
    for jump in [6.0, 30.0] {
        let late = beside(0.0, &|t| if t < 0.5 { 0.0 } else { jump });
        let first = late.frames.iter().find(|seen| seen.heading_counts).expect("it counts again").t;
        assert!((first - 2.0).abs() < 0.12, "{jump}°: {first} s");
    }
    // A continuously moving target counts all the time.
    let followed = beside(9.0, &|t| 20.0 * t);
    assert!(followed.frames.iter().filter(|seen| seen.t > 0.72).all(|seen| seen.heading_counts));
    // Targets out of reach of eyes, neck and head do not count, nor do those nearly overhead.
    assert_eq!(worst(&beside(0.0, &|_| 170.0)), None);
    let overhead = character.measure(Order::of(2.0), |_| character.seen_at(5.0, 20.0, 75.0), |_| {}).1;
    assert_eq!(worst(&overhead), None);
}

#[test]
fn a_head_that_lags_behind_a_jerky_idle_shows() {
    // The head swings by ±12° at 2.5 Hz: three times the acceleration that a head can follow.
    let still = eyeless_statue(|_| ());
    let head = still.node("head");
    let rest = still.document.skeleton().rest()[head].rotation;
    let keys: Vec<f32> = (0_u16..=240).map(|k| f32::from(k) / 60.0).collect();
    let jerk = |hertz: f32| {
        let swing = |t: &f32| {
            let degrees = 12.0 * (hertz * t * std::f32::consts::TAU).sin();
            rest * Quat::from_rotation_x(degrees.to_radians())
        };
        let turns: Vec<Quat> = keys.iter().map(swing).collect();
        let clip =
            Clip::new("idle").with_rotation(head, Track::linear(keys.clone(), turns).expect("a key at each time"));
        let model = still.document.with_clips(&[clip]).expect("a clip");
        let character = Character::new(&model);
        let (baked, measured) = character.measure(Order::of(4.0), |_| character.seen_at(5.0, 25.0, 0.0), |_| {});
        let worst = measured.worst(Criterion::HeadingError).expect("it can be told").value;
        // For a level target the measured error agrees with that of the bake.
        let late = baked.frames.iter().filter(|frame| frame.t > 0.7);
        let most = late.map(|frame| frame.error_deg).fold(0.0, f64::max);
        assert!((worst - most).abs() < 0.5, "{worst}° beside, {most}° off");
        worst
    };
    let (slow, quick) = (jerk(0.25), jerk(2.5));
    assert!(slow < 1.0 && quick > 5.0, "{slow}° and {quick}°");
}
