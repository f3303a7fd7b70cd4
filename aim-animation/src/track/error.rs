//! [`TrackError`]: reasons why keys do not form a track.

use core::fmt;

/// Reason why keys do not form a track. Keys are counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum TrackError {
    /// There are no keys.
    Empty,
    /// The numbers of times and values differ.
    Lengths {
        /// The number of times.
        times: usize,
        /// The number of values.
        values: usize,
    },
    /// The time of this key is negative or not finite.
    Time(usize),
    /// The time of this key is less than that of the key before it, or equal to those of both keys before it.
    Order(usize),
    /// The value of this key is not finite, exceeds 1e15, or is a quaternion of length 0.
    Value(usize),
    /// A tangent or control point of this key is not finite, or makes the curve exceed 1e15.
    Tangent(usize),
}

impl fmt::Display for TrackError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("a track needs one key at least"),
            Self::Lengths { times, values } => write!(f, "{times} times but {values} values"),
            Self::Time(key) => write!(f, "the time of key {key} is negative or not finite"),
            Self::Order(key) => {
                write!(
                    f,
                    "the time of key {key} is less than the one before; two keys at most may share a time, for a jump"
                )
            }
            Self::Value(key) => {
                write!(f, "the value of key {key} is not finite, too large, or a quaternion of length 0")
            }
            Self::Tangent(key) => write!(f, "a tangent of key {key} is not finite or too large"),
        }
    }
}

impl core::error::Error for TrackError {}
