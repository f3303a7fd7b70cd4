//! Targets behind: each policy, its boundaries, and the turn to the other side.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "frames are counted")]

use crate::common::*;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Behind, Joint, Outcome, Pose, Role, Settings, Solver, Status};

const POLICIES: [Behind; 4] = [Behind::Off, Behind::Clip, Behind::Hold, Behind::Release];

/// Returns a target this many degrees to the left of straight ahead, at eye height.
fn at(heading_deg: f32) -> Vec3 {
    Vec3::new(-0.03, 1.68, -0.1) + Quat::from_rotation_y(heading_deg * DEG) * WORLD[0] * 3.0
}

/// Runs one frame and asserts that no angle exceeds its rate or its range.
fn aim(rig: &mut NumericRig, target: Vec3, policy: Behind) -> Outcome {
    let before = rig.joints.clone();
    let pose = Pose::new(upright(rig));
    let outcome = rig.aim_with(&pose, target, 1.0 / 60.0, &Settings::default().with_behind(policy));
    for ((info, old), new) in rig.infos.iter().zip(&before).zip(&rig.joints) {
        for (range, old, new) in [(info.heading, old.heading(), new.heading()), (info.pitch, old.pitch(), new.pitch())]
        {
            assert!((new - old).abs() <= info.rate / 60.0 + 1e-6, "{policy:?}: {old} to {new}");
            assert!(range.is_some_and(|[lo, hi]| (lo..=hi).contains(&new)), "{policy:?}: {new}");
        }
    }
    assert!(sound(rig));
    outcome
}

fn angles(rig: &NumericRig) -> Vec<(f32, f32)> {
    rig.joints.iter().map(|joint| (joint.heading(), joint.pitch())).collect()
}

/// Returns a thug after following a target from straight ahead to this heading, degrees.
fn following(policy: Behind, to_deg: f32) -> NumericRig {
    let mut rig = NumericRig::thug();
    let frames = 120;
    for frame in 0..=frames {
        aim(&mut rig, at(to_deg * frame as f32 / frames as f32), policy);
    }
    rig
}

#[test]
fn hold_keeps_the_angles() {
    for side in [1.0, -1.0] {
        let mut rig = following(Behind::Hold, side * 149.0);
        for _ in 0..60 {
            assert_eq!(aim(&mut rig, at(side * 149.0), Behind::Hold).status, Status::AtLimit);
        }
        let held = angles(&rig);
        for heading in [151.0, 170.0, 180.0, 190.0, 209.0, 219.0] {
            assert_eq!(aim(&mut rig, at(side * heading), Behind::Hold).status, Status::Behind);
            assert_eq!(angles(&rig), held, "{heading}");
        }
        // On the other side the target counts as behind until 10° past the boundary; then it is followed there.
        assert_eq!(aim(&mut rig, at(side * 221.0), Behind::Hold).status, Status::AtLimit);
        for _ in 0..120 {
            aim(&mut rig, at(side * 235.0), Behind::Hold);
        }
        assert!(rig.joints[1].heading() * side < -50.0 * DEG, "{:?}", rig.joints);
    }
}

/// `Behind::Hold` does not keep joints outside a range that has changed.
#[test]
fn hold_returns_joints_to_a_shrunken_range() {
    let mut rig = following(Behind::Hold, 149.0);
    rig.infos[1].heading = Some([-60.0 * DEG, 20.0 * DEG]);
    let pose = Pose::new(upright(&rig));
    let settings = Settings::default().with_behind(Behind::Hold);
    let mut last = rig.joints[1].heading();
    while last > 20.0 * DEG {
        let outcome = rig.aim_with(&pose, at(180.0), 1.0 / 60.0, &settings);
        let heading = rig.joints[1].heading();
        assert_eq!(outcome.recovering.contains(1), heading > 20.0 * DEG);
        assert!(outcome.status == Status::Behind && heading < last && last - heading <= 170.0 * DEG / 60.0 + 1e-6);
        last = heading;
    }
}

#[test]
fn release_returns_to_the_animation() {
    let mut rig = following(Behind::Release, 149.0);
    assert!(rig.joints[1].heading() > 50.0 * DEG);
    for _ in 0..60 {
        assert_eq!(aim(&mut rig, at(160.0), Behind::Release).status, Status::Behind);
    }
    assert!(rig.corrections().all(|(_, q)| q == Quat::IDENTITY));
    // Still behind until it is 10° in front of the boundary.
    assert_eq!(aim(&mut rig, at(141.0), Behind::Release).status, Status::Behind);
    assert_eq!(angles(&rig), [(0.0, 0.0); 3]);
    assert_eq!(aim(&mut rig, at(139.0), Behind::Release).status, Status::AtLimit);
    assert!(rig.joints[1].heading() > 0.0);
}

