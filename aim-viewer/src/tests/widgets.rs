//! Tests of every control of the panel, the plots and the overlay, by name.

use std::f64::consts::PI;

use aim_codegen::declare::{from_derive_input, from_toml};
use aim_codegen::{AngleRange, JointSpec, RigSpec};
use aim_runtime::Behind;
use serde_json::{Value, json};

use super::*;
use crate::target::Path;
use crate::tuning::Lineup;

/// A rig for the mannequin that uses every setting that the panel can show for a joint.
const RICH: &str = r#"
name = "Rich"
axes = { up = "+X", forward = "+Y", left = "+Z" }
[[joint]]
name = "left_eye"
role = "eye"
other_eye = "right_eye"
heading = ["-35deg", "35deg"]
pitch = ["-25deg", "20deg"]
pitch_taper = 0.3
rate = "450deg"
stiffness = 0.5
[[joint]]
name = "neck"
role = "neck"
heading = ["-60deg", "60deg"]
pitch = ["-40deg", "35deg"]
limits_from = "bind_pose"
rate = "170deg"
acceleration = "900deg"
[[joint]]
name = "spine3"
role = "chest"
heading = "free"
rate = "70deg"
upright = 0.5
"#;

fn rich() -> Window {
    let mannequin = Character::mannequin().expect("the mannequin");
    Window::new(mannequin.with_rig("rich.toml", RICH).expect("it fits"), TALL)
}

fn spec(viewer: &Viewer) -> &RigSpec {
    &viewer.stage.tuning.spec
}

fn ends(range: Option<AngleRange>) -> [f64; 2] {
    match range {
        Some(AngleRange::Between(lo, hi)) => [lo, hi].map(|end| (end.to_degrees() * 1e6).round() / 1e6),
        Some(AngleRange::Free) => [f64::NEG_INFINITY, f64::INFINITY],
        None => [0.0; 2],
    }
}

