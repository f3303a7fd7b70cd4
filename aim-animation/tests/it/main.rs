//! The animation runtime through its public interface, judged by definitions in f64 (`common`).

mod blending;
mod common;
mod documented;
mod errors;
mod instances;
mod motions;
mod playing;
mod poses;
mod properties;
mod reaching;
mod seams;
mod skeletons;
mod spaces;
mod tracks;
mod transforms;
mod transitions;
mod trees;
