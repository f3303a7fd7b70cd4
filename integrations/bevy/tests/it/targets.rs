//! Tests of targets: several, characters that look at each other, entities without a transform, and snaps.

use bevy_aim::aim::glam::{DVec3, Vec3};
use bevy_aim::{AimSettings, AimSnap, AimStatus, AimTarget};
use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_transform::components::Transform;

use crate::stage::{self, Player, bone, drawn, error_deg, hero, outcome, spawn, status};

fn character(app: &mut App, place: Transform, target: AimTarget) -> Entity {
    let character = spawn(app, hero(), place, 1.0);
    app.world_mut().entity_mut(character).insert(target);
    character
}

#[test]
fn several_are_weighted() {
    let mut app = stage::app();
    let lamps = [-1.0, 1.0].map(|x| app.world_mut().spawn(Transform::from_xyz(x, 1.66, 3.0)).id());
    let [left, right] = lamps;
    let both = AimTarget::entity(left).and_entity(right, Vec3::ZERO, 3.0);
    let who = character(&mut app, Transform::IDENTITY, both);
    app.world_mut().get_mut::<Player>(who).expect("a player").plays = false;
    for _ in 0..120 {
        app.update();
    }
    let ahead = |app: &App| drawn(app, bone(app, who, "left_eye")).matrix3.y_axis.normalize();
    let both = ahead(&app);
    assert!(both.x > 0.05 && both.x < 0.29, "nearer to the heavier one: {both}");
    // Despawn the heavier target: the other one has all the weight.
    app.world_mut().entity_mut(right).despawn();
    for _ in 0..120 {
        app.update();
    }
    assert_eq!(app.world().get::<AimTarget>(who), Some(&AimTarget::entity(left)));
    assert_eq!(status(&app, who), AimStatus::Reached);
    assert!(error_deg(&app, who, "left_eye", DVec3::new(-1.0, 1.66, 3.0)) < 0.1);
}

#[test]
fn two_look_each_other_in_the_eye() {
    let mut app = stage::app();
    let facing = Transform::from_xyz(0.5, 0.1, 1.5).with_rotation(aim::glam::Quat::from_rotation_y(2.6));
    let pair = [Transform::IDENTITY, facing].map(|place| character(&mut app, place, AimTarget::nothing()));
    for (who, whom) in [(0, 1), (1, 0)] {
        let eye = bone(&app, pair[whom], "left_eye");
        app.world_mut().entity_mut(pair[who]).insert(AimTarget::entity(eye));
        app.world_mut().get_mut::<Player>(pair[who]).expect("a player").plays = who == 0;
    }
    let mut worst = 0.0_f64;
    for frame in 0..300 {
        app.update();
        for (who, whom) in [(0, 1), (1, 0)] {
            let eye = drawn(&app, bone(&app, pair[whom], "left_eye")).translation;
            if frame > 150 {
                assert_eq!(status(&app, pair[who]), AimStatus::Reached);
                worst = worst.max(error_deg(&app, pair[who], "left_eye", eye));
            }
        }
    }
    // One of them walks, so an error remains: the change of its correction in one frame.
    assert!(worst < 0.1, "{worst}° off");
}

#[test]
fn no_place_is_no_target() {
    let mut app = stage::app();
    let nowhere = app.world_mut().spawn_empty().id();
    let who = character(&mut app, Transform::IDENTITY, AimTarget::entity(nowhere));
    app.update();
    assert_eq!(status(&app, who), AimStatus::NoTarget);
    app.world_mut().entity_mut(nowhere).insert(Transform::from_xyz(0.2, 1.6, 2.0));
    for _ in 0..120 {
        app.update();
    }
    assert_eq!(status(&app, who), AimStatus::Reached);
    app.world_mut().entity_mut(who).insert(AimTarget::point(Vec3::NAN));
    app.update();
    assert_eq!(status(&app, who), AimStatus::Degenerate);
    // The character itself has no `Transform`.
    app.world_mut().entity_mut(who).remove::<Transform>();
    app.update();
    assert_eq!(status(&app, who), AimStatus::Unbound(bevy_aim::Unbound::Place));
}

#[test]
fn a_snap_is_at_once() {
    let mut app = stage::app();
    let who = character(&mut app, Transform::IDENTITY, AimTarget::nothing());
    app.world_mut().entity_mut(who).insert(AimSnap);
    app.update();
    app.update();
    assert!(app.world().get::<AimSnap>(who).is_some(), "it waits for a target");
    app.world_mut().entity_mut(who).insert(AimTarget::point(Vec3::new(1.5, 1.2, 1.5)));
    app.update();
    assert_eq!(status(&app, who), AimStatus::Reached);
    assert!(error_deg(&app, who, "left_eye", DVec3::new(1.5, 1.2, 1.5)) < 0.1);
    assert!(app.world().get::<AimSnap>(who).is_none());
    app.world_mut().entity_mut(who).insert(AimTarget::point(Vec3::new(-1.5, 1.2, 1.5)));
    app.update();
    assert_eq!(status(&app, who), AimStatus::RateLimited, "and only once");
}

#[test]
fn settings_are_those_of_the_character() {
    let mut app = stage::app();
    let point = Vec3::new(1.5, 1.6, 1.5);
    let [strong, weak] = [1.0, 0.0].map(|weight| {
        let who = character(&mut app, Transform::IDENTITY, AimTarget::point(point));
        app.world_mut().get_mut::<AimSettings>(who).expect("settings").weight = weight;
        who
    });
    for _ in 0..120 {
        app.update();
    }
    assert!(error_deg(&app, strong, "left_eye", point.as_dvec3()) < 0.1);
    assert!(error_deg(&app, weak, "left_eye", point.as_dvec3()) > 30.0);
    assert_eq!(outcome(&app, weak).status, AimStatus::Reached, "as far as it is to go");
}

#[test]
fn gazes_are_told_as_lines() {
    let mut app = stage::app();
    let point = Vec3::new(0.6, 1.5, 2.0);
    let who = character(&mut app, Transform::from_xyz(0.2, 0.0, 0.0), AimTarget::point(point));
    for _ in 0..60 {
        app.update();
    }
    let binding = stage::binding(&app, who);
    let gazes = binding.gaze_lines(1.0);
    assert_eq!(gazes.len(), 2);
    for line in &gazes {
        assert!((line.to - line.from).angle_between(point - line.from) < 2e-3, "{line:?}");
    }
    let eye = drawn(&app, bone(&app, who, "left_eye")).translation;
    assert!(gazes[0].from.as_dvec3().distance(eye) < 1e-5);
    assert!(binding.range_lines(0.2).len() > 100 && binding.axis_lines(0.1).len() == 3 * 4);
}
