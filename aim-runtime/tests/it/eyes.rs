//! Both eyes in one call, checked by independent forward kinematics in f64.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "frames are counted")]

use crate::common::*;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Axes, Behind, Joint, Outcome, Pose, Settings, Status};

const DT: f32 = 1.0 / 60.0;
/// Point between the eyes in the upright pose.
const MIDDLE: Vec3 = Vec3::new(0.0, 1.68, -0.10);

/// Returns the upright thug with eyes 6 cm apart; the rig's own is the left one.
fn upright_pair(rig: &NumericRig, pair: &Axes) -> (Vec<Affine3A>, Affine3A) {
    (upright(rig), bone(pair, Quat::IDENTITY, MIDDLE + Vec3::new(0.03, 0.0, 0.0)))
}

fn posed((joints, pair): &(Vec<Affine3A>, Affine3A)) -> Pose<Vec<Affine3A>> {
    Pose::new(joints.clone()).with_other_eye(*pair)
}

fn at(heading_deg: f32, pitch_deg: f32, distance: f32) -> Vec3 {
    MIDDLE + Quat::from_rotation_y(heading_deg * DEG) * Quat::from_rotation_x(pitch_deg * DEG) * WORLD[0] * distance
}

fn directions(rig: &NumericRig, (joints, pair): &(Vec<Affine3A>, Affine3A)) -> [Vec3; 2] {
    [gaze64(rig, joints, 0).1, pair_gaze64(rig, joints, pair).1].map(|v| Vec3::from(v.map(|x| x as f32)))
}

/// Returns the convergence of the eyes, radians; negative if they diverge.
fn convergence(rig: &NumericRig) -> f32 {
    rig.memory.other_eye().unwrap()[0] - rig.joints[0].heading()
}

/// Runs one frame of both eyes; asserts that both keep to ranges and rates and that the outcome is right.
fn aim(
    rig: &mut NumericRig,
    pose: &(Vec<Affine3A>, Affine3A),
    target: Vec3,
    dt: f32,
    settings: &Settings,
    case: &str,
) -> Outcome {
    let (before, eye_before) = (rig.joints.clone(), rig.memory.other_eye());
    let outcome = rig.aim_with(&posed(pose), target, dt, settings);
    if outcome.status == Status::Degenerate {
        assert_eq!(before, rig.joints, "{case}");
        return outcome;
    }
    let own = |joint: &Joint| [joint.heading(), joint.pitch()];
    let mut moves: Vec<_> =
        rig.infos.iter().zip(&before).zip(&rig.joints).map(|((i, a), b)| (*i, own(a), own(b))).collect();
    let mut mirrored = rig.infos[0];
    mirrored.heading = mirrored.heading.map(|[lo, hi]| [-hi, -lo]);
    if dt > 0.0 {
        moves.push((mirrored, eye_before.unwrap_or_default(), rig.memory.other_eye().unwrap()));
    }
    for (index, (info, old, new)) in moves.into_iter().enumerate() {
        for ((range, old), new) in [info.heading, info.pitch].into_iter().zip(old).zip(new) {
            let [lo, hi] = range.unwrap_or_default();
            assert!((new - old).abs() <= info.rate * dt.clamp(0.0, 0.1) + 1e-6, "{case}: {index} from {old} to {new}");
            let outside = |angle: f32| (lo - angle).max(angle - hi).max(0.0);
            assert!(outside(new) <= outside(old), "{case}: {index} from {old} to {new}");
        }
    }
    if let Some(q) = rig.other_eye_correction() {
        let length = q.to_array().map(f64::from).iter().map(|x| x * x).sum::<f64>().sqrt();
        assert!((length - 1.0).abs() < 1e-6 && sound(rig), "{case}");
    }
    if settings.weight == 1.0 && settings.effector == 0 && dt > 0.0 {
        let (joints, pair) = pose;
        let left = [remaining64(rig, joints, 0, target), angle_to64(pair_gaze64(rig, joints, pair), target)];
        for (left, reported) in left.into_iter().zip([outcome.remaining, outcome.other_eye_remaining.unwrap()]) {
            assert!((left - f64::from(reported)).abs() < 2e-5, "{case}: {left} but {outcome:?}");
        }
        // A follower does not affect the status.
        if rig.effector.origin != [0.0; 3] {
            return outcome;
        }
        let farther = outcome.remaining.max(outcome.other_eye_remaining.unwrap());
        assert_eq!(outcome.status == Status::Reached, farther <= settings.tolerance, "{case}: {outcome:?}");
    }
    outcome
}

