//! `aim rig` proposes declarations that every other command accepts, in either notation.

use crate::common::character::Character;
use crate::common::forward::list;
use crate::common::gltf::Model;
use crate::common::rig::{conventions, joints};
use crate::common::{Place, changed, in_full};
use aim_runtime::glam::{DVec3, EulerRot, Quat, Vec3};
use serde_json::json;

#[test]
fn the_mannequins_rig_is_proposed_with_its_axes_and_human_ranges() {
    let place = Place::with_mannequin();
    let text = place.done("rig m.glb").stdout;
    place.write("p.toml", &text);
    assert!(
        text.contains("name = \"M\"") && text.starts_with("# Measured from m.glb. Faces +Z, up is +Y, according to "),
        "{text}"
    );
    assert!(text.contains("axes = { up = \"+X\", forward = \"+Y\", left = \"+Z\" }"), "{text}");
    assert!(text.contains("# eyes can turn by about 50 degrees"), "every joint says why: {text}");
    let rig: serde_json::Value = toml::from_str(&text).expect("it is TOML");
    let names: Vec<_> = list(&rig["joint"]).iter().map(|joint| joint["name"].as_str().unwrap_or("")).collect();
    assert_eq!(names, ["left_eye", "head", "neck", "spine3", "spine2", "spine1", "spine"]);
    assert_eq!((&rig["joint"][0]["other_eye"], &rig["region"]), (&json!("right_eye"), &json!("human")));
    for joint in list(&rig["joint"]) {
        assert_eq!(joint["limits_from"], "bind_pose", "of a body, whatever a clip does already: {text}");
    }
    // The bones of a region share its range; a longer bone of the spine gets a larger share.
    let sum = |from: usize, to: usize| {
        joints(&text)[from..to].iter().filter_map(|joint| joint.heading).map(|[_, hi]| hi).sum::<f64>()
    };
    assert_eq!((sum(1, 3), sum(1, 2)), (78.0, 39.0), "{text}");
    assert!((sum(3, 7) - 30.0).abs() < 1.5 && sum(6, 7) > 5.0, "{text}");
    place.done("check p.toml --samples 50");
    place.done("check m.glb --rig p.toml");
    place.done("generate p.toml --lang rust -o p.rs");
    place.done("bake m.glb --rig p.toml --target orbit:2,0,8 --out a.glb --report a.json");
    place.done("bake m.glb --target orbit:2,0,8 --out b.glb --report b.json");
    assert!(place.read("a.glb") == place.read("b.glb"), "without a rig the proposed one is aimed");
}

#[test]
fn every_convention_and_every_frame_between_comes_back() {
    let conventions = conventions();
    let turn = Quat::from_euler(EulerRot::XYZ, 0.3, -0.4, 0.2);
    for (number, axes) in conventions.iter().enumerate().step_by(if in_full() { 1 } else { 7 }) {
        // The spine's axes are a general frame.
        let between = axes.map(|axis| (turn * Vec3::from_array(axis)).to_array());
        let axes_of = |bone: &str| if bone == "spine3" { between } else { *axes };
        let place = Place::new();
        place.write("m.glb", &aim_character::mannequin(axes_of).expect("frames"));
        let text = place.done("rig m.glb").stdout;
        for (joint, bone) in joints(&text).iter().zip(["left_eye", "head", "neck", "spine3"]) {
            let declared = axes_of(bone).map(|axis| DVec3::from_array(axis.map(f64::from)));
            let found = [joint.up, joint.forward, joint.left];
            let off = declared.iter().zip(found).map(|(a, b)| a.distance(b)).fold(0.0, f64::max);
            assert!(off < 1e-5, "convention {number}, {bone}: {found:?} instead of {declared:?}\n{text}");
        }
        if number % 7 == 0 {
            place.write("p.toml", &text);
            place.done("check m.glb --rig p.toml");
            place.done("check p.toml --samples 20");
        }
    }
}

