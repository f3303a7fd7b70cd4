//! Instruction counts saved by gungraun, their limits, and the table in the README.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::pose::MEASURED;

/// Instructions per evaluation, keyed by benchmark and number type.
pub type Counts = BTreeMap<(String, String), f64>;

/// Rows of the table: each problem with its implementations, each by label and benchmark name.
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

/// Limits of the ratio of one benchmark's count to another's, in f32 and in f64.
///
/// Sines and cosines take half of a joint's instructions in f32 and three quarters in f64, the same for every
/// implementation. In f64, even the hand-written code is therefore at 0.65 of num-dual.
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

/// Lines of the README that enclose the table.
const MARKERS: [&str; 2] = ["<!-- benchmarks: begin -->\n", "<!-- benchmarks: end -->\n"];

/// Relative difference of a count from the README's above which the table is stale. Counts vary a little with the
/// compiler's version and the C library's sines.
const DRIFT: f64 = 0.05;

/// Reads every `summary.json` below `folder`.
///
/// # Errors
/// Fails if a file cannot be read or is not a summary.
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

/// Parses a summary: the benchmark's name, its number type, and the instructions of one evaluation.
fn summary(text: &str) -> Option<((String, String), f64)> {
    let summary: Value = serde_json::from_str(text).ok()?;
    // `new` is this run's count; `old` stands beside it if gungraun compared with an earlier run.
    let total = summary["profiles"][0]["data"]["total"]["metrics"]["Ir"]["values"]["new"].as_f64()?;
    let (name, float) = summary["id"].as_str()?.rsplit_once('_')?;
    Some(((name.to_owned(), float.to_owned()), total / MEASURED as f64))
}

/// Returns a line for each limit that the counts exceed or that cannot be judged because a count is missing.
pub fn exceeded(counts: &Counts) -> Vec<String> {
    let mut failures = Vec::new();
    for &(of, to, single, double) in LIMITS {
        for (float, limit) in [("f32", single), ("f64", double)] {
            let (Some(a), Some(b)) = (get(counts, of, float), get(counts, to, float)) else {
                failures.push(format!("{of} or {to} was not measured in {float}"));
                continue;
            };
            let ratio = a / b;
            // Limits have two decimals, so ratios are rounded to two.
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

/// Formats the table in Markdown: counts, and their ratio to the derived code's.
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

/// Returns `readme` with `table` between the markers.
///
/// # Errors
/// Fails if the markers are missing.
pub fn replaced(readme: &str, table: &str) -> Result<String, String> {
    let (before, _, after) = parts(readme)?;
    Ok(format!("{before}{table}{after}"))
}

/// Returns the first line of `table` that differs in `readme`: by its words, or by a number beyond the allowed drift.
/// `None` if the table is up to date.
///
/// # Errors
/// Fails if the markers are missing.
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

/// Splits the README into the text up to the table, the table, and the text after it.
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

/// Returns `true` if two lines have the same words, and numbers within the allowed drift.
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
