//! The rows of the natural layer.

mod following;
mod shift;
mod steps;

pub use following::{following, resting};
pub use steps::steps;
