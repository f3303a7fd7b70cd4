//! Natural gaze: the eye leads and stays on the target; neck and spine follow with their shares and their inertia.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "frames are counted")]

use crate::common::*;
use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::{Behind, Budgets, GazeSharing, Joint, JointInfo, Outcome, Pose, Role, Settings, Solver, Status};

pub(crate) const FRAME_RATES: [f32; 3] = [30.0, 60.0, 144.0];
const EYE: Vec3 = Vec3::new(-0.03, 1.68, -0.10);

/// Returns the thug with roles, so that its default solver is the natural one.
pub(crate) fn thug() -> NumericRig {
    let mut rig = NumericRig::thug();
    for (info, role) in rig.infos.iter_mut().zip([Role::Eye, Role::Neck, Role::Chest]) {
        // The independent forward kinematics ignores upright tilts; these have tests of their own.
        *info = info.with_role(role).with_upright(0.0);
    }
    rig
}

/// Default accelerations for the roles neck and chest, rad/s².
const ACCELERATIONS: [f32; 2] = [1200.0 * DEG, 500.0 * DEG];

/// Returns a target at 3 m, this many degrees to the left of and above straight ahead.
pub(crate) fn at(heading_deg: f32, pitch_deg: f32) -> Vec3 {
    EYE + Quat::from_rotation_y(heading_deg * DEG) * Quat::from_rotation_x(pitch_deg * DEG) * WORLD[0] * 3.0
}

fn angles(joint: &Joint) -> [f32; 2] {
    [joint.heading(), joint.pitch()]
}

/// Returns the magnitude of a joint's angles, degrees.
fn turned(joint: &Joint) -> f32 {
    joint.heading().hypot(joint.pitch()) / DEG
}

/// Runs one frame; asserts that ranges and rates hold, corrections are valid, and the outcome is right.
pub(crate) fn aim(rig: &mut NumericRig, pose: &[Affine3A], target: Vec3, dt: f32, settings: &Settings) -> Outcome {
    let before = rig.joints.clone();
    let outcome = rig.aim_with(&Pose::new(pose.to_vec()), target, dt, settings);
    for ((info, old), new) in rig.infos.iter().zip(&before).zip(&rig.joints) {
        let ranges = [info.heading, info.pitch].map(|range| range.unwrap_or_default());
        for ((range, old), new) in ranges.into_iter().zip(angles(old)).zip(angles(new)) {
            assert!((new - old).abs() <= info.rate * dt + 1e-6, "{old} to {new}");
            assert!((range[0]..=range[1]).contains(&new), "{new} in {range:?}");
        }
    }
    assert!(sound(rig));
    if settings.weight == 1.0 && outcome.status == Status::Reached {
        assert!(remaining64(rig, pose, 0, target) <= f64::from(settings.tolerance) + 1e-6);
    }
    outcome
}

/// Checks that the velocity of each supporting joint changes by no more than its acceleration allows.
struct Jerk {
    before: Vec<[f32; 2]>,
    velocities: Vec<[f32; 2]>,
}

impl Jerk {
    fn new(rig: &NumericRig) -> Self {
        Self { before: rig.joints.iter().map(angles).collect(), velocities: vec![[0.0; 2]; rig.joints.len()] }
    }

    fn watch(&mut self, rig: &NumericRig, dt: f32) {
        for (index, acceleration) in [1, 2].into_iter().zip(ACCELERATIONS) {
            let now = angles(&rig.joints[index]);
            let velocity = [0, 1].map(|k| (now[k] - self.before[index][k]) / dt);
            for (new, old) in velocity.into_iter().zip(self.velocities[index]) {
                // Rounding errors of an angle after two differences.
                let rounding = 2e-7 / dt;
                assert!((new - old).abs() <= 1.002 * acceleration * dt + rounding, "joint {index}: {old} to {new}");
            }
            (self.before[index], self.velocities[index]) = (now, velocity);
        }
    }
}

/// Runs 1.5 s with a static target. Returns the frame in which the gaze arrived and, per frame, the rotation of the
/// eye, of neck and chest together, and the remaining angle, all in degrees.
fn step(rig: &mut NumericRig, target: Vec3, hz: f32, settings: &Settings) -> (Option<usize>, Vec<[f32; 3]>) {
    let pose = upright(rig);
    let mut jerk = Jerk::new(rig);
    let mut frames = Vec::new();
    for _ in 0..(1.5 * hz) as usize {
        aim(rig, &pose, target, 1.0 / hz, settings);
        jerk.watch(rig, 1.0 / hz);
        let remaining = (remaining64(rig, &pose, 0, target) as f32) / DEG;
        frames.push([turned(&rig.joints[0]), turned(&rig.joints[1]) + turned(&rig.joints[2]), remaining]);
    }
    (frames.iter().position(|frame| frame[2] < 0.1), frames)
}

/// Returns the time at which a rotation first exceeds 1°, seconds.
fn begins(turns: impl Iterator<Item = f32>, hz: f32) -> f32 {
    let mut before = 0.0;
    for (frame, now) in turns.enumerate() {
        if now >= 1.0 {
            return (frame as f32 + (1.0 - before) / (now - before)) / hz;
        }
        before = now;
    }
    f32::INFINITY
}

