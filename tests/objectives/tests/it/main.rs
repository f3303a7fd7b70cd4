//! Objectives as users write them, judged by dual numbers.

mod aiming;
mod branches;
mod companions;
mod distances;
mod energies;
mod harness;
mod limits;
mod manifolds;
mod natural;
mod rotations;
