//! Compares the solvers that can turn a gaze to a target, and prints the table of `docs/solvers.md`.
//!
//! `compare_solvers [--check]`: with `--check` it exits with 1 if that page shows a different table. Instructions are
//! counted by valgrind and may differ by a quarter, since they depend on the compiler.
//! `compare_solvers --run NAME COUNT` is the process whose instructions are counted.

use std::env;
use std::fmt::Write as _;
use std::fs;
use std::hint::black_box;
use std::path::Path;
use std::process::ExitCode;

use aim_benches::callgrind;
use aim_benches::solver::compare::{Authored, CONTENDERS, Contender, Judged, cases, judged};
use aim_benches::solver::row::{number, quantile};

/// Number of cases whose accuracy is judged.
const JUDGED: usize = 2000;
/// Number of cases whose instructions are counted.
const COUNTED: usize = 64;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("compare_solvers: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), String> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let check = match *words.as_slice() {
        [] => false,
        ["--check"] => true,
        ["--run", name, count] => {
            let contender = CONTENDERS.iter().find(|contender| contender.name == name).ok_or("no such solver")?;
            solve_some(contender, count.parse().map_err(|error| format!("{count}: {error}"))?);
            return Ok(());
        }
        _ => return Err("compare_solvers [--check | --run NAME COUNT]".to_owned()),
    };
    let table = table()?;
    println!("{table}");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/solvers.md");
    let page = fs::read_to_string(&path).map_err(|error| format!("docs/solvers.md: {error}"))?;
    let is_stale = || table.lines().any(|row| !page.lines().any(|other| is_same(row, other)));
    if check && is_stale() {
        return Err("the table of docs/solvers.md is stale: it should be the one above".to_owned());
    }
    Ok(())
}

/// Returns the second half of a Markdown link: an anchor inline, another page as a reference link.
fn link(page: &str) -> String {
    if page.starts_with('#') { format!("({page})") } else { format!("[{page}]") }
}

/// Returns `true` if two rows are equal, allowing a quarter's difference in the instructions.
fn is_same(row: &str, other: &str) -> bool {
    let split = |row: &'_ str| -> Option<(String, f64)> {
        let (rest, count) = row.trim_end_matches([' ', '|']).rsplit_once('|')?;
        Some((rest.to_owned(), count.trim().parse().ok()?))
    };
    match (split(row), split(other)) {
        (Some((a, count)), Some((b, before))) => a == b && (count / before - 1.0).abs() <= 0.25,
        _ => row == other,
    }
}

fn solve_some(contender: &Contender, count: usize) {
    let (authored, cases) = (Authored::default(), cases(COUNTED));
    for case in &cases[..count.min(COUNTED)] {
        black_box(contender.solve(black_box(case), black_box(&authored)));
    }
}

fn table() -> Result<String, String> {
    let (authored, cases) = (Authored::default(), cases(JUDGED));
    let all = |contender: &Contender| -> Vec<Judged> {
        cases.iter().map(|case| judged(case, &contender.solve(case, &authored))).collect()
    };
    let exact = all(&CONTENDERS[0]);
    let mut table = String::from(
        "| solver | on target | error, median / worst | limits held | displacement | roll | instructions |\n|---|---|---|---|---|---|---|\n",
    );
    for contender in &CONTENDERS {
        let found = all(contender);
        let share = |holds: fn(&Judged) -> bool| {
            100.0 * found.iter().filter(|judged| holds(judged)).count() as f64 / found.len() as f64
        };
        let mut errors: Vec<f64> = found.iter().map(|judged| judged.error_deg).collect();
        let mut rolls: Vec<f64> = found.iter().map(|judged| judged.roll_deg).collect();
        // Only cases that both solvers solve and that need a displacement.
        let pairs = found.iter().zip(&exact).filter(|(a, b)| on_target(a) && on_target(b) && b.displacement > 1e-4);
        let mut ratios: Vec<f64> = pairs.map(|(a, b)| a.displacement / b.displacement).collect();
        let displacement =
            if ratios.is_empty() { "–".to_owned() } else { format!("{} ×", number(quantile(&mut ratios, 0.5))) };
        writeln!(
            table,
            "| [{}]{} | {:.1} % | {:.3}° / {:.1}° | {:.1} % | {displacement} | {:.1}° | {} |",
            contender.name,
            link(contender.page),
            share(on_target),
            quantile(&mut errors, 0.5),
            quantile(&mut errors, 1.0),
            share(|judged| judged.beyond_deg < 0.05),
            quantile(&mut rolls, 0.5),
            instructions(contender)?,
        )
        .expect("a string grows");
    }
    Ok(table)
}

fn on_target(judged: &Judged) -> bool {
    judged.error_deg <= 0.1
}

/// Returns the instructions of one case, rounded to two digits because they vary a little with the compiler.
fn instructions(contender: &Contender) -> Result<String, String> {
    let count = |cases: usize| -> Result<f64, String> {
        let program = env::current_exe().map_err(|error| error.to_string())?;
        callgrind::instructions(&program, &["--run".to_owned(), contender.name.to_owned(), cases.to_string()])
    };
    let each = (count(COUNTED)? - count(0)?) / COUNTED as f64;
    let digit = 10.0_f64.powf(each.max(1.0).log10().floor() - 1.0);
    Ok(format!("{:.0}", (each / digit).round() * digit))
}
