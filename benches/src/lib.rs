//! What the benchmarks and the accuracy test share: a derived rig, the same mathematics written by hand, central
//! differences, seeded poses, and the table that is made of gungraun's counts.
//!
//! One joint's aim and both its derivatives are `[aim, ∂aim/∂pitch, ∂aim/∂heading]` throughout, as the derived kernel
//! gives them; a chain's are those of `AimRig`.
#![forbid(unsafe_code)]

pub mod bakes;
pub mod by_hand;
pub mod callgrind;
pub mod chain_by_hand;
pub mod derived;
pub mod differences;
mod float;
pub mod pose;
pub mod solver;
pub mod table;

pub use float::Float;
