//! Objectives, each stated once in a file of its own, and the kernels derived from them.
//!
//! Read in this order: `chain` is the geometry that objectives are stated over; `statement` defines [`Objective`] and
//! states one for a rig; [`aim`](AIM_GRADIENT) and [`residual`](CHAIN_RESIDUAL_JACOBIAN) are the objectives; `kernel`
//! lists them and derives their [`Kernel`]s. `notation` holds the symbols of the inputs.
//!
//! A new objective is a file with a constant [`Objective`] and an entry in [`OBJECTIVES`]. Every back end, the
//! operation counts and the checks iterate over that list.

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