fn settle(rig: &mut NumericRig, pose: &(Vec<Affine3A>, Affine3A), target: Vec3, case: &str) -> Outcome {
    for _ in 0..120 {
        aim(rig, pose, target, DT, &Settings::default(), case);
    }
    aim(rig, pose, target, DT, &Settings::default(), case)
}

#[test]
fn near_they_converge_and_far_they_are_parallel() {
    for (heading, pitch) in [(0.0, 0.0), (30.0, 10.0), (-60.0, -15.0), (80.0, 0.0)] {
        for distance in [0.15, 0.3, 1.0, 50.0, 1e9] {
            let mut rig = NumericRig::thug();
            let pose = upright_pair(&rig, &THUG);
            let target = at(heading, pitch, distance);
            let case = format!("{heading}°, {pitch}°, {distance} m");
            let snapped = rig.snap(&posed(&pose), target);
            assert_eq!(snapped.status, Status::Reached, "{case}: {snapped:?} {:?}", rig.joints);
            rig.reset();
            let outcome = settle(&mut rig, &pose, target, &case);
            assert_eq!(outcome.status, Status::Reached, "{case}: {outcome:?}");
            let [a, b] = directions(&rig, &pose);
            let apart = a.angle_between(b);
            // 6 cm as seen from the target, less what the turn of the head takes off.
            let wanted = if distance > 10.0 { 0.06 / distance } else { 0.0 };
            assert!(
                if distance > 10.0 { (apart - wanted).abs() < 5e-4 } else { apart > 0.03 / distance },
                "{case}: {apart}"
            );
        }
    }
}

/// A target nearer than 10 cm is aimed at as if it were at 10 cm, and not reported as reached.
#[test]
fn targets_nearer_than_ten_centimetres_are_moved_out() {
    for size in [0.01, 1.0, 100.0] {
        let world = Affine3A::from_scale(Vec3::splat(size));
        let mut angles = Vec::new();
        for distance in [0.100_5, 0.08, 0.04, 0.01] {
            let mut rig = NumericRig::thug();
            let (joints, pair) = upright_pair(&rig, &THUG);
            let pose = (joints.iter().map(|joint| world * *joint).collect(), world * pair);
            let outcome = settle(&mut rig, &pose, world.transform_point3(at(0.0, 0.0, distance)), "near");
            let expected = if distance > 0.1 { Status::Reached } else { Status::AtLimit };
            assert_eq!(outcome.status, expected, "{distance} × {size}: {outcome:?}");
            angles.push(convergence(&rig) / DEG);
        }
        for angle in angles {
            assert!((angle - 2.0 * 16.7).abs() < 0.2, "{angle}");
        }
    }
}

/// In every convention of the other eye's bone, and in a mirrored world, it looks the same way.
#[test]
fn the_other_eye_may_have_any_convention() {
    let mirror = Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0));
    for (heading, pitch, distance) in [(20.0, 8.0, 0.3), (-50.0, -12.0, 2.0)] {
        let target = at(heading, pitch, distance);
        let mut reference = NumericRig::thug();
        let pose = upright_pair(&reference, &THUG);
        settle(&mut reference, &pose, target, "reference");
        let expected = directions(&reference, &pose);
        for (own, _) in triples().into_iter().step_by(5) {
            for (axes, _) in triples() {
                for mirrored in [false, true] {
                    let world = if mirrored { mirror } else { Affine3A::IDENTITY };
                    let mut rig = NumericRig::thug_with(own);
                    let (joints, pair) = upright_pair(&rig, &axes);
                    let pose = (joints.iter().map(|joint| world * *joint).collect(), world * pair);
                    let case = format!("{own:?} {axes:?} {mirrored}");
                    for _ in 0..60 {
                        aim(&mut rig, &pose, world.transform_point3(target), DT, &Settings::default(), &case);
                    }
                    for (found, expected) in directions(&rig, &pose).into_iter().zip(expected) {
                        let found = world.transform_vector3(found);
                        assert!((found - expected).length() < 5e-4, "{case}: {found} for {expected}");
                    }
                }
            }
        }
    }
}

