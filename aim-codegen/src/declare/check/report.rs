//! [`Report`]: collects what is wrong; nothing stops at the first error.

use crate::declare::diagnostics::Diagnostic;
use crate::declare::place::Place;
use crate::declare::tree::Notation;
use crate::text::Text;

/// The errors found so far.
pub(super) struct Report {
    pub(super) notation: Notation,
    found: Vec<Diagnostic>,
}

impl Report {
    pub(super) fn new(notation: Notation) -> Self {
        Self { notation, found: Vec::new() }
    }

    pub(super) fn error(&mut self, place: &Place, text: Text) {
        self.found.push(Diagnostic::new(text, place.clone()));
    }

    pub(super) fn error_with_note(&mut self, place: &Place, text: Text, note: String, other: &Place) {
        self.found.push(Diagnostic::new(text, place.clone()).with_note(note, other.clone()));
    }

    pub(super) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    pub(super) fn into_list(self) -> Vec<Diagnostic> {
        self.found
    }
}
