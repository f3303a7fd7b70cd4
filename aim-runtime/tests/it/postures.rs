//! Postures of the natural gaze: level heads, calm necks.
#![allow(clippy::cast_precision_loss, reason = "steps are counted")]

use crate::common::*;
use crate::natural::{at, thug};
use aim_runtime::glam::{Mat3A, Quat, Vec3};
use aim_runtime::{Budgets, Joint, LimitsFrom, Pose, Role, Settings, Status};

/// Near the zenith a target's heading is ill-conditioned. The head looks up rather than aside, on whichever side the
/// target passes, and small movements of the target turn it little.
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

/// If the animation turns the head but not the neck, the head looks up from there: for an overhead target, the neck
/// does not turn it back to the front.
#[test]
fn a_neck_turns_little_under_a_head_that_looks_overhead() {
    for side in [-25.0, 25.0_f32] {
        let (rig, _) = looking(side, 0.0, 89.9);
        let [head, neck] = [0, 1].map(|joint| rig.joints[joint].heading() / DEG);
        assert!(neck.abs() < 12.0 && head.abs() < 22.0, "{side}°: {head}°, {neck}°");
    }
}

/// A chest that leans back under a head turned aside rolls the head, so it leans back less the further the head is
/// turned.
#[test]
fn a_look_up_over_the_shoulder_does_not_tip_the_head() {
    for side in [-1.0, 1.0] {
        for (heading, elevation) in [(60.0, 30.0), (75.0, 40.0), (95.0, 40.0), (95.0, 50.0_f32)] {
            let mut rig = thug();
            let pose = upright(&rig);
            rig.snap(&Pose::new(&pose), at(side * heading, elevation));
            // The eye adds no roll to the head.
            rig.joints[0] = Joint::default();
            let roll = roll_of(&rig, 0.0);
            assert!(roll.abs() < 1.5, "{heading}°, {elevation}°: the head rolls by {roll}°");
        }
    }
}

/// A neck does not nod under a head that the animation turns aside, since that would roll the head.
#[test]
fn a_neck_nods_little_under_a_head_turned_aside() {
    for side in [-45.0, 45.0_f32] {
        let (rig, roll) = looking(side, side, -35.0);
        let [head, neck] = [0, 1].map(|joint| rig.joints[joint].pitch() / DEG);
        assert!(neck.abs() < 0.25 * head.abs(), "{side}°: {head}°, {neck}°");
        assert!(roll.abs() < 8.0, "{side}°: the head rolls by {roll}°");
        // Straight ahead, head and neck share the pitch.
        let (rig, roll) = looking(0.0, 0.0, -35.0);
        let [head, neck] = [0, 1].map(|joint| rig.joints[joint].pitch() / DEG);
        assert!(neck.abs() > 0.4 * head.abs() && roll.abs() < 0.1, "{head}°, {neck}°, {roll}°");
    }
}

/// A target below and to the side is left to the head: bending the chest under it would roll it.
#[test]
fn a_look_down_over_the_shoulder_does_not_tip_the_head() {
    let chest = |heading_deg: f32| looking(0.0, heading_deg, -45.0).0.joints[2].pitch() / DEG;
    for side in [-50.0, 50.0] {
        let (ahead, aside) = (chest(0.0), chest(side));
        assert!(ahead < -3.0 && aside > 0.5 * ahead, "the chest bends by {aside}° aside, by {ahead}° ahead");
    }
}

/// If the head cannot nod further, the neck does, except under a head turned far aside: there it would roll the head
/// and hardly raise the gaze.
#[test]
fn a_neck_does_not_roll_a_head_that_cannot_nod() {
    let reach = |heading_deg: f32, elevation_deg: f32| {
        let mut rig = stiff_person();
        let pose = upright(&rig);
        rig.snap(&Pose::new(pose), at(heading_deg, elevation_deg));
        (rig.joints[1].pitch() / DEG, roll_of(&rig, 0.0))
    };
    let (neck, roll) = reach(0.0, 25.0);
    assert!(neck > 18.0 && roll.abs() < 0.1, "{neck}°, {roll}°");
    for side in [-1.0, 1.0] {
        let (neck, roll) = reach(side * 100.0, 25.0);
        assert!(neck < 10.0 && roll.abs() < 15.0, "the neck nods by {neck}°, the head rolls by {roll}°");
    }
}

