//! `aim clip`, checked with the tests' own glTF reader and forward kinematics.

use std::path::Path;

use crate::common::Place;
use crate::common::forward::{list, number};
use crate::common::gltf::{Model, put_together, take_apart};
use aim_animation::{Clip, Track};
use aim_character::{Mannequin, PAPER_AXES};
use aim_gltf::Document;
use aim_runtime::glam::{DMat4, DQuat, DVec3, Vec3};
use serde_json::Value;

/// Returns the mannequin with its moves.
fn moving() -> Vec<u8> {
    Mannequin::new().with_moves().glb(|_| PAPER_AXES).expect("orthonormal axes")
}

fn place_of_moves() -> Place {
    let place = Place::new();
    place.write("m.glb", &moving());
    place
}

/// Returns the part of the report about a clip.
fn cost<'r>(report: &'r Value, clip: &str) -> &'r Value {
    list(&report["clips"]).iter().find(|cost| cost["clip"] == clip).unwrap_or_else(|| panic!("{clip}: {report}"))
}

/// Returns the size of a clip's keys in a file, in bytes, counting shared accessors once.
fn key_bytes(glb: &[u8], clip: &str) -> usize {
    let (json, _) = take_apart(glb);
    let clip = list(&json["animations"]).iter().find(|animation| animation["name"] == clip).expect("the clip");
    let mut used: Vec<u64> = list(&clip["samplers"])
        .iter()
        .flat_map(|sampler| [&sampler["input"], &sampler["output"]])
        .map(|at| at.as_u64().expect("an index"))
        .collect();
    used.sort_unstable();
    used.dedup();
    let size = |at: u64| {
        let accessor = &json["accessors"][usize::try_from(at).expect("small")];
        let width = match accessor["type"].as_str() {
            Some("SCALAR") => 1,
            Some("VEC3") => 3,
            Some("VEC4") => 4,
            other => panic!("{other:?}"),
        };
        let part = if accessor["componentType"] == 5126 { 4 } else { 2 };
        width * part * usize::try_from(accessor["count"].as_u64().expect("a count")).expect("small")
    };
    used.into_iter().map(size).sum()
}

