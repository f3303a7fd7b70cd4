//! The runtime of `aim-rig`: turns eyes, neck and spine to a target on top of any animation, within limits, at
//! bounded speed.
//!
//! The derivatives come from the rig's own derived kernels ([`AimRig`]); nothing here is tied to a bone convention.
//! No call allocates or panics, whatever the bits of its input.
#![no_std]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("aim-runtime needs square roots and sines: enable the feature `std` or `libm`");

mod joint;
mod outcome;
mod pose;
mod rig;
mod scalar;
mod settings;

pub use glam;
pub use joint::{Joint, JointInfo};
pub use outcome::{JointSet, Outcome, Status};
pub use pose::{ChainPose, Pose};
pub use rig::{AimRig, Axes, Corrections, Effector};
pub use scalar::Scalar;
pub use settings::{Ascent, Settings};
