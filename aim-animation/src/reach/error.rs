//! [`ReachError`]: reasons why bones are not a limb, or goals cannot be met.

use core::fmt;

use crate::limb::LimbError;

/// Reason why a limb cannot be made to reach its goals.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ReachError {
    /// The length of the clip or the rate is not positive and finite.
    Length,
    /// This bone of the limb is missing or is not a child of the one before it. A limb needs a joint and a tip. The
    /// index counts from the first joint.
    Limb(usize),
    /// At some time of the clip the limb has no length between two of its bones, or is not finite or too far away.
    Place,
    /// The time of this goal is outside the clip.
    Time(usize),
    /// This goal shares its nearest sample with another one.
    Together(usize),
    /// The state belongs to another limb or clip.
    State,
}

impl fmt::Display for ReachError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Length => f.write_str("the length of the clip and the rate have to be positive and finite"),
            Self::Limb(bone) => write!(f, "bone {bone} of the limb is missing or does not hang on the one before it"),
            Self::Place => f.write_str("the limb has no length, or is not finite at some time of the clip"),
            Self::Time(goal) => write!(f, "the time of goal {goal} is not within the clip"),
            Self::Together(goal) => write!(f, "goal {goal} is within a sample of another one; sample at a higher rate"),
            Self::State => f.write_str("the state is of another limb or clip"),
        }
    }
}

impl ReachError {
    pub(super) fn from_limb(error: LimbError) -> Self {
        match error {
            LimbError::Bone(bone) => Self::Limb(bone),
            _ => Self::Place,
        }
    }
}

impl core::error::Error for ReachError {}
