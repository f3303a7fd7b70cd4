//! [`Posture`]: what a move has the body do at one time.

use aim_runtime::glam::{DQuat, DVec3};

/// The mannequin at a time: what legs follow, and how the joints above turn.
pub(super) struct Posture {
    /// The hips' offset from their bind place, and their turn, in the space of the model.
    pub(super) hips: (DVec3, DQuat),
    /// Left and right.
    pub(super) feet: [Foot; 2],
    /// The turn of a joint above the legs relative to its parent, in the character's axes.
    pub(super) turns: Box<dyn Fn(&str) -> DQuat>,
}

/// A foot: where it is put, and how it rolls there.
#[derive(Clone, Copy)]
pub(super) struct Foot {
    /// On the ground below the ankle of a flat foot, metres.
    pub(super) at: DVec3,
    /// To the left, radians.
    pub(super) yaw: f64,
    /// Over the ground, metres.
    pub(super) lift: f64,
    /// The heel raised over the ball, or, below 0, the toes over the heel; radians.
    pub(super) roll: f64,
}
