//! [`Plan`]: a tree compiled to a list of operations.

use alloc::vec::Vec;
use core::ops::Range;

use super::node::{Parameter, Weights};
use crate::mask::Mask;
use crate::transform::Transform;

/// A compiled tree, evaluated every frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Plan {
    /// The nodes; parents precede their children, the root is first.
    pub(super) shapes: Vec<Shape>,
    /// The child node of each edge; the edges of a node are consecutive.
    pub(super) children: Vec<usize>,
    pub(super) ops: Vec<Op>,
    pub(super) masks: Vec<Mask>,
    pub(super) references: Vec<Vec<Transform>>,
    /// Number of poses that are held at once.
    pub(super) slots: usize,
    pub(super) sums: usize,
}

/// A node and its edges to the nodes that it blends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    pub(super) rule: Rule,
    pub(super) edges: Range<usize>,
}

/// Rule for the weights of a node's edges.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Rule {
    Source(usize),
    Sum(Weights),
    Blend { weight: Parameter, mask: Option<usize> },
    Add { weight: Parameter },
}

/// An operation of the evaluation. Poses are in slots, used like a stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Op {
    /// Jumps to operation `to` if the edge has no weight.
    Skip { edge: usize, to: usize },
    /// Requests a pose from the caller.
    Source { number: usize, slot: usize },
    /// Starts a sum.
    Begin { sum: usize },
    /// Adds a weighted pose to a sum.
    Gather { edge: usize, slot: usize, sum: usize },
    /// Writes the result of a sum to a slot.
    Finish { sum: usize, slot: usize },
    /// Blends the next slot into this one, by the weights of edge `edge` and the one after it.
    Blend { edge: usize, slot: usize, mask: Option<usize> },
    /// Adds to this slot the difference between the next slot and a reference pose.
    Add { edge: usize, slot: usize, mask: Option<usize>, reference: Option<usize> },
}
