//! [`Text`] of an error, and helpers shared by the messages of declarations and of `#[differentiate]`.

use core::fmt::Display;

use crate::names::nearest;

/// Message and help line of an error.
#[derive(Clone, Debug)]
pub(crate) struct Text {
    pub(crate) message: String,
    pub(crate) help: String,
}

impl Text {
    pub(crate) fn new(message: impl Display, help: impl Display) -> Self {
        Self { message: message.to_string(), help: help.to_string() }
    }
}

/// Defines messages as functions: `name(argument: Type, …) where variable = expression, … => message, help;`, the last
/// two as format strings.
macro_rules! messages {
    ($(
        $(#[$attribute:meta])*
        $name:ident($($argument:ident: $type:ty),*) $(where $($variable:pat_param = $value:expr),+)? =>
            $message:literal, $help:literal;
    )*) => {$(
        $(#[$attribute])*
        pub(crate) fn $name($($argument: $type),*) -> $crate::declare::report::text::Text {
            $($(let $variable = $value;)+)?
            $crate::declare::report::text::Text::new(format_args!($message), format_args!($help))
        }
    )*};
}
pub(crate) use messages;

messages! {
    no_comma(key: &str, plural: &str) => "expected `,` before `{key}`", "put a comma between two {plural}";

    not_a_name(name: &str, plural: &str) => "expected `,` after `{name}`", "name whole {plural}, not parts of them";
}

/// Formats names in backquotes, separated by commas.
pub(crate) fn list(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// Returns the help for an unknown name: the known one that was probably meant, otherwise `otherwise`.
pub(crate) fn did_you_mean(name: &str, known: &[&str], otherwise: impl FnOnce() -> String) -> String {
    nearest(name, known).map_or_else(otherwise, |nearest| format!("did you mean `{nearest}`?"))
}
