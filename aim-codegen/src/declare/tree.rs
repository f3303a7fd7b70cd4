//! The neutral tree: what the user wrote, with a place for every key and value, before anything is judged.
//!
//! Both front ends build it and neither reports anything: what is wrong is kept in the tree as a fact, so that `check`
//! is the only source of errors.

use proc_macro2::TokenStream;

use super::place::Place;

/// How the declaration was written; messages quote it back in the same notation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Notation {
    /// Attributes of a derive macro.
    Rust,
    /// A TOML file.
    Toml,
}

impl Notation {
    /// One of two, by notation.
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
    /// Facts about the Rust item that a TOML file cannot have.
    pub(crate) item: ItemFacts,
}

/// One joint's settings.
#[derive(Debug)]
pub(crate) struct Joint {
    pub(crate) name: Option<Value>,
    pub(crate) section: Section,
}

impl Joint {
    /// Its name, as far as it has one.
    pub(crate) fn name_or_joint(&self) -> &str {
        self.name.as_ref().and_then(Value::text).unwrap_or("joint")
    }

    /// Where something missing is reported: at the name, the smallest place that tells which joint it is.
    pub(crate) fn name_place(&self) -> &Place {
        self.name.as_ref().map_or(&self.section.place, |name| &name.place)
    }
}

/// The settings of a rig or of a joint.
#[derive(Debug)]
pub(crate) struct Section {
    /// Where something missing is reported.
    pub(crate) place: Place,
    /// The attributes the settings came from; none in TOML.
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) entries: Vec<Entry>,
}

/// An attribute that is ours.
#[derive(Debug)]
pub(crate) struct Attribute {
    pub(crate) place: Place,
    /// Whether it has the form `#[name(…)]`.
    pub(crate) has_list: bool,
}

/// What is known of the Rust item that carries the declaration.
#[derive(Debug, Default)]
pub(crate) struct ItemFacts {
    /// What the item is, if it is not a struct with named fields: `a tuple struct`.
    pub(crate) wrong_shape: Option<(&'static str, Place)>,
    /// Its generic parameters.
    pub(crate) generics: Option<Place>,
    /// Joints' fields of a type that cannot be `Joint`: the field's name, and the type with its place.
    pub(crate) foreign: Vec<(String, Word)>,
    /// Attributes of ours where they do not belong.
    pub(crate) misplaced: Vec<Word>,
}

/// A word with its place.
#[derive(Clone, Debug)]
pub(crate) struct Word {
    pub(crate) text: String,
    pub(crate) place: Place,
}

/// One piece of a section or table.
#[derive(Debug)]
pub(crate) enum Entry {
    /// `key = value` or `key(…)`.
    Item(Item),
    /// Tokens where a key was expected.
    Stray(Word),
    /// A key that follows a value without a comma.
    NoComma(Word),
    /// A key that appears again where the syntax itself forbids it.
    #[cfg(feature = "toml")]
    Repeated { key: Word, first: Option<Place> },
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
    pub(crate) place: Place,
}

/// What a value is, by its form alone.
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
    /// `a..=b`, with ends left out as written.
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
    /// As written.
    pub(crate) text: String,
    pub(crate) value: f64,
    /// What follows the digits; empty if nothing does.
    pub(crate) unit: String,
    /// `hexadecimal`, `octal` or `binary`.
    pub(crate) radix: Option<&'static str>,
    /// Whether there is space between the digits and the unit.
    pub(crate) detached: bool,
}

impl Number {
    /// A number without a unit.
    pub(crate) fn plain(text: &str, value: f64) -> Self {
        Self { text: text.to_owned(), value, unit: String::new(), radix: None, detached: false }
    }

    /// The number as written, without its unit.
    pub(crate) fn digits(&self) -> &str {
        self.text.strip_suffix(self.unit.as_str()).unwrap_or(&self.text).trim_end()
    }
}

impl Value {
    /// The string, if it is meant as one.
    pub(crate) fn text(&self) -> Option<&str> {
        if let Kind::Text(text) = &self.kind { Some(text) } else { None }
    }

    /// A number as written; empty if it is none.
    pub(crate) fn number(&self) -> &str {
        if let Kind::Number(number) = &self.kind { &number.text } else { "" }
    }

    /// What was found, for a message.
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
