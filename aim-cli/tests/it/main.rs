//! Tests of the command through its command line.

mod bad_arguments;
mod bad_models;
mod bake_conventions;
mod bake_odd_clips;
mod bake_odd_rigs;
mod bake_options;
mod bake_real;
mod bake_targets;
mod book;
mod check_model;
mod clip;
mod common;
mod demo;
mod example;
mod explain;
mod forms;
mod generate;
mod hold;
mod manners;
mod morph_eyes;
mod plausibility;
mod plot;
mod reach;
mod rig;
mod shapes;