#[test]
fn the_derive_is_accepted_by_the_macro() {
    let place = Place::new();
    place.write("hero-of 2.glb", &crate::common::mannequin());
    for (number, axes) in conventions().into_iter().enumerate().step_by(5) {
        place.write("hero-of 2.glb", &aim_character::mannequin(|_| axes).expect("frames"));
        let ran = place.run(["rig", "hero-of 2.glb", "--format", "rust"]);
        assert_eq!(ran.code, 0, "{}", ran.stderr);
        let (import, item) = ran.stdout.split_once("\n\n").expect("an import and a struct");
        assert_eq!(import, "use aim::{AimRig, Joint};");
        assert!(item.contains("pub struct HeroOf2 {"), "{item}");
        let derived = aim_codegen::derive(item.replace("#[derive(AimRig)]", "").parse().expect("tokens")).to_string();
        assert!(!derived.contains("compile_error"), "convention {number}: {derived}\n{item}");
    }
}

/// The code printed for the mannequin is the one that the plugin's tests compile and run.
#[test]
fn what_is_spawned_in_bevy_is_fresh() {
    let place = Place::new();
    place.write("mannequin.glb", &crate::common::mannequin());
    let printed = place.done("rig mannequin.glb --format bevy").stdout;
    assert!(
        printed.contains("other_eye = \"right_eye\"")
            && !printed.contains("with_other_eye")
            && !printed.contains("bind_pose(["),
        "{printed}"
    );
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../integrations/bevy/tests/it/mannequin.rs");
    let expected = format!("//! Printed by `aim rig mannequin.glb --format bevy`.\n\n{printed}");
    if std::env::var_os("AIM_BLESS").is_some() {
        std::fs::write(path, &expected).expect("it can be written");
    }
    let found = std::fs::read_to_string(path).expect("it is checked in");
    assert!(found == expected, "run with AIM_BLESS=1: {path} is not what is printed:\n{printed}");
}

/// If a file's rest pose differs from its bind pose, arms and head are measured from the bind pose.
#[test]
fn a_bind_pose_that_is_not_the_rest_pose_is_printed_for_bevy() {
    let neck = Model::new(&crate::common::mannequin()).node("neck");
    let turned = changed(|json| json["nodes"][neck]["rotation"] = json!([0.0, 0.0, 0.382_683_43, 0.923_879_5]));
    let place = Place::new();
    place.write("m.glb", &turned);
    let printed = place.done("rig m.glb --format bevy").stdout;
    for part in ["use bevy_aim::aim::glam::{Affine3A, Quat, Vec3};", ".with_bind_pose([", "(\"neck\", Affine3A::"] {
        assert!(printed.contains(part), "{part}: {printed}");
    }
}

#[test]
fn a_stated_facing_overrules_the_measured_one() {
    let place = Place::with_mannequin();
    let text = place.done("rig m.glb --forward -x").stdout;
    assert!(text.contains("Faces -X, up is +Y, according to the legs, the stated axes."), "{text}");
    // In the paper's axes a bone's +Y led forward and +Z left: the former right is now forward.
    let head = &joints(&text)[1];
    assert_eq!((head.up, head.forward, head.left), (DVec3::X, DVec3::NEG_Z, DVec3::Y), "{text}");
    place.done("inspect m.glb --json --forward -Z --html i.html");
    let found: serde_json::Value =
        serde_json::from_str(&place.done("inspect m.glb --json --forward -Z --up +Y").stdout).expect("JSON");
    assert_eq!((&found["forward"], &found["confidence"]), (&json!([0.0, 0.0, -1.0]), &json!(1.0)));
    place.done("bake m.glb --target orbit:2,0,8 --forward +X --out a.glb --report a.json");
    let target = list(&place.json("a.json")["frames"][0]["target"])
        .iter()
        .map(|x| x.as_f64().expect("a number"))
        .collect::<Vec<_>>();
    assert!(target[0] > 1.9 && target[2].abs() < 0.2, "the orbit begins in the stated front: {target:?}");
    place.refused("rig m.glb --forward +Y", &["m.glb", "--forward +Y", "up", "--up"]);
    place.refused("rig m.glb --forward up", &["--forward", "+X, -X, +Y"]);
}

#[test]
fn a_statement_against_the_evidence_is_questioned() {
    let place = Place::with_mannequin();
    for command in ["rig m.glb", "bake m.glb --target orbit:2,0,8 --out a.glb", "inspect m.glb --json"] {
        let told = |forward: &str| place.done(&format!("{command} --forward {forward}")).stderr;
        let wrong = told("-Z");
        for word in ["warning: m.glb: --forward -Z contradicts", "forward is +Z according to"] {
            assert!(wrong.contains(word), "{command}: {wrong}");
        }
        assert!(!told("+Z").contains("--forward"), "{command}");
        assert!(!place.done(command).stderr.contains("--forward"), "{command}");
    }
}

