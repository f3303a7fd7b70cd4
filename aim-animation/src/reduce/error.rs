//! [`ReductionError`]: reasons why a clip cannot be reduced.

use core::fmt;

/// Reason why a clip cannot be reduced.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ReductionError {
    /// A tolerance is negative or not finite.
    Tolerance(f32),
    /// The time of a pin is negative or not finite.
    Pin(f32),
    /// The packed tracks would take more than 2³² bits.
    Size,
}

impl fmt::Display for ReductionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Tolerance(tolerance) => {
                write!(f, "a tolerance of {tolerance}; it may not be negative and has to be finite")
            }
            Self::Pin(time) => {
                write!(f, "the time of a pin is {time} s; it may not be negative and has to be finite")
            }
            Self::Size => write!(f, "the packed tracks take more than 2³² bits; cut the clip into pieces"),
        }
    }
}

impl core::error::Error for ReductionError {}
