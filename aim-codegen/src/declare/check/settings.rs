//! [`Settings`]: entries sorted by key; unknown, repeated and misplaced keys are reported here, once.

use super::keys::{JOINT_KEYS, Key, RIG_KEYS};
use crate::declare::report::Report;
use crate::declare::report::messages;
use crate::declare::report::text;
use crate::declare::tree::{Entry, Item, Kind, Value};
use crate::names;

/// Where settings stand, for keys that belong elsewhere.
#[derive(Clone, Copy)]
pub(super) enum Level {
    Rig,
    Joint,
    Table,
}

/// The usable settings of a section.
pub(super) struct Settings<'t> {
    items: Vec<&'t Item>,
    /// Keys that are there in some form, so that they are not reported as missing, too.
    present: Vec<&'t str>,
}

/// Words for settings that other programs use.
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

/// Keys of earlier versions and what they are called now.
const RENAMED: &[(&str, &str)] = &[
    ("bones", "axes"),
    ("comfort", "stiffness"),
    ("level", "upright"),
    ("narrowing", "pitch_taper"),
    ("pair", "other_eye"),
    ("range", "limits_from"),
];

impl<'t> Settings<'t> {
    pub(super) fn read(entries: &'t [Entry], known: &[Key], level: Level, report: &mut Report) -> Self {
        let mut settings = Self { items: Vec::new(), present: Vec::new() };
        for entry in entries {
            match entry {
                Entry::Item(item) => settings.add(item, known, level, report),
                Entry::Stray(word) => report.error(&word.place, messages::stray(&word.text)),
                Entry::NoComma(word) => report.error(&word.place, text::no_comma(&word.text, "settings")),
                #[cfg(feature = "toml")]
                Entry::Repeated { key, first } => {
                    let text = messages::duplicate_key(&key.text);
                    match first {
                        Some(first) => {
                            report.error_with_note(&key.place, text, text::first_use(&key.text), first);
                        }
                        None => report.error(&key.place, text),
                    }
                }
            }
        }
        settings
    }

    /// The value of this key, if it has one.
    pub(super) fn get(&self, key: &str) -> Option<&'t Value> {
        self.items.iter().find(|item| item.key.text == key).map(|item| &item.value)
    }

    /// Whether the key was at least meant.
    pub(super) fn has(&self, key: &str) -> bool {
        self.present.contains(&key)
    }

    fn add(&mut self, item: &'t Item, known: &[Key], level: Level, report: &mut Report) {
        let key = item.key.text.as_str();
        let Some((_, expected)) = known.iter().find(|(name, _)| *name == key) else {
            self.unknown(item, known, level, report);
            return;
        };
        if let Some(first) = self.items.iter().find(|first| first.key.text == key) {
            let note = text::first_use(key);
            report.error_with_note(&item.key.place, messages::duplicate_key(key), note, &first.key.place);
            return;
        }
        self.present.push(key);
        if matches!(item.value.kind, Kind::Absent | Kind::Unassigned) {
            report.error(&item.value.place, messages::no_value(key, Some(*expected), report.notation));
        } else {
            self.items.push(item);
        }
    }

    fn unknown(&mut self, item: &'t Item, known: &[Key], level: Level, report: &mut Report) {
        let key = item.key.text.as_str();
        let names: Vec<&'static str> = known.iter().map(|(name, _)| *name).collect();
        let (is_rig, is_joint) = (RIG_KEYS, JOINT_KEYS);
        let of = |keys: &[Key]| keys.iter().any(|(name, _)| *name == key);
        let renamed = RENAMED.iter().find(|(old, new)| *old == key && names.contains(new));
        let text = match level {
            _ if renamed.is_some() => {
                let new = renamed.map_or("", |(_, new)| new);
                self.present.push(new);
                messages::renamed_key(key, new, &item.value, report.notation)
            }
            Level::Joint if of(is_rig) => messages::key_of_rig(key, report.notation),
            Level::Rig if of(is_joint) => messages::key_of_joint(key, report.notation),
            _ => {
                let nearest = nearest(key, &names);
                self.present.extend(nearest);
                messages::unknown_key(key, nearest, &names)
            }
        };
        report.error(&item.key.place, text);
    }
}

/// The known key that was probably meant.
fn nearest(key: &str, known: &[&'static str]) -> Option<&'static str> {
    let lower = key.to_lowercase();
    if let Some((_, meant)) = SYNONYMS.iter().find(|(other, meant)| *other == lower && known.contains(meant)) {
        return Some(meant);
    }
    names::nearest(key, known.iter().copied())
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
