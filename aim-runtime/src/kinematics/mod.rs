//! Where the joints are and what the effector sees: rotations, the pose made ready, forward kinematics.

pub(crate) mod bearing;
pub(crate) mod chain;
mod held;
pub(crate) mod joint_range;
pub(crate) mod rotation;
pub(crate) mod view;
