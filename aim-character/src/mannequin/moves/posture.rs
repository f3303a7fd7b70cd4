//! [`Posture`]: the state of the body at one time of a move.

use aim_runtime::glam::{DQuat, DVec3};

/// The mannequin at one time: the hips and feet that the legs follow, and the rotations of the other joints.
pub(super) struct Posture {
    /// Offset of the hips from their bind position, and their rotation, in model space.
    pub(super) hips: (DVec3, DQuat),
    /// Left and right foot.
    pub(super) feet: [Foot; 2],
    /// Rotation of a joint above the legs relative to its parent, in the character's axes.
    pub(super) turns: Box<dyn Fn(&str) -> DQuat>,
}

/// Position and roll of a foot.
#[derive(Clone, Copy)]
pub(super) struct Foot {
    /// Point on the ground below the ankle of the flat foot, metres.
    pub(super) at: DVec3,
    /// Heading to the left, radians.
    pub(super) yaw: f64,
    /// Height above the ground, metres.
    pub(super) lift: f64,
    /// Roll, radians: above 0 the heel is raised about the ball, below 0 the toes are raised about the heel.
    pub(super) roll: f64,
}
