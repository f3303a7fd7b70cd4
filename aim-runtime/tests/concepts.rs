//! Aiming concept by concept, under identity, translated, rotated, scaled, non-uniform and mirrored parents, for rigs
//! of a hundredth to a hundred times their size. Judged by an independent forward kinematics in f64.
#![allow(clippy::cast_possible_truncation, reason = "frames are counted and f64 is rounded to f32 on purpose")]

mod common;

use aim_runtime::glam::{Affine3A, Quat, Vec3, Vec3A};
use aim_runtime::{AimRig, Axes, Effector, Joint, Outcome, Pose, Settings, Status};
use common::*;

const TOLERANCE_RAD: f64 = 0.1 * core::f64::consts::PI / 180.0;
const SCALES: [f32; 3] = [0.01, 1.0, 100.0];

/// Every parent at every scale: a name, the transform and whether it keeps shapes.
fn worlds() -> impl Iterator<Item = (String, Affine3A, bool)> {
    parents().into_iter().flat_map(|(name, parent, similar)| {
        SCALES
            .into_iter()
            .map(move |scale| (format!("{name} × {scale}"), Affine3A::from_scale(Vec3::splat(scale)) * parent, similar))
    })
}

fn moved(parent: &Affine3A, pose: &[Affine3A]) -> Vec<Affine3A> {
    pose.iter().map(|joint| *parent * *joint).collect()
}

/// Aims for some seconds, as a game would.
fn aim_for(rig: &mut NumericRig, pose: &[Affine3A], target: Vec3, seconds: f32) -> Outcome {
    let pose = Pose { joints: pose.to_vec() };
    let mut outcome = rig.aim(&pose, target, 1.0 / 60.0);
    for _ in 1..(seconds * 60.0) as usize {
        outcome = rig.aim(&pose, target, 1.0 / 60.0);
    }
    outcome
}

/// Both ways of aiming: at once, and frame by frame.
fn both(rig: &NumericRig, pose: &[Affine3A], target: Vec3, case: &str) -> [(NumericRig, Outcome); 2] {
    let (mut snapped, mut stepped) = (rig.clone(), rig.clone());
    let snap = snapped.snap(&Pose { joints: pose.to_vec() }, target);
    let step = aim_for(&mut stepped, pose, target, 4.0);
    for (rig, outcome) in [(&snapped, snap), (&stepped, step)] {
        assert!(sound(rig), "{case}");
        if outcome.status == Status::Degenerate {
            continue;
        }
        let left = remaining64(rig, pose, 0, target);
        assert!((left - f64::from(outcome.remaining)).abs() < 2e-5, "{case}: {left} but {outcome:?}");
        assert_eq!(outcome.status == Status::Reached, outcome.remaining <= TOLERANCE_RAD as f32, "{case}");
        assert!((outcome.aim - outcome.remaining.cos()).abs() < 1e-6, "{case}");
    }
    [(snapped, snap), (stepped, step)]
}

fn reached(rig: &NumericRig, pose: &[Affine3A], target: Vec3, case: &str) {
    for ((_, outcome), how) in both(rig, pose, target, case).into_iter().zip(["snap", "frames"]) {
        assert_eq!(outcome.status, Status::Reached, "{case}, {how}: {outcome:?}");
    }
}

#[test]
fn correction() {
    let right = Vec3::X;
    let targets = [right, -right, Vec3::Z, Vec3::NEG_Z, Vec3::new(1.0, 1.0, 0.0), Vec3::new(2.0, 2.0, 0.0)];
    for (world, parent, _) in worlds() {
        for (rig, name) in [(NumericRig::ball(THUG), "ball"), (offset_ball([0.02, 0.05, -0.01]), "offset")] {
            let pose = moved(&parent, &[bone(&THUG, Quat::IDENTITY, Vec3::new(0.1, 1.6, 0.2))]);
            for target in targets {
                let case = format!("{name}, {world}, {target}");
                reached(&rig, &pose, parent.transform_point3(target + Vec3::new(0.1, 1.6, 0.2)), &case);
            }
        }
    }
}

