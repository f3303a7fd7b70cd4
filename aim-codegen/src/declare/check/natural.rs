//! How a natural gaze is shared.

use core::f64::consts::PI;

use super::keys::NATURAL_KEYS;
use super::read;
use super::settings::{Level, Settings};
use crate::NaturalSpec;
use crate::declare::report::Report;
use crate::declare::report::messages::{self, Expected};
use crate::declare::tree::{Kind, Value};

/// Checks `natural`; `None` if anything of it was reported.
pub(super) fn check(value: &Value, report: &mut Report) -> Option<NaturalSpec> {
    let Kind::Table(entries) = &value.kind else {
        read::mismatch(report, "natural", Expected::Natural, value);
        return None;
    };
    let settings = Settings::read(entries, NATURAL_KEYS, Level::Table, report);
    let usual = NaturalSpec::default();
    let mut angle = |key: &str, usual: f64| settings.get(key).map_or(Some(usual), |value| angle(report, key, value));
    let [eyes_only, engage, release] =
        [("eyes_only", usual.eyes_only), ("engage", usual.engage), ("release", usual.release)]
            .map(|(key, usual)| angle(key, usual));
    let head_share =
        settings.get("head_share").map_or(Some(usual.head_share), |value| read::share(report, "head_share", value));
    let delay = settings.get("delay").map_or(Some(usual.delay), |value| delay(report, value));
    let (engage, release) = (engage?, release?);
    if release > engage {
        // Where both are set the second is the one to change.
        let place = settings.get("release").or_else(|| settings.get("engage")).map_or(&value.place, |set| &set.place);
        report.error(place, messages::release_above_engage(shown_deg(engage), shown_deg(release)));
        return None;
    }
    Some(NaturalSpec { eyes_only: eyes_only?, head_share: head_share?, engage, release, delay: delay? })
}

/// An angle between two directions, radians.
fn angle(report: &mut Report, key: &str, value: &Value) -> Option<f64> {
    let angle = read::angle(report, key, Expected::Angle, value)?;
    // Radians are written with few digits: a little more than π is π.
    if (0.0..=PI + 1e-5).contains(&angle) {
        return Some(angle.min(PI) + 0.0);
    }
    report.error(&value.place, messages::angle_outside(key, value.describe().trim_matches('`')));
    None
}

fn delay(report: &mut Report, value: &Value) -> Option<f64> {
    let delay = read::plain(report, "delay", Expected::Seconds, value)?;
    if delay >= 0.0 {
        return Some(delay + 0.0);
    }
    report.error(&value.place, messages::negative_delay(value.describe().trim_matches('`')));
    None
}

fn shown_deg(angle_rad: f64) -> f64 {
    (angle_rad.to_degrees() * 1e3).round() / 1e3
}
