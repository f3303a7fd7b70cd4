//! Instruction counts as gungraun left them, the limits they are held to, and the table that the README shows.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::pose::MEASURED;

/// Instructions per evaluation, by benchmark and number type.
pub type Counts = BTreeMap<(String, String), f64>;

/// The rows of the table: a problem, then each way to solve it by the name of its benchmark.
const PROBLEMS: &[(&str, &[(&str, &str)])] = &[
    (
        "one joint from its angles: aim and both derivatives",
        &[
            ("derived", "joint_derived"),
            ("by hand, 46 operations", "joint_by_hand"),
            ("num-dual, the target turned back by hand", "joint_dual_turned_back"),
            ("num-dual, as the paper states it", "joint_dual_paper"),
            ("central differences", "joint_differences"),
            ("symdiff, the target turned back by hand", "joint_symdiff"),
        ],
    ),
    ("the same, sines and cosines given", &[("derived", "joint_given_derived"), ("by hand", "joint_given_by_hand")]),
    (
        "three joints from their angles: aim and 6 derivatives",
        &[
            ("derived", "gradient_derived"),
            ("by hand", "gradient_by_hand"),
            ("central differences", "gradient_differences"),
        ],
    ),
    (
        "the same, sines and cosines given",
        &[("derived", "gradient_given_derived"), ("by hand", "gradient_given_by_hand")],
    ),
    (
        "three joints from their angles: residual and Jacobian",
        &[
            ("derived", "jacobian_derived"),
            ("by hand", "jacobian_by_hand"),
            ("central differences", "jacobian_differences"),
        ],
    ),
    (
        "the same, sines and cosines given",
        &[("derived", "jacobian_given_derived"), ("by hand", "jacobian_given_by_hand")],
    ),
];

/// What may not be exceeded: one benchmark's count over another's, in f32 and in f64.
///
/// Sines and cosines are half of a joint's instructions in f32 and three quarters in f64, the same in every way to
/// compute it: against num-dual in f64 even the hand-written code is at 0.65.
const LIMITS: &[(&str, &str, f64, f64)] = &[
    ("joint_derived", "joint_by_hand", 1.05, 1.05),
    ("joint_given_derived", "joint_given_by_hand", 1.05, 1.05),
    ("gradient_derived", "gradient_by_hand", 1.05, 1.05),
    ("gradient_given_derived", "gradient_given_by_hand", 1.05, 1.05),
    ("jacobian_derived", "jacobian_by_hand", 1.05, 1.05),
    ("jacobian_given_derived", "jacobian_given_by_hand", 1.05, 1.05),
    ("joint_derived", "joint_dual_paper", 0.5, 0.65),
    ("joint_derived", "joint_dual_turned_back", 0.75, 0.85),
    ("joint_derived", "joint_differences", 0.35, 0.35),
    ("gradient_derived", "gradient_differences", 0.35, 0.35),
    ("jacobian_derived", "jacobian_differences", 0.35, 0.35),
];

/// Where the README's table begins and ends.
const MARKERS: [&str; 2] = ["<!-- benchmarks: begin -->\n", "<!-- benchmarks: end -->\n"];

/// How far a count may be from the README's before the table is stale. Counts follow the compiler's version and the
/// C library's sines a little; what they say does not.
const DRIFT: f64 = 0.05;

/// Reads every `summary.json` below `folder`.
///
/// # Errors
/// What could not be read, or is no summary.
pub fn read(folder: &Path) -> Result<Counts, String> {
    let mut counts = Counts::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(&folder).map_err(|error| {
            format!(
                "{}: {error}; run cargo bench -p aim-benches --bench instructions -- --save-summary=json",
                folder.display()
            )
        })?;
        for path in entries.filter_map(|entry| Some(entry.ok()?.path())) {
            if path.is_dir() {
                folders.push(path);
            } else if path.file_name().is_some_and(|name| name == "summary.json") {
                let text = fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
                let (key, count) = summary(&text).ok_or_else(|| format!("{}: no count in it", path.display()))?;
                counts.insert(key, count);
            }
        }
    }
    Ok(counts)
}

