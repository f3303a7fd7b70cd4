//! [`Diagnostics`]: all errors of one declaration, each with its place and a help line.

use proc_macro2::{Ident, Span, TokenStream};
use quote::quote_spanned;

use crate::declare::report::text::Text;
use crate::declare::source_place::SourcePlace;

/// One error in a declaration.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    text: Text,
    place: SourcePlace,
    note: Option<(String, SourcePlace)>,
}

impl Diagnostic {
    pub(crate) fn new(text: Text, place: SourcePlace) -> Self {
        Self { text, place, note: None }
    }

    pub(crate) fn with_note(mut self, note: impl Into<String>, place: SourcePlace) -> Self {
        self.note = Some((note.into(), place));
        self
    }

    /// Replaces token places by ranges of the text that the tokens were parsed from.
    pub(crate) fn place_in_text(&mut self) {
        self.place = self.place.in_text();
        self.note = self.note.take().map(|(note, place)| (note, place.in_text()));
    }

    /// Returns the error message: what is wrong.
    #[must_use]
    pub fn message(&self) -> &str {
        &self.text.message
    }

    /// Returns the help line: how to fix it.
    #[must_use]
    pub fn help(&self) -> &str {
        &self.text.help
    }

    /// Returns the place of the error.
    #[must_use]
    pub fn place(&self) -> &SourcePlace {
        &self.place
    }

    /// Returns the second place concerned, such as a key's first use, with a description of it.
    #[must_use]
    pub fn note(&self) -> Option<(&str, &SourcePlace)> {
        self.note.as_ref().map(|(note, place)| (note.as_str(), place))
    }
}

/// All errors of one declaration; at least one.
#[derive(Clone, Debug)]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
    pub(super) source: Option<Source>,
}

/// The file that the places refer to.
#[derive(Clone, Debug)]
pub(crate) struct Source {
    pub(crate) name: String,
    pub(crate) text: String,
}

impl Diagnostics {
    /// Sorts the errors by place.
    pub(crate) fn new(mut list: Vec<Diagnostic>, source: Option<Source>) -> Self {
        list.sort_by_key(|diagnostic| diagnostic.place.offset());
        Self { list, source }
    }

    /// Iterates over the errors, in the order of the text.
    pub fn iter(&self) -> core::slice::Iter<'_, Diagnostic> {
        self.list.iter()
    }

    /// Returns one `compile_error!` for each error, at its place, and one for each note.
    #[must_use]
    pub fn into_compile_error(self) -> TokenStream {
        let mut tokens = TokenStream::new();
        for Diagnostic { text, place, note } in self.list {
            tokens.extend(compile_error(&format!("{}\n\n  = help: {}", text.message, text.help), &place));
            if let Some((note, place)) = note {
                tokens.extend(compile_error(&format!("note: {note}"), &place));
            }
        }
        tokens
    }
}

impl<'a> IntoIterator for &'a Diagnostics {
    type Item = &'a Diagnostic;
    type IntoIter = core::slice::Iter<'a, Diagnostic>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// Emits one `compile_error!`. Rustc underlines from the macro's path to its arguments, so the path carries the first
/// span and the arguments the last.
fn compile_error(message: &str, place: &SourcePlace) -> TokenStream {
    let (first, last) = match place {
        SourcePlace::Tokens { first, last } => (*first, *last),
        SourcePlace::Text(_) => (Span::call_site(), Span::call_site()),
    };
    let core = Ident::new("core", first);
    let path = quote_spanned!(first=> ::#core::compile_error!);
    let arguments = quote_spanned!(last=> { #message });
    quote::quote!(#path #arguments)
}
