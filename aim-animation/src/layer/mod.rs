//! Implementations of [`Layer`](crate::Layer).
//!
//! - `limb.rs` brings the tip of a limb to a point.
//! - `aim.rs` aims a rig.
//! - `poses.rs` blends aim poses.
//! - `recoil.rs` kicks an object held in a hand.

#[cfg(feature = "std")]
mod aim;
mod limb;
mod poses;
mod recoil;

#[cfg(feature = "std")]
pub use aim::AimLayer;
pub use limb::{LimbLayer, Space, TipTarget};
pub use poses::{AimLine, AimPoseError, AimPoseSet, AimPosesLayer};
pub use recoil::Recoil;
