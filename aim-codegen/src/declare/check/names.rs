//! Checks names of rigs, joints and bones: usable in Rust, C and WGSL, and each used once.

use super::read;
use super::settings::{Setting, Settings};
use crate::declare::parse::literal::is_word;
use crate::declare::report::expected::Expected;
use crate::declare::report::{Report, messages};
use crate::declare::source_place::SourcePlace;
use crate::declare::tree::{Joint, Kind, Notation, Rig, Value};
use crate::names::{is_rust_keyword, keyword_of, snake_case};

/// Checks the names of the rig and of its joints.
pub(super) fn check(rig: &Rig, report: &mut Report) {
    match &rig.name {
        Some(name) => _ = check_name(name, report),
        None => report.error(&rig.section.place, messages::no_name("rig")),
    }
    let mut seen: Vec<(&str, String, &SourcePlace)> = Vec::new();
    for joint in &rig.joints {
        let Some(value) = &joint.name else {
            report.error(&joint.section.place, messages::no_name("joint"));
            continue;
        };
        let Some(name) = check_name(value, report) else { continue };
        let snake = snake_case(name);
        match seen.iter().find(|(_, other, _)| *other == snake) {
            Some((first, _, place)) => {
                let text = if *first == name {
                    messages::duplicate_name(name)
                } else {
                    messages::name_collision(first, name, &snake)
                };
                report.error_with_note(&value.place, text, messages::first_use(first), place);
            }
            None => seen.push((name, snake, &value.place)),
        }
    }
}

/// Checks one name; `None` if it was reported.
fn check_name<'t>(value: &'t Value, report: &mut Report) -> Option<&'t str> {
    let Some(name) = value.text() else {
        return read::mismatch(report, Setting { key: "name", expected: Expected::NAME, value });
    };
    let snake = snake_case(name);
    let is_identifier = is_word(name) && name != "_";
    let text = if !is_identifier && (name.is_ascii() || report.notation == Notation::Toml && !is_word(name)) {
        messages::not_identifier(name)
    } else if !name.is_ascii() {
        messages::not_ascii(name)
    } else if let Some(language) = keyword_of(&snake) {
        messages::keyword(name, &snake, language)
    } else if report.notation == Notation::Toml && is_rust_keyword(name) {
        // In a macro, rustc has already checked this: a keyword arrives as `r#…`, and the emitted Rust repeats that
        // form.
        messages::rust_keyword(name)
    } else if name.starts_with("__") {
        messages::reserved_prefix(name)
    } else {
        return Some(name);
    };
    report.refuse(&value.place, text)
}

/// Reports bones that are named twice, among all joints (with their alternatives and other eyes) and held bones.
pub(super) fn check_bones(joints: &[(&Joint, Settings<'_>)], report: &mut Report) {
    let turned = check_turned(joints, report);
    let mut held: Vec<(&str, &SourcePlace)> = Vec::new();
    let named = joints.iter().filter_map(|(_, settings)| settings.get("hold"));
    for (bone, place) in named.flat_map(|setting| texts(setting.value)) {
        if let Some((_, first, by_name)) = turned.iter().find(|(first, ..)| *first == bone) {
            let note = if *by_name { messages::default_bone_here(bone) } else { messages::first_use(bone) };
            report.error_with_note(place, messages::held_joint(bone), note, first);
        } else if let Some((_, first)) = held.iter().find(|(first, _)| *first == bone) {
            report.error_with_note(place, messages::duplicate_held(bone), messages::first_use(bone), first);
        } else {
            held.push((bone, place));
        }
    }
}

/// Reports bones of joints and of other eyes that are named twice. Returns each bone with its place and `true` if the
/// joint's own name is also the bone's name.
fn check_turned<'t>(
    joints: &[(&'t Joint, Settings<'t>)],
    report: &mut Report,
) -> Vec<(&'t str, &'t SourcePlace, bool)> {
    let mut seen: Vec<(&str, &SourcePlace, bool)> = Vec::new();
    for (joint, settings) in joints {
        let mut own: Vec<(&str, &SourcePlace, bool)> = Vec::new();
        let name = joint.name.as_ref().filter(|_| settings.get("bone").is_none());
        own.extend(name.and_then(|name| Some((name.text()?, &name.place, true))));
        for setting in [settings.get("bone"), settings.get("other_eye")].into_iter().flatten() {
            own.extend(texts(setting.value).map(|(bone, place)| (bone, place, false)));
        }
        for (bone, place, by_name) in own {
            match seen.iter().find(|(first, ..)| *first == bone) {
                // Two joints with the same name have already been reported.
                Some((_, _, true)) if by_name => {}
                Some((_, first, first_by_name)) => {
                    let note = if *first_by_name || by_name {
                        messages::default_bone_here(bone)
                    } else {
                        messages::first_use(bone)
                    };
                    // The explicit name is the one to change, so it carries the error.
                    let (place, other) = if by_name { (*first, place) } else { (place, *first) };
                    report.error_with_note(place, messages::duplicate_bone(bone), note, other);
                }
                None => seen.push((bone, place, by_name)),
            }
        }
    }
    seen
}

/// Returns the strings of a value, single or in a list. Values that are not strings have already been reported.
fn texts(value: &Value) -> impl Iterator<Item = (&str, &SourcePlace)> {
    let values = match &value.kind {
        Kind::List(values) => values.as_slice(),
        _ => core::slice::from_ref(value),
    };
    values.iter().filter_map(|value| Some((value.text()?, &value.place)))
}
