//! The paper's objective: the cosine between where the effector points and where the target is.
//!
//! Stated as the paper states it, effector side (equations 4 to 6):
//!
//! ```text
//! P₀  = (0, 0, 0, 1) M R(p) R(h)                  the effector's origin
//! P₁  = (f, 1)       M R(p) R(h)                  its tip
//! aim = (P − P₀) / |P − P₀| · (P₁ − P₀)
//! ```
//!
//! The small form, which turns the target back into the effector's frame, is found by rewriting.

use aim_symbolic::{Graph, Rigid, Scalar, Vector};

use super::statement::{ChainInputs, Effector, JointInputs, effector_to_end, turned};
use crate::RigSpec;

/// The aim as a function of one joint's pitch and heading.
pub fn joint_aim(g: &mut Graph, spec: &RigSpec, joint: usize, inputs: &JointInputs) -> Scalar {
    let to_end = turned(g, &spec.joints[joint], inputs.effector_to_joint, inputs.pitch, inputs.heading);
    aim(g, spec, to_end, inputs.target)
}

/// The aim as a function of all joints' angles.
pub fn chain_aim(g: &mut Graph, spec: &RigSpec, inputs: &ChainInputs) -> Scalar {
    let to_end = effector_to_end(g, spec, inputs);
    aim(g, spec, to_end, inputs.target)
}

fn aim(g: &mut Graph, spec: &RigSpec, to_end: Rigid, target: Vector) -> Scalar {
    let effector = Effector::at(g, to_end);
    let direction = effector.direction(g, spec.effector.frame.forward);
    let to_target = g.sub_vectors(target, effector.origin);
    let to_target = g.normalize(to_target);
    g.dot(to_target, direction)
}
