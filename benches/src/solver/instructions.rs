//! Instructions a character and frame, counted by valgrind: the same on every run, whatever else the machine does.

use std::env;
use std::path::PathBuf;
use std::process::Command;

use super::row::Row;

/// How many characters are counted.
pub const CHARACTERS: usize = 64;
/// Of how many frames inputs are made ready.
pub const FRAMES: u16 = 600;

/// What is counted: the solver's name for `track_frames`, in which frames, what it is, and what it must not exceed in
/// plain x86-64 and with what x86-64-v3 has.
type Counted = (&'static str, [u16; 2], &'static str, Option<[f64; 2]>);

const ALL: [u16; 2] = [0, FRAMES];
/// Frames in which every target has long been caught up with.
const FOLLOWING: [u16; 2] = [200, 400];

const COUNTED: &[Counted] = &[
    ("exact", FOLLOWING, "track, exact: instructions a character and frame", Some([1640.0, 1130.0])),
    ("exact", ALL, "the same with the frames that catch up at first", None),
    ("exact moving", FOLLOWING, "track on a moving animation, exact", Some([1640.0, 1130.0])),
    ("eye", ALL, "eye only, with limits, closed form", Some([350.0, 350.0])),
    // What a frame costs at most: no angles meet the target, and all that may is tried.
    ("exact blocked", [0, 1], "out of reach, exact: the first frame", None),
    ("exact blocked", [1, 60], "out of reach, exact: frames of the first second", None),
    ("exact blocked", [240, 300], "out of reach, exact: later frames", Some([40_000.0, 40_000.0])),
    ("natural", ALL, "track, natural", Some([12_600.0, 10_200.0])),
    ("natural blocked", [240, 300], "out of reach, natural: later frames", None),
    ("ascent", ALL, "track, ascent", None),
    ("paper", ALL, "track, the paper's method", None),
];

/// Counts everything.
///
/// # Errors
/// That something could not be built, or valgrind not be run.
pub fn count() -> Result<Vec<Row>, String> {
    let target = env::current_exe().map_err(|error| error.to_string())?;
    // …/target/release/solver_table
    let target = target.ancestors().nth(2).ok_or("this program has no target folder")?.to_owned();
    let mut rows = Vec::new();
    for (machine, flags, folder) in
        [("x86-64", "", target.clone()), ("x86-64-v3", "-C target-cpu=x86-64-v3", target.join("x86-64-v3"))]
    {
        let program = build(flags, folder)?;
        for (solver, frames, what, limits) in COUNTED {
            let [before, after] = frames.map(|frames| instructions(&program, solver, frames));
            let each = (after? - before?) / (CHARACTERS as f64 * f64::from(frames[1] - frames[0]));
            let what = format!("{what}, {machine}");
            rows.push(match limits {
                Some(limits) => Row::at_most(what, limits[usize::from(!flags.is_empty())], "", each.round()),
                None => Row::shown(what, "", each.round()),
            });
        }
    }
    Ok(rows)
}

/// `track_frames` for a machine.
fn build(flags: &str, folder: PathBuf) -> Result<PathBuf, String> {
    let cargo = env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.args(["build", "--quiet", "--release", "--package", "aim-benches", "--bin", "track_frames"]);
    command.arg("--manifest-path").arg(concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml"));
    command.arg("--target-dir").arg(&folder);
    if !flags.is_empty() {
        command.env("RUSTFLAGS", flags);
    }
    let status = command.status().map_err(|error| format!("cargo: {error}"))?;
    if status.success() { Ok(folder.join("release/track_frames")) } else { Err("track_frames does not build".into()) }
}

fn instructions(program: &PathBuf, solver: &str, frames: u16) -> Result<f64, String> {
    let mut words = solver.split(' ');
    let mut command = Command::new("valgrind");
    command.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]).arg(program);
    command.arg(words.next().unwrap_or_default()).arg(frames.to_string()).args(words);
    let output = command.output().map_err(|error| format!("valgrind: {error}"))?;
    let said = String::from_utf8_lossy(&output.stderr);
    said.lines()
        .find_map(|line| line.split_once("Collected :")?.1.trim().parse().ok())
        .ok_or_else(|| format!("valgrind counted nothing:\n{said}"))
}
