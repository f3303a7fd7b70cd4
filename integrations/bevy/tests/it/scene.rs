//! Characters side by side that walk, cross-fade and stop, while their targets move, jump and disappear.

use bevy_aim::aim::glam::{DVec3, Quat, Vec3};
use bevy_aim::{AimStatus, AimTarget};
use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_transform::components::Transform;

use crate::stage::{self, FRAME, Judged, Player, drawn, error_deg, hero, judge, outcome, spawn, status};

struct Show {
    app: App,
    characters: Vec<Entity>,
    /// The target of each character, parented to a turning pivot.
    lamps: Vec<Entity>,
    judged: Vec<Option<Judged>>,
    /// Largest error of an eye in frames with status `Reached`, degrees.
    worst_deg: f64,
    /// Number of checks with status `Reached`.
    reached: usize,
    frame: u16,
}

impl Show {
    /// Spawns two characters in metres, one in centimetres like those of Mixamo, one mirrored, and one on a turning
    /// platform.
    fn new() -> Self {
        let mut app = stage::app();
        let at = |x: f32| Transform::from_xyz(x, 0.0, 0.0);
        let mirrored = Transform { scale: Vec3::new(-1.0, 1.0, 1.0), ..at(6.0) };
        let places = [(at(0.0), 1.0), (at(1.5), 1.0), (at(3.0), 0.01), (mirrored, 1.0), (at(1.0), 1.0)];
        let characters: Vec<Entity> =
            places.iter().map(|(place, scale)| spawn(&mut app, hero(), *place, *scale)).collect();
        let platform = app.world_mut().spawn(Transform::from_xyz(9.0, 0.2, 0.0)).id();
        app.world_mut().entity_mut(characters[4]).insert(ChildOf(platform));
        let mut lamps = Vec::new();
        for &character in &characters {
            let pivot = app.world_mut().spawn(Transform::IDENTITY).id();
            let lamp = app.world_mut().spawn((Transform::IDENTITY, ChildOf(pivot))).id();
            app.world_mut().entity_mut(character).insert(AimTarget::entity(lamp));
            lamps.push(lamp);
        }
        let judged = characters.iter().map(|_| None).collect();
        Self { app, characters, lamps, judged, worst_deg: 0.0, reached: 0, frame: 0 }
    }

    /// Runs frames. In each, moves characters and targets as a game would, and checks the result.
    fn run(&mut self, frames: u16) {
        for _ in 0..frames {
            let t = f32::from(self.frame) * FRAME.as_secs_f32();
            self.frame += 1;
            for (number, &character) in self.characters.iter().enumerate() {
                let mut root = self.app.world_mut().get_mut::<Transform>(character).expect("a place");
                let plays = t < 6.0;
                if plays {
                    root.translation.z = 1.2 * t;
                    root.rotation = Quat::from_rotation_y(0.3 * (0.7 * t).sin());
                }
                let place = root.translation;
                if number == 4 {
                    let on = self.app.world().get::<ChildOf>(character).expect("a platform").parent();
                    let mut platform = self.app.world_mut().get_mut::<Transform>(on).expect("a place");
                    platform.rotation = Quat::from_rotation_y(0.4 * t);
                    platform.translation.y = 0.2 + 0.1 * t.sin();
                }
                let (offset, lamp) = (number as f32, self.lamps[number]);
                let Ok(hangs_on) =
                    self.app.world().get_entity(lamp).map(|lamp| lamp.get::<ChildOf>().expect("a pivot").parent())
                else {
                    continue;
                };
                let angle = 0.8 * (0.9 * t + offset).sin();
                let mut pivot = self.app.world_mut().get_mut::<Transform>(hangs_on).expect("a place");
                *pivot =
                    Transform::from_translation(if number == 4 { Vec3::new(9.0, 0.0, 0.0) + place } else { place })
                        .with_rotation(Quat::from_rotation_y(angle));
                let mut lamp = self.app.world_mut().get_mut::<Transform>(lamp).expect("a place");
                lamp.translation = Vec3::new(0.0, 1.6 + 0.3 * (1.3 * t + offset).cos(), 2.0);
            }
            self.app.update();
            self.judge();
        }
    }

