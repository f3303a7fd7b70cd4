//! The `aim` command: parses its arguments, runs one of [`commands`], and turns failures into exit codes.

mod args;
mod commands;
mod failure;
mod files;
mod html;
mod interpreted;
mod measured;
mod report;
mod target;

use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    let arguments = args::Arguments::parse();
    match commands::run(arguments.command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("{failure}");
            failure.exit_code()
        }
    }
}
