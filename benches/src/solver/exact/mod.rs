//! Measurements of the exact solver. Each public function returns rows of the table.

mod bounds;
mod displacement;
mod frames;
mod reach;
mod small;
mod stuck;

pub use bounds::{noise, output_rate};
pub use displacement::{least_displacement, tracking, tracking_of};
pub use frames::unreached_frames;
pub use reach::{cold, unreachable};
pub use small::{holding, roll, stiffnesses};
pub use stuck::{stuck_on_orbits, stuck_on_random_rigs, stuck_still};
