//! Converts values of the tree to typed values. Each function returns the complete value, or reports an error.

use aim_model::{BoneName, Role};

use super::frame;
use super::settings::Setting;
use crate::declare::parse::literal;
use crate::declare::report::expected::{Expected, Form};
use crate::declare::report::text::Text;
use crate::declare::report::{Report, messages, text};
use crate::declare::source_place::SourcePlace;
use crate::declare::tree::{Entry, Item, Kind, Notation, Number, Value};
use crate::names;

/// Reports a value of the wrong kind, with help chosen by the kind that was found.
pub(crate) fn mismatch<T>(report: &mut Report, setting: Setting<'_>) -> Option<T> {
    let Setting { key, expected, value } = setting;
    let (found, notation) = (value.describe(), report.notation);
    let text = match &value.kind {
        Kind::Word(_) if expected.form == Form::Word => messages::expected(key, expected, &found, notation),
        Kind::Word(_) | Kind::Path(_) | Kind::Other(_) => messages::not_literal(key, expected, &found, notation),
        // `-LIMIT` has the form of an axis, but was meant as a constant.
        Kind::Axis { letter, .. } if frame::axis(letter, false).is_none() => {
            messages::not_literal(key, expected, &found, notation)
        }
        Kind::Text(text) if notation == Notation::Rust && expected.form != Form::Text => {
            match literal::word(text, &value.place) {
                Kind::Text(_) => messages::expected(key, expected, &found, notation),
                Kind::Word(_) if expected.form == Form::Other => messages::expected(key, expected, &found, notation),
                Kind::Number(number) if expected.form == Form::Angle => match radians(key, &number, notation) {
                    Ok(_) => messages::quoted(key, expected, &found, text),
                    // Quoted because it does not lex otherwise, such as `35°`.
                    Err(text) => text,
                },
                _ => messages::quoted(key, expected, &found, text),
            }
        }
        _ => messages::expected(key, expected, &found, notation),
    };
    report.refuse(&value.place, text)
}

/// Reads an angle in radians; it may be infinite or NaN.
pub(super) fn angle(report: &mut Report, setting: Setting<'_>) -> Option<f64> {
    let Kind::Number(number) = &setting.value.kind else { return mismatch(report, setting) };
    let angle = radians(setting.key, number, report.notation);
    report.accept(setting.place(), angle)
}

/// Converts the number to radians, or returns the error about its unit.
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

/// Reads a positive, finite number: in radians for an angle, a rate or an acceleration, otherwise without a unit.
pub(super) fn positive(report: &mut Report, setting: Setting<'_>) -> Option<f64> {
    let found = if setting.expected.form == Form::Angle { angle } else { plain }(report, setting)?;
    let text = setting.value.number();
    // The runtime stores `f32`: larger numbers would become infinite there, smaller ones zero.
    if !fits(found) {
        report.refuse(setting.place(), messages::not_finite(setting.key, text))
    } else if found < f64::from(f32::MIN_POSITIVE) {
        let zero = found > -f64::from(f32::MIN_POSITIVE);
        report.refuse(setting.place(), messages::not_positive(setting.key, text, zero))
    } else {
        Some(found)
    }
}

fn fits(value: f64) -> bool {
    value.abs() <= f64::from(f32::MAX)
}

/// Reads a finite number without a unit.
pub(super) fn plain(report: &mut Report, setting: Setting<'_>) -> Option<f64> {
    let Kind::Number(number) = &setting.value.kind else { return mismatch(report, setting) };
    let Number { text, unit, .. } = number;
    let text = if let Some(radix) = number.radix {
        messages::radix(text, radix)
    } else if !unit.is_empty() {
        messages::unit_on_plain(setting.key, number.digits(), unit)
    } else if !fits(number.value) {
        messages::not_finite(setting.key, text)
    } else {
        return Some(number.value);
    };
    report.refuse(setting.place(), text)
}

/// Reads a number from 0 to 1.
pub(super) fn share(report: &mut Report, setting: Setting<'_>) -> Option<f64> {
    let share = plain(report, setting)?;
    if (0.0..=1.0).contains(&share) {
        return Some(share + 0.0);
    }
    report.refuse(setting.place(), messages::share_outside(setting.key, setting.value.number()))
}

/// Reads `true` or `false`.
pub(super) fn flag(report: &mut Report, setting: Setting<'_>) -> Option<bool> {
    if let Kind::Bool(flag) = setting.value.kind { Some(flag) } else { mismatch(report, setting) }
}

/// Reads one of two words; returns `true` if it is the first.
pub(crate) fn is_first_of(report: &mut Report, setting: Setting<'_>, words: [&str; 2]) -> Option<bool> {
    match &setting.value.kind {
        Kind::Word(word) if words.contains(&word.as_str()) => Some(word == words[0]),
        Kind::Word(word) if words.contains(&word.to_lowercase().as_str()) => {
            let text = messages::capitals(setting.key, setting.expected, word, report.notation);
            report.refuse(setting.place(), text)
        }
        _ => mismatch(report, setting),
    }
}

/// Reads a role.
pub(super) fn role(report: &mut Report, setting: Setting<'_>) -> Option<Role> {
    let Kind::Word(word) = &setting.value.kind else { return mismatch(report, setting) };
    let named = |name: &str| Role::ALL.into_iter().find(|role| role.as_str() == name);
    named(word).or_else(|| {
        let nearest = names::nearest(word, &Role::ALL.map(Role::as_str)).and_then(named);
        let meant = nearest.or_else(|| BoneName::new(word).role());
        report.refuse(setting.place(), messages::unknown_role(word, meant, report.notation))
    })
}

