//! Values of the tree → typed values; each either comes out whole or is reported.

use super::frame;
use crate::declare::parse::literal;
use crate::declare::place::Place;
use crate::declare::report::Report;
use crate::declare::report::messages::{self, Expected};
use crate::declare::report::text::Text;
use crate::declare::tree::{Kind, Notation, Number, Value};
use crate::names;
use aim_model::Role;

/// Reports a value of the wrong kind, with the help that fits what was found.
pub(super) fn mismatch(report: &mut Report, key: &str, expected: Expected, value: &Value) {
    let found = value.describe();
    let notation = report.notation;
    let text = match &value.kind {
        Kind::Word(_) if takes_words(expected) => messages::expected(key, expected, &found, notation),
        Kind::Word(_) | Kind::Path(_) | Kind::Other(_) => messages::not_literal(key, expected, &found, notation),
        // `-LIMIT`: it has the form of an axis, but a constant is what was meant.
        Kind::Axis { letter, .. } if frame::axis(letter, false).is_none() => {
            messages::not_literal(key, expected, &found, notation)
        }
        Kind::Text(text) if notation == Notation::Rust && !takes_strings(expected) => {
            match literal::word(text, &value.place) {
                Kind::Text(_) => messages::expected(key, expected, &found, notation),
                Kind::Number(number) if takes_units(expected) => match radians(key, &number, notation) {
                    Ok(_) => messages::quoted(key, expected, &found, text),
                    // The quotes were put around what does not lex without, such as `35°`.
                    Err(text) => text,
                },
                _ => messages::quoted(key, expected, &found, text),
            }
        }
        _ => messages::expected(key, expected, &found, notation),
    };
    report.error(&value.place, text);
}

fn takes_words(expected: Expected) -> bool {
    matches!(expected, Expected::Side | Expected::LimitsFrom | Expected::Role | Expected::Flag)
}

fn takes_strings(expected: Expected) -> bool {
    matches!(expected, Expected::NodeName | Expected::NodeNames | Expected::Name)
}

fn takes_units(expected: Expected) -> bool {
    matches!(
        expected,
        Expected::Angle | Expected::AngleRange | Expected::HeadingRange | Expected::Rate | Expected::Acceleration
    )
}

/// An angle in radians, finite or not.
pub(super) fn angle(report: &mut Report, key: &str, expected: Expected, value: &Value) -> Option<f64> {
    let Kind::Number(number) = &value.kind else {
        mismatch(report, key, expected, value);
        return None;
    };
    match radians(key, number, report.notation) {
        Ok(angle) => Some(angle),
        Err(text) => {
            report.error(&value.place, text);
            None
        }
    }
}

/// The number in radians, or what is wrong with its unit.
fn radians(key: &str, number: &Number, notation: Notation) -> Result<f64, Text> {
    Err(if let Some(radix) = number.radix {
        messages::radix(&number.text, radix)
    } else if number.unit.is_empty() && !number.value.is_finite() {
        messages::not_finite(key, &number.text)
    } else if number.detached {
        messages::detached_unit(number.digits(), &number.unit, notation)
    } else {
        match number.unit.as_str() {
            "deg" => return Ok(number.value.to_radians()),
            "rad" => return Ok(number.value),
            "" => messages::missing_unit(number.digits(), notation),
            unit => messages::unknown_unit(number.digits(), unit, notation),
        }
    })
}

/// A positive, finite angle, in radians: a rate or an acceleration.
pub(super) fn positive_angle(report: &mut Report, key: &str, expected: Expected, value: &Value) -> Option<f64> {
    let angle = angle(report, key, expected, value)?;
    positive(report, key, angle, value)
}

/// A positive, finite number without a unit.
pub(super) fn positive_number(report: &mut Report, key: &str, value: &Value) -> Option<f64> {
    let number = plain(report, key, Expected::Number, value)?;
    positive(report, key, number, value)
}

fn positive(report: &mut Report, key: &str, found: f64, value: &Value) -> Option<f64> {
    let text = value.describe();
    let text = text.trim_matches('`');
    // The runtime holds single precision: beyond its largest number is infinite to it, below its smallest is zero.
    if !fits(found) {
        report.error(&value.place, messages::not_finite(key, text));
    } else if found < f64::from(f32::MIN_POSITIVE) {
        let zero = found > -f64::from(f32::MIN_POSITIVE);
        report.error(&value.place, messages::not_positive(key, text, zero));
    } else {
        return Some(found);
    }
    None
}