/// Human timing: the eye's main sequence, the arrival of the gaze, and the share and speed of the head.
#[test]
fn the_eye_leads_and_returns() {
    /// Frames per second, high enough to measure speeds.
    const HZ: f32 = 600.0;
    let peak = |angles: &mut dyn Iterator<Item = f32>| {
        let mut before = 0.0;
        let mut fastest = (0.0, 0.0);
        for angle in angles {
            let speed = (angle - before) * HZ;
            if speed > fastest.0 {
                fastest = (speed, angle);
            }
            before = angle;
        }
        fastest
    };
    for side in [1.0, -1.0] {
        for (degrees, arrives_ms) in [(10.0_f32, 45.0..=60.0), (30.0, 80.0..=135.0), (60.0, 200.0..=330.0)] {
            let case = format!("{degrees}°, side {side}");
            let (arrival, frames) = step(&mut thug(), at(side * degrees, 0.0), HZ, &Settings::default());
            let arrival = arrival.expect("a gaze that arrives");
            let arrived_ms = (arrival + 1) as f32 / HZ * 1e3;
            assert!(arrives_ms.contains(&arrived_ms), "{case}: there after {arrived_ms} ms");
            assert!(frames[arrival..].iter().all(|frame| frame[2] < 0.1), "{case}: and stays");
            let [eye, neck, _] = frames[frames.len() - 1];
            if degrees < 20.0 {
                let (fastest, _) = peak(&mut frames.iter().map(|frame| frame[0]));
                assert!((280.0..=380.0).contains(&fastest), "{case}: a saccade at {fastest}°/s");
                assert!(frames.iter().all(|frame| frame[1] < 0.01), "{case}: a glance is the eyes'");
                continue;
            }
            let (fastest, where_) = peak(&mut frames.iter().map(|frame| frame[1]));
            let part = where_ / neck;
            assert!((0.3..=0.5).contains(&part), "{case}: the head is fastest after {part} of its way");
            assert!(frames.iter().all(|frame| frame[1] <= neck + 0.1), "{case}: and does not overshoot");
            if degrees > 45.0 {
                assert!((100.0..=200.0).contains(&fastest), "{case}: the head turns at {fastest}°/s");
                let there = frames.iter().position(|frame| frame[1] > 0.95 * neck).expect("a head that arrives");
                assert!((0.42..=0.65).contains(&(there as f32 / HZ)), "{case}: the head is there after {there} frames");
                assert!((18.0..=26.0).contains(&eye), "{case}: the eye ends at {eye}");
            }
        }
    }
}

/// Positions at given times do not depend on the frame rate.
#[test]
fn positions_do_not_depend_on_the_frame_rate() {
    let necks = |hz: f32| {
        let frames = step(&mut thug(), at(60.0, 10.0), hz, &Settings::default()).1;
        [0.1, 0.2, 0.3, 0.4].map(|t| frames[(t * hz).round() as usize - 1][1])
    };
    let [slow, quick] = [necks(30.0), necks(120.0)];
    for (slow, quick) in slow.into_iter().zip(quick) {
        assert!((slow - quick).abs() < 0.3, "{slow} and {quick}");
    }
}

/// Heading and pitch reach their goals at the same time, so that the path is nearly an arc.
#[test]
fn an_oblique_gaze_keeps_to_its_arc() {
    for (heading, pitch) in [(45.0, 20.0), (-30.0, 30.0), (25.0, -35.0), (50.0, -30.0)] {
        for hz in FRAME_RATES {
            let mut rig = thug();
            let (pose, target) = (upright(&rig), at(heading, pitch));
            let ahead = gaze64(&rig, &pose, 0).1.map(|x| x as f32);
            let normal = Vec3::from(ahead).cross(target - EYE).normalize();
            for _ in 0..(0.6 * hz) as usize {
                aim(&mut rig, &pose, target, 1.0 / hz, &Settings::default());
                let gaze = Vec3::from(gaze64(&rig, &pose, 0).1.map(|x| x as f32));
                let off = gaze.dot(normal).asin() / DEG;
                assert!(off.abs() < 7.0, "{heading}°, {pitch}°, {hz} Hz: {off}");
            }
        }
    }
}

/// Once the gaze is on the target it stays there, however target and body move.
#[test]
fn the_gaze_follows_a_moving_target_and_body() {
    let mut rng = Rng(5);
    for hz in FRAME_RATES {
        let mut rig = thug();
        let swings: Vec<(Vec3, f32)> = (0..3).map(|_| (rng.direction(), rng.between(2.0, 5.0))).collect();
        for frame in 0..(6.0 * hz) as usize {
            let t = frame as f32 / hz;
            let mut pose = upright(&rig);
            for (joint, (axis, speed)) in pose.iter_mut().zip(&swings) {
                joint.matrix3 =
                    Mat3A::from_quat(Quat::from_axis_angle(*axis, 0.08 * (speed * t).sin())) * joint.matrix3;
            }
            let outcome =
                aim(&mut rig, &pose, at(50.0 * (1.3 * t).sin(), 10.0 * t.cos()), 1.0 / hz, &Settings::default());
            assert!(t < 0.5 || outcome.status == Status::Reached, "{t} s: {outcome:?}");
        }
    }
}

