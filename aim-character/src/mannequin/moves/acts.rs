//! Moves on the spot: a jump, a turn to the left, a wave.

use std::f64::consts::{FRAC_PI_2, TAU};

use aim_runtime::glam::{DQuat, DVec3};

use super::curve::{ease, moving, through};
use super::posture::{Foot, Posture};

/// Length of the jump, seconds.
pub(super) const JUMP: f64 = 1.6;
/// Length of the turn, seconds.
pub(super) const TURN: f64 = 1.4;
/// Length of the wave, seconds.
pub(super) const WAVE: f64 = 2.6;

/// Height of the hips while standing at ease, relative to the bind pose, metres.
const STAND: f64 = -0.009;
/// Distance of the standing feet from the middle, metres.
const ASIDE: f64 = 0.095;
/// Angle by which the standing feet are turned out, radians.
const OUT: f64 = 0.12;

fn standing(sign: f64) -> Foot {
    Foot { at: DVec3::X * (sign * ASIDE), yaw: sign * OUT, lift: 0.0, roll: 0.0 }
}

fn tip(angle: f64) -> DQuat {
    DQuat::from_rotation_x(angle)
}

fn yaw(angle: f64) -> DQuat {
    DQuat::from_rotation_y(angle)
}

fn roll(angle: f64) -> DQuat {
    DQuat::from_rotation_z(angle)
}

fn sided(joint: &str) -> (f64, &str) {
    match joint.split_once('_') {
        Some(("left", name)) => (1.0, name),
        Some(("right", name)) => (-1.0, name),
        _ => (0.0, joint),
    }
}

/// Returns the rotation of an arm joint while the arms hang at ease.
fn at_ease(side: f64, name: &str) -> DQuat {
    match name {
        "upper_arm" => roll(side * 0.05) * tip(0.04),
        "lower_arm" => tip(-0.18),
        "hand" => tip(-0.06),
        _ => DQuat::IDENTITY,
    }
}

/// Jump: down, off the ground for 0.4 s, and down again.
pub(super) fn jump(t: f64) -> Posture {
    // Free flight of 0.4 s: it starts and ends at height `OFF`, with the velocities ±g/2 · 0.4 s.
    const OFF: f64 = 0.030;
    const SPEED: f64 = 0.5 * 9.81 * 0.4;
    let heights = [
        [0.0, STAND, 0.0],
        [0.1, STAND, 0.0],
        [0.40, -0.24, 0.0],
        [0.56, OFF, SPEED],
        [0.96, OFF, -SPEED],
        [1.12, -0.20, 0.0],
        [1.5, STAND, 0.0],
        [1.6, STAND, 0.0],
    ];
    let height = moving(&heights, t);
    let air = ((t - 0.56) / 0.4).clamp(0.0, 1.0);
    let lift = if t > 0.56 && t < 0.96 { height - OFF + 0.9 * (air * (1.0 - air)).powi(2) } else { 0.0 };
    let heel = through(&[(0.42, 0.0), (0.56, 0.72), (0.62, 0.72), (0.96, 0.35), (1.06, 0.0)], t);
    // Bend of hips and knees, 1 at the lowest point. The trunk leans with it, so that the weight stays over the feet.
    let bent = through(&[(0.1, 0.0), (0.40, 1.0), (0.58, -0.1), (0.90, 0.1), (1.12, 0.85), (1.5, 0.0)], t);
    let arms = through(&[(0.05, 0.0), (0.38, 0.8), (0.76, -1.9), (1.14, -0.4), (1.55, 0.0)], t);
    let feet = [1.0, -1.0].map(|sign| Foot { lift, roll: heel, ..standing(sign) });
    let turns = move |joint: &str| {
        let (side, name) = sided(joint);
        match name {
            "spine" | "spine1" | "spine2" | "spine3" => tip(0.10 * bent),
            "neck" | "head" => tip(-0.36 * bent),
            "upper_arm" => at_ease(side, name) * tip(arms),
            "lower_arm" => tip(-0.18 - 0.35 * bent.max(0.0) - 0.1 * (-arms).max(0.0)),
            _ => at_ease(side, name),
        }
    };
    let hips = DVec3::new(0.0, height, -0.11 * bent);
    Posture { hips: (hips, tip(0.32 * bent)), feet, turns: Box::new(turns) }
}

/// Quarter turn to the left in two steps. The head leads.
pub(super) fn turn(t: f64) -> Posture {
    let share = |from: f64, to: f64| ease((t - from) / (to - from));
    let body = FRAC_PI_2 * share(0.1, 1.25);
    let foot = |sign: f64, from: f64, to: f64| {
        let u = ((t - from) / (to - from)).clamp(0.0, 1.0);
        let angle = FRAC_PI_2 * ease(u);
        let stand = standing(sign);
        let up = (u * (1.0 - u)).powi(2);
        Foot { at: yaw(angle) * stand.at, yaw: stand.yaw + angle, lift: 1.1 * up, roll: 4.0 * up }
    };
    let feet = [foot(1.0, 0.2, 0.68), foot(-1.0, 0.7, 1.2)];
    // Shares by which the weight is shifted onto the left and the right foot, while the other one moves.
    let onto = [
        through(&[(0.6, 0.0), (0.9, 1.0), (1.05, 1.0), (1.35, 0.0)], t),
        through(&[(0.0, 0.0), (0.3, 1.0), (0.5, 1.0), (0.8, 0.0)], t),
    ];
    let hips = (feet[0].at * onto[0] + feet[1].at * onto[1]) * 0.45 + DVec3::Y * (STAND - 0.026 * (onto[0] + onto[1]));
    let first = 0.36 * (FRAC_PI_2 * share(0.0, 0.7) - body);
    let turns = move |joint: &str| {
        let (side, name) = sided(joint);
        match name {
            "neck" | "head" => yaw(0.6 * first),
            "spine1" | "spine2" | "spine3" => yaw(0.2 * first),
            "upper_arm" => at_ease(side, name) * tip(side * 0.25 * first),
            _ => at_ease(side, name),
        }
    };
    Posture { hips: (hips, yaw(body)), feet, turns: Box::new(turns) }
}

/// Wave of the right hand, raised beside the head, palm forward.
pub(super) fn wave(t: f64) -> Posture {
    let raised = through(&[(0.05, 0.0), (0.6, 1.0), (2.0, 1.0), (2.55, 0.0)], t);
    let to_and_fro =
        0.38 * (TAU * 2.2 * (t - 0.6)).sin() * through(&[(0.5, 0.0), (0.75, 1.0), (1.85, 1.0), (2.1, 0.0)], t);
    let turns = move |joint: &str| {
        let (side, name) = sided(joint);
        let arm = match name {
            "clavicle" => roll(-0.18 * raised),
            "upper_arm" => roll(-1.55 * raised) * tip(-0.35 * raised),
            "lower_arm" => roll(-1.35 * raised + to_and_fro) * yaw(-0.8 * raised),
            "hand" => roll(0.3 * to_and_fro) * yaw(-0.6 * raised),
            _ => DQuat::IDENTITY,
        };
        match name {
            "spine" | "spine1" | "spine2" => roll(0.025 * raised),
            "neck" | "head" => roll(-0.03 * raised),
            _ if side < 0.0 => arm * at_ease(side, name).slerp(DQuat::IDENTITY, raised),
            _ => at_ease(side, name),
        }
    };
    // The weight shifts to the left foot.
    let hips = DVec3::new(0.025 * raised, STAND - 0.004 * raised, 0.0);
    Posture { hips: (hips, roll(-0.02 * raised)), feet: [1.0, -1.0].map(standing), turns: Box::new(turns) }
}