#[test]
fn correction_of_a_chain() {
    let mut rng = Rng(7);
    for (world, parent, similar) in worlds() {
        for case in 0..20 {
            let rig = NumericRig::thug();
            let pose = animated(&rig, &mut rng, 0.2);
            let heading = rng.between(-50.0, 50.0) * DEG;
            let pitch = rng.between(-30.0, 20.0) * DEG;
            let turn = Quat::from_rotation_y(heading) * Quat::from_rotation_x(pitch);
            let eye = Vec3::from(pose[0].translation);
            let target = eye + turn * (WORLD[0] * rng.between(0.5, 10.0));
            // A stretched world stretches the angles too: keep to what stays well within the ranges.
            let target = if similar { target } else { eye + (target - eye) * Vec3::new(0.5, 0.2, 1.0) };
            let pose = moved(&parent, &pose);
            reached(&rig, &pose, parent.transform_point3(target), &format!("{world}, case {case}"));
        }
    }
}

/// The sense of the angles: left is positive heading, up is positive pitch, whatever the parent does.
#[test]
fn sense_of_the_angles() {
    for (world, parent, _) in worlds() {
        let rig = NumericRig::ball(THUG);
        let pose = moved(&parent, &[bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]);
        for (target, heading, pitch) in [
            (WORLD[0] + WORLD[2], 1.0, 0.0),
            (WORLD[0] - WORLD[2], -1.0, 0.0),
            (WORLD[0] + WORLD[1], 0.0, 1.0),
            (WORLD[0] - WORLD[1], 0.0, -1.0),
        ] {
            for (rig, _) in both(&rig, &pose, parent.transform_point3(target), &world) {
                let joint = rig.joints[0];
                for (angle, sense) in [(joint.heading(), heading), (joint.pitch(), pitch)] {
                    assert!((angle - sense * 45.0 * DEG).abs() < 0.2 * DEG, "{world}, {target}: {joint:?}");
                }
            }
        }
    }
}

/// The effector's direction may be any of the bone's.
#[test]
fn forward() {
    for (world, parent, _) in worlds() {
        for forward in [Vec3::Y, -Vec3::Y, Vec3::Z, Vec3::X, Vec3::new(0.6, 0.0, 0.8)] {
            let mut rig = NumericRig::ball(THUG);
            rig.effector.forward = forward.to_array();
            let pose = moved(&parent, &[bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]);
            // From an effector along the bone's up, heading alone is a roll: look where pitch gets it.
            let (_, gaze) = gaze64(&rig, &[bone(&THUG, Quat::IDENTITY, Vec3::ZERO)], 0);
            let gaze = Vec3::from(gaze.map(|x| x as f32));
            let target = Quat::from_axis_angle(WORLD[2], 20.0 * DEG) * gaze * 3.0;
            reached(&rig, &pose, parent.transform_point3(target), &format!("{world}, {forward}"));
        }
    }
}

/// Nothing rolls: the ends of heading and pitch are the same from every order of arriving, and an eye turned to a
/// target at its own height keeps its up.
#[test]
fn up() {
    for (world, parent, similar) in worlds() {
        let rig = NumericRig::ball(THUG);
        let pose = moved(&parent, &[bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]);
        for heading in [-150.0, -90.0, -30.0, 10.0, 60.0, 120.0] {
            let target = Quat::from_rotation_y(heading * DEG) * WORLD[0];
            for (rig, _) in both(&rig, &pose, parent.transform_point3(target), &world) {
                let up = Vec3::from(THUG.up);
                let (_, q) = rig.corrections().next().unwrap();
                assert!((q * up - up).length() < 4e-3, "{world}, {heading}: {}", q * up);
                if similar {
                    assert!((rig.joints[0].heading() - heading * DEG).abs() < 2e-3, "{world}, {heading}");
                }
            }
        }
    }
}

fn offset_ball(origin: [f32; 3]) -> NumericRig {
    let mut rig = NumericRig::ball(THUG);
    rig.effector.origin = origin;
    rig
}

