//! Compares the hashes with those of a file, or writes them: `same-bits [--write] golden.txt`.

use std::process::ExitCode;

use aim_same_bits::{RUNS, hash};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let found: String = (0..).zip(RUNS).map(|(run, name)| format!("{:016x} {name}\n", hash(run))).collect();
    let wrong = match &arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["--write", path] => std::fs::write(path, found).err().map(|error| format!("{path}: {error}")),
        [path] => match std::fs::read_to_string(path) {
            Ok(golden) if golden == found => None,
            Ok(golden) => Some(format!("other bits than in {path}:\n{golden}but\n{found}")),
            Err(error) => Some(format!("{path}: {error}")),
        },
        _ => Some("usage: same-bits [--write] golden.txt".into()),
    };
    match wrong {
        None => ExitCode::SUCCESS,
        Some(wrong) => {
            eprintln!("{wrong}");
            ExitCode::FAILURE
        }
    }
}
