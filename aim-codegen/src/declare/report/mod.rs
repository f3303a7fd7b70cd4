//! Last pass: what is wrong, in words, and how it is shown.
//!
//! A [`Report`] collects; `messages` and `text` hold the words, `diagnostics` the errors with their places, and `render`
//! shows them as a compiler does.

pub(crate) mod diagnostics;
pub(crate) mod messages;
pub(crate) mod render;
pub(crate) mod text;

use crate::declare::place::Place;
use crate::declare::report::diagnostics::Diagnostic;
use crate::declare::report::text::Text;
use crate::declare::tree::Notation;

/// Collects what is wrong with a declaration; nothing stops at the first error.
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

    pub(crate) fn error_with_note(&mut self, place: &Place, text: Text, note: String, other: &Place) {
        self.found.push(Diagnostic::new(text, place.clone()).with_note(note, other.clone()));
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    pub(crate) fn into_list(self) -> Vec<Diagnostic> {
        self.found
    }
}
