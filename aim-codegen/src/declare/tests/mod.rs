//! Tests of declarations through their front ends.

#[cfg(feature = "toml")]
mod both;
mod fuzz;
mod item;
mod specs;
#[cfg(feature = "toml")]
mod toml_only;

use syn::DeriveInput;

use super::{Diagnostics, SourcePlace, from_derive_input};

/// Parses an item; the test's own text is always valid Rust.
fn parse(item: &str) -> DeriveInput {
    syn::parse_str(item).unwrap_or_else(|error| panic!("{error}: {item}"))
}

/// Returns the errors of an item.
fn errors_of(item: &str) -> Diagnostics {
    match from_derive_input(&parse(item)) {
        Ok(declared) => panic!("no error in {item}: {declared:?}"),
        Err(errors) => errors,
    }
}

/// Returns the text at a place.
fn excerpt(text: &str, place: &SourcePlace) -> String {
    let range = match place {
        SourcePlace::Tokens { first, last } => first.byte_range().start..last.byte_range().end,
        SourcePlace::Text(range) => range.clone(),
    };
    text[range].to_owned()
}

/// Returns each error's message and the text it points at; asserts that each has a help line.
fn listed(text: &str, errors: &Diagnostics) -> Vec<(String, String)> {
    errors
        .iter()
        .map(|error| {
            assert!(!error.help().is_empty() && !error.help().ends_with('.'), "{}", error.message());
            assert!(!error.message().ends_with('.'), "{}", error.message());
            (error.message().to_owned(), excerpt(text, error.place()))
        })
        .collect()
}
