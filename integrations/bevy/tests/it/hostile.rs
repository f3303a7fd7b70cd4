//! Changes that a game may make to a character at an unexpected time. Nothing panics, all transforms stay finite, and
//! the status says why nothing is aimed.

use bevy_aim::aim::glam::{Quat, Vec3};
use bevy_aim::aim::{Behind, Solver};
use bevy_aim::{AimPlugin, AimSettings, AimSnap, AimStatus, AimSystems, AimTarget, AimedBone, Unbound};
use bevy_app::{AnimationSystems, App, PostUpdate};
use bevy_ecs::prelude::*;
use bevy_time::{Time, Virtual};
use bevy_transform::components::Transform;

use crate::stage::{self, FRAME, Player, angle_deg, binding, bone, error_deg, hero, judge, spawn, status};

const LAMP: Vec3 = Vec3::new(0.9, 1.7, 1.5);

/// Spawns a walking character whose target is the lamp.
fn walking(app: &mut App) -> Entity {
    let character = spawn(app, hero(), Transform::IDENTITY, 1.0);
    app.world_mut().entity_mut(character).insert(AimTarget::point(LAMP));
    character
}

/// Spawns a standing character, and returns it when it looks at the lamp.
fn standing(app: &mut App) -> Entity {
    let character = walking(app);
    app.world_mut().get_mut::<Player>(character).expect("a player").plays = false;
    frames(app, 90);
    assert_eq!(status(app, character), AimStatus::Reached);
    character
}

/// Runs frames, and checks after each that every transform is finite.
fn frames(app: &mut App, count: usize) {
    for _ in 0..count {
        app.update();
        for transform in app.world_mut().query::<&Transform>().iter(app.world()) {
            assert!(transform.is_finite(), "{transform:?}");
        }
    }
}

#[track_caller]
fn assert_looks_at_lamp(app: &App, character: Entity) {
    assert_eq!(status(app, character), AimStatus::Reached);
    assert!(error_deg(app, character, "left_eye", LAMP.as_dvec3()) <= 0.1);
}

/// Entities to despawn in the next frame.
#[derive(Resource, Default)]
struct Doomed(Vec<Entity>);

fn strike(mut commands: Commands, mut doomed: ResMut<Doomed>) {
    doomed.0.drain(..).for_each(|entity| commands.entity(entity).despawn());
}

#[test]
fn bones_and_characters_are_despawned_in_mid_frame() {
    for after_the_aim in [false, true] {
        let mut app = stage::app();
        app.init_resource::<Doomed>();
        match after_the_aim {
            true => app.add_systems(PostUpdate, strike.after(AimSystems)),
            false => app.add_systems(PostUpdate, strike.after(AnimationSystems).before(AimSystems)),
        };
        let [first, second] = [(); 2].map(|()| standing(&mut app));
        let (eye, neck) = (bone(&app, first, "left_eye"), bone(&app, first, "neck"));
        app.world_mut().resource_mut::<Doomed>().0 = vec![eye, second];
        frames(&mut app, 1);
        assert!(
            after_the_aim || status(&app, first) == AimStatus::Unbound(Unbound::Bones),
            "{:?}",
            status(&app, first)
        );
        frames(&mut app, 3);
        assert_eq!(status(&app, first), AimStatus::Unbound(Unbound::Joint(0)));
        let rest = stage::to_bevy(&stage::skeleton().rest()[stage::skeleton().find("neck").expect("a bone")]);
        assert_eq!(*app.world().get::<Transform>(neck).expect("a bone"), rest, "what is left is as it was animated");
        assert!(app.world().get_entity(second).is_err());
        // Despawn the rest of the character's bones.
        let children = app.world().get::<Children>(first).expect("an armature").iter().collect();
        app.world_mut().resource_mut::<Doomed>().0 = children;
        frames(&mut app, 3);
        assert_eq!(status(&app, first), AimStatus::Unbound(Unbound::Bones));
        assert_eq!(app.world_mut().query::<&AimedBone>().iter(app.world()).count(), 0);
    }
}

#[test]
fn settings_change_in_every_frame() {
    let mut app = stage::app();
    let character = walking(&mut app);
    let wild = [0.5, -1.0, f32::NAN, f32::INFINITY, 0.0, 1.0, 1e30, -0.0];
    let solvers = [None, Some(Solver::Exact), Some(Solver::Natural), Some(Solver::Ascent)];
    frames(&mut app, 1);
    let rates: Vec<f32> = binding(&app, character).rig().description().joints().iter().map(|info| info.rate).collect();
    for frame in 0..240 {
        let before = binding(&app, character).angles().to_vec();
        let of = |step: usize| wild[(frame * step) % wild.len()];
        let settings = AimSettings {
            weight: of(1),
            tolerance: of(3),
            effector: [0, 1, 3, usize::MAX][frame % 4],
            attention: of(5),
            patience: of(7),
            behind: if frame % 3 == 0 { Behind::Plane } else { Behind::default() },
            solver: solvers[(frame / 4) % 4],
            ..AimSettings::default()
        };
        app.world_mut().entity_mut(character).insert(settings);
        frames(&mut app, 1);
        judge(&app, character, None, 0.0);
        for ((was, now), rate) in before.iter().zip(binding(&app, character).angles()).zip(&rates) {
            let turned = [now.heading() - was.heading(), now.pitch() - was.pitch()];
            let most = rate * FRAME.as_secs_f32() + 1e-5;
            assert!(turned.iter().all(|turned| turned.abs() <= most), "frame {frame}: {turned:?}, at most {most}");
        }
    }
    app.world_mut().entity_mut(character).insert(AimSettings::default());
    frames(&mut app, 120);
    assert_looks_at_lamp(&app, character);
}

