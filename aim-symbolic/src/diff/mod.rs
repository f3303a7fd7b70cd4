//! Derivatives: reverse sweeps from a value, over whole vectors, and forward sweeps from a variable.

pub(crate) mod differential;
mod gradient;
mod growth;
mod local;
mod mask;
mod partial;
mod plane_angle;
pub(crate) mod step;
pub(crate) mod sweep;
mod tangent;
