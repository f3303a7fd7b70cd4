//! Test cases of ozz-animation's aim job, under the same names.

use aim_runtime::glam::{Affine3A, Quat, Vec3, Vec3A};
use aim_runtime::{Effector, Joint, Pose, Settings, Status};

use super::*;

/// ozz's job is invalid if a joint or an output is missing or if forward is not unit. Here, too few joints are a
/// degenerate call, outputs cannot be missing, and a declared forward is checked at compile time. For a rig known only
/// at run time, a forward of another length still aims.
#[test]
fn job_validity() {
    let target = Vec3::new(-1.0, 1.9, -2.0);
    for solver in SOLVERS {
        let settings = Settings::default().with_solver(solver);
        let mut rig = person();
        let pose = upright(&rig);
        for joints in [vec![], pose[..1].to_vec(), pose[..2].to_vec()] {
            let outcome = rig.aim_with(&Pose::new(joints), target, DT, &settings);
            assert_eq!(outcome.status, Status::Degenerate);
            assert_eq!(rig.joints, vec![Joint::default(); 3]);
        }
        rig.infos.clear();
        rig.joints.clear();
        assert_eq!(rig.aim_with(&Pose::new(vec![]), target, DT, &settings).status, Status::Degenerate);

        for length in [1.0, 0.5, 3.0] {
            let mut rig = person();
            rig.effector.forward = (length * Vec3::from(THUG.forward)).to_array();
            let outcome = rig.snap_with(&Pose::new(pose.clone()), target, &settings);
            assert!(length != 1.0 || outcome.status == Status::Reached, "{solver:?}, {length}: {outcome:?}");
            assert_true_outcome(&rig, &pose, 0, target, &outcome, "a forward of another length");
        }
        let mut rig = person();
        rig.effector.forward = [0.0; 3];
        let outcome = rig.aim_with(&Pose::new(pose), target, DT, &settings);
        assert!(outcome.status == Status::Degenerate && sound(&rig));
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
                assert_reached(&rig, &pose, parent.transform_point3(target + Vec3::new(0.1, 1.6, 0.2)), &case);
            }
        }
    }
}

/// Chains of several joints, for which ozz has a sample but no test.
#[test]
fn correction_of_a_chain() {
    let mut rng = Rng(7);
    for (world, parent, similar) in worlds() {
        for case in 0..10 {
            let rig = person();
            let pose = animated(&rig, &mut rng, 0.2);
            let heading = rng.between(-50.0, 50.0) * DEG;
            let pitch = rng.between(-30.0, 20.0) * DEG;
            let turn = Quat::from_rotation_y(heading) * Quat::from_rotation_x(pitch);
            let eye = Vec3::from(pose[0].translation);
            let target = eye + turn * (WORLD[0] * rng.between(0.5, 10.0));
            // A stretched world stretches angles, too: keep to targets well within the ranges.
            let target = if similar { target } else { eye + (target - eye) * Vec3::new(0.5, 0.2, 1.0) };
            let pose = moved(&parent, &pose);
            assert_reached(&rig, &pose, parent.transform_point3(target), &format!("{world}, case {case}"));
        }
    }
}

/// Signs of the angles: positive heading is left, positive pitch is up, under every parent.
#[test]
fn sense_of_the_angles() {
    for (world, parent, _) in worlds() {
        let rig = NumericRig::ball(THUG);
        let pose = moved(&parent, &alone());
        for (target, heading, pitch) in [
            (WORLD[0] + WORLD[2], 1.0, 0.0),
            (WORLD[0] - WORLD[2], -1.0, 0.0),
            (WORLD[0] + WORLD[1], 0.0, 1.0),
            (WORLD[0] - WORLD[1], 0.0, -1.0),
        ] {
            for (rig, _, case) in solve_by_every_solver(&rig, &pose, parent.transform_point3(target), &world) {
                let joint = rig.joints[0];
                for (angle, sense) in [(joint.heading(), heading), (joint.pitch(), pitch)] {
                    assert!((angle - sense * 45.0 * DEG).abs() < 0.2 * DEG, "{case}, {target}: {joint:?}");
                }
            }
        }
    }
}

/// The effector's direction may be any direction of the bone.
#[test]
fn forward() {
    for (world, parent, _) in worlds() {
        for forward in [Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z, Vec3::X, -Vec3::X, Vec3::new(0.6, 0.0, 0.8)] {
            let mut rig = NumericRig::ball(THUG);
            rig.effector.forward = forward.to_array();
            // If the effector is along the bone's up, heading alone is a roll: choose a target that pitch reaches.
            let gaze = Vec3::from(animated64(&rig, &alone(), 0).1.map(|x| x as f32));
            let target = Quat::from_axis_angle(WORLD[2], 20.0 * DEG) * gaze * 3.0;
            let pose = moved(&parent, &alone());
            assert_reached(&rig, &pose, parent.transform_point3(target), &format!("{world}, {forward}"));
        }
    }
}

