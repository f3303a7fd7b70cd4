//! [`Expected`]: what the type of a place says of the value that comes to stand there. Expressions whose meaning depends on
//! it are few: `Default::default()`, sums of nothing, `array::from_fn`.

use super::value::Value;

/// A type, as far as it is known.
#[derive(Clone, Debug, Default)]
pub(super) enum Expected {
    /// The full name of a struct, or the name of another type.
    Named(String),
    /// The full name of a generic struct or enum, and what is known of its arguments: lengths and types.
    Generic(String, Vec<Value>),
    /// Elements, and how many.
    Array(Box<Self>, Option<usize>),
    Tuple(Vec<Self>),
    Optional,
    /// A type that is not understood, with parameters.
    Other,
    /// It is not known.
    #[default]
    Any,
}

impl Expected {
    /// The type of a part of it.
    pub(super) fn part(&self, index: usize) -> &Self {
        match self {
            Self::Array(element, _) => element,
            Self::Tuple(parts) => parts.get(index).unwrap_or(&Self::Any),
            _ => &Self::Any,
        }
    }

    /// The name, where it has one.
    pub(super) fn name(&self) -> Option<&str> {
        match self {
            Self::Named(name) | Self::Generic(name, _) => Some(name),
            _ => None,
        }
    }
}
