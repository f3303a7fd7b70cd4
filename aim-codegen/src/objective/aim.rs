//! The paper's objective: the cosine of the angle between the effector's direction and the direction to the target.
//!
//! Stated on the effector side, as in the paper (equations 4 to 6):
//!
//! ```text
//! P₀  = (0, 0, 0, 1) M R(p) R(h)                  the effector's origin
//! P₁  = (f, 1)       M R(p) R(h)                  its tip
//! aim = (P − P₀) / |P − P₀| · (P₁ − P₀)
//! ```
//!
//! Rewriting finds the smaller form, which transforms the target into the effector's frame instead.

use aim_symbolic::print::Formula;
use aim_symbolic::{Graph, Scalar};

use super::chain::Chain;
use super::statement::{Objective, Scope};

/// Aim of one joint and its gradient; joints nearer the effector are held still.
pub const AIM_GRADIENT: Objective = Objective {
    name: "aim_gradient",
    title: "aim and gradient",
    scope: Scope::Joint,
    outputs: |joint, _| format!("Aim of joint {joint}, d aim / d pitch, d aim / d heading."),
    symbols,
    state,
};

/// Aim of the chain and its gradient with respect to the angles of all joints.
pub const CHAIN_VALUE_GRADIENT: Objective = Objective {
    name: "chain_value_gradient",
    scope: Scope::Chain,
    outputs: |_, angles| {
        format!("The chain's aim, then its {angles} derivatives, pitch before heading, joint by joint.")
    },
    ..AIM_GRADIENT
};

fn symbols() -> Vec<Formula> {
    vec![Formula::upright("aim")]
}

fn state(g: &mut Graph, chain: &Chain<'_>) -> Vec<Scalar> {
    let effector = chain.effector_at_end(g);
    let direction = effector.direction(g, chain.effector.frame.forward);
    let to_target = g.sub_vectors(chain.inputs.target, effector.origin);
    let to_target = g.normalize(to_target);
    vec![g.dot(to_target, direction)]
}
