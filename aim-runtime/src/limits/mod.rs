//! Ranges of motion in this pose ([`motion`]) and what a rate leaves of them in one frame ([`reach`]).

pub(crate) mod motion;
pub(crate) mod reach;
