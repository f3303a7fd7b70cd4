//! From targets to what a frame turns to: several targets become one ([`blend`]), the policy for targets behind
//! ([`behind`]) and the weight make it a goal ([`goal`]).

pub(crate) mod behind;
pub(crate) mod blend;
pub(crate) mod goal;