/// If no joint can bring the head nearer to its target, all joints are at rest.
#[test]
fn a_head_that_cannot_nod_stands_still() {
    for side in [-1.0, 1.0] {
        let mut rig = stiff_person();
        let mut pose = upright(&rig);
        pose[0].matrix3 = Mat3A::from_rotation_y(side * 80.0 * DEG) * pose[0].matrix3;
        let pose = Pose::new(pose);
        let frame = |rig: &mut NumericRig| {
            rig.aim(&pose, at(side * 80.0, 20.0), 1.0 / 60.0);
            rig.joints.iter().flat_map(|joint| [joint.heading(), joint.pitch()]).collect::<Vec<_>>()
        };
        for _ in 0..240 {
            frame(&mut rig);
        }
        let mut before = frame(&mut rig);
        for _ in 0..20 {
            let now = frame(&mut rig);
            let most = now.iter().zip(&before).map(|(now, before)| (now - before).abs()).fold(0.0, f32::max);
            assert!(most < 1e-3 * DEG, "{:?} after {:?}", now, before);
            before = now;
        }
    }
}

/// A target that passes over the head and on behind it is looked up to until it is low enough to turn round to: the head
/// does not sink to the target's elevation in front.
#[test]
fn a_head_does_not_sink_below_a_target_that_passes_over_it() {
    for aside in [-0.1, 0.0, 0.05_f32] {
        for leads in [false, true] {
            let mut rig = thug();
            for info in &mut rig.infos[1..] {
                *info = info.with_pitch(-60.0 * DEG, 60.0 * DEG);
            }
            let settings = Settings::default().with_effector(usize::from(leads));
            let pose = Pose::new(upright(&rig));
            let mut raised = |angle: f32| {
                rig.snap_with(&pose, over(aside, angle), &settings);
                rig.joints[1..].iter().map(|joint| joint.pitch() / DEG).sum::<f32>()
            };
            let most = raised(90.0);
            for angle in [95.0, 100.0, 105.0, 110.0, 115.0] {
                let now = raised(angle);
                assert!(now > most - 3.0, "{aside}, {angle}°: the head is raised by {now}° after {most}°");
            }
        }
    }
}

/// A target behind and high up that bobs, as it does for a character who walks away from it, does not make the head turn
/// round and back.
#[test]
fn a_head_does_not_swing_below_a_target_that_bobs_high_behind_it() {
    for side in [-178.0, 175.0_f32] {
        let mut rig = thug();
        let pose = Pose::new(upright(&rig));
        for step in 0..300 {
            let elevation = 67.0 + 4.0 * (step as f32 / 10.0).sin();
            rig.aim(&pose, at(side, elevation), 1.0 / 60.0);
            let turned: f32 = rig.joints[1..].iter().map(|joint| joint.heading() / DEG).sum();
            assert!(turned.abs() < 20.0, "{side}°, {step}: the head turns by {turned}°");
        }
    }
}

/// While a target passes over the head, the eye looks up to it, wherever the head has to turn.
#[test]
fn an_eye_follows_over_the_head() {
    for aside in [-0.1, 0.03, 0.2_f32] {
        let mut rig = thug();
        let pose = Pose::new(upright(&rig));
        let frame = |rig: &mut NumericRig, angle: f32| {
            rig.aim(&pose, over(aside, angle), 1.0 / 60.0);
            rig.joints[0].pitch() / DEG
        };
        for _ in 0..120 {
            frame(&mut rig, 60.0);
        }
        for step in 0..50 {
            let angle = 60.0 + 3.0 * step as f32;
            let pitch = frame(&mut rig, angle);
            assert!(!(80.0..=125.0).contains(&angle) || pitch > 10.0, "{angle}°: the eye looks up by {pitch}°");
        }
    }
}

/// An animal with its head down, as for grazing, lifts it before it looks far to the side or back. It neither looks
/// there from under its body nor rolls its head over.
#[test]
fn a_head_that_hangs_down_is_lifted_to_look_aside() {
    for side in [-1.0, 1.0_f32] {
        for down in [62.0, 70.0, 78.0_f32] {
            let mut rig = person();
            rig.budgets = Budgets::QUADRUPED;
            for (info, role) in rig.infos.iter_mut().zip([Role::Head, Role::Neck, Role::Neck]) {
                let wide = info.with_role(role).with_heading(-60.0 * DEG, 60.0 * DEG);
                *info = wide.with_pitch(-14.0 * DEG, 110.0 * DEG).with_upright(1.0);
            }
            let mut pose = upright(&rig);
            for joint in &mut pose {
                joint.matrix3 = Mat3A::from_rotation_x(-down * DEG) * joint.matrix3;
            }
            let target = at(side * 105.0, 10.0);
            rig.snap(&Pose::new(&pose).with_up(Vec3::Y), target);
            let [heading, pitch] =
                [Joint::heading, Joint::pitch].map(|of| rig.joints.iter().map(of).sum::<f32>() / DEG);
            assert!(side * heading > 60.0 && pitch > 20.0, "{side}, {down}°: {heading}°, {pitch}°");
        }
    }
}

