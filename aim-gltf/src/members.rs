//! Typed access to members of JSON objects.

use std::collections::BTreeMap;

use serde_json::{Map, Value};

use crate::error::Error;

/// A JSON value that does not have the expected type.
pub(crate) struct MemberError {
    /// Path inside the element, such as `.sparse.indices`.
    place: String,
    problem: String,
}

impl MemberError {
    fn new(expected: &str, found: &Value) -> Self {
        let found = match found {
            Value::Null => "null".to_owned(),
            Value::Bool(flag) => flag.to_string(),
            Value::Number(number) => number.to_string(),
            Value::String(_) => "a string".to_owned(),
            Value::Array(_) => "an array".to_owned(),
            Value::Object(_) => "an object".to_owned(),
        };
        Self { place: String::new(), problem: format!("it is {found}, expected {expected}") }
    }

    fn inside(mut self, place: &str) -> Self {
        self.place.insert_str(0, place);
        self
    }

    /// Converts to an error at an element of one of the document's arrays.
    pub(crate) fn at(self, array: &str, index: usize) -> Error {
        Error::invalid(format!("{array}[{index}]{}", self.place), self.problem)
    }
}

/// A type that can be read from JSON; unknown members are ignored.
pub(crate) trait FromJson: Sized {
    fn from_json(value: Value) -> Result<Self, MemberError>;
}

/// The members of an object, removed as they are read.
pub(crate) struct Members(Map<String, Value>);

impl Members {
    pub(crate) fn of(value: Value) -> Result<Self, MemberError> {
        match value {
            Value::Object(members) => Ok(Self(members)),
            other => Err(MemberError::new("an object", &other)),
        }
    }

    /// Takes a member of any type; `None` if it is missing.
    pub(crate) fn take(&mut self, key: &str) -> Option<Value> {
        self.0.get_mut(key).map(Value::take)
    }

    /// Reads a member; `None` if it is missing or `null`.
    pub(crate) fn optional<T: FromJson>(&mut self, key: &str) -> Result<Option<T>, MemberError> {
        self.take(key).filter(|value| !value.is_null()).map(|value| read_member(key, value)).transpose()
    }

    /// Reads a member; the type's default if it is missing.
    pub(crate) fn or_default<T: FromJson + Default>(&mut self, key: &str) -> Result<T, MemberError> {
        self.take(key).map_or_else(|| Ok(T::default()), |value| read_member(key, value))
    }

    pub(crate) fn required<T: FromJson>(&mut self, key: &str) -> Result<T, MemberError> {
        match self.take(key) {
            Some(value) => read_member(key, value),
            None => Err(MemberError { place: String::new(), problem: format!("its member `{key}` is missing") }),
        }
    }
}

fn read_member<T: FromJson>(key: &str, value: Value) -> Result<T, MemberError> {
    T::from_json(value).map_err(|error| error.inside(&format!(".{key}")))
}

impl FromJson for usize {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let whole = value.as_u64().and_then(|number| Self::try_from(number).ok());
        whole.ok_or_else(|| MemberError::new("a non-negative integer", &value))
    }
}

impl FromJson for u32 {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let whole = value.as_u64().and_then(|number| Self::try_from(number).ok());
        whole.ok_or_else(|| MemberError::new("a 32-bit integer", &value))
    }
}

impl FromJson for f64 {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        value.as_f64().ok_or_else(|| MemberError::new("a number", &value))
    }
}

impl FromJson for bool {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        value.as_bool().ok_or_else(|| MemberError::new("true or false", &value))
    }
}

impl FromJson for String {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        match value {
            Value::String(text) => Ok(text),
            other => Err(MemberError::new("a string", &other)),
        }
    }
}

impl<T: FromJson> FromJson for Vec<T> {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let Value::Array(values) = value else { return Err(MemberError::new("an array", &value)) };
        let mut all = Self::with_capacity(values.len());
        for (index, value) in values.into_iter().enumerate() {
            all.push(T::from_json(value).map_err(|error| error.inside(&format!("[{index}]")))?);
        }
        Ok(all)
    }
}

impl<const N: usize> FromJson for [f64; N] {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let numbers = Vec::<f64>::from_json(value)?;
        let found = numbers.len();
        let problem = || format!("it has {found} numbers, expected {N}");
        numbers.try_into().map_err(|_| MemberError { place: String::new(), problem: problem() })
    }
}

impl FromJson for BTreeMap<String, usize> {
    fn from_json(value: Value) -> Result<Self, MemberError> {
        let Members(members) = Members::of(value)?;
        let mut all = Self::new();
        for (key, value) in members {
            let number = read_member(&key, value)?;
            all.insert(key, number);
        }
        Ok(all)
    }
}
