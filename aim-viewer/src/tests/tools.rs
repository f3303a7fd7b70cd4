//! Tests of the tools that replace the rig's solver, on several characters.

use aim_character::{PAPER_AXES, Role, mannequin};
use aim_runtime::glam::{DAffine3, DVec3};
use serde_json::{Value, json};

use super::*;
use crate::tools::Tool;

/// Returns a GLB file with its JSON and binary chunk edited.
pub(super) fn edited(glb: &[u8], edit: impl FnOnce(&mut Value, &mut Vec<u8>)) -> Vec<u8> {
    let length = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().expect("four bytes")) as usize;
    let json = 20..20 + length(12);
    let bin = json.end + 8..json.end + 8 + length(json.end);
    let mut document: Value = serde_json::from_slice(&glb[json]).expect("it is JSON");
    let mut bin = glb[bin].to_vec();
    edit(&mut document, &mut bin);
    aim_gltf::to_glb(document.to_string().as_bytes(), Some(&bin)).expect("it is small")
}

/// Returns the mannequin below a node with this scale.
pub(super) fn scaled(scale: [f64; 3]) -> Character {
    let file = edited(&mannequin(|_| PAPER_AXES).expect("frames"), |document, _| {
        let roots = document["scenes"][0]["nodes"].clone();
        let nodes = document["nodes"].as_array_mut().expect("it has nodes");
        nodes.push(json!({ "name": "scaled", "scale": scale, "children": roots }));
        let root = nodes.len() - 1;
        document["scenes"][0]["nodes"] = json!([root]);
    });
    Character::from_bytes("scaled.glb", &file).expect("as the mannequin")
}

const TANK: &str = r#"{ "asset": { "version": "2.0" }, "nodes": [
    { "name": "hull", "children": [1] },
    { "name": "turret base", "children": [2], "translation": [0.0, 1.0, 0.0] },
    { "name": "barrel", "children": [3] },
    { "name": "end", "translation": [0.0, 0.0, -2.0] }
] }"#;

/// Returns the window after two seconds with a tool and a still target, and the world transforms without either.
fn tried(character: Character, tool: Tool, target: impl Fn(&Viewer) -> Vec3) -> (Window, Vec<DAffine3>) {
    let mut window = Window::new(character, USUAL);
    let stage = &mut window.harness.state_mut().stage;
    stage.clock.play.clip = None;
    stage.tuning.settings.weight = 0.0;
    window.frames(120);
    let unaimed = window.viewer().stage.first().expect("a frame").world.clone();
    let target = target(window.viewer());
    let stage = &mut window.harness.state_mut().stage;
    (stage.tuning.tool, stage.target.place) = (Some(tool), target);
    window.frames(120);
    (window, unaimed)
}

/// Returns the angle between a bone's measured forward direction and the direction to the target, degrees.
fn off(window: &Window, bone: usize) -> f64 {
    let stage = &window.viewer().stage;
    let world = stage.first().expect("a frame").world[bone];
    let forward = stage.character.measurement.bone(bone).expect("it is measured").frame.forward;
    let wanted = stage.target_now().as_dvec3() - world.translation;
    world.transform_vector3(forward).angle_between(wanted).to_degrees()
}

fn ahead(viewer: &Viewer) -> Vec3 {
    viewer.stage.room().point(0.5, 0.2, 1.5)
}

