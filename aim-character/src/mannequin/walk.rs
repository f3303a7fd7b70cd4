//! The walk on the spot: a periodic rotation of each joint relative to its parent, in the character's axes.

use core::f64::consts::TAU;

use aim_runtime::glam::{DQuat, DVec3};

use super::joints::Joint;

/// Length of a period of two steps, seconds.
const SECONDS: f64 = 1.2;
/// Number of keys in a period, without the repeated first one.
const KEYS: u32 = 36;

/// Returns the times of the keys. The first and the last have the same phase.
pub(super) fn times() -> impl Iterator<Item = f64> {
    (0..=KEYS).map(|k| f64::from(k) / f64::from(KEYS) * SECONDS)
}

/// Returns the hips' offset and the rotation of each joint at the time of a key.
pub(super) fn at(joints: &[Joint], seconds: f64) -> (DVec3, Vec<DQuat>) {
    let key = (seconds / SECONDS * f64::from(KEYS)).round() % f64::from(KEYS);
    let phase = key / f64::from(KEYS);
    (hips_offset(phase), joints.iter().map(|joint| turn(&joint.name, phase)).collect())
}

/// Returns the hips' offset from their bind position at a phase (0…1), metres.
fn hips_offset(phase: f64) -> DVec3 {
    let p = TAU * phase;
    DVec3::new(0.012 * p.cos(), 0.016 * (2.0 * p).cos() - 0.022, 0.0)
}

/// Returns the rotation of a joint from the bind pose at a phase (0…1). Axes: x left, y up, z forward.
fn turn(joint: &str, phase: f64) -> DQuat {
    let p = TAU * phase;
    // Rotations about +x tip the top forward, so a hanging limb swings back.
    let tip = DQuat::from_rotation_x;
    let yaw = DQuat::from_rotation_y;
    let roll = DQuat::from_rotation_z;
    match joint {
        "hips" => yaw(-0.09 * p.sin()) * roll(0.035 * p.cos()),
        "spine" => yaw(0.04 * p.sin()) * roll(-0.02 * p.cos()) * tip(0.03),
        "spine1" | "spine2" => yaw(0.05 * p.sin()) * roll(-0.012 * p.cos()),
        "spine3" => yaw(0.06 * p.sin()) * tip(0.02 + 0.012 * (2.0 * p).cos()),
        "neck" => yaw(-0.06 * p.sin()) * tip(-0.01),
        "head" => yaw(-0.04 * p.sin()) * tip(-0.03 - 0.02 * (2.0 * p + 0.5).cos()) * roll(0.01 * p.cos()),
        _ => limb(joint, p),
    }
}

fn limb(joint: &str, p: f64) -> DQuat {
    // The right side lags the left by half a period.
    let (name, p, side) = match (joint.strip_prefix("left_"), joint.strip_prefix("right_")) {
        (Some(name), _) => (name, p, 1.0),
        (_, Some(name)) => (name, p + TAU / 2.0, -1.0),
        _ => return DQuat::IDENTITY,
    };
    let tip = DQuat::from_rotation_x;
    match name {
        "clavicle" => DQuat::from_rotation_y(side * 0.02) * tip(0.03 * p.sin()),
        "upper_arm" => DQuat::from_rotation_z(side * 0.03) * tip(0.05 + 0.42 * p.sin()),
        "lower_arm" => tip(-0.28 + 0.16 * p.sin()),
        "hand" => tip(-0.06 + 0.08 * (p - 0.6).sin()),
        "upper_leg" => tip(-0.05 - 0.38 * p.sin()),
        // Bent most while the leg swings forward.
        "lower_leg" => tip(0.08 + 0.95 * (0.5 + 0.5 * (p + 0.35).cos()).powi(3)),
        "foot" => tip(0.02 + 0.2 * (p + 2.2).sin()),
        "toes" => tip(-0.12 * (1.0 + (p + 1.6).cos())),
        _ => DQuat::IDENTITY,
    }
}