/// An effector beside the joint's axis, a barrel say: aimed by its own line, not the joint's.
#[test]
fn offset() {
    for (world, parent, _) in worlds() {
        for origin in [[0.0, 0.0, 0.0], [0.0, 0.707, 0.0], [0.5, 0.5, 0.0], [-0.5, 0.5, 0.0], [0.5, 0.0, 0.5]] {
            let rig = offset_ball(origin);
            let pose = moved(&parent, &[bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]);
            for target in [Vec3::new(2.0, 0.3, 0.0), Vec3::new(-1.0, 0.2, -1.0), Vec3::new(0.1, 1.0, -1.5)] {
                reached(&rig, &pose, parent.transform_point3(target), &format!("{world}, {origin:?}, {target}"));
            }
        }
        // Nearer than the line ever passes: out of reach, and said so.
        let rig = offset_ball([0.5, 0.0, 0.5]);
        let pose = moved(&parent, &[bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]);
        for (_, outcome) in both(&rig, &pose, parent.transform_point3(Vec3::new(0.1, 0.0, -0.1)), &world) {
            assert_eq!(outcome.status, Status::AtLimit, "{world}");
        }
    }
}

/// Already aimed at: nothing moves, exactly.
#[test]
fn aligned_target() {
    for (world, parent, _) in worlds() {
        let rig = NumericRig::thug();
        let pose = moved(&parent, &upright(&rig));
        for distance in [0.1, 1.0, 2.0, 50.0] {
            let target = upright(&rig)[0].translation + Vec3A::from(WORLD[0]) * distance;
            for (rig, outcome) in both(&rig, &pose, parent.transform_point3(target.into()), &world) {
                assert_eq!(outcome.status, Status::Reached, "{world}, {distance}");
                assert!(rig.joints.iter().all(|joint| joint.heading().abs() < 1e-4), "{world}: {:?}", rig.joints);
            }
        }
        // Above and behind its own up axis, still finite and true.
        for target in [Vec3::Y * 2.0, Vec3::Y * -2.0, Vec3::Z * 3.0] {
            both(&rig, &pose, parent.transform_point3(target), &world);
        }
    }
}

/// On the effector there is no direction; a thousandth of the rig beside it there is, at every scale.
#[test]
fn target_too_close() {
    for (world, parent, similar) in worlds() {
        let mut rig = NumericRig::thug();
        rig.joints = vec![Joint::with_angles(0.1, -0.1), Joint::with_angles(0.2, 0.1), Joint::default()];
        let before = rig.joints.clone();
        let pose = moved(&parent, &upright(&rig));
        let on_effector = Vec3::from(gaze64(&rig, &pose, 0).0.map(|x| x as f32));
        let outcome = rig.aim(&Pose { joints: pose.clone() }, on_effector, 1.0 / 60.0);
        assert_eq!((outcome.status, outcome.aim), (Status::Degenerate, 0.0), "{world}");
        assert_eq!(rig.joints, before, "{world}: the angles hold");

        // The single eye turns about its own origin, so the nearness changes nothing else. The world is
        // far away in one case, and f32 then has nothing finer to say.
        if similar && !world.starts_with("translated") {
            let mut eye = NumericRig::ball(THUG);
            let pose = moved(&parent, &[bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]);
            let near = parent.transform_point3(Vec3::new(-1e-3, 0.0, -1e-3));
            let outcome = eye.snap(&Pose { joints: pose }, near);
            assert_eq!(outcome.status, Status::Reached, "{world}");
            assert!((eye.joints[0].heading() - 45.0 * DEG).abs() < 1e-3, "{world}");
        }
    }
}

