//! The chain's residual: the effector's deviation from the target, left and up.
//!
//! With `v` the vector from the effector to the target, and `f`, `l`, `u` the effector's forward, left and up
//! directions:
//!
//! ```text
//! s = 2 (v · l, v · u) / (|v| + v · f)
//! ```
//!
//! This is the stereographic projection of `v / |v|`, of length 2 tan(angle / 2). It is monotonic up to 180°, where it
//! is singular. There, and if the target coincides with the effector, it is 0 with a zero Jacobian, so success must be
//! judged by the angle instead.

use aim_symbolic::print::Formula;
use aim_symbolic::{Graph, Scalar};

use super::chain::Chain;
use super::statement::{Objective, Scope};

/// Residual (left, up) and its Jacobian.
pub const CHAIN_RESIDUAL_JACOBIAN: Objective = Objective {
    name: "chain_residual_jacobian",
    title: "residual and Jacobian",
    scope: Scope::Chain,
    outputs: |_, angles| {
        format!(
            "The chain's stereographic residual (left, up), then the {angles} derivatives of the first and of the second."
        )
    },
    symbols: || ["left", "up"].map(|side| Formula::italic("s").indexed(Formula::upright(side))).to_vec(),
    state,
};

fn state(g: &mut Graph, chain: &Chain<'_>) -> Vec<Scalar> {
    let effector = chain.effector_at_end(g);
    let frame = chain.effector.frame;
    let [forward, left, up] = [frame.forward, frame.left, frame.up].map(|axis| effector.direction(g, axis));

    let to_target = g.sub_vectors(chain.inputs.target, effector.origin);
    let distance = g.norm(to_target);
    let ahead = g.dot(to_target, forward);
    let sum = g.add(distance, ahead);
    let reciprocal = g.reciprocal(sum);
    let two = g.constant(2.0);
    let twice = g.mul(two, reciprocal);
    let aside = [left, up].map(|axis| {
        let aside = g.dot(to_target, axis);
        g.mul(twice, aside)
    });
    aside.to_vec()
}
