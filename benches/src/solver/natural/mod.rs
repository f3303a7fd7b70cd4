//! Measurements of the natural gaze. Most public functions return rows of the table.

mod following;
mod people;
mod shift;
mod steps;

pub use following::{following, resting};
pub use people::{HZ, Headings, SHIFTS_DEG, people, shift};
pub use steps::steps;
