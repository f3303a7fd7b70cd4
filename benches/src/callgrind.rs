//! Instruction counts of whole programs and of single calls, by valgrind's callgrind.

use std::path::Path;
use std::process::{Command, Output};
use std::{env, fs, process};

fn callgrind(program: &Path, options: &[String], arguments: &[String]) -> Result<Output, String> {
    let mut command = Command::new("valgrind");
    command.arg("--tool=callgrind").args(options).arg(program).args(arguments);
    command.output().map_err(|error| format!("valgrind: {error}"))
}

/// Returns the instructions of a program from its start to its end.
///
/// # Errors
/// Fails if valgrind cannot be run or reports no count.
pub fn instructions(program: &Path, arguments: &[String]) -> Result<f64, String> {
    let output = callgrind(program, &["--callgrind-out-file=/dev/null".into()], arguments)?;
    let said = String::from_utf8_lossy(&output.stderr);
    said.lines()
        .find_map(|line| line.split_once("Collected :")?.1.trim().parse().ok())
        .ok_or_else(|| format!("valgrind counted nothing:\n{said}"))
}

/// Returns the instructions of each of the `calls` calls of `function`, in order, that this program makes when it is
/// run again with `arguments`.
///
/// # Errors
/// Fails if valgrind cannot be run or reports no counts, or if the program fails.
pub fn instructions_of_calls(function: &str, calls: usize, arguments: &[String]) -> Result<Vec<u64>, String> {
    let io = |error: std::io::Error| error.to_string();
    let folder = env::temp_dir().join(format!("callgrind-{}", process::id()));
    fs::create_dir_all(&folder).map_err(io)?;
    let options = [
        "--collect-atstart=no".to_owned(),
        format!("--toggle-collect={function}"),
        format!("--dump-after={function}"),
        format!("--callgrind-out-file={}", folder.join("out").display()),
    ];
    let output = callgrind(&env::current_exe().map_err(io)?, &options, arguments)?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    let counted = (1..=calls).map(|part| {
        let text = fs::read_to_string(folder.join(format!("out.{part}"))).map_err(io)?;
        let totals = text.lines().find_map(|line| line.strip_prefix("totals: "));
        totals.and_then(|totals| totals.trim().parse().ok()).ok_or_else(|| "callgrind wrote no totals".to_owned())
    });
    let counted = counted.collect();
    fs::remove_dir_all(&folder).map_err(io)?;
    counted
}
