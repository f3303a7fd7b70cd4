//! A viewer: a window with a live character that looks at a target.
//!
//! The runtime does the aiming; this crate displays it. `stage` holds the character and its solvers, `controls` and
//! `panel` turn input into changes of the stage, `gizmos` builds a picture of it, and `draw` draws that picture.

mod actor;
mod app;
mod camera;
mod character;
mod controls;
mod draw;
mod feet;
mod gizmos;
mod hand;
mod held;
mod overlay;
mod panel;
mod picture;
mod player;
mod plots;
mod pointed;
mod skinning;
mod stage;
mod target;
mod timing;
mod tools;
mod tuning;
mod viewer;

#[cfg(test)]
mod tests;

pub use gizmos::Shown;
pub use target::Path;
pub use tuning::Lineup;

#[cfg(not(target_arch = "wasm32"))]
mod native;
#[cfg(not(target_arch = "wasm32"))]
pub use native::{Options, Shot, run};

#[cfg(target_arch = "wasm32")]
mod web;
#[cfg(target_arch = "wasm32")]
pub use web::start;
