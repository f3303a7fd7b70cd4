//! Texts of error messages: what the messages of declarations and of `#[differentiate]` share.

use crate::names::nearest;

/// An error's message and what to do about it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Text {
    pub(crate) message: String,
    pub(crate) help: String,
}

impl From<(&str, &str)> for Text {
    fn from((message, help): (&str, &str)) -> Self {
        text(message, help)
    }
}

pub(crate) fn text(message: impl Into<String>, help: impl Into<String>) -> Text {
    Text { message: message.into(), help: help.into() }
}

/// Names in backquotes, with commas between them.
pub(crate) fn list<'n>(names: impl IntoIterator<Item = &'n str>) -> String {
    names.into_iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// The help for an unknown name: the known one that was probably meant, or else `otherwise`.
pub(crate) fn did_you_mean<'n>(
    name: &str,
    known: impl Iterator<Item = &'n str> + Clone,
    otherwise: impl FnOnce() -> String,
) -> String {
    nearest(name, known).map_or_else(otherwise, |nearest| format!("did you mean `{nearest}`?"))
}

pub(crate) fn no_comma(key: &str, things: &str) -> Text {
    text(format!("expected `,` before `{key}`"), format!("put a comma between two {things}"))
}

pub(crate) fn first_use(what: &str) -> String {
    format!("`{what}` was first used here")
}