/// With attention, the head turns fully to the target while the eye stays on it.
#[test]
fn attention_turns_the_head() {
    let mut rig = thug();
    let (pose, target) = (upright(&rig), at(40.0, 10.0));
    rig.snap(&Pose::new(pose.clone()), target);
    let glancing = turned(&rig.joints[0]);
    assert!(glancing > 15.0);
    let mut jerk = Jerk::new(&rig);
    for frame in 0..180 {
        let settings = Settings::default().with_attention(frame as f32 / 60.0);
        let outcome = aim(&mut rig, &pose, target, 1.0 / 60.0, &settings);
        jerk.watch(&rig, 1.0 / 60.0);
        assert!(outcome.status == Status::Reached && outcome.remaining < 0.01 * DEG, "{frame}: {outcome:?}");
    }
    assert!(turned(&rig.joints[0]) < 0.5, "{}", turned(&rig.joints[0]));
    // And back, as before; NaN counts as 0.
    for _ in 0..180 {
        let outcome = aim(&mut rig, &pose, target, 1.0 / 60.0, &Settings::default().with_attention(f32::NAN));
        assert!(outcome.remaining < 0.01 * DEG);
    }
    assert!((turned(&rig.joints[0]) - glancing).abs() < 0.1);
}

/// When targets, weights and attention jump, velocities still change only within the acceleration limits.
#[test]
fn accelerations_are_limited_when_inputs_jump() {
    let mut rng = Rng(8);
    for hz in FRAME_RATES {
        let mut rig = thug();
        let pose = upright(&rig);
        let mut jerk = Jerk::new(&rig);
        let (mut target, mut settings) = (at(0.0, 0.0), Settings::default());
        for frame in 0..3000 {
            if frame % 20 == 0 {
                target = EYE + rng.direction() * rng.between(0.3, 5.0);
                settings = settings.with_weight(rng.between(-0.5, 1.5)).with_attention(rng.between(-0.5, 1.5));
                settings.behind = [Behind::Off, Behind::Clip, Behind::Hold, Behind::Release][rng.below(4)];
            }
            aim(&mut rig, &pose, target, 1.0 / hz, &settings);
            jerk.watch(&rig, 1.0 / hz);
        }
    }
}

/// At weight 0 the joints return to the exact identity. The gaze returns first, and nothing jerks.
#[test]
fn at_weight_zero_the_joints_return_to_the_identity() {
    let mut rig = thug();
    let (pose, target) = (upright(&rig), at(55.0, -10.0));
    rig.snap(&Pose::new(pose.clone()), target);
    let mut jerk = Jerk::new(&rig);
    let animated = ahead(&thug(), &pose, 0, 1e6);
    for frame in 0..120 {
        let outcome = aim(&mut rig, &pose, target, 1.0 / 60.0, &Settings::default().with_weight(0.0));
        jerk.watch(&rig, 1.0 / 60.0);
        let off = remaining64(&rig, &pose, 0, animated) as f32 / DEG;
        assert!(frame < 20 || (off < 0.1 && outcome.status == Status::Reached), "{frame}: {off}");
    }
    assert_eq!(rig.joints.iter().map(turned).fold(0.0, f32::max), 0.0);
    assert!(rig.corrections().all(|(_, q)| q == Quat::IDENTITY));
    for frame in 0..120 {
        aim(&mut rig, &pose, target, 1.0 / 60.0, &Settings::default().with_weight(frame as f32 / 60.0));
        jerk.watch(&rig, 1.0 / 60.0);
    }
    assert!(remaining64(&rig, &pose, 0, target) < 1e-4);
}

/// An orbiting target is followed on the other side, in either direction and for every policy behind.
#[test]
fn an_orbiting_target_is_followed_on_the_other_side() {
    for policy in [Behind::Off, Behind::Clip, Behind::Plane, Behind::Hold, Behind::Release] {
        for turn_s in [6.0, -6.0, 15.0, -15.0_f32] {
            let mut rig = thug();
            let pose = upright(&rig);
            let mut jerk = Jerk::new(&rig);
            for frame in 0..(120.0 * turn_s.abs()) as usize {
                let heading = 360.0 * (frame as f32 / 60.0 / turn_s);
                let settings = Settings::default().with_behind(policy);
                let outcome = aim(&mut rig, &pose, at(heading, 0.0), 1.0 / 60.0, &settings);
                jerk.watch(&rig, 1.0 / 60.0);
                let off_front = (heading.abs() % 360.0 - 180.0).abs();
                if off_front > 120.0 && frame > 30 {
                    assert_eq!(outcome.status, Status::Reached, "{policy:?}, {turn_s} s, {heading}°: {outcome:?}");
                }
                assert!(off_front > 60.0 || outcome.status != Status::Reached);
            }
        }
    }
}

