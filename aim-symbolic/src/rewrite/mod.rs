//! Rewriting rules, which move rotations to where they cancel or cost least, and their driver.

pub(crate) mod bases;
mod cases;
pub(crate) mod directions;
mod frames;
mod gathered;
mod homogeneous;
mod length;
mod limits;
pub(crate) mod log;
mod product;
mod rewriter;
mod rotations;
pub mod rules;
mod scaling;
mod series;
mod sums;
mod vanishing;
