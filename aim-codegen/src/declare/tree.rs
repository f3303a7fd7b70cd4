//! The neutral tree: the user's declaration, unchecked, with a place for every key and value.
//!
//! Both front ends build it, and neither reports anything: mistakes are recorded in the tree, so that `check` is the
//! only source of errors.

use proc_macro2::TokenStream;

use super::source_place::SourcePlace;

/// Notation of a declaration; messages quote it back in the same notation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Notation {
    /// Attributes of a derive macro.
    Rust,
    /// A TOML file.
    Toml,
}

impl Notation {
    /// Returns the variant for this notation.
    pub(crate) fn pick<T>(self, rust: T, toml: T) -> T {
        match self {
            Self::Rust => rust,
            Self::Toml => toml,
        }
    }
}

/// A whole declaration.
#[derive(Debug)]
pub(crate) struct Rig {
    pub(crate) notation: Notation,
    pub(crate) name: Option<Value>,
    pub(crate) section: Section,
    pub(crate) joints: Vec<Joint>,
    /// Facts about the Rust item; empty for a TOML file.
    pub(crate) item: ItemFacts,
}

/// One joint's settings.
#[derive(Debug)]
pub(crate) struct Joint {
    pub(crate) name: Option<Value>,
    pub(crate) section: Section,
}

impl Joint {
    /// Returns the joint's name, or `joint` if it has none.
    pub(crate) fn name_or_joint(&self) -> &str {
        self.name.as_ref().and_then(Value::text).unwrap_or("joint")
    }

    /// Returns the place for reports of missing settings: the name, the smallest place that identifies the joint.
    pub(crate) fn name_place(&self) -> &SourcePlace {
        self.name.as_ref().map_or(&self.section.place, |name| &name.place)
    }
}

/// The settings of a rig or of a joint.
#[derive(Debug)]
pub(crate) struct Section {
    /// Place for reports of missing settings.
    pub(crate) place: SourcePlace,
    /// Attributes that the settings came from; none in TOML.
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) entries: Vec<Entry>,
}

/// An attribute of this derive.
#[derive(Debug)]
pub(crate) struct Attribute {
    pub(crate) place: SourcePlace,
    /// `true` if it has the form `#[name(…)]`.
    pub(crate) has_list: bool,
}

/// Facts about the Rust item that carries the declaration.
#[derive(Debug, Default)]
pub(crate) struct ItemFacts {
    /// Kind of the item if it is not a struct with named fields: `a tuple struct`.
    pub(crate) wrong_shape: Option<(&'static str, SourcePlace)>,
    /// Place of its generic parameters.
    pub(crate) generics: Option<SourcePlace>,
    /// Joint fields whose type cannot be `Joint`: the field's name, and the type with its place.
    pub(crate) foreign: Vec<(String, Word)>,
    /// Attributes of this derive in places where they do not belong.
    pub(crate) misplaced: Vec<Word>,
}

/// A word with its place.
#[derive(Clone, Debug)]
pub(crate) struct Word {
    pub(crate) text: String,
    pub(crate) place: SourcePlace,
}

/// One entry of a section or table.
#[derive(Debug)]
pub(crate) enum Entry {
    /// `key = value` or `key(…)`.
    Item(Item),
    /// Tokens where a key was expected.
    Stray(Word),
    /// A key that follows a value without a comma.
    NoComma(Word),
    /// A repeated key, where the syntax itself forbids it.
    #[cfg(feature = "toml")]
    Repeated { key: Word, first: Option<SourcePlace> },
}

/// A key with its value.
#[derive(Debug)]
pub(crate) struct Item {
    pub(crate) key: Word,
    pub(crate) value: Value,
}

/// A value with its place.
#[derive(Debug)]
pub(crate) struct Value {
    pub(crate) kind: Kind,
    pub(crate) place: SourcePlace,
}

/// Kind of a value, by its form alone.
#[derive(Debug)]
pub(crate) enum Kind {
    Number(Number),
    /// `+X`, or any sign before a word.
    Axis {
        negative: bool,
        letter: String,
    },
    /// `(a, b, c)`
    Tuple(Vec<Value>),
    /// `[a, b]`
    List(Vec<Value>),
    /// `a..=b`; either end may be missing.
    Range {
        low: Option<Box<Value>>,
        high: Option<Box<Value>>,
        inclusive: bool,
    },
    /// A string that is meant as a string.
    Text(String),
    Bool(bool),
    /// A bare word.
    Word(String),
    /// Settings in parentheses or an inline table.
    Table(Vec<Entry>),
    /// A path, for `crate = …`.
    Path(TokenStream),
    /// A key that stands alone.
    Absent,
    /// A key followed by something other than `=`.
    Unassigned,
    /// Anything else, in words: `an expression`.
    Other(&'static str),
}

/// A numeric literal.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Number {
    /// Text as written.
    pub(crate) text: String,
    pub(crate) value: f64,
    /// Text after the digits; empty if there is none.
    pub(crate) unit: String,
    /// `hexadecimal`, `octal` or `binary`.
    pub(crate) radix: Option<&'static str>,
    /// `true` if there is space between the digits and the unit.
    pub(crate) detached: bool,
}

impl Number {
    /// Returns a number without a unit.
    pub(crate) fn plain(text: &str, value: f64) -> Self {
        Self { text: text.to_owned(), value, unit: String::new(), radix: None, detached: false }
    }

    /// Returns the number as written, without its unit.
    pub(crate) fn digits(&self) -> &str {
        self.text.strip_suffix(self.unit.as_str()).unwrap_or(&self.text).trim_end()
    }
}

impl Value {
    /// Returns the string, if the value is meant as one.
    pub(crate) fn text(&self) -> Option<&str> {
        if let Kind::Text(text) = &self.kind { Some(text) } else { None }
    }

    /// Returns the number as written; empty if the value is not a number.
    pub(crate) fn number(&self) -> &str {
        if let Kind::Number(number) = &self.kind { &number.text } else { "" }
    }

    /// Describes the value for a message.
    pub(crate) fn describe(&self) -> String {
        match &self.kind {
            Kind::Number(number) => format!("`{}`", number.text),
            Kind::Axis { negative, letter } => format!("`{}{letter}`", if *negative { '-' } else { '+' }),
            Kind::Text(text) => format!("the string `\"{}\"`", text.escape_debug()),
            Kind::Bool(flag) => format!("`{flag}`"),
            Kind::Word(word) => format!("`{word}`"),
            Kind::Tuple(_) | Kind::List(_) => "a list of values".into(),
            Kind::Range { .. } => "a range".into(),
            Kind::Table(_) => "a group of settings".into(),
            Kind::Path(_) => "a path".into(),
            Kind::Absent | Kind::Unassigned => "nothing".into(),
            Kind::Other(what) => (*what).into(),
        }
    }
}
