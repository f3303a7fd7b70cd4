//! Last pass: words the errors and renders them.
//!
//! A [`Report`] collects errors; `messages` and `text` hold the wording, `expected` that of expected values,
//! `diagnostics` the errors with their places; `render` formats them like a compiler.

pub(crate) mod diagnostics;
pub(crate) mod expected;
pub(crate) mod messages;
pub(crate) mod render;
pub(crate) mod text;

use proc_macro2::TokenStream;
use quote::ToTokens;

use self::diagnostics::{Diagnostic, Diagnostics};
use self::text::Text;
use super::source_place::SourcePlace;
use super::tree::Notation;

/// Collects errors; checking continues after each.
pub(crate) struct Report {
    pub(crate) notation: Notation,
    diagnostics: Vec<Diagnostic>,
}

impl Report {
    pub(crate) fn new(notation: Notation) -> Self {
        Self { notation, diagnostics: Vec::new() }
    }

    pub(crate) fn error(&mut self, place: &SourcePlace, text: Text) {
        self.diagnostics.push(Diagnostic::new(text, place.clone()));
    }

    /// Reports an error about these tokens.
    pub(crate) fn error_in(&mut self, tokens: &impl ToTokens, text: Text) {
        self.error(&SourcePlace::of(tokens), text);
    }

    pub(crate) fn error_with_note(&mut self, place: &SourcePlace, text: Text, note: String, other: &SourcePlace) {
        self.diagnostics.push(Diagnostic::new(text, place.clone()).with_note(note, other.clone()));
    }

    /// Reports an error and returns `None` in place of a value.
    pub(crate) fn refuse<T>(&mut self, place: &SourcePlace, text: Text) -> Option<T> {
        self.error(place, text);
        None
    }

    /// Returns the value, or reports its error and returns `None`.
    pub(crate) fn accept<T>(&mut self, place: &SourcePlace, value: Result<T, Text>) -> Option<T> {
        value.map_err(|text| self.error(place, text)).ok()
    }

    /// Returns the number of errors so far.
    pub(crate) fn count(&self) -> usize {
        self.diagnostics.len()
    }

    /// Truncates to the first `count` errors and returns the removed ones.
    pub(crate) fn forget(&mut self, count: usize) -> Vec<Diagnostic> {
        self.diagnostics.split_off(count)
    }

    /// Appends errors that were removed by [`forget`](Self::forget).
    pub(crate) fn restore(&mut self, forgotten: Vec<Diagnostic>) {
        self.diagnostics.extend(forgotten);
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.diagnostics.is_empty()
    }

    pub(crate) fn into_compile_error(self) -> TokenStream {
        Diagnostics::new(self.diagnostics, None).into_compile_error()
    }

    pub(crate) fn into_list(self) -> Vec<Diagnostic> {
        self.diagnostics
    }
}
