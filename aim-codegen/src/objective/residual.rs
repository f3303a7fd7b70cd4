//! The chain's residual: by how much the effector misses the target, left and up.
//!
//! With `v` the way from the effector to the target, `f`, `l`, `u` the effector's forward, left and up directions:
//!
//! ```text
//! s = 2 (v · l, v · u) / (|v| + v · f)
//! ```
//!
//! the stereographic projection of `v / |v|`, of length 2 tan(angle / 2). It is monotonous up to 180°, where it is
//! singular; there, and with the target on the effector, it is 0 with a zero Jacobian, so success must be judged by
//! the angle.

use aim_symbolic::{Graph, Scalar};

use super::statement::{ChainInputs, Effector, effector_to_end};
use crate::RigSpec;

/// The residual, left and up, as functions of all joints' angles.
pub fn chain_residual(g: &mut Graph, spec: &RigSpec, inputs: &ChainInputs) -> [Scalar; 2] {
    let to_end = effector_to_end(g, spec, inputs);
    let effector = Effector::at(g, to_end);
    let frame = spec.effector.frame;
    let [forward, left, up] = [frame.forward, frame.left, frame.up].map(|axis| effector.direction(g, axis));

    let to_target = g.sub_vectors(inputs.target, effector.origin);
    let distance = g.norm(to_target);
    let ahead = g.dot(to_target, forward);
    let sum = g.add(distance, ahead);
    let reciprocal = g.reciprocal(sum);
    let two = g.constant(2.0);
    let twice = g.mul(two, reciprocal);
    [left, up].map(|axis| {
        let aside = g.dot(to_target, axis);
        g.mul(twice, aside)
    })
}