/// Under every parent, at every scale, in any animation.
#[test]
fn both_eyes_aim_under_every_parent_transform() {
    let mut rng = Rng(21);
    for (name, parent, similar) in parents() {
        for size in [0.01, 1.0, 100.0] {
            let world = Affine3A::from_scale(Vec3::splat(size)) * parent;
            for case in 0..10 {
                let mut rig = NumericRig::thug();
                let joints = animated(&rig, &mut rng, 0.15);
                let axes = triples()[rng.below(48)].0;
                let other = Affine3A::from_translation(Vec3::new(0.06, 0.0, 0.0))
                    * bone(&axes, Quat::from_axis_angle(rng.direction(), 0.1), joints[0].translation.into());
                let pose = (joints.iter().map(|joint| world * *joint).collect::<Vec<_>>(), world * other);
                let stretch = if similar { 1.0 } else { 0.4 };
                let target = at(rng.between(-60.0, 60.0), stretch * rng.between(-15.0, 10.0), rng.between(0.3, 3.0));
                let case = format!("{name} × {size}, case {case}");
                let outcome = settle(&mut rig, &pose, world.transform_point3(target), &case);
                assert_eq!(outcome.status, Status::Reached, "{case}: {outcome:?} {:?}", rig.joints);
            }
        }
    }
}

/// Targets that wander, jump, come close and pass behind, with varying poses, weights and time steps.
#[test]
fn limits_and_rates_hold_and_eyes_never_part() {
    let mut rng = Rng(22);
    let mut rig = NumericRig::thug();
    // A wider range outward than inward.
    rig.infos[0].heading = Some([-25.0 * DEG, 40.0 * DEG]);
    let mut target = at(0.0, 0.0, 1.0);
    let mut counts = [0; 4];
    for frame in 0..6000 {
        match rng.below(40) {
            0 => target = MIDDLE + rng.direction() * rng.between(0.02, 4.0),
            1 => target = at(rng.between(-80.0, 80.0), rng.between(-20.0, 20.0), rng.between(0.1, 50.0)),
            _ => target += rng.direction() * 0.01,
        }
        let mut pose = upright_pair(&rig, &THUG);
        let turn = Affine3A::from_quat(Quat::from_axis_angle(rng.direction(), 0.01));
        pose.0.iter_mut().for_each(|joint| *joint = turn * *joint);
        pose.1 = turn * pose.1;
        let settings = match rng.below(12) {
            0 => Settings::default().with_weight(rng.between(-0.2, 1.2)),
            1 => Settings::default().with_effector(rng.below(4)),
            2 => Settings::default().with_behind([Behind::Off, Behind::Hold, Behind::Release][rng.below(3)]),
            _ => Settings::default(),
        };
        let dt = if rng.below(20) == 0 { rng.between(-0.05, 0.2) } else { DT };
        let outcome = aim(&mut rig, &pose, target, dt, &settings, &format!("frame {frame}"));
        if dt > 0.0 && outcome.status != Status::Degenerate {
            assert!(convergence(&rig) >= -1e-6, "frame {frame}: {}", convergence(&rig));
        }
        counts[match outcome.status {
            Status::Reached => 0,
            Status::RateLimited => 1,
            Status::AtLimit => 2,
            _ => 3,
        }] += 1;
    }
    assert!(counts.iter().all(|&count| count > 100), "{counts:?}");
}

/// If one eye reaches a target just outside the other's range, it is not reached yet; the neck turns until both reach
/// it.
#[test]
fn the_neck_turns_so_that_both_eyes_reach_the_target() {
    for side in [1.0, -1.0] {
        let mut rig = NumericRig::thug();
        let pose = upright_pair(&rig, &THUG);
        for heading in 0..=110 {
            let target = at(side * heading as f32, 0.0, 0.4);
            let outcome = settle(&mut rig, &pose, target, &format!("{heading}"));
            if heading <= 100 {
                assert_eq!(outcome.status, Status::Reached, "{heading}: {outcome:?} {:?}", rig.joints);
            }
        }
    }
}

