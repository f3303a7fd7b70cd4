//! Prints the requirements on the natural gaze as tables: plausibility of bakes, movement compared with people's, and
//! the cost of a frame.
//!
//! `gaze_table [--check [ROW…]]`: with `--check` it exits with 1 if a requirement does not hold, except for rows that
//! begin with one of the given words. The characters are the mannequin and, if `AIM_RIGS` names a folder, the files in
//! it. Costs are counted by valgrind on `track_frames`, which must be built first:
//! `cargo build --release -p aim-benches --bins`.

use std::env;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use aim_benches::bakes::looks;
use aim_benches::callgrind;
use aim_benches::solver::natural::people;
use aim_benches::solver::row::{Row, markdown};
use aim_character::{PAPER_AXES, mannequin};
use aim_gltf::Document;

/// Counted cases: mode of `track_frames`, description, and limit in instructions per character and frame.
const COSTS: [(&str, &str, f64); 4] = [
    ("natural", "following", 3500.0),
    ("natural-aside", "target long out of reach", 5000.0),
    ("natural-overhead", "target overhead", 5000.0),
    ("natural-jump", "target that jumps to and fro", 5000.0),
];
/// Limit for the extra instructions per character and frame of following with both eyes instead of one.
const SECOND_EYE: f64 = 600.0;
/// Number of characters in `track_frames`.
const CHARACTERS: f64 = 64.0;
/// Numbers of frames of the two runs whose instructions are subtracted.
const FRAMES: [u32; 2] = [200, 400];

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("gaze_table: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<bool, String> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let (check, excepted) = match arguments.split_first() {
        None => (false, &[][..]),
        Some((word, excepted)) if word == "--check" => (true, excepted),
        _ => return Err("gaze_table [--check [ROW…]]".to_owned()),
    };
    let mut judged = Vec::new();
    let mut show = |title: &str, rows: Vec<Row>| {
        println!("{}", markdown(title, &rows));
        judged.extend(rows);
    };
    let model = mannequin(|_| PAPER_AXES).map_err(|error| error.to_string())?;
    let document = Document::from_bytes(&model).map_err(|error| error.to_string())?;
    show("bakes", looks("mannequin", &document)?);
    for file in characters()? {
        let document = Document::load(&file).map_err(|error| format!("{}: {error}", file.display()))?;
        let name = file.file_stem().unwrap_or_default().to_string_lossy();
        show("bakes", looks(&name, &document)?);
    }
    show("movement", people());
    show("instructions, a character and frame", costs()?);
    let broken: Vec<&Row> = judged.iter().filter(|row| row.held == Some(false)).collect();
    println!("{} of {} do not hold", broken.len(), judged.iter().filter(|row| row.held.is_some()).count());
    for row in &broken {
        println!("- {}: {}, must be {}", row.what, row.measured, row.must);
    }
    let is_excepted = |row: &&Row| excepted.iter().any(|begins| row.what.starts_with(begins));
    Ok(!check || broken.iter().all(is_excepted))
}

/// Returns the model files in the folder that `AIM_RIGS` names, sorted by path; none if it is not set.
fn characters() -> Result<Vec<PathBuf>, String> {
    let Some(folder) = env::var_os("AIM_RIGS") else {
        eprintln!("gaze_table: AIM_RIGS names no folder of characters: the mannequin alone is baked");
        return Ok(Vec::new());
    };
    let folder = Path::new(&folder);
    let entries = folder.read_dir().map_err(|error| format!("{}: {error}", folder.display()))?;
    let files = entries.filter_map(|entry| Some(entry.ok()?.path()));
    let is_model = |file: &PathBuf| {
        file.extension().is_some_and(|ending| ["glb", "gltf", "vrm"].iter().any(|known| ending == *known))
    };
    let mut files: Vec<PathBuf> = files.filter(is_model).collect();
    files.sort();
    Ok(files)
}

fn costs() -> Result<Vec<Row>, String> {
    let program = env::current_exe().map_err(|error| error.to_string())?.with_file_name("track_frames");
    if !program.is_file() {
        return Err(format!("{} is not built: cargo build --release -p aim-benches --bins", program.display()));
    }
    let count = |mode: &str, frames: u32| callgrind::instructions(&program, &[mode.to_owned(), frames.to_string()]);
    let [few, many] = FRAMES;
    let each = |mode: &str| -> Result<f64, String> {
        Ok((count(mode, many)? - count(mode, few)?) / (CHARACTERS * f64::from(many - few)))
    };
    let rows =
        COSTS.iter().map(|(mode, what, most)| Ok(Row::at_most(format!("natural, {what}"), *most, "", each(mode)?)));
    let mut rows = rows.collect::<Result<Vec<Row>, String>>()?;
    rows.push(Row::at_most(
        "natural, a second eye".to_owned(),
        SECOND_EYE,
        "",
        each("natural-eyes")? - each("natural")?,
    ));
    Ok(rows)
}
