//! Objectives as users write them, judged by dual numbers.

mod aiming;
mod branches;
mod by_hand;
mod companions;
mod counted;
mod discrete;
mod distances;
mod documented;
mod elementary;
mod energies;
mod exponential;
mod fields;
mod harness;
mod kept;
mod language;
mod least_squares;
mod lengths;
mod limits;
mod lists;
mod manifolds;
mod natural;
mod nested;
mod powers;
mod quotients;
mod roots;
mod rotations;
