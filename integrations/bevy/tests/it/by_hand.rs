//! The plugin's results are bit-identical to direct calls of the runtime with `aim::animation` on the whole skeleton.

use bevy_aim::AimTarget;
use bevy_aim::aim::animation::{AimChain, Corrections};
use bevy_aim::aim::glam::{Affine3A, Quat, Vec3};
use bevy_aim::aim::{AimRig, DynAim, Outcome, Settings};
use bevy_transform::components::Transform;

use crate::stage::{self, FRAME, Hero, Player, binding, hero, outcome, skeleton, spawn};

#[test]
fn outcome_and_corrections_are_those_of_the_runtime() {
    let mut app = stage::app();
    let places = [Transform::IDENTITY, Transform::from_xyz(1.0, 0.5, -2.0).with_rotation(Quat::from_rotation_y(1.0))];
    let characters = places.map(|place| spawn(&mut app, hero(), place, 1.0));
    let find = |name: &str| skeleton().find(name).expect("a bone");
    let chain = AimChain::named(skeleton(), Hero::RIG)
        .and_then(|chain| chain.with_other_eye(find("right_eye")))
        .and_then(|chain| chain.with_standing_up(Vec3::Y, find("hips")))
        .expect("a chain");
    let mut by_hand = characters.map(|_| DynAim::new(Hero::RIG));
    let mut frame = chain.frame();
    let mut moved = 0;
    for number in 0..300_u16 {
        let t = f32::from(number) * FRAME.as_secs_f32();
        let target = Vec3::new(2.0 * (0.8 * t).sin(), 1.5 + 0.5 * (1.7 * t).cos(), 2.0 + 0.6 * t);
        for &character in &characters {
            app.world_mut().entity_mut(character).insert(AimTarget::point(target));
            let mut root = app.world_mut().get_mut::<Transform>(character).expect("a place");
            root.translation.x += 0.01;
        }
        app.update();
        for (&character, aim) in characters.iter().zip(&mut by_hand) {
            let player = app.world().get::<Player>(character).expect("a player");
            let mut local = player.animated.clone();
            let mut model = vec![Affine3A::IDENTITY; local.len()];
            skeleton().to_model(&local, &mut model).expect("a pose");
            frame.place = app.world().get::<Transform>(character).expect("a place").compute_affine();
            chain.gather(&mut frame, &mut local, &mut model).expect("a pose");
            let dt = FRAME.as_secs_f32();
            let expected = aim.aim(&frame.pose(), target, dt, &Settings::default());
            let found = outcome(&app, character).outcome.expect("an outcome");
            assert_eq!(bits(&found), bits(&expected), "frame {number}");
            let binding = binding(&app, character);
            let turns = binding.corrections().iter().zip(aim.corrections());
            for (found, expected) in turns {
                assert_eq!(found.to_array().map(f32::to_bits), expected.to_array().map(f32::to_bits), "frame {number}");
                moved += usize::from(*found != Quat::IDENTITY);
            }
            // The drawn transforms equal those that `AimChain::apply` computes.
            let corrections = Corrections::from(&*aim);
            chain.apply(&frame, corrections, &mut local, &mut model).expect("a pose");
            for name in ["left_eye", "right_eye", "neck", "spine3", "spine1", "left_clavicle"] {
                let bone = find(name);
                let drawn = app.world().get::<Transform>(player.bones[bone]).expect("a bone");
                assert_eq!(stage::to_bevy(&local[bone]), *drawn, "frame {number}, {name}");
            }
        }
    }
    assert!(moved > 2000, "{moved} corrections were none");
}

fn bits(outcome: &Outcome) -> ([u32; 4], [Option<u32>; 2], Option<[u32; 4]>, String) {
    let numbers = [outcome.aim, outcome.remaining, outcome.body_turn, outcome.out_of_reach_for].map(f32::to_bits);
    let eye = [outcome.other_eye_remaining.map(f32::to_bits), None];
    let turn = outcome.other_eye_correction.map(|turn| turn.to_array().map(f32::to_bits));
    (numbers, eye, turn, format!("{:?} {:?} {:?}", outcome.status, outcome.at_limit, outcome.recovering))
}