/// A target that trembles at the boundary does not switch the policy on and off.
#[test]
fn a_target_jittering_at_the_boundary_does_not_toggle_the_policy() {
    for policy in [Behind::Clip, Behind::Hold, Behind::Release] {
        let mut rig = following(policy, 149.0);
        aim(&mut rig, at(152.0), policy);
        let mut rng = Rng(4);
        for _ in 0..200 {
            assert_eq!(aim(&mut rig, at(150.0 + rng.between(-8.0, 8.0)), policy).status, Status::Behind);
        }
    }
}

/// Without a policy the target counts as merely out of reach, and the joints stay on their side while it trembles
/// behind.
#[test]
fn off_reports_a_target_behind_as_out_of_reach() {
    let mut rig = following(Behind::Off, 170.0);
    assert!(rig.joints[1].heading() > 55.0 * DEG);
    let mut rng = Rng(4);
    for _ in 0..200 {
        let outcome = aim(&mut rig, at(180.0 + rng.between(-2.0, 2.0)), Behind::Off);
        assert_eq!(outcome.status, Status::AtLimit);
        assert!(rig.joints[1].heading() > 55.0 * DEG);
    }
}

/// Orbits in both directions: under every policy the target is followed on the other side, without a jump.
#[test]
fn an_orbiting_target_is_followed_again_on_the_other_side() {
    for policy in POLICIES {
        for turn in [1.0, -1.0] {
            let mut rig = NumericRig::thug();
            let mut reached = 0;
            let frames = 8 * 60;
            for frame in 0..2 * frames {
                let outcome = aim(&mut rig, at(turn * 360.0 * (frame % frames) as f32 / frames as f32), policy);
                reached += usize::from(outcome.status == Status::Reached);
            }
            // Reached within ±115° of straight ahead, except while turning to the other side.
            let within = 2 * frames * 230 / 360;
            assert!(reached > within - 2 * 60, "{policy:?}: {reached} of {within}");
        }
    }
}

/// A snap applies the policy immediately and forgets that the target was behind.
#[test]
fn a_snap_applies_the_policy_at_once() {
    let snap = |rig: &mut NumericRig, heading: f32, policy: Behind| {
        let pose = Pose::new(upright(rig));
        rig.snap_with(&pose, at(heading), &Settings::default().with_behind(policy)).status
    };
    let mut rig = following(Behind::Hold, 100.0);
    let held = angles(&rig);
    assert_eq!(snap(&mut rig, 170.0, Behind::Hold), Status::Behind);
    assert_eq!(angles(&rig), held);
    assert_eq!(snap(&mut rig, 170.0, Behind::Release), Status::Behind);
    assert_eq!(angles(&rig), [(0.0, 0.0); 3]);
    assert_eq!(snap(&mut rig, 145.0, Behind::Release), Status::AtLimit);
    assert!(rig.joints[1].heading() > 50.0 * DEG);
    assert_eq!(snap(&mut rig, 180.0, Behind::Clip), Status::Behind);
    assert!(rig.joints[1].heading() > 50.0 * DEG);
    rig.joints = vec![Joint::default(); 3];
    assert_eq!(snap(&mut rig, 180.0, Behind::Off), Status::AtLimit);
}

/// For a rig that can look everywhere, no target is behind.
#[test]
fn within_reach_nothing_is_behind() {
    for policy in POLICIES {
        let mut rig = NumericRig::ball(THUG);
        let pose = Pose::new(vec![bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]);
        let settings = Settings::default().with_behind(policy);
        for _ in 0..60 {
            rig.aim_with(&pose, -WORLD[0] + 0.01 * WORLD[2], 1.0 / 60.0, &settings);
        }
        assert!(rig.joints[0].heading() > 178.0 * DEG);
    }
}

