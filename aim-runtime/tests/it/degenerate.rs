//! For inputs of any bits, corrections are finite and unit, the status is right, and the state remains usable.

use crate::common::*;
use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3, Vec3A};
use aim_runtime::{Axes, Call, Effector, Joint, Pose, Rig, Settings, State, Status, Target, Targets};

/// Asserts that one second of valid input aims as usual, whatever came before.
fn still_works(rig: &mut NumericRig, case: &str) {
    let pose = Pose::new(upright(rig));
    let target = Vec3::new(-1.0, 1.8, -2.0);
    let mut outcome = rig.aim(&pose, target, 1.0 / 60.0);
    for _ in 0..180 {
        outcome = rig.aim(&pose, target, 1.0 / 60.0);
    }
    assert_eq!(outcome.status, Status::Reached, "{case}: {outcome:?} {:?}", rig.joints);
}

#[test]
fn random_bits_are_harmless() {
    let mut rng = Rng(77);
    for case in 0..4000 {
        let mut rig = NumericRig::thug();
        let declared = rig.infos.clone();
        rig.snap(&Pose::new(upright(&rig)), Vec3::new(1.0, 1.5, -2.0));
        for _ in 0..4 {
            let mut pose = upright(&rig);
            let joint = rng.below(3);
            match rng.below(5) {
                0 => pose[joint].translation = Vec3A::new(rng.any(), rng.any(), rng.any()),
                1 => {
                    let mut axis = || Vec3A::new(rng.any(), rng.any(), rng.any());
                    pose[joint].matrix3 = Mat3A::from_cols(axis(), axis(), axis());
                }
                2 => {
                    let by = Affine3A::from_scale(Vec3::new(rng.any(), rng.any(), rng.any()));
                    pose.iter_mut().for_each(|joint| *joint = by * *joint);
                }
                _ => {}
            }
            let target = Vec3::new(rng.any(), rng.any(), rng.any());
            if rng.below(4) == 0 {
                let info = &mut rig.infos[rng.below(3)];
                info.heading = Some([rng.any(), rng.any()]);
                info.pitch = if rng.below(2) == 0 { None } else { Some([rng.any(), rng.any()]) };
                info.rate = rng.any();
                info.stiffness = rng.any();
            }
            let settings = match rng.below(3) {
                0 => Settings::default(),
                _ => {
                    let mut settings = Settings::default().with_weight(rng.any()).with_tolerance(rng.any());
                    settings.effector = rng.below(5);
                    settings.ascent.relax = Some(rng.any());
                    settings.ascent.halvings = (rng.bits() >> 32) as u32;
                    settings
                }
            };
            let pose = Pose::new(pose);
            let outcome = if rng.below(3) == 0 {
                rig.snap_with(&pose, target, &settings)
            } else {
                rig.aim_with(&pose, target, rng.any(), &settings)
            };
            let context = format!("case {case}: {target} {pose:?} {settings:?} {:?}", rig.infos);
            assert!(sound(&rig), "{context}: {:?}", rig.joints);
            assert!((-1.0..=1.0).contains(&outcome.aim), "{context}: {outcome:?}");
            assert!((0.0..=core::f32::consts::PI + 1e-6).contains(&outcome.remaining), "{context}: {outcome:?}");
            assert!(rig.joints.iter().all(|j| j.heading().is_finite() && j.pitch().is_finite()), "{context}");
        }
        rig.infos.clone_from(&declared);
        // Ranges may have been arbitrary: give the angles time to return.
        for _ in 0..1200 {
            let pose = Pose::new(upright(&rig));
            let settings = Settings::default().with_weight(0.0);
            if rig.aim_with(&pose, Vec3::ZERO, 0.1, &settings).recovering.is_empty() {
                break;
            }
        }
        still_works(&mut rig, &format!("case {case}"));
    }
}

#[test]
fn degenerate_inputs_are_reported_as_such() {
    let good = Vec3::new(-1.0, 1.8, -2.0);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for lane in 0..3 {
            let mut rig = NumericRig::thug();
            let pose = upright(&rig);
            rig.snap(&Pose::new(pose.clone()), good);
            let before = rig.joints.clone();
            let mut target = good;
            target[lane] = bad;
            let outcome = rig.aim(&Pose::new(pose.clone()), target, 1.0 / 60.0);
            assert_eq!((outcome.status, outcome.aim), (Status::Degenerate, 0.0));
            for joint in 0..3 {
                let mut pose = pose.clone();
                pose[joint].translation[lane] = bad;
                assert_eq!(rig.aim(&Pose::new(pose), good, 1.0 / 60.0).status, Status::Degenerate);
                let mut pose = upright(&rig);
                pose[joint].matrix3.y_axis[lane] = bad;
                assert_eq!(rig.snap(&Pose::new(pose), good).status, Status::Degenerate);
            }
            assert_eq!(rig.joints, before, "the angles hold");
            // An invalid eye does not matter if the head is aimed.
            let mut pose = pose.clone();
            pose[0].translation[lane] = bad;
            let settings = Settings::default().with_effector(1);
            assert_ne!(rig.aim_with(&Pose::new(pose), good, 0.016, &settings).status, Status::Degenerate);
        }
    }
    // Too few transforms, for a rig known only at run time.
    let mut rig = NumericRig::thug();
    let outcome = rig.aim(&Pose::new(vec![Affine3A::IDENTITY]), good, 1.0 / 60.0);
    assert_eq!(outcome.status, Status::Degenerate);
}

