//! The [`Layer`](crate::Layer)s that characters have. `limb.rs` brings a limb's tip to a point, `aim.rs` aims a rig, `poses.rs` blends
//! poses that aim, `recoil.rs` kicks what a hand holds.

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