/// Joints that arrive first on the other side wait there for the others: no pitch oscillates.
#[test]
fn turning_round_does_not_chatter() {
    let (mut reversals, mut turns) = (0, 0);
    for (seconds, height, turn) in [(10.0, 0.0, 1.0), (6.0, 0.0, 1.0), (6.0, 0.3, -1.0), (8.0, -0.4, 1.0)] {
        let mut rig = NumericRig::thug();
        let settings = Settings::default().with_solver(Solver::Exact);
        let mut angles: [Vec<[f32; 2]>; 3] = Default::default();
        for frame in 0..600 {
            let t = frame as f32 / 60.0;
            // The body breathes and sways, as in animations.
            let sway = Quat::from_rotation_x(0.03 * (2.0 * t).sin()) * Quat::from_rotation_y(0.04 * (1.3 * t).cos());
            let pose: Vec<Affine3A> = upright(&rig).iter().map(|bone| Affine3A::from_quat(sway) * *bone).collect();
            let target = at(turn * 360.0 * t / seconds) + Vec3::Y * height;
            let outcome = rig.aim_with(&Pose::new(pose), target, 1.0 / 60.0, &settings);
            turns += usize::from(outcome.status != Status::Reached && outcome.remaining > 1.8);
            for (angles, joint) in angles.iter_mut().zip(&rig.joints) {
                angles.push([joint.pitch(), joint.heading()]);
            }
        }
        for three in angles.iter().flat_map(|angles| angles.windows(3)) {
            for (a, (b, c)) in three[0].iter().zip(three[1].iter().zip(three[2])) {
                let [before, after] = [b - a, c - b];
                reversals += usize::from(before * after < 0.0 && before.abs().min(after.abs()) > 0.2 * DEG);
            }
        }
    }
    assert!(turns > 40, "{turns} frames of turning round");
    assert!(reversals <= 8, "{reversals} reversals");
}

/// Returns a thug with the roles eye, neck and chest.
fn with_roles() -> NumericRig {
    let mut rig = NumericRig::thug();
    for (info, role) in rig.infos.iter_mut().zip([Role::Eye, Role::Neck, Role::Chest]) {
        *info = info.with_role(role);
    }
    rig
}

/// Returns heading (to the left) and elevation of the first joint's gaze, degrees from straight ahead.
fn gaze(rig: &NumericRig) -> [f32; 2] {
    let [x, y, z] = gaze64(rig, &upright(rig), 0).1.map(|x| x as f32);
    [(-x).atan2(-z) / DEG, y.asin() / DEG]
}

/// With `Behind::Plane`, a target behind is projected onto a plane in front, at most 80° to the side and at its own
/// height. A target in front of the plane is not changed. Holds for both solvers.
#[test]
fn a_plane_in_front_clips_the_target() {
    for solver in [Solver::Exact, Solver::Natural] {
        for heading in [0.0, 40.0, 79.0, 85.0, 100.0, 120.0, 150.0, 170.0, 180.0, 190.0, 240.0, 275.0, 300.0_f32] {
            for height in [-0.4, 0.0, 0.5_f32] {
                let mut rig = with_roles();
                let settings = Settings::default().with_behind(Behind::Plane).with_solver(solver);
                let pose = Pose::new(upright(&rig));
                let target = at(heading) + height * Vec3::Y;
                let mut outcome = rig.aim_with(&pose, target, 1.0 / 60.0, &settings);
                for _ in 0..240 {
                    outcome = rig.aim_with(&pose, target, 1.0 / 60.0, &settings);
                }
                let (sin, cos) = (heading * DEG).sin_cos();
                let expected = [sin.atan2(cos.max((80.0 * DEG).cos())) / DEG, (height / 3.0).atan() / DEG];
                let found = gaze(&rig);
                let case = format!("{solver:?}, {heading}°, {height}: {found:?} for {expected:?}, {outcome:?}");
                // The eye moves with the head, by some centimetres.
                assert!((0..2).all(|axis| (found[axis] - expected[axis]).abs() < 3.0), "{case}");
                let is_off = cos < (80.0 * DEG).cos();
                assert_eq!(outcome.status, if is_off { Status::Behind } else { Status::Reached }, "{case}");
            }
        }
    }
}

/// Orbits in both directions, with both solvers: the gaze returns through the front without a jump, more slowly than
/// its rates allow.
#[test]
fn a_plane_in_front_is_continuous() {
    for solver in [Solver::Exact, Solver::Natural] {
        for turn in [1.0, -1.0] {
            let mut rig = with_roles();
            let settings = Settings::default().with_behind(Behind::Plane).with_solver(solver);
            let pose = Pose::new(upright(&rig));
            rig.snap_with(&pose, at(0.0), &settings);
            let (mut last, mut fastest, mut widest) = (gaze(&rig), 0.0_f32, 0.0_f32);
            for frame in 0..2 * 24 * 60 {
                rig.aim_with(&pose, at(turn * frame as f32 / 4.0), 1.0 / 60.0, &settings);
                let now = gaze(&rig);
                fastest = fastest.max((now[0] - last[0]).abs());
                widest = widest.max(now[0].abs());
                assert!(now[1].abs() < 3.0, "{solver:?}, frame {frame}: level, not {now:?}");
                last = now;
            }
            // At the back, the projected target moves tan 80° times as fast as the target itself: 1.4° per frame.
            assert!(fastest < 2.0 && (75.0..83.0).contains(&widest), "{solver:?}: {fastest}° a frame, {widest}°");
        }
    }
}
