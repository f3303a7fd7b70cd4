//! Limbs: closed forms that put the end of a few bones where it should be.

mod two_bone;

pub use two_bone::{Bend, Hinge, Limb, TwoBone, TwoBoneOutcome, TwoBoneStatus};