#[test]
fn weight() {
    for (world, parent, similar) in worlds() {
        let pose = moved(&parent, &[bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]);
        for (target, full) in [(Vec3::new(-1.0, 0.0, 0.0), 90.0), (WORLD[0] - WORLD[2], -45.0)] {
            for (weight, part) in
                [(1.0, 1.0), (2.0, 1.0), (0.5, 0.5), (0.25, 0.25), (0.0, 0.0), (-0.5, 0.0), (f32::NAN, 0.0)]
            {
                let mut rig = NumericRig::ball(THUG);
                let settings = Settings::default().with_weight(weight);
                let outcome = rig.snap_with(&Pose { joints: pose.clone() }, parent.transform_point3(target), &settings);
                assert_eq!(outcome.status, Status::Reached, "{world}, {weight}");
                assert!(sound(&rig));
                let heading = rig.joints[0].heading();
                if similar {
                    assert!((heading - part * full * DEG).abs() < 1e-4, "{world}, {weight}: {heading}");
                }
                if part == 0.0 {
                    assert_eq!(rig.joints[0], Joint::default(), "{world}, {weight}");
                }
            }
        }
    }
}

#[test]
fn zero_scale() {
    for flat in [Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0), Vec3::new(0.0, 0.0, 1.0)] {
        for squashed in 0..3 {
            let mut rig = NumericRig::thug();
            let mut pose = upright(&rig);
            pose[squashed] *= Affine3A::from_scale(flat);
            let outcome = rig.aim(&Pose { joints: pose }, Vec3::new(1.0, 1.0, -1.0), 1.0 / 60.0);
            assert_eq!(outcome.status, Status::Degenerate);
            assert!(rig.corrections().all(|(_, q)| q == Quat::IDENTITY));
        }
    }
}

/// The head instead of the eye: its own forward is aimed from its own origin, and the eye goes back to rest.
#[test]
fn head_as_effector() {
    // An eye with other axes than its head's, and an effector that is not even its forward.
    let eye_axes = Axes { up: [0.0, 0.0, 1.0], forward: [1.0, 0.0, 0.0], left: [0.0, 1.0, 0.0] };
    let settings = Settings::default().with_effector(1);
    for (world, parent, _) in worlds() {
        for forward in [eye_axes.forward, [0.0, 0.6, 0.8], [0.0, 0.0, 1.0]] {
            let mut rig = NumericRig::thug();
            rig.infos[0] = rig.infos[0].with_axes(eye_axes);
            rig.effector = Effector { forward, origin: [0.01, 0.02, 0.0] };
            rig.joints[0] = Joint::with_angles(0.5, -0.3);
            let pose = moved(&parent, &upright(&rig));
            let target = parent.transform_point3(Vec3::new(-1.0, 1.9, -2.0));
            let mut snapped = rig.clone();
            let outcome = snapped.snap_with(&Pose { joints: pose.clone() }, target, &settings);
            assert_eq!(outcome.status, Status::Reached, "{world}");
            assert!(remaining64(&snapped, &pose, 1, target) < TOLERANCE_RAD, "{world}");
            assert_eq!(snapped.joints[0], Joint::default(), "{world}");

            for frame in 0..120 {
                let before = rig.joints[0].heading();
                let outcome = rig.aim_with(&Pose { joints: pose.clone() }, target, 1.0 / 60.0, &settings);
                let left = remaining64(&rig, &pose, 1, target);
                assert!((left - f64::from(outcome.remaining)).abs() < 2e-5, "{world}");
                let moved = before - rig.joints[0].heading();
                assert!((0.0..450.0 * DEG / 60.0 + 1e-6).contains(&moved), "{world}, {frame}");
            }
            assert!(remaining64(&rig, &pose, 1, target) < TOLERANCE_RAD, "{world}");
            assert_eq!((rig.joints[0].heading(), rig.joints[0].pitch()), (0.0, 0.0), "{world}");
        }
    }
}

/// An index past the chain aims the innermost joint.
#[test]
fn effector_past_the_chain() {
    let mut rig = NumericRig::thug();
    let pose = upright(&rig);
    let target = ahead(&rig, &pose, 2, 3.0) + Vec3::new(0.1, 0.1, 0.0);
    let outcome = rig.snap_with(&Pose { joints: pose.clone() }, target, &Settings::default().with_effector(99));
    assert_eq!(outcome.status, Status::Reached);
    assert!(remaining64(&rig, &pose, 2, target) < TOLERANCE_RAD);
}
