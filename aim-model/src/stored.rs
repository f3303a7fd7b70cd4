//! Serialised form of numbers with the feature `serde`, for `#[serde(with = "aim_model::stored")]`.
//!
//! JSON has neither infinity nor NaN. Human-readable formats therefore store them as the words `inf`, `-inf` and `nan`,
//! as in TOML; binary formats store every number by its bits.

use core::fmt;
use core::marker::PhantomData;

use serde::de::{self, SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Serialises a number or an array of numbers.
pub fn serialize<T: Stored, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
    value.store(serializer)
}

/// Deserialises a number or an array of numbers.
pub fn deserialize<'de, T: Stored, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    T::load(deserializer)
}

/// A number or an array of numbers.
pub trait Stored: Copy {
    /// Writes the value to `serializer`.
    fn store<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error>;
    /// Reads a value from `deserializer`.
    fn load<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error>;
}

/// An array element, wrapped to implement serde's own traits.
struct Element<T>(T);

impl<T: Stored> Serialize for Element<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.store(serializer)
    }
}

impl<'de, T: Stored> Deserialize<'de> for Element<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        T::load(deserializer).map(Self)
    }
}

impl<T: Stored + Default, const N: usize> Stored for [T; N] {
    fn store<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut tuple = serializer.serialize_tuple(N)?;
        for &element in self {
            tuple.serialize_element(&Element(element))?;
        }
        tuple.end()
    }

    fn load<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_tuple(N, Elements(PhantomData))
    }
}

struct Elements<T, const N: usize>(PhantomData<[T; N]>);

impl<'de, T: Stored + Default, const N: usize> Visitor<'de> for Elements<T, N> {
    type Value = [T; N];

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{N} numbers")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut sequence: A) -> Result<[T; N], A::Error> {
        let mut values = [T::default(); N];
        for (index, value) in values.iter_mut().enumerate() {
            let Element(element) = sequence.next_element()?.ok_or_else(|| de::Error::invalid_length(index, &self))?;
            *value = element;
        }
        Ok(values)
    }
}

macro_rules! stored {
    ($float:ident, $serialize:ident) => {
        impl Stored for $float {
            fn store<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                match *self {
                    number if number.is_finite() || !serializer.is_human_readable() => serializer.$serialize(number),
                    number if number.is_nan() => serializer.serialize_str("nan"),
                    number if number > 0.0 => serializer.serialize_str("inf"),
                    _ => serializer.serialize_str("-inf"),
                }
            }

            fn load<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                if !deserializer.is_human_readable() {
                    return Self::deserialize(deserializer);
                }
                struct Number;
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_precision_loss,
                    trivial_numeric_casts,
                    reason = "a number is read as the nearest of its type"
                )]
                impl Visitor<'_> for Number {
                    type Value = $float;

                    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                        f.write_str("a number, `inf`, `-inf` or `nan`")
                    }

                    fn visit_f64<E: de::Error>(self, number: f64) -> Result<$float, E> {
                        Ok(number as $float)
                    }

                    fn visit_i64<E: de::Error>(self, number: i64) -> Result<$float, E> {
                        Ok(number as $float)
                    }

                    fn visit_u64<E: de::Error>(self, number: u64) -> Result<$float, E> {
                        Ok(number as $float)
                    }

                    fn visit_str<E: de::Error>(self, word: &str) -> Result<$float, E> {
                        match word {
                            "inf" => Ok($float::INFINITY),
                            "-inf" => Ok($float::NEG_INFINITY),
                            "nan" => Ok($float::NAN),
                            _ => Err(E::invalid_value(de::Unexpected::Str(word), &self)),
                        }
                    }
                }
                deserializer.deserialize_any(Number)
            }
        }
    };
}

stored!(f32, serialize_f32);
stored!(f64, serialize_f64);
