//! What the animation does with the eyes: their glances are replaced by the gaze, and do not move the head.

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::{GazeSharing, LimitsFrom, Pose, Settings};

use crate::common::*;
use crate::natural::{at, thug};

/// Returns the thug with ranges from the bind pose.
fn bound() -> NumericRig {
    let mut rig = thug();
    for info in &mut rig.infos {
        info.limits_from = LimitsFrom::BindPose;
    }
    rig
}

/// Returns the pose with the eye turned to the left and up.
fn glancing(rig: &NumericRig, heading_deg: f32, pitch_deg: f32) -> Vec<Affine3A> {
    let mut pose = upright(rig);
    let turn = Quat::from_rotation_y(heading_deg * DEG) * Quat::from_rotation_x(pitch_deg * DEG);
    pose[0].matrix3 = Mat3A::from_quat(turn) * pose[0].matrix3;
    pose
}

/// Runs two seconds; returns the angles of neck and chest, degrees.
fn settled(rig: &NumericRig, pose: Vec<Affine3A>, target: Vec3, settings: &Settings) -> [[f32; 2]; 2] {
    let mut rig = rig.clone();
    let pose = Pose::new(pose).with_bind(upright(&rig));
    for _ in 0..120 {
        rig.aim_with(&pose, target, 1.0 / 60.0, settings);
    }
    [1, 2].map(|joint| [rig.joints[joint].heading() / DEG, rig.joints[joint].pitch() / DEG])
}

#[test]
fn a_glance_of_the_animation_does_not_move_the_head() {
    for target in [at(60.0, 0.0), at(-30.0, 10.0), at(40.0, -25.0), at(5.0, 0.0), at(110.0, 0.0)] {
        let rig = bound();
        let steady = settled(&rig, upright(&rig), target, &Settings::default());
        for (heading, pitch) in [(12.0, 0.0), (-15.0, 5.0), (0.0, -12.0), (20.0, 10.0)] {
            let found = settled(&rig, glancing(&rig, heading, pitch), target, &Settings::default());
            for (found, expected) in found.as_flattened().iter().zip(steady.as_flattened()) {
                assert!((found - expected).abs() < 0.7, "{target}, glance {heading}°, {pitch}°: {found:?} {steady:?}");
            }
        }
    }
}

/// At a low weight, head and eye stay near the animation, however it glances.
#[test]
fn at_a_low_weight_the_head_stays_near_the_animation() {
    let (rig, settings) = (bound(), Settings::default().with_weight(0.02));
    for (heading, pitch) in [(30.0, 0.0), (-30.0, 10.0)] {
        let found = settled(&rig, glancing(&rig, heading, pitch), at(40.0, 0.0), &settings);
        assert!(found.as_flattened().iter().all(|angle| angle.abs() < 1.0), "{heading}°: {found:?}");
    }
}

/// Towards a target straight above, the gaze goes straight up, even from a glance to the side.
#[test]
fn a_glance_does_not_bend_the_way_of_the_gaze() {
    for side in [1.0, -1.0] {
        let mut rig = bound();
        let bind = upright(&rig);
        for joints in [upright(&rig), glancing(&rig, 12.0 * side, 0.0)] {
            rig.reset();
            let pose = Pose::new(joints).with_bind(bind.clone());
            rig.snap(&pose, at(0.0, 0.0));
            for frame in 0..60 {
                rig.aim(&pose, at(0.0, 60.0), 1.0 / 60.0);
                let (_, [x, _, z]) = gaze64(&rig, &pose.joints, 0);
                let off = x.atan2(-z).to_degrees();
                assert!(off.abs() < 2.0, "frame {frame}: {off}°");
            }
        }
    }
}

/// An eye rests in its customary range beside the turned head, unless the head has no room or is not to turn.
#[test]
fn an_eye_does_not_stay_in_its_corner() {
    let eye = |heading: f32, sharing: GazeSharing| {
        let mut rig = thug();
        let pose = Pose::new(upright(&rig));
        rig.snap_with(&pose, at(heading, 0.0), &Settings::default().with_sharing(sharing));
        rig.joints[0].heading() / DEG
    };
    let human = GazeSharing::default();
    for side in [1.0, -1.0] {
        for heading in [60.0, 75.0, 90.0] {
            let found = eye(side * heading, human);
            assert!((23.0..26.5).contains(&(side * found)), "{heading}°: {found}°");
        }
        let found = eye(side * 150.0, human);
        assert!(side * found > 34.0, "out of reach: {found}°");
        let found = eye(side * 32.0, GazeSharing { eyes_only: 33.0 * DEG, engage: 5.0 * DEG, ..human });
        assert!(side * found > 31.5, "the eyes' own shift: {found}°");
        let found = eye(side * 34.0, GazeSharing { head_share: 0.0, ..human });
        assert!(side * found > 33.5, "a head that hardly turns: {found}°");
    }
}