/// Returns the sorted key times of a clip's channels, counting shared accessors once.
fn key_times(model: &Model, clip: &str) -> Vec<f64> {
    let clip = &model.json["animations"][model.clip_index(clip).expect("the clip")];
    let inputs = list(&clip["samplers"]).iter().map(|sampler| sampler["input"].as_u64().expect("an index"));
    let mut times: Vec<f64> = inputs.flat_map(|at| model.accessor(usize::try_from(at).expect("small"))).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// Returns the world transforms of all nodes at a time of a clip.
fn world(model: &Model, clip: &str, t: f64) -> Vec<DMat4> {
    world_of(model, &model.clip(model.clip_index(clip).expect("the clip")), t)
}

fn world_of(model: &Model, clip: &crate::common::gltf::Clip, t: f64) -> Vec<DMat4> {
    let pose = model.pose(clip, t);
    let mut world: Vec<Option<DMat4>> = vec![None; pose.len()];
    fn place(model: &Model, pose: &[crate::common::gltf::Local], world: &mut [Option<DMat4>], node: usize) -> DMat4 {
        if let Some(known) = world[node] {
            return known;
        }
        let local = pose[node].matrix();
        let found = model.parent(node).map_or(local, |parent| place(model, pose, world, parent) * local);
        world[node] = Some(found);
        found
    }
    (0..pose.len()).map(|node| place(model, &pose, &mut world, node)).collect()
}

fn joint(world: &DMat4) -> DVec3 {
    world.transform_point3(DVec3::ZERO)
}

/// Returns the largest distance between a joint in one file's clip and in the other's, at all keys and between them.
fn furthest(before: &[u8], after: &[u8], clip: &str) -> f64 {
    let (before, after) = (Model::new(before), Model::new(after));
    let mut times: Vec<f64> = key_times(&before, clip).into_iter().chain(key_times(&after, clip)).collect();
    times.sort_by(f64::total_cmp);
    let between: Vec<f64> = times.windows(2).map(|pair| 0.37 * pair[0] + 0.63 * pair[1]).collect();
    let clips = [&before, &after].map(|model| model.clip(model.clip_index(clip).expect("the clip")));
    let at = |model: &Model, clip, t| -> Vec<DVec3> { world_of(model, clip, t).iter().map(joint).collect() };
    let off = |t: f64| {
        let (was, is) = (at(&before, &clips[0], t), at(&after, &clips[1], t));
        was.iter().zip(is).map(|(was, is)| was.distance(is)).fold(0.0, f64::max)
    };
    times.into_iter().chain(between).map(off).fold(0.0, f64::max)
}

#[test]
fn without_options_the_cost_of_each_clip_is_told_and_nothing_written() {
    let place = place_of_moves();
    let said = place.done("clip m.glb --report r.json").stdout;
    assert_eq!(place.names(), ["m.glb", "r.json"]);
    let report = place.json("r.json");
    let glb = place.read("m.glb");
    let model = Model::new(&glb);
    let names: Vec<&str> =
        list(&model.json["animations"]).iter().map(|clip| clip["name"].as_str().expect("a name")).collect();
    assert_eq!(names.len(), list(&report["clips"]).len());
    for name in names {
        let cost = cost(&report, name);
        let bytes = key_bytes(&glb, name);
        let length = model.clip(model.clip_index(name).expect("a clip")).seconds;
        assert_eq!(cost["before"]["key_bytes"], bytes, "{name}");
        assert!((number(&cost["length_s"]) - length).abs() < 1e-6, "{name}");
        let a_second = number(&cost["before"]["key_bytes_a_second"]);
        assert!((a_second * length / f64::from(u32::try_from(bytes).expect("small")) - 1.0).abs() < 1e-5, "{name}");
        let tracks: u64 = ["moving", "constant", "at_rest"]
            .iter()
            .map(|kind| cost["before"]["tracks"][kind].as_u64().expect("a number"))
            .sum();
        let at = model.clip_index(name).expect("a clip");
        assert_eq!(usize::try_from(tracks).ok(), Some(list(&model.json["animations"][at]["channels"]).len()), "{name}");
        let bones: f64 = list(&cost["bones"])
            .iter()
            .flat_map(|bone| bone["before"].as_object().expect("kinds").values())
            .map(number)
            .sum();
        assert!((bones - f64::from(u32::try_from(bytes).expect("small"))).abs() < 1e-6, "{name}: {bones} of {bytes}");
        let row =
            said.lines().find(|line| line.split_whitespace().next() == Some(name)).unwrap_or_else(|| panic!("{said}"));
        assert!(row.contains('%'), "{row}");
        assert_eq!((&cost["reduced"]["proposed"], &cost["mended"]), (&true.into(), &Value::Null), "{name}");
    }
    assert!(said.starts_with("clip ") && said.lines().next().is_some_and(|head| head.ends_with("share")), "{said}");
    assert!(said.contains("--reduce 1mm"), "{said}");
    assert_eq!(report["out"], Value::Null);
}

#[test]
fn tracks_are_moving_constant_or_at_rest() {
    let document = Document::from_bytes(&crate::common::mannequin()).expect("a model");
    let find = |name: &str| document.skeleton().find(name).expect("a bone");
    let rest = |name: &str| document.skeleton().rest()[find(name)];
    let still = |value: Vec3| Track::linear([0.0, 1.0], [value; 2]).expect("a track");
    let clip = Clip::new("few")
        .with_translation(find("head"), still(rest("head").translation))
        .with_translation(find("neck"), still(rest("neck").translation * 1.1))
        .with_rotation(find("neck"), Track::constant(-rest("neck").rotation).expect("a track"))
        .with_scale(find("head"), Track::linear([0.0, 1.0], [Vec3::ONE, Vec3::ONE * 1.1]).expect("a track"));
    let place = Place::new();
    place.write("few.glb", &document.with_clips(&[clip]).expect("it can be written"));
    place.done("clip few.glb --clip few --report r.json");
    let report = place.json("r.json");
    assert_eq!(list(&report["clips"]).len(), 1);
    let tracks = &cost(&report, "few")["before"]["tracks"];
    assert_eq!([&tracks["moving"], &tracks["constant"], &tracks["at_rest"]], [1, 1, 2], "{tracks}");
}

#[test]
fn a_reduced_file_is_smaller_and_within_its_tolerance() {
    let place = place_of_moves();
    let old = place.read("m.glb");
    let mut sizes = vec![old.len()];
    for tolerance in [0.2, 1.0, 5.0] {
        let said = place.done(&format!("clip m.glb --reduce {tolerance}mm --out s.glb --report r.json")).stdout;
        let (new, report) = (place.read("s.glb"), place.json("r.json"));
        assert!(said.contains("wrote s.glb"), "{said}");
        assert_eq!(report["file_bytes"], serde_json::json!([old.len(), new.len()]));
        sizes.push(new.len());
        for cost in list(&report["clips"]) {
            let name = cost["clip"].as_str().expect("a name");
            assert_eq!(cost["after"]["key_bytes"], key_bytes(&new, name), "{name}");
            let mm = number(&report["millimetre"]);
            let (told, found) = (number(&cost["reduced"]["error_mm"]), furthest(&old, &new, name) / mm);
            assert!(
                found <= told * 1.001 + 1e-3 && told <= tolerance,
                "{name} at {tolerance} mm: {found}, {told} is told"
            );
            let seconds = |glb: &[u8]| {
                let model = Model::new(glb);
                model.clip(model.clip_index(name).expect("a clip")).seconds
            };
            assert!((seconds(&old) - seconds(&new)).abs() < 1e-6, "{name}");
        }
    }
    assert!(sizes.windows(2).all(|pair| pair[1] < pair[0]), "{sizes:?}");
    let sum = |glb: &[u8]| ["walk", "walk_ahead", "run", "wave"].iter().map(|name| key_bytes(glb, name)).sum::<usize>();
    place.done("clip m.glb --reduce 1mm --out s.glb");
    assert!(sum(&place.read("s.glb")) * 2 <= sum(&old), "{} of {}", sum(&place.read("s.glb")), sum(&old));
}

#[test]
fn one_clip_is_reduced_and_the_others_stay() {
    let place = place_of_moves();
    place.done("clip m.glb --clip walk --reduce 1mm --out s.glb");
    let (old, new) = (place.read("m.glb"), place.read("s.glb"));
    assert!(key_bytes(&new, "walk") < key_bytes(&old, "walk") && new.len() < old.len());
    for name in ["run", "wave"] {
        assert_eq!(key_bytes(&old, name), key_bytes(&new, name));
        assert!(furthest(&old, &new, name) < 1e-9, "{name}");
    }
    // Overwriting its own input.
    place.done("clip s.glb --clip run --clip wave --reduce 1mm --out s.glb");
    assert!(key_bytes(&place.read("s.glb"), "run") < key_bytes(&old, "run"));
    assert_eq!(place.names(), ["m.glb", "s.glb"]);
}

#[test]
fn pinned_poses_stay() {
    let place = place_of_moves();
    place.done("clip m.glb --clip run --reduce 20mm --out loose.glb");
    place.done("clip m.glb --clip run --reduce 20mm --pin 0.13,0.3 --out s.glb --report r.json");
    let models = ["m.glb", "s.glb", "loose.glb"].map(|name| Model::new(&place.read(name)));
    let off = |model: &Model, t: f64| {
        let (was, is) = (world(&models[0], "run", t), world(model, "run", t));
        was.iter().zip(&is).map(|(was, is)| joint(was).distance(joint(is))).fold(0.0, f64::max)
    };
    for t in [0.13_f32, 0.3] {
        let t = f64::from(t);
        assert!(off(&models[1], t) < 2e-5, "{} at {t}", off(&models[1], t));
        assert!(off(&models[2], t) > 1e-4, "without a pin it would be elsewhere: {}", off(&models[2], t));
    }
    assert_eq!(list(&cost(&place.json("r.json"), "run")["reduced"]["pins"]).len(), 2);
}

#[test]
fn a_clip_that_stands_still_keeps_its_length() {
    let document = Document::from_bytes(&crate::common::mannequin()).expect("a model");
    let head = document.skeleton().find("head").expect("a head");
    let rest = document.skeleton().rest()[head];
    let place = Place::new();
    for (name, turn) in [("rest", rest.rotation), ("stare", aim_runtime::glam::Quat::from_rotation_x(0.3))] {
        let clip = Clip::new(name).with_rotation(head, Track::linear([0.0, 1.0, 2.5], [turn; 3]).expect("a track"));
        place.write("still.glb", &document.with_clips(&[clip]).expect("it can be written"));
        place.done(&format!("clip still.glb --clip {name} --reduce 1mm --out s.glb"));
        let [was, is] = ["still.glb", "s.glb"].map(|name| Model::new(&place.read(name)));
        let seconds = is.clip(is.clip_index(name).expect("the clip is there")).seconds;
        assert_eq!(seconds.to_bits(), 2.5_f64.to_bits(), "{name}");
        let [was, is] = [&was, &is].map(|model| world(model, name, 1.7));
        assert!(was.iter().zip(&is).all(|(was, is)| was.abs_diff_eq(*is, 1e-5)), "{name}");
    }
}

/// Returns a track that swings there and back, with 30 keys per second.
fn swing(seconds: u8, turn: impl Fn(f32) -> aim_runtime::glam::Quat) -> Track<aim_runtime::glam::Quat> {
    let times: Vec<f32> = (0..=30 * seconds).map(|k| f32::from(k) / 30.0).collect();
    let turns: Vec<_> = times.iter().map(|t| turn((3.0 * t).sin())).collect();
    Track::linear(times, turns).expect("a track")
}

/// A clip that a constant track makes longer than its movement keeps its length when reduced.
#[test]
fn what_moves_is_not_replaced_where_what_stands_still_was_longer() {
    let document = Document::from_bytes(&crate::common::mannequin()).expect("a model");
    let (first, neck) = (0, document.skeleton().find("neck").expect("a bone"));
    let rest = document.skeleton().rest();
    let still = Track::linear([0.0, 2.0], [rest[neck].translation; 2]).expect("a track");
    let turned = swing(1, |a| rest[first].rotation * aim_runtime::glam::Quat::from_rotation_z(a));
    let moved: Vec<Vec3> =
        turned.times().iter().map(|t| rest[first].translation * (1.0 + 0.1 * (4.0 * t).sin())).collect();
    let moved = Track::linear(turned.times(), moved).expect("a track");
    let grown: Vec<Vec3> = turned.times().iter().map(|t| Vec3::splat(1.0 + 0.1 * (5.0 * t).sin())).collect();
    let grown = Track::linear(turned.times(), grown).expect("a track");
    let turns = Clip::new("held").with_translation(neck, still).with_rotation(first, turned);
    let moves = turns.clone().with_translation(first, moved);
    let grows = moves.clone().with_scale(first, grown);
    let place = Place::new();
    for (what, clip) in [("turns", turns), ("moves", moves), ("grows", grows)] {
        place.write("m.glb", &document.with_clips(&[clip]).expect("it can be written"));
        let ran = place.aim("clip m.glb --clip held --reduce 1mm --out s.glb --report r.json");
        assert_eq!(ran.code, 0, "{what}: {ran:?}");
        let (old, new, report) = (place.read("m.glb"), place.read("s.glb"), place.json("r.json"));
        let told = number(&cost(&report, "held")["reduced"]["error_mm"]);
        let found = furthest(&old, &new, "held") / number(&report["millimetre"]);
        assert!(told <= 1.0 && found <= 1.0, "{what}: {found} mm, {told} is told");
        let seconds = |glb: &[u8]| {
            let model = Model::new(glb);
            model.clip(model.clip_index("held").expect("a clip")).seconds
        };
        assert_eq!([seconds(&old), seconds(&new)], [2.0, 2.0], "{what}");
    }
}

/// Returns a node with a triangle, two morph targets, and two clips of their weights: a smooth one and one with steps.
/// A constant track of the node is longer than the weights.
fn face() -> Vec<u8> {
    let json = serde_json::json!({
        "asset": { "version": "2.0" },
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "name": "face", "mesh": 0 }],
        "meshes": [{
            "weights": [0, 0],
            "primitives": [{ "attributes": { "POSITION": 0 }, "targets": [{ "POSITION": 0 }, { "POSITION": 0 }] }],
        }],
        "accessors": [{ "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0] }],
    });
    let document = Document::from_bytes(&serde_json::to_vec(&json).expect("JSON")).expect("a model");
    let times: Vec<f32> = (0..=60_u8).map(|k| f32::from(k) / 30.0).collect();
    let weight = |of: fn(f32) -> f32| times.iter().copied().map(of).collect::<Vec<f32>>();
    let linear = |values: Vec<f32>| Track::linear(&times[..], values).expect("a track");
    let step = |values: Vec<f32>| Track::step(&times[..], values).expect("a track");
    let still = Track::linear([0.0, 2.5], [Vec3::ZERO; 2]).expect("a track");
    let smile = Clip::new("smile")
        .with_scalar(0, linear(weight(|t| 0.5 + 0.5 * (3.0 * t).sin())))
        .with_scalar(1, linear(weight(|t| 0.5 + 0.5 * (2.1 * t).cos())))
        .with_translation(0, still);
    let blink = Clip::new("blink")
        .with_scalar(0, step(weight(|t| if t > 1.49 { 1.0 } else { 0.0 })))
        .with_scalar(1, step(weight(|t| if (0.49..0.79).contains(&t) { 1.0 } else { 0.0 })));
    document.with_clips(&[smile, blink]).expect("it can be written")
}

#[test]
fn reduced_weights_are_what_they_were() {
    let place = Place::new();
    place.write("m.glb", &face());
    let ran = place.aim("clip m.glb --reduce 1mm --forward +Z --up +Y --out s.glb --report r.json");
    assert_eq!(ran.code, 0, "{ran:?}");
    assert!(ran.stdout.contains("morph weight error at most 0.0"), "{}", ran.stdout);
    let [was, is] = ["m.glb", "s.glb"].map(|name| Document::from_bytes(&place.read(name)).expect("a model"));
    for (name, seconds) in [("smile", 2.5), ("blink", 2.0)] {
        let [was, is] = [&was, &is].map(|document| document.clip(name).expect("the clip"));
        assert_eq!((was.length_s(), is.length_s()), (seconds, seconds), "{name}");
        let mut found = 0.0_f64;
        for ((_, was), (_, is)) in was.scalars().iter().zip(is.scalars()) {
            // A dense grid, and each key with the time just before it.
            let grid = (0..1300_u16).map(|k| f32::from(k) / 500.0);
            let keys = was.times().iter().chain(is.times()).flat_map(|t| [*t, t.next_down().max(0.0)]);
            let off = grid.chain(keys).map(|t| f64::from((was.sample(t) - is.sample(t)).abs()));
            found = off.fold(found, f64::max);
        }
        let report = place.json("r.json");
        let told = number(&cost(&report, name)["reduced"]["weights_error"]);
        assert!(
            found <= 1.001e-3 && told <= 1.001e-3 && found <= told * 1.05 + 1e-6,
            "{name}: {found}, {told} is told"
        );
        let bytes = |side: &str| cost(&report, name)[side]["key_bytes"].as_u64().expect("bytes");
        assert!(bytes("after") < bytes("before"), "{name}: {} of {}", bytes("after"), bytes("before"));
    }
}

/// Returns half of the mannequin's walk, which ends elsewhere than it begins.
fn half_a_walk() -> Vec<u8> {
    let document = Document::from_bytes(&moving()).expect("a model");
    let half = document.clip("walk_ahead").expect("a clip").cut(0.1, 0.6).with_name("half");
    document.with_clips(&[half]).expect("it can be written")
}

#[test]
fn a_loop_is_mended_in_place_and_speed() {
    let place = Place::new();
    place.write("h.glb", &half_a_walk());
    let said = place.done("clip h.glb --clip half --loop --out l.glb --report r.json").stdout;
    let report = place.json("r.json");
    let (before, after) = (&cost(&report, "half")["before"]["seam"], &cost(&report, "half")["after"]["seam"]);
    assert!(number(&before["deg"]["most"]) > 5.0 && number(&after["deg"]["most"]) < 0.05, "{before}\n{after}");
    assert!(number(&before["deg_s"]["most"]) > 20.0 && number(&after["deg_s"]["most"]) < 1.0, "{before}\n{after}");
    assert!(said.contains("seam after  ") && said.contains("loop  mended"), "{said}");
    assert!(said.contains("--reduce to shrink them"), "{said}");
    assert_eq!(cost(&report, "half")["mended"], true);
    // Rotations only: without the hips, whose movement continues.
    let turns = |name: &str, t: f64| -> Vec<DQuat> {
        let model = Model::new(&place.read(name));
        let clip = model.clip(model.clip_index("half").expect("the clip"));
        let mut pose = model.pose(&clip, t);
        pose.remove(model.node("hips"));
        pose.iter().map(|local| local.rotation).collect()
    };
    let apart = |name: &str| {
        let ends = turns(name, 0.0).into_iter().zip(turns(name, 0.5));
        ends.map(|(a, b)| a.angle_between(b).to_degrees()).fold(0.0, f64::max)
    };
    assert!(apart("h.glb") > 5.0 && apart("l.glb") < 0.1, "{} {}", apart("h.glb"), apart("l.glb"));
    // A clip that already loops is left as it is.
    place.write("m.glb", &moving());
    let said = place.done("clip m.glb --clip walk --loop --out w.glb --report r.json").stdout;
    assert_eq!(place.read("w.glb"), place.read("m.glb"));
    assert!(said.contains("loop  unchanged"), "{said}");
    assert_eq!(cost(&place.json("r.json"), "walk")["mended"], false);
}

#[test]
fn what_is_taken_out_and_what_is_left_are_the_clip_again() {
    let place = place_of_moves();
    let source = Model::new(&moving());
    let hips = source.node("hips");
    let on_hips = |node: usize| std::iter::successors(Some(node), |node| source.parent(*node)).any(|node| node == hips);
    for clip in ["walk_ahead", "walk_circle", "turn"] {
        for kind in ["linear", "composite", "delta"] {
            place.done(&format!("clip m.glb --clip {clip} --extract {kind} --out o.glb --report r.json"));
            let (model, left) = (Model::new(&place.read("m.glb")), Model::new(&place.read("o.glb")));
            let told = place.json("r.json");
            let extracted = &cost(&told, clip)["extracted"];
            let seconds = number(&extracted["seconds"]);
            let whole: Vec<f64> = list(&extracted["translation"]).iter().map(number).collect();
            let [was, is] = [[&model; 2], [&left; 2]].map(|both| [0.0, seconds].map(|t| world(both[0], clip, t)[hips]));
            // In place: the hips end at their starting position.
            let level = |world: &DMat4| joint(world) * (DVec3::X + DVec3::Z);
            assert!(level(&is[0]).distance(level(&is[1])) < 1e-3, "{clip} {kind}: {} {}", is[0], is[1]);
            assert!(level(&was[0]).distance(level(&is[0])) < 1e-3, "{clip} {kind}: begins where it began");
            // M(end), from the original and the extracted clip: a rotation about the vertical by the reported angle.
            let motion = was[1] * is[1].inverse();
            let told_turn = number(&extracted["turn_deg"]);
            let turn = DQuat::from_mat4(&motion).angle_between(DQuat::IDENTITY).to_degrees();
            assert!((turn - told_turn).abs() < 0.1, "{clip} {kind}: {turn}°, {told_turn}° is told");
            assert!(joint(&motion).distance(DVec3::from_slice(&whole)) < 2e-3, "{clip} {kind}: {motion} {whole:?}");
            let path = extracted.get("path").map(list).unwrap_or_default();
            assert_eq!(path.len() > 10, kind == "delta");
            for at in path.iter().step_by(7) {
                let numbers = |key: &str| list(&at[key]).iter().map(number).collect::<Vec<_>>();
                let rotation = DQuat::from_slice(&numbers("rotation"));
                let motion = DMat4::from_rotation_translation(rotation, DVec3::from_slice(&numbers("translation")));
                let t = number(&at["t"]);
                let (was, is) = (world(&model, clip, t), world(&left, clip, t));
                let carried = (0..was.len()).filter(|node| on_hips(*node));
                let off =
                    carried.map(|node| joint(&was[node]).distance(joint(&(motion * is[node])))).fold(0.0, f64::max);
                assert!(off < 2e-3, "{clip}: {off} at {t}");
                assert!(
                    level(&is[hips]).distance(level(&world(&left, clip, 0.0)[hips])) < 2e-3,
                    "{clip}: stands at {t}"
                );
            }
        }
    }
    // The reported speed is that of the hips in the clip.
    place.done("clip m.glb --clip walk_ahead --report r.json");
    let model = Model::new(&place.read("m.glb"));
    let [start, end] = [0.0, 1.1].map(|t| joint(&world(&model, "walk_ahead", t)[hips]));
    let told = number(&cost(&place.json("r.json"), "walk_ahead")["root"]["speed"]);
    assert!((start.distance(end) / 1.1 - told).abs() < 1e-3, "{told}");
}

#[test]
fn what_is_in_place_stays_as_it_is() {
    let place = place_of_moves();
    for kind in ["linear", "composite"] {
        let said = place.done(&format!("clip m.glb --clip walk --extract {kind} --out o.glb --report r.json")).stdout;
        assert!(said.contains("nothing to extract") && !said.contains("extracted as"), "{said}");
        assert_eq!(place.read("o.glb"), place.read("m.glb"), "{kind}");
        assert_eq!(cost(&place.json("r.json"), "walk")["extracted"]["nothing"], true);
    }
    place.done("clip m.glb --clip walk_ahead --extract linear --report r.json");
    assert_eq!(cost(&place.json("r.json"), "walk_ahead")["extracted"]["nothing"], false);
}

#[test]
fn a_tolerance_of_nothing_leaves_out_what_changes_nothing() {
    let place = place_of_moves();
    place.done("clip m.glb --reduce 0mm --out s.glb --report r.json --html r.html");
    let page = String::from_utf8(place.read("r.html")).expect("a page is text");
    assert!(!page.contains("NaN") && !page.contains("inf"), "the page");
    let report = place.json("r.json");
    for cost in list(&report["clips"]) {
        assert!(number(&cost["reduced"]["error_mm"]) <= 1e-3, "{cost}");
        assert!(cost["after"]["key_bytes"].as_u64() <= cost["before"]["key_bytes"].as_u64(), "{cost}");
    }
}

#[test]
fn the_size_that_is_told_is_that_of_the_file() {
    let (json, bin) = take_apart(&moving());
    // With whitespace and unreferenced bytes, which a rewritten file would not keep.
    let mut text = serde_json::to_vec_pretty(&json).expect("JSON");
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut glb = b"glTF".to_vec();
    let length = 28 + text.len() + bin.len();
    for number in [2, length, text.len(), 0x4e4f_534a] {
        glb.extend(u32::try_from(number).expect("small").to_le_bytes());
    }
    glb.extend(&text);
    for number in [bin.len(), 0x004e_4942] {
        glb.extend(u32::try_from(number).expect("small").to_le_bytes());
    }
    glb.extend(&bin);
    assert_eq!(glb.len(), length);
    let place = Place::new();
    place.write("m.glb", &glb);
    let said = place.done("clip m.glb --report r.json").stdout;
    assert_eq!(place.json("r.json")["file_bytes"][0], length, "{said}");
}

#[test]
fn all_changes_are_one() {
    let place = Place::new();
    place.write("h.glb", &half_a_walk());
    let all = "clip h.glb --clip half --extract delta --loop --reduce 1mm --pin 0.25";
    place.done(&format!("{all} --out o.glb --report r.json"));
    let report = place.json("r.json");
    let cost = cost(&report, "half");
    assert!(number(&cost["reduced"]["error_mm"]) <= 1.0, "{cost}");
    assert!(number(&cost["after"]["seam"]["mm"]["most"]) < 1.5, "{}", cost["after"]["seam"]);
    place.done("clip h.glb --clip half --extract delta --loop --out whole.glb");
    assert!(key_bytes(&place.read("o.glb"), "half") * 2 < key_bytes(&place.read("whole.glb"), "half"), "{cost}");
    // The same without an output file.
    let place2 = Place::new();
    place2.write("h.glb", &half_a_walk());
    let said = place2.done(&format!("{all} --report r.json")).stdout;
    assert_eq!(place2.names(), ["h.glb", "r.json"]);
    assert!(said.contains("write it with --out"), "{said}");
    assert_eq!(place2.json("r.json")["file_bytes"], report["file_bytes"]);
}

#[test]
fn a_page_shows_each_clip() {
    let place = place_of_moves();
    place.done("clip m.glb --reduce 1mm --html r.html");
    let text = String::from_utf8(place.read("r.html")).expect("a page is text");
    let page = scraper::Html::parse_document(&text);
    assert!(page.errors.is_empty(), "{:?}", page.errors);
    let count = |selector: &str| page.select(&scraper::Selector::parse(selector).expect("a selector")).count();
    let clips = list(&Model::new(&moving()).json["animations"]).len();
    assert_eq!((count("h2"), count(".chart"), count(".costs tbody tr")), (clips, 3 * clips, clips));
    assert_eq!(count("svg"), count("svg[aria-label], svg[aria-hidden]"), "every drawing is named or an ornament");
    assert!(count(".bars .bar.after") > clips && count(".bars .ticks") > 4 * clips);
    assert!(text.len() < 60_000 * clips, "{} bytes", text.len());
}

#[test]
fn names_of_files_are_escaped() {
    let (mut json, bin) = take_apart(&crate::common::mannequin());
    json["animations"][0]["name"] = "<b>&walk</b>".into();
    let node = list(&json["nodes"]).iter().position(|node| node["name"] == "head").expect("a head");
    json["nodes"][node]["name"] = "<i>a head with a long name</i>".into();
    let place = Place::new();
    place.write("odd.glb", &put_together(&json, &bin));
    place.done("clip odd.glb --html r.html");
    let text = String::from_utf8(place.read("r.html")).expect("a page is text");
    assert!(text.contains("&lt;b&gt;") && !text.contains("<b>") && !text.contains("<i>"));
}

#[test]
fn a_bake_can_be_reduced() {
    let place = Place::with_mannequin();
    let bake = |rest: &str| format!("bake m.glb --target orbit:2,0.2,6 --seconds 6 --report r.json {rest}");
    place.done(&bake("--out whole.glb"));
    assert_eq!(place.json("r.json").get("reduction"), None);
    let said = place.done(&bake("--reduce 1mm --out small.glb")).stdout;
    let told = &place.json("r.json")["reduction"];
    let (whole, small) = (place.read("whole.glb"), place.read("small.glb"));
    let clip = "walk_aimed";
    assert_eq!(told["key_bytes"], serde_json::json!([key_bytes(&whole, clip), key_bytes(&small, clip)]));
    assert!(key_bytes(&small, clip) * 3 < key_bytes(&whole, clip) * 2 && small.len() < whole.len(), "{told}");
    assert!(said.contains("keys reduced from") && said.contains("° before reduction)"), "{said}");
    place.done("clip whole.glb --report c.json");
    let mm = number(&place.json("c.json")["millimetre"]);
    assert!(number(&told["error_mm"]) <= 1.0 && furthest(&whole, &small, clip) <= 1.001 * mm, "{told}");
    // Gaze direction: 1 mm at 1 m.
    let [was, is] = [&whole, &small].map(|glb| Model::new(glb));
    let eye = was.node("left_eye");
    let direction = |model: &Model, t: f64| DQuat::from_mat4(&world(model, clip, t)[eye]);
    let off = (0..=360_u16).map(|frame| {
        let t = f64::from(frame) / 60.0;
        direction(&was, t).angle_between(direction(&is, t)).to_degrees()
    });
    let off = off.fold(0.0, f64::max);
    let gaze = number(&told["gaze_error_deg"]);
    assert!(gaze < 0.07 && gaze <= off + 1e-3, "{gaze}° told, turned by {off}°");
    place.done("bake m.glb --target 1,1.6,2 --seconds 0.5 --report r.json --out whole.glb --html r.html --reduce 1mm");
    assert!(String::from_utf8(place.read("r.html")).expect("text").contains("keys reduced from"));
}

#[test]
fn what_cannot_be_used_is_said() {
    let place = place_of_moves();
    let with = |rest: &str| format!("clip m.glb {rest}");
    for (rest, words) in [
        ("--clip wlak", &["wlak", "walk"][..]),
        ("--reduce 1 --out o.glb", &["--reduce", "did you mean 1mm?"]),
        ("--reduce 1cm --out o.glb", &["--reduce", "did you mean 10mm?"]),
        ("--reduce 2000mm --out o.glb", &["--reduce", "at most 1000mm"]),
        ("--reduce -1mm --out o.glb", &["--reduce", "1mm"]),
        ("--reduce infmm --out o.glb", &["--reduce", "1mm"]),
        ("--reduce NaNmm --out o.glb", &["--reduce", "1mm"]),
        ("--reduce 1m --out o.glb", &["--reduce", "1mm"]),
        ("--pin 0.1", &["--reduce"]),
        ("--reduce 1mm --pin a --out o.glb", &["--pin", "expected seconds separated by commas, such as 0.2,0.42"]),
        ("--reduce 1mm --pin 0.2, --out o.glb", &["--pin", "expected seconds"]),
        ("--json", &["--json", "--report"]),
        ("--reduce 1mm --pin 9 --out o.glb", &["m.glb", "9 s", "walk", "--clip"]),
        ("--reduce 1mm --pin -0.1 --out o.glb", &["-0.1 s"]),
        ("--reduce 1mm --pin NaN --out o.glb", &["NaN s"]),
        ("--extract screw", &["screw", "composite"]),
        ("--out o.glb", &["o.glb", "--reduce", "--loop", "--extract"]),
        ("--reduce 1mm --out o.gltf", &["o.gltf", ".glb"]),
        ("--report o.html", &["o.html", ".json"]),
        ("--html o.json", &["o.json", ".html"]),
        ("--report m.glb", &["used twice"]),
        ("--loop --out o.glb --report o.glb", &["used twice"]),
        ("--loop --out o.glb --report nowhere/r.json", &["nowhere"]),
    ] {
        place.refused(&with(rest), words);
        assert_eq!(place.names(), ["m.glb"], "{rest}");
    }
    place.refused("clip gone.glb", &["gone.glb"]);
    let still = crate::common::changed(|json| {
        json.as_object_mut().expect("an object").remove("animations");
    });
    place.write("still.glb", &still);
    place.refused("clip still.glb", &["still.glb", "no clips"]);
    let door =
        Document::from_bytes(br#"{ "asset": { "version": "2.0" }, "nodes": [{ "name": "door" }] }"#).expect("a node");
    let open = [0.0, 1.0].map(aim_runtime::glam::Quat::from_rotation_y);
    let open = Clip::new("open").with_rotation(0, Track::linear([0.0, 1.0], open).expect("a track"));
    place.write("door.glb", &door.with_clips(&[open]).expect("it can be written"));
    place.refused("clip door.glb --extract linear --out o.glb", &["door.glb", "open", "hips"]);
    place.done("clip door.glb --reduce 1mm --loop --out o.glb --html r.html");
}

#[test]
fn clips_of_one_name_are_told_of() {
    let (mut json, bin) = take_apart(&moving());
    json["animations"][1]["name"] = json["animations"][0]["name"].clone();
    let place = Place::new();
    place.write("two.glb", &put_together(&json, &bin));
    let said = place.aim("clip two.glb --reduce 1mm --out o.glb");
    assert!(said.code == 0 && said.stderr.contains("several clips named \"walk\""), "{said:?}");
}

/// Returns the character files in a folder.
fn files(folder: &Path) -> Vec<std::path::PathBuf> {
    let entries =
        std::fs::read_dir(folder).expect("the folder can be listed").map(|entry| entry.expect("an entry").path());
    let mut files: Vec<_> =
        entries.filter(|path| path.extension().is_some_and(|end| end == "glb" || end == "gltf")).collect();
    files.sort();
    files
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn every_character_is_reduced_within_a_millimetre() {
    let (mut before, mut after) = (0, 0);
    for file in files(&crate::common::real_rigs()) {
        let place = Place::new();
        let arguments = ["clip".as_ref(), file.as_os_str()].into_iter();
        let options =
            ["--reduce", "1mm", "--out", "s.glb", "--report", "r.json", "--html", "r.html"].map(AsRef::as_ref);
        let ran = place.run(arguments.chain(options));
        assert!(ran.code == 0 && ran.only_warns(), "{}: {ran:?}", file.display());
        let report = place.json("r.json");
        let new = place.read("s.glb");
        let document = Document::load(&file).expect("a model");
        let old = document.with_clips(&[]).expect("it can be written");
        assert!(new.len() < old.len(), "{}: {} bytes of {}", file.display(), new.len(), old.len());
        for cost in list(&report["clips"]) {
            let name = cost["clip"].as_str().expect("a name");
            let told = number(&cost["reduced"]["error_mm"]);
            assert!(told <= 1.0, "{} {name}: {told} mm", file.display());
            if Document::from_bytes(&old).expect("a model").clips().iter().all(|clip| !clip.name().starts_with("clip"))
            {
                let found = furthest(&old, &new, name) / number(&report["millimetre"]);
                assert!(found <= 1.001 * told + 1e-3, "{} {name}: {found} mm, {told} is told", file.display());
            }
            let bytes = |side: &str| cost[side]["key_bytes"].as_u64().expect("bytes");
            println!("{} {name}: {} of {}, {told:.3} mm", file.display(), bytes("after"), bytes("before"));
            before += bytes("before");
            after += bytes("after");
        }
        println!("{}: file {} of {}", file.display(), new.len(), old.len());
    }
    println!("{after} of {before} bytes of keys");
    assert!(after * 100 <= before * 35, "{after} of {before}");
}