#[test]
fn proposed_angles_have_few_decimals() {
    for tenths in 1..=9 {
        let model = changed(|json| crate::forms::insert(json, "neck1", "head", f64::from(tenths) / 10.0));
        let character = Character::new(&model);
        let proposal = aim_character::propose(&character.document, &character.measurement, None).expect("a rig");
        let text = aim_character::declaration::toml(&proposal, "A test.");
        let angles = text.match_indices("deg\"").map(|(end, _)| {
            let start = text[..end].rfind('"').expect("quotes");
            &text[start + 1..end]
        });
        for angle in angles {
            let decimals = angle.split_once('.').map_or(0, |(_, decimals)| decimals.len());
            assert!(decimals <= 3, "{angle}deg in\n{text}");
        }
        assert!(!text.contains("rad\""), "{text}");
    }
}

#[test]
fn a_guess_is_called_one() {
    let place = Place::new();
    place.write(
        "n.glb",
        &changed(|json| {
            for node in json["nodes"].as_array_mut().expect("nodes") {
                node.as_object_mut().expect("a node").remove("name");
            }
        }),
    );
    let guess = "The facing is uncertain: no names tell left from right, only the feet tell front from back.";
    for command in ["inspect n.glb", "rig n.glb"] {
        let said = place.done(command).stdout;
        assert!(said.contains(guess) && said.contains("--forward"), "{said}");
    }
    place.done("inspect n.glb --html i.html");
    assert!(String::from_utf8_lossy(&place.read("i.html")).contains(guess));
    let said = place.done("inspect n.glb --forward +Z").stdout;
    assert!(!said.contains("uncertain"), "{said}");
}

