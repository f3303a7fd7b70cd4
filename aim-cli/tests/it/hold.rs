//! Arms attached to the neck: `inspect`, `rig` and `check` report them, and `bake` holds them in place.

use crate::common::{Place, changed};
use serde_json::{Value, json};

const ARMS: [&str; 2] = ["left_clavicle", "right_clavicle"];

/// Returns a folder with `m.glb`, the mannequin with its arms on the neck, and `m.toml`, its rig.
fn arms_on_the_neck() -> Place {
    let place = Place::with_mannequin();
    let model = changed(|json| {
        let nodes = json["nodes"].as_array_mut().expect("there are nodes");
        let at = |nodes: &[Value], name: &str| nodes.iter().position(|node| node["name"] == name).expect("a bone");
        let (arms, neck) = (ARMS.map(|arm| at(nodes, arm)), at(nodes, "neck"));
        for node in nodes.iter_mut() {
            if let Some(children) = node.get_mut("children").and_then(Value::as_array_mut) {
                children.retain(|child| !arms.iter().any(|arm| *child == json!(arm)));
            }
        }
        let children = nodes[neck]["children"].as_array_mut().expect("a neck carries a head");
        children.extend(arms.map(|arm| json!(arm)));
    });
    place.write("m.glb", &model);
    place
}

/// Returns whether a bake of `m.glb` writes translations of the left and of the right arm.
fn holds(place: &Place, options: &str) -> [bool; 2] {
    place.done(&format!("bake m.glb --target 2,1.9,1 --seconds 0.2 --out out.glb {options}"));
    let (json, _) = crate::common::gltf::take_apart(&place.read("out.glb"));
    let clips = json["animations"].as_array().expect("a clip was written");
    let channels = clips[clips.len() - 1]["channels"].as_array().expect("it has channels");
    ARMS.map(|arm| {
        channels.iter().any(|channel| {
            let node = channel["target"]["node"].as_u64().and_then(|node| usize::try_from(node).ok());
            let name = node.map(|node| &json["nodes"][node]["name"]);
            name.is_some_and(|name| name == arm) && channel["target"]["path"] == "translation"
        })
    })
}

/// Writes `h.toml`: `m.toml` with this `hold` at the neck.
fn holding(place: &Place, hold: &str) {
    let rig = String::from_utf8(place.read("m.toml")).expect("text");
    let neck = "bone = \"neck\"\n";
    assert!(rig.contains(neck), "{rig}");
    place.write("h.toml", &rig.replace(neck, &format!("{neck}hold = {hold}\n")));
}

#[test]
fn every_command_tells_of_arms_on_the_neck() {
    let place = arms_on_the_neck();
    let seen = place.done("inspect m.glb").stdout;
    assert!(seen.contains("neck carries left_clavicle, right_clavicle, which turn with it unless held"), "{seen}");
    let proposed = place.done("rig m.glb").stdout;
    assert!(proposed.contains("hold = [\"left_clavicle\", \"right_clavicle\"]"), "{proposed}");
    assert!(place.done("rig m.glb --format rust").stdout.contains("hold = [\"left_clavicle\", \"right_clavicle\"],"));
    place.write("p.toml", &proposed);

    let both = "\"left_clavicle\", \"right_clavicle\"";
    let declared = place.done("check m.glb --rig p.toml").stdout;
    assert!(declared.contains(&format!("neck: carries {both}, held as declared")), "{declared}");
    let found = place.done("check m.glb --rig m.toml").stdout;
    assert!(found.contains(&format!("neck: carries {both}, held by default")), "{found}");
    holding(&place, "[]");
    let loose = place.done("check m.glb --rig h.toml").stdout;
    assert!(
        loose.contains(&format!("which turn with it; declare hold = [{both}] to keep them with the trunk")),
        "{loose}"
    );

    let plain = Place::with_mannequin();
    for command in ["inspect m.glb", "check m.glb --rig m.toml", "rig m.glb"] {
        let said = plain.done(command).stdout;
        assert!(!said.contains("carries") && !said.contains("hold ="), "{said}");
    }
}

#[test]
fn a_bake_holds_what_is_declared_asked_for_or_found() {
    let place = arms_on_the_neck();
    place.write("p.toml", &place.done("rig m.glb").stdout);
    for (options, expected) in [
        ("", [true, true]),
        ("--rig m.toml", [true, true]),
        ("--rig p.toml", [true, true]),
        ("--hold none", [false, false]),
        ("--hold left_clavicle --rig m.toml", [true, false]),
        ("--hold left_clavicle,right_clavicle", [true, true]),
    ] {
        assert_eq!(holds(&place, options), expected, "{options}");
    }
    for (hold, expected) in [("[]", [false, false]), ("[\"right_clavicle\"]", [false, true])] {
        holding(&place, hold);
        assert_eq!(holds(&place, "--rig h.toml"), expected, "{hold}");
        assert_eq!(holds(&place, "--rig h.toml --hold left_clavicle"), [true, false], "{hold}");
    }
}

