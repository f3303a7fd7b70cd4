//! Tests of the examples without a window: `cargo test --no-default-features`.
#![cfg(not(feature = "window"))]

use aim::AimRig as _;
use bevy::prelude::*;
use bevy_aim::{AimBinding, AimOutcome, AimPlugin, AimStatus, AimTarget};
use bevy_aim_examples::{Pointer, Stage};

#[path = "../examples/conversation.rs"]
mod conversation;
#[path = "../examples/crowd.rs"]
mod crowd;
#[path = "../examples/look_at_mouse.rs"]
mod look_at_mouse;
#[path = "../examples/turret.rs"]
mod turret;

fn app(plugin: fn(&mut App)) -> App {
    let mut app = App::new();
    app.add_plugins((Stage { camera: Vec3::Z, middle: Vec3::ZERO }, AimPlugin::default(), plugin));
    app.finish();
    app.update();
    app
}

fn run(app: &mut App, frames: usize) {
    (0..frames).for_each(|_| app.update());
}

/// Returns the angle between a character's first joint, along its own `forward`, and the direction to a point, degrees.
fn error_deg(app: &App, character: Entity, forward: Vec3, point: Vec3) -> f32 {
    let bone = app.world().get::<AimBinding>(character).expect("bones").joints().next().expect("a joint");
    let place = app.world().get::<GlobalTransform>(bone).expect("a place").affine();
    place.transform_vector3(forward).angle_between(point - Vec3::from(place.translation)).to_degrees()
}

#[test]
fn the_mouse_is_looked_at() {
    let mut app = app(look_at_mouse::plugin);
    let character = app.world_mut().query_filtered::<Entity, With<AimTarget>>().single(app.world()).expect("one");
    let ray = Ray3d::new(Vec3::new(0.0, 1.65, 2.2), Dir3::new(Vec3::new(0.2, 0.1, -1.0)).expect("a direction"));
    app.world_mut().resource_mut::<Pointer>().0 = Some(ray);
    run(&mut app, 120);
    assert_eq!(app.world().get::<AimOutcome>(character).expect("an outcome").status, AimStatus::Reached);
    assert!(error_deg(&app, character, Vec3::Y, Vec3::new(0.2, 1.75, 1.2)) < 0.15);
    app.world_mut().resource_mut::<Pointer>().0 = None;
    run(&mut app, 2);
    assert_eq!(app.world().get::<AimOutcome>(character).expect("an outcome").status, AimStatus::NoTarget);
}

#[test]
fn each_looks_at_who_speaks() {
    let mut app = app(conversation::plugin);
    let mut speakers = Vec::new();
    for _ in 0..12 {
        // A little over one second, so that some samples fall just after a look has begun.
        run(&mut app, 61);
        let talk = app.world().resource::<conversation::Conversation>();
        let (speaker, listener) = talk.now().expect("people");
        speakers.push(speaker);
        for &person in &talk.people.clone() {
            let whom = if person == speaker { listener } else { speaker };
            let eye = app.world().get::<AimBinding>(whom).expect("bones").joints().next().expect("a joint");
            let target = app.world().get::<AimTarget>(person).expect("a target");
            assert_eq!(*target, AimTarget::entity(eye));
            let eye = app.world().get::<GlobalTransform>(eye).expect("a place").translation();
            let outcome = app.world().get::<AimOutcome>(person).expect("an outcome");
            if outcome.status == AimStatus::Reached {
                // While both turn, the error is up to the other's movement in one frame.
                assert!(error_deg(&app, person, Vec3::Y, eye) < 1.0, "{}", error_deg(&app, person, Vec3::Y, eye));
            }
        }
    }
    speakers.dedup();
    assert!(speakers.len() >= 3, "each has spoken");
}

#[test]
fn the_turret_fires_when_it_is_on_the_drone() {
    let mut app = app(turret::plugin);
    run(&mut app, 600);
    let (character, gun) = app.world_mut().query::<(Entity, &turret::Gun)>().single(app.world()).expect("one");
    assert!(gun.shots > 10, "{} shots in ten seconds", gun.shots);
    let drone =
        app.world_mut().query_filtered::<&GlobalTransform, With<turret::Drone>>().single(app.world()).expect("one");
    let drone = drone.translation();
    assert!(error_deg(&app, character, Vec3::Z, drone) < 0.15);
    assert_eq!(turret::Turret::RIG.barrel.heading(), 0.0);
}

#[test]
fn two_thousand_watch() {
    let mut app = app(crowd::plugin);
    run(&mut app, 60);
    let ball =
        app.world_mut().query_filtered::<&GlobalTransform, With<crowd::Thrown>>().single(app.world()).expect("one");
    let ball = ball.translation();
    let people: Vec<(Entity, AimStatus)> = app
        .world_mut()
        .query::<(Entity, &AimOutcome)>()
        .iter(app.world())
        .map(|(entity, outcome)| (entity, outcome.status))
        .collect();
    let reached: Vec<Entity> =
        people.iter().filter(|(_, status)| status.is_reached()).map(|(entity, _)| *entity).collect();
    assert!(people.len() == 2000 && reached.len() > 1900, "{} of {}", reached.len(), people.len());
    assert!(reached.iter().all(|&person| error_deg(&app, person, Vec3::Y, ball) < 0.15));
}
