//! Stored settings, states and outcomes read back the same, and a restored character continues as if it had never been
//! stored.

use std::fmt::Debug;

use aim::animation::{Control, Looping, Transform};
use aim::glam::{Affine3A, Quat, Vec3};
use aim::rigs::Thug;
use aim::{Aim, Aimed, Ascent, Behind, Budgets, GazeSharing, Outcome, Pose, Settings, Solver, State, Status, Target};
use aim_tests::random::Random;
use serde::Serialize;
use serde::de::DeserializeOwned;

fn json<T: Serialize + DeserializeOwned>(value: &T) -> T {
    let text = serde_json::to_string(value).expect("values can be written as JSON");
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error} in {text}"))
}

/// Writes and reads a value in a binary format.
fn cbor<T: Serialize + DeserializeOwned>(value: &T) -> T {
    let mut bytes = Vec::new();
    ciborium::into_writer(value, &mut bytes).expect("values can be written as CBOR");
    ciborium::from_reader(&bytes[..]).expect("what was written can be read")
}

#[track_caller]
fn assert_survives<T: Serialize + DeserializeOwned + PartialEq + Debug>(value: &T) {
    assert_eq!((&json(value), &cbor(value)), (value, value));
}

/// Returns the pose of a standing thug with an animated neck, +Y up, facing +Z, in metres.
fn standing(frame: u16) -> Pose<[Affine3A; 3]> {
    let upright = Quat::from_xyzw(0.5, 0.5, 0.5, 0.5);
    let nod = Quat::from_rotation_x(0.1 * (f32::from(frame) / 20.0).sin());
    let at = |y, z| Affine3A::from_rotation_translation(nod * upright, Vec3::new(0.0, y, z));
    let pose = Pose::new([at(1.66, 0.09), at(1.51, 0.0), at(1.37, 0.0)]).with_up(Vec3::Y);
    pose.with_other_eye(Affine3A::from_rotation_translation(nod * upright, Vec3::new(-0.06, 1.66, 0.09)))
}

#[test]
fn settings_outcomes_and_targets_are_read_as_they_were_written() {
    assert_survives(&Settings::default());
    let settings = Settings::default()
        .with_weight(0.1)
        .with_effector(2)
        .with_solver(Solver::Ascent)
        .with_behind(Behind::Plane)
        .with_attention(0.7)
        .with_sharing(GazeSharing::default().with_head_share(0.3).with_delay(f32::INFINITY))
        .with_patience(2.5)
        .with_ascent(Ascent::paper());
    assert_survives(&settings);
    for solver in [Solver::Natural, Solver::Exact, Solver::Ascent] {
        assert_survives(&Settings::default().with_solver(solver));
    }
    assert_survives(&Budgets::UNBOUNDED);
    assert_survives(&Target::new(Vec3::new(0.1, -2.0, 1e-9), 0.3));
    assert_survives(&standing(7));
    let mut thug = Aim::<Thug>::new();
    for target in [Vec3::new(0.1, 1.7, 2.0), Vec3::new(9.0, 1.7, 0.1), Vec3::new(0.3, 1.0, -3.0), Vec3::NAN] {
        let aimed: Aimed<[Quat; 3]> = thug.aim(&standing(0), target, 0.1, &Settings::default());
        assert_survives(&aimed);
        let outcome: Outcome = aimed.outcome;
        assert_survives(&outcome);
    }
}

#[test]
fn files_written_by_hand_need_what_differs_alone() {
    let settings: Settings = toml::from_str("weight = 1\nsolver = \"exact\"\n[sharing]\nhead_share = 0.5")
        .expect("what is left out is as by default");
    let expected = Settings::default().with_solver(Solver::Exact);
    assert_eq!(settings, expected.with_sharing(GazeSharing::default().with_head_share(0.5)));
    let words = serde_json::to_value(Settings::default()).expect("settings can be written as JSON");
    assert_eq!((&words["behind"], &words["patience"], &words["solver"]), (&"clip".into(), &"inf".into(), &().into()));
    assert_eq!(serde_json::to_value(Status::RateLimited).expect("words can be written"), "rate_limited");
}

