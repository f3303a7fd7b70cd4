//! Tests of playing clips: seeking, transitions, a separate clip on the upper body, and in-place movement.

use aim_animation::{Clip, Track};
use aim_runtime::glam::{DVec3, Quat, Vec3};
use egui_kittest::kittest::Queryable;

use super::{USUAL, Window};
use crate::character::Character;

/// Returns a window with the mannequin and a clip in which its hips move ahead by two metres in a second and its left
/// arm is raised.
fn gliding() -> Window {
    let mannequin = Character::mannequin().expect("the mannequin");
    let skeleton = mannequin.skeleton();
    let bone = |name: &str| skeleton.find(name).expect("it has one");
    let (hips, arm) = (bone("hips"), bone("left_upper_arm"));
    let rest = skeleton.rest();
    let places = [Vec3::ZERO, Vec3::Z * 2.0].map(|by| rest[hips].translation + by);
    let raised = [0.0, 1.0].map(|angle| Quat::from_rotation_z(angle) * rest[arm].rotation);
    let clip = Clip::new("glide")
        .with_translation(hips, Track::linear([0.0, 1.0], places).expect("two keys"))
        .with_rotation(arm, Track::linear([0.0, 1.0], raised).expect("two keys"));
    let file = mannequin.document.with_clips(&[clip]).expect("it can be written");
    let mut window = Window::new(Character::from_bytes("gliding.glb", &file).expect("as the mannequin"), USUAL);
    // Turn aiming off and wait until the corrections are gone, so that only the animation is visible.
    window.harness.state_mut().stage.tuning.settings.weight = 0.0;
    window.frames(150);
    window
}

fn place(window: &Window, name: &str) -> DVec3 {
    let stage = &window.viewer().stage;
    let node = stage.character.skeleton().find(name).expect("it has one");
    stage.first().expect("there is a frame").world[node].translation
}

/// Returns a node's position at a time of a clip, computed directly from the file.
fn authored(window: &Window, clip: &str, seconds: f32, name: &str) -> DVec3 {
    let character = &window.viewer().stage.character;
    let (skeleton, clip) = (character.skeleton(), character.document.clip(clip).expect("it is there"));
    skeleton.world_f64(&skeleton.pose(clip, seconds))[skeleton.find(name).expect("it has one")].translation
}

fn choose(window: &mut Window, list: &str, entry: &str) {
    window.click(list);
    window.click(&format!("{list}: {entry}"));
}

#[test]
fn any_time_of_a_clip_can_be_gone_to() {
    let mut window = gliding();
    window.click("pause");
    let foot = "left_foot";
    let bar = window.rect("time");
    for share in [0.2, 0.9, 0.5] {
        let to = bar.left_center() + eframe::egui::vec2(share * bar.width(), 0.0);
        window.drag(eframe::egui::PointerButton::Primary, bar.center(), to);
        let time = window.viewer().stage.actors[0].player.time();
        let length = window.viewer().stage.clip_length();
        assert!((time / length - share).abs() < 0.08, "{time} s of {length} s for {share}");
        let wanted = authored(&window, "walk", time, foot);
        assert!(place(&window, foot).distance(wanted) < 1e-5, "at {time} s");
    }
}

#[test]
fn one_clip_goes_over_into_another() {
    let mut window = gliding();
    for fade_s in [0.5, 0.0] {
        window.harness.state_mut().stage.clock.play.fade_s = fade_s;
        choose(&mut window, "clip", "walk");
        window.frames(60);
        let hand = "left_hand";
        window.click("clip");
        let before = place(&window, hand);
        window.harness.get(super::by("clip: rest pose")).click();
        window.harness.step();
        let step = place(&window, hand).distance(before);
        let rest = window.viewer().stage.character.skeleton().clone();
        let rest = rest.world_f64(rest.rest())[rest.find(hand).expect("it has one")].translation;
        let left = place(&window, hand).distance(rest);
        // With a fade the hand is still near its old position, without one it is in the new pose at once.
        assert!(if fade_s > 0.0 { left > step } else { left < 1e-4 }, "{step} m gone, {left} m from the rest pose");
        window.frames(40);
        let left = place(&window, hand).distance(rest);
        assert!(left < 1e-4, "{left} m from the rest pose in the end");
    }
}

#[test]
fn the_upper_body_has_a_clip_of_its_own() {
    let mut window = gliding();
    window.harness.state_mut().stage.clock.play.fade_s = 0.0;
    choose(&mut window, "clip", "rest pose");
    choose(&mut window, "upper", "glide");
    window.frames(30);
    let rest = window.viewer().stage.character.skeleton().clone();
    let at_rest = |name: &str| rest.world_f64(rest.rest())[rest.find(name).expect("it has one")].translation;
    assert!(place(&window, "left_hand").distance(at_rest("left_hand")) > 0.05, "the arm moves");
    for still in ["hips", "left_foot", "right_hand"] {
        assert!(place(&window, still).distance(at_rest(still)) < 1e-4, "{still}");
    }
    choose(&mut window, "upper", "as the clip");
    window.frames(2);
    assert!(place(&window, "left_hand").distance(at_rest("left_hand")) < 1e-4);
}

#[test]
fn a_character_walks_on_the_spot() {
    let mut window = gliding();
    choose(&mut window, "clip", "glide");
    window.frames(40);
    let gone = place(&window, "hips").z;
    assert!(gone > 0.5, "{gone} m");
    window.click("in place");
    for _ in 0..30 {
        window.frames(3);
        let away = place(&window, "hips").with_y(0.0).length();
        assert!(away < 1e-3, "{away} m");
    }
}
