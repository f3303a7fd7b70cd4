//! Long random sequences: ranges and rates hold, the status is right, and no state is ever corrupted.
#![allow(clippy::cast_possible_truncation, reason = "frames are counted and f64 is rounded to f32 on purpose")]

use crate::common::*;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Ascent, Joint, Outcome, Pose, Settings, Status};

/// Checks one call. `before` holds the joints' states before it.
fn check(rig: &NumericRig, before: &[Joint], outcome: &Outcome, dt: f32, case: &str) {
    let dt = if dt > 0.0 { dt.min(0.1) } else { 0.0 };
    assert!(sound(rig), "{case}");
    for (index, ((info, old), new)) in rig.infos.iter().zip(before).zip(&rig.joints).enumerate() {
        let mut outside_any = false;
        for (range, old, new) in [(info.heading, old.heading(), new.heading()), (info.pitch, old.pitch(), new.pitch())]
        {
            let change = (new - old).abs();
            let free = range.is_some_and(|[lo, hi]| lo == f32::NEG_INFINITY && hi == f32::INFINITY);
            let change = if free { change.min((change - core::f32::consts::TAU).abs()) } else { change };
            assert!(change <= info.rate * dt + 1e-6, "{case}: joint {index} moved {change}");
            let [lo, hi] = range.unwrap_or([0.0, 0.0]);
            let [lo, hi] = if lo > hi { [0.5 * (lo + hi); 2] } else { [lo, hi] };
            let outside = |angle: f32| (lo - angle).max(angle - hi).max(0.0);
            assert!(outside(new) <= outside(old), "{case}: joint {index} left its range: {old} to {new}");
            outside_any |= outside(new) > 0.0;
        }
        assert_eq!(outcome.recovering.contains(index), outside_any, "{case}");
    }
}

/// Ten thousand frames with targets that wander, jump, orbit and vanish, and a pose that always moves.
#[test]
fn limits_and_rates_hold() {
    let mut rng = Rng(2024);
    let mut counts = [0; 5];
    let mut target = Vec3::new(0.0, 1.6, -2.0);
    let mut rig = NumericRig::thug();
    let declared = rig.infos.clone();
    for frame in 0..10_000 {
        match rng.below(60) {
            0 => target = Vec3::new(0.0, 1.6, 0.0) + rng.direction() * rng.between(0.05, 8.0),
            1 => {
                // Change the ranges, some of which become inverted.
                for (info, declared) in rig.infos.iter_mut().zip(&declared) {
                    let (a, b) = (rng.between(-0.8, 0.3), rng.between(-0.3, 0.8));
                    info.heading = if rng.below(2) == 0 { declared.heading } else { Some([a, b]) };
                    info.pitch = if rng.below(2) == 0 { declared.pitch } else { Some([a, b]) };
                }
            }
            2 => rig.infos.clone_from(&declared),
            _ => target += rng.direction() * 0.02,
        }
        let pose = animated(&rig, &mut rng, 0.02);
        let dt = match rng.below(20) {
            0 => rng.between(-1.0, 1.0),
            1 => 0.0,
            _ => 1.0 / 60.0,
        };
        let settings = match rng.below(10) {
            0 => Settings::default().with_weight(rng.between(-0.2, 1.2)),
            1 => Settings::default().with_effector(rng.below(4)),
            2 => Settings::default().with_ascent(Ascent::paper()),
            _ => Settings::default(),
        };
        let before = rig.joints.clone();
        let outcome = rig.aim_with(&Pose::new(pose.clone()), target, dt, &settings);
        let case = format!("frame {frame}, dt {dt}");
        check(&rig, &before, &outcome, dt, &case);
        if dt.is_nan() || dt <= 0.0 {
            assert_eq!(rig.joints, before, "{case}: nothing moves");
        }
        if settings.weight == 1.0 && outcome.status != Status::Degenerate {
            let left = remaining64(&rig, &pose, settings.effector.min(2), target);
            assert!((left - f64::from(outcome.remaining)).abs() < 1e-5, "{case}: {left} {outcome:?}");
            assert_eq!(outcome.status == Status::Reached, outcome.remaining <= settings.tolerance, "{case}");
        }
        counts[match outcome.status {
            Status::Reached => 0,
            Status::RateLimited => 1,
            Status::AtLimit => 2,
            Status::Behind => 3,
            _ => 4,
        }] += 1;
    }
    assert!(counts[..4].iter().all(|&count| count > 100), "the sequence saw every status: {counts:?}");
}

