//! The `aim` command as a library: [`run`] parses arguments, runs one command, and says how it ended.
//!
//! [`InterpretedRig`] is the rig that is known only at run time.

mod args;
mod commands;
mod declaration;
mod evidence;
mod explain;
mod failure;
mod files;
mod fit;
mod html;
mod interpreted;
mod outputs;
mod proposal;
mod report;
mod target;

use std::process::ExitCode;

use clap::Parser;

pub use interpreted::InterpretedRig;

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
