//! Records of derivative sweeps.

use crate::ir::node::Node;
use crate::{Scalar, Variable};

/// The record of a sweep: all nodes that it visited, in order.
#[derive(Clone, Debug)]
pub struct SweepRecord {
    /// The direction of the sweep.
    pub direction: SweepDirection,
    /// The visited nodes.
    pub visited: Vec<VisitedNode>,
}

/// The direction of a sweep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepDirection {
    /// Backward, from this value to the variables.
    Backward(Scalar),
    /// Forward, from this variable to the values.
    Forward(Variable),
}

/// A node that a sweep visited.
#[derive(Clone, Debug)]
pub struct VisitedNode {
    /// The visited node.
    pub node: Node,
    /// Backward, the derivative of the value by the node; forward, the derivative of the node by the variable.
    pub derivative: Node,
    /// Backward, the node's contributions to the derivatives of the value by variables. Empty forward.
    pub contributions: Vec<(Variable, Scalar)>,
}
