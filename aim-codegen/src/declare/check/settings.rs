//! [`Settings`]: entries by key. Reports unknown, repeated and misplaced keys, each once.

use super::keys::{JOINT_KEYS, Key, RIG_KEYS};
use crate::declare::report::Report;
use crate::declare::report::expected::{Expected, Form};
use crate::declare::report::{messages, text};
use crate::declare::source_place::SourcePlace;
use crate::declare::tree::{Entry, Item, Kind, Value};
use crate::names;

/// Level at which settings stand; decides which keys belong there and how messages name the group.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    Rig,
    Joint,
    Table,
    /// The attribute of `#[differentiate]`.
    Options,
}

/// A setting with a known key.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Setting<'t> {
    pub(crate) key: &'t str,
    pub(crate) expected: Expected,
    pub(crate) value: &'t Value,
}

impl<'t> Setting<'t> {
    /// Returns a part of the value as a setting of its own, with the same key.
    pub(super) fn part(self, expected: Expected, value: &'t Value) -> Self {
        Self { expected, value, ..self }
    }

    pub(crate) fn place(self) -> &'t SourcePlace {
        &self.value.place
    }
}

/// The usable settings of a section.
pub(crate) struct Settings<'t> {
    items: Vec<(&'t Item, Expected)>,
    /// Keys that are present in any form, even faulty, so that they are not also reported as missing.
    present: Vec<&'t str>,
}

/// Words that other programs use for these settings.
const SYNONYMS: &[(&str, &str)] = &[
    ("yaw", "heading"),
    ("azimuth", "heading"),
    ("elevation", "pitch"),
    ("tilt", "pitch"),
    ("speed", "rate"),
    ("velocity", "rate"),
    ("accel", "acceleration"),
    ("weight", "stiffness"),
    ("node", "bone"),
    ("backward", "back"),
    ("front", "forward"),
    ("mirror", "mirrored"),
];

/// Keys of earlier versions, with their present names.
const RENAMED: &[(&str, &str)] = &[
    ("bones", "axes"),
    ("comfort", "stiffness"),
    ("level", "upright"),
    ("narrowing", "pitch_taper"),
    ("pair", "other_eye"),
    ("range", "limits_from"),
];

impl<'t> Settings<'t> {
    pub(crate) fn read(entries: &'t [Entry], known: &[Key], level: Level, report: &mut Report) -> Self {
        let mut settings = Self { items: Vec::new(), present: Vec::new() };
        for entry in entries {
            match entry {
                Entry::Item(item) => settings.add(item, known, level, report),
                Entry::Stray(word) if level == Level::Options => {
                    report.error(&word.place, messages::stray_option(&word.text));
                }
                Entry::Stray(word) => report.error(&word.place, messages::stray(&word.text)),
                Entry::NoComma(word) => {
                    let plural = if level == Level::Options { "options" } else { "settings" };
                    report.error(&word.place, text::no_comma(&word.text, plural));
                }
                #[cfg(feature = "toml")]
                Entry::Repeated { key, first } => repeated(report, &key.text, &key.place, first.as_ref()),
            }
        }
        settings
    }

    /// Returns the setting with this key, if it has a value.
    pub(crate) fn get(&self, key: &str) -> Option<Setting<'t>> {
        let &(item, expected) = self.items.iter().find(|(item, _)| item.key.text == key)?;
        Some(Setting { key: &item.key.text, expected, value: &item.value })
    }

    /// Returns the value of this key, converted by `read`; `None` if it is absent or was reported.
    pub(crate) fn read_value<T>(
        &self,
        key: &str,
        report: &mut Report,
        read: impl FnOnce(&mut Report, Setting<'t>) -> Option<T>,
    ) -> Option<T> {
        self.get(key).and_then(|setting| read(report, setting))
    }

    /// Returns `true` if the key is present, even with a faulty value or a misspelled name.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.present.contains(&key)
    }

    fn add(&mut self, item: &'t Item, known: &[Key], level: Level, report: &mut Report) {
        let key = item.key.text.as_str();
        let Some(&(_, expected)) = known.iter().find(|(name, _)| *name == key) else {
            self.unknown(item, known, level, report);
            return;
        };
        if let Some((first, _)) = self.items.iter().find(|(first, _)| first.key.text == key) {
            repeated(report, key, &item.key.place, Some(&first.key.place));
            return;
        }
        self.present.push(key);
        if matches!(item.value.kind, Kind::Absent | Kind::Unassigned) && expected.form != Form::Nothing {
            report.error(&item.value.place, messages::no_value(key, expected, report.notation));
        } else {
            self.items.push((item, expected));
        }
    }

    fn unknown(&mut self, item: &'t Item, known: &[Key], level: Level, report: &mut Report) {
        let key = item.key.text.as_str();
        let names: Vec<&'static str> = known.iter().map(|(name, _)| *name).collect();
        let is_of = |keys: &[Key]| keys.iter().any(|(name, _)| *name == key);
        let text = if let Some((_, new)) = RENAMED.iter().find(|(old, new)| *old == key && names.contains(new)) {
            self.present.push(new);
            messages::renamed_key(key, new, &item.value, report.notation)
        } else if level == Level::Joint && is_of(RIG_KEYS) {
            messages::key_of_rig(key, report.notation)
        } else if level == Level::Rig && is_of(JOINT_KEYS) {
            messages::key_of_joint(key, report.notation)
        } else {
            let kind = if level == Level::Options { "option" } else { "setting" };
            let nearest = nearest(key, &names);
            self.present.extend(nearest);
            messages::unknown_key(kind, key, nearest, &names)
        };
        report.error(&item.key.place, text);
    }
}

fn repeated(report: &mut Report, key: &str, place: &SourcePlace, first: Option<&SourcePlace>) {
    let text = messages::duplicate_key(key);
    match first {
        Some(first) => report.error_with_note(place, text, messages::first_use(key), first),
        None => report.error(place, text),
    }
}

/// Returns the known key that was probably meant.
fn nearest(key: &str, known: &[&'static str]) -> Option<&'static str> {
    let lower = key.to_lowercase();
    if let Some((_, meant)) = SYNONYMS.iter().find(|(other, meant)| *other == lower && known.contains(meant)) {
        return Some(meant);
    }
    names::nearest(key, known)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_key_is_found_or_none() {
        let known = ["heading", "pitch", "rate", "stiffness", "bone", "axes", "back"];
        for (key, meant) in [
            ("headng", Some("heading")),
            ("haeding", Some("heading")),
            ("Heading", Some("heading")),
            ("rates", Some("rate")),
            ("yaw", Some("heading")),
            ("head", Some("heading")),
            ("backward", Some("back")),
            ("bonez", Some("bone")),
            ("colour", None),
            ("", None),
        ] {
            assert_eq!(nearest(key, &known), meant, "{key}");
        }
    }
}