/// Reads a path, as tokens.
pub(crate) fn path(report: &mut Report, setting: Setting<'_>) -> Option<proc_macro2::TokenStream> {
    if let Kind::Path(path) = &setting.value.kind { Some(path.clone()) } else { mismatch(report, setting) }
}

/// Reads a node's name.
pub(super) fn node(report: &mut Report, setting: Setting<'_>) -> Option<String> {
    match &setting.value.kind {
        Kind::Text(text) if text.trim().is_empty() => report.refuse(setting.place(), messages::empty_bone(setting.key)),
        Kind::Text(text) => Some(text.clone()),
        _ => mismatch(report, setting),
    }
}

/// Reads a node's name, or a non-empty list of them.
pub(super) fn nodes(report: &mut Report, setting: Setting<'_>) -> Option<Vec<String>> {
    match &setting.value.kind {
        Kind::List(values) if values.is_empty() => report.refuse(setting.place(), messages::empty_bone(setting.key)),
        _ => any_nodes(report, setting),
    }
}

/// Reads a node's name, or a list of them that may be empty.
pub(super) fn any_nodes(report: &mut Report, setting: Setting<'_>) -> Option<Vec<String>> {
    match &setting.value.kind {
        Kind::List(values) => {
            values.iter().map(|value| node(report, setting.part(Expected::NODE_NAME, value))).collect()
        }
        _ => node(report, setting).map(|node| vec![node]),
    }
}

/// Reads bare words, `key(a, b)` or `key = ["a", "b"]`, each at most once. `plural` is the messages' word for what they
/// name.
pub(crate) fn words<'t>(report: &mut Report, setting: Setting<'t>, plural: &str) -> Vec<(&'t str, &'t SourcePlace)> {
    let mut words = Vec::new();
    add_words(report, setting, (plural, None), &mut words);
    words.into_iter().map(|word| (word.text, word.place)).collect()
}

/// Reads bare words like [`words`], some of which may stand in `wrapper(…)`.
pub(crate) fn wrapped_words<'t>(
    report: &mut Report,
    setting: Setting<'t>,
    plural: &str,
    wrapper: &str,
) -> Vec<ListedWord<'t>> {
    let mut words = Vec::new();
    add_words(report, setting, (plural, Some(wrapper)), &mut words);
    words
}

/// A bare word that was read from a list.
pub(crate) struct ListedWord<'t> {
    pub(crate) text: &'t str,
    pub(crate) place: &'t SourcePlace,
    /// `true` if the word stands in a wrapper.
    pub(crate) wrapped: bool,
}

fn add_words<'t>(
    report: &mut Report,
    setting: Setting<'t>,
    (plural, wrapper): (&str, Option<&str>),
    words: &mut Vec<ListedWord<'t>>,
) {
    let key = setting.key;
    let wrapped = wrapper.is_some_and(|wrapper| wrapper == key);
    let add = |report: &mut Report, words: &mut Vec<ListedWord<'t>>, text: &'t str, place: &'t SourcePlace| match words
        .iter()
        .find(|other| other.text == text)
    {
        Some(first) => {
            let note = messages::first_use(text);
            report.error_with_note(place, messages::duplicate_word(text), note, first.place);
        }
        None => words.push(ListedWord { text, place, wrapped }),
    };
    let wrong = |report: &mut Report, value: &Value| mismatch::<()>(report, Setting { value, ..setting });
    match &setting.value.kind {
        Kind::List(values) => {
            for value in values {
                match &value.kind {
                    Kind::Word(word) => add(report, words, word, &value.place),
                    _ => _ = wrong(report, value),
                }
            }
        }
        Kind::Table(entries) => {
            for entry in entries {
                match entry {
                    Entry::Item(Item { key, value: Value { kind: Kind::Absent, .. } }) => {
                        add(report, words, &key.text, &key.place);
                    }
                    Entry::Item(Item { key, value: value @ Value { kind: Kind::Table(_), .. } })
                        if !wrapped && wrapper.is_some_and(|wrapper| wrapper == key.text) =>
                    {
                        add_words(report, Setting { key: &key.text, value, ..setting }, (plural, wrapper), words);
                    }
                    Entry::Item(Item { key, value: Value { kind: Kind::Unassigned, place } }) => {
                        report.error(place, text::not_a_name(&key.text, plural));
                    }
                    Entry::Item(Item { value, .. }) => _ = wrong(report, value),
                    Entry::Stray(word) => {
                        let found = format!("`{}`", word.text);
                        let text = messages::expected(key, setting.expected, &found, report.notation);
                        report.error(&word.place, text);
                    }
                    Entry::NoComma(word) => report.error(&word.place, text::no_comma(&word.text, plural)),
                    #[cfg(feature = "toml")]
                    Entry::Repeated { key, .. } => report.error(&key.place, messages::duplicate_key(&key.text)),
                }
            }
        }
        _ => _ = wrong(report, setting.value),
    }
}

/// Reads three finite numbers, in the notation's brackets.
pub(super) fn vector(report: &mut Report, setting: Setting<'_>) -> Option<[f64; 3]> {
    let ((Kind::Tuple(values), Notation::Rust) | (Kind::List(values), Notation::Toml)) =
        (&setting.value.kind, report.notation)
    else {
        return mismatch(report, setting);
    };
    let [x, y, z] = values.as_slice() else {
        return report.refuse(setting.place(), messages::vector_length(setting.key, values.len()));
    };
    // Read all three before returning, so that each error is reported.
    let [x, y, z] = [x, y, z].map(|value| plain(report, setting.part(Expected::NUMBER, value)));
    Some([x?, y?, z?])
}