/// A state that is stored and restored at every frame leads to the same bits as one that is not.
#[test]
fn a_character_that_was_stored_goes_on_with_the_same_bits() {
    for (name, settings) in [
        ("natural", Settings::default().with_solver(Solver::Natural).with_patience(1.0)),
        ("exact", Settings::default().with_solver(Solver::Exact)),
        ("ascent", Settings::default().with_solver(Solver::Ascent)),
    ] {
        let mut random = Random::new(17);
        #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is meant")]
        let mut number = |limit: f64| random.within(limit) as f32;
        let (mut kept, mut target) = (Aim::<Thug>::new(), Vec3::ZERO);
        let mut stored = [kept; 2];
        for frame in 0..600 {
            if frame % 40 == 0 {
                target = Vec3::new(number(3.0), 1.6 + number(1.0), 1.0 + number(3.0));
            }
            let pose = standing(frame);
            let expected = kept.aim(&pose, target, 1.0 / 60.0, &settings);
            stored = [json(&stored[0]), cbor(&stored[1])];
            for (format, stored) in ["JSON", "CBOR"].into_iter().zip(&mut stored) {
                let aimed = stored.aim(&pose, target, 1.0 / 60.0, &settings);
                let bits = |aimed: &Aimed<[Quat; 3]>| aimed.corrections.map(|turn| turn.to_array().map(f32::to_bits));
                assert_eq!(bits(&aimed), bits(&expected), "{name}, {format}, frame {frame}");
                assert_eq!((aimed.outcome, &*stored), (expected.outcome, &kept), "{name}, {format}, frame {frame}");
            }
        }
    }
}

#[test]
fn a_state_is_read_for_as_many_joints_as_it_was_written_for() {
    let state = State::new(Aim::<Thug>::new().state.joints.to_vec());
    assert_eq!(json(&state), state);
    for count in [0, 2, 4] {
        let other = State::new(vec![aim::Joint::REST; count]);
        let text = serde_json::to_string(&other).expect("a state can be written");
        let error =
            serde_json::from_str::<Aim<Thug>>(&text).expect_err("another number of joints is no such character");
        assert!(error.to_string().contains("expected 3 joints"), "{error}");
    }
}

#[test]
fn a_clip_goes_on_from_where_it_was_stored() {
    for looping in [Looping::Once, Looping::Repeat, Looping::PingPong] {
        let mut kept = Control::new().with_looping(looping).with_speed(1.3);
        for _ in 0..200 {
            let mut stored = (json(&kept), cbor(&kept));
            assert_eq!(stored, (kept, kept));
            let step = kept.advance(1.0 / 60.0, 0.7);
            assert_eq!((stored.0.advance(1.0 / 60.0, 0.7), stored.1.advance(1.0 / 60.0, 0.7)), (step, step));
        }
    }
    assert_survives(&Transform::new(Vec3::new(0.1, 0.2, 0.3), Quat::from_rotation_x(0.3)));
}

/// A stored state may hold any numbers: corrections are still finite and unit, and angles return into their ranges.
#[test]
fn a_state_with_nonsense_does_no_harm() {
    let mut random = Random::new(5);
    let state = serde_json::to_value(Aim::<Thug>::new()).expect("a state can be written");
    for case in 0..300 {
        let mut broken = state.clone();
        spoil(&mut broken, &mut random);
        let Ok(mut thug) = serde_json::from_value::<Aim<Thug>>(broken) else { continue };
        let settings = Settings::default().with_solver(if case % 2 == 0 { Solver::Natural } else { Solver::Exact });
        for frame in 0..240 {
            let aimed = thug.aim(&standing(frame), Vec3::new(0.5, 1.8, 2.0), 1.0 / 60.0, &settings);
            for turn in aimed.corrections {
                assert!((turn.length() - 1.0).abs() < 1e-5, "case {case}, frame {frame}: {thug:?}");
            }
            assert!(frame < 239 || aimed.outcome.recovering.is_empty(), "case {case}: {thug:?} {:?}", thug.state);
        }
    }
}

/// Replaces some of the numbers.
fn spoil(value: &mut serde_json::Value, random: &mut Random) {
    match value {
        serde_json::Value::Array(list) => list.iter_mut().for_each(|value| spoil(value, random)),
        serde_json::Value::Object(map) => map.values_mut().for_each(|value| spoil(value, random)),
        serde_json::Value::Number(number) if number.is_f64() && random.below(3) == 0 => {
            let numbers = [1e38, -1e38, 3.0, -100.0, 1e-40, f64::from(f32::MAX), 0.5, 7.0];
            *value = numbers[random.below(numbers.len())].into();
        }
        serde_json::Value::Number(number) if random.below(3) == 0 && number.as_u64() == Some(0) => {
            *value = [1, 127, 255][random.below(3)].into();
        }
        serde_json::Value::Null if random.below(2) == 0 => *value = vec![1e30, -2.0].into(),
        _ => {}
    }
}
