//! Parses literals from their text: numbers with a unit, and the words in TOML strings.

use crate::declare::source_place::SourcePlace;
use crate::declare::tree::{Kind, Number, Value};

/// Parses a number with an optional sign before it and an optional unit after it; `None` if the text does not start
/// like a number.
pub(crate) fn number(text: &str) -> Option<Number> {
    let text = text.trim();
    let (negative, unsigned) = match text.strip_prefix('-') {
        Some(rest) => (true, rest.trim_start()),
        None => (false, text.strip_prefix('+').unwrap_or(text).trim_start()),
    };
    let radix = match unsigned.get(..2) {
        Some("0x" | "0X") => Some("hexadecimal"),
        Some("0o" | "0O") => Some("octal"),
        Some("0b" | "0B") => Some("binary"),
        _ => None,
    };
    if radix.is_some() {
        return Some(Number { radix, ..Number::plain(text, f64::NAN) });
    }
    let end = digits_end(unsigned)?;
    let (digits, rest) = unsigned.split_at(end);
    let unit = rest.trim_start();
    let value: f64 = digits.replace('_', "").parse().ok()?;
    let value = if negative { -value } else { value };
    Some(Number { unit: unit.to_owned(), detached: unit.len() < rest.len(), ..Number::plain(text, value) })
}

/// Returns the end of digits, fraction and exponent, where the unit starts.
fn digits_end(text: &str) -> Option<usize> {
    let bytes = text.as_bytes();
    let run = |mut at: usize| {
        while bytes.get(at).is_some_and(|b| b.is_ascii_digit() || *b == b'_') {
            at += 1;
        }
        at
    };
    if !bytes.first()?.is_ascii_digit() {
        return None;
    }
    let mut end = run(0);
    if bytes.get(end) == Some(&b'.') && bytes.get(end + 1).is_none_or(u8::is_ascii_digit) {
        end = run(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let signed = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if bytes.get(end + 1 + signed).is_some_and(u8::is_ascii_digit) {
            end = run(end + 1 + signed);
        }
    }
    Some(end)
}

/// Parses a TOML string that is not a name: a number, an axis, a range or a word.
pub(crate) fn word(text: &str, place: &SourcePlace) -> Kind {
    let trimmed = text.trim();
    if let Some((low, high)) = trimmed.split_once("..") {
        let end = |part: &str| {
            let part = part.trim();
            (!part.is_empty()).then(|| Box::new(Value { kind: word(part, place), place: place.clone() }))
        };
        let inclusive = high.starts_with('=');
        return Kind::Range { low: end(low), high: end(high.strip_prefix('=').unwrap_or(high)), inclusive };
    }
    if let Some(number) = number(trimmed) {
        return Kind::Number(number);
    }
    if let Some(letter) = trimmed.strip_prefix(['+', '-']).filter(|rest| is_word(rest)) {
        return Kind::Axis { negative: trimmed.starts_with('-'), letter: letter.to_owned() };
    }
    if is_word(trimmed) { Kind::Word(trimmed.to_owned()) } else { Kind::Text(text.to_owned()) }
}

/// Returns `true` if the text has the form of an identifier, in any script.
pub(crate) fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_') && text.chars().all(|c| c.is_alphanumeric() || c == '_')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_their_text_and_unit() {
        for (text, value, unit) in [
            ("35deg", 35.0, "deg"),
            ("-35deg", -35.0, "deg"),
            ("- 35deg", -35.0, "deg"),
            ("+0.5rad", 0.5, "rad"),
            ("1_000.5_0deg", 1000.5, "deg"),
            ("35_deg", 35.0, "deg"),
            ("1e2deg", 100.0, "deg"),
            ("1e-2", 0.01, ""),
            ("1.", 1.0, ""),
            ("2e", 2.0, "e"),
            ("35°", 35.0, "°"),
        ] {
            let number = number(text).expect(text);
            assert_eq!((number.value, number.unit.as_str(), number.radix), (value, unit, None), "{text}");
        }
        assert!(number("35 deg").expect("a number").detached);
        assert_eq!(number("0x1deg").expect("a number").radix, Some("hexadecimal"));
        assert_eq!(number("1e999deg").expect("a number").value, f64::INFINITY);
        for text in ["", "-", "deg", ".5", "+X", "°", "..", "\u{1F600}"] {
            assert_eq!(number(text), None, "{text}");
        }
    }

    #[test]
    fn words_are_classified() {
        let place = SourcePlace::Text(0..0);
        assert!(matches!(word("+X", &place), Kind::Axis { negative: false, .. }));
        assert!(matches!(word("-Zed", &place), Kind::Axis { negative: true, .. }));
        assert!(matches!(word("free", &place), Kind::Word(_)));
        assert!(matches!(word("-1deg..=2deg", &place), Kind::Range { inclusive: true, .. }));
        assert!(matches!(word("..", &place), Kind::Range { low: None, high: None, inclusive: false }));
        assert!(matches!(word("two words", &place), Kind::Text(_)));
    }
}