#[test]
fn a_head_an_eye_and_poses_point_at_the_target() {
    for scale in [[1.0; 3], [-1.0, 1.0, 1.0], [-1.2, 0.9, 1.1]] {
        // With non-uniform scale, no rotation of a bone is exact, and the solver returns the nearest.
        let most_deg = if scale[1] == 1.0 { 0.1 } else { 4.0 };
        for tool in [Tool::LookAt, Tool::OneBone, Tool::AimPoses] {
            let (window, unaimed) = tried(scaled(scale), tool, ahead);
            let stage = &window.viewer().stage;
            let frame = stage.first().expect("a frame");
            let with_role = |role| stage.character.measurement.with_role(role).expect("it has one").node;
            let (head, eyes) = (with_role(Role::Head), [Role::LeftEye, Role::RightEye].map(with_role));
            let pointed = match tool {
                Tool::LookAt => vec![head],
                Tool::OneBone => eyes.to_vec(),
                _ => vec![stage.character.chain.joints[0]],
            };
            for bone in pointed {
                let off = off(&window, bone);
                assert!(off < most_deg, "{tool:?} under {scale:?}: {off}° off");
            }
            assert!(frame.error_deg < most_deg, "{tool:?} under {scale:?}: tells {}° off", frame.error_deg);
            // Only the turned bones and their descendants have moved.
            let turned = match tool {
                Tool::LookAt => vec![head],
                Tool::OneBone => eyes.to_vec(),
                _ => vec![*stage.character.chain.joints.last().expect("a chain")],
            };
            let skeleton = stage.character.skeleton();
            let moved = |node: &usize| !frame.world[*node].abs_diff_eq(unaimed[*node], 1e-5);
            let stray = (0..skeleton.len())
                .filter(moved)
                .find(|node| !turned.iter().any(|bone| skeleton.subtree(*bone).contains(node)));
            assert_eq!(stray.map(|node| &skeleton.names()[node]), None, "{tool:?} under {scale:?}");
        }
    }
}

#[test]
fn a_hand_reaches_for_the_target() {
    for scale in [[1.0; 3], [-1.0, 1.0, 1.0]] {
        let near = |viewer: &Viewer| {
            let stage = &viewer.stage;
            let hand = stage.character.hand.expect("it has one");
            assert!(stage.character.skeleton().names()[hand].contains("hand"));
            let [up, forward, _] = stage.character.directions();
            stage.first().expect("a frame").world[hand].translation.as_vec3() + up * 0.25 + forward * 0.3
        };
        let (window, _) = tried(scaled(scale), Tool::Ccd, near);
        let stage = &window.viewer().stage;
        let hand = stage.first().expect("a frame").world[stage.character.hand.expect("it has one")].translation;
        let left = hand.distance(stage.target_now().as_dvec3());
        assert!(left < 1e-3, "{left} m left under {scale:?}");
        let right = hand - stage.character.measurement.bind_world[stage.character.chain.joints[0]].translation;
        assert!(right.dot(stage.character.measurement.left) < 0.0, "it is the right one");
        // For a target out of reach, the arm stretches towards it.
        let (window, _) = tried(scaled(scale), Tool::Ccd, |viewer| viewer.stage.room().point(-1.0, 0.5, 4.0));
        let frame = window.viewer().stage.first().expect("a frame");
        assert_eq!(frame.outcome.status, aim_runtime::Status::AtLimit);
        assert!(frame.error_deg < 12.0, "{}", frame.error_deg);
    }
}

#[test]
fn every_tool_can_be_tried_on_a_thing_without_head_or_hand() {
    for tool in Tool::ALL {
        let tank = Character::from_bytes("tank.gltf", TANK.as_bytes()).expect("a chain is proposed");
        let (window, _) = tried(tank, tool, ahead);
        let frame = window.viewer().stage.first().expect("a frame");
        let is_finite = |at: &DAffine3| at.is_finite() && at.translation.distance(DVec3::ZERO) < 10.0;
        assert!(frame.world.iter().all(is_finite), "{tool:?}");
        assert!(window.viewer().caption().contains(tool.name()), "{}", window.viewer().caption());
    }
}

#[test]
fn the_head_turns_no_faster_than_it_may() {
    let (mut window, _) = tried(scaled([1.0; 3]), Tool::LookAt, ahead);
    let head = window.viewer().stage.character.measurement.with_role(Role::Head).expect("it has one").node;
    let forward = |window: &Window| {
        let stage = &window.viewer().stage;
        let of_bone = stage.character.measurement.bone(head).expect("it is measured").frame.forward;
        stage.first().expect("a frame").world[head].transform_vector3(of_bone)
    };
    let place = window.viewer().stage.room().point(-1.2, 0.0, 1.0);
    window.harness.state_mut().stage.target.place = place;
    let mut frames = 0;
    while off(&window, head) > 0.1 {
        let before = forward(&window);
        window.frames(1);
        let turned = before.angle_between(forward(&window));
        assert!(turned < 4.0 / 60.0 + 1e-4, "{turned} rad in a frame");
        frames += 1;
        assert!(frames < 60, "{}° off", off(&window, head));
    }
    assert!(frames > 5, "it takes time: {frames} frames");
}