/// A person who bends down until the eyes look at the ground, or back past the feet, looks up to a target ahead and
/// turns to one aside, wherever the animated eyes look: never under the body, and to the side of the target.
#[test]
fn a_person_who_bends_down_looks_up_the_right_way() {
    for upright_heading in [0.0, 1.0] {
        for down in [60.0, 75.0, 82.0, 88.0, 90.0, 93.0, 100.0, 110.0_f32] {
            for glance in [-12.0, 0.0, 12.0_f32] {
                for heading in [-120.0, -60.0, 0.0, 60.0, 120.0_f32] {
                    let mut rig = thug();
                    rig.infos[1] = rig.infos[1].with_upright(upright_heading);
                    let bind = upright(&rig);
                    let mut pose = bind.clone();
                    for (joint, part) in pose.iter_mut().zip([1.0, 1.0, 0.8]) {
                        joint.matrix3 = Mat3A::from_rotation_x(-part * down * DEG) * joint.matrix3;
                    }
                    pose[0].matrix3 = Mat3A::from_rotation_x(glance * DEG) * pose[0].matrix3;
                    rig.snap(&Pose::new(&pose).with_bind(&bind).with_up(Vec3::Y), at(heading, 0.0));
                    let [aside, up] =
                        [Joint::heading, Joint::pitch].map(|of| (of(&rig.joints[0]) + of(&rig.joints[1])) / DEG);
                    let case = format!("{upright_heading}, {down}°, {glance}°, {heading}°: {aside}°, {up}°");
                    match heading {
                        0.0 => assert!(aside.abs() < 1.0 && up > 25.0, "{case}"),
                        _ => assert!(heading.signum() * aside > 25.0, "{case}"),
                    }
                }
            }
        }
    }
}

/// A person who lies on one side and looks up turns to a target ahead in the same way, whichever way the body is tipped
/// a little.
#[test]
fn a_person_who_lies_on_one_side_does_not_turn_over() {
    for side in [-1.0, 1.0_f32] {
        for turn in [40.0, 50.0, 55.0_f32] {
            let gaze = |tip: f32| {
                let mut rig = thug();
                let bind = upright(&rig);
                let mut pose = bind.clone();
                let lying = Mat3A::from_rotation_z((90.0 + tip) * side * DEG);
                for (joint, part) in pose.iter_mut().zip([1.0, 1.0, 0.0]) {
                    joint.matrix3 = lying * Mat3A::from_rotation_y(part * side * turn * DEG) * joint.matrix3;
                }
                rig.snap(&Pose::new(&pose).with_bind(&bind).with_up(Vec3::Y), at(0.0, 0.0));
                let sum = |of: fn(&Joint) -> f32| rig.joints.iter().map(of).sum::<f32>() / DEG;
                [sum(Joint::heading), sum(Joint::pitch)]
            };
            let [before, after] = [-1.0, 1.0].map(gaze);
            let apart = (after[0] - before[0]).abs().max((after[1] - before[1]).abs());
            assert!(apart < 1.0, "{side}, {turn}°: {before:?}, {after:?}");
        }
    }
}