/// If the target is out of reach to the side, the gaze keeps its elevation; above or below, its heading. The status
/// says so.
#[test]
fn a_target_out_of_reach_is_followed_level() {
    let gaze = |rig: &NumericRig, pose: &[Affine3A]| {
        let [x, y, z] = gaze64(rig, pose, 0).1.map(|x| x as f32);
        [(-x).atan2(-z) / DEG, y.asin() / DEG]
    };
    for heading in [-170.0, -150.0, -125.0, 125.0, 140.0, 160.0_f32] {
        for pitch in [-20.0, 0.0, 20.0_f32] {
            for (policy, solver) in [(Behind::Off, None), (Behind::Clip, Some(Solver::Natural))] {
                let mut rig = thug();
                let pose = upright(&rig);
                let mut settings = Settings::default().with_behind(policy);
                settings.solver = solver;
                let mut outcome = aim(&mut rig, &pose, at(heading, pitch), 1.0 / 60.0, &settings);
                for frame in 0..240 {
                    outcome = aim(&mut rig, &pose, at(heading, pitch), 1.0 / 60.0, &settings);
                    let [_, elevation] = gaze(&rig, &pose);
                    assert!(
                        (elevation - pitch).abs() < if frame < 42 { pitch.abs() + 8.0 } else { 2.5 },
                        "{heading}°, {pitch}°, {frame}: {elevation}°"
                    );
                }
                assert!(matches!(outcome.status, Status::AtLimit | Status::Behind), "{heading}°: {outcome:?}");
                let [turned, _] = gaze(&rig, &pose);
                assert!((105.0..=119.0).contains(&(turned * heading.signum())), "{heading}°, {pitch}°: {turned}°");
            }
        }
    }
    for heading in [-40.0, 0.0, 60.0_f32] {
        for pitch in [-85.0, 80.0_f32] {
            let mut rig = thug();
            let pose = upright(&rig);
            let mut outcome = aim(&mut rig, &pose, at(heading, pitch), 1.0 / 60.0, &Settings::default());
            for _ in 0..240 {
                outcome = aim(&mut rig, &pose, at(heading, pitch), 1.0 / 60.0, &Settings::default());
            }
            assert_eq!(outcome.status, Status::AtLimit);
            let [turned, elevation] = gaze(&rig, &pose);
            assert!(
                elevation.abs() > 55.0 && turned.abs() <= heading.abs() + 1.0,
                "{heading}°, {pitch}°: {turned}°, {elevation}°"
            );
        }
    }
}

/// A target whose heading and elevation each fit the joints' combined ranges is within reach.
#[test]
fn targets_that_fit_the_ranges_are_reached() {
    let mut rng = Rng(12);
    let mut failed = Vec::new();
    for case in 0..1500 {
        let count = 2 + rng.below(5);
        let chest = 1 + rng.below(count - 1);
        let mut infos = Vec::new();
        for index in 0..count {
            let role = match index {
                0 if rng.below(3) > 0 => Role::Eye,
                0 => Role::Head,
                _ if index < chest => Role::Neck,
                _ => Role::Chest,
            };
            let mut side = |most: f32| most * DEG * rng.between(0.2, 1.0);
            let most = if index == 0 { 35.0 } else { 80.0 / (count - 1) as f32 };
            infos.push(
                JointInfo::new(THUG, 200.0 * DEG)
                    .with_heading(-side(most), side(most))
                    .with_pitch(-side(0.5 * most), side(0.5 * most))
                    .with_role(role),
            );
        }
        let mut rig = NumericRig::new(infos);
        rig.budgets = Budgets::UNBOUNDED;
        // Most of the joints' combined range: a pitch combined with a heading raises the gaze only by its cosine.
        let mut part = |most: f32, range: fn(&JointInfo) -> Option<[f32; 2]>| {
            let [lo, hi] = rig.infos.iter().filter_map(range).fold([0.0, 0.0], |[a, b], [lo, hi]| [a + lo, b + hi]);
            most * rng.between(lo, hi) / DEG
        };
        let (heading, pitch) = (part(0.85, |info| info.heading), part(0.65, |info| info.pitch));
        let mut place = Vec3::new(0.0, 1.7, 0.0);
        let mut joints = Vec::new();
        for _ in 0..count {
            joints.push(bone(&THUG, Quat::from_axis_angle(rng.direction(), rng.between(0.0, 0.03)), place));
            place -= Vec3::new(0.0, rng.between(0.05, 0.2), rng.between(-0.05, 0.05));
        }
        let from = Vec3::from(joints[0].translation);
        let turn = Quat::from_rotation_y(heading * DEG) * Quat::from_rotation_x(pitch * DEG);
        let target = from + turn * WORLD[0] * rng.between(3.0, 30.0);
        let settings = Settings::default().with_behind(Behind::Off);
        let pose = Pose::new(joints).with_up(Vec3::Y);
        let status = rig.clone().aim_with(&pose, target, 1.0 / 60.0, &settings).status;
        let snapped = rig.snap_with(&pose, target, &settings);
        if snapped.status != Status::Reached || status == Status::AtLimit {
            failed.push((case, heading, pitch, snapped.status, snapped.remaining / DEG, status));
        }
    }
    // Except for one in a thousand, where all but one or two joints are at their limits.
    assert!(failed.len() <= 2, "{}: {failed:?}", failed.len());
}

