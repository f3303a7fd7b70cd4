//! Joint limits: the ranges of motion in a pose ([`motion`]), and the part of them that a rate allows in one frame
//! ([`reach`]).

pub(crate) mod motion;
pub(crate) mod reach;

/// An interval of angles, radians.
pub(crate) type Interval = aim_model::Interval<f32>;
/// A joint's ranges of motion in one pose, as intervals of its added angles.
pub(crate) type RangeOfMotion = aim_model::RangeOfMotion<f32>;
/// An added heading and pitch, radians.
pub(crate) type Angles<T = f32> = aim_model::Angles<T>;
