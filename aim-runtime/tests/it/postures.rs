//! How regions hold themselves in a natural gaze: level heads, calm necks.
#![allow(clippy::cast_precision_loss, reason = "steps are counted")]

use crate::common::*;
use crate::natural::{at, thug};
use aim_runtime::glam::Mat3A;
use aim_runtime::{Joint, Pose, Role};

/// The heading of a target near the zenith says little: the head looks up rather than aside, whichever side the target passes
/// on, and a target that moves a little turns it little.
#[test]
fn near_the_zenith_the_head_stays_ahead() {
    for elevation in [78.0, 82.0, 86.0, 89.0_f32] {
        let mut rig = thug();
        let pose = upright(&rig);
        let mut before: Option<f32> = None;
        for step in -45..=45 {
            let heading = 4.0 * step as f32;
            rig.snap(&Pose::new(&pose), at(heading, elevation));
            let turned: f32 = rig.joints[1..].iter().map(|joint| joint.heading() / DEG).sum();
            let most = 1.5 * (90.0 - elevation) + 2.0;
            assert!(turned.abs() < most, "{heading}°, {elevation}°: the head turns by {turned}°");
            let moved = before.map_or(0.0, |before| (turned - before).abs());
            assert!(moved < 3.0, "{heading}°, {elevation}°: the head turns by {moved}° more");
            before = Some(turned);
        }
    }
}

/// A head that the animation turns aside, on a neck that it does not, looks up from there: what is overhead does not have the neck turn
/// it back to the front.
#[test]
fn a_neck_turns_little_under_a_head_that_looks_overhead() {
    for side in [-25.0, 25.0_f32] {
        let (rig, _) = looking(side, 0.0, 89.9);
        let [head, neck] = [0, 1].map(|joint| rig.joints[joint].heading() / DEG);
        assert!(neck.abs() < 12.0 && head.abs() < 22.0, "{side}°: {head}°, {neck}°");
    }
}

/// A chest that leans back under a head turned aside rolls the head: it leans back the less, the farther the head is turned.
#[test]
fn a_look_up_over_the_shoulder_does_not_tip_the_head() {
    for side in [-1.0, 1.0] {
        for (heading, elevation) in [(60.0, 30.0), (75.0, 40.0), (95.0, 40.0), (95.0, 50.0_f32)] {
            let mut rig = thug();
            let pose = upright(&rig);
            rig.snap(&Pose::new(&pose), at(side * heading, elevation));
            // Forward, left and up are x, y and z here.
            let turn = |joint: &Joint| Mat3A::from_rotation_z(joint.heading()) * Mat3A::from_rotation_y(-joint.pitch());
            let head = turn(&rig.joints[2]) * turn(&rig.joints[1]);
            let roll = head.y_axis.z.atan2(head.z_axis.z) / DEG;
            assert!(roll.abs() < 1.5, "{heading}°, {elevation}°: the head rolls by {roll}°");
        }
    }
}

/// A neck does not nod under a head that the animation turns out of it, which it would roll.
#[test]
fn a_neck_nods_little_under_a_head_turned_aside() {
    for side in [-45.0, 45.0_f32] {
        let (rig, roll) = looking(side, side, -35.0);
        let [head, neck] = [0, 1].map(|joint| rig.joints[joint].pitch() / DEG);
        assert!(neck.abs() < 0.25 * head.abs(), "{side}°: {head}°, {neck}°");
        assert!(roll.abs() < 8.0, "{side}°: the head rolls by {roll}°");
        // Straight ahead they share it.
        let (rig, roll) = looking(0.0, 0.0, -35.0);
        let [head, neck] = [0, 1].map(|joint| rig.joints[joint].pitch() / DEG);
        assert!(neck.abs() > 0.4 * head.abs() && roll.abs() < 0.1, "{head}°, {neck}°, {roll}°");
    }
}

/// Head, neck and chest after a snap to a target, the head turned aside by the animation, and the roll of the head in degrees.
fn looking(side_deg: f32, heading_deg: f32, pitch_deg: f32) -> (NumericRig, f32) {
    let mut rig = thug();
    for (info, role) in rig.infos.iter_mut().zip([Role::Head, Role::Neck, Role::Chest]) {
        *info = info.with_role(role).with_heading(-39.0 * DEG, 39.0 * DEG).with_pitch(-31.0 * DEG, 37.0 * DEG);
    }
    let mut pose = upright(&rig);
    pose[0].matrix3 = Mat3A::from_rotation_y(side_deg * DEG) * pose[0].matrix3;
    rig.snap(&Pose::new(pose), at(heading_deg, pitch_deg));
    // Forward, left and up are x, y and z here; the animation turns the head about what is up.
    let turn = |joint: &Joint| Mat3A::from_rotation_z(joint.heading()) * Mat3A::from_rotation_y(-joint.pitch());
    let inside = turn(&rig.joints[2]) * turn(&rig.joints[1]);
    let head = inside * Mat3A::from_rotation_z(side_deg * DEG) * turn(&rig.joints[0]);
    let roll = head.y_axis.z.atan2(head.z_axis.z) / DEG;
    (rig, roll)
}