/// A snap gives the pose in which the gaze would come to rest, and it stays there.
#[test]
fn a_snap_gives_the_final_pose() {
    let mut rng = Rng(11);
    for _ in 0..100 {
        let target = at(rng.between(-70.0, 70.0), rng.between(-30.0, 30.0));
        let mut rig = thug();
        let pose = animated(&rig, &mut rng, 0.1);
        let mut slow = rig.clone();
        let outcome = rig.snap(&Pose::new(pose.clone()), target);
        assert_eq!(outcome.status, Status::Reached);
        let snapped = rig.joints.clone();
        for _ in 0..180 {
            aim(&mut slow, &pose, target, 1.0 / 60.0, &Settings::default());
            let outcome = aim(&mut rig, &pose, target, 1.0 / 60.0, &Settings::default());
            assert_eq!(outcome.status, Status::Reached);
        }
        for ((snapped, stayed), came) in snapped.iter().zip(&rig.joints).zip(&slow.joints) {
            for ((a, b), c) in angles(snapped).into_iter().zip(angles(stayed)).zip(angles(came)) {
                assert!((a - b).abs() < 0.1 * DEG && (a - c).abs() < 0.2 * DEG, "{a}, {b}, {c}");
            }
        }
    }
}

/// Supporting joints start moving above one angle and stop below another.
#[test]
fn engagement_has_two_thresholds() {
    let natural = GazeSharing::default().with_eyes_only(5.0 * DEG).with_engagement(15.0 * DEG, 6.0 * DEG);
    let settings = Settings::default().with_sharing(natural);
    let mut rig = thug();
    let pose = upright(&rig);
    let mut neck_at = |heading: f32| {
        for _ in 0..90 {
            aim(&mut rig, &pose, at(heading, 0.0), 1.0 / 60.0, &settings);
        }
        turned(&rig.joints[1])
    };
    // Run some frames first, so that the joints' goals are known.
    assert_eq!(neck_at(0.0), 0.0);
    assert_eq!(neck_at(12.0), 0.0);
    let there = neck_at(20.0);
    assert!(there > 8.0);
    let back = neck_at(16.0);
    assert!(back > 5.0 && back < there - 2.0, "still following: {back}");
    let little = neck_at(9.0);
    assert!(little > 1.0 && little < back, "{little}");
    // The eye is near its centre now, so supporting joints stay where they are.
    let resting = neck_at(13.0);
    assert!((resting - little).abs() < 0.1, "{resting} is not {little}");
}

#[test]
fn a_delay_holds_back_the_head_only() {
    let delayed = Settings::default().with_sharing(GazeSharing::default().with_delay(0.1));
    let lag_s = |settings: &Settings| {
        let frames = step(&mut thug(), at(50.0, 0.0), 60.0, settings).1;
        assert!(frames[1][0] > 5.0, "the eye does not wait");
        begins(frames.iter().map(|frame| frame[1]), 60.0)
    };
    let more = lag_s(&delayed) - lag_s(&Settings::default());
    assert!((0.09..0.13).contains(&more), "{more}");
}

/// Accelerations declared by a rig take effect.
#[test]
fn declared_accelerations_take_effect() {
    let reach_s = |acceleration: f32| {
        let mut rig = thug();
        for info in &mut rig.infos[1..] {
            *info = info.with_acceleration(acceleration * DEG);
        }
        let pose = upright(&rig);
        (0..600).find(|_| {
            aim(&mut rig, &pose, at(60.0, 0.0), 1.0 / 60.0, &Settings::default());
            turned(&rig.joints[1]) > 10.0
        })
    };
    let [quick, slow] = [4000.0, 200.0].map(|acceleration| reach_s(acceleration).unwrap());
    assert!(quick <= 8 && slow > 15, "{quick}, {slow}");
}

/// Unusual rigs: hinges, an effector that is not the eye's own, a leaning neck, a stretched pose, a free base.
#[test]
fn unusual_rigs_are_aimed() {
    let eye = JointInfo::new(THUG, 450.0 * DEG).with_heading(-35.0 * DEG, 35.0 * DEG).with_role(Role::Eye);
    let yaw = JointInfo::new(THUG, 170.0 * DEG).with_heading(-60.0 * DEG, 60.0 * DEG);
    let nod = JointInfo::new(THUG, 120.0 * DEG).with_pitch(-40.0 * DEG, 40.0 * DEG);
    let turret = JointInfo::new(THUG, 120.0 * DEG).with_heading(f32::NEG_INFINITY, f32::INFINITY);
    let hinged = NumericRig::new(vec![eye, yaw, nod]);
    let mut offset = thug();
    offset.effector.origin = [0.01, 0.02, -0.01];
    offset.effector.forward = Vec3::new(0.1, 1.0, -0.1).normalize().into();
    let mut turning = thug();
    turning.infos[2] = turret;
    let mut leaning = thug();
    leaning.infos[..2].iter_mut().for_each(|info| *info = info.with_upright(1.0));
    let stretch = Affine3A::from_scale(Vec3::new(1.0, 1.3, 0.9));
    let rigs = [("hinged", hinged), ("offset", offset), ("turning", turning), ("leaning", leaning), ("plain", thug())];
    for (name, rig) in rigs {
        for stretched in [false, true] {
            for (heading, pitch) in [(5.0, 0.0), (-30.0, 0.0), (50.0, 15.0), (-65.0, -10.0)] {
                let mut rig = rig.clone();
                let mut rng = Rng(2);
                let mut pose = animated(&rig, &mut rng, 0.1);
                let mut target = at(heading, pitch);
                if stretched {
                    pose.iter_mut().for_each(|joint| *joint = stretch * *joint);
                    target = stretch.transform_point3(target);
                }
                let mut outcome = rig.aim(&Pose::new(pose.clone()), target, 1.0 / 60.0);
                for _ in 0..180 {
                    outcome = rig.aim(&Pose::new(pose.clone()), target, 1.0 / 60.0);
                }
                let case = format!("{name}, stretched {stretched}, {heading}°: {outcome:?}");
                assert_eq!(outcome.status, Status::Reached, "{case}");
                assert!(name == "leaning" || remaining64(&rig, &pose, 0, target) < 2e-3, "{case}");
            }
        }
    }
}

