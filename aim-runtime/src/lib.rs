//! The runtime of `aim-rig`: turns eyes, neck and spine to a target on top of any animation, within limits, at
//! bounded speed.
//!
//! The derivatives come from the rig's own derived kernels ([`AimRig`]); nothing here is tied to a bone convention.
//! No call allocates or panics, whatever the bits of its input.
//!
//! # Feature flags
//!
//! - `std` (default): sines, cosines and square roots from the standard library.
//! - `libm`: the same from `libm`, for targets without a standard library.
//! - `wide`: [`Scalar`] for the vectors of the [`wide`](https://docs.rs/wide) crate, so that one call of a kernel serves
//!   as many characters as the vector has lanes. Needs Rust 1.89, as that crate does; works with `std` and with `libm`.
#![no_std]
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    clippy::manual_clamp,
    reason = "NaN has to take the safe way: `!(a > b)` catches it, and `max` before `min` drops it"
)]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("aim-runtime needs square roots and sines: enable the feature `std` or `libm`");

mod alone;
mod ascent;
mod behind;
mod chain;
mod dual;
mod exact;
mod eyes;
mod follow;
mod frame;
mod goal;
pub mod ik;
mod joint;
mod limits;
mod math;
mod motion;
mod natural;
mod outcome;
mod pose;
mod quick;
pub mod reach;
mod real;
mod rig;
mod scalar;
mod settings;
mod settle;
mod targets;
mod trig;
mod view;

pub use glam;
pub use joint::{Joint, JointInfo, Role};
pub use outcome::{JointSet, Outcome, Status};
pub use pose::{ChainPose, DetailedPose, Pose};
pub use real::Real;
pub use rig::{AimRig, Axes, Corrections, Effector};
pub use scalar::Scalar;
pub use settings::{Ascent, Behind, Natural, Settings, Solver};
pub use targets::Target;
#[cfg(feature = "wide")]
pub use wide;
