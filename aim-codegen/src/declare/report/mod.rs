//! Last pass: what is wrong, in words, and how it is shown.
//!
//! A [`Report`] collects; `messages` and `text` hold the words, `expected` those about values, `diagnostics` the errors
//! with their places, and `render` shows them as a compiler does.

pub(crate) mod diagnostics;
pub(crate) mod expected;
pub(crate) mod messages;
pub(crate) mod render;
pub(crate) mod text;

use proc_macro2::TokenStream;
use quote::ToTokens;

use self::diagnostics::{Diagnostic, Diagnostics};
use self::text::Text;
use super::place::Place;
use super::tree::Notation;

/// Collects what is wrong; nothing stops at the first error.
pub(crate) struct Report {
    pub(crate) notation: Notation,
    found: Vec<Diagnostic>,
}

impl Report {
    pub(crate) fn new(notation: Notation) -> Self {
        Self { notation, found: Vec::new() }
    }

    pub(crate) fn error(&mut self, place: &Place, text: Text) {
        self.found.push(Diagnostic::new(text, place.clone()));
    }

    /// An error about these tokens.
    pub(crate) fn error_in(&mut self, tokens: &impl ToTokens, text: Text) {
        self.error(&Place::of(tokens), text);
    }

    pub(crate) fn error_with_note(&mut self, place: &Place, text: Text, note: String, other: &Place) {
        self.found.push(Diagnostic::new(text, place.clone()).with_note(note, other.clone()));
    }

    /// An error in place of a value.
    pub(crate) fn refuse<T>(&mut self, place: &Place, text: Text) -> Option<T> {
        self.error(place, text);
        None
    }

    /// The value of what stands there, or the error about it.
    pub(crate) fn accept<T>(&mut self, place: &Place, value: Result<T, Text>) -> Option<T> {
        value.map_err(|text| self.error(place, text)).ok()
    }

    /// How many errors there are.
    pub(crate) fn count(&self) -> usize {
        self.found.len()
    }

    /// Keeps only so many, the first ones. The others.
    pub(crate) fn forget(&mut self, count: usize) -> Vec<Diagnostic> {
        self.found.split_off(count)
    }

    /// Puts back what was forgotten.
    pub(crate) fn restore(&mut self, forgotten: Vec<Diagnostic>) {
        self.found.extend(forgotten);
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    pub(crate) fn into_compile_error(self) -> TokenStream {
        Diagnostics::new(self.found, None).into_compile_error()
    }

    pub(crate) fn into_list(self) -> Vec<Diagnostic> {
        self.found
    }
}
