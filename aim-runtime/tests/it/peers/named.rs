//! Problems reported by users of other solvers, as far as they apply to this one.

use crate::common::truth::seen_pair64;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Axes, Behind, Pose, Settings, Status};

use super::*;

/// A parent turned by a quarter about any axis changes nothing (godot#104216).
#[test]
fn parent_turned_by_a_quarter() {
    for axis in [Vec3::X, Vec3::Y, Vec3::Z] {
        for quarters in 1..4_u8 {
            let parent = Affine3A::from_axis_angle(axis, f32::from(quarters) * 90.0 * DEG);
            let rig = person();
            let target = Vec3::new(-1.0, 1.9, -1.5);
            let straight = solve_by_every_solver(&rig, &upright(&rig), target, "straight");
            let turned =
                solve_by_every_solver(&rig, &moved(&parent, &upright(&rig)), parent.transform_point3(target), "turned");
            for ((a, reached, _), (b, outcome, case)) in straight.into_iter().zip(turned) {
                assert_eq!((reached.status, outcome.status), (Status::Reached, Status::Reached), "{case}");
                for (a, b) in a.joints.iter().zip(&b.joints) {
                    let apart = (a.heading() - b.heading()).abs().max((a.pitch() - b.pitch()).abs());
                    assert!(apart < 2e-3, "{case}, {axis}, {quarters}: {a:?} {b:?}");
                }
            }
        }
    }
}

/// Bones with different orientations at rest, each with axes of its own (godot#115584, UniVRM#2159).
#[test]
fn neck_rest_other_than_head_rest() {
    let conventions = triples();
    for (number, (axes, _)) in conventions.iter().enumerate() {
        let mut rig = person();
        let others = [number, (7 * number + 11) % 48, (13 * number + 5) % 48].map(|k| conventions[k].0);
        for (info, axes) in rig.infos.iter_mut().zip(others) {
            *info = info.with_axes(axes);
        }
        rig.effector.forward = others[0].forward;
        let target = Vec3::new(-1.2, 1.8, -1.4);
        let expected = solve_by_every_solver(&person(), &upright(&person()), target, "one convention");
        let found = solve_by_every_solver(&rig, &upright(&rig), target, &format!("{axes:?}"));
        for ((a, ..), (b, outcome, case)) in expected.into_iter().zip(found) {
            assert_eq!(outcome.status, Status::Reached, "{case}");
            for (a, b) in a.joints.iter().zip(&b.joints) {
                let apart = (a.heading() - b.heading()).abs().max((a.pitch() - b.pitch()).abs());
                assert!(apart < 5e-3, "{case}: {a:?} {b:?}");
            }
        }
    }
}

/// Any initial heading of the character (UniVRM#2801).
#[test]
fn facing_anywhere() {
    for heading in 0..12_u8 {
        let parent = Affine3A::from_rotation_y(f32::from(heading) * 30.0 * DEG);
        let rig = person();
        let pose = moved(&parent, &upright(&rig));
        for target in [Vec3::new(-1.0, 1.9, -1.5), Vec3::new(1.0, 1.3, -1.5)] {
            assert_reached(&rig, &pose, parent.transform_point3(target), &format!("{heading}"));
        }
    }
}

/// A target behind at partial influence: no flip, and the gaze stays on its side (godot PR#99619).
#[test]
fn influence_below_one_behind() {
    for solver in SOLVERS {
        for behind in [Behind::Off, Behind::Clip] {
            for side in [1.0, -1.0] {
                let mut rig = person();
                let pose = upright(&rig);
                let settings = Settings::default().with_solver(solver).with_behind(behind).with_weight(0.5);
                let mut rng = Rng(3);
                for frame in 0..400 {
                    let heading = if frame < 200 { 0.85 * frame as f32 } else { 180.0 + rng.between(-8.0, 8.0) };
                    let turn = Quat::from_rotation_y(side * heading * DEG);
                    let target = Vec3::new(-0.03, 1.68, -0.1) + turn * WORLD[0] * 2.0;
                    let before = rig.joints.clone();
                    rig.aim_with(&Pose::new(pose.clone()), target, DT, &settings);
                    assert_within_limits(&rig, &before, DT, "behind");
                    let aside = seen64(&rig, &pose, 0).1[0] * f64::from(-side);
                    assert!(frame < 100 || aside > 0.5, "{solver:?}, {behind:?}, {frame}: {aside}");
                }
            }
        }
    }
}

/// Eyes whose bones are turned by +90° and −90° about up at rest, on a head that is turned at rest (three-vrm#1096).
#[test]
fn eyes_of_different_rests() {
    let quarter = |axes: &Axes, by: f32| {
        let turn = Quat::from_axis_angle(axes.up.into(), by * DEG);
        let [up, forward, left] = [axes.up, axes.forward, axes.left].map(|v| (turn * Vec3::from(v)).to_array());
        Axes { up, forward, left }
    };
    let head = Affine3A::from_rotation_y(35.0 * DEG);
    for solver in SOLVERS {
        for (own, other) in [(90.0, -90.0), (-90.0, 90.0), (0.0, 180.0)] {
            let mut rig = person();
            rig.infos[0] = rig.infos[0].with_axes(quarter(&THUG, own));
            rig.effector.forward = rig.infos[0].axes().forward;
            let pose = moved(&head, &upright(&rig));
            let pair = head * bone(&quarter(&THUG, other), Quat::IDENTITY, Vec3::new(0.03, 1.68, -0.1));
            let settings = Settings::default().with_solver(solver);
            for target in [Vec3::new(-0.2, 1.7, -0.5), Vec3::new(0.6, 1.8, -1.5)] {
                let target = head.transform_point3(target);
                let mut rig = rig.clone();
                let outcome = rig.snap_with(&Pose::new(pose.clone()).with_other_eye(pair), target, &settings);
                assert_eq!(outcome.status, Status::Reached, "{solver:?}, {own}");
                assert_true_outcome(&rig, &pose, 0, target, &outcome, "an eye");
                assert!(angle_to64(seen_pair64(&rig, &pose, &pair), target) < TOLERANCE_RAD, "{solver:?}, {own}");
            }
        }
    }
}
