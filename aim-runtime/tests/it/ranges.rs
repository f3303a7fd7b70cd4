//! Ranges of motion: relative to the bind pose, and narrowing with the heading.

use crate::common::*;
use crate::shaken::eyeless;
use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::{Joint, LimitsFrom, Pose, Settings, Status};

/// Returns the thug with absolute ranges.
fn absolute() -> NumericRig {
    let mut rig = NumericRig::thug();
    for info in &mut rig.infos {
        info.limits_from = LimitsFrom::BindPose;
    }
    rig
}

/// Returns the upright thug with its neck (and the eye with it) turned by these angles in world space.
fn with_neck_turned(rig: &NumericRig, heading: f32, pitch: f32) -> Vec<Affine3A> {
    let mut pose = upright(rig);
    let turn = Quat::from_rotation_y(heading) * Quat::from_rotation_x(pitch);
    let about = Affine3A::from_translation(pose[1].translation.into())
        * Affine3A::from_quat(turn)
        * Affine3A::from_translation(-Vec3::from(pose[1].translation));
    for joint in &mut pose[..2] {
        *joint = about * *joint;
    }
    pose
}

fn at(heading: f32, pitch: f32) -> Vec3 {
    Vec3::new(-0.03, 1.65, -0.1) + Quat::from_rotation_y(heading) * Quat::from_rotation_x(pitch) * WORLD[0] * 20.0
}

/// Aims for two seconds; asserts that no frame exceeds a rate.
fn settle(rig: &mut NumericRig, pose: &Pose<Vec<Affine3A>>, target: Vec3) -> Status {
    let mut status = Status::Degenerate;
    for _ in 0..120 {
        let before = rig.joints.clone();
        status = rig.aim(pose, target, 1.0 / 60.0).status;
        for ((info, old), new) in rig.infos.iter().zip(&before).zip(&rig.joints) {
            let moved = (new.heading() - old.heading()).abs().max((new.pitch() - old.pitch()).abs());
            assert!(moved <= info.rate / 60.0 + 1e-6, "moved {moved}");
        }
    }
    status
}

/// The animation's own turn counts towards the range: less may be added on that side, and more on the other.
#[test]
fn bind_pose_limits_include_the_animation() {
    for (name, parent, similar) in parents() {
        for scale in [0.01, 1.0, 100.0] {
            let world = Affine3A::from_scale(Vec3::splat(scale)) * parent;
            let placed = |pose: Vec<Affine3A>| pose.iter().map(|joint| world * *joint).collect::<Vec<_>>();
            let rig = absolute();
            let bind = placed(upright(&rig));
            let turned = placed(with_neck_turned(&rig, 40.0 * DEG, 0.0));
            for (target, neck) in [(at(130.0 * DEG, 0.0), 20.0 * DEG), (at(-130.0 * DEG, 0.0), -100.0 * DEG)] {
                let mut rig = rig.clone();
                let pose = Pose::new(turned.clone()).with_bind(bind.clone());
                settle(&mut rig, &pose, world.transform_point3(target));
                // A stretched world stretches the animation's angle.
                let near = if similar { 1e-3 } else { 0.5 };
                let heading = rig.joints[1].heading();
                assert!((heading - neck).abs() < near, "{name} × {scale}: {}", heading / DEG);
            }
        }
    }
}

/// If the animation itself exceeds a range, the joint is not moved further out, and it returns only as far as the
/// target requires.
#[test]
fn an_animation_outside_its_range_is_not_corrected() {
    let mut rig = absolute();
    let bind = upright(&rig);
    let pose = Pose::new(with_neck_turned(&rig, 80.0 * DEG, 0.0)).with_bind(bind);
    settle(&mut rig, &pose, at(80.0 * DEG, 0.0));
    assert!((-0.3 * DEG..=0.0).contains(&rig.joints[1].heading()));
    settle(&mut rig, &pose, at(150.0 * DEG, 0.0));
    assert_eq!(rig.joints[1].heading(), 0.0);
    assert!(settle(&mut rig, &pose, at(20.0 * DEG, 0.0)) == Status::Reached);
    assert!(rig.joints[1].heading() < -10.0 * DEG);
}

/// At weight 0, an animation is not held back when it leaves its range, however fast.
#[test]
fn at_weight_zero_an_animation_may_leave_its_range() {
    for speed in [50.0, 200.0, 600.0] {
        let mut rig = eyeless();
        for info in &mut rig.infos {
            info.limits_from = LimitsFrom::BindPose;
        }
        let (bind, settings) = (upright(&rig), Settings::default().with_weight(0.0));
        for frame in 0..120_u8 {
            let t = f32::from(frame) / 60.0;
            let turned = with_neck_turned(&rig, (speed * t).min(120.0) * DEG, 0.0);
            rig.aim_with(&Pose::new(turned).with_bind(bind.clone()), at(0.0, 0.0), 1.0 / 60.0, &settings);
            assert!(rig.corrections().all(|(_, q)| q == Quat::IDENTITY), "{speed}°/s, {t} s: {:?}", rig.joints);
        }
    }
}