/// The benchmark's name, its number type, and the instructions of one evaluation.
fn summary(text: &str) -> Option<((String, String), f64)> {
    let summary: Value = serde_json::from_str(text).ok()?;
    // Beside `old`, where the run compared with an earlier one.
    let total = summary["profiles"][0]["data"]["total"]["metrics"]["Ir"]["values"]["new"].as_f64()?;
    let (name, float) = summary["id"].as_str()?.rsplit_once('_')?;
    Some(((name.to_owned(), float.to_owned()), total / MEASURED as f64))
}

/// The limits that the counts exceed, one line each; also those that cannot be judged.
pub fn exceeded(counts: &Counts) -> Vec<String> {
    let mut failures = Vec::new();
    for &(of, to, single, double) in LIMITS {
        for (float, limit) in [("f32", single), ("f64", double)] {
            let (Some(a), Some(b)) = (get(counts, of, float), get(counts, to, float)) else {
                failures.push(format!("{of} or {to} was not measured in {float}"));
                continue;
            };
            let ratio = a / b;
            // Limits have two digits, and ratios are judged to two.
            if (100.0 * ratio).round() > (100.0 * limit).round() {
                failures.push(format!("{float}: {of} is {ratio:.3} × {to}, more than {limit} ({a:.1}, {b:.1})"));
            }
        }
    }
    failures
}

fn get(counts: &Counts, benchmark: &str, float: &str) -> Option<f64> {
    counts.get(&(benchmark.to_owned(), float.to_owned())).copied()
}

/// The table in Markdown: counts, and how many times the derived code's they are.
pub fn markdown(counts: &Counts) -> String {
    let mut table = "| problem | code | f32 | f64 |\n|---|---|---|---|\n".to_owned();
    for (problem, rows) in PROBLEMS {
        for (i, (code, benchmark)) in rows.iter().enumerate() {
            let cell = |float: &str| match (get(counts, benchmark, float), get(counts, rows[0].1, float)) {
                (Some(count), Some(_)) if i == 0 => format!("**{count:.0}**"),
                (Some(count), Some(derived)) => format!("{count:.0} ({:.2} ×)", count / derived),
                _ => "–".to_owned(),
            };
            let problem = if i == 0 { problem } else { "" };
            table += &format!("| {problem} | {code} | {} | {} |\n", cell("f32"), cell("f64"));
        }
    }
    table
}

/// `readme` with `table` between the markers.
///
/// # Errors
/// That the markers are missing.
pub fn replaced(readme: &str, table: &str) -> Result<String, String> {
    let (before, _, after) = parts(readme)?;
    Ok(format!("{before}{table}{after}"))
}

/// The first line of `table` that `readme` shows otherwise: other words, or a number that is too far off.
///
/// # Errors
/// That the markers are missing.
pub fn stale(readme: &str, table: &str) -> Result<Option<String>, String> {
    let (_, shown, _) = parts(readme)?;
    let (shown, table): (Vec<&str>, Vec<&str>) = (shown.lines().collect(), table.lines().collect());
    let differs = (0..shown.len().max(table.len())).find(|&i| match (shown.get(i), table.get(i)) {
        (Some(shown), Some(table)) => !alike(shown, table),
        _ => true,
    });
    Ok(differs.map(|i| {
        let line = |lines: &[&str]| lines.get(i).copied().unwrap_or("(nothing)").to_owned();
        format!("README.md shows\n  {}\nmeasured is\n  {}", line(&shown), line(&table))
    }))
}

/// Everything up to the table, the table, everything after it.
fn parts(readme: &str) -> Result<(&str, &str, &str), String> {
    let [begin, end] = MARKERS.map(|marker| readme.find(marker));
    match (begin, end) {
        (Some(begin), Some(end)) if begin < end => {
            let begin = begin + MARKERS[0].len();
            Ok((&readme[..begin], &readme[begin..end], &readme[end..]))
        }
        _ => Err(format!("README.md holds no {}… {}", MARKERS[0].trim_end(), MARKERS[1].trim_end())),
    }
}

/// The same words, and numbers that are near each other.
fn alike(a: &str, b: &str) -> bool {
    let (a, b): (Vec<&str>, Vec<&str>) = (words(a), words(b));
    a.len() == b.len()
        && a.iter().zip(&b).all(|(a, b)| match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(a), Ok(b)) => (a - b).abs() <= DRIFT * a.abs().max(b.abs()),
            _ => a == b,
        })
}

fn words(line: &str) -> Vec<&str> {
    line.split([' ', '*', '(', ')']).filter(|word| !word.is_empty()).collect()
}
