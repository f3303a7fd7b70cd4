//! From targets to the goal of a frame: several targets are blended into one ([`blend`]); the policy for targets behind
//! ([`behind`]) and the weight turn it into a goal ([`goal`]).

pub(crate) mod behind;
pub(crate) mod blend;
pub(crate) mod goal;
