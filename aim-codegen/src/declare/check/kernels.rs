//! The kernels that are wanted as functions of the rig: names of objectives, each once.

use super::read;
use crate::declare::place::Place;
use crate::declare::report::Report;
use crate::declare::report::messages::{self, Expected};
use crate::declare::report::text;
use crate::declare::tree::{Entry, Item, Kind, Value};
use crate::objective::OBJECTIVES;

/// Checks `kernels`; what was reported is left out.
pub(super) fn check(value: &Value, report: &mut Report) -> Vec<&'static str> {
    let mut found: Vec<(&'static str, &Place)> = Vec::new();
    for (name, place) in words(value, report) {
        let known = OBJECTIVES.map(|objective| objective.name);
        let Some(objective) = known.into_iter().find(|known| *known == name) else {
            report.error(place, messages::unknown_kernel(name, &known));
            continue;
        };
        match found.iter().find(|(other, _)| *other == objective) {
            Some((_, first)) => {
                report.error_with_note(place, messages::duplicate_kernel(name), text::first_use(name), first);
            }
            None => found.push((objective, place)),
        }
    }
    found.into_iter().map(|(name, _)| name).collect()
}

/// The words of `kernels(a, b)` or `["a", "b"]`.
fn words<'t>(value: &'t Value, report: &mut Report) -> Vec<(&'t str, &'t Place)> {
    let mut words = Vec::new();
    match &value.kind {
        Kind::List(values) => {
            for value in values {
                match &value.kind {
                    Kind::Word(word) => words.push((&word[..], &value.place)),
                    _ => read::mismatch(report, "kernels", Expected::Kernels, value),
                }
            }
        }
        Kind::Table(entries) => {
            for entry in entries {
                match entry {
                    Entry::Item(Item { key, value }) if matches!(value.kind, Kind::Absent) => {
                        words.push((&key.text[..], &key.place));
                    }
                    Entry::Item(Item { value, .. }) => read::mismatch(report, "kernels", Expected::Kernels, value),
                    Entry::Stray(word) => report.error(&word.place, messages::stray(&word.text)),
                    Entry::NoComma(word) => report.error(&word.place, text::no_comma(&word.text, "kernels")),
                    #[cfg(feature = "toml")]
                    Entry::Repeated { key, .. } => report.error(&key.place, messages::duplicate_key(&key.text)),
                }
            }
        }
        _ => read::mismatch(report, "kernels", Expected::Kernels, value),
    }
    words
}
