//! Tests of every key in the help.

use aim_runtime::glam::Vec3;

use super::*;
use crate::controls::KEYS;
use crate::gizmos::Shown;
use crate::stage::Stage;
use crate::tools::Tool;

/// The keys of an entry in the help, and for each a test of its effect.
type Case = (&'static str, &'static [(Key, fn(&mut Window, Key))]);

/// The entries, with the same names as in the help.
const CASES: [Case; 14] = [
    ("I K", &[(Key::I, |w, key| moves(w, key, up)), (Key::K, |w, key| moves(w, key, |w| -up(w)))]),
    ("J L", &[(Key::J, |w, key| moves(w, key, |w| -right(w))), (Key::L, |w, key| moves(w, key, right))]),
    ("M N", &[(Key::M, |w, key| moves(w, key, nearer)), (Key::N, |w, key| moves(w, key, |w| -nearer(w)))]),
    (
        "← → ↑ ↓",
        &[
            (Key::ArrowLeft, |w, key| turns(w, key, [-1.0, 0.0])),
            (Key::ArrowRight, |w, key| turns(w, key, [1.0, 0.0])),
            (Key::ArrowUp, |w, key| turns(w, key, [0.0, 1.0])),
            (Key::ArrowDown, |w, key| turns(w, key, [0.0, -1.0])),
        ],
    ),
    ("Z X", &[(Key::Z, |w, key| zooms(w, key, -1.0)), (Key::X, |w, key| zooms(w, key, 1.0))]),
    ("Q A", &[(Key::Q, |w, key| sets_frames(w, key, true)), (Key::A, |w, key| sets_frames(w, key, false))]),
    ("B", &[(Key::B, |w, key| toggles(w, key, |shown| shown.boxes))]),
    ("F", &[(Key::F, |w, key| toggles(w, key, |shown| shown.feet))]),
    ("G", &[(Key::G, |w, key| toggles(w, key, |shown| shown.lamp))]),
    ("E", &[(Key::E, switches_effector)]),
    ("Space", &[(Key::Space, pauses)]),
    ("T", &[(Key::T, changes_tool)]),
    (".", &[(Key::Period, steps)]),
    ("H", &[(Key::H, toggles_panel)]),
];

fn right(window: &Window) -> Vec3 {
    window.viewer().camera.axes()[0]
}

fn up(window: &Window) -> Vec3 {
    window.viewer().camera.directions[0]
}

fn nearer(window: &Window) -> Vec3 {
    right(window).cross(up(window))
}

/// Checks that the key moves the target by 0.6 m in half a second in this direction, and takes it off its path.
fn moves(window: &mut Window, key: Key, direction: impl Fn(&Window) -> Vec3) {
    window.click("path: orbit");
    let before = window.viewer().stage.target_now();
    window.hold(key, 30);
    let Stage { target, .. } = &window.viewer().stage;
    assert_eq!(target.path, crate::target::Path::Still, "{key:?} takes it off its path");
    let by = (window.viewer().stage.target_now() - before) / window.viewer().stage.room().metre;
    assert!(by.distance(direction(window) * 0.6) < 0.05, "{key:?} moves by {by}");
    let after = window.viewer().stage.target_now();
    window.frames(5);
    assert_eq!(window.viewer().stage.target_now(), after, "{key:?} was let go");
}

fn turns(window: &mut Window, key: Key, [yaw, pitch]: [f32; 2]) {
    let before = window.viewer().camera;
    window.hold(key, 20);
    let after = window.viewer().camera;
    let by = [after.yaw - before.yaw, after.pitch - before.pitch];
    assert!((by[0] - 0.5 * yaw).abs() < 0.06 && (by[1] - 0.5 * pitch).abs() < 0.06, "{key:?} turns by {by:?}");
}

fn zooms(window: &mut Window, key: Key, sign: f32) {
    let before = window.viewer().camera.distance;
    window.hold(key, 10);
    assert!((window.viewer().camera.distance / before).ln() * sign > 0.1, "{key:?}");
}

fn sets_frames(window: &mut Window, key: Key, wanted: bool) {
    window.harness.state_mut().shown.axes = !wanted;
    for _ in 0..2 {
        window.press(key);
        assert_eq!(window.viewer().shown.axes, wanted, "{key:?}");
    }
}

fn toggles(window: &mut Window, key: Key, flag: fn(&Shown) -> bool) {
    for wanted in [true, false] {
        window.press(key);
        assert_eq!(flag(&window.viewer().shown), wanted, "{key:?}");
    }
}

fn switches_effector(window: &mut Window, key: Key) {
    let mut seen = Vec::new();
    for _ in 0..3 {
        seen.push(window.viewer().stage.effector());
        window.press(key);
    }
    assert_eq!(seen, [0, 1, 0], "eyes, neck, eyes");
}

fn changes_tool(window: &mut Window, key: Key) {
    let tools = [None].into_iter().chain(Tool::ALL.map(Some)).chain([None]);
    for tool in tools {
        assert_eq!(window.viewer().stage.tuning.tool, tool);
        window.press(key);
    }
}

fn pauses(window: &mut Window, key: Key) {
    for wanted in [true, false] {
        window.press(key);
        assert_eq!(window.viewer().stage.clock.paused, wanted);
    }
}

fn steps(window: &mut Window, key: Key) {
    window.press(key);
    assert!(window.viewer().stage.clock.paused, "it pauses");
    let before = window.viewer().stage.clock.time;
    window.press(key);
    window.frames(5);
    let after = window.viewer().stage.clock.time;
    assert!((after - before - SIXTIETH).abs() < 1e-6, "by {}", after - before);
}

fn toggles_panel(window: &mut Window, key: Key) {
    for wanted in [false, true] {
        window.press(key);
        window.frames(1);
        assert_eq!((window.viewer().shown.panel, window.is_shown("pause")), (wanted, wanted));
    }
}

#[test]
fn every_key_of_the_help_does_what_it_says() {
    assert_eq!(CASES.map(|case| case.0), KEYS.map(|key| key.0), "each has a test");
    for (_, keys) in CASES {
        for (key, test) in keys {
            test(&mut Window::mannequin(USUAL), *key);
        }
    }
}

#[test]
fn keys_with_modifiers_are_the_windows() {
    let mut window = Window::mannequin(USUAL);
    let before = (window.viewer().camera, window.viewer().stage.target_now(), window.viewer().shown);
    for key in [Key::Q, Key::Z, Key::I, Key::H, Key::Space, Key::E] {
        window.harness.key_press_modifiers(egui::Modifiers::COMMAND, key);
        window.harness.step();
        window.frames(1);
    }
    assert_eq!((window.viewer().camera, window.viewer().stage.target_now(), window.viewer().shown), before);
    assert!(!window.viewer().stage.clock.paused && window.viewer().stage.effector() == 0);
}

#[test]
fn keys_still_work_after_a_click_on_the_panel() {
    let mut window = Window::mannequin(USUAL);
    for name in ["show gaze", "solver: exact", "crowd", "pause"] {
        window.click(name);
        window.press(Key::Q);
        assert!(window.viewer().shown.axes, "after {name}");
        window.press(Key::A);
    }
}
