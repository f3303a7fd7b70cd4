//! [`Expected`]: the type that the context expects of a value. Only a few expressions depend on it:
//! `Default::default()`, empty sums, `array::from_fn`.

use super::value::Value;

/// An expected type, as far as it is known.
#[derive(Clone, Debug, Default)]
pub(super) enum Expected {
    /// Full name of a struct, or name of another type.
    Named(String),
    /// Full name of a generic struct or enum, and its arguments as far as they are known: lengths and types.
    Generic(String, Vec<Value>),
    /// Element type and length.
    Array(Box<Self>, Option<usize>),
    Tuple(Vec<Self>),
    Optional,
    /// A type with parameters that is not supported.
    Other,
    /// Unknown.
    #[default]
    Any,
}

impl Expected {
    /// Returns the expected type of a part.
    pub(super) fn part(&self, index: usize) -> &Self {
        match self {
            Self::Array(element, _) => element,
            Self::Tuple(parts) => parts.get(index).unwrap_or(&Self::Any),
            _ => &Self::Any,
        }
    }

    /// Returns the type's name, if it has one.
    pub(super) fn name(&self) -> Option<&str> {
        match self {
            Self::Named(name) | Self::Generic(name, _) => Some(name),
            _ => None,
        }
    }
}
