//! Checks the budgets of the body's regions in a natural gaze.

use super::joint::rate;
use super::keys::{BUDGET_KEYS, REGION_KEYS};
use super::settings::{Level, Setting, Settings};
use super::{range, read};
use crate::declare::report::{Report, messages};
use crate::declare::tree::Kind;
use crate::{AngleRange, Budget, Budgets};

/// Checks `region`; `None` if any part of it was reported.
pub(super) fn check(report: &mut Report, region: Setting<'_>) -> Option<Budgets> {
    let entries = match &region.value.kind {
        Kind::Table(entries) => entries,
        Kind::Word(_) => return body(report, region),
        _ => return read::mismatch(report, region),
    };
    let settings = Settings::read(entries, REGION_KEYS, Level::Table, report);
    let like = settings.get("like").map_or(Some(Budgets::HUMAN), |setting| body(report, setting));
    let mut part = |key: &str, usual: Option<Budget>| {
        settings.get(key).map_or(usual, |setting| budget(report, setting, usual.unwrap_or(Budgets::HUMAN.head)))
    };
    let head = part("head", like.map(|like| like.head));
    let chest = part("chest", like.map(|like| like.chest));
    like.and(Some(Budgets { head: head?, chest: chest? }))
}

/// Reads the budgets of a body that is named by a word.
fn body(report: &mut Report, setting: Setting<'_>) -> Option<Budgets> {
    let Kind::Word(word) = &setting.value.kind else { return read::mismatch(report, setting) };
    match Budgets::NAMED.iter().find(|(name, _)| name == word) {
        Some((_, budgets)) => Some(*budgets),
        None => report.refuse(setting.place(), messages::unknown_body(word)),
    }
}

/// Reads a region's budget; settings that are left out keep their value in `usual`.
fn budget(report: &mut Report, part: Setting<'_>, usual: Budget) -> Option<Budget> {
    let Kind::Table(entries) = &part.value.kind else { return read::mismatch(report, part) };
    let settings = Settings::read(entries, BUDGET_KEYS, Level::Table, report);
    let mut ends = |key: &str, usual: [f64; 2]| {
        settings.get(key).map_or(Some(usual), |setting| match range::range(report, setting)? {
            AngleRange::Between(lo, hi) => Some([lo, hi]),
            AngleRange::Free => report.refuse(setting.place(), messages::budget_free()),
        })
    };
    let (heading, pitch) = (ends("heading", usual.heading), ends("pitch", usual.pitch));
    let rate = settings.get("rate").map_or(Some(usual.rate), |setting| rate(report, setting));
    let acceleration =
        settings.get("acceleration").map_or(Some(usual.acceleration), |setting| read::positive(report, setting));
    Some(Budget { heading: heading?, pitch: pitch?, rate: rate?, acceleration: acceleration? })
}
