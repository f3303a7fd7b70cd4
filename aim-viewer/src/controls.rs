//! Keys and the mouse: the one place that turns input into changes of what is shown.

use aim_runtime::glam::{Vec2, Vec3};
use eframe::egui::{Context, InputState, Key, PointerButton, Rect, Response};

use crate::camera::Camera;
use crate::gizmos::{Shown, TARGET};
use crate::stage::Stage;
use crate::tools::Tool;

/// Speeds of held keys: of the target, metres of a 1.7 m character a second; of the camera, radians a second; of the zoom,
/// to the power of seconds.
const TARGET_SPEED: f32 = 1.2;
const TURN_SPEED: f32 = 1.5;
const ZOOM_SPEED: f32 = 0.4;
/// Turn by the mouse, radians a point, and zoom by its wheel, to the power of points.
const MOUSE_TURN: f32 = 0.008;
const WHEEL_ZOOM: f32 = 0.998;
/// The target is taken hold of within this distance from its edge, points.
const GRASP: f32 = 12.0;

/// Every key with what it does, for the help; the paper's are the first.
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

/// Actions of the mouse in the scene.
pub(crate) const MOUSE: [(&str, &str); 4] = [
    ("Drag the target", "moves it across the view"),
    ("Drag elsewhere", "turns the camera"),
    ("Right drag", "moves the camera"),
    ("Wheel", "camera nearer, further"),
];

/// The thing that the mouse drags.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Held {
    /// The target of the figure that stands so far aside.
    Target(Vec3),
    /// The view: it turns.
    View,
}

/// Keys that are held or were pressed.
pub(crate) fn keys(context: &Context, stage: &mut Stage, camera: &mut Camera, shown: &mut Shown, seconds: f32) {
    if context.egui_wants_keyboard_input() {
        return;
    }
    context.input(|input| {
        // With these, keys are the window's or the browser's.
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

/// One of two keys: 1, the other: −1, none or both: 0.
fn either(input: &InputState, plus: Key, minus: Key) -> f32 {
    f32::from(i8::from(input.key_down(plus)) - i8::from(input.key_down(minus)))
}

fn move_target(input: &InputState, stage: &mut Stage, camera: &Camera, seconds: f32) {
    // As the viewer sees it, but level: up is the character's.
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

/// The mouse over the scene: it drags the target, turns the view, moves it with another button, and zooms.
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

/// Shift of the figure whose target is under a point of the scene, which is given from its upper left.
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
