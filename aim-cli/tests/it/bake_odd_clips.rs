//! Clips as exporters write them: steps, splines, jumps, duplicate channels, or no clip at all.

use crate::common::forward::{Bake, list};
use crate::common::rig::joints;
use crate::common::{Place, changed};
use serde_json::{Value, json};

/// Bakes this model and checks everything; returns the output's JSON.
#[track_caller]
fn bake(model: &[u8], options: &str) -> Value {
    let place = Place::with_mannequin();
    place.write("m.glb", model);
    place.done(&format!("bake m.glb --rig m.toml --out out.glb --report r.json {options}"));
    let rig = String::from_utf8(place.read("m.toml")).expect("text");
    let (output, report) = (place.read("out.glb"), place.json("r.json"));
    Bake { source: model, output: &output, report: &report, joints: Some(&joints(&rig)) }.check();
    crate::common::gltf::take_apart(&output).0
}

const ORBIT: &str = "--target orbit:2,0.2,8";

#[test]
fn a_channel_there_twice_counts_once_the_last() {
    let model = changed(|json| {
        let channels = json["animations"][0]["channels"].as_array_mut().expect("channels");
        // Insert, before the neck's channel, another channel of its rotation with a different bone's keys. The last one
        // applies.
        let neck = channels.iter().position(|channel| channel["target"]["node"] == 5).expect("the neck moves");
        let mut other = channels[neck].clone();
        other["sampler"] = json!(neck + 1);
        channels.insert(0, other);
    });
    bake(&model, ORBIT);
}

#[test]
fn of_several_clips_the_idle_one_is_taken_and_said() {
    let place = Place::with_mannequin();
    let named = |names: &[&str]| {
        changed(|json| {
            let clip = json["animations"][0].clone();
            let clips = names.iter().map(|name| {
                let mut clip = clip.clone();
                clip["name"] = json!(name);
                clip
            });
            json["animations"] = clips.collect();
        })
    };
    for (names, taken) in [(&["Death", "Hero|Idle", "idle"][..], "Hero|Idle"), (&["Death", "Run"], "Death")] {
        place.write("m.glb", &named(names));
        let told = place.done(&format!("bake m.glb --rig m.toml --out out.glb --report r.json {ORBIT}")).stderr;
        assert!(told.contains(&format!("using {taken:?}")) && told.contains("--clip"), "{told}");
        assert_eq!(place.json("r.json")["clip"], format!("{taken}_aimed"));
    }
    place.write("m.glb", &named(&["Death"]));
    let told = place.done(&format!("bake m.glb --rig m.toml --out out.glb {ORBIT}")).stderr;
    assert!(!told.contains("--clip"), "{told}");
}

#[test]
fn two_keys_at_one_time_are_a_jump() {
    let model = changed(|_| ());
    let (json, mut bin) = crate::common::gltf::take_apart(&model);
    let index = |value: &Value| usize::try_from(value.as_u64().unwrap_or(0)).expect("small");
    let input = &json["accessors"][index(&json["animations"][0]["samplers"][0]["input"])];
    let view = &json["bufferViews"][index(&input["bufferView"])];
    let start = index(&view["byteOffset"]) + index(&input["byteOffset"]);
    bin.copy_within(start + 20..start + 24, start + 24);
    // A frame rate without a frame at the jump itself, where either key would be valid.
    bake(&crate::common::gltf::put_together(&json, &bin), &format!("{ORBIT} --fps 47"));
    bake(&crate::common::gltf::put_together(&json, &bin), &format!("{ORBIT} --fps 47 --seconds 3"));
}

#[test]
fn a_clip_without_length_needs_one() {
    let place = Place::with_mannequin();
    let empty = changed(|json| json["animations"] = json!([{ "name": "hm", "channels": [], "samplers": [] }]));
    place.write("m.glb", &empty);
    place.refused("bake m.glb --rig m.toml --target 0,1,2 --out out.glb", &["m.glb", "\"hm\"", "--seconds"]);
    bake(&empty, &format!("{ORBIT} --seconds 1"));
    let still = changed(|json| {
        let clip = json["animations"][0].clone();
        for sampler in list(&clip["samplers"]) {
            for key in ["input", "output"] {
                json["accessors"][usize::try_from(sampler[key].as_u64().expect("one")).expect("small")]["count"] =
                    json!(1);
            }
        }
    });
    place.write("m.glb", &still);
    place.refused("bake m.glb --rig m.toml --target 0,1,2 --out out.glb", &["m.glb", "\"walk\"", "--seconds"]);
    bake(&still, &format!("{ORBIT} --seconds 1"));
}

#[test]
fn what_a_clip_moves_besides_nodes_is_kept() {
    let pointer =
        json!({ "path": "pointer", "extensions": { "KHR_animation_pointer": { "pointer": "/materials/0/x" } } });
    let model = changed(|json| {
        let channel = json!({ "sampler": 3, "target": pointer });
        json["animations"][0]["channels"].as_array_mut().expect("channels").push(channel);
    });
    let place = Place::with_mannequin();
    place.write("m.glb", &model);
    place.done("bake m.glb --rig m.toml --target 0,1.6,2 --out out.glb");
    let (before, _) = crate::common::gltf::take_apart(&model);
    let (after, _) = crate::common::gltf::take_apart(&place.read("out.glb"));
    let clip = &after["animations"][0];
    let kept: Vec<&Value> = list(&clip["channels"]).iter().filter(|channel| channel["target"] == pointer).collect();
    assert_eq!(kept.len(), 1, "the pointer's channel");
    let sampler = usize::try_from(kept[0]["sampler"].as_u64().expect("one")).expect("small");
    assert_eq!(clip["samplers"][sampler], before["animations"][0]["samplers"][3]);
}

#[test]
fn a_clip_that_moves_the_chain_by_steps_and_splines() {
    for interpolation in ["STEP", "CUBICSPLINE"] {
        let model = changed(|json| {
            for sampler in json["animations"][0]["samplers"].as_array_mut().expect("samplers") {
                if interpolation == "STEP" {
                    sampler["interpolation"] = json!("STEP");
                }
            }
            if interpolation == "CUBICSPLINE" {
                // A third as many keys: groups of three values become in-tangent, value and out-tangent.
                let clip = json["animations"][0].clone();
                for sampler in list(&clip["samplers"]) {
                    let (input, output) = (&sampler["input"], &sampler["output"]);
                    let [input, output] =
                        [input, output].map(|i| usize::try_from(i.as_u64().expect("one")).expect("one"));
                    json["accessors"][input]["count"] = json!(12);
                    json["accessors"][input]["max"] = json!([11.0 / 30.0]);
                    json["accessors"][output]["count"] = json!(36);
                }
                for sampler in json["animations"][0]["samplers"].as_array_mut().expect("samplers") {
                    sampler["interpolation"] = json!("CUBICSPLINE");
                }
            }
        });
        bake(&model, "--target orbit:2,0.2,8 --seconds 1.51 --fps 47");
    }
}
