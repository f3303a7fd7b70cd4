//! Plausibility of a bake: as a block of the report, in words, and as a check.

use std::path::Path;

use aim_character::{Criterion, Plausibility};
use serde::Serializer;
use serde::ser::SerializeMap;

use crate::bake_report::BakeReport;
use crate::failure::{Failure, Result};
use crate::words::{fixed, listed, trimmed};

/// Serialises the block `plausibility` of a report: the worst value of each criterion, or null if it could not be
/// measured.
pub(crate) fn block<S: Serializer>(measured: &Plausibility, serializer: S) -> std::result::Result<S::Ok, S::Error> {
    let mut block = serializer.serialize_map(Some(Criterion::ALL.len()))?;
    for criterion in Criterion::ALL {
        let worst = measured.worst(criterion).map(|worst| worst.value);
        match criterion {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count of frames at most")]
            Criterion::Reversals => block.serialize_entry(criterion.key(), &worst.map(|count| count as u64))?,
            _ => block.serialize_entry(criterion.key(), &worst)?,
        }
    }
    block.end()
}

/// One criterion, formatted for display.
pub(crate) struct Row {
    pub(crate) name: &'static str,
    /// Worst value; a dash if the criterion could not be measured.
    pub(crate) value: String,
    /// Limit; `None` if there is none.
    pub(crate) limit: Option<String>,
    /// Time of the worst value.
    pub(crate) when: Option<String>,
    /// Worst value as a share of the limit; `None` if either is unknown.
    share: Option<f64>,
    /// `true` if the worst value is beyond the limit.
    pub(crate) is_exceeded: bool,
}

impl Row {
    /// Returns the name, the value and the limit.
    fn limited(&self) -> String {
        format!("{} {} (limit {})", self.name, self.value, self.limit.as_deref().unwrap_or_default())
    }
}

/// Returns a row for each criterion.
pub(crate) fn rows(measured: &Plausibility) -> impl Iterator<Item = Row> + '_ {
    Criterion::ALL.into_iter().map(|criterion| {
        let (worst, limit) = (measured.worst(criterion), criterion.must(measured.is_humanoid));
        Row {
            name: name(criterion),
            value: worst.map_or_else(|| "–".to_owned(), |worst| shown(criterion, worst.value)),
            limit: limit.map(|limit| shown(criterion, limit)),
            // The time of a value that is shown as 0 says nothing.
            when: worst
                .filter(|worst| shown(criterion, worst.value) != shown(criterion, 0.0))
                .map(|worst| format!("{} s", fixed(worst.t, 2))),
            share: worst.zip(limit).map(|(worst, limit)| worst.value / limit),
            is_exceeded: worst.zip(limit).is_some_and(|(worst, limit)| worst.value > limit),
        }
    })
}

fn name(criterion: Criterion) -> &'static str {
    match criterion {
        Criterion::HeadToChestHeading => "head relative to chest",
        Criterion::HeadRoll => "head roll",
        Criterion::ElevationError => "vertical gaze error",
        Criterion::HeadingError => "horizontal gaze error",
        Criterion::LimbShift => "hand and clavicle shift beyond the chest's turn",
        Criterion::HeadSpeed => "head speed",
        Criterion::HeadAcceleration => "head acceleration",
        Criterion::Reversals => "acceleration reversals",
    }
}

fn shown(criterion: Criterion, value: f64) -> String {
    match criterion {
        Criterion::LimbShift => format!("{} % of the height", trimmed(100.0 * value, 1)),
        Criterion::HeadSpeed => format!("{}°/s", trimmed(value, 0)),
        Criterion::HeadAcceleration => format!("{}°/s²", trimmed(value, 0)),
        Criterion::Reversals if value > 0.0 => format!("{} in 0.5 s", trimmed(value, 0)),
        Criterion::Reversals => trimmed(value, 0),
        _ => format!("{}°", trimmed(value, 1)),
    }
}

/// Returns the exceeded criteria in words, each with its limit and the time of its worst value.
fn exceeded(measured: &Plausibility) -> Vec<String> {
    let too_much = rows(measured).filter(|row| row.is_exceeded);
    too_much.map(|row| format!("{} at {}", row.limited(), row.when.as_deref().unwrap_or_default())).collect()
}

/// Returns a line that names the value nearest to its limit; if any limits are exceeded, two lines: one with all values,
/// and one with those beyond their limits.
pub(crate) fn in_words(measured: &Plausibility) -> String {
    let exceeded = exceeded(measured);
    if !exceeded.is_empty() {
        let all: Vec<String> = rows(measured).map(|row| format!("{} {}", row.name, row.value)).collect();
        return format!("plausibility: {}\nexceeds plausible limits: {}", all.join(", "), exceeded.join(", "));
    }
    let nearest = rows(measured).filter_map(|row| Some((row.share?, row)));
    // Of equal shares, the first.
    match nearest.reduce(|nearest, row| if row.0 > nearest.0 { row } else { nearest }) {
        Some((_, row)) => {
            format!("plausibility: all values within their limits; nearest to its limit: {}", row.limited())
        }
        None => "plausibility: no value could be compared with a limit".to_owned(),
    }
}

/// Checks that no limit is exceeded and that the gaze was on the target at all. `moving` is the name of a target node
/// that moves with the gaze.
///
/// # Errors
/// A value is beyond its limit, no frame has a direction to aim in, or none is on a target that moves with the gaze; the
/// message lists all of these. `file` has been written nevertheless.
pub(crate) fn insist(report: &BakeReport, moving: Option<&str>, file: &Path) -> Result {
    let mut problems = Vec::new();
    if report.frames.iter().all(|frame| frame.status == "degenerate") {
        problems.push("no frame has a direction to aim in".to_owned());
    } else if let (0, Some(name)) = (report.summary.reached, moving) {
        problems.push(format!("no frame is {}: {name} moves with the gaze", report.on_it()));
    }
    let exceeded = exceeded(&report.plausibility);
    if !exceeded.is_empty() {
        let parts: Vec<&str> = exceeded.iter().map(String::as_str).collect();
        problems.push(format!("it exceeds plausible limits: {}", listed(&parts)));
    }
    if problems.is_empty() {
        return Ok(());
    }
    Err(Failure::Check(format!("{}: written, but {}", file.display(), problems.join("; "))))
}
