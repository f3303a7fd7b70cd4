//! Effectors other than joint 0's own forward at its own origin.

use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::{Axes, Effector, Joint, Pose, Settings, Status};

use super::*;

/// An effector beside the joint's axis, such as a barrel, is aimed by its own line.
#[test]
fn offset() {
    for (world, parent, _) in worlds() {
        for origin in [[0.0, 0.0, 0.0], [0.0, 0.707, 0.0], [0.5, 0.5, 0.0], [-0.5, 0.5, 0.0], [0.5, 0.0, 0.5]] {
            let rig = offset_ball(origin);
            let pose = moved(&parent, &alone());
            for target in [Vec3::new(2.0, 0.3, 0.0), Vec3::new(-1.0, 0.2, -1.0), Vec3::new(0.1, 1.0, -1.5)] {
                assert_reached(&rig, &pose, parent.transform_point3(target), &format!("{world}, {origin:?}, {target}"));
            }
        }
        // Nearer to the joint than the effector's line: out of reach, and reported as such.
        let rig = offset_ball([0.5, 0.0, 0.5]);
        let pose = moved(&parent, &alone());
        for (_, outcome, case) in
            solve_by_every_solver(&rig, &pose, parent.transform_point3(Vec3::new(0.1, 0.0, -0.1)), &world)
        {
            assert_eq!(outcome.status, Status::AtLimit, "{case}");
        }
    }
}

/// With the head as effector, its own forward is aimed from its own origin, and the eye returns to rest.
#[test]
fn head_as_effector() {
    // An eye with other axes than its head's, and an effector that need not be the eye's forward.
    let eye_axes = Axes { up: [0.0, 0.0, 1.0], forward: [1.0, 0.0, 0.0], left: [0.0, 1.0, 0.0] };
    for (world, parent, _) in worlds() {
        for (forward, solver) in
            [eye_axes.forward, [0.0, 0.6, 0.8], [0.0, 0.0, 1.0]].into_iter().flat_map(|v| SOLVERS.map(|s| (v, s)))
        {
            let settings = Settings::default().with_effector(1).with_solver(solver);
            let mut rig = person();
            rig.infos[0] = rig.infos[0].with_axes(eye_axes);
            rig.effector = Effector { forward, origin: [0.01, 0.02, 0.0] };
            rig.joints[0] = Joint::from_angles(0.5, -0.3);
            let pose = moved(&parent, &upright(&rig));
            let target = parent.transform_point3(Vec3::new(-1.0, 1.9, -2.0));
            let mut snapped = rig.clone();
            let outcome = snapped.snap_with(&Pose::new(pose.clone()), target, &settings);
            let case = format!("{world}, {solver:?}");
            assert_eq!(outcome.status, Status::Reached, "{case}");
            assert_true_outcome(&snapped, &pose, 1, target, &outcome, &case);
            assert_eq!((snapped.joints[0].heading(), snapped.joints[0].pitch()), (0.0, 0.0), "{case}");

            for frame in 0..120 {
                let before = rig.joints[0].heading();
                let outcome = rig.aim_with(&Pose::new(pose.clone()), target, DT, &settings);
                assert_true_outcome(&rig, &pose, 1, target, &outcome, &case);
                let moved = before - rig.joints[0].heading();
                assert!((0.0..450.0 * DEG / 60.0 + 1e-6).contains(&moved), "{case}, {frame}");
            }
            assert!(angle_to64(seen64(&rig, &pose, 1), target) < TOLERANCE_RAD, "{case}");
            assert_eq!((rig.joints[0].heading(), rig.joints[0].pitch()), (0.0, 0.0), "{case}");
        }
    }
}

/// An effector index beyond the chain selects the innermost joint.
#[test]
fn effector_past_the_chain() {
    for solver in SOLVERS {
        let mut rig = person();
        let pose = upright(&rig);
        let target = ahead(&rig, &pose, 2, 3.0) + Vec3::new(0.1, 0.1, 0.0);
        let settings = Settings::default().with_effector(99).with_solver(solver);
        let outcome = rig.snap_with(&Pose::new(pose.clone()), target, &settings);
        assert_eq!(outcome.status, Status::Reached);
        assert!(angle_to64(seen64(&rig, &pose, 2), target) < TOLERANCE_RAD);
    }
}

/// Every pair of signed axes as forward and up, right-handed and left-handed: the same gaze by the same angles.
#[test]
fn forward_up_pairs() {
    for solver in SOLVERS {
        let settings = Settings::default().with_solver(solver);
        for target in [Vec3::new(-1.5, 1.9, -1.0), Vec3::new(1.0, 1.5, -2.0), Vec3::new(-0.5, 1.6, -0.4)] {
            let aimed = |axes: Axes| {
                let mut rig = person();
                for info in &mut rig.infos {
                    *info = info.with_axes(axes);
                }
                rig.effector.forward = axes.forward;
                let pose = upright(&rig);
                let mut snapped = rig.clone();
                let outcome = snapped.snap_with(&Pose::new(pose.clone()), target, &settings);
                assert_eq!(outcome.status, Status::Reached, "{solver:?}, {axes:?}");
                for _ in 0..180 {
                    let outcome = rig.aim_with(&Pose::new(pose.clone()), target, DT, &settings);
                    assert_true_outcome(&rig, &pose, 0, target, &outcome, "a pair of axes");
                }
                (snapped, rig)
            };
            let (snapped, stepped) = aimed(THUG);
            for (axes, _) in triples() {
                let (other_snapped, other_stepped) = aimed(axes);
                for (a, b) in [(&snapped, &other_snapped), (&stepped, &other_stepped)] {
                    for (a, b) in a.joints.iter().zip(&b.joints) {
                        let apart = (a.heading() - b.heading()).abs().max((a.pitch() - b.pitch()).abs());
                        assert!(apart < 5e-3, "{solver:?}, {axes:?}: {a:?} {b:?}");
                    }
                }
            }
        }
    }
}

/// With an effector on a joint anywhere in the world.
#[test]
fn translated_joint() {
    for at in [Vec3::new(0.5, 0.0, 0.0), Vec3::new(-7.0, 30.0, 2.0)] {
        let rig = offset_ball([0.2, 0.1, 0.05]);
        let pose = [bone(&THUG, Quat::from_rotation_z(0.3), at)];
        assert_reached(&rig, &pose, at + Vec3::new(2.0, 0.5, -1.0), &format!("{at}"));
    }
}
