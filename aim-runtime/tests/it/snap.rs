//! `snap` reaches every reachable target precisely, and gets as near as possible to the others.

use crate::common::*;
use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::{Joint, JointInfo, Pose, Status};

/// Sets the joints to random angles within their ranges.
fn random_angles(rig: &mut NumericRig, rng: &mut Rng) {
    let mut joints = rig.joints.clone();
    for (joint, info) in joints.iter_mut().zip(&rig.infos) {
        let mut pick = |range: Option<[f32; 2]>| range.map_or(0.0, |[lo, hi]| rng.between(lo.max(-3.0), hi.min(3.0)));
        *joint = Joint::from_angles(pick(info.heading), pick(info.pitch));
    }
    rig.joints = joints;
}

#[test]
fn a_snap_reaches_every_reachable_target() {
    let mut rng = Rng(1);
    let mut failed = 0;
    let mut inexact = 0;
    for case in 0..3000 {
        let mut rig = NumericRig::thug();
        let pose = animated(&rig, &mut rng, 0.4);
        // A target that some angles look at is reachable.
        random_angles(&mut rig, &mut rng);
        let target = ahead(&rig, &pose, 0, rng.between(0.3, 20.0));
        if case % 2 == 0 {
            random_angles(&mut rig, &mut rng);
        } else {
            rig.reset();
        }
        let outcome = rig.snap(&Pose::new(pose.clone()), target);
        let left = remaining64(&rig, &pose, 0, target);
        assert!((left - f64::from(outcome.remaining)).abs() < 3e-6);
        if outcome.status != Status::Reached {
            failed += 1;
            eprintln!("case {case}: {:?} {}", outcome.status, left.to_degrees());
        } else if left > 2e-5 {
            inexact += 1;
        }
    }
    assert_eq!((failed, inexact), (0, 0));
}

/// Chains of one to six joints, including hinges, with offset effectors and ranges of any size.
#[test]
fn a_snap_reaches_with_any_chain() {
    let mut rng = Rng(99);
    for case in 0..2000 {
        let mut place = Vec3::new(0.0, 1.7, 0.0);
        let (mut infos, mut pose) = (Vec::new(), Vec::new());
        for _ in 0..1 + rng.below(6) {
            let mut info = JointInfo::new(THUG, 1.0).with_stiffness(rng.between(0.3, 4.0));
            let hinge = rng.below(6);
            if hinge != 0 {
                info = info.with_heading(-rng.between(5.0, 70.0) * DEG, rng.between(5.0, 70.0) * DEG);
            }
            if hinge != 1 {
                info = info.with_pitch(-rng.between(5.0, 40.0) * DEG, rng.between(5.0, 40.0) * DEG);
            }
            infos.push(info);
            pose.push(bone(&THUG, Quat::from_axis_angle(rng.direction(), rng.between(0.0, 0.4)), place));
            place += Vec3::new(rng.between(-0.05, 0.05), -rng.between(0.02, 0.3), rng.between(-0.05, 0.1));
        }
        let mut rig = NumericRig::new(infos);
        rig.effector.origin = (rng.direction() * 0.05).to_array();
        random_angles(&mut rig, &mut rng);
        let target = ahead(&rig, &pose, 0, rng.between(0.3, 10.0));
        rig.reset();
        let outcome = rig.snap(&Pose::new(pose.clone()), target);
        if outcome.status != Status::Behind {
            assert_eq!(outcome.status, Status::Reached, "case {case}: {outcome:?}");
            assert!(remaining64(&rig, &pose, 0, target) < 2e-5, "case {case}");
        }
    }
}

/// Out of reach, the best of many random postures is no nearer.
#[test]
fn out_of_reach_a_snap_is_as_near_as_random_postures() {
    let mut rng = Rng(4);
    let mut unreachable = 0;
    for case in 0..100 {
        let mut rig = NumericRig::thug();
        let pose = animated(&rig, &mut rng, 0.2);
        let turn = Quat::from_rotation_y(rng.between(-145.0, 145.0) * DEG);
        let tilt = Quat::from_rotation_x(rng.between(-90.0, 90.0) * DEG);
        let target = Vec3::new(-0.03, 1.68, -0.1) + turn * tilt * WORLD[0] * 2.0;
        let outcome = rig.snap(&Pose::new(pose.clone()), target);
        if outcome.status == Status::AtLimit {
            unreachable += 1;
            let mut probe = rig.clone();
            for _ in 0..3000 {
                random_angles(&mut probe, &mut rng);
                let left = remaining64(&probe, &pose, 0, target);
                assert!(left > f64::from(outcome.remaining) - 2e-3, "case {case}: {outcome:?}, {left}");
            }
        }
    }
    assert!(unreachable > 20, "{unreachable}");
}

/// For reachable targets the result does not depend on the joints' previous angles: scrubbing in both directions
/// agrees.
#[test]
fn a_snap_does_not_depend_on_the_past() {
    let pose = Pose::new(upright(&NumericRig::thug()));
    let (mut there, mut back) = (NumericRig::thug(), NumericRig::thug());
    let at = |step: i32| Vec3::new(-0.1 * step as f32, 1.6, -1.0);
    for step in -15..=15 {
        there.snap(&pose, at(step));
        for other in (step..=15).rev() {
            back.snap(&pose, at(other));
        }
        assert_eq!(there.corrections().collect::<Vec<_>>(), back.corrections().collect::<Vec<_>>(), "{step}");
    }
}

/// A target on the animated effector has no direction: nothing moves, whatever the joints' angles.
#[test]
fn a_target_on_the_effector_leaves_the_joints() {
    for turned in [0.0, 0.3] {
        let mut rig = NumericRig::thug();
        let pose = upright(&rig);
        rig.joints.fill(Joint::from_angles(turned, 0.5 * turned));
        let before = rig.joints.clone();
        let outcome = rig.snap(&Pose::new(pose.clone()), pose[0].translation.into());
        assert_eq!((outcome.status, &rig.joints), (Status::Degenerate, &before));
    }
}