#[test]
fn time_stands_still() {
    let mut app = stage::app();
    let character = walking(&mut app);
    app.world_mut().resource_mut::<Time<Virtual>>().set_relative_speed(0.0);
    frames(&mut app, 5);
    assert_eq!(status(&app, character), AimStatus::RateLimited);
    judge(&app, character, None, 0.0);
    assert!(binding(&app, character).angles().iter().all(|joint| joint.heading() == 0.0 && joint.pitch() == 0.0));
    // Unless the character snaps.
    app.world_mut().entity_mut(character).insert(AimSnap);
    frames(&mut app, 1);
    assert_looks_at_lamp(&app, character);
}

#[test]
fn numbers_that_are_none() {
    let mut app = stage::app();
    let character = standing(&mut app);
    let angles = binding(&app, character).angles().to_vec();
    let place = |app: &mut App, place: Transform| {
        *app.world_mut().get_mut::<Transform>(character).expect("a place") = place;
        app.update();
        status(app, character)
    };
    for wrong in [
        Transform::from_scale(Vec3::ZERO),
        Transform::from_scale(Vec3::splat(f32::NAN)),
        Transform::from_xyz(f32::NAN, 0.0, 0.0),
        Transform::from_xyz(f32::INFINITY, 0.0, 0.0),
        Transform::from_rotation(Quat::from_xyzw(f32::NAN, 0.0, 0.0, 1.0)),
    ] {
        assert_eq!(place(&mut app, wrong), AimStatus::Degenerate, "{wrong:?}");
        assert_eq!(binding(&app, character).angles(), angles, "{wrong:?}");
        judge(&app, character, None, 0.0);
    }
    assert_eq!(place(&mut app, Transform::IDENTITY), AimStatus::Reached);
    for wrong in [Vec3::NAN, Vec3::splat(f32::INFINITY), Vec3::splat(f32::MAX)] {
        app.world_mut().entity_mut(character).insert(AimTarget::point(wrong));
        frames(&mut app, 2);
        assert!(!status(&app, character).is_reached(), "{wrong}: {:?}", status(&app, character));
    }
    for weight in [f32::NAN, f32::INFINITY, -1.0, 0.0] {
        app.world_mut().entity_mut(character).insert(AimTarget::nothing().and_point(LAMP, weight));
        frames(&mut app, 2);
    }
    app.world_mut().entity_mut(character).insert(AimTarget::point(LAMP));
    frames(&mut app, 120);
    assert_looks_at_lamp(&app, character);
}

/// A cloned character is independent of the original. A cloned bone does not belong to the original's character.
#[test]
fn characters_and_bones_are_cloned() {
    let mut app = stage::app();
    let character = standing(&mut app);
    let aside = Vec3::new(-0.9, 1.5, 1.5);
    let neck = bone(&app, character, "neck");
    let head = app.world_mut().entity_mut(neck).clone_and_spawn_with_opt_out(|builder| {
        builder.linked_cloning(true).deny::<ChildOf>();
    });
    let cut_off = *app.world().get::<Transform>(head).expect("a place");
    let copy = app.world_mut().entity_mut(character).clone_and_spawn_with_opt_out(|builder| {
        builder.linked_cloning(true).deny::<Player>();
    });
    app.world_mut().entity_mut(copy).insert(AimTarget::point(aside));
    frames(&mut app, 120);
    app.world_mut().entity_mut(character).insert(AimTarget::point(Vec3::new(0.2, 1.7, 1.5)));
    frames(&mut app, 120);
    assert_eq!([character, copy].map(|who| status(&app, who)), [AimStatus::Reached; 2]);
    let own = |who| binding(&app, who).joints().collect::<Vec<_>>();
    assert!(own(character).iter().all(|bone| !own(copy).contains(bone)));
    let eye = stage::drawn(&app, own(copy)[0]);
    assert!(angle_deg(eye.matrix3.y_axis, aside.as_dvec3() - eye.translation) <= 0.1);
    assert_eq!(*app.world().get::<Transform>(head).expect("a place"), cut_off, "the original's turns are not its own");
    // Despawning the original does not affect the copy.
    app.world_mut().entity_mut(character).despawn();
    frames(&mut app, 10);
    assert_eq!(status(&app, copy), AimStatus::Reached);
}

#[test]
fn a_character_is_hung_elsewhere() {
    let mut app = stage::app();
    let character = standing(&mut app);
    let cart =
        Transform::from_xyz(0.1, 0.0, 0.1).with_rotation(Quat::from_rotation_y(0.3)).with_scale(Vec3::splat(1.1));
    let cart = app.world_mut().spawn(cart).id();
    for round in 0..6 {
        match round % 2 {
            0 => app.world_mut().entity_mut(character).insert(ChildOf(cart)),
            _ => app.world_mut().entity_mut(character).remove::<ChildOf>(),
        };
        frames(&mut app, 60);
        assert_looks_at_lamp(&app, character);
    }
    // A parent without a `Transform`.
    let nowhere = app.world_mut().spawn_empty().id();
    app.world_mut().entity_mut(character).insert(ChildOf(nowhere));
    frames(&mut app, 2);
    assert_eq!(status(&app, character), AimStatus::Unbound(Unbound::Place));
}

#[test]
#[should_panic(expected = "AimPlugin")]
fn two_plugins_are_one_too_many() {
    let mut app = App::new();
    app.add_plugins((AimPlugin::default(), AimPlugin::default()));
}
