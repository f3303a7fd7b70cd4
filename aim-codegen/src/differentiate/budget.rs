//! `budget = …`: upper limits for the operations of a derived function.

use aim_symbolic::Count;

use super::messages;
use crate::declare::SourcePlace;
use crate::declare::check::keys::Key;
use crate::declare::check::read;
use crate::declare::check::settings::{Level, Setting, Settings};
use crate::declare::report::Report;
use crate::declare::report::expected::Expected;
use crate::declare::tree::Kind;

/// Upper limit of each kind in [`KINDS`], and the place where it is written.
pub(super) struct Budget {
    most: [Option<(usize, SourcePlace)>; KINDS.len()],
}

const KEYS: &[Key] =
    &[("operations", Expected::OPERATIONS), ("selects", Expected::SELECTS), ("calls", Expected::CALLS)];

/// Name of a kind of operation, and its number in a [`Count`].
type Counted = (&'static str, fn(&Count) -> usize);

/// Kinds of operations, in the order of [`KEYS`].
const KINDS: [Counted; 3] = [
    ("operations", Count::total),
    ("comparisons and selects", |count| count.select),
    ("function calls", |count| count.call),
];

impl Budget {
    /// Reads a number of operations, or `(operations = 46, selects = 2, calls = 4)`, any of which may be omitted.
    pub(super) fn read(report: &mut Report, setting: Setting<'_>) -> Option<Self> {
        let Kind::Table(entries) = &setting.value.kind else {
            let operations = number(report, setting)?;
            return Some(Self { most: [Some(operations), None, None] });
        };
        let settings = Settings::read(entries, KEYS, Level::Options, report);
        let mut most = [const { None }; KINDS.len()];
        for (most, (key, _)) in most.iter_mut().zip(KEYS) {
            *most = settings.read_value(key, report, number);
        }
        Some(Self { most })
    }

    /// Reports each limit that the function exceeds; returns `true` if there is none.
    pub(super) fn judge(&self, count: Count, report: &mut Report) -> bool {
        let mut is_kept = true;
        for ((most, (words, of)), (key, _)) in self.most.iter().zip(KINDS).zip(KEYS) {
            if let Some((most, place)) = most
                && of(&count) > *most
            {
                report.error(place, messages::over_budget(*most, words, key, of(&count), count));
                is_kept = false;
            }
        }
        is_kept
    }
}

fn number(report: &mut Report, setting: Setting<'_>) -> Option<(usize, SourcePlace)> {
    match setting.value.number().replace('_', "").parse() {
        Ok(number) => Some((number, setting.place().clone())),
        Err(_) => read::mismatch(report, setting),
    }
}
