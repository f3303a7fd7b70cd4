//! What several crates of `aim-rig` must agree on, said once: axes, roles, what bone names tell, ranges of
//! motion, how a gaze is shared, and the numbers that derived code computes with.
//!
//! No standard library and no dependencies, but for `libm`, `wide` and `serde` where they are asked for: so the runtime, the macro
//! and the command can all build on it.

#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "names")]
extern crate alloc;

mod axes;
#[cfg(any(feature = "std", feature = "libm"))]
#[doc(hidden)]
pub mod differences;
mod float;
mod gaze;
#[cfg(feature = "names")]
mod names;
mod range;
#[cfg(any(feature = "std", feature = "libm"))]
mod real;
mod role;
#[cfg(any(feature = "std", feature = "libm"))]
mod scalar;
#[cfg(feature = "serde")]
#[doc(hidden)]
pub mod stored;

pub use axes::Axes;
pub use float::Float;
pub use gaze::{Budget, Budgets, GazeSharing};
#[cfg(feature = "names")]
pub use names::{BodyPart, BoneName, Side};
pub use range::{Angles, Interval, LimitsFrom, RangeOfMotion, Taper};
#[cfg(any(feature = "std", feature = "libm"))]
pub use real::Real;
pub use role::Role;
#[cfg(any(feature = "std", feature = "libm"))]
pub use scalar::Scalar;
