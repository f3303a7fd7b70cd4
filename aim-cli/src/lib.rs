//! The `aim` command as a library: [`run`] parses arguments, runs one command, and says how it ended.

mod args;
mod commands;
mod explain;
mod failure;
mod files;
mod html;
mod outputs;
mod plot;
mod report;
mod target;
mod ticks;

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
