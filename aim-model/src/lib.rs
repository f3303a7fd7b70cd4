//! What several crates of `aim-rig` must agree on, said once: axes, roles, what bone names tell, ranges of
//! motion, how a gaze is shared.
//!
//! No dependencies and no standard library, so that the runtime, the macro and the command can all build on it.

#![no_std]

#[cfg(feature = "names")]
extern crate alloc;

mod axes;
mod float;
mod gaze;
#[cfg(feature = "names")]
mod names;
mod range;
mod role;

pub use axes::Axes;
pub use float::Float;
pub use gaze::{Budget, Budgets, GazeSharing};
#[cfg(feature = "names")]
pub use names::{BodyPart, BoneName, Side};
pub use range::{Angles, Interval, LimitsFrom, RangeOfMotion, Taper};
pub use role::Role;