    fn judge(&mut self) {
        for (number, &character) in self.characters.iter().enumerate() {
            let dt = FRAME.as_secs_f64();
            self.judged[number] = Some(judge(&self.app, character, self.judged[number].as_ref(), dt));
            if status(&self.app, character) != AimStatus::Reached {
                continue;
            }
            self.reached += 1;
            let target = self.target(number);
            for eye in ["left_eye", "right_eye"] {
                let error = error_deg(&self.app, character, eye, target);
                self.worst_deg = self.worst_deg.max(error);
                assert!(
                    error <= 0.1,
                    "character {number}, frame {}, {eye}: {error}° off, said to be reached",
                    self.frame
                );
            }
        }
    }

    fn target(&self, number: usize) -> DVec3 {
        let list = &self.app.world().get::<AimTarget>(self.characters[number]).expect("a target").list;
        match list[0].at {
            bevy_aim::AimAt::Point(point) => point.as_dvec3(),
            bevy_aim::AimAt::Entity(entity, point) => drawn(&self.app, entity).transform_point3(point.as_dvec3()),
        }
    }

    fn players(&mut self, change: impl Fn(&mut Player)) {
        for &character in &self.characters {
            change(&mut self.app.world_mut().get_mut::<Player>(character).expect("a player"));
        }
    }
}

#[test]
fn reached_is_reached_as_bevy_draws_it() {
    let mut show = Show::new();
    show.run(180);
    let while_walking = show.reached;
    assert!(while_walking > 5 * 90, "reached in {while_walking} frames of {}", 5 * 180);
    // Cross-fade from walking to running.
    for step in 0..=20_u8 {
        show.players(|player| player.next = Some((stage::clip("run"), f32::from(step) / 20.0)));
        show.run(3);
    }
    show.run(60);
    // The animation stops, so bones keep the last pose of the clip.
    show.players(|player| player.plays = false);
    show.run(240);
    let reached = show.reached;
    // The target jumps once and then stays.
    for &character in &show.characters {
        let place = show.app.world().get::<bevy_transform::components::GlobalTransform>(character).expect("a place");
        let point = place.affine().transform_point3(Vec3::new(0.9, 1.9, 1.5));
        show.app.world_mut().entity_mut(character).insert(AimTarget::point(point));
    }
    show.run(240);
    assert!(show.reached - reached > 5 * 120, "{} of {}", show.reached - reached, 5 * 240);
    // Return to the lamps, and despawn them.
    for (&character, &lamp) in show.characters.iter().zip(&show.lamps) {
        show.app.world_mut().entity_mut(character).insert(AimTarget::entity(lamp));
    }
    show.run(60);
    for &lamp in &show.lamps {
        show.app.world_mut().entity_mut(lamp).despawn();
    }
    show.run(240);
    for (number, &character) in show.characters.iter().enumerate() {
        assert_eq!(status(&show.app, character), AimStatus::NoTarget);
        assert!(show.app.world().get::<AimTarget>(character).expect("a target").list.is_empty());
        let judged = show.judged[number].as_ref().expect("a frame");
        let off = judged.angles_deg.iter().flatten().fold(0.0_f64, |most, angle| most.max(angle.abs()));
        assert!(off < 0.01, "character {number} is at rest again: {:?}", judged.angles_deg);
        assert_eq!(outcome(&show.app, character).remaining, 0.0);
    }
    println!("reached in {} frames, at most {:.4}° off", show.reached, show.worst_deg);
}

#[test]
fn a_far_target_keeps_the_neck_in_its_range_while_nothing_is_animated() {
    let mut app = stage::app();
    let character = spawn(&mut app, hero(), Transform::IDENTITY, 1.0);
    app.world_mut().get_mut::<Player>(character).expect("a player").plays = false;
    app.world_mut().entity_mut(character).insert(AimTarget::point(Vec3::new(1.5, 1.6, -3.0)));
    let mut judged = None;
    for _ in 0..240 {
        app.update();
        judged = Some(judge(&app, character, judged.as_ref(), FRAME.as_secs_f64()));
    }
    assert!(status(&app, character).is_out_of_reach(), "{:?}", outcome(&app, character));
    let neck = judged.expect("a frame").angles_deg[1][0];
    assert!(neck > 20.0, "the neck is turned: {neck}°");
}