/// ozz's up is a bone vector that is kept towards the pole. Here it is declared with the bone's axes and kept by
/// avoiding roll: an eye turned to a target at its own height keeps its up, whatever the path.
#[test]
fn up() {
    for (world, parent, similar) in worlds() {
        let rig = NumericRig::ball(THUG);
        let pose = moved(&parent, &alone());
        for heading in [-150.0, -90.0, -30.0, 10.0, 60.0, 120.0] {
            let target = Quat::from_rotation_y(heading * DEG) * WORLD[0];
            for (rig, _, case) in solve_by_every_solver(&rig, &pose, parent.transform_point3(target), &world) {
                let up = Vec3::from(THUG.up);
                let (_, q) = rig.corrections().next().unwrap();
                assert!((q * up - up).length() < 4e-3, "{case}, {heading}: {}", q * up);
                if similar {
                    assert!((rig.joints[0].heading() - heading * DEG).abs() < 2e-3, "{case}, {heading}");
                }
            }
        }
    }
}

/// Returns a head that leans forward by 30°, with this `upright` setting, and its pose.
fn leaning(level: f32) -> (NumericRig, Vec<Affine3A>) {
    let mut rig = NumericRig::ball(THUG);
    rig.infos[0] = rig.infos[0].with_upright(level);
    (rig, vec![bone(&THUG, Quat::from_rotation_x(-30.0 * DEG), Vec3::ZERO)])
}

/// Returns the angle of the bone's left above the horizon, degrees.
fn roll_deg(rig: &NumericRig, pose: &[Affine3A], parent: &Affine3A) -> f32 {
    let (_, q) = rig.corrections().next().unwrap();
    let left = parent.inverse().transform_vector3(pose[0].transform_vector3(q * Vec3::from(THUG.left)));
    left.normalize().dot(Vec3::Y).asin() / DEG
}

/// ozz's pole is the direction that the up vector is turned towards. Here it is the pose's up, about which upright
/// headings turn. Its length does not matter; without a usable one, the bone's own up is used.
#[test]
fn pole() {
    for (world, parent, similar) in worlds() {
        for solver in [Solver::Exact, Solver::Natural] {
            let settings = Settings::default().with_solver(solver);
            let target = parent.transform_point3(Quat::from_rotation_y(60.0 * DEG) * WORLD[0] * 4.0);
            let up = parent.transform_vector3(Vec3::Y);
            let aimed = |pole: Option<Vec3>| {
                let (mut rig, pose) = leaning(1.0);
                let pose = moved(&parent, &pose);
                let joints = Pose::new(pose.clone());
                let outcome = match pole {
                    Some(pole) => rig.snap_with(&joints.with_up(pole), target, &settings),
                    None => rig.snap_with(&joints, target, &settings),
                };
                assert_eq!(outcome.status, Status::Reached, "{world}, {pole:?}");
                assert_true_outcome(&rig, &pose, 0, target, &outcome, &format!("{world}, {pole:?}"));
                (roll_deg(&rig, &pose, &parent), rig.corrections().next().unwrap().1)
            };
            let (level, reference) = aimed(Some(up));
            assert!(!similar || level.abs() < 0.1, "{world}, {solver:?}: {level}");
            for length in [2.0, 1e-9, 1e9, 1e-20] {
                let (_, turn) = aimed(Some(length * up));
                assert!(turn.angle_between(reference) < 2e-3, "{world}, {length}: {turn} for {reference}");
            }
            // Without a pole, or with one that has no direction, headings turn about the bone's own up.
            let (_, own) = aimed(None);
            for pole in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY] {
                assert_eq!(aimed(Some(pole)).1, own, "{world}, {pole}");
            }
            // For an up that is upside down, the shortest tilt is undefined, so the bone is not tilted.
            assert!(aimed(Some(-up)).1.angle_between(own) < 2e-3, "{world}");
            // For an up to the side, the result is still aimed and finite.
            aimed(Some(parent.transform_vector3(Vec3::Z)));
            aimed(Some(parent.transform_vector3(Vec3::X)));
        }
    }
}

