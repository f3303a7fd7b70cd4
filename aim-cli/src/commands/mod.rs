//! One module a command.

mod bake;
mod check;
mod count;
mod demo;
mod generate;
mod inspect;
mod reach;

use crate::args::Command;
use crate::failure::Result;

/// Runs the command.
pub(crate) fn run(command: Command) -> Result {
    match command {
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Generate(arguments) => generate::run(&arguments),
        Command::Count(arguments) => count::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Bake(arguments) => bake::run(&arguments),
        Command::Reach(arguments) => reach::run(&arguments),
    }
}
