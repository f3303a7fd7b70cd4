//! Ranges of motion in this pose ([`motion`]) and what a rate leaves of them in one frame ([`reach`]).

pub(crate) mod motion;
pub(crate) mod reach;

/// An interval of angles, radians.
pub(crate) type Interval = aim_model::Interval<f32>;
/// A joint's ranges of motion in this call, as intervals of its added angles.
pub(crate) type RangeOfMotion = aim_model::RangeOfMotion<f32>;
/// An added heading and pitch, radians.
pub(crate) type Angles<T = f32> = aim_model::Angles<T>;