/// A target at 1e20 is an ordinary direction; rigs of that size and of its inverse are aimed, too.
#[test]
fn extreme_sizes_and_distances_are_aimed() {
    let mut rig = NumericRig::thug();
    let pose = upright(&rig);
    let outcome = rig.snap(&Pose::new(pose.clone()), Vec3::new(-0.5e20, 0.1e20, -1e20));
    assert_eq!(outcome.status, Status::Reached);
    let mut reference = NumericRig::thug();
    reference.snap(&Pose::new(pose.clone()), Vec3::new(-0.5e6, 0.1e6, -1e6));
    for (a, b) in rig.joints.iter().zip(&reference.joints) {
        assert!((a.heading() - b.heading()).abs() < 1e-3 && (a.pitch() - b.pitch()).abs() < 1e-3);
    }
    for scale in [1e-20, 1e-10, 1e10, 1e20] {
        let by = Affine3A::from_scale(Vec3::splat(scale));
        let mut rig = NumericRig::thug();
        let pose: Vec<Affine3A> = upright(&rig).iter().map(|joint| by * *joint).collect();
        let outcome = rig.snap(&Pose::new(pose), by.transform_point3(Vec3::new(-1.0, 1.8, -2.0)));
        assert_eq!(outcome.status, Status::Reached, "{scale}: {outcome:?}");
    }
}

#[test]
fn unusual_declarations_are_harmless() {
    let awkward = [[0.0; 3], [f32::NAN; 3], [1.0, 0.0, 0.0], [1e20, 0.0, 0.0], [1e-30, 1e-30, 0.0]];
    for forward in awkward {
        for up in awkward {
            let mut rig = NumericRig::thug();
            let pose = Pose::new(upright(&rig));
            rig.infos[0] = rig.infos[0].with_axes(Axes { forward, up, left: up });
            rig.effector = Effector { forward, origin: up };
            rig.joints[0] = Joint::from_angles(0.4, 0.3);
            for effector in 0..3 {
                let settings = Settings::default().with_effector(effector);
                let outcome = rig.aim_with(&pose, Vec3::new(-1.0, 1.8, -2.0), 1.0 / 60.0, &settings);
                assert!(outcome.remaining.is_finite(), "{forward:?} {up:?}");
                assert!(sound(&rig), "{forward:?} {up:?}: {:?}", rig.corrections().collect::<Vec<_>>());
            }
        }
    }
    assert_eq!(Joint::from_angles(f32::NAN, f32::INFINITY), Joint::default());
}

/// A rig without joints has nothing to aim and reports so.
#[test]
fn a_rig_without_joints_is_degenerate() {
    let mut rig = NumericRig::thug();
    rig.infos.clear();
    rig.joints.clear();
    assert_eq!(rig.aim(&Pose::new(Vec::new()), Vec3::X, 0.016).status, Status::Degenerate);
    assert_eq!(rig.snap(&Pose::new(Vec::new()), Vec3::X).status, Status::Degenerate);
    assert_eq!(rig.corrections().count(), 0);
}

/// Slices of wrong lengths: nothing is aimed, nothing moves, and nothing panics.
#[test]
fn slices_of_wrong_lengths_are_degenerate() {
    let (settings, point) = (Settings::default(), Vec3::new(0.3, 1.6, -2.0));
    let weighted = [Target::new(point, 0.7), Target::new(-point, 0.2)];
    for count in [1, 3] {
        let mut rig = NumericRig::thug();
        rig.infos.truncate(count);
        rig.joints.truncate(count);
        let pose = upright(&rig);
        for targets in [Targets::from(point), Targets::from(&weighted)] {
            for [joints, transforms, turns] in [[0, count, count], [count, count - 1, count], [count, count, count + 1]]
            {
                let mut state = State::new(vec![Joint::from_angles(0.1, 0.2); joints]);
                let mut corrections = vec![Quat::from_rotation_x(0.5); turns];
                let (before, unturned) = (state.clone(), corrections.clone());
                let call = Call { targets, dt: Some(0.016), settings: &settings };
                let pose = Pose::new(&pose[..transforms]);
                let outcome = (&rig as &dyn Rig).aim(&mut state, &pose, &call, &mut corrections);
                assert_eq!(outcome.status, Status::Degenerate, "{joints} {transforms} {turns}");
                assert!(state == before && corrections == unturned, "{joints} {transforms} {turns}");
            }
        }
    }
}

/// With only one bone mirrored and another stretched, the remaining angle still agrees with forward kinematics.
#[test]
fn mirrored_and_stretched_parents_inside_the_chain_are_aimed() {
    let mut rng = Rng(31);
    for case in 0..200 {
        let mut rig = NumericRig::thug();
        let mut pose = upright(&rig);
        let by = match case % 4 {
            0 => Vec3::new(-1.0, 1.0, 1.0),
            1 => Vec3::new(1.0, 1.0, 1.6),
            2 => Vec3::new(-1.3, 0.7, 1.0),
            _ => Vec3::splat(0.5),
        };
        let joint = rng.below(3);
        pose[joint] *= Affine3A::from_scale(by);
        let turn = Quat::from_rotation_y(rng.between(-40.0, 40.0) * DEG);
        let target = Vec3::new(0.0, 1.7, 0.0) + turn * Vec3::new(0.0, 0.1, -2.0);
        for _ in 0..240 {
            let outcome = rig.aim(&Pose::new(pose.clone()), target, 1.0 / 60.0);
            assert!((remaining64(&rig, &pose, 0, target) - f64::from(outcome.remaining)).abs() < 1e-5);
        }
        let outcome = rig.aim(&Pose::new(pose.clone()), target, 1.0 / 60.0);
        assert_eq!(outcome.status, Status::Reached, "case {case}, {by}, joint {joint}: {outcome:?}");
    }
}