/// The turret's free heading wraps at half a turn and keeps turning at its rate.
#[test]
fn free_heading_wraps() {
    let mut rig = NumericRig::turret();
    let pose = vec![
        bone(&THUG, Quat::IDENTITY, Vec3::new(0.0, 0.5, -0.2)),
        bone(&THUG, Quat::IDENTITY, Vec3::new(0.0, 0.2, 0.0)),
    ];
    let mut reached = 0;
    for frame in 0..2000 {
        let t = frame as f32 / 60.0;
        let target = Vec3::new(4.0 * (0.9 * t).sin(), 1.0, 4.0 * (0.9 * t).cos());
        let before = rig.joints.clone();
        let outcome = rig.aim(&Pose::new(pose.clone()), target, 1.0 / 60.0);
        check(&rig, &before, &outcome, 1.0 / 60.0, &format!("frame {frame}"));
        assert!(rig.joints[1].heading().abs() <= core::f32::consts::PI + 1e-6);
        assert!(!outcome.at_limit.contains(1), "a free heading has no limit");
        reached += usize::from(outcome.status == Status::Reached);
    }
    assert!(reached > 1700, "{reached}");
}

/// A static target within reach is reached, and once the displacement is minimal, nothing moves any more, exactly.
#[test]
fn joints_come_to_rest_on_a_static_target() {
    let mut rng = Rng(3);
    for case in 0..200 {
        let mut rig = NumericRig::thug();
        let pose = animated(&rig, &mut rng, 0.2);
        let sample: Vec<Joint> = rig
            .infos
            .iter()
            .map(|info| {
                let pick = |[lo, hi]: [f32; 2], rng: &mut Rng| rng.between(0.9 * lo, 0.9 * hi);
                Joint::from_angles(pick(info.heading.unwrap(), &mut rng), pick(info.pitch.unwrap(), &mut rng))
            })
            .collect();
        rig.joints = sample;
        let target = ahead(&rig, &pose, 0, rng.between(0.5, 5.0));
        rig.reset();
        let mut frames = 0;
        while rig.aim(&Pose::new(pose.clone()), target, 1.0 / 60.0).status != Status::Reached {
            frames += 1;
            assert!(frames < 400, "case {case}: {:?}", rig.aim(&Pose::new(pose.clone()), target, 0.0));
        }
        for _ in 0..240 {
            let outcome = rig.aim(&Pose::new(pose.clone()), target, 1.0 / 60.0);
            assert_eq!(outcome.status, Status::Reached, "case {case}: it stays reached");
        }
        let angles = |rig: &NumericRig| rig.joints.iter().map(|j| [j.heading(), j.pitch()]).collect::<Vec<_>>();
        let settled = angles(&rig);
        for _ in 0..10 {
            rig.aim(&Pose::new(pose.clone()), target, 1.0 / 60.0);
        }
        assert_eq!(angles(&rig), settled, "case {case}");
    }
}

/// The status is judged without the rates: a reachable target is never reported as out of reach, nor the reverse.
#[test]
fn at_limit_and_rate_limited_are_distinguished() {
    let mut rng = Rng(5);
    for case in 0..120 {
        let rig = NumericRig::thug();
        let pose = Pose::new(animated(&rig, &mut rng, 0.2));
        let heading = rng.between(-140.0, 140.0) * DEG;
        let pitch = rng.between(-80.0, 75.0) * DEG;
        let turn = Quat::from_rotation_y(heading) * Quat::from_rotation_x(pitch);
        let target = Vec3::new(-0.03, 1.68, -0.1) + turn * WORLD[0] * 3.0;
        let settled = rig.clone().snap(&pose, target);
        assert!(matches!(settled.status, Status::Reached | Status::AtLimit | Status::Behind));
        let mut stepped = rig.clone();
        let first = stepped.aim(&pose, target, 1.0 / 60.0);
        match settled.status {
            Status::Reached => assert!(matches!(first.status, Status::Reached | Status::RateLimited), "case {case}"),
            status => assert_eq!(first.status, status, "case {case}"),
        }
        // After many frames the gaze is as near as after the snap, whatever the sharing.
        let mut last = first;
        for _ in 0..300 {
            last = stepped.aim(&pose, target, 1.0 / 60.0);
        }
        assert!(last.remaining < settled.remaining + 2.5 * DEG, "case {case}: {settled:?} {last:?}");
        if settled.status == Status::Reached {
            assert_eq!(last.status, Status::Reached, "case {case}");
        }
    }
}