/// Without a bind pose, or with one that has no rotation, absolute ranges are relative.
#[test]
fn bind_pose_limits_need_a_bind_pose() {
    let target = at(130.0 * DEG, 0.0);
    let mut relative = NumericRig::thug();
    let turned = with_neck_turned(&relative, 40.0 * DEG, 0.0);
    let flat = vec![Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0)); 3];
    let nan = vec![Affine3A::from_scale(Vec3::NAN); 3];
    settle(&mut relative, &Pose::new(turned.clone()), target);
    for bind in [None, Some(flat), Some(nan)] {
        let mut rig = absolute();
        let mut pose = Pose::new(turned.clone());
        pose.bind = bind;
        settle(&mut rig, &pose, target);
        assert_eq!(rig.joints, relative.joints);
    }
}

/// If the animation moves, the added angles follow their moving ranges at their rates.
#[test]
fn bind_pose_limits_move_with_the_animation() {
    let mut rng = Rng(77);
    let mut rig = absolute();
    let bind = upright(&rig);
    let (mut heading, mut pitch) = (0.0, 0.0);
    let mut target = at(0.5, 0.0);
    for frame in 0..3000 {
        if rng.below(40) == 0 {
            (heading, pitch) = (rng.between(-1.5, 1.5), rng.between(-1.5, 1.5));
            target = at(rng.between(-3.0, 3.0), rng.between(-1.0, 1.0));
        }
        let mut joints = with_neck_turned(&rig, heading, pitch);
        let straight_up = Quat::from_rotation_x(90.0 * DEG);
        if rng.below(100) == 0 {
            joints[0].matrix3 = Mat3A::from_quat(straight_up) * joints[0].matrix3;
        }
        let before = rig.joints.clone();
        let outcome = rig.aim(&Pose::new(joints).with_bind(bind.clone()), target, 1.0 / 60.0);
        assert!(sound(&rig));
        for (index, ((info, old), new)) in rig.infos.iter().zip(&before).zip(&rig.joints).enumerate() {
            let moves = [new.heading() - old.heading(), new.pitch() - old.pitch()];
            let moved = moves[0].abs().max(moves[1].abs());
            assert!(moved <= info.rate / 60.0 + 1e-6, "frame {frame}: joint {index} moved {moved}");
            if outcome.recovering.contains(index) {
                assert!(moved >= info.rate / 60.0 - 1e-5, "frame {frame}: joint {index} recovers by {moved}");
            }
        }
    }
}

/// The range of the pitch narrows towards the ends of the heading's, in snaps and in every frame.
#[test]
fn pitch_narrows_with_the_heading() {
    let mut rig = NumericRig::thug();
    for (info, narrowing) in rig.infos.iter_mut().zip([0.5, 0.25, 1.0]) {
        info.pitch_taper = narrowing;
    }
    // Narrows faster than the pitch can follow.
    rig.infos[2].pitch = Some([-40.0 * DEG, 40.0 * DEG]);
    let end = |[lo, hi]: [f32; 2], angle: f32| if angle < 0.0 { lo } else { hi };
    let outside = |rig: &NumericRig, index: usize, joint: &Joint| {
        let info = &rig.infos[index];
        let heading_end = end(info.heading.unwrap(), joint.heading());
        let kept = 1.0 - info.pitch_taper * joint.heading() / heading_end;
        let pitch_end = end(info.pitch.unwrap(), joint.pitch());
        joint.pitch().abs() - pitch_end.abs() * kept
    };
    let mut rng = Rng(8);
    let mut target = at(0.0, 0.0);
    let (mut narrowed, mut recovered) = (0, 0);
    for frame in 0..3000 {
        let snap = rng.below(50) == 0;
        if rng.below(30) == 0 {
            target = at(rng.between(-3.0, 3.0), rng.between(-1.2, 1.2));
        }
        let pose = Pose::new(upright(&rig));
        let before = rig.joints.clone();
        let outcome = if snap { rig.snap(&pose, target) } else { rig.aim(&pose, target, 1.0 / 60.0) };
        for (index, old) in before.iter().enumerate() {
            let new = rig.joints[index];
            let out = outside(&rig, index, &new);
            let step = rig.infos[index].rate / 60.0;
            // A violation in the last bit may be reported as recovering.
            if !(0.0..=1e-6).contains(&out) {
                assert_eq!(outcome.recovering.contains(index), out > 1e-6, "frame {frame}, joint {index}: {out}");
            }
            if out > 1e-6 {
                let back = (old.pitch().abs() - new.pitch().abs() - step).abs();
                assert!(back < 1e-5, "frame {frame}, joint {index} goes back at its rate");
                recovered += 1;
            }
            narrowed += usize::from(out.abs() < 1e-6 && new.heading().abs() > 0.1);
        }
    }
    assert!(narrowed > 100 && recovered > 10, "{narrowed} {recovered}");
}
