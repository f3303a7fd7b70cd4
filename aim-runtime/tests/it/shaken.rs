//! A head whose animation shakes it. Without eyes, it must itself stay on the target.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "frames are counted")]

use crate::common::*;
use crate::natural::{FRAME_RATES, aim, at, thug};
use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::{Role, Settings};

/// Returns the thug's joints as head, neck and chest: without eyes, the head leads.
pub(crate) fn eyeless() -> NumericRig {
    let mut rig = thug();
    for (info, role) in rig.infos.iter_mut().zip([Role::Head, Role::Neck, Role::Chest]) {
        *info = info.with_role(role).with_heading(-60.0 * DEG, 60.0 * DEG);
    }
    rig
}

/// Runs 8 s of a head without eyes whose animation turns it by `turn_at(t)` radians. After `from_s` seconds, calls
/// `look` in each frame with the rig and its remaining angle in degrees.
fn shaken(hz: f32, from_s: f32, turn_at: impl Fn(f32) -> f32, mut look: impl FnMut(&NumericRig, f64)) {
    let (mut rig, target) = (eyeless(), at(25.0, 0.0));
    for frame in 0..(8.0 * hz) as usize {
        let t = frame as f32 / hz;
        let mut pose = upright(&rig);
        pose[0].matrix3 = Mat3A::from_quat(Quat::from_rotation_y(turn_at(t))) * pose[0].matrix3;
        aim(&mut rig, &pose, target, 1.0 / hz, &Settings::default());
        if t > from_s {
            look(&rig, remaining64(&rig, &pose, 0, target).to_degrees());
        }
    }
}

/// Returns the largest remaining angle after `from_s` seconds, degrees.
fn worst_shaken(hz: f32, from_s: f32, turn_at: impl Fn(f32) -> f32) -> f64 {
    let mut worst = 0.0_f64;
    shaken(hz, from_s, turn_at, |_, off| worst = worst.max(off));
    worst
}

/// Shaking that needs less than 0.45 of the head's acceleration is compensated. Of faster shaking, the head compensates
/// a part; where it can compensate hardly any, the error is about the shaking itself.
#[test]
fn shaking_is_not_amplified() {
    const SWING_DEG: f32 = 12.0;
    for hz in FRAME_RATES {
        for tenths in [5, 10, 15, 16, 18, 20, 25, 30, 40, 50] {
            let swings_hz = tenths as f32 / 10.0;
            let worst = worst_shaken(hz, 2.0, |t| SWING_DEG * DEG * (std::f32::consts::TAU * swings_hz * t).sin());
            let most = f64::from(SWING_DEG) * if tenths <= 15 { 0.75 } else { 1.25 };
            let most = if tenths <= 10 { 0.1 } else { most };
            assert!(worst < most, "{swings_hz} Hz at {hz} frames a second: {worst}° of {SWING_DEG}°");
        }
    }
}

/// Shaking far beyond its acceleration does not swing a head without eyes between the extremes of it.
#[test]
fn shaking_does_not_reverse_the_head() {
    const ACCELERATION_DEG_S2: f32 = 1200.0;
    for hz in [60.0, 120.0, 144.0] {
        let mut headings = Vec::new();
        let turn_at = |t: f32| 12.0 * DEG * (std::f32::consts::TAU * 4.0 * t).sin();
        shaken(hz, 2.0, turn_at, |rig, _| {
            let [head, neck] = [0, 1].map(|joint| rig.joints[joint].heading());
            headings.push((head + neck).to_degrees());
        });
        let gains = headings.windows(3).map(|three| (three[0] - 2.0 * three[1] + three[2]) * hz * hz);
        let most = gains.fold(0.0_f32, |most, gain| most.max(gain.abs())) / ACCELERATION_DEG_S2;
        assert!(most < 0.55, "{most} of the acceleration at {hz} frames a second");
    }
}

/// Oscillation between −1 and 1: a function of time in seconds and frequency in hertz.
type Wave = fn(f32, f32) -> f32;

/// A sine sampled by keys ten times a second, with linear interpolation.
fn keyed(t: f32, swings_hz: f32) -> f32 {
    let key = (10.0 * t).floor();
    let [from, to] = [key, key + 1.0].map(|key| (std::f32::consts::TAU * 0.1 * key * swings_hz).sin());
    from + (to - from) * (10.0 * t - key)
}