#[test]
fn a_chain_may_be_named_and_has_to_be_one() {
    let place = Place::with_mannequin();
    let text = place.done("rig m.glb --chain head,spine2,hips").stdout;
    let rig: serde_json::Value = toml::from_str(&text).expect("it is TOML");
    let bones: Vec<_> = list(&rig["joint"]).iter().map(|joint| joint["bone"].as_str().unwrap_or("")).collect();
    assert_eq!(bones, ["head", "spine2", "hips"]);
    let hands = place.done("rig m.glb --chain left_hand,left_lower_arm").stdout;
    place.write("hands.toml", &hands);
    place.done("check m.glb --rig hands.toml");
    place.refused("rig m.glb --chain hed", &["m.glb", "\"hed\"", "head"]);
    place.refused("rig m.glb --chain spine,head", &["m.glb", "is not below"]);
    place.write("thing.gltf", r#"{"asset":{"version":"2.0"},"nodes":[{"name":"thing"}]}"#);
    place.refused("rig thing.gltf", &["thing.gltf", "--chain"]);
}

#[test]
fn a_turret_turns_without_end_and_raises_its_barrel() {
    let place = Place::new();
    let json = json!({ "asset": { "version": "2.0" }, "nodes": [
        { "name": "hull", "children": [1] },
        { "name": "turret base", "children": [2], "translation": [0.0, 1.0, 0.0] },
        { "name": "barrel", "children": [3] },
        { "name": "end", "translation": [0.0, 0.0, -2.0] },
    ]});
    place.write("tank.gltf", &json.to_string());
    let text = place.done("rig tank.gltf").stdout;
    let rig: serde_json::Value = toml::from_str(&text).expect("it is TOML");
    let names: Vec<_> = list(&rig["joint"]).iter().map(|joint| joint["bone"].as_str().unwrap_or("")).collect();
    assert_eq!(names, ["barrel", "turret base"]);
    assert_eq!((&rig["joint"][1]["heading"], rig["joint"][0].get("heading")), (&json!("free"), None));
    assert!(text.contains("forward = \"-Z\""), "{text}");
    place.done("bake tank.gltf --target 3,2,1 --seconds 3 --out o.glb --report r.json");
    let report = place.json("r.json");
    assert_eq!(report["frames"][180]["status"], "reached", "{}", report["frames"][180]);
}

#[test]
fn a_long_neck_bends_in_all_its_bones() {
    let place = Place::new();
    // Turns the mannequin's spine into a long neck.
    let necks = ["spine", "spine1", "spine2", "spine3"];
    place.write(
        "dino.glb",
        &changed(|json| {
            for node in json["nodes"].as_array_mut().expect("nodes") {
                if let Some(at) = necks.iter().position(|name| node["name"] == *name) {
                    node["name"] = format!("Neck{}", at + 1).into();
                }
            }
        }),
    );
    let text = place.done("rig dino.glb").stdout;
    let rig: serde_json::Value = toml::from_str(&text).expect("it is TOML");
    let names: Vec<_> = list(&rig["joint"]).iter().map(|joint| joint["name"].as_str().unwrap_or("")).collect();
    assert_eq!(names, ["left_eye", "head", "neck", "neck4", "neck3", "neck2", "neck1"]);
    let heading: f64 = joints(&text)[1..].iter().filter_map(|joint| joint.heading).map(|[_, hi]| hi).sum();
    assert!((heading - 78.0).abs() < 1.5, "with the head they turn by {heading}°");
}

#[test]
fn a_spine_that_legs_hang_on_stands_still() {
    let place = Place::new();
    // As in 3ds Max Biped skeletons, the thighs hang on the first bone of the spine.
    place.write(
        "biped.glb",
        &changed(|json| {
            let nodes = json["nodes"].as_array_mut().expect("nodes");
            let at = |nodes: &[serde_json::Value], name: &str| {
                nodes.iter().position(|node| node["name"] == name).expect(name)
            };
            let legs = ["left_upper_leg", "right_upper_leg"].map(|name| json!(at(nodes, name)));
            let [hips, spine] = ["hips", "spine"].map(|name| at(nodes, name));
            nodes[hips]["children"].as_array_mut().expect("children").retain(|child| !legs.contains(child));
            nodes[spine]["children"].as_array_mut().expect("children").extend(legs);
        }),
    );
    let text = place.done("rig biped.glb").stdout;
    let rig: serde_json::Value = toml::from_str(&text).expect("it is TOML");
    let bones: Vec<_> = list(&rig["joint"]).iter().map(|joint| joint["bone"].as_str().unwrap_or("")).collect();
    assert_eq!(bones, ["left_eye", "head", "neck", "spine3", "spine2", "spine1"]);
}

#[test]
fn who_goes_on_all_fours_keeps_its_forefeet_on_the_ground() {
    let place = Place::new();
    let at = |name: &str, place: [f64; 3], children: &[usize]| {
        let mut node = json!({ "name": name, "translation": place });
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        node
    };
    let json = json!({ "asset": { "version": "2.0" }, "nodes": [
        at("Hips", [0.0, 0.6, 0.0], &[1, 8, 10]),
        at("Spine", [0.0, 0.0, 0.3], &[2, 4, 6]),
        at("Neck", [0.0, 0.1, 0.4], &[3]),
        at("Head", [0.0, 0.1, 0.2], &[]),
        at("LeftArm", [0.1, 0.0, 0.3], &[5]),
        at("LeftHand", [0.0, -0.6, 0.0], &[]),
        at("RightArm", [-0.1, 0.0, 0.3], &[7]),
        at("RightHand", [0.0, -0.6, 0.0], &[]),
        at("LeftThigh", [0.1, 0.0, 0.0], &[9]),
        at("LeftFoot", [0.0, -0.6, 0.0], &[]),
        at("RightThigh", [-0.1, 0.0, 0.0], &[11]),
        at("RightFoot", [0.0, -0.6, 0.0], &[]),
    ]});
    place.write("fox.gltf", &json.to_string());
    let text = place.done("rig fox.gltf").stdout;
    let rig: serde_json::Value = toml::from_str(&text).expect("it is TOML");
    let bones: Vec<_> = list(&rig["joint"]).iter().map(|joint| joint["bone"].as_str().unwrap_or("")).collect();
    assert_eq!((bones, &rig["region"]), (vec!["Head", "Neck"], &json!("quadruped")), "{text}");
    place.write("p.toml", &text);
    place.done("check fox.gltf --rig p.toml");
}

#[test]
fn a_chain_that_is_named_shares_its_regions_too() {
    let place = Place::with_mannequin();
    for (chain, heading) in
        [("head", [78.0].as_slice()), ("neck", &[78.0]), ("head,neck", &[39.0, 39.0]), ("head,spine2", &[78.0, 30.0])]
    {
        let text = place.done(&format!("rig m.glb --chain {chain}")).stdout;
        let found: Vec<f64> = joints(&text).iter().filter_map(|joint| joint.heading).map(|[_, hi]| hi).collect();
        assert_eq!(found, heading, "{chain}: {text}");
    }
}

/// Returns the mannequin as a VRM file with a `lookAt` of this kind, whose maps take these inputs to these outputs:
/// inner, outer, down, up.
fn vrm(kind: &str, maps: [[f64; 2]; 4]) -> Vec<u8> {
    changed(|json| {
        let mut look = json!({ "type": kind });
        let directions = ["HorizontalInner", "HorizontalOuter", "VerticalDown", "VerticalUp"];
        for (direction, [input, output]) in directions.into_iter().zip(maps) {
            look[format!("rangeMap{direction}")] = json!({ "inputMaxValue": input, "outputScale": output });
        }
        json["extensions"] = json!({ "VRMC_vrm": { "lookAt": look } });
    })
}

const MAPS: [[f64; 2]; 4] = [[90.0, 8.0], [90.0, 12.0], [90.0, 10.0], [10.0, 9.0]];

#[test]
fn the_eyes_of_a_vrm_file_look_as_far_as_its_maps_have_inputs() {
    let place = Place::new();
    place.write("v.vrm", &vrm("bone", MAPS));
    let text = place.done("rig v.vrm").stdout;
    let eye = &joints(&text)[0];
    assert_eq!((eye.heading, eye.pitch), (Some([-35.0, 35.0]), Some([-25.0, 10.0])), "{text}");
    assert!(text.contains("the range maps of the file's lookAt"), "{text}");
    // Eyes without pitch.
    place.write("v.vrm", &vrm("bone", [[90.0, 8.0], [90.0, 8.0], [90.0, 0.0], [90.0, 0.0]]));
    let text = place.done("rig v.vrm").stdout;
    assert_eq!((joints(&text)[0].heading, joints(&text)[0].pitch), (Some([-35.0, 35.0]), None), "{text}");
    place.write("p.toml", &text);
    place.done("check v.vrm --rig p.toml");
}

#[test]
fn the_bones_of_a_vrm_files_eyes_turn_by_its_maps() {
    let place = Place::new();
    let source = vrm("bone", MAPS);
    place.write("v.vrm", &source);
    // One target to the left and above, one to the right and below.
    for (target, both_eyes) in [("1,2.2,2", ""), ("-1,1.2,2", ""), ("1,2.2,2", " --both-eyes")] {
        place.done(&format!("bake v.vrm --target={target} --seconds 0.5 --out o.glb --report r.json{both_eyes}"));
        let (report, output) = (place.json("r.json"), Model::new(&place.read("o.glb")));
        let source = Model::new(&source);
        let named = [(&source, "walk"), (&output, "walk_aimed")];
        let clips = named.map(|(model, name)| model.clip(model.clip_index(name).expect("the clip")));
        for frame in list(&report["frames"]) {
            let t = frame["t"].as_f64().expect("a time");
            let [before, after] = [source.pose(&clips[0], t), output.pose(&clips[1], t)];
            let number = |key: &str| frame["joints"][0][key].as_f64().expect("degrees");
            let (heading, pitch) = (number("heading_deg"), number("pitch_deg"));
            // In the paper's axes up is +X, forward +Y, left +Z. Outward for the left eye is inward for the right eye.
            for (eye, outward) in [("left_eye", 1.0), ("right_eye", -1.0)] {
                let node = output.node(eye);
                let gaze = before[node].rotation.inverse() * after[node].rotation * DVec3::Y;
                let found = (gaze.z.atan2(gaze.y).to_degrees(), gaze.x.asin().to_degrees());
                let side = if heading * outward > 0.0 { 12.0 / 90.0 } else { 8.0 / 90.0 };
                let height = if pitch < 0.0 { 10.0 / 90.0 } else { 0.9 };
                let off = (found.0 - heading * side).abs().max((found.1 - pitch * height).abs());
                // With `--both-eyes` the other eye is aimed itself and has angles of its own.
                let most = if both_eyes.is_empty() || eye == "left_eye" { 1e-3 } else { 0.6 };
                assert!(off < most, "{target}{both_eyes}, {t} s, {eye}: {found:?} for {heading}, {pitch}");
                assert!(heading.abs() > 2.0 && pitch.abs() > 0.5, "it looks aside: {heading}, {pitch}");
            }
            assert_eq!(frame["status"], "reached", "{frame}");
        }
    }
}

#[test]
fn the_head_leads_where_eyes_are_no_bones_that_move() {
    let place = Place::new();
    let still = MAPS.map(|[input, _]| [input, 0.0]);
    for (kind, maps, why) in [("bone", still, "keeps the eyes still"), ("expression", MAPS, "eyes use expressions")] {
        place.write("v.vrm", &vrm(kind, maps));
        let text = place.done("rig v.vrm").stdout;
        let rig: serde_json::Value = toml::from_str(&text).expect("it is TOML");
        assert_eq!((&rig["joint"][0]["name"], &rig["joint"][1]["name"]), (&json!("head"), &json!("neck")), "{text}");
        assert!(text.contains(why) && text.contains("the head leads"), "{text}");
        place.done("bake v.vrm --target 1,1.6,2 --seconds 0.5 --out o.glb --report r.json");
        // An eye named explicitly is used.
        let text = place.done("rig v.vrm --chain left_eye,neck").stdout;
        assert!(!text.contains("the head leads"), "{text}");
    }
    let morphs = |has_bones: bool| {
        changed(|json| {
            json["meshes"][0]["extras"] = json!({ "targetNames": ["jawOpen", "eyeLookInLeft"] });
            for node in json["nodes"].as_array_mut().expect("nodes") {
                if !has_bones && node["name"].as_str().is_some_and(|name| name.ends_with("_eye")) {
                    node["name"] = "ball".into();
                }
            }
        })
    };
    for has_bones in [true, false] {
        place.write("m.glb", &morphs(has_bones));
        let text = place.done("rig m.glb").stdout;
        assert_eq!(text.contains("its meshes have none"), !has_bones, "{text}");
    }
}

#[test]
#[ignore = "needs AIM_RIGS"]
fn what_is_proposed_for_real_characters_is_accepted_and_fits() {
    let folder = crate::common::real_rigs();
    for entry in std::fs::read_dir(folder).expect("the folder can be listed") {
        let file = entry.expect("an entry").path();
        if !file.extension().is_some_and(|extension| extension == "glb" || extension == "gltf") {
            continue;
        }
        let place = Place::new();
        let run = |arguments: &[&str]| {
            let arguments = arguments.iter().map(|word| if *word == "FILE" { file.as_os_str() } else { word.as_ref() });
            let ran = place.run(arguments);
            assert_eq!(ran.code, 0, "{}: {}", file.display(), ran.stderr);
            ran.stdout
        };
        place.write("p.toml", &run(&["rig", "FILE"]));
        run(&["check", "FILE", "--rig", "p.toml"]);
        run(&["check", "p.toml", "--samples", "50"]);
        let item = run(&["rig", "FILE", "--format", "rust"]).replace("use aim::{AimRig, Joint};", "");
        let derived = aim_codegen::derive(item.replace("#[derive(AimRig)]", "").parse().expect("tokens")).to_string();
        assert!(!derived.contains("compile_error"), "{}: {item}", file.display());
        let page = run(&["inspect", "FILE", "--html", "page.html"]);
        assert!(page.contains("Confidence") && place.read("page.html").len() > 10_000, "{}", file.display());
    }
}

#[test]
fn names_that_no_language_takes_and_bones_that_no_terminal_shows() {
    let place = Place::new();
    let model = changed(|json| {
        for node in json["nodes"].as_array_mut().expect("nodes") {
            if node["name"] == "neck" {
                node["name"] = "neck\u{1b}".into();
            }
        }
    });
    place.write("default.glb", &model);
    let toml = place.done("rig default.glb --chain head,neck\u{1b}").stdout;
    assert!(toml.contains("name = \"DefaultRig\"") && toml.contains(r#"bone = "neck\u001B""#), "{toml}");
    place.write("r.toml", &toml);
    place.done("check default.glb --rig r.toml");
    let rust = place.done("rig default.glb --format rust --chain head,neck\u{1b}").stdout;
    assert!(rust.contains(r#"bone = "neck\u{1B}""#), "{rust}");
}
