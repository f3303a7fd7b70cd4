//! Aiming on top of an animation, checked by forward kinematics in f64.

mod gizmos;
mod glue;
mod hits;
mod layers;
mod planting;