/// For a target that trembles exactly behind, the joints stay on their side.
#[test]
fn behind_keeps_its_side() {
    for side in [1.0, -1.0] {
        let mut rig = NumericRig::thug();
        let pose = Pose::new(upright(&rig));
        let at = |heading: f32, tilt: f32| {
            Vec3::new(-0.03, 1.68, -0.1)
                + Quat::from_rotation_y(heading * DEG) * Quat::from_rotation_x(tilt * DEG) * WORLD[0] * 3.0
        };
        let mut rng = Rng(9);
        let mut outcome = rig.aim(&pose, at(side * 100.0, 0.0), 1.0 / 60.0);
        for step in 0..70 {
            outcome = rig.aim(&pose, at(side * (110.0 + step as f32), 0.0), 1.0 / 60.0);
        }
        assert_eq!(outcome.status, Status::Behind);
        let settled = rig.joints.clone();
        assert!(settled[1].heading() * side > 50.0 * DEG);
        for _ in 0..600 {
            let outcome = rig.aim(&pose, at(180.0 + rng.between(-8.0, 8.0), rng.between(-5.0, 5.0)), 1.0 / 60.0);
            assert_eq!(outcome.status, Status::Behind);
            for (joint, settled) in rig.joints.iter().zip(&settled) {
                assert!((joint.heading() - settled.heading()).abs() < 3.0 * DEG, "{joint:?} {settled:?}");
            }
        }
        // When it is clearly on the other side, they follow.
        for _ in 0..300 {
            rig.aim(&pose, at(-side * 165.0, 0.0), 1.0 / 60.0);
        }
        assert!(rig.joints[1].heading() * side < -50.0 * DEG);
    }
}

/// A target seen for the first time exactly behind, where there is no gradient: the turn is to the left.
#[test]
fn exactly_behind_goes_left() {
    let mut rig = NumericRig::ball(THUG);
    let pose = Pose::new(vec![bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]);
    for _ in 0..60 {
        rig.aim(&pose, -WORLD[0], 1.0 / 60.0);
    }
    assert!((rig.joints[0].heading() - 180.0 * DEG).abs() < 0.2 * DEG);
}

/// If a target teleports, no angle moves faster than its rate; only a snap jumps.
#[test]
fn a_jump_of_the_target_respects_rates() {
    let mut rig = NumericRig::thug();
    let pose = Pose::new(upright(&rig));
    rig.snap(&pose, Vec3::new(-2.0, 1.7, -1.0));
    let left = rig.joints.clone();
    let before = rig.joints.clone();
    let outcome = rig.aim(&pose, Vec3::new(2.0, 1.7, -1.0), 1.0 / 60.0);
    assert_eq!(outcome.status, Status::RateLimited);
    check(&rig, &before, &outcome, 1.0 / 60.0, "teleport");
    let outcome = rig.snap(&pose, Vec3::new(2.0, 1.7, -1.0));
    assert_eq!(outcome.status, Status::Reached);
    assert!(rig.joints[1].heading() < 0.0 && left[1].heading() > 0.0);
}

/// At weight 0 the corrections decay at their rates to the exact identity, with a target or without.
#[test]
fn weight_zero_decays_to_the_identity() {
    for target in [Vec3::new(1.0, 1.7, -1.0), Vec3::NAN, Vec3::ZERO] {
        let mut rig = NumericRig::thug();
        let pose = Pose::new(upright(&rig));
        rig.snap(&pose, Vec3::new(-2.0, 1.9, -1.0));
        assert!(rig.joints.iter().any(|joint| joint.heading() != 0.0));
        let settings = Settings::default().with_weight(0.0);
        let mut outcome = rig.aim_with(&pose, target, 0.0, &settings);
        for frame in 0..60 {
            let before = rig.joints.clone();
            outcome = rig.aim_with(&pose, target, 1.0 / 60.0, &settings);
            check(&rig, &before, &outcome, 1.0 / 60.0, &format!("frame {frame}"));
        }
        assert!(rig.corrections().all(|(_, q)| q == Quat::IDENTITY));
        assert!(rig.joints.iter().all(|joint| joint.heading() == 0.0 && joint.pitch() == 0.0));
        assert_eq!(outcome.status, Status::Reached);
    }
}