/// Without a chest, the budget of the head counts from the bind pose, as ranges do: an animal that walks with its head
/// low looks up as far as one that walks with its head high, and no further.
#[test]
fn a_head_without_a_chest_has_its_budget_from_the_bind_pose() {
    let up_deg = Budgets::QUADRUPED.head.pitch[1] / DEG;
    for lift in [-35.0, 0.0, 35.0_f32] {
        let mut rig = person();
        rig.budgets = Budgets::QUADRUPED;
        for (info, role) in rig.infos.iter_mut().zip([Role::Head, Role::Neck, Role::Neck]) {
            let wide = info.with_role(role).with_pitch(-50.0 * DEG, 50.0 * DEG);
            *info = wide.with_upright(1.0).with_limits_from(LimitsFrom::BindPose);
        }
        let bind = upright(&rig);
        let mut pose = bind.clone();
        for joint in &mut pose {
            joint.matrix3 = Mat3A::from_rotation_x(lift * DEG) * joint.matrix3;
        }
        let pose = Pose::new(pose).with_bind(bind).with_up(Vec3::Y);
        let highest = |rig: &mut NumericRig, elevation_deg: f32| {
            let outcome = rig.snap(&pose, at(0.0, elevation_deg));
            (outcome.status, lift + rig.joints.iter().map(Joint::pitch).sum::<f32>() / DEG)
        };
        let (status, _) = highest(&mut rig, up_deg - 8.0);
        assert_eq!(status, Status::Reached, "{lift}°");
        let (_, elevation) = highest(&mut rig, 85.0);
        assert!((up_deg - 5.0..up_deg + 0.1).contains(&elevation), "{lift}°: {elevation}°");
    }
}

/// Returns a target on a circle over the head, at this angle from the front and this far to the left.
fn over(aside_m: f32, angle_deg: f32) -> Vec3 {
    at(0.0, angle_deg) + WORLD[2] * aside_m
}

/// Returns a rig of head, neck and chest.
fn person() -> NumericRig {
    let mut rig = thug();
    for (info, role) in rig.infos.iter_mut().zip([Role::Head, Role::Neck, Role::Chest]) {
        *info = info.with_role(role).with_heading(-39.0 * DEG, 39.0 * DEG).with_pitch(-31.0 * DEG, 37.0 * DEG);
    }
    rig
}

/// Returns a rig of head, neck and chest whose head can hardly nod.
fn stiff_person() -> NumericRig {
    let mut rig = person();
    rig.infos[0] = rig.infos[0].with_pitch(-3.0 * DEG, 3.0 * DEG);
    rig
}

/// Returns the roll of a head that the animation turns aside by `side_deg`, degrees.
fn roll_of(rig: &NumericRig, side_deg: f32) -> f32 {
    // Forward, left and up are x, y and z here; the animation turns the head about up.
    let turn = |joint: &Joint| Mat3A::from_rotation_z(joint.heading()) * Mat3A::from_rotation_y(-joint.pitch());
    let inside = turn(&rig.joints[2]) * turn(&rig.joints[1]);
    let head = inside * Mat3A::from_rotation_z(side_deg * DEG) * turn(&rig.joints[0]);
    head.y_axis.z.atan2(head.z_axis.z) / DEG
}

/// Returns head, neck and chest after a snap to a target, with the head turned aside by the animation, and the roll of
/// the head in degrees.
fn looking(side_deg: f32, heading_deg: f32, pitch_deg: f32) -> (NumericRig, f32) {
    let mut rig = person();
    let mut pose = upright(&rig);
    pose[0].matrix3 = Mat3A::from_rotation_y(side_deg * DEG) * pose[0].matrix3;
    rig.snap(&Pose::new(pose), at(heading_deg, pitch_deg));
    let roll = roll_of(&rig, side_deg);
    (rig, roll)
}

/// If a chest faces the ground, as in a crouch, its front is where its up points, whatever the heading of its forward.
/// The head has equal range to both sides, and the chest does not roll it.
#[test]
fn a_chest_that_faces_the_ground_has_its_front_ahead() {
    let [ahead, up] = [Vec3::Z, Vec3::Y];
    for yaw in [-25.0, 0.0, 25.0_f32] {
        let turn =
            Quat::from_axis_angle(up.cross(ahead).normalize(), 80.0 * DEG) * Quat::from_axis_angle(up, yaw * DEG);
        assert!((turn * ahead).dot(up) < -0.85, "it faces the ground");
        for heading in [-80.0, 80.0_f32] {
            let mut rig = thug();
            let mut pose = upright(&rig);
            pose[2].matrix3 = Mat3A::from_quat(turn) * pose[2].matrix3;
            let outcome = rig.snap(&Pose::new(&pose).with_up(up), at(heading, 5.0));
            assert_ne!(outcome.status, Status::AtLimit, "{yaw}°, {heading}°");
            assert!(outcome.remaining < 0.1 * DEG, "{yaw}°, {heading}°: {}° off", outcome.remaining / DEG);
            let chest = rig.joints[2].heading() / DEG;
            assert!(chest.abs() < 2.0, "{yaw}°, {heading}°: the chest turns by {chest}°");
        }
    }
}
