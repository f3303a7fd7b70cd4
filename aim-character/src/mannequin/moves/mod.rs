//! Moves of the mannequin besides walking on the spot. A move gives the positions of hips and feet at a time and the
//! rotations of trunk and arms; [`legs`] bends the legs accordingly, so that feet do not slide. `gait.rs` has walking
//! and running, `acts.rs` the rest.

mod acts;
mod curve;
mod gait;
mod legs;
mod posture;

use aim_runtime::glam::{DQuat, DVec3};

use super::joints::Joint;
use posture::Posture;

/// Keys per second: enough that a foot does not stray between keys.
const RATE: f64 = 60.0;

/// A move: a clip of the mannequin, computed by a formula.
pub(super) struct Move {
    pub(super) name: &'static str,
    pub(super) seconds: f64,
    posture: fn(f64) -> Posture,
}

/// Walking straight ahead.
pub(super) const WALK_AHEAD: Move =
    Move { name: "walk_ahead", seconds: gait::WALK.period, posture: |t| gait::WALK.posture(t) };
/// Running straight ahead.
pub(super) const RUN: Move = Move { name: "run", seconds: gait::RUN.period, posture: |t| gait::RUN.posture(t) };

/// All moves.
pub(super) const MOVES: [Move; 6] = [
    WALK_AHEAD,
    Move {
        name: "walk_circle",
        seconds: gait::CIRCLE.period * gait::CIRCLE_CYCLES,
        posture: |t| gait::CIRCLE.posture(t),
    },
    RUN,
    Move { name: "jump", seconds: acts::JUMP, posture: acts::jump },
    Move { name: "turn", seconds: acts::TURN, posture: acts::turn },
    Move { name: "wave", seconds: acts::WAVE, posture: acts::wave },
];

impl Move {
    /// Returns the times of the keys.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few hundred")]
    pub(super) fn times(&self) -> impl Iterator<Item = f64> + use<> {
        let (count, seconds) = ((self.seconds * RATE).round() as u32, self.seconds);
        (0..=count).map(move |k| seconds * f64::from(k) / f64::from(count))
    }

    /// Returns the hips' offset from their bind position, and the rotation of every joint relative to its parent, in
    /// the character's axes.
    pub(super) fn at(&self, joints: &[Joint], seconds: f64) -> (DVec3, Vec<DQuat>) {
        let posture = (self.posture)(seconds);
        let mut turns: Vec<DQuat> = joints.iter().map(|joint| (posture.turns)(&joint.name)).collect();
        let (offset, turn) = posture.hips;
        turns[0] = turn;
        for (side, foot) in ["left", "right"].into_iter().zip(posture.feet) {
            legs::bend(joints, &mut turns, offset, side, foot);
        }
        (offset, turns)
    }
}
