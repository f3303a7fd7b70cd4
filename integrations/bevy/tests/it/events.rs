//! Tests of the events on characters.

use bevy_aim::aim::glam::Vec3;
use bevy_aim::{AimLost, AimOutOfReach, AimReached, AimTarget, AimTurnBody};
use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_transform::components::Transform;

use crate::stage::{self, hero, outcome, spawn};

/// The events so far, in order.
#[derive(Resource, Default)]
struct Told(Vec<(Entity, String)>);

fn app() -> App {
    let mut app = stage::app();
    app.init_resource::<Told>();
    app.add_observer(|on: On<AimReached>, mut told: ResMut<Told>| told.0.push((on.entity, "reached".into())));
    app.add_observer(|on: On<AimLost>, mut told: ResMut<Told>| told.0.push((on.entity, "lost".into())));
    app.add_observer(|on: On<AimOutOfReach>, mut told: ResMut<Told>| told.0.push((on.entity, "out of reach".into())));
    app.add_observer(|on: On<AimTurnBody>, mut told: ResMut<Told>| {
        told.0.push((on.entity, format!("turn {}", if on.angle > 0.0 { "left" } else { "right" })));
    });
    app
}

fn told(app: &mut App, frames: usize) -> Vec<(Entity, String)> {
    for _ in 0..frames {
        app.update();
    }
    std::mem::take(&mut app.world_mut().resource_mut::<Told>().0)
}

#[test]
fn each_change_is_told_once_and_to_the_entity() {
    let mut app = app();
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    // A second character, without a target: it must not trigger events.
    spawn(&mut app, hero(), Transform::from_xyz(3.0, 0.0, 0.0), 1.0);
    let lamp = app.world_mut().spawn(Transform::from_xyz(0.3, 1.6, 2.0)).id();
    app.world_mut().entity_mut(character).insert(AimTarget::entity(lamp));
    let own = |words: &[&str]| words.iter().map(|word| (character, (*word).to_owned())).collect::<Vec<_>>();
    assert_eq!(told(&mut app, 120), own(&["reached"]));
    assert_eq!(told(&mut app, 60), own(&[]), "nothing changes");
    // Far to the left and behind the character.
    app.world_mut().get_mut::<Transform>(lamp).expect("a lamp").translation = Vec3::new(1.5, 1.6, -2.5);
    let words = told(&mut app, 240);
    assert!(words.iter().all(|(entity, _)| *entity == character));
    let words: Vec<&str> = words.iter().map(|(_, word)| &word[..]).collect();
    assert_eq!(words.iter().filter(|word| **word == "lost").count(), 1, "{words:?}");
    assert_eq!(words.iter().filter(|word| **word == "out of reach").count(), 1, "{words:?}");
    assert_eq!(words.iter().filter(|word| **word == "turn left").count(), 1, "{words:?}");
    assert!(outcome(&app, character).body_turn > 0.3, "{:?}", outcome(&app, character));
    // Turn the body as reported, and a little more, because it sways while it walks.
    let turn = outcome(&app, character).body_turn + 0.3;
    app.world_mut().get_mut::<Transform>(character).expect("a place").rotate_y(turn);
    assert_eq!(told(&mut app, 240), own(&["reached"]));
    // The target is despawned.
    app.world_mut().entity_mut(lamp).despawn();
    assert_eq!(told(&mut app, 60), own(&["lost"]));
}

#[test]
fn an_observer_may_despawn_what_it_observes() {
    let mut app = app();
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    app.world_mut().entity_mut(character).insert(AimTarget::point(Vec3::new(0.0, 1.6, 2.0)));
    app.world_mut().entity_mut(character).observe(|on: On<AimReached>, mut commands: Commands| {
        commands.entity(on.entity).despawn();
    });
    assert!(told(&mut app, 120).len() == 1);
    assert!(app.world().get_entity(character).is_err());
}
