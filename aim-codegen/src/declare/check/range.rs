//! Checks ranges of angles: both ends present, in order, around 0, within ±π.

use core::f64::consts::PI;

use super::read;
use super::settings::Setting;
use crate::AngleRange;
use crate::declare::report::expected::Expected;
use crate::declare::report::{Report, messages};
use crate::declare::tree::{Kind, Notation, Value};

/// Largest excess over ±π at which the end of a range is read as ±π: radians are written with few digits.
const ROUNDING_RAD: f64 = 1e-5;

/// Smallest useful range end, radians (1°). If both ends are smaller, a number of radians was probably written as
/// degrees.
const SMALLEST_RAD: f64 = PI / 180.0;

/// Reads the range of `heading` or `pitch`.
pub(super) fn range(report: &mut Report, setting: Setting<'_>) -> Option<AngleRange> {
    let (key, notation) = (setting.key, report.notation);
    match (&setting.value.kind, notation) {
        (Kind::Word(word), _) if word == "free" && key == "heading" => Some(AngleRange::Free),
        (Kind::Word(word), _) if word == "free" => report.refuse(setting.place(), messages::pitch_free(notation)),
        (Kind::Range { low: Some(low), high: Some(high), inclusive: true }, Notation::Rust) => {
            between(report, setting, [low, high])
        }
        (Kind::Range { low, high, .. }, Notation::Rust) => {
            report.error(setting.place(), messages::range_open(key, notation));
            for end in [low, high].into_iter().flatten() {
                read::angle(report, setting.part(Expected::ANGLE, end));
            }
            None
        }
        (Kind::List(ends), Notation::Toml) => match ends.as_slice() {
            [low, high] => between(report, setting, [low, high]),
            _ => report.refuse(setting.place(), messages::range_list(key, ends.len())),
        },
        (Kind::Number(number), _) => {
            // If the number itself is faulty, report that first.
            read::angle(report, setting)?;
            let size = number.text.trim_start_matches(['-', '+', ' ']);
            report.refuse(setting.place(), messages::range_single(key, &setting.value.describe(), size, notation))
        }
        _ => read::mismatch(report, setting),
    }
}

fn between(report: &mut Report, setting: Setting<'_>, ends: [&Value; 2]) -> Option<AngleRange> {
    let (key, [low, high]) = (setting.key, ends.map(Value::number));
    let ends = ends.map(|end| {
        let angle = read::angle(report, setting.part(Expected::ANGLE, end))?;
        if angle.abs() > PI + ROUNDING_RAD {
            return report.refuse(&end.place, messages::range_beyond(key, end.number()));
        }
        Some(angle.clamp(-PI, PI) + 0.0)
    });
    let [Some(from), Some(to)] = ends else { return None };
    let wrong = if from > to {
        messages::range_inverted(key, low, high, report.notation)
    } else if from == to {
        messages::range_empty(key)
    } else if from > 0.0 || to < 0.0 {
        messages::range_without_zero(key, low, high)
    } else if -from < SMALLEST_RAD && to < SMALLEST_RAD {
        messages::range_tiny(key, low, high, report.notation)
    } else {
        return Some(AngleRange::Between(from, to));
    };
    report.refuse(setting.place(), wrong)
}
