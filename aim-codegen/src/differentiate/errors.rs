//! [`Errors`]: collects what is wrong with a function; nothing stops at the first.

use quote::ToTokens;

use crate::declare::report::text::Text;
use crate::declare::{Diagnostic, Diagnostics, Place};

/// The errors found so far.
#[derive(Default)]
pub(super) struct Errors {
    found: Vec<Diagnostic>,
}

impl Errors {
    /// An error about these tokens.
    pub(super) fn add(&mut self, tokens: &impl ToTokens, text: impl Into<Text>) {
        self.at(&Place::of(tokens), text);
    }

    pub(super) fn at(&mut self, place: &Place, text: impl Into<Text>) {
        self.found.push(Diagnostic::new(text.into(), place.clone()));
    }

    pub(super) fn at_with_note(&mut self, place: &Place, text: impl Into<Text>, note: String, other: &Place) {
        self.found.push(Diagnostic::new(text.into(), place.clone()).with_note(note, other.clone()));
    }

    pub(super) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    pub(super) fn into_diagnostics(self) -> Diagnostics {
        Diagnostics::new(self.found, None)
    }
}
