//! Keyboard and mouse control of the stage, the camera and what is shown.

use aim_runtime::glam::{Vec2, Vec3};
use eframe::egui::{Context, InputState, Key, PointerButton, Rect, Response};

use crate::camera::Camera;
use crate::gizmos::{Shown, TARGET};
use crate::stage::Stage;
use crate::tools::Tool;

/// Speed of the target while a key is held, metres of a 1.7 m character per second.
const TARGET_SPEED: f32 = 1.2;
/// Speed of the camera's turn while a key is held, radians per second.
const TURN_SPEED: f32 = 1.5;
/// Factor of the camera's distance per second while the zoom key is held.
const ZOOM_SPEED: f32 = 0.4;
/// Turn of the camera per point of mouse movement, radians.
const MOUSE_TURN: f32 = 0.008;
/// Factor of the camera's distance per point of scrolling.
const WHEEL_ZOOM: f32 = 0.998;
/// Distance from the target's edge within which the mouse picks it up, points.
const GRASP: f32 = 12.0;

/// The keys and their actions, for the help; those of the paper come first.
pub(crate) const KEYS: [(&str, &str); 14] = [
    ("I K", "target up, down"),
    ("J L", "target left, right"),
    ("M N", "target nearer to you, further"),
    ("← → ↑ ↓", "turn the camera"),
    ("Z X", "camera nearer, further"),
    ("Q A", "bones' reference frames on, off"),
    ("B", "boxes of the bones on, off"),
    ("F", "a sloped floor with planted feet on, off"),
    ("G", "a lamp in the right hand on, off"),
    ("E", "aim the eyes or the neck"),
    ("Space", "pause, go on"),
    ("T", "the next solver instead of the rig's"),
    (".", "a single frame"),
    ("H", "this panel on, off"),
];

/// The mouse actions in the scene, for the help.
pub(crate) const MOUSE: [(&str, &str); 4] = [
    ("Drag the target", "moves it across the view"),
    ("Drag elsewhere", "turns the camera"),
    ("Right drag", "moves the camera"),
    ("Wheel", "camera nearer, further"),
];

/// The object of a mouse drag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Held {
    /// The target of the figure with this offset.
    Target(Vec3),
    /// The view, which the drag turns.
    View,
}

/// Applies the keys that are held or were pressed in this frame.
pub(crate) fn keys(context: &Context, stage: &mut Stage, camera: &mut Camera, shown: &mut Shown, seconds: f32) {
    if context.egui_wants_keyboard_input() {
        return;
    }
    context.input(|input| {
        // Key combinations with these modifiers belong to the window or the browser.
        if input.modifiers.command || input.modifiers.ctrl || input.modifiers.alt {
            return;
        }
        move_target(input, stage, camera, seconds);
        move_camera(input, camera, stage.character.metre(), seconds);
        for event in [(Key::Q, true), (Key::A, false)] {
            if input.key_pressed(event.0) {
                shown.axes = event.1;
            }
        }
        for (key, flag) in [
            (Key::B, &mut shown.boxes),
            (Key::F, &mut shown.feet),
            (Key::G, &mut shown.lamp),
            (Key::H, &mut shown.panel),
        ] {
            *flag ^= input.key_pressed(key);
        }
        if input.key_pressed(Key::E) {
            stage.switch_effector();
        }
        if input.key_pressed(Key::T) {
            stage.tuning.tool = Tool::after(stage.tuning.tool);
        }
        if input.key_pressed(Key::Space) {
            stage.clock.paused = !stage.clock.paused;
        }
        if input.key_pressed(Key::Period) {
            stage.clock.paused = true;
            stage.clock.step = true;
        }
    });
}

/// Returns 1 while only `plus` is held, −1 while only `minus` is, otherwise 0.
fn either(input: &InputState, plus: Key, minus: Key) -> f32 {
    f32::from(i8::from(input.key_down(plus)) - i8::from(input.key_down(minus)))
}

fn move_target(input: &InputState, stage: &mut Stage, camera: &Camera, seconds: f32) {
    // Move relative to the view, but along the character's up and the horizontal plane.
    let up = camera.directions[0];
    let [right, ..] = camera.axes();
    let nearer = right.cross(up);
    let by = right * either(input, Key::L, Key::J)
        + up * either(input, Key::I, Key::K)
        + nearer * either(input, Key::M, Key::N);
    if by != Vec3::ZERO {
        let room = stage.room();
        stage.target.move_by(&room, by * (TARGET_SPEED * room.metre * seconds));
    }
}

fn move_camera(input: &InputState, camera: &mut Camera, metre: f32, seconds: f32) {
    let turn = TURN_SPEED * seconds;
    camera.orbit(
        turn * either(input, Key::ArrowRight, Key::ArrowLeft),
        turn * either(input, Key::ArrowUp, Key::ArrowDown),
    );
    camera.zoom(ZOOM_SPEED.powf(seconds * either(input, Key::Z, Key::X)), metre);
}

/// Applies the mouse in the scene: it drags the target, turns the view, moves the view with another button, and zooms.
pub(crate) fn mouse(scene: &Response, stage: &mut Stage, camera: &mut Camera, held: &mut Option<Held>) {
    let rect = scene.rect;
    let delta = Vec2::new(scene.drag_delta().x, scene.drag_delta().y);
    if scene.drag_started_by(PointerButton::Primary) {
        let pressed = scene.ctx.input(|input| input.pointer.press_origin());
        let at = pressed.map(|at| Vec2::new(at.x - rect.left(), at.y - rect.top()));
        let grasped = at.and_then(|at| figure_of_target(stage, camera, rect, at));
        *held = Some(grasped.map_or(Held::View, Held::Target));
    }
    if scene.dragged_by(PointerButton::Primary) {
        match held {
            Some(Held::Target(shift)) => {
                let by = camera.drag(stage.target_now() + *shift, delta, rect.height());
                let room = stage.room();
                stage.target.move_by(&room, by);
            }
            _ => camera.orbit(-delta.x * MOUSE_TURN, delta.y * MOUSE_TURN),
        }
    } else if scene.dragged() {
        camera.focus -= camera.drag(camera.focus, delta, rect.height());
    }
    if scene.drag_stopped() {
        *held = None;
    }
    if scene.hovered() {
        let wheel = scene.ctx.input(|input| input.smooth_scroll_delta().y);
        camera.zoom(WHEEL_ZOOM.powf(wheel), stage.character.metre());
    }
}

/// Returns the offset of the figure whose target is under a point of the scene, given relative to its upper left
/// corner.
fn figure_of_target(stage: &Stage, camera: &Camera, rect: Rect, at: Vec2) -> Option<Vec3> {
    let size = Vec2::new(rect.width(), rect.height());
    let edge = camera.axes()[1] * (TARGET * stage.character.metre());
    let is_under = |shift: &Vec3| {
        let target = stage.target_now() + *shift;
        let seen = camera.project(target, size).zip(camera.project(target + edge, size));
        seen.is_some_and(|(middle, edge)| middle.distance(at) < middle.distance(edge) + GRASP)
    };
    stage.actors.iter().map(|actor| actor.shift).find(is_under)
}
