//! Several weighted targets in one call.
#![allow(clippy::cast_precision_loss, reason = "frames are counted")]

use crate::common::*;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Pose, Settings, Status, Target};

const DT: f32 = 1.0 / 60.0;

fn targets(rng: &mut Rng, count: usize) -> Vec<Target> {
    let one = |rng: &mut Rng| {
        let turn = Quat::from_rotation_y(rng.between(-1.2, 1.2)) * Quat::from_rotation_x(rng.between(-0.4, 0.4));
        let point = Vec3::new(-0.03, 1.68, -0.1) + turn * WORLD[0] * rng.between(0.5, 5.0);
        Target::new(point, rng.between(0.0, 1.0))
    };
    (0..count).map(|_| one(rng)).collect()
}

/// One target of weight 1 equals the plain call, bit for bit; of another weight, the weighted call.
#[test]
fn one_target_equals_the_plain_call() {
    let mut rng = Rng(12);
    for _ in 0..50 {
        let target = targets(&mut rng, 1)[0];
        let (mut several, mut one) = (NumericRig::thug(), NumericRig::thug());
        let pose = Pose::new(animated(&one, &mut rng, 0.1));
        for weight in [1.0, 7.0, target.weight] {
            let settings = Settings::default().with_weight(0.8 * weight.min(1.0));
            for _ in 0..20 {
                let list = [Target { weight, ..target }];
                let a = several.aim_at(&pose, &list, DT, &Settings::default().with_weight(0.8));
                assert_eq!(a, one.aim_with(&pose, target.point, DT, &settings));
                assert_eq!(several.joints, one.joints);
            }
        }
    }
}

/// The order of targets does not matter, bit for bit.
#[test]
fn the_order_of_targets_does_not_matter() {
    let mut rng = Rng(13);
    for _ in 0..100 {
        let count = 2 + rng.below(5);
        let mut list = targets(&mut rng, count);
        let mut rig = NumericRig::thug();
        let pose = Pose::new(animated(&rig, &mut rng, 0.1));
        rig.snap_at(&pose, &list, &Settings::default());
        let joints = rig.joints.clone();
        for _ in 0..5 {
            let (a, b) = (rng.below(count), rng.below(count));
            list.swap(a, b);
            rig.reset();
            rig.snap_at(&pose, &list, &Settings::default());
            assert_eq!(rig.joints, joints);
        }
    }
}

/// The gaze for several targets is between them, in every world.
#[test]
fn the_gaze_is_between_several_targets() {
    for (name, parent, _) in parents().into_iter().filter(|parent| parent.2) {
        for scale in [0.01, 1.0, 100.0] {
            let world = Affine3A::from_scale(Vec3::splat(scale)) * parent;
            let mut rig = NumericRig::ball(THUG);
            let pose = Pose::new(vec![world * bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]);
            let at = |heading: f32, weight| {
                Target::new(world.transform_point3(Quat::from_rotation_y(heading * DEG) * WORLD[0] * 2.0), weight)
            };
            let settings = Settings::default();
            for (list, heading) in [
                ([at(0.0, 1.0), at(60.0, 1.0)], 30.0),
                ([at(-40.0, 0.3), at(40.0, 0.3)], 0.0),
                ([at(0.0, 0.0), at(60.0, 0.5)], 30.0),
                ([at(20.0, 0.25), at(60.0, 0.25)], 20.0),
            ] {
                let outcome = rig.snap_at(&pose, &list, &settings);
                assert_eq!(outcome.status, Status::Reached, "{name} × {scale}");
                let found = rig.joints[0].heading() / DEG;
                assert!((found - heading).abs() < 0.1, "{name} × {scale}: {found} for {heading}");
            }
        }
    }
}

/// Small changes of the weights change the gaze little, from one target to the other and out again.
#[test]
fn the_gaze_is_continuous_in_the_weights() {
    let mut rng = Rng(14);
    for _ in 0..20 {
        let list = targets(&mut rng, 3);
        let mut rig = NumericRig::ball(THUG);
        let pose = Pose::new(vec![bone(&THUG, Quat::IDENTITY, Vec3::new(-0.03, 1.68, -0.1))]);
        let mut last: Option<(f32, f32)> = None;
        for step in 0..=300 {
            let t = step as f32 / 100.0;
            let weight = |start: f32| (1.0 - (t - start).abs()).max(0.0);
            let weighted = [0.0, 1.0, 2.0].map(weight);
            let list: Vec<Target> =
                list.iter().zip(weighted).map(|(&target, weight)| Target { weight, ..target }).collect();
            rig.reset();
            rig.snap_at(&pose, &list, &Settings::default());
            let now = (rig.joints[0].heading(), rig.joints[0].pitch());
            if let Some((heading, pitch)) = last {
                let change = (now.0 - heading).abs().max((now.1 - pitch).abs());
                assert!(change < 0.1, "{change} at {t}");
            }
            last = Some(now);
        }
    }
}

/// Without a target the corrections decay to the exact identity, at their rates.
#[test]
fn without_targets_the_gaze_is_that_of_weight_zero() {
    let mut rig = NumericRig::thug();
    let pose = Pose::new(upright(&rig));
    rig.snap(&pose, Vec3::new(-2.0, 1.9, -1.0));
    for frame in 0..60 {
        let before = rig.joints.clone();
        let list: &[Target] = if frame % 2 == 0 { &[] } else { &[Target::new(Vec3::NAN, 1.0)] };
        rig.aim_at(&pose, list, DT, &Settings::default());
        for ((info, old), new) in rig.infos.iter().zip(&before).zip(&rig.joints) {
            assert!((new.heading() - old.heading()).abs() <= info.rate * DT + 1e-6);
        }
    }
    assert!(rig.corrections().all(|(_, q)| q == Quat::IDENTITY));
}

/// For inputs of any bits, corrections are finite, unit and within the ranges.
#[test]
fn random_bits_are_harmless() {
    let mut rng = Rng(15);
    let mut rig = NumericRig::thug();
    for _ in 0..3000 {
        let count = rng.below(4);
        let list: Vec<Target> =
            (0..count).map(|_| Target::new(Vec3::new(rng.any(), rng.any(), rng.any()), rng.any())).collect();
        let mut joints = upright(&rig);
        if rng.below(4) == 0 {
            joints[rng.below(3)].translation.x = rng.any();
        }
        let outcome = rig.aim_at(&Pose::new(joints), &list, DT, &Settings::default());
        assert!(sound(&rig) && outcome.remaining.is_finite());
    }
}