/// After a change of solver, supporting joints start without their former velocity.
#[test]
fn switching_the_solver_leaves_no_velocity() {
    let mut rig = thug();
    let pose = upright(&rig);
    for _ in 0..8 {
        aim(&mut rig, &pose, at(60.0, 0.0), 1.0 / 60.0, &Settings::default());
    }
    let exact = Settings::default().with_solver(Solver::Exact);
    for _ in 0..120 {
        aim(&mut rig, &pose, at(60.0, 0.0), 1.0 / 60.0, &exact);
    }
    let mut jerk = Jerk::new(&rig);
    for _ in 0..120 {
        let outcome = aim(&mut rig, &pose, at(60.0, 0.0), 1.0 / 60.0, &Settings::default());
        jerk.watch(&rig, 1.0 / 60.0);
        assert_eq!(outcome.status, Status::Reached);
    }
}

/// A single eye moves exactly as with the exact solver.
#[test]
fn a_single_eye_is_solved_by_the_exact_solver() {
    let mut rigs = [Solver::Natural, Solver::Exact].map(|solver| (thug(), Settings::default().with_solver(solver)));
    for frame in 0..60 {
        for (rig, settings) in &mut rigs {
            rig.infos.truncate(1);
            rig.joints.truncate(1);
            let pose = upright(rig);
            rig.aim_with(&Pose::new(pose), at(frame as f32, 5.0), 1.0 / 60.0, settings);
        }
        assert_eq!(rigs[0].0.joints, rigs[1].0.joints);
    }
}

/// Both eyes converge while the head follows, and come to rest together.
#[test]
fn both_eyes_converge_while_the_head_follows() {
    let mut rig = thug();
    let joints = upright(&rig);
    let mut other = joints[0];
    other.translation.x = 0.03;
    let pose = Pose::new(joints.clone()).with_other_eye(other);
    let target = Vec3::new(0.0, 1.68, -0.10) + Quat::from_rotation_y(50.0 * DEG) * WORLD[0] * 0.5;
    let mut arrived = None;
    let mut jerk = Jerk::new(&rig);
    for frame in 0..120 {
        let outcome = rig.aim(&pose, target, 1.0 / 60.0);
        jerk.watch(&rig, 1.0 / 60.0);
        let left = remaining64(&rig, &joints, 0, target).max(angle_to64(pair_gaze64(&rig, &joints, &other), target));
        if arrived.is_none() && outcome.status == Status::Reached {
            arrived = Some(frame);
        }
        assert!(arrived.is_none() || left < 2e-3, "{frame}: {left}");
    }
    assert!(arrived.is_some_and(|frame| frame < 20), "{arrived:?}");
    assert!(turned(&rig.joints[1]) > 10.0);
    for _ in 0..120 {
        rig.aim_with(&pose, target, 1.0 / 60.0, &Settings::default().with_weight(0.0));
        jerk.watch(&rig, 1.0 / 60.0);
    }
    assert!(rig.corrections().all(|(_, q)| q == Quat::IDENTITY));
    assert_eq!(rig.other_eye_correction(), Some(Quat::IDENTITY));
}

/// Settings, poses, targets and declarations with arbitrary bits do no harm.
#[test]
fn random_bits_are_harmless() {
    let mut rng = Rng(77);
    for _ in 0..3000 {
        let mut rig = thug();
        for info in &mut rig.infos {
            if rng.below(3) == 0 {
                info.acceleration = rng.any();
                info.rate = rng.any();
                info.stiffness = rng.any();
                info.heading = Some([rng.any(), rng.any()]);
            }
        }
        let mut pose = upright(&rig);
        for _ in 0..6 {
            if rng.below(4) == 0 {
                pose[rng.below(3)].translation = Vec3::new(rng.any(), rng.any(), rng.any()).into();
            }
            let mut natural = GazeSharing::default().with_eyes_only(rng.any()).with_head_share(rng.any());
            natural = natural.with_engagement(rng.any(), rng.any()).with_delay(rng.any());
            let settings = Settings::default().with_sharing(natural).with_attention(rng.any()).with_weight(rng.any());
            let target =
                if rng.below(2) == 0 { Vec3::new(rng.any(), rng.any(), rng.any()) } else { EYE + rng.direction() };
            let dt = if rng.below(3) == 0 { rng.any() } else { 1.0 / 60.0 };
            let pose = Pose::new(pose.clone());
            let outcome = match rng.below(8) {
                0 => rig.snap_with(&pose, target, &settings),
                _ => rig.aim_with(&pose, target, dt, &settings),
            };
            assert!(sound(&rig) && outcome.remaining.is_finite() && outcome.aim.is_finite());
            assert!(rig.joints.iter().flat_map(angles).all(f32::is_finite));
        }
    }
}