#[test]
fn arms_that_vrm_names_or_nobody_are_found_too() {
    let place = arms_on_the_neck();
    let (mut json, bin) = crate::common::gltf::take_apart(&place.read("m.glb"));
    let names: Vec<String> = json["nodes"]
        .as_array()
        .expect("nodes")
        .iter()
        .map(|node| node["name"].as_str().unwrap_or_default().to_owned())
        .collect();
    crate::forms::nameless(&mut json);
    let at = |name: &str| names.iter().position(|known| known == name).expect("a bone");
    let written = |json: &Value| place.write("n.glb", &crate::common::gltf::put_together(json, &bin));
    let [left, right] = ARMS.map(|arm| format!("Bone.{:03}", at(arm)));
    // They are recognised by the body's structure, and every command reports them.
    written(&json);
    let held = format!("hold = [\"{left}\", \"{right}\"]");
    let proposed = place.done("rig n.glb").stdout;
    assert!(proposed.contains(&held), "{proposed}");
    let seen = place.done("inspect n.glb").stdout;
    assert!(seen.contains(&format!("carries {left}, {right}, which turn with it")), "{seen}");
    // A single arm is not recognised as a pair. VRM names it.
    let bones = [
        ("hips", "hips"),
        ("spine", "spine"),
        ("neck", "neck"),
        ("head", "head"),
        ("leftShoulder", "left_clavicle"),
        ("leftUpperArm", "left_upper_arm"),
        ("leftLowerArm", "left_lower_arm"),
    ];
    json["nodes"][at("neck")]["children"]
        .as_array_mut()
        .expect("children")
        .retain(|child| *child != json!(at(ARMS[1])));
    written(&json);
    assert!(!place.done("inspect n.glb").stdout.contains("carries"), "nothing tells a single arm");
    let bones: serde_json::Map<String, Value> =
        bones.into_iter().map(|(bone, name)| (bone.to_owned(), json!({ "node": at(name) }))).collect();
    json["extensions"] = json!({ "VRMC_vrm": { "specVersion": "1.0", "humanoid": { "humanBones": bones } } });
    json["extensionsUsed"] = json!(["VRMC_vrm"]);
    written(&json);
    let proposed = place.done("rig n.glb").stdout;
    assert!(proposed.contains(&format!("hold = [\"{left}\"]")), "{proposed}");
}

#[test]
fn the_arms_of_a_nameless_body_are_its_longest_pair() {
    let place = arms_on_the_neck();
    let (mut json, bin) = crate::common::gltf::take_apart(&place.read("m.glb"));
    // Plain nodes without a skin, with two short pairs of bones on the breast: dangling parts, not arms.
    let nodes = json["nodes"].as_array_mut().expect("nodes");
    let breast = nodes.iter().position(|node| node["name"] == "spine2").expect("a bone");
    let arms = ARMS.map(|arm| nodes.iter().position(|node| node["name"] == arm).expect("a bone"));
    // In the paper's axes the first coordinate is the height, here relative to the neck's joint.
    arms.iter().for_each(|arm| nodes[*arm]["translation"][0] = json!(-0.01));
    for side in [1.0, -1.0] {
        let at = nodes.len();
        nodes[breast]["children"].as_array_mut().expect("children").push(json!(at));
        nodes.push(json!({ "translation": [0.05, 0.08, 0.09 * side], "children": [at + 1] }));
        nodes.push(json!({ "translation": [0.0, 0.05, 0.0] }));
    }
    for node in nodes.iter_mut() {
        let node = node.as_object_mut().expect("a node");
        node.remove("skin");
        node.remove("mesh");
    }
    crate::forms::nameless(&mut json);
    for key in ["skins", "meshes"] {
        json.as_object_mut().expect("an object").remove(key);
    }
    place.write("n.glb", &crate::common::gltf::put_together(&json, &bin));
    let [left, right] = arms.map(|arm| format!("Bone.{arm:03}"));
    let seen = place.done("inspect n.glb").stdout;
    assert!(seen.contains(&format!("carries {left}, {right}, which turn with it")), "{seen}");
}

#[test]
fn names_that_cannot_be_held_are_refused() {
    let place = arms_on_the_neck();
    holding(&place, "[\"left_clavicel\"]");
    let ran = place.aim("check m.glb --rig h.toml");
    let words = "hold: no node named \"left_clavicel\"; the nearest names are left_clavicle";
    assert!(ran.code == 1 && ran.stderr.contains(words), "{ran:?}");
    let bake = "bake m.glb --target 1,1,1 --out out.glb";
    place.refused(&format!("{bake} --rig h.toml"), &["m.glb", words]);
    place.refused(&format!("{bake} --hold left_clavicel"), &["m.glb", "no node named \"left_clavicel\""]);
    place.refused(&format!("{bake} --hold head"), &["hold names \"head\", which carries"]);
    place.refused(&format!("{bake} --hold hips"), &["hold names \"hips\", which is not below"]);
    place.refused(&format!("{bake} --hold none,left_clavicle"), &["no node named \"none\""]);
}

#[test]
fn blanks_beside_commas_are_not_of_a_name() {
    let place = arms_on_the_neck();
    let words = ["bake", "m.glb", "--target", "2,1.9,1", "--seconds", "0.2", "--report", "r.json", "--out", "out.glb"];
    let ran = place.run(words.into_iter().chain(["--hold", "left_clavicle, right_clavicle"]));
    assert_eq!(ran.code, 0, "{ran:?}");
    assert_eq!(place.json("r.json")["frames"][0]["followers"].as_array().map(Vec::len), Some(3), "an eye and two arms");
    let ran = place.run(words.into_iter().chain(["--hold", " none"]));
    assert_eq!((ran.code, place.json("r.json")["frames"][0]["followers"].as_array().map(Vec::len)), (0, Some(1)));
    let ran = place.run(["rig", "m.glb", "--chain", "head, neck"]);
    assert!(ran.code == 0 && ran.stdout.contains("bone = \"neck\""), "{ran:?}");
    for command in ["bake m.glb --target 1,1,1 --out o.glb --hold left_clavicle,", "rig m.glb --chain head,,neck"] {
        place.refused(command, &["a name is empty", "a,b"]);
    }
}
