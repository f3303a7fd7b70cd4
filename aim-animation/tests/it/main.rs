//! Tests of the animation runtime through its public interface, against definitions in f64 (`common`).

mod blending;
mod bounds;
mod common;
mod documented;
mod errors;
mod fading;
mod instances;
mod layers;
mod meshes;
mod motions;
mod packing;
mod planting;
mod playing;
mod poses;
mod properties;
mod reaching;
mod reducing;
mod seams;
mod skeletons;
mod spaces;
mod tracks;
mod transforms;
mod transitions;
mod trees;