/// Frames after a snap do not move the joints, also out of reach.
#[test]
fn frames_after_a_snap_do_not_move_the_joints() {
    for (heading, pitch) in [(20.0, 0.0), (60.0, 10.0), (130.0, 60.0), (130.0, 45.0), (115.0, -60.0), (0.0, 85.0)] {
        let mut rig = thug();
        let pose = upright(&rig);
        rig.snap_with(&Pose::new(pose.clone()), at(heading, pitch), &Settings::default());
        let snapped = rig.joints.clone();
        for _ in 0..60 {
            aim(&mut rig, &pose, at(heading, pitch), 1.0 / 60.0, &Settings::default());
        }
        for (before, now) in snapped.iter().zip(&rig.joints) {
            let moved = [before.heading() - now.heading(), before.pitch() - now.pitch()];
            assert!(moved[0].hypot(moved[1]) < 0.01 * DEG, "{heading}°, {pitch}°: {before:?} to {now:?}");
        }
    }
}

/// A faster neck does not arrive later.
#[test]
fn a_higher_rate_is_no_slower() {
    let frames = |rate: f32| {
        let mut rig = thug();
        rig.infos[1].rate = rate * DEG;
        rig.budgets = Budgets { head: aim_runtime::Budget { rate: rate * DEG, ..rig.budgets.head }, ..rig.budgets };
        let pose = upright(&rig);
        (0..300).find(|_| {
            turned(&rig.joints[1]) > 25.0 || {
                aim(&mut rig, &pose, at(60.0, 10.0), 1.0 / 60.0, &Settings::default());
                false
            }
        })
    };
    let usual = frames(170.0).unwrap();
    assert!([300.0, 1000.0, 5000.0].into_iter().all(|rate| frames(rate).is_some_and(|count| count <= usual)));
}

/// With a neck bent deeply forward by the animation, the neck still turns to a target aside by way of the front.
#[test]
fn a_deep_nod_changes_no_side() {
    for nod in [55.0, 59.0, 61.0, 70.0_f32] {
        let mut rig = thug();
        let mut pose = upright(&rig);
        let neck = pose[1].translation;
        let turn = Affine3A::from_translation(neck.into())
            * Affine3A::from_rotation_x(-nod * DEG)
            * Affine3A::from_translation(-Vec3::from(neck));
        pose[..2].iter_mut().for_each(|joint| *joint = turn * *joint);
        for _ in 0..120 {
            aim(&mut rig, &pose, at(100.0, -20.0), 1.0 / 60.0, &Settings::default());
        }
        let heading = rig.joints[1].heading() / DEG;
        assert!(heading > 30.0, "{nod}°: {heading}°");
    }
}

/// If a target trembles behind a neck with unlimited heading but a human budget, the neck stays on the side it was on.
#[test]
fn a_free_neck_with_a_budget_keeps_its_side() {
    let mut rig = thug();
    rig.infos[1].heading = Some([f32::NEG_INFINITY, f32::INFINITY]);
    let pose = upright(&rig);
    let settings = Settings::default().with_behind(Behind::Off);
    let mut rng = Rng(5);
    for frame in 0..400 {
        let heading = if frame < 100 { 1.7 * frame as f32 } else { 180.0 + rng.between(-1.5, 1.5) };
        rig.aim_with(&Pose::new(pose.clone()), at(heading, 0.0), 1.0 / 60.0, &settings);
        assert!(frame < 100 || rig.joints[1].heading() > 60.0 * DEG, "{frame}: {:?}", rig.joints[1]);
    }
}

/// Out of reach to the side, the outcome reports how far the body would have to turn, and since when. Turned by 2°
/// more, the target is within reach; by 3° less, it is not. This holds behind, too, for every policy.
#[test]
fn body_turn_brings_the_target_into_reach() {
    for (heading, pitch) in [(125.0, 0.0), (-140.0, 10.0), (122.0, -15.0), (170.0, 0.0), (-160.0, 20.0_f32)] {
        for behind in [Behind::Off, Behind::Clip, Behind::Hold, Behind::Release] {
            let settings = Settings::default().with_behind(behind);
            let after = |heading: f32, frames: usize| {
                let mut rig = thug();
                let pose = upright(&rig);
                let mut outcome = aim(&mut rig, &pose, at(heading, pitch), 1.0 / 60.0, &settings);
                for _ in 1..frames {
                    outcome = aim(&mut rig, &pose, at(heading, pitch), 1.0 / 60.0, &settings);
                }
                outcome
            };
            let outcome = after(heading, 90);
            let turn = outcome.body_turn / DEG;
            assert!(turn * heading.signum() > 1.0 && turn.abs() < heading.abs(), "{heading}°, {behind:?}: {turn}°");
            assert!((outcome.out_of_reach_for - 1.5).abs() < 1e-3, "{heading}°, {behind:?}: {outcome:?}");
            let turned = after(heading - turn - 2.0 * heading.signum(), 240);
            assert_eq!(turned.status, Status::Reached, "{heading}°, {behind:?}: {turn}°, {turned:?}");
            assert_eq!([turned.body_turn, turned.out_of_reach_for], [0.0; 2]);
            assert_ne!(
                after(heading - turn + 3.0 * heading.signum(), 240).status,
                Status::Reached,
                "{heading}°, {behind:?}"
            );
        }
    }
}