/// ozz's twist is an explicit roll about the aimed direction. Here a roll results from turning about a leaning bone's
/// own up, and `upright` removes it.
#[test]
fn twist() {
    for (world, parent, similar) in worlds() {
        for solver in [Solver::Exact, Solver::Natural] {
            let mut last = f32::INFINITY;
            for level in [0.0, 0.25, 0.5, 0.75, 1.0] {
                let (mut rig, pose) = leaning(level);
                let pose = moved(&parent, &pose);
                let target = parent.transform_point3(Quat::from_rotation_y(60.0 * DEG) * WORLD[0] * 4.0);
                let posed = Pose::new(pose.clone()).with_up(parent.transform_vector3(Vec3::Y));
                let outcome = rig.snap_with(&posed, target, &Settings::default().with_solver(solver));
                let case = format!("{world}, {solver:?}, {level}");
                assert_eq!(outcome.status, Status::Reached, "{case}");
                assert_true_outcome(&rig, &pose, 0, target, &outcome, &case);
                let roll = roll_deg(&rig, &pose, &parent).abs();
                if similar {
                    assert!(roll < last, "{case}: {roll} after {last}");
                    assert!(level < 1.0 || roll < 0.1, "{case}: {roll}");
                    assert!(level > 0.0 || roll > 20.0, "{case}: {roll}");
                    last = roll;
                }
            }
        }
    }
}

/// A target already aimed at: nothing moves.
#[test]
fn aligned_target() {
    for (world, parent, _) in worlds() {
        let rig = person();
        let pose = moved(&parent, &upright(&rig));
        for distance in [0.1, 1.0, 2.0, 50.0] {
            let target = upright(&rig)[0].translation + Vec3A::from(WORLD[0]) * distance;
            for (rig, outcome, case) in
                solve_by_every_solver(&rig, &pose, parent.transform_point3(target.into()), &world)
            {
                assert_eq!(outcome.status, Status::Reached, "{case}, {distance}");
                assert!(rig.joints.iter().all(|joint| joint.heading().abs() < 1e-4), "{case}: {:?}", rig.joints);
            }
        }
    }
}

/// A target along the effector's up, where heading has no effect: finite, reported correctly, as near as pitch gets.
#[test]
fn aligned_target_up() {
    for (world, parent, similar) in worlds() {
        for &above in if world.ends_with("× 1") { &[1.0, 2.0, -2.0][..] } else { &[1.0] } {
            let pose = moved(&parent, &alone());
            let target = parent.transform_point3(Vec3::Y * above);
            for (rig, outcome, case) in solve_by_every_solver(&NumericRig::ball(THUG), &pose, target, &world) {
                assert_eq!(outcome.status, Status::AtLimit, "{case}, {above}");
                if similar {
                    assert!((outcome.remaining - DEG).abs() < 1e-3, "{case}, {above}: {outcome:?}");
                }
                assert!(rig.joints[0].pitch() * above > 0.0, "{case}, {above}");
            }
        }
        if !["identity × 1", "non-uniformly scaled × 1"].contains(&world.as_str()) {
            continue;
        }
        let rig = person();
        let pose = moved(&parent, &upright(&rig));
        let eye = Vec3::from(upright(&rig)[0].translation);
        for target in [eye + Vec3::Y * 2.0, eye - Vec3::Y * 2.0, eye + Vec3::Z * 3.0] {
            solve_by_every_solver(&rig, &pose, parent.transform_point3(target), &world);
        }
    }
}

/// A target along the pole, above a leaning head: upright headings turn about the direction of the target itself.
#[test]
fn aligned_target_pole() {
    for (world, parent, similar) in worlds() {
        for (solver, above) in [(Solver::Exact, 2.0), (Solver::Natural, 2.0), (Solver::Exact, -2.0)] {
            let (mut rig, pose) = leaning(1.0);
            let pose = moved(&parent, &pose);
            let target = parent.transform_point3(Vec3::Y * above);
            let posed = Pose::new(pose.clone()).with_up(parent.transform_vector3(Vec3::Y));
            let settings = Settings::default().with_solver(solver);
            for _ in 0..120 {
                let before = rig.joints.clone();
                let outcome = rig.aim_with(&posed, target, DT, &settings);
                assert_true_outcome(&rig, &pose, 0, target, &outcome, &world);
                assert_within_limits(&rig, &before, DT, &world);
            }
            let outcome = rig.snap_with(&posed, target, &settings);
            // Leaning forward by 30°, the head would have to pitch up by 120° but can by 89°.
            let out_of_reach = if above > 0.0 { 31.0 * DEG } else { 0.0 };
            assert!(!similar || (outcome.remaining - out_of_reach).abs() < 0.1 * DEG, "{world}: {outcome:?}");
        }
    }
}