/// Sweeping the weight causes no jump, also with the target behind.
#[test]
fn weight_sweeps_smoothly() {
    for target in [Vec3::new(-2.0, 1.6, -1.0), Vec3::new(0.1, 1.6, 3.0)] {
        let mut rig = NumericRig::thug();
        let pose = Pose::new(upright(&rig));
        for frame in 0..600 {
            let weight = 0.5 - 0.5 * (frame as f32 * 0.05).cos();
            let before = rig.joints.clone();
            let outcome = rig.aim_with(&pose, target, 1.0 / 60.0, &Settings::default().with_weight(weight));
            check(&rig, &before, &outcome, 1.0 / 60.0, &format!("frame {frame}"));
        }
    }
}

/// If ranges shrink below the angles, these return at their rates and are reported as recovering.
#[test]
fn joints_return_to_a_shrunken_range() {
    let mut rig = NumericRig::thug();
    let pose = Pose::new(upright(&rig));
    rig.snap(&pose, Vec3::new(-3.0, 1.7, -0.5));
    assert!(rig.joints[1].heading() > 20.0 * DEG);
    rig.infos[1].heading = Some([-5.0 * DEG, 5.0 * DEG]);
    let mut seen = false;
    for frame in 0..60 {
        let before = rig.joints.clone();
        let outcome = rig.aim(&pose, Vec3::new(-3.0, 1.7, -0.5), 1.0 / 60.0);
        check(&rig, &before, &outcome, 1.0 / 60.0, &format!("frame {frame}"));
        seen |= outcome.recovering.contains(1);
        if outcome.recovering.contains(1) {
            let moved = before[1].heading() - rig.joints[1].heading();
            assert!((moved - 170.0 * DEG / 60.0).abs() < 1e-5, "at its rate: {moved}");
        }
    }
    assert!(seen && rig.joints[1].heading() <= 5.0 * DEG);
}

/// The paper's ascent without any additions follows its target and keeps the limits.
#[test]
fn the_papers_ascent_follows_its_target() {
    let mut rig = NumericRig::thug();
    let pose = upright(&rig);
    let settings = Settings::default().with_ascent(Ascent::paper());
    let mut worst = 0.0_f32;
    for frame in 0..600 {
        let t = frame as f32 / 60.0;
        let target = Vec3::new(-1.2 * t.sin(), 1.6 + 0.2 * (0.7 * t).sin(), -2.0);
        let before = rig.joints.clone();
        let outcome = rig.aim_with(&Pose::new(pose.clone()), target, 1.0 / 60.0, &settings);
        check(&rig, &before, &outcome, 1.0 / 60.0, &format!("frame {frame}"));
        if frame > 30 {
            worst = worst.max(outcome.remaining);
        }
    }
    assert!(worst < 2.0 * DEG, "{}", worst / DEG);
    // Supporting joints relax: with the target ahead again, the neck returns to rest, though only nearly with the
    // paper's coarse steps.
    let finished = settings.with_ascent(Ascent::default().with_relax(Some(0.95)));
    for (settings, near) in [(settings, 5.0 * DEG), (finished, 0.1 * DEG)] {
        rig.snap(&Pose::new(pose.clone()), Vec3::new(-2.0, 1.7, -1.0));
        assert!(rig.joints[1].heading() > 20.0 * DEG);
        for _ in 0..300 {
            rig.aim_with(&Pose::new(pose.clone()), Vec3::new(-0.03, 1.68, -3.0), 1.0 / 60.0, &settings);
        }
        assert!(rig.joints[1].heading().abs() < near, "{}", rig.joints[1].heading() / DEG);
    }
}

/// Far from the world's origin, as precisely as f32 represents the pose.
#[test]
fn results_are_accurate_far_from_the_origin() {
    let away = Affine3A::from_translation(Vec3::new(2048.0, -512.0, 1024.0));
    let mut rig = NumericRig::thug();
    let pose: Vec<Affine3A> = upright(&rig).iter().map(|joint| away * *joint).collect();
    let target = away.transform_point3(Vec3::new(-1.0, 1.9, -2.0));
    let outcome = rig.snap(&Pose::new(pose.clone()), target);
    assert_eq!(outcome.status, Status::Reached);
    assert!(remaining64(&rig, &pose, 0, target) < 1e-4);
}
