//! The `aim` command as a library: [`run`] parses the arguments, runs one command and returns its exit code.

mod args;
mod axis;
mod bake_report;
mod baked_reduction;
mod clip_report;
mod commands;
mod deviation;
mod effector;
mod explain;
mod facing;
mod failure;
mod files;
mod html;
mod outputs;
mod page;
mod plausibility;
mod plot;
mod projection;
mod reach_report;
mod reduction;
mod seam_report;
mod target;
mod warnings;
mod words;

use std::process::ExitCode;

use clap::Parser;

/// Runs the command given by the process arguments. Prints a failure to standard error.
pub fn run() -> ExitCode {
    let arguments = args::Arguments::parse();
    match commands::run(arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            failure.exit_code()
        }
    }
}
