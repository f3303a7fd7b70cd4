//! What is derived: objectives, each stated once in a file of its own, and the kernels that come of them.
//!
//! Read in this order: `chain` is the geometry that objectives are stated over, `statement` says what an [`Objective`]
//! is and states it for a rig, [`aim`](AIM_GRADIENT) and [`residual`](CHAIN_RESIDUAL_JACOBIAN) are the objectives,
//! `kernel` lists them and derives their [`Kernel`]s. `notation` holds the symbols of the inputs.
//!
//! A new objective is a file with a constant [`Objective`] and its place in [`OBJECTIVES`]: every back end, the counts and
//! the checks go by that list.

mod aim;
mod chain;
mod kernel;
mod notation;
mod residual;
mod statement;

pub use aim::{AIM_GRADIENT, CHAIN_VALUE_GRADIENT};
pub use chain::{Chain, Effector, FirstLink, HEADING, Inputs, PITCH};
pub use kernel::{Function, Kernel, OBJECTIVES, functions, kernels};
pub use notation::{basis_symbols, notation};
pub use residual::CHAIN_RESIDUAL_JACOBIAN;
pub use statement::{Objective, Scope, Statement};
