//! Ranges of angles: both ends there, in order, around 0, within half a turn.

use core::f64::consts::PI;

use super::read;
use crate::AngleRange;
use crate::declare::report::Report;
use crate::declare::report::messages::{self, Expected};
use crate::declare::tree::{Kind, Notation, Value};

/// How far beyond ±π a range's end may lie to mean ±π: radians are written with few digits.
const ROUNDING_RAD: f64 = 1e-5;

/// Less than this to both sides is no range of motion, radians (1°): radians were written as degrees.
const SMALLEST_RAD: f64 = PI / 180.0;

/// Reads the range of `heading` or `pitch`.
pub(super) fn range(report: &mut Report, key: &str, value: &Value) -> Option<AngleRange> {
    let expected = if key == "heading" { Expected::HeadingRange } else { Expected::AngleRange };
    let notation = report.notation;
    match (&value.kind, notation) {
        (Kind::Word(word), _) if word == "free" => {
            if key == "heading" {
                return Some(AngleRange::Free);
            }
            report.error(&value.place, messages::pitch_free(notation));
            None
        }
        (Kind::Range { low: Some(low), high: Some(high), inclusive: true }, Notation::Rust) => {
            between(report, key, low, high, value)
        }
        (Kind::Range { low, high, .. }, Notation::Rust) => {
            report.error(&value.place, messages::range_open(key, notation));
            for end in [low, high].into_iter().flatten() {
                read::angle(report, key, Expected::Angle, end);
            }
            None
        }
        (Kind::List(ends), Notation::Toml) => match ends.as_slice() {
            [low, high] => between(report, key, low, high, value),
            _ => {
                report.error(&value.place, messages::range_list(key, ends.len()));
                None
            }
        },
        (Kind::Number(number), _) => {
            // A number that is itself wrong is reported as such first.
            if read::angle(report, key, expected, value).is_some() {
                let size = number.text.trim_start_matches(['-', '+', ' ']);
                report.error(&value.place, messages::range_single(key, &value.describe(), size, notation));
            }
            None
        }
        _ => {
            read::mismatch(report, key, expected, value);
            None
        }
    }
}

fn between(report: &mut Report, key: &str, low: &Value, high: &Value, whole: &Value) -> Option<AngleRange> {
    let ends = [low, high].map(|end| {
        let angle = read::angle(report, key, Expected::Angle, end)?;
        if angle.abs() > PI + ROUNDING_RAD {
            report.error(&end.place, messages::range_beyond(key, text(end)));
            return None;
        }
        Some(angle.clamp(-PI, PI) + 0.0)
    });
    let [Some(from), Some(to)] = ends else { return None };
    let wrong = if from > to {
        messages::range_inverted(key, text(low), text(high), report.notation)
    } else if from == to {
        messages::range_empty(key)
    } else if from > 0.0 || to < 0.0 {
        messages::range_without_zero(key, text(low), text(high))
    } else if -from < SMALLEST_RAD && to < SMALLEST_RAD {
        messages::range_tiny(key, [text(low), text(high)], report.notation)
    } else {
        return Some(AngleRange::Between(from, to));
    };
    report.error(&whole.place, wrong);
    None
}

/// A number as written.
fn text(value: &Value) -> &str {
    match &value.kind {
        Kind::Number(number) => &number.text,
        _ => "",
    }
}