/// A static target leaves the eyes still, in reach or not, also overhead; a trembling one, nearly so.
#[test]
fn still_targets_leave_the_eyes_still() {
    let mut rng = Rng(25);
    for (heading, pitch, distance) in
        [(20.0, 5.0, 0.3), (110.0, 0.0, 0.3), (140.0, 30.0, 1.0), (10.0, 85.0, 0.5), (0.0, 0.0, 0.05)]
    {
        let mut rig = NumericRig::thug();
        let pose = upright_pair(&rig, &THUG);
        let target = at(heading, pitch, distance);
        settle(&mut rig, &pose, target, "still");
        let angles = |rig: &NumericRig| {
            let (eye, other) = (&rig.joints[0], rig.memory.other_eye().unwrap());
            [eye.heading(), eye.pitch(), other[0], other[1]]
        };
        for tremble in [0.0, 1e-3] {
            for _ in 0..120 {
                let before = angles(&rig);
                let near = target + rng.direction() * tremble;
                let outcome = aim(&mut rig, &pose, near, DT, &Settings::default(), "still");
                let change = angles(&rig).iter().zip(before).fold(0.0, |most: f32, (a, b)| most.max((a - b).abs()));
                // The trembling itself, as seen from the eyes. Out of reach a chain comes to rest slowly. Overhead the
                // head makes small turns: to leave range for convergence, and because its heading has no effect there.
                let settled = outcome.status == Status::Reached && pitch < 60.0;
                let slowly = if settled { 1e-5 } else { 0.2 * DEG };
                let bound = slowly + 3.0 * tremble / distance.max(0.1);
                assert!(change <= bound, "{heading}°, {pitch}°, {distance} m: {} at {tremble}", change / DEG);
            }
        }
    }
}

#[test]
fn weight_zero_and_a_head_that_is_aimed_bring_both_to_rest() {
    for (settings, effector) in [(Settings::default().with_weight(0.0), 0), (Settings::default().with_effector(1), 1)] {
        let mut rig = NumericRig::thug();
        let pose = upright_pair(&rig, &THUG);
        settle(&mut rig, &pose, at(40.0, 5.0, 0.3), "before");
        assert!(rig.other_eye_correction().unwrap() != Quat::IDENTITY);
        for _ in 0..60 {
            let outcome = aim(&mut rig, &pose, at(20.0, 0.0, 3.0), DT, &settings, "to rest");
            assert!(outcome.other_eye_remaining.is_some());
        }
        assert_eq!(rig.other_eye_correction(), Some(Quat::IDENTITY), "{effector}");
        assert_eq!((rig.joints[0].heading(), rig.joints[0].pitch()), (0.0, 0.0));
        assert_eq!(rig.joints[1].heading() == 0.0, effector == 0);
    }
}

/// A decreasing weight reduces the convergence continuously.
#[test]
fn weight_scales_the_convergence() {
    let mut rig = NumericRig::thug();
    let pose = upright_pair(&rig, &THUG);
    let mut last = f32::INFINITY;
    for weight in [1.0, 0.75, 0.5, 0.25, 0.05, 0.0] {
        let outcome = rig.snap_with(&posed(&pose), at(0.0, 0.0, 0.3), &Settings::default().with_weight(weight));
        assert_eq!(outcome.status, Status::Reached, "{weight}: {outcome:?}");
        let converged = convergence(&rig);
        assert!(converged < last, "{weight}: {converged}");
        assert!((converged - weight * 0.2).abs() < 0.01, "{weight}: {converged}");
        last = converged;
    }
    assert_eq!(last, 0.0);
}

/// With an effector beside the eye, that eye leads alone and the other one turns in parallel.
#[test]
fn an_eye_beside_an_offset_effector_follows_in_parallel() {
    let mut rig = NumericRig::thug();
    rig.effector.origin = [0.0, 0.01, 0.0];
    let axes = triples()[17].0;
    let pose = upright_pair(&rig, &axes);
    let outcome = settle(&mut rig, &pose, at(30.0, 5.0, 0.5), "follower");
    assert_eq!(outcome.status, Status::Reached);
    let [a, b] = directions(&rig, &pose);
    assert!(a.angle_between(b) < 1e-3);
    assert!(outcome.other_eye_remaining.unwrap() > 0.05);
}

