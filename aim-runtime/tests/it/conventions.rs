//! All 48 conventions give the same angles and the same picture: 24 right-handed and 24 left-handed triples. The latter
//! are tested as mirrored bones in the same world and as plain bones in a mirrored world.

use crate::common::*;
use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::{Axes, Pose, Status};

/// Returns the thug with these axes in every bone, in a pose of small rotations, in a world that may be mirrored.
fn authored(axes: Axes, turns: &[Quat], mirrored: bool) -> (NumericRig, Vec<Affine3A>) {
    let rig = NumericRig::thug_with(axes);
    let mut pose = upright(&rig);
    for (joint, turn) in pose.iter_mut().zip(turns) {
        joint.matrix3 = Mat3A::from_quat(*turn) * joint.matrix3;
        if mirrored {
            *joint = mirror() * *joint;
        }
    }
    (rig, pose)
}

fn mirror() -> Affine3A {
    Affine3A::from_scale(Vec3::new(-1.0, 1.0, 1.0))
}

#[test]
fn every_convention_gives_the_same_picture() {
    let all = triples();
    assert_eq!(all.iter().filter(|(_, right)| *right).count(), 24);
    assert_eq!(all.len(), 48);

    let mut rng = Rng(48);
    for case in 0..6 {
        let turns: Vec<Quat> = (0..3).map(|_| Quat::from_axis_angle(rng.direction(), rng.between(0.0, 0.3))).collect();
        let eye = Vec3::from(upright(&NumericRig::thug())[0].translation);
        let target = eye
            + Quat::from_rotation_y(rng.between(-80.0, 80.0) * DEG)
                * Quat::from_rotation_x(rng.between(-25.0, 20.0) * DEG)
                * (WORLD[0] * rng.between(0.5, 5.0));
        let (mut reference, reference_pose) = authored(THUG, &turns, false);
        let mut pictures = Vec::new();
        for (axes, _) in &all {
            for mirrored in [false, true] {
                let (rig, pose) = authored(*axes, &turns, mirrored);
                pictures.push((axes, mirrored, rig, pose));
            }
        }
        for frame in 0..40 {
            let outcome = reference.aim(&Pose::new(reference_pose.clone()), target, 1.0 / 60.0);
            for (axes, mirrored, rig, pose) in &mut pictures {
                let target = if *mirrored { mirror().transform_point3(target) } else { target };
                let other = rig.aim(&Pose::new(pose.clone()), target, 1.0 / 60.0);
                let case = format!("case {case}, frame {frame}, {axes:?}, mirrored {mirrored}");
                // If a step is barely accepted, rounding decides, and the angles differ until the end.
                assert!((outcome.remaining - other.remaining).abs() < 2e-3, "{case}: {outcome:?} {other:?}");
                assert!(sound(rig), "{case}");
                if frame == 39 {
                    assert_eq!((outcome.status, other.status), (Status::Reached, Status::Reached), "{case}");
                    for (a, b) in reference.joints.iter().zip(&rig.joints) {
                        assert!((a.heading() - b.heading()).abs() < 5e-3, "{case}: {a:?} {b:?}");
                        assert!((a.pitch() - b.pitch()).abs() < 5e-3, "{case}: {a:?} {b:?}");
                    }
                    let (origin, gaze) = gaze64(&reference, &reference_pose, 0);
                    let (other_origin, other_gaze) = gaze64(rig, pose, 0);
                    let flip = if *mirrored { -1.0 } else { 1.0 };
                    for (a, b) in [(origin, other_origin), (gaze, other_gaze)] {
                        assert!((a[0] - flip * b[0]).abs() < 5e-3, "{case}");
                        assert!((a[1] - b[1]).abs() < 5e-3 && (a[2] - b[2]).abs() < 5e-3, "{case}");
                    }
                }
            }
        }
    }
}

/// Heading turns forward towards left and pitch turns forward towards up, in every convention.
#[test]
fn corrections_turn_the_right_way() {
    for (axes, _) in triples() {
        let mut rig = NumericRig::ball(axes);
        let [forward, up, left] = [axes.forward, axes.up, axes.left].map(Vec3::from);
        for (heading, pitch) in [(0.3_f32, 0.0_f32), (0.0, 0.3), (-1.0, 0.0), (0.0, -1.0), (0.7, -0.4)] {
            rig.joints = vec![aim_runtime::Joint::from_angles(heading, pitch)];
            // A time step of 0 moves nothing.
            rig.aim(&Pose::new([bone(&axes, Quat::IDENTITY, Vec3::ZERO)]), Vec3::NEG_Z, 0.0);
            let (index, q) = rig.corrections().next().unwrap();
            assert_eq!(index, 0);
            let pitched = forward * pitch.cos() + up * pitch.sin();
            let turned = (forward * heading.cos() + left * heading.sin()) * pitched.dot(forward) + up * pitched.dot(up);
            assert!((q * forward - turned).length() < 1e-6, "{axes:?}");
        }
    }
}

/// A bone whose frame is turned by 20° takes the same path.
#[test]
fn bones_with_general_frames_are_aimed() {
    let turn = Quat::from_axis_angle(Vec3::new(0.6, -0.64, 0.48), 20.0 * DEG);
    for (axes, _) in triples() {
        let [forward, up, left] = [axes.forward, axes.up, axes.left].map(|v| (turn * Vec3::from(v)).to_array());
        let rig = NumericRig::thug_with(Axes { forward, up, left });
        let pose = upright(&rig);
        let target = Vec3::new(-1.0, 1.9, -1.2);
        let mut rig = rig;
        let mut reference = NumericRig::thug();
        reference.snap(&Pose::new(upright(&NumericRig::thug())), target);
        let outcome = rig.snap(&Pose::new(pose.clone()), target);
        assert_eq!(outcome.status, Status::Reached);
        assert!(remaining64(&rig, &pose, 0, target) < 1e-4);
        for (a, b) in reference.joints.iter().zip(&rig.joints) {
            assert!((a.heading() - b.heading()).abs() < 1e-3 && (a.pitch() - b.pitch()).abs() < 1e-3);
        }
    }
}
