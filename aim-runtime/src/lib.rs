//! The runtime of `aim-rig`: turns eyes, neck and spine to a target on top of any animation, within limits, at
//! bounded speed.
//!
//! The derivatives come from the rig's own derived kernels ([`Rig`]); nothing here is tied to a bone convention.
//! No call allocates or panics, whatever the bits of its input.
//!
//! # Feature flags
//!
//! - `std` (default): square roots and rounding from the standard library, and the functions of [`Real`].
//! - `libm`: the same from `libm`, for targets without a standard library.
//! - `serde`: `Serialize` and `Deserialize` for [`Settings`], [`State`], [`Aim`], [`Outcome`], [`Target`], [`Pose`] and what they
//!   are made of. A state that is read back goes on with the same bits. Formats that people read have the words `inf`,
//!   `-inf` and `nan` for numbers that are not finite.
//! - `f64`: glam's types in double precision, in the re-exported [`glam`].
//! - `wide`: [`Scalar`] for the vectors of the [`wide`](https://docs.rs/wide) crate, so that one call of a kernel serves
//!   as many characters as the vector has lanes. Needs Rust 1.89, as that crate does; works with `std` and with `libm`.
//!
//! # Small programs
//!
//! Solvers are compiled for several numbers of joints, for speed. For programs that are downloaded, two flags of the compiler
//! (`RUSTFLAGS`) make them smaller: `--cfg aim_small` compiles them once, for chains of at most 16 joints, and `--cfg aim_natural`
//! leaves out all but [`Solver::Natural`]; calls that it does not serve are degenerate. The natural solver's bits stay the same.
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    clippy::manual_clamp,
    reason = "NaN has to take the safe way: `!(a > b)` catches it, and `max` before `min` drops it"
)]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("aim-runtime needs square roots and sines: enable the feature `std` or `libm`");

mod aim;
pub mod check;
#[cfg(feature = "std")]
mod dyn_aim;
pub mod ik;
mod kinematics;
mod limits;
mod math;
mod rig;
pub mod rotation;
mod solve;
mod target;
pub mod trajectory;

pub use aim::{Aim, Aimed, Call, Targets};
#[doc(hidden)]
pub use aim_model::differences;
pub use aim_model::{Axes, LimitsFrom, Real, Role, Scalar};
#[cfg(feature = "std")]
pub use dyn_aim::DynAim;
pub use glam;
pub use kinematics::joint_range::JointRange;
pub use rig::{
    AimRig, Ascent, Behind, Description, Effector, Joint, JointInfo, JointSet, Memory, Outcome, Pose, Rig, Settings,
    Solver, State, Status,
};
pub use target::blend::Target;
#[cfg(feature = "wide")]
pub use wide;

/// Bounds of the turn that the joints of one part of the body make together. See [`aim_model::Budget`].
pub type Budget = aim_model::Budget<f32>;
/// The budgets of the parts of a body, per rig by [`Description::with_budgets`]. See [`aim_model::Budgets`].
pub type Budgets = aim_model::Budgets<f32>;
/// How a natural gaze is shared between the eyes and the joints that support them, per rig by
/// [`Description::sharing`], per call by [`Settings::sharing`]. See [`aim_model::GazeSharing`].
pub type GazeSharing = aim_model::GazeSharing<f32>;
