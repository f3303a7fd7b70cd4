//! Code shared by the benchmarks and the accuracy test: a derived rig, the same mathematics written by hand, central
//! differences, seeded poses, and the table built from gungraun's counts.
//!
//! The aim of one joint and its derivatives are `[aim, ∂aim/∂pitch, ∂aim/∂heading]` throughout, in the order of the
//! derived kernel; the outputs for a chain are ordered as in `AimRig`.
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