/// A control to click, a function that reads the state, and its values before and after.
type Click = (&'static str, fn(&Viewer) -> String, &'static str, &'static str);

const CLICKS: &[Click] = &[
    ("pause", |v| v.stage.clock.paused.to_string(), "false", "true"),
    ("go on", |v| v.stage.clock.paused.to_string(), "true", "false"),
    ("step", |v| v.stage.clock.paused.to_string(), "false", "true"),
    ("in place", |v| v.stage.clock.play.in_place.to_string(), "false", "true"),
    ("solver: exact", |v| v.stage.tuning.lineup.name().into(), "natural", "exact"),
    ("solver: side by side", |v| v.stage.actors.len().to_string(), "1", "3"),
    ("instead: look at", tool, "None", "Some(LookAt)"),
    ("instead: one bone", tool, "Some(LookAt)", "Some(OneBone)"),
    ("instead: ccd", tool, "Some(OneBone)", "Some(Ccd)"),
    ("instead: aim poses", tool, "Some(Ccd)", "Some(AimPoses)"),
    ("instead: none", tool, "Some(AimPoses)", "None"),
    ("as published", |v| v.stage.tuning.as_published.to_string(), "false", "true"),
    ("solver: ascent", |v| v.stage.tuning.lineup.name().into(), "side by side", "ascent"),
    ("solver: natural", |v| v.stage.tuning.lineup.name().into(), "ascent", "natural"),
    ("effector: neck", |v| v.stage.effector().to_string(), "0", "1"),
    ("effector: spine3", |v| v.stage.effector().to_string(), "1", "2"),
    ("effector: eyes", |v| v.stage.effector().to_string(), "2", "0"),
    ("both eyes", |v| v.stage.tuning.both_eyes.to_string(), "true", "false"),
    ("behind: off", behind, "Clip", "Off"),
    ("behind: plane", behind, "Off", "Plane"),
    ("behind: hold", behind, "Plane", "Hold"),
    ("behind: release", behind, "Hold", "Release"),
    ("behind: clip", behind, "Release", "Clip"),
    ("path: orbit", |v| v.stage.target.path.name().into(), "still", "orbit"),
    ("path: figure of eight", |v| v.stage.target.path.name().into(), "orbit", "figure of eight"),
    ("path: noise", |v| v.stage.target.path.name().into(), "figure of eight", "noise"),
    ("path: still", |v| v.stage.target.path.name().into(), "noise", "still"),
    ("show gaze", |v| v.shown.gaze.to_string(), "true", "false"),
    ("show limits", |v| v.shown.limits.to_string(), "false", "true"),
    ("show reference frames", |v| v.shown.axes.to_string(), "false", "true"),
    ("show boxes", |v| v.shown.boxes.to_string(), "false", "true"),
    ("show lamp", |v| v.shown.lamp.to_string(), "false", "true"),
    ("show slope", |v| v.stage.is_sloped.to_string(), "false", "true"),
    ("show trail", |v| v.shown.trail.to_string(), "true", "false"),
    ("show timing", |v| v.shown.timing.to_string(), "true", "false"),
    ("show dark", |v| v.shown.dark.to_string(), "true", "false"),
    ("plot: neck", |v| format!("{:?}", v.plotted), "None", "Some(1)"),
    ("plot: spine3", |v| format!("{:?}", v.plotted), "Some(1)", "Some(2)"),
    ("plot: left_eye", |v| format!("{:?}", v.plotted), "Some(2)", "Some(0)"),
    ("plot: all", |v| format!("{:?}", v.plotted), "Some(0)", "None"),
    ("show plots", |v| v.shown.plots.to_string(), "true", "false"),
    ("neck heading free", |v| ends(spec(v).joints[1].heading)[1].to_string(), "60", "inf"),
    ("spine3 heading free", |v| ends(spec(v).joints[2].heading)[1].to_string(), "inf", "90"),
    ("hide the panel", |v| v.shown.panel.to_string(), "true", "false"),
    ("show the panel", |v| v.shown.panel.to_string(), "false", "true"),
];

fn tool(viewer: &Viewer) -> String {
    format!("{:?}", viewer.stage.actors[0].tool)
}

fn behind(viewer: &Viewer) -> String {
    let policy: Behind = viewer.stage.tuning.settings.behind;
    format!("{policy:?}")
}

/// A control to drag, and a function that reads its value. Dragging right increases the value, dragging left decreases
/// it.
type Drag = (&'static str, fn(&Viewer) -> f64);

const DRAGS: &[Drag] = &[
    ("speed", |v| v.stage.clock.speed.into()),
    ("fade", |v| v.stage.clock.play.fade_s.into()),
    ("weight", |v| v.stage.tuning.settings.weight.into()),
    ("attention", |v| v.stage.tuning.settings.attention.into()),
    ("crowd", |v| f64::from(u32::try_from(v.stage.tuning.crowd).expect("few"))),
    ("target left", |v| v.stage.room().place(v.stage.target_now())[0].into()),
    ("target up", |v| v.stage.room().place(v.stage.target_now())[1].into()),
    ("target front", |v| v.stage.room().place(v.stage.target_now())[2].into()),
    ("left_eye heading from", |v| ends(spec(v).joints[0].heading)[0]),
    ("left_eye heading to", |v| ends(spec(v).joints[0].heading)[1]),
    ("left_eye pitch from", |v| ends(spec(v).joints[0].pitch)[0]),
    ("left_eye pitch to", |v| ends(spec(v).joints[0].pitch)[1]),
    ("left_eye rate", |v| spec(v).joints[0].rate),
    ("left_eye stiffness", |v| spec(v).joints[0].stiffness),
    ("neck heading from", |v| ends(spec(v).joints[1].heading)[0]),
    ("neck heading to", |v| ends(spec(v).joints[1].heading)[1]),
    ("neck pitch from", |v| ends(spec(v).joints[1].pitch)[0]),
    ("neck pitch to", |v| ends(spec(v).joints[1].pitch)[1]),
    ("neck rate", |v| spec(v).joints[1].rate),
    ("neck acceleration", |v| spec(v).joints[1].acceleration.unwrap_or_default()),
    ("neck stiffness", |v| spec(v).joints[1].stiffness),
    ("spine3 rate", |v| spec(v).joints[2].rate),
    ("spine3 stiffness", |v| spec(v).joints[2].stiffness),
];

/// Collapsible sections, each with a control that it contains.
const FOLDS: &[(&str, &str)] = &[
    ("group Animation", "pause"),
    ("group Aiming", "weight"),
    ("group Target", "path: orbit"),
    ("group Joints", "joint neck"),
    ("joint left_eye", "left_eye rate"),
    ("joint neck", "neck rate"),
    ("joint spine3", "spine3 rate"),
    ("group Show", "show gaze"),
    ("group Rig", "copy as Rust"),
];

/// Controls with separate tests below.
const OTHERS: &[&str] = &[
    "clip",
    "clip: rest pose",
    "clip: walk",
    "clip: walk_ahead",
    "clip: walk_circle",
    "clip: run",
    "clip: jump",
    "clip: turn",
    "clip: wave",
    "upper",
    "upper: as the clip",
    "upper: walk",
    "upper: walk_ahead",
    "upper: walk_circle",
    "upper: run",
    "upper: jump",
    "upper: turn",
    "upper: wave",
    "time",
    "restart",
    "reset the target",
    "reset the view",
    "left_eye as declared",
    "neck as declared",
    "spine3 as declared",
    "left_eye heading free",
    "spine3 heading from",
    "spine3 heading to",
    "copy as Rust",
    "copy as TOML",
    "group Help",
    "dismiss",
    // Tested in `mouse.rs`.
    "scene",
];

/// Expands the sections of all joints.
fn unfold(window: &mut Window) {
    for joint in ["joint left_eye", "joint neck", "joint spine3"] {
        window.click(joint);
    }
}

/// Drags a drag value or slider by this number of points.
fn pull(window: &mut Window, name: &str, by: f32) {
    let from = window.rect(name).center();
    window.drag(egui::PointerButton::Primary, from, from + egui::vec2(by, 0.0));
}

#[test]
fn every_control_has_a_test() {
    let tested: BTreeSet<&str> = CLICKS
        .iter()
        .map(|case| case.0)
        .chain(DRAGS.iter().map(|case| case.0))
        .chain(FOLDS.iter().map(|case| case.0))
        .chain(OTHERS.iter().copied())
        .collect();
    let mut window = rich();
    unfold(&mut window);
    window.click("group Help");
    let mut found = window.controls();
    // Controls that are shown only at times: open lists, the second label of a button, the range of a joint that was
    // free.
    for list in ["clip", "upper"] {
        window.click(list);
        found.extend(window.controls());
        window.press(Key::Escape);
    }
    window.click("pause");
    window.click("spine3 heading free");
    window.drop_bytes("nonsense.glb", b"nonsense");
    found.extend(window.controls());
    window.click("hide the panel");
    found.extend(window.controls());
    let found: BTreeSet<&str> = found.iter().map(String::as_str).collect();
    let untested: Vec<_> = found.difference(&tested).collect();
    assert!(untested.is_empty(), "no test clicks or drags {untested:?}");
    let gone: Vec<_> = tested.difference(&found).collect();
    assert!(gone.is_empty(), "there are tests of what is not there: {gone:?}");
}

#[test]
fn clicks_change_what_they_say() {
    let mut window = rich();
    unfold(&mut window);
    for (name, read, before, after) in CLICKS {
        assert_eq!(read(window.viewer()), *before, "before {name}");
        window.click(name);
        assert_eq!(read(window.viewer()), *after, "after {name}");
    }
}

#[test]
fn drags_change_what_they_say() {
    let mut window = rich();
    unfold(&mut window);
    for (name, read) in DRAGS {
        // Sliders jump to the pointer, so the drag starts from the middle of the slider.
        pull(&mut window, name, -12.0);
        let before = read(window.viewer());
        pull(&mut window, name, 40.0);
        let between = read(window.viewer());
        pull(&mut window, name, -60.0);
        let after = read(window.viewer());
        assert!(between > before && after < between, "{name}: {before}, to the right {between}, to the left {after}");
    }
    let shown = window.viewer().stage.tuning.crowd;
    assert_eq!(window.viewer().stage.crowd.len() + 1, shown, "the crowd is there");
}

#[test]
fn groups_fold() {
    let mut window = rich();
    unfold(&mut window);
    for (heading, inside) in FOLDS {
        assert!(window.is_shown(inside), "{heading} is open");
        window.click(heading);
        assert!(!window.is_shown(inside), "{heading} is folded");
        window.click(heading);
        assert!(window.is_shown(inside), "{heading} is open again");
    }
    let has_keys = |window: &Window| window.texts().iter().any(|text| text == crate::controls::KEYS[0].1);
    assert!(!has_keys(&window));
    window.click("group Help");
    assert!(has_keys(&window), "the help tells the keys");
}

#[test]
fn clips_are_chosen_and_restarted() {
    let mut window = Window::mannequin(TALL);
    window.frames(30);
    window.click("clip");
    window.click("clip: rest pose");
    assert_eq!(window.viewer().stage.clock.play.clip, None);
    window.click("clip");
    window.click("clip: walk");
    let clock = window.viewer().stage.clock;
    assert!(clock.play.clip == Some(0) && clock.time < 0.1, "a clip begins at its beginning: {clock:?}");
    window.click("path: orbit");
    window.frames(60);
    let turned = |window: &Window| window.viewer().stage.first().expect("a frame").joints[1].heading.abs();
    assert!(turned(&window) > 0.1);
    window.click("restart");
    let stage = &window.viewer().stage;
    assert!(stage.clock.time < 0.1 && stage.target.time < 0.1 && stage.memory.len() <= 2, "{:?}", stage.clock);
    assert!(turned(&window) < 0.1, "the joints are at rest");
}

#[test]
fn the_target_and_the_view_are_put_back() {
    let mut window = Window::mannequin(TALL);
    let [target, camera] = [window.viewer().stage.target_now(), window.viewer().camera.focus];
    window.click("path: orbit");
    window.frames(30);
    window.click("reset the target");
    assert_eq!((window.viewer().stage.target_now(), window.viewer().stage.target.path), (target, Path::Still));
    let scene = window.scene.get();
    let from = scene.left_top() + egui::vec2(60.0, 300.0);
    window.drag(egui::PointerButton::Secondary, from, from + egui::vec2(50.0, 50.0));
    assert!(window.viewer().camera.focus.distance(camera) > 0.01);
    window.click("reset the view");
    assert_eq!(window.viewer().camera.focus, camera);
}

#[test]
fn a_chosen_path_starts_where_it_is_and_ends_where_the_target_is() {
    let mut window = Window::mannequin(TALL);
    window.click("path: noise");
    window.frames(40);
    let before = window.viewer().stage.target_now();
    window.click("path: still");
    let after = window.viewer().stage.target_now();
    assert!(before.distance(after) < 0.2, "it stays where it was: {before} {after}");
    assert_eq!(window.viewer().stage.target_now(), window.viewer().stage.target.place);
}

#[test]
fn numbers_are_typed() {
    let mut window = rich();
    unfold(&mut window);
    window.click("neck heading to");
    window.harness.event(egui::Event::Text("12.5".into()));
    window.press(Key::Enter);
    window.frames(2);
    assert_eq!(ends(spec(window.viewer()).joints[1].heading), [-60.0, 12.5]);
    // Typing does not move the target or the camera.
    let before = (window.viewer().stage.target_now(), window.viewer().camera);
    window.click("neck rate");
    window.hold(Key::K, 3);
    assert_eq!((window.viewer().stage.target_now(), window.viewer().camera), before);
}

/// Checks that a joint can be declared.
fn assert_declarable(joint: &JointSpec) {
    for range in [joint.heading, joint.pitch].into_iter().flatten() {
        if let AngleRange::Between(lo, hi) = range {
            assert!((-PI..=0.0).contains(&lo) && (0.0..=PI).contains(&hi) && lo < hi, "{lo} {hi}");
            assert!(lo <= -PI / 180.0 || hi >= PI / 180.0, "{lo} {hi}");
        }
    }
    assert!(joint.rate > 0.0 && joint.stiffness > 0.0 && joint.acceleration.is_none_or(|a| a > 0.0), "{joint:?}");
}

#[test]
fn no_drag_makes_a_rig_that_cannot_be_declared() {
    let mut window = rich();
    unfold(&mut window);
    let joints =
        DRAGS.iter().filter(|(name, _)| name.contains('_') || name.starts_with("neck ") || name.starts_with("spine3 "));
    for by in [-900.0, 900.0, -900.0] {
        for (name, _) in joints.clone() {
            pull(&mut window, name, by);
            spec(window.viewer()).joints.iter().for_each(assert_declarable);
            assert_eq!(copied(&mut window, "copy as TOML", read_toml), *spec(window.viewer()), "{name}");
        }
    }
}

#[test]
fn joints_go_back_to_what_was_declared() {
    let mut window = rich();
    unfold(&mut window);
    let declared = spec(window.viewer()).clone();
    window.click("neck heading free");
    assert!(!window.is_shown("neck heading to"), "what is free has no ends");
    window.click("neck heading free");
    assert_eq!(*spec(window.viewer()), declared, "the declared range comes back");
    window.click("spine3 heading free");
    assert!(window.is_shown("spine3 heading from") && window.is_shown("spine3 heading to"));
    pull(&mut window, "spine3 heading from", 30.0);
    pull(&mut window, "spine3 heading to", -30.0);
    let [lo, hi] = ends(spec(window.viewer()).joints[2].heading);
    assert!(lo > -90.0 && hi < 90.0, "{lo} {hi}");
    window.click("left_eye heading free");
    assert_eq!(spec(window.viewer()).joints[0], declared.joints[0], "a narrowing needs ends");
    pull(&mut window, "left_eye rate", 60.0);
    pull(&mut window, "neck acceleration", -60.0);
    for (at, joint) in declared.joints.iter().enumerate() {
        assert_ne!(spec(window.viewer()).joints[at], *joint);
        window.click(&format!("{} as declared", joint.name));
        assert_eq!(spec(window.viewer()).joints[at], *joint);
    }
}

fn read_toml(text: &str) -> RigSpec {
    from_toml("copied.toml", text).unwrap_or_else(|errors| panic!("{}", errors.render()))
}

fn read_rust(text: &str) -> RigSpec {
    let (import, item) = text.split_once("\n\n").expect("an import and a struct");
    assert_eq!(import, "use aim::{AimRig, Joint};");
    let item = syn::parse_str(item).unwrap_or_else(|error| panic!("{error}: {text}"));
    from_derive_input(&item).unwrap_or_else(|errors| panic!("{}\n{text}", errors.render())).spec
}

/// Clicks a button, and parses the text that it copies to the clipboard.
fn copied(window: &mut Window, name: &str, read: fn(&str) -> RigSpec) -> RigSpec {
    window.harness.get(by(name)).click();
    window.harness.step();
    let command = window.harness.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    read(&command.expect("a text on the clipboard"))
}

#[test]
fn the_rig_is_copied_as_it_is_set() {
    let mut window = rich();
    unfold(&mut window);
    for (name, _) in DRAGS.iter().filter(|(name, _)| name.starts_with("left_eye") || name.starts_with("neck")) {
        pull(&mut window, name, 17.0);
    }
    window.click("spine3 heading free");
    let set = spec(window.viewer()).clone();
    assert_ne!(set, *window.viewer().stage.character.spec());
    assert_eq!(copied(&mut window, "copy as TOML", read_toml), set);
    assert!(window.texts().iter().any(|text| text.contains("TOML copied")), "it says so");
    assert_eq!(copied(&mut window, "copy as Rust", read_rust), set);
}

#[test]
fn everything_can_be_scrolled_to_in_a_small_window() {
    let mut window = Window::mannequin([800.0, 600.0]);
    assert!(window.rect("copy as TOML").min.y > 600.0);
    let over = window.rect("weight").center();
    for _ in 0..10 {
        window.wheel(over, -200.0);
    }
    assert!(window.rect("copy as TOML").max.y < 600.0, "{:?}", window.rect("copy as TOML"));
    let set = spec(window.viewer()).clone();
    assert_eq!(copied(&mut window, "copy as TOML", read_toml), set);
}

#[test]
fn plots_and_scene_share_the_window() {
    let mut window = Window::mannequin(USUAL);
    let with_plots = window.scene.get();
    window.click("show plots");
    assert!(window.scene.get().height() > with_plots.height() + 100.0);
    window.click("hide the panel");
    assert!(window.scene.get().width() > with_plots.width() + 200.0);
}

#[test]
fn programs_are_told_where_the_target_is_and_how_far_off_the_gaze() {
    let mut window = Window::mannequin(USUAL);
    window.frames(60);
    let state: Value = serde_json::from_str(&window.viewer().state()).expect("it is JSON");
    let target = window.viewer().stage.target_now();
    let rounded = |x: f32| (f64::from(x) * 1e4).round() / 1e4;
    let seen = <[f32; 2]>::from(window.seen(target)).map(rounded);
    let expected = json!({
        "solver": "natural",
        "status": "Reached",
        "error_deg": 0.0,
        "target": target.to_array().map(rounded),
        "target_seen": seen,
        "gazes_seen": state[0]["gazes_seen"],
    });
    assert_eq!(state, json!([expected]));
    assert_eq!(state[0]["gazes_seen"].as_array().map(Vec::len), Some(2), "of both eyes");
}

#[test]
fn the_overlay_tells_what_becomes_of_the_gaze() {
    let mut window = Window::mannequin(USUAL);
    window.frames(60);
    let has = |window: &Window, part: &str| window.texts().iter().any(|text| text.contains(part));
    for part in
        ["the mannequin", "reached", "on the target", "° off", "of a 60 Hz frame", "frames a second", "Drop a .glb"]
    {
        assert!(has(&window, part), "{part}: {:?}", window.texts());
    }
    assert!(!has(&window, "crowd of"));
    window.click("solver: side by side");
    window.click("show timing");
    window.frames(600);
    let names = window.texts().iter().filter(|text| *text == "ascent").count();
    assert!(names >= 3, "in the list, under the figure, and above the plot");
    assert!(!has(&window, "of a 60 Hz frame") && !has(&window, "Drop a .glb"), "{:?}", window.texts());
    window.click("show timing");
    window.harness.state_mut().stage.tuning.crowd = 12;
    window.frames(2);
    assert!(has(&window, "crowd of 12"), "{:?}", window.texts());
    assert_eq!(window.viewer().stage.tuning.lineup, Lineup::All);
}