/// Triangle wave.
fn triangle(t: f32, swings_hz: f32) -> f32 {
    1.0 - 4.0 * ((t * swings_hz).fract() - 0.5).abs()
}

/// Sawtooth wave that rises slowly and falls quickly.
fn saw(t: f32, swings_hz: f32) -> f32 {
    let phase = (t * swings_hz).fract();
    if phase < 0.7 { 2.0 * phase / 0.7 - 1.0 } else { 1.0 - 2.0 * (phase - 0.7) / 0.3 }
}

/// If the animation reverses abruptly, like one with ten keys a second, or is faster in one direction, the error is
/// less than the peak-to-peak shaking, and the head does not drift away. At 0.5 Hz, the speed v changes by at most 57°/s,
/// which 0.45 of the acceleration a takes v²/0.9a = 3° to follow.
#[test]
fn a_head_that_is_thrown_to_and_fro_does_not_drift() {
    const SWING_DEG: f32 = 12.0;
    let waves: [(&str, Wave); 3] = [("keyed", keyed), ("triangle", triangle), ("saw", saw)];
    for hz in FRAME_RATES {
        for (name, wave) in waves {
            for swings_hz in [0.5, 1.4, 1.8, 2.3, 3.0, 4.0] {
                let worst = worst_shaken(hz, 4.0, |t| SWING_DEG * DEG * wave(t, swings_hz));
                let most = if swings_hz < 1.0 { 3.5 } else { 2.0 * f64::from(SWING_DEG) };
                assert!(worst < most, "{name}, {swings_hz} Hz at {hz} frames a second: {worst}°");
            }
        }
    }
}

/// A body that jerks ten times a second, as with keys a tenth of a second apart, by less than the head's acceleration
/// can compensate: the head absorbs each jerk in two frames, and its acceleration does not jump between extremes.
#[test]
fn jerks_of_the_body_do_not_reverse_the_head() {
    const ACCELERATION_DEG_S2: f32 = 1200.0;
    const JERKS_HZ: f32 = 10.0;
    for hz in [30.0, 60.0, 120.0] {
        // A triangle wave's velocity changes by 8 · swing · frequency when it reverses.
        let jerk_deg_s = 0.8 * ACCELERATION_DEG_S2 / hz;
        let swing_deg = jerk_deg_s / (4.0 * JERKS_HZ);
        let (mut headings, mut worst) = (Vec::new(), 0.0_f64);
        let turn_at = |t| swing_deg * DEG * triangle(t + 0.001, 0.5 * JERKS_HZ);
        shaken(hz, 2.0, turn_at, |rig, off| {
            let [head, neck] = [0, 1].map(|joint| rig.joints[joint].heading());
            headings.push((head + neck).to_degrees());
            worst = worst.max(off);
        });
        let accelerations: Vec<f32> =
            headings.windows(3).map(|three| (three[0] - 2.0 * three[1] + three[2]) * hz * hz).collect();
        let peaks = accelerations
            .iter()
            .map(|gain| gain / ACCELERATION_DEG_S2)
            .fold([0.0_f32; 2], |[most, least], gain| [most.max(gain), least.min(gain)]);
        assert!(peaks[0] < 0.6 && peaks[1] > -0.6, "{peaks:?} of the acceleration at {hz} frames a second");
        assert!(worst < 0.4 * f64::from(jerk_deg_s / hz), "{worst}° off at {hz} frames a second");
    }
}

