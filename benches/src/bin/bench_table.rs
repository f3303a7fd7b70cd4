//! Checks the counts saved by `cargo bench -p aim-benches --bench instructions -- --save-summary=json` against their
//! limits, and writes them into README.md.
//!
//! `bench_table [--check] [FOLDER]`: with `--check` nothing is written, and a stale table is a failure. FOLDER is where
//! gungraun saved its summaries, by default its folder in this workspace's target folder. Exits with 1 if a limit is
//! exceeded.

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::{env, fs};

use aim_benches::table;

fn main() -> ExitCode {
    match run() {
        Ok(said) => {
            println!("{said}");
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("bench_table: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<String, String> {
    let mut check = false;
    let mut folder = None;
    for argument in env::args_os().skip(1) {
        if argument == "--check" {
            check = true;
        } else if folder.is_none() && !argument.to_string_lossy().starts_with('-') {
            folder = Some(PathBuf::from(argument));
        } else {
            return Err(format!("unknown argument {}", argument.display()));
        }
    }
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let folder = folder.unwrap_or_else(|| {
        let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
        target.join("gungraun/aim-benches/instructions")
    });

    let counts = table::read(&folder)?;
    let markdown = table::markdown(&counts);
    println!("{markdown}");

    let path = root.join("README.md");
    let readme = fs::read_to_string(&path).map_err(|error| format!("README.md: {error}"))?;
    // Written before the limits are checked: the table shows the measurements even if a limit is exceeded.
    let said = if !check {
        let readme = table::replaced(&readme, &markdown)?;
        fs::write(&path, readme).map_err(|error| format!("README.md: {error}"))?;
        "README.md holds this table; every limit is kept"
    } else {
        "README.md's table is up to date; every limit is kept"
    };

    let exceeded = table::exceeded(&counts);
    if !exceeded.is_empty() {
        return Err(format!("too many instructions:\n  {}", exceeded.join("\n  ")));
    }
    match table::stale(&readme, &markdown)? {
        Some(difference) if check => {
            Err(format!("the table is stale; run cargo run -p aim-benches --bin bench_table\n{difference}"))
        }
        _ => Ok(said.to_owned()),
    }
}
