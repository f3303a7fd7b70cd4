//! The `aim` command as a library: [`run`] parses arguments, runs one command, and says how it ended.

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
mod words;

use std::process::ExitCode;

use clap::Parser;

/// Runs the command that the process was started with.
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
