//! One module for each command.

mod bake;
pub(crate) mod check;
mod check_model;
mod clip;
pub(crate) mod count;
mod demo;
mod explain;
pub(crate) mod generate;
mod inspect;
mod plot;
mod reach;
mod rig;
mod view;

use crate::args::Command;
use crate::failure::Result;

/// Runs a command.
pub(crate) fn run(command: Command) -> Result {
    match command {
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Rig(arguments) => rig::run(&arguments),
        Command::Generate(arguments) => generate::run(&arguments),
        Command::Count(arguments) => count::run(&arguments),
        Command::Check(arguments) => match &arguments.model_rig {
            Some(rig) => check_model::run(&arguments.rig, rig),
            None => check::run(&arguments),
        },
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Plot(arguments) => plot::run(&arguments),
        Command::Bake(arguments) => bake::run(&arguments),
        Command::Reach(arguments) => reach::run(&arguments),
        Command::Clip(arguments) => clip::run(&arguments),
        Command::View(arguments) => view::run(arguments),
    }
}
