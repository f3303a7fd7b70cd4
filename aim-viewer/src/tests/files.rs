//! Tests of files dropped onto the window.

use std::sync::Arc;

use aim_character::{PAPER_AXES, mannequin};

use super::*;

fn model() -> Vec<u8> {
    mannequin(|_| PAPER_AXES).expect("frames")
}

const TANK: &str = r#"{ "asset": { "version": "2.0" }, "nodes": [
    { "name": "hull", "children": [1] },
    { "name": "turret base", "children": [2], "translation": [0.0, 1.0, 0.0] },
    { "name": "barrel", "children": [3] },
    { "name": "end", "translation": [0.0, 0.0, -2.0] }
] }"#;

const STIFF: &str = r#"
name = "Stiff"
axes = { up = "+X", forward = "+Y", left = "+Z" }
[[joint]]
name = "head"
role = "head"
heading = ["-5deg", "5deg"]
rate = "30deg"
"#;

/// Returns a dropped file as a desktop passes it, by path.
fn on_disk(name: &str, bytes: &[u8]) -> egui::DroppedFile {
    let folder = std::env::temp_dir().join(format!("aim-viewer-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for files");
    let path = folder.join(name);
    std::fs::write(&path, bytes).expect("a file");
    egui::DroppedFile { path: Some(path), ..Default::default() }
}

#[test]
fn a_model_is_opened_with_its_proposed_rig() {
    let by_path = on_disk("hero.glb", &model());
    let by_bytes = egui::DroppedFile { name: "hero.glb".into(), bytes: Some(Arc::from(model())), ..Default::default() };
    for file in [by_path, by_bytes] {
        let mut window = Window::mannequin(USUAL);
        window.click("show gaze");
        window.click("plot: spine3");
        window.drop_file(file);
        let viewer = window.viewer();
        assert_eq!((viewer.stage.character.name.as_str(), &viewer.trouble), ("hero.glb", &None));
        assert!(!viewer.stage.character.is_mannequin, "its code is not compiled");
        assert!(!viewer.shown.gaze && viewer.plotted.is_none(), "what is shown stays, what is gone is not chosen");
        window.frames(60);
        assert!(window.viewer().stage.first().expect("a frame").error_deg < 0.1);
    }
}

#[test]
fn a_rig_is_taken_for_the_model_that_is_shown() {
    for file in [
        on_disk("stiff.toml", STIFF.as_bytes()),
        egui::DroppedFile { name: "Stiff.TOML".into(), bytes: Some(Arc::from(STIFF.as_bytes())), ..Default::default() },
    ] {
        let mut window = Window::mannequin(USUAL);
        window.drop_file(file);
        assert_eq!(window.viewer().trouble, None);
        assert_eq!(window.viewer().stage.tuning.spec.name, "Stiff");
        assert!(window.is_shown("joint head") && !window.is_shown("joint neck"));
    }
}

#[test]
fn a_rig_and_a_model_may_come_together() {
    let mut window = Window::mannequin(USUAL);
    let files = [on_disk("with-a-model.toml", STIFF.as_bytes()), on_disk("with-a-rig.glb", &model())];
    window.harness.input_mut().dropped_files.extend(files);
    window.frames(2);
    let viewer = window.viewer();
    assert_eq!(viewer.trouble, None);
    assert_eq!(
        (viewer.stage.character.name.as_str(), viewer.stage.tuning.spec.name.as_str()),
        ("with-a-rig.glb", "Stiff")
    );
}

#[test]
fn what_does_not_fit_is_told_and_changes_nothing() {
    let other = STIFF.replace("\"head\"", "\"trunk\"");
    let cases: [(&str, &[u8], &[&str]); 5] = [
        ("nonsense.glb", b"nonsense", &["nonsense.glb", "glTF"]),
        ("empty.gltf", b"", &["empty.gltf"]),
        ("other.toml", other.as_bytes(), &["trunk"]),
        ("wrong.toml", b"name = 3", &["wrong.toml"]),
        ("bytes.toml", &[0xff, 0xfe, 0x00], &["bytes.toml", "text"]),
    ];
    let mut window = Window::mannequin(USUAL);
    window.frames(40);
    let before = window.viewer().stage.first().expect("a frame").joints[1].heading;
    assert!(before.abs() > 0.01);
    for (name, bytes, told) in cases {
        window.drop_bytes(name, bytes);
        let trouble = window.viewer().trouble.clone().expect("trouble");
        assert!(told.iter().all(|word| trouble.contains(word)), "{name}: {trouble}");
        assert!(window.texts().contains(&trouble), "it is shown");
        assert_eq!(window.viewer().stage.character.name, "the mannequin");
        let now = window.viewer().stage.first().expect("a frame").joints[1].heading;
        assert!((now - before).abs() < 0.2, "the joints stay where they were: {before} {now}");
        window.click("dismiss");
        assert_eq!(window.viewer().trouble, None);
        assert!(!window.is_shown("dismiss"));
    }
    window.drop_file(egui::DroppedFile { name: "nothing.glb".into(), ..Default::default() });
    assert!(window.viewer().trouble.as_ref().is_some_and(|text| text.contains("nothing.glb")));
    window.drop_file(egui::DroppedFile { path: Some("/no/such.toml".into()), ..Default::default() });
    assert!(window.viewer().trouble.as_ref().is_some_and(|text| text.contains("such.toml")));
    window.drop_bytes("hero.glb", &model());
    assert_eq!(window.viewer().trouble, None, "what fits clears it");
}

#[test]
fn long_trouble_wraps_and_can_be_dismissed_in_a_small_window() {
    let mut window = Window::mannequin([400.0, 300.0]);
    window.harness.state_mut().trouble = Some("much is wrong with it, ".repeat(200));
    window.frames(3);
    let button = window.rect("dismiss");
    assert!(Rect::from_min_size(Pos2::ZERO, egui::vec2(400.0, 300.0)).contains_rect(button), "{button:?}");
    window.click("dismiss");
    assert_eq!(window.viewer().trouble, None);
}

#[test]
fn a_turret_without_clips_eyes_or_neck_is_aimed() {
    let mut window = Window::mannequin(TALL);
    window.drop_bytes("tank.gltf", TANK.as_bytes());
    assert_eq!(window.viewer().trouble, None);
    let stage = &window.viewer().stage;
    assert_eq!((stage.clock.play.clip, stage.tuning.spec.joints.len()), (None, 2));
    window.click("both eyes");
    assert!(!window.viewer().stage.tuning.both_eyes, "there is no pair");
    window.frames(120);
    assert!(window.viewer().stage.first().expect("a frame").error_deg < 0.5);
    window.press(Key::E);
    assert_eq!(window.viewer().stage.effector(), 1);
    window.press(Key::E);
    for name in ["solver: side by side", "path: orbit", "show limits", "show reference frames", "clip"] {
        window.click(name);
    }
    assert!(window.is_shown("clip: rest pose") && !window.is_shown("clip: walk"));
    window.frames(60);
    assert_eq!(window.viewer().stage.actors.len(), 3);
}

#[test]
fn one_joint_has_nothing_to_switch_to() {
    let mut window = Window::mannequin(USUAL);
    window.drop_bytes("stiff.toml", STIFF.as_bytes());
    window.press(Key::E);
    assert_eq!(window.viewer().stage.effector(), 0);
    window.frames(30);
    assert!(window.viewer().stage.first().is_some());
}
