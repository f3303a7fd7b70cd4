//! Tests of the mouse in the scene, and outside it.

use eframe::egui::{PointerButton, Vec2, vec2};

use super::*;
use crate::tuning::Lineup;

/// Returns an empty place in the scene.
fn elsewhere(window: &Window) -> Pos2 {
    let scene = window.scene.get();
    scene.left_top() + vec2(40.0, scene.height() * 0.5)
}

#[test]
fn the_target_is_dragged_where_the_pointer_goes() {
    let mut window = Window::mannequin(USUAL);
    window.click("path: orbit");
    window.click("pause");
    let camera = window.viewer().camera;
    let from = window.seen(window.viewer().stage.target_now());
    let to = from + vec2(-120.0, 60.0);
    window.drag(PointerButton::Primary, from, to);
    let seen = window.seen(window.viewer().stage.target_now());
    assert!(seen.distance(to) < 1.0, "{seen} instead of {to}");
    assert_eq!((window.viewer().camera, window.viewer().stage.target.path), (camera, crate::target::Path::Still));
}

#[test]
fn any_figures_target_can_be_dragged() {
    let mut window = Window::mannequin(USUAL);
    window.click("solver: side by side");
    window.harness.state_mut().step_back();
    window.click("pause");
    assert_eq!(window.viewer().stage.tuning.lineup, Lineup::All);
    for at in 0..3 {
        let target = |window: &Window| window.viewer().stage.target_now() + window.viewer().stage.actors[at].shift;
        let from = window.seen(target(&window));
        let to = from + vec2(30.0, -20.0);
        window.drag(PointerButton::Primary, from, to);
        assert!(window.seen(target(&window)).distance(to) < 2.0, "figure {at}");
    }
}

#[test]
fn elsewhere_the_mouse_turns_and_moves_the_camera() {
    let mut window = Window::mannequin(USUAL);
    let from = elsewhere(&window);
    let [camera, target] = [window.viewer().camera.focus, window.viewer().stage.target_now()];
    let [yaw, pitch] = [window.viewer().camera.yaw, window.viewer().camera.pitch];
    window.drag(PointerButton::Primary, from, from + vec2(50.0, 25.0));
    let turned = window.viewer().camera;
    // The front of the scene follows the pointer.
    assert!(turned.yaw < yaw && turned.pitch > pitch && turned.focus == camera, "{turned:?}");
    for button in [PointerButton::Secondary, PointerButton::Middle] {
        let before = window.viewer().camera;
        let seen = window.seen(before.focus);
        window.drag(button, from, from + vec2(40.0, -30.0));
        let after = window.viewer().camera;
        assert_eq!((after.yaw, after.pitch, after.distance), (before.yaw, before.pitch, before.distance));
        let by: Vec2 = window.seen(before.focus) - seen;
        assert!((by - vec2(40.0, -30.0)).length() < 1.0, "{button:?} moves by {by}");
    }
    assert_eq!(window.viewer().stage.target_now(), target);
}

#[test]
fn the_wheel_zooms_in_the_scene_alone() {
    let mut window = Window::mannequin(USUAL);
    let distance = |window: &Window| window.viewer().camera.distance;
    let at = elsewhere(&window);
    let first = distance(&window);
    window.wheel(at, 100.0);
    let near = distance(&window);
    assert!(near < first * 0.95);
    window.wheel(at, -200.0);
    assert!(distance(&window) > first);
    let last = distance(&window);
    for over in ["weight", "plot: all"] {
        let over = window.rect(over).center();
        window.wheel(over, 100.0);
        assert_eq!(distance(&window), last, "the wheel scrolls what it is over");
    }
    let plot = window.scene.get().center_bottom() + vec2(0.0, 100.0);
    window.wheel(plot, 100.0);
    assert_eq!(distance(&window), last);
}

#[test]
fn plots_take_no_drags() {
    let mut window = Window::mannequin(USUAL);
    window.frames(30);
    let before = window.viewer().camera;
    let plot = window.scene.get().center_bottom() + vec2(50.0, 90.0);
    window.drag(PointerButton::Primary, plot, plot + vec2(60.0, 20.0));
    assert_eq!(window.viewer().camera, before);
}

#[test]
fn the_panel_is_made_wider() {
    let mut window = Window::mannequin(USUAL);
    let edge = window.scene.get().right_center() + vec2(1.0, 0.0);
    window.drag(PointerButton::Primary, edge, edge - vec2(60.0, 0.0));
    assert!(window.scene.get().right() < edge.x - 40.0, "{:?} {edge}", window.scene.get());
}