fn fits(value: f64) -> bool {
    value.abs() <= f64::from(f32::MAX)
}

/// A finite number without a unit.
pub(super) fn plain(report: &mut Report, key: &str, expected: Expected, value: &Value) -> Option<f64> {
    let Kind::Number(number) = &value.kind else {
        mismatch(report, key, expected, value);
        return None;
    };
    let Number { text, unit, .. } = number;
    let text = if let Some(radix) = number.radix {
        messages::radix(text, radix)
    } else if !unit.is_empty() {
        messages::unit_on_plain(key, number.digits(), unit)
    } else if !fits(number.value) {
        messages::not_finite(key, text)
    } else {
        return Some(number.value);
    };
    report.error(&value.place, text);
    None
}

/// A number from 0 to 1.
pub(super) fn share(report: &mut Report, key: &str, value: &Value) -> Option<f64> {
    let share = plain(report, key, Expected::Number, value)?;
    if (0.0..=1.0).contains(&share) {
        return Some(share + 0.0);
    }
    report.error(&value.place, messages::share_outside(key, value.describe().trim_matches('`')));
    None
}

/// `true` or `false`.
pub(super) fn flag(report: &mut Report, key: &str, value: &Value) -> Option<bool> {
    if let Kind::Bool(flag) = value.kind {
        return Some(flag);
    }
    mismatch(report, key, Expected::Flag, value);
    None
}

/// One of two words: whether it is the first.
pub(super) fn either(
    report: &mut Report,
    key: &str,
    expected: Expected,
    words: [&str; 2],
    value: &Value,
) -> Option<bool> {
    match &value.kind {
        Kind::Word(word) if word == words[0] => Some(true),
        Kind::Word(word) if word == words[1] => Some(false),
        Kind::Word(word) if words.contains(&word.to_lowercase().as_str()) => {
            report.error(&value.place, messages::capitals(key, expected, word, report.notation));
            None
        }
        _ => {
            mismatch(report, key, expected, value);
            None
        }
    }
}

/// A role.
pub(super) fn role(report: &mut Report, key: &str, value: &Value) -> Option<Role> {
    let Kind::Word(word) = &value.kind else {
        mismatch(report, key, Expected::Role, value);
        return None;
    };
    if let Some(role) = Role::ALL.into_iter().find(|role| role.as_str() == word) {
        return Some(role);
    }
    let nearest = names::nearest(word, Role::ALL.into_iter().map(Role::as_str));
    let nearest = nearest.and_then(|near| Role::ALL.into_iter().find(|role| role.as_str() == near));
    report.error(
        &value.place,
        messages::unknown_role(word, nearest.or_else(|| aim_model::BoneName::new(word).role()), report.notation),
    );
    None
}

/// A node's name.
pub(super) fn node<'t>(
    report: &mut Report,
    key: &str,
    expected: Expected,
    value: &'t Value,
) -> Option<(&'t str, &'t Place)> {
    let Kind::Text(text) = &value.kind else {
        mismatch(report, key, expected, value);
        return None;
    };
    if text.trim().is_empty() {
        report.error(&value.place, messages::empty_bone(key));
        return None;
    }
    Some((text, &value.place))
}

/// A node's name, or a list of them.
pub(super) fn nodes<'t>(report: &mut Report, key: &str, value: &'t Value) -> Vec<(&'t str, &'t Place)> {
    match &value.kind {
        Kind::List(values) if values.is_empty() => {
            report.error(&value.place, messages::empty_bone(key));
            Vec::new()
        }
        Kind::List(values) => values.iter().filter_map(|value| node(report, key, Expected::NodeName, value)).collect(),
        _ => node(report, key, Expected::NodeNames, value).into_iter().collect(),
    }
}

/// Three finite numbers, in the notation's brackets.
pub(super) fn vector(report: &mut Report, key: &str, expected: Expected, value: &Value) -> Option<[f64; 3]> {
    let ((Kind::Tuple(values), Notation::Rust) | (Kind::List(values), Notation::Toml)) = (&value.kind, report.notation)
    else {
        mismatch(report, key, expected, value);
        return None;
    };
    let [x, y, z] = values.as_slice() else {
        report.error(&value.place, messages::vector_length(key, values.len()));
        return None;
    };
    // All three are read before any is given up.
    let [x, y, z] = [x, y, z].map(|value| plain(report, key, Expected::Number, value));
    Some([x?, y?, z?])
}
