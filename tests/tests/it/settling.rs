//! With a still pose and target, a reachable target is reached in the time that the rates allow, and then nothing
//! moves.

use aim::glam::{Affine3A, Quat, Vec3};
use aim::rigs::{Thug, Turret};
use aim::{Aim, AimRig, Pose, Settings, Status};
use aim_tests::random::Random;
use aim_tests::scale::in_full;

const FRAME: f32 = 1.0 / 60.0;

/// Returns the pose of a standing thug, +Y up, facing +Z, in metres.
fn standing() -> Pose<[Affine3A; 3]> {
    let upright = Quat::from_xyzw(0.5, 0.5, 0.5, 0.5);
    let at = |y, z| Affine3A::from_rotation_translation(upright, Vec3::new(0.0, y, z));
    Pose::new([at(1.66, 0.09), at(1.51, 0.0), at(1.37, 0.0)])
}

/// Returns a target two metres from the eyes, this far to the left and up.
fn direction(azimuth_deg: f32, elevation_deg: f32) -> Vec3 {
    let (sin_a, cos_a) = azimuth_deg.to_radians().sin_cos();
    let (sin_e, cos_e) = elevation_deg.to_radians().sin_cos();
    Vec3::new(0.0, 1.66, 0.0) + 2.0 * Vec3::new(sin_a * cos_e, sin_e, cos_a * cos_e)
}

/// Aims for five seconds, far longer than any movement takes, and returns the status and the largest movement of an
/// angle in the last second.
fn settle<R: AimRig>(rig: &mut Aim<R>, pose: &Pose<R::Array<Affine3A>>, target: Vec3) -> (Status, f32) {
    let mut moved: f32 = 0.0;
    let mut status = Status::Degenerate;
    for frame in 0..300 {
        let before = rig.state.joints;
        status = rig.aim(pose, target, FRAME, &Settings::default()).outcome.status;
        if frame >= 240 {
            for (a, b) in before.as_ref().iter().zip(rig.state.joints.as_ref()) {
                moved = moved.max((a.heading() - b.heading()).abs()).max((a.pitch() - b.pitch()).abs());
            }
        }
    }
    (status, moved)
}

#[test]
fn a_reachable_target_is_reached_whatever_was_looked_at_before() {
    let pose = standing();
    let (mut reached, mut pairs) = (0, Vec::new());
    for before in (0..12).flat_map(|a| [-30.0, 0.0, 30.0].map(|e| (30.0 * a as f32 - 180.0, e))) {
        for target in (0..8).flat_map(|a| [-25.0, 5.0, 30.0].map(|e| (45.0 * a as f32 - 180.0, e))) {
            pairs.push((before, target));
        }
    }
    // Seven divides neither number of directions, so all of them occur.
    let step = if in_full() { 1 } else { 7 };
    for (before, target) in pairs.into_iter().step_by(step) {
        let target_ws = direction(target.0, target.1);
        let settings = Settings::default();
        let mut free = Aim::<Thug>::new();
        let reachable = free.snap(&pose, target_ws, &settings).outcome.status == Status::Reached;
        let mut thug = Aim::<Thug>::new();
        let _ = thug.snap(&pose, direction(before.0, before.1), &settings);
        let (status, moved) = settle(&mut thug, &pose, target_ws);
        assert_eq!(status == Status::Reached, reachable, "{before:?}, then {target:?}: {status:?}, {thug:?}");
        assert!(moved < 0.2_f32.to_radians(), "{before:?}, then {target:?}: {status:?} and moves {moved}");
        reached += usize::from(reachable);
    }
    assert!(reached * step > 200, "{reached}");
}

#[test]
fn a_turret_comes_to_rest_wherever_its_target_stands() {
    let mut random = Random::new(5);
    for tilt in [0.0_f32, 0.3, 1.1] {
        let base = Affine3A::from_rotation_z(tilt);
        let pose = Pose::new([base * Affine3A::from_translation(0.4 * Vec3::Y), base]);
        for number in 0..150 {
            #[expect(clippy::cast_possible_truncation, reason = "any place near the turret will do")]
            let target = Vec3::from_array(random.vector(1.5).map(|c| c as f32));
            let mut turret = Aim::<Turret>::new();
            let (status, moved) = settle(&mut turret, &pose, target);
            assert!(moved < 0.2_f32.to_radians(), "tilt {tilt}, {number}, {target}: {status:?} and moves {moved}");
        }
    }
}
