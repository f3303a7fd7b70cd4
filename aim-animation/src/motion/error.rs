//! [`MotionError`]: reasons why no motion can be extracted from a clip.

use core::fmt;

/// Reason why no root path can be extracted from a clip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MotionError {
    /// The length of the clip or the rate is not positive and finite.
    Length,
    /// The skeleton has no such bone.
    Bone(usize),
    /// The up direction is zero or not finite.
    Up,
    /// The position of the bone is not finite, or too large, at some time of the clip.
    Place,
}

impl fmt::Display for MotionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length => f.write_str("the length of the clip and the rate have to be positive and finite"),
            Self::Bone(bone) => write!(f, "there is no bone {bone} to move by"),
            Self::Up => f.write_str("the direction up is zero or not finite"),
            Self::Place => f.write_str("the bone is not finite at some time of the clip"),
        }
    }
}

impl core::error::Error for MotionError {}