/// When the patience with a target out of reach ends, the gaze returns to the animation; it resumes once it can reach
/// it.
#[test]
fn the_gaze_gives_up_after_its_patience() {
    for (target, behind) in
        [(at(130.0, 0.0), Behind::Off), (at(10.0, 88.0), Behind::Clip), (at(175.0, 0.0), Behind::Clip)]
    {
        let settings = Settings::default().with_patience(1.0).with_behind(behind);
        let mut rig = thug();
        let pose = upright(&rig);
        let mut jerk = Jerk::new(&rig);
        let mut most = 0.0_f32;
        for _ in 0..60 {
            aim(&mut rig, &pose, target, 1.0 / 60.0, &settings);
            jerk.watch(&rig, 1.0 / 60.0);
            most = most.max(turned(&rig.joints[1]));
        }
        assert!(most > 20.0, "{target}: {most}°");
        for _ in 0..150 {
            let outcome = aim(&mut rig, &pose, target, 1.0 / 60.0, &settings);
            jerk.watch(&rig, 1.0 / 60.0);
            assert!(matches!(outcome.status, Status::AtLimit | Status::Behind), "{outcome:?}");
        }
        assert!(rig.joints.iter().all(|joint| turned(joint) < 0.1), "{target}: {:?}", rig.joints);
        for _ in 0..120 {
            aim(&mut rig, &pose, at(40.0, 0.0), 1.0 / 60.0, &settings);
            jerk.watch(&rig, 1.0 / 60.0);
        }
        assert!(remaining64(&rig, &pose, 0, at(40.0, 0.0)) < 0.002);
    }
}

/// If budgets limit a turn well before the joints' own ranges, policies for targets behind follow the budgets.
#[test]
fn policies_for_targets_behind_use_the_budgets() {
    let after = |behind: Behind| {
        let mut rig = thug();
        for info in &mut rig.infos[1..] {
            *info = info.with_heading(-100.0 * DEG, 100.0 * DEG).with_pitch(-50.0 * DEG, 50.0 * DEG);
        }
        let pose = upright(&rig);
        let settings = Settings::default().with_behind(behind);
        let mut outcome = aim(&mut rig, &pose, at(170.0, 0.0), 1.0 / 60.0, &settings);
        for _ in 0..180 {
            outcome = aim(&mut rig, &pose, at(170.0, 0.0), 1.0 / 60.0, &settings);
        }
        (outcome.status, turned(&rig.joints[1]))
    };
    assert_eq!(after(Behind::Off).0, Status::AtLimit);
    for (behind, neck) in [(Behind::Clip, 60.0..=80.0), (Behind::Release, 0.0..=0.1), (Behind::Hold, 0.0..=0.1)] {
        let (status, turned) = after(behind);
        assert!(status == Status::Behind && neck.contains(&turned), "{behind:?}: {status:?}, {turned}°");
    }
}

/// A slight skew, as from rounded rotations, does not make a pose non-rigid, and the outcome is still right.
#[test]
fn a_slight_skew_leaves_the_outcome_exact() {
    let mut rng = Rng(5);
    for case in 0..2000 {
        let mut rig = thug();
        let mut pose = animated(&rig, &mut rng, 0.3);
        let joint = &mut pose[rng.below(3)].matrix3;
        joint.x_axis += joint.y_axis * rng.between(-1e-4, 1e-4);
        let target = EYE + 3.0 * rng.direction();
        let outcome = rig.snap(&Pose::new(pose.clone()), target);
        let truth = remaining64(&rig, &pose, 0, target);
        let apart = (f64::from(outcome.remaining) - truth).abs();
        assert!(apart < 1.2e-5, "case {case}: {outcome:?} instead of {truth}");
    }
}

/// A fade may end at any frame, as linear ones do: neither head nor chest overshoots its final position.
#[test]
fn fades_do_not_overshoot() {
    for (seconds, heading_deg) in [(0.2, 40.0), (0.4, 60.0), (1.0, 60.0)] {
        let mut rig = thug();
        let pose = upright(&rig);
        let target = at(heading_deg, 10.0);
        let mut fade = |weight: &dyn Fn(f32) -> f32| -> Vec<[[f32; 2]; 2]> {
            let frames = 0..240;
            let each = frames.map(|frame| {
                let settings = Settings::default().with_weight(weight(frame as f32 / 60.0 / seconds).clamp(0.0, 1.0));
                aim(&mut rig, &pose, target, 1.0 / 60.0, &settings);
                let [neck, chest] = [1, 2].map(|joint| angles(&rig.joints[joint]));
                // The neck compensates for a chest that is slower than the head.
                [[neck[0] + chest[0], neck[1] + chest[1]], chest]
            });
            each.collect()
        };
        for (way, turned) in [("in", fade(&|part| part)), ("out", fade(&|part| 1.0 - part))] {
            let [first, last] = [turned[0], turned[239]];
            for (frame, parts) in turned.iter().enumerate() {
                for (part, angle) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let [from, to, now] = [&first, &last, parts].map(|parts| parts[part][angle] / DEG);
                    let within = from.min(to) - 0.4..=from.max(to) + 0.4;
                    assert!(within.contains(&now), "{way} in {seconds} s: {now}° in frame {frame}, {from}° to {to}°");
                }
            }
            assert!((last[0][0] - first[0][0]).abs() > 10.0 * DEG, "{way}: the head is faded");
        }
    }
}
