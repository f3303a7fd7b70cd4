//! Definitions shared by the crates of `aim-rig`: bone axes, joint roles, the classification of bone names, ranges of
//! motion, gaze sharing, and the number types of derived code.
//!
//! The crate needs no standard library and has no dependencies except the optional `libm`, `wide` and `serde`, so that
//! the runtime, the macro and the command can all build on it.

#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "names")]
extern crate alloc;

mod axes;
mod constant;
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
#[doc(hidden)]
pub use constant::{NumberConstant, number_constant};
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
