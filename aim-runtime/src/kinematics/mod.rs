//! Kinematics of a chain: joint rotations, preparation of the pose, forward kinematics, and directions as angles.

pub(crate) mod bearing;
pub(crate) mod chain;
mod held;
pub(crate) mod joint_range;
pub(crate) mod rotation;
pub(crate) mod view;