#[test]
fn without_another_eye_results_are_unchanged() {
    let mut rng = Rng(23);
    let (mut with, mut without) = (NumericRig::thug(), NumericRig::thug());
    let pose = upright_pair(&with, &THUG);
    assert_eq!(with.other_eye_correction(), None);
    with.aim(&posed(&pose), at(30.0, 0.0, 0.5), 0.0);
    assert_eq!(with.other_eye_correction(), Some(Quat::IDENTITY), "no time has passed");
    for _ in 0..50 {
        let target = at(rng.between(-90.0, 90.0), 0.0, 2.0);
        let plain = Pose::new(pose.0.clone());
        let a = with.aim(&(plain.clone()), target, DT);
        assert_eq!((a, a.other_eye_remaining), (without.aim(&plain, target, DT), None));
        assert_eq!(with.joints, without.joints);
    }
    with.aim(&posed(&pose), at(30.0, 0.0, 0.5), DT);
    assert!(with.other_eye_correction().is_some());
    with.aim(&Pose::new(pose.0), at(30.0, 0.0, 0.5), DT);
    assert_eq!(with.other_eye_correction(), None, "forgotten");
}

/// An invalid transform of the other eye is degenerate: everything is held.
#[test]
fn an_invalid_other_eye_is_degenerate() {
    let mut rig = NumericRig::thug();
    let (joints, pair) = upright_pair(&rig, &THUG);
    settle(&mut rig, &(joints.clone(), pair), at(30.0, 5.0, 0.5), "before");
    let (before, correction) = (rig.joints.clone(), rig.other_eye_correction());
    for bad in [
        Affine3A::from_translation(Vec3::NAN),
        Affine3A::from_scale(Vec3::ZERO),
        Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0)),
        Affine3A::from_scale(Vec3::INFINITY),
    ] {
        let outcome = rig.aim(&posed(&(joints.clone(), bad)), at(0.0, 0.0, 1.0), DT);
        assert_eq!((outcome.status, outcome.other_eye_remaining), (Status::Degenerate, None));
        assert_eq!((&rig.joints, rig.other_eye_correction()), (&before, correction));
    }
    // Exactly between the eyes there is no direction for the pair; on the other eye, none for that eye.
    for target in [MIDDLE, Vec3::from(pair.translation), Vec3::NAN] {
        let outcome = NumericRig::thug().aim(&posed(&(joints.clone(), pair)), target, DT);
        assert!(outcome.remaining.is_finite(), "{outcome:?}");
    }
    // Two eyes at the same point never converge.
    let outcome = rig.snap(&posed(&(joints.clone(), joints[0])), at(0.0, 0.0, 0.3));
    assert_eq!(outcome.status, Status::Reached);
    assert_eq!(convergence(&rig), 0.0);
}

#[test]
fn random_bits_are_harmless() {
    let mut rng = Rng(24);
    let mut rig = NumericRig::thug();
    for _ in 0..5000 {
        let (mut joints, mut pair) = upright_pair(&rig, &THUG);
        let spoilt = rng.below(4);
        let spoil = |rng: &mut Rng, joint: &mut Affine3A| {
            let mut numbers = joint.to_cols_array();
            numbers[rng.below(12)] = rng.any();
            *joint = Affine3A::from_cols_array(&numbers);
        };
        if spoilt == 0 {
            spoil(&mut rng, &mut pair);
        } else if spoilt == 1 {
            let joint = rng.below(3);
            spoil(&mut rng, &mut joints[joint]);
        }
        let target = if rng.below(2) == 0 { Vec3::new(rng.any(), rng.any(), rng.any()) } else { at(10.0, 0.0, 0.5) };
        let settings = Settings::default().with_weight(rng.any()).with_effector(rng.below(3));
        let pose = posed(&(joints, pair));
        let outcome = if rng.below(5) == 0 {
            rig.snap_with(&pose, target, &settings)
        } else {
            rig.aim_with(&pose, target, DT, &settings)
        };
        assert!(outcome.remaining.is_finite() && sound(&rig));
        if let Some(q) = rig.other_eye_correction() {
            assert!((q.length() - 1.0).abs() < 2e-6, "{q}");
        }
        assert!(outcome.other_eye_remaining.is_none_or(|left| left.is_finite()));
    }
}