/// A target on the effector has no direction.
#[test]
fn target_too_close() {
    for (world, parent, _) in worlds() {
        for solver in SOLVERS {
            let mut rig = person();
            rig.joints = vec![Joint::from_angles(0.1, -0.1), Joint::from_angles(0.2, 0.1), Joint::default()];
            let pose = moved(&parent, &upright(&rig));
            let settings = Settings::default().with_solver(solver);
            // Let the upright frames settle first.
            rig.aim_with(&Pose::new(pose.clone()), Vec3::splat(1e3), 1e-9, &settings);
            let before = rig.joints.clone();
            let on_effector = Vec3::from(seen64(&rig, &pose, 0).0.map(|x| x as f32));
            let outcome = rig.aim_with(&Pose::new(pose.clone()), on_effector, DT, &settings);
            if solver == Solver::Natural && outcome.status != Status::Degenerate {
                // The head moved on and took the eye slightly off the target, so there is a direction again.
                assert_within_limits(&rig, &before, DT, &world);
                continue;
            }
            assert_eq!((outcome.status, outcome.aim), (Status::Degenerate, 0.0), "{world}, {solver:?}");
            assert_eq!(rig.joints, before, "{world}, {solver:?}: the angles hold");
        }
    }
}

#[test]
fn weight() {
    for (world, parent, similar) in worlds() {
        let pose = moved(&parent, &alone());
        for (target, full) in [(Vec3::new(-1.0, 0.0, 0.0), 90.0), (WORLD[0] - WORLD[2], -45.0)] {
            for (weight, part) in
                [(1.0, 1.0), (2.0, 1.0), (0.5, 0.5), (0.25, 0.25), (0.0, 0.0), (-0.5, 0.0), (f32::NAN, 0.0)]
            {
                for solver in SOLVERS {
                    let mut rig = NumericRig::ball(THUG);
                    let settings = Settings::default().with_weight(weight).with_solver(solver);
                    let posed = Pose::new(pose.clone());
                    let outcome = rig.snap_with(&posed, parent.transform_point3(target), &settings);
                    let case = format!("{world}, {solver:?}, {weight}");
                    assert_eq!(outcome.status, Status::Reached, "{case}");
                    assert!(sound(&rig));
                    let heading = rig.joints[0].heading();
                    assert!(!similar || (heading - part * full * DEG).abs() < 1e-4, "{case}: {heading}");
                    if part == 0.0 {
                        assert_eq!((heading, rig.joints[0].pitch()), (0.0, 0.0), "{case}");
                    }
                }
            }
        }
    }
}

#[test]
fn zero_scale() {
    for flat in [Vec3::ZERO, Vec3::new(1.0, 0.0, 1.0), Vec3::new(0.0, 0.0, 1.0)] {
        for squashed in 0..3 {
            for solver in SOLVERS {
                let mut rig = person();
                let mut pose = upright(&rig);
                pose[squashed] *= Affine3A::from_scale(flat);
                let settings = Settings::default().with_solver(solver);
                let outcome = rig.aim_with(&Pose::new(pose), Vec3::new(1.0, 1.0, -1.0), DT, &settings);
                assert_eq!(outcome.status, Status::Degenerate);
                assert!(rig.corrections().all(|(_, q)| q == Quat::IDENTITY));
            }
        }
    }
}

/// Forward parallel to up is an error in a bone's axes but valid for an effector, such as a lamp on a head.
#[test]
fn forward_parallel_to_up() {
    for (world, parent, _) in worlds() {
        for along in [THUG.up, (-Vec3::from(THUG.up)).to_array()] {
            let mut rig = person();
            rig.effector = Effector { forward: along, origin: [0.05, 0.0, 0.0] };
            let pose = moved(&parent, &upright(&rig));
            let gaze = Vec3::from(animated64(&rig, &upright(&rig), 0).1.map(|x| x as f32));
            let from = upright(&rig)[0].transform_point3(rig.effector.origin.into());
            for (axis, angle) in [(WORLD[2], 10.0), (WORLD[2], -10.0)] {
                let target = from + Quat::from_axis_angle(axis, angle * DEG) * gaze * 3.0;
                assert_reached(&rig, &pose, parent.transform_point3(target), &format!("{world}, {along:?}, {angle}"));
            }
            // About the other axis, heading and pitch are both needed, if it is reachable at all: only check the
            // outcome.
            let target = from + Quat::from_axis_angle(WORLD[0], 10.0 * DEG) * gaze * 3.0;
            solve_by_every_solver(&rig, &pose, parent.transform_point3(target), &format!("{world}, {along:?}, aside"));
        }
    }
}
