//! [`Row`]: one number with what it must not exceed, and the table of all of them.

use std::fmt::Write as _;

/// One line of the table.
#[derive(Clone, Debug)]
pub struct Row {
    /// What was measured.
    pub what: String,
    /// What must hold.
    pub must: String,
    /// What was found.
    pub measured: String,
    /// Whether it holds; `None` for what is only shown.
    pub held: Option<bool>,
}

impl Row {
    /// A number that must be no larger than `limit`; NaN is too large.
    pub fn at_most(what: impl Into<String>, limit: f64, unit: &str, measured: f64) -> Self {
        Self {
            what: what.into(),
            must: format!("≤ {}{unit}", number(limit)),
            measured: format!("{}{unit}", number(measured)),
            held: Some(measured <= limit),
        }
    }

    /// A number that must lie in a range.
    pub fn between(what: impl Into<String>, [lo, hi]: [f64; 2], unit: &str, measured: f64) -> Self {
        Self {
            what: what.into(),
            must: format!("{}–{}{unit}", number(lo), number(hi)),
            measured: format!("{}{unit}", number(measured)),
            held: Some((lo..=hi).contains(&measured)),
        }
    }

    /// How many of `all` there are of what there must be none.
    pub fn none(what: impl Into<String>, found: usize, all: usize) -> Self {
        Self {
            what: what.into(),
            must: "0".to_owned(),
            measured: format!("{found} of {all}"),
            held: Some(found == 0 && all > 0),
        }
    }

    /// How many of `all` there are of what there must be nothing else.
    pub fn every(what: impl Into<String>, found: usize, all: usize) -> Self {
        let share = 100.0 * found as f64 / all as f64;
        Self {
            what: what.into(),
            must: "100 %".to_owned(),
            measured: format!("{share:.2} % of {all}"),
            held: Some(found == all && all > 0),
        }
    }

    /// A number that is only shown.
    pub fn shown(what: impl Into<String>, unit: &str, measured: f64) -> Self {
        Self { what: what.into(), must: "–".to_owned(), measured: format!("{}{unit}", number(measured)), held: None }
    }

    /// The same with words after the measured number.
    #[must_use]
    pub fn noting(mut self, note: &str) -> Self {
        self.measured = format!("{} ({note})", self.measured);
        self
    }
}

/// Three digits, and no more zeros than that takes.
pub fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        a if !a.is_finite() => x.to_string(),
        a if a >= 100.0 => format!("{x:.0}"),
        a if a >= 10.0 => trimmed(&format!("{x:.1}")),
        a if a >= 1.0 => trimmed(&format!("{x:.2}")),
        a if a >= 0.01 => trimmed(&format!("{x:.4}")),
        _ => format!("{x:.1e}"),
    }
}

fn trimmed(number: &str) -> String {
    number.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The value that a share of the values does not exceed; 0 of none.
pub fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index below the length")]
    let index = (share * (values.len().saturating_sub(1)) as f64).round() as usize;
    values.get(index).copied().unwrap_or(0.0)
}

/// The largest value; 0 of none, NaN if any is.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |a, b| if a >= b || a.is_nan() { a } else { b })
}

/// The rows as a table in Markdown.
pub fn markdown(title: &str, rows: &[Row]) -> String {
    let mut table = format!("| {title} | must | measured | |\n|---|---|---|---|\n");
    for Row { what, must, measured, held } in rows {
        let verdict = match held {
            Some(true) => "held",
            Some(false) => "**broken**",
            None => "",
        };
        writeln!(table, "| {what} | {must} | {measured} | {verdict} |").expect("a string grows");
    }
    table
}