/// Nods of the animation, with 30 keys a second, do not swing a head with eyes between the extremes of its acceleration.
/// The eyes keep the target meanwhile.
#[test]
fn nods_of_the_animation_do_not_reverse_a_head_with_eyes() {
    const ACCELERATION: f32 = 1200.0 * DEG;
    let (hz, keys_hz) = (60.0_f32, 30.0_f32);
    for nods_hz in [1.2, 1.7] {
        let (mut rig, target) = (thug(), at(50.0, 0.0));
        let mut pitches = Vec::new();
        for frame in 0..(6.0 * hz) as usize {
            let t = frame as f32 / hz;
            let key = (keys_hz * t).floor();
            let [from, to] = [key, key + 1.0].map(|key| (std::f32::consts::TAU * key / keys_hz * nods_hz).sin());
            let nod = 11.0 * DEG * (from + (to - from) * (keys_hz * t - key));
            let mut pose = upright(&rig);
            let neck = Affine3A::from_translation(pose[1].translation.into());
            for joint in &mut pose[..2] {
                *joint = neck * Affine3A::from_rotation_x(nod) * neck.inverse() * *joint;
            }
            let outcome = aim(&mut rig, &pose, target, 1.0 / hz, &Settings::default());
            if t > 2.0 {
                pitches.push(rig.joints[1].pitch());
                assert!(outcome.remaining < 0.5 * DEG, "{nods_hz} Hz, {t} s: {}° off", outcome.remaining / DEG);
            }
        }
        let gains = pitches.windows(3).map(|three| (three[0] - 2.0 * three[1] + three[2]) * hz * hz / ACCELERATION);
        let [most, least] = gains.fold([0.0_f32; 2], |[most, least], gain| [most.max(gain), least.min(gain)]);
        assert!(most < 0.5 && least > -0.5, "{nods_hz} Hz: {least}…{most} of the acceleration");
    }
}

/// A pose with non-uniform scale, as scaled bones or rounding in an exporter leave it, is followed as smoothly as one
/// without.
#[test]
fn a_skewed_pose_does_not_shake_the_head() {
    for scale in [1.0 - 5e-5, 0.98, 0.9] {
        let mut rig = eyeless();
        let (target, dt) = (at(30.0, 10.0), 1.0 / 60.0);
        let mut before = [0.0; 2];
        for frame in 0..600 {
            let mut pose = upright(&rig);
            let sway = (frame as f32 * dt).sin();
            let turns = [-35.0 + 10.0 * sway, 25.0, 0.0];
            for (joint, turn_deg) in pose.iter_mut().zip(turns) {
                let turned = Mat3A::from_quat(Quat::from_rotation_y(turn_deg * DEG)) * joint.matrix3;
                joint.matrix3 = Mat3A::from_diagonal(Vec3::new(1.0, 1.0, scale)) * turned;
            }
            let outcome = aim(&mut rig, &pose, target, dt, &Settings::default());
            let turned = rig.joints.iter().map(|joint| joint.heading()).sum::<f32>();
            let speed = (turned - before[0]) / dt;
            let gain = (speed - before[1]) / dt;
            if frame > 120 {
                let off = outcome.remaining / DEG;
                assert!(off < 0.1, "scale {scale}, frame {frame}: {off}° off");
                assert!(gain.abs() < 60.0 * DEG, "scale {scale}, frame {frame}: {}°/s²", gain / DEG);
            }
            before = [turned, speed];
        }
    }
}

/// If the animation turns the head once, faster than the acceleration can follow, the head is off by less than half of
/// the turn, on either side, and soon back on its target. It is no shaking, even if the animation turns back later.
#[test]
fn a_brisk_turn_is_not_amplified() {
    let smooth = |x: f32| x.clamp(0.0, 1.0).powi(2) * (3.0 - 2.0 * x.clamp(0.0, 1.0));
    for hz in FRAME_RATES {
        for (turn_deg, span_s) in [(15.0, 0.15), (28.0, 0.2), (28.0, 0.25), (50.0, 0.3_f32)] {
            for back_s in [0.3, 9.0] {
                let turn_at = |t: f32| {
                    turn_deg * DEG * (smooth((t - 3.0) / span_s) - smooth((t - 3.0 - span_s - back_s) / span_s))
                };
                let (mut worst, mut late) = (0.0_f64, 0);
                shaken(hz, 2.0, turn_at, |_, off| {
                    worst = worst.max(off);
                    late += usize::from(off > 3.0);
                });
                let case = format!("{turn_deg}° in {span_s} s, back after {back_s} s, at {hz} frames a second");
                let late_s = late as f32 / hz;
                assert!(worst < 0.5 * f64::from(turn_deg), "{case}: {worst}° off");
                assert!(late_s < if back_s > 1.0 { 0.8 } else { 1.2 }, "{case}: off for {late_s} s");
            }
        }
    }
}
