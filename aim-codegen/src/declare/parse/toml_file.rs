//! Parses a TOML file into the neutral tree, with byte ranges. Reports only violations of the TOML syntax itself.

use core::ops::Range;

use toml::Spanned;
use toml::de::{DeString, DeTable, DeValue};

use super::literal;
use crate::declare::report::diagnostics::Diagnostic;
use crate::declare::report::messages;
use crate::declare::source_place::SourcePlace;
use crate::declare::tree::{Entry, Item, ItemFacts, Joint, Kind, Notation, Number, Rig, Section, Value, Word};

/// Parses the text; the diagnostics are syntax errors.
pub(crate) fn read(text: &str) -> (Rig, Vec<Diagnostic>) {
    let (document, errors) = DeTable::parse_recoverable(text);
    let mut table = entries(document.get_ref());
    let mut syntax = Vec::new();
    let single = table.iter().find_map(|entry| match entry {
        Entry::Item(Item { key, value: Value { kind: Kind::Table(_), place } }) if key.text == "joint" => {
            Some(place.clone())
        }
        _ => None,
    });
    for error in errors {
        let span = error.span().unwrap_or(text.len()..text.len());
        match (error.message(), text.get(span.clone())) {
            ("duplicate key", Some(key)) => {
                let key = key.trim_matches(['"', '\'']).to_owned();
                let first = nearest_before(&table, &key, span.start);
                table.push(Entry::Repeated { key: Word { text: key, place: SourcePlace::Text(span) }, first });
            }
            (message, part) => {
                let message = messages::syntax(message, part.unwrap_or_default());
                syntax.push(Diagnostic::new(message, SourcePlace::Text(span)));
            }
        }
    }
    if let Some(place) = single {
        // All other errors in such a file follow from this one.
        syntax = vec![Diagnostic::new(messages::single_joint(), place)];
    }
    let start = SourcePlace::Text(0..0);
    let joints = joints(&mut table);
    let rig = Rig {
        notation: Notation::Toml,
        name: take(&mut table, "name", |_| true),
        section: Section { place: start, attributes: Vec::new(), entries: table },
        joints,
        item: ItemFacts::default(),
    };
    (rig, syntax)
}

/// Removes the joints of `[[joint]]` from the table and returns them; empty if `joint` has another form.
fn joints(table: &mut Vec<Entry>) -> Vec<Joint> {
    let is_table = |value: &Value| matches!(value.kind, Kind::Table(_));
    let is_list = |value: &Value| matches!(&value.kind, Kind::List(all) if all.iter().all(is_table));
    let Some(Value { kind: Kind::List(all), .. }) = take(table, "joint", is_list) else { return Vec::new() };
    let joint = |Value { kind, place }| {
        let Kind::Table(mut entries) = kind else { return None };
        let name = take(&mut entries, "name", |_| true);
        Some(Joint { name, section: Section { place, attributes: Vec::new(), entries } })
    };
    all.into_iter().filter_map(joint).collect()
}

/// Removes the value of a key from the table and returns it, if it fits.
fn take(entries: &mut Vec<Entry>, key: &str, fits: impl Fn(&Value) -> bool) -> Option<Value> {
    let is_it = |entry: &Entry| matches!(entry, Entry::Item(item) if item.key.text == key && fits(&item.value));
    let at = entries.iter().position(is_it)?;
    if let Entry::Item(item) = entries.remove(at) { Some(item.value) } else { None }
}

fn entries(table: &DeTable<'_>) -> Vec<Entry> {
    let mut entries: Vec<(Range<usize>, Entry)> = table
        .iter()
        .map(|(key, value)| {
            let item = Item { key: word(key), value: read_value(key.get_ref(), value) };
            (key.span(), Entry::Item(item))
        })
        .collect();
    entries.sort_by_key(|(span, _)| span.start);
    entries.into_iter().map(|(_, entry)| entry).collect()
}

fn word(key: &Spanned<DeString<'_>>) -> Word {
    Word { text: key.get_ref().to_string(), place: SourcePlace::Text(key.span()) }
}

fn read_value(key: &str, value: &Spanned<DeValue<'_>>) -> Value {
    let place = SourcePlace::Text(value.span());
    let number = |text: &str| {
        // Infinities and NaN have no digits.
        let special = || text.parse().ok().map(|value| Number::plain(text, value));
        literal::number(text).or_else(special).map_or(Kind::Other("a number out of range"), Kind::Number)
    };
    let kind = match value.get_ref() {
        // Names are plain strings; any other string is parsed by its own syntax.
        DeValue::String(text) if matches!(key, "name" | "bone" | "other_eye" | "hold") => Kind::Text(text.to_string()),
        DeValue::String(text) => literal::word(text, &place),
        DeValue::Integer(integer) => number(&integer.to_string()),
        DeValue::Float(float) => number(float.as_str()),
        DeValue::Boolean(flag) => Kind::Bool(*flag),
        DeValue::Datetime(_) => Kind::Other("a date"),
        DeValue::Array(values) => Kind::List(values.iter().map(|value| read_value(key, value)).collect()),
        DeValue::Table(table) => Kind::Table(entries(table)),
    };
    Value { kind, place }
}

/// Returns the place of the key's previous occurrence: the nearest one above `before`, because the parser does not say
/// which table the repeated key fell into.
fn nearest_before(entries: &[Entry], key: &str, before: usize) -> Option<SourcePlace> {
    let mut nearest: Option<SourcePlace> = None;
    let mut open: Vec<&Entry> = entries.iter().collect();
    while let Some(entry) = open.pop() {
        let Entry::Item(item) = entry else { continue };
        let offset = item.key.place.offset();
        let nearer = nearest.as_ref().is_none_or(|found| found.offset() < offset);
        if item.key.text == key && offset < before && nearer {
            nearest = Some(item.key.place.clone());
        }
        match &item.value.kind {
            Kind::Table(entries) => open.extend(entries),
            Kind::List(values) => open.extend(values.iter().flat_map(|value| match &value.kind {
                Kind::Table(entries) => entries.as_slice(),
                _ => &[],
            })),
            _ => {}
        }
    }
    nearest
}
