//! [`Row`]: a measured number with its requirement, and the table of all rows.

use std::fmt::Write as _;

/// One line of the table.
#[derive(Clone, Debug)]
pub struct Row {
    /// Description of the measured quantity.
    pub what: String,
    /// Requirement in words.
    pub must: String,
    /// Measured value in words.
    pub measured: String,
    /// `Some(true)` if the requirement holds; `None` if the row is only shown.
    pub held: Option<bool>,
}

impl Row {
    /// Creates a row for a number that must not exceed `limit`; NaN fails.
    pub fn at_most(what: impl Into<String>, limit: f64, unit: &str, measured: f64) -> Self {
        Self {
            what: what.into(),
            must: format!("≤ {}{unit}", number(limit)),
            measured: format!("{}{unit}", number(measured)),
            held: Some(measured <= limit),
        }
    }

    /// Creates a row for a number that must lie in a range, ends included.
    pub fn between(what: impl Into<String>, [lo, hi]: [f64; 2], unit: &str, measured: f64) -> Self {
        Self {
            what: what.into(),
            must: format!("{}–{}{unit}", number(lo), number(hi)),
            measured: format!("{}{unit}", number(measured)),
            held: Some((lo..=hi).contains(&measured)),
        }
    }

    /// Creates a row for a count of violations among `all` cases, which must be 0. An empty sample fails.
    pub fn none(what: impl Into<String>, found: usize, all: usize) -> Self {
        Self {
            what: what.into(),
            must: "0".to_owned(),
            measured: format!("{found} of {all}"),
            held: Some(found == 0 && all > 0),
        }
    }

    /// Creates a row for a count of successes, which must equal `all`. An empty sample fails.
    pub fn every(what: impl Into<String>, found: usize, all: usize) -> Self {
        let share = 100.0 * found as f64 / all as f64;
        Self {
            what: what.into(),
            must: "100 %".to_owned(),
            measured: format!("{share:.2} % of {all}"),
            held: Some(found == all && all > 0),
        }
    }

    /// Creates a row for a number that is only shown.
    pub fn shown(what: impl Into<String>, unit: &str, measured: f64) -> Self {
        Self { what: what.into(), must: "–".to_owned(), measured: format!("{}{unit}", number(measured)), held: None }
    }

    /// Returns the row with a note after the measured number.
    #[must_use]
    pub fn noting(mut self, note: &str) -> Self {
        self.measured = format!("{} ({note})", self.measured);
        self
    }
}

/// Formats a number with about three significant digits and without trailing zeros.
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

/// Returns the quantile of the values at `share`, 0…1; 0 if there are none. Sorts the values.
pub fn quantile(values: &mut [f64], share: f64) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index below the length")]
    let index = (share * (values.len().saturating_sub(1)) as f64).round() as usize;
    values.get(index).copied().unwrap_or(0.0)
}

/// Returns the largest value, at least 0; NaN if any value is NaN.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |a, b| if a >= b || a.is_nan() { a } else { b })
}

/// Formats the rows as a Markdown table.
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
