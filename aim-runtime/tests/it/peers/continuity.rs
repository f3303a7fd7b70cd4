//! Sweeps: whatever a target passes, no angle moves faster than its rate.

use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::{Behind, Pose, Settings, Status};

use super::*;

/// Returns every solver with every policy for targets behind.
fn all_settings() -> impl Iterator<Item = Settings> {
    SOLVERS.into_iter().flat_map(|solver| {
        [Behind::Off, Behind::Clip, Behind::Hold, Behind::Release]
            .map(|behind| Settings::default().with_solver(solver).with_behind(behind))
    })
}

/// Aims at each target in turn; asserts that no frame's correction changes by more than both of its angles' rates
/// allow.
fn sweep(rig: &mut NumericRig, targets: impl Iterator<Item = Vec3>, settings: &Settings, case: &str) -> f32 {
    let pose = upright(rig);
    let posed = Pose::new(pose.clone());
    let mut largest = 0.0_f32;
    for target in targets {
        let (before, turned): (_, Vec<Quat>) = (rig.joints.clone(), rig.corrections().map(|(_, q)| q).collect());
        let outcome = rig.aim_with(&posed, target, DT, settings);
        assert_within_limits(rig, &before, DT, case);
        // Nearer than a centimetre, f32 does not resolve the angle that finely.
        if settings.weight == 1.0 && (target - Vec3::from(seen64(rig, &pose, 0).0.map(|x| x as f32))).length() > 0.01 {
            assert_true_outcome(rig, &pose, 0, target, &outcome, case);
        }
        for ((index, q), old) in rig.corrections().zip(turned) {
            let turn = 2.0 * (q * old.conjugate()).xyz().length().min(1.0).asin();
            assert!(turn <= 2.0 * rig.infos[index].rate * DT + 1e-5, "{case}: joint {index} turns by {turn}");
            largest = largest.max(turn);
        }
    }
    largest
}

/// Past the effector's up and down. Another solver turns by up to 27.6° in such a step.
#[test]
fn past_the_pole() {
    for settings in all_settings() {
        for beside in [-0.4, 5.0] {
            for below in [1.0, -1.0] {
                let along = (-45..=45).map(|step| step as f32 * 0.2);
                let targets = along.map(|past| {
                    let turn = Quat::from_rotation_x(past * DEG) * Quat::from_rotation_z(beside * DEG);
                    Vec3::new(-0.03, 1.68, -0.1) + turn * Vec3::Y * below * 2.0
                });
                sweep(&mut person(), targets, &settings, &format!("{settings:?}, {beside} beside"));
            }
        }
    }
}

/// Past straight behind. Another solver jumps by 179.9° at half the weight.
#[test]
fn past_behind() {
    for settings in all_settings() {
        for weight in [1.0, 0.5] {
            let along = (-60..=60).chain((-60..=60).rev()).map(|step| 180.0 + step as f32 * 0.1);
            let targets = along.map(|heading| {
                let turn = Quat::from_rotation_y(heading * DEG) * Quat::from_rotation_x(0.3 * DEG);
                Vec3::new(-0.03, 1.68, -0.1) + turn * WORLD[0] * 2.0
            });
            let settings = settings.with_weight(weight);
            sweep(&mut person(), targets, &settings, &format!("{settings:?}"));
        }
    }
}

#[test]
fn round_and_round() {
    for settings in all_settings() {
        for (seconds, radii) in [(4.0, &[0.3, 2.0][..]), (-8.0, &[2.0]), (0.7, &[2.0])] {
            for &radius in radii {
                let targets = (0..360).map(|frame| {
                    let turn = Quat::from_rotation_y(core::f32::consts::TAU * frame as f32 * DT / seconds);
                    Vec3::new(0.0, 1.6, 0.0) + turn * WORLD[0] * radius
                });
                sweep(&mut person(), targets, &settings, &format!("{settings:?}, {seconds} s, {radius} m"));
            }
        }
    }
}

/// Through the effector's origin and out again.
#[test]
fn through_the_effector() {
    for settings in all_settings() {
        for towards in [WORLD[0], WORLD[2], Vec3::new(0.1, 1.0, 0.2)] {
            let targets = (-120..=120).map(|step| Vec3::new(-0.03, 1.68, -0.1) + towards * (step as f32 * 1e-3));
            let mut rig = person();
            sweep(&mut rig, targets, &settings, &format!("{settings:?}, {towards}"));
            let pose = upright(&rig);
            let outcome = aim_for(&mut rig, &pose, Vec3::new(-1.0, 1.8, -2.0), 3.0, &settings);
            assert_eq!(outcome.status, Status::Reached, "{settings:?}, {towards}");
        }
    }
}

/// Off and on again while the target has moved elsewhere: no jerk towards its old position.
#[test]
fn weight_off_and_on() {
    for settings in all_settings() {
        let mut rig = person();
        let places = [Vec3::new(-2.0, 1.7, -1.0), Vec3::new(2.0, 1.5, -1.0), Vec3::new(0.0, 1.6, 3.0)];
        for (place, weight) in places.into_iter().flat_map(|place| [(place, 1.0), (-place, 0.0), (place, 0.3)]) {
            let settings = settings.with_weight(weight);
            sweep(&mut rig, core::iter::repeat_n(place, 45), &settings, &format!("{settings:?}"));
        }
    }
}
