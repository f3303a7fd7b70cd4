#![doc = include_str!("../README.md")]
#![no_std]

pub use aim_derive::AimRig;
pub use aim_runtime::*;

/// The bundled rigs, compiled from `rigs/*.toml`.
#[cfg(feature = "rigs")]
pub mod rigs {
    include!(concat!(env!("OUT_DIR"), "/rigs.rs"));
}

/// What emitted code names; not for hand-written code.
#[doc(hidden)]
pub mod __private {
    pub use aim_runtime::{AimRig, Axes, Effector, Joint, JointInfo, Scalar};
}
