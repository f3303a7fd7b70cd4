//! The attribute's own arguments: `wrt(…)`, `budget = …`, `hessian`, `crate = …`.

use proc_macro2::TokenStream;

use super::errors::Errors;
use super::messages;
use crate::declare::Place;
use crate::declare::parse::tokens::entries;
use crate::declare::report::text;
use crate::declare::tree::{Entry, Kind, Value, Word};

/// What the attribute asks for.
#[derive(Default)]
pub(super) struct Options {
    /// The names of the variables, each once; `None` where `wrt` is missing.
    pub(super) wrt: Option<Vec<Word>>,
    /// The most operations, and where that is written.
    pub(super) budget: Option<(usize, Place)>,
    pub(super) hessian: Option<Place>,
    pub(super) krate: Option<TokenStream>,
}

const KEYS: [&str; 4] = ["wrt", "budget", "hessian", "crate"];

impl Options {
    pub(super) fn parse(attribute: TokenStream, errors: &mut Errors) -> Self {
        let mut options = Self::default();
        let mut seen: Vec<Word> = Vec::new();
        for entry in entries(attribute) {
            let item = match entry {
                Entry::Item(item) => item,
                Entry::Stray(word) => {
                    errors.at(&word.place, messages::stray_option(&word.text));
                    continue;
                }
                Entry::NoComma(word) => {
                    errors.at(&word.place, text::no_comma(&word.text, "options"));
                    continue;
                }
                #[cfg(feature = "toml")]
                Entry::Repeated { .. } => continue,
            };
            let key = item.key.text.as_str();
            if let Some(first) = seen.iter().find(|word| word.text == key) {
                let note = text::first_use(key);
                errors.at_with_note(&item.key.place, messages::option_twice(key), note, &first.place);
                continue;
            }
            match key {
                "wrt" => options.wrt = Some(variables(&item.key, item.value, errors)),
                "budget" => options.budget = budget(&item.value, errors),
                "hessian" => match item.value.kind {
                    Kind::Absent | Kind::Bool(true) => options.hessian = Some(item.key.place.clone()),
                    Kind::Bool(false) => {}
                    _ => errors.at(&item.value.place, messages::flag_with_value(key)),
                },
                "crate" => match item.value.kind {
                    Kind::Path(path) => options.krate = Some(path),
                    _ => errors.at(&item.value.place, messages::CRATE_NOT_A_PATH),
                },
                _ => errors.at(&item.key.place, messages::unknown_option(key, &KEYS)),
            }
            seen.push(item.key);
        }
        options
    }
}

fn variables(key: &Word, value: Value, errors: &mut Errors) -> Vec<Word> {
    let Kind::Table(entries) = value.kind else {
        errors.at(&value.place, messages::WRT_FORM);
        return Vec::new();
    };
    let mut names: Vec<Word> = Vec::new();
    if entries.is_empty() {
        errors.at(&key.place, messages::WRT_EMPTY);
    }
    for entry in entries {
        let word = match entry {
            Entry::Item(item) if matches!(item.value.kind, Kind::Absent) => item.key,
            Entry::Item(item) => {
                errors.at(&item.value.place, messages::WRT_FORM);
                continue;
            }
            Entry::Stray(word) | Entry::NoComma(word) => {
                errors.at(&word.place, messages::WRT_FORM);
                continue;
            }
            #[cfg(feature = "toml")]
            Entry::Repeated { .. } => continue,
        };
        if let Some(first) = names.iter().find(|name| name.text == word.text) {
            let note = text::first_use(&word.text);
            errors.at_with_note(&word.place, messages::wrt_twice(&word.text), note, &first.place);
        } else {
            names.push(word);
        }
    }
    names
}

fn budget(value: &Value, errors: &mut Errors) -> Option<(usize, Place)> {
    let Kind::Number(number) = &value.kind else {
        errors.at(&value.place, messages::BUDGET_FORM);
        return None;
    };
    match number.text.replace('_', "").parse() {
        Ok(budget) => Some((budget, value.place.clone())),
        Err(_) => {
            errors.at(&value.place, messages::BUDGET_FORM);
            None
        }
    }
}
