//! Measures all requirements on the whole-chain solvers, and prints them as tables.
//!
//! `solver_table [--check] [--quick] [--solver exact|natural|ascent|paper] [WORD…]`: with `--check` it exits with 1 if
//! a requirement does not hold. `--quick` measures one sixteenth of the cases. With words, only measurements whose name
//! contains one of them run.

use std::env;
use std::process::ExitCode;
use std::time::Instant;

use aim::{Ascent, Settings, Solver};
use aim_benches::solver::row::{Row, markdown};
use aim_benches::solver::sample::Sample;
use aim_benches::solver::{exact, natural};

/// A named measurement.
type Measurement = (&'static str, fn(&Sample) -> Vec<Row>);

const EXACT: &[Measurement] = &[
    ("displacement", exact::least_displacement),
    ("stuck", exact::stuck_still),
    ("orbits", exact::stuck_on_orbits),
    ("rigs", exact::stuck_on_random_rigs),
    ("frames", exact::unreached_frames),
    ("cold", exact::cold),
    ("unreachable", exact::unreachable),
    ("noise", exact::noise),
    ("rate", exact::output_rate),
    ("holding", exact::holding),
    ("stiffnesses", exact::stiffnesses),
    ("roll", exact::roll),
    ("track", exact::tracking),
];

const NATURAL: &[Measurement] = &[
    ("natural steps", natural::steps),
    ("natural following", natural::following),
    ("natural resting", natural::resting),
];

/// The published method, for comparison, on the rows that the documentation quotes for it.
const PAPER: &[Measurement] = &[
    ("paper", |sample| {
        exact::tracking_of(&Sample { settings: ascent(Ascent::paper()), ..*sample }, "the paper's method, ")
    }),
    ("paper", |sample| {
        let plain = Ascent::paper().with_relax(None);
        exact::tracking_of(&Sample { settings: ascent(plain), ..*sample }, "without its relaxing, ")
    }),
];

fn ascent(ascent: Ascent) -> Settings {
    Settings::default().with_solver(Solver::Ascent).with_ascent(ascent)
}

fn main() -> ExitCode {
    match run() {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("solver_table: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<bool, String> {
    let (mut check, mut words) = (false, Vec::new());
    let mut sample = Sample { thinned: 1, settings: Settings::default().with_solver(Solver::Exact) };
    let mut arguments = env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--check" => check = true,
            "--quick" => sample.thinned = 16,
            "--solver" => {
                sample.settings = match arguments.next().as_deref() {
                    Some("exact") => Settings::default().with_solver(Solver::Exact),
                    Some("natural") => Settings::default().with_solver(Solver::Natural),
                    Some("ascent") => ascent(Ascent::default()),
                    Some("paper") => ascent(Ascent::paper()),
                    _ => return Err("--solver is exact, natural, ascent or paper".to_owned()),
                }
            }
            word if !word.starts_with('-') => words.push(word.to_owned()),
            _ => return Err(format!("unknown argument {argument}")),
        }
    }
    let mut judged = measure("exact", EXACT, &sample, &words);
    println!("{}", markdown("exact layer", &judged));
    let natural = Sample { settings: Settings::default().with_solver(Solver::Natural), ..sample };
    let natural = measure("natural", NATURAL, &natural, &words);
    println!("{}", markdown("natural layer", &natural));
    judged.extend(natural);
    let paper = measure("paper", PAPER, &sample, &words);
    // The published method is shown only for comparison, so its rows are not judged.
    let paper: Vec<Row> = paper.into_iter().map(|row| Row { held: None, ..row }).collect();
    println!("{}", markdown("for comparison", &paper));
    let broken = judged.iter().filter(|row| row.held == Some(false)).count();
    println!("{broken} of {} do not hold", judged.iter().filter(|row| row.held.is_some()).count());
    Ok(!check || broken == 0)
}

fn measure(layer: &str, measurements: &[Measurement], sample: &Sample, words: &[String]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (name, measurement) in measurements {
        if !words.is_empty() && !words.iter().any(|word| name.contains(word.as_str())) {
            continue;
        }
        let start = Instant::now();
        rows.extend(measurement(sample));
        eprintln!("{layer}: {name}, {:.1} s", start.elapsed().as_secs_f64());
    }
    rows
}
