//! Runtime of `aim-rig`: turns eyes, neck and spine towards a target on top of any animation, within joint limits and
//! at bounded speed.
//!
//! Derivatives come from the kernels derived for each rig ([`Rig`]), so nothing here depends on a bone convention. No
//! solver allocates or panics, for any input, including NaN and infinity.
//!
//! # Feature flags
//!
//! - `std` (default): square roots and rounding from the standard library, and the functions of [`Real`].
//! - `libm`: the same functions from the crate `libm`, for targets without a standard library.
//! - `serde`: `Serialize` and `Deserialize` for [`Settings`], [`State`], [`Aim`], [`Outcome`], [`Target`], [`Pose`] and
//!   the types of their fields. A restored state continues with bit-identical results. Human-readable formats store
//!   numbers that are not finite as the words `inf`, `-inf` and `nan`.
//! - `f64`: double-precision glam types, in the re-exported [`glam`].
//! - `wide`: [`Scalar`] for the vectors of the [`wide`](https://docs.rs/wide) crate, so that one kernel call evaluates
//!   as many characters as the vector has lanes. Needs Rust 1.89, as that crate does; works with `std` and with `libm`.
//!
//! # Small programs
//!
//! For speed, the solvers are compiled for several numbers of joints. Two compiler flags (`RUSTFLAGS`) reduce the size
//! of programs that are downloaded:
//!
//! - `--cfg aim_small` compiles the solvers once, for chains of at most 16 joints.
//! - `--cfg aim_natural` leaves out every solver except [`Solver::Natural`]. A call that the natural solver does not
//!   support returns [`Status::Degenerate`].
//!
//! Neither flag changes the results of the natural solver.
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
#[doc(hidden)]
pub use aim_model::number_constant;
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

/// Limits on the total turn of the joints of one body part. See [`aim_model::Budget`].
pub type Budget = aim_model::Budget<f32>;
/// Turn budgets of the body parts, set per rig by [`Description::with_budgets`]. See [`aim_model::Budgets`].
pub type Budgets = aim_model::Budgets<f32>;
/// Division of a natural gaze between the eyes and the joints that support them; set per rig by
/// [`Description::with_sharing`] and per call by [`Settings::sharing`]. See [`aim_model::GazeSharing`].
pub type GazeSharing = aim_model::GazeSharing<f32>;
