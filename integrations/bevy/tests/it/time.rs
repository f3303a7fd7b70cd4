//! Tests of pauses, slow motion, fixed steps, and unchanged transforms.

use std::time::Duration;

use bevy_aim::aim::glam::Vec3;
use bevy_aim::{AimPlugin, AimStatus, AimTarget};
use bevy_app::{App, FixedPostUpdate, PostUpdate};
use bevy_ecs::prelude::*;
use bevy_time::{Fixed, Time, TimeUpdateStrategy, Virtual};
use bevy_transform::components::Transform;

use crate::stage::{self, FRAME, Player, app_with, binding, hero, judge, spawn, status};

const ASIDE: Vec3 = Vec3::new(2.0, 1.6, 0.5);

fn neck_deg(app: &App, character: Entity) -> f32 {
    binding(app, character).angles()[1].heading().to_degrees()
}

#[test]
fn a_pause_holds_the_gaze_and_slow_motion_slows_it() {
    let mut app = stage::app();
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    app.world_mut().entity_mut(character).insert(AimTarget::point(ASIDE));
    for _ in 0..20 {
        app.update();
    }
    let before = neck_deg(&app, character);
    let joints = binding(&app, character).angles().to_vec();
    app.world_mut().resource_mut::<Time<Virtual>>().pause();
    for _ in 0..20 {
        app.update();
        assert_eq!(binding(&app, character).angles(), joints);
        judge(&app, character, None, 0.0);
    }
    app.world_mut().resource_mut::<Time<Virtual>>().unpause();
    app.world_mut().resource_mut::<Time<Virtual>>().set_relative_speed(0.1);
    let mut judged = judge(&app, character, None, 0.0);
    for _ in 0..10 {
        app.update();
        judged = judge(&app, character, Some(&judged), 0.1 * FRAME.as_secs_f64());
    }
    assert!(neck_deg(&app, character) > before + 0.01, "it goes on");
}

#[test]
fn fixed_steps_of_their_own() {
    let mut app = app_with(AimPlugin::in_schedule(FixedPostUpdate));
    app.insert_resource(Time::<Fixed>::from_hz(30.0));
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    app.world_mut().get_mut::<Player>(character).expect("a player").plays = false;
    app.world_mut().entity_mut(character).insert(AimTarget::point(ASIDE));
    let mut judged = None;
    let mut steps = 0;
    let mut was = 0.0;
    for _ in 0..240 {
        app.update();
        // At most one step of 1/30 s per frame, and none in every other frame.
        judged = Some(judge(&app, character, judged.as_ref(), 1.0 / 30.0));
        if let Some(binding) = app.world().get::<bevy_aim::AimBinding>(character) {
            let now = binding.angles()[1].heading();
            steps += usize::from(now != was);
            was = now;
        }
    }
    assert_eq!(status(&app, character), AimStatus::Reached);
    assert!(steps > 10 && steps < 121, "{steps} steps in 240 frames");
}

#[test]
fn what_is_right_is_not_written() {
    #[derive(Resource, Default)]
    struct Changed(usize);
    let mut app = stage::app();
    app.init_resource::<Changed>();
    let count = |bones: Query<(), bevy_ecs::query::Changed<Transform>>, mut changed: ResMut<Changed>| {
        changed.0 += bones.iter().count();
    };
    app.add_systems(PostUpdate, count.after(bevy_aim::AimSystems));
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    app.world_mut().get_mut::<Player>(character).expect("a player").plays = false;
    app.world_mut().entity_mut(character).insert(AimTarget::point(ASIDE));
    for _ in 0..240 {
        app.update();
    }
    assert_eq!(status(&app, character), AimStatus::Reached);
    app.world_mut().resource_mut::<Changed>().0 = 0;
    for _ in 0..10 {
        app.update();
    }
    assert_eq!(app.world().resource::<Changed>().0, 0);
}

#[test]
fn a_long_frame_is_no_leap() {
    let mut app = stage::app();
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    app.world_mut().entity_mut(character).insert(AimTarget::point(ASIDE));
    app.update();
    let judged = judge(&app, character, None, 0.0);
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs(5)));
    app.update();
    judge(&app, character, Some(&judged), 0.1);
}
