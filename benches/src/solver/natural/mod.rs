//! The rows of the natural layer.

mod following;
mod people;
mod shift;
mod steps;

pub use following::{following, resting};
pub use people::{HZ, Headings, SHIFTS_DEG, people, shift};
pub use steps::steps;
