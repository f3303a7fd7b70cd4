//! Checks the sharing of a natural gaze.

use core::f64::consts::PI;

use super::keys::NATURAL_KEYS;
use super::read;
use super::settings::{Level, Setting, Settings};
use crate::NaturalSpec;
use crate::declare::report::{Report, messages};
use crate::declare::tree::Kind;

/// Checks `natural`; `None` if any part of it was reported.
pub(super) fn check(report: &mut Report, natural: Setting<'_>) -> Option<NaturalSpec> {
    let Kind::Table(entries) = &natural.value.kind else { return read::mismatch(report, natural) };
    let settings = Settings::read(entries, NATURAL_KEYS, Level::Table, report);
    let mut number = |key: &str, usual: f64, read: fn(&mut Report, Setting<'_>) -> Option<f64>| {
        settings.get(key).map_or(Some(usual), |setting| read(report, setting))
    };
    let usual = NaturalSpec::default();
    let eyes_only = number("eyes_only", usual.eyes_only, angle);
    // A user who lowers one of these wants the head to move sooner. So `engage` defaults to at most `eyes_only`, and
    // `release` to at most `engage`.
    let engage = number("engage", usual.engage.min(eyes_only.unwrap_or(PI)), angle);
    let release = number("release", usual.release.min(engage.unwrap_or(PI)), angle);
    let head_share = number("head_share", usual.head_share, read::share);
    let delay = number("delay", usual.delay, delay);
    let (engage, release) = (engage?, release?);
    if release > engage {
        // If both are set, the second is the one to change.
        let at = settings.get("release").or_else(|| settings.get("engage")).unwrap_or(natural);
        let [engage_deg, release_deg] = [engage, release].map(|angle| (angle.to_degrees() * 1e3).round() / 1e3);
        return report.refuse(at.place(), messages::release_above_engage(engage_deg, release_deg));
    }
    Some(NaturalSpec { eyes_only: eyes_only?, head_share: head_share?, engage, release, delay: delay? })
}

/// Reads an angle between two directions, in radians, 0…π.
fn angle(report: &mut Report, setting: Setting<'_>) -> Option<f64> {
    let angle = read::angle(report, setting)?;
    // Radians are written with few digits, so accept slightly more than π as π.
    if (0.0..=PI + 1e-5).contains(&angle) {
        return Some(angle.min(PI) + 0.0);
    }
    report.refuse(setting.place(), messages::angle_outside(setting.key, setting.value.number()))
}

fn delay(report: &mut Report, setting: Setting<'_>) -> Option<f64> {
    let delay = read::plain(report, setting)?;
    if delay >= 0.0 {
        return Some(delay + 0.0);
    }
    report.refuse(setting.place(), messages::negative_delay(setting.value.number()))
}
