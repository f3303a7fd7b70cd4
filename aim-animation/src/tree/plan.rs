//! [`Plan`]: nodes as a list of operations.

use alloc::vec::Vec;
use core::ops::Range;

use super::node::{Parameter, Weights};
use crate::mask::Mask;
use crate::transform::Transform;

/// What a tree does every frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Plan {
    /// Parents before their children, the root first.
    pub(super) shapes: Vec<Shape>,
    /// The child at the end of each edge; the edges of a node follow each other.
    pub(super) children: Vec<usize>,
    pub(super) ops: Vec<Op>,
    pub(super) masks: Vec<Mask>,
    pub(super) references: Vec<Vec<Transform>>,
    /// How many poses and sums are held at once.
    pub(super) slots: usize,
    pub(super) sums: usize,
}

/// A node, by its edges to those that it blends.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    pub(super) rule: Rule,
    pub(super) edges: Range<usize>,
}

/// How a node weighs its edges.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Rule {
    Source(usize),
    Sum(Weights),
    Blend { weight: Parameter, mask: Option<usize> },
    Add { weight: Parameter },
}

/// A step of the evaluation. Poses are in slots, as on a stack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Op {
    /// Goes on at `to` if the edge has no weight.
    Skip { edge: usize, to: usize },
    /// Asks the caller for a pose.
    Source { number: usize, slot: usize },
    /// Begins a sum.
    Begin { sum: usize },
    /// Adds a pose to a sum.
    Gather { edge: usize, slot: usize, sum: usize },
    /// Writes a sum.
    Finish { sum: usize, slot: usize },
    /// Blends the next slot into this one by the weights of the two edges that follow each other.
    Blend { edge: usize, slot: usize, mask: Option<usize> },
    /// Adds the difference of the next slot from a reference to this one.
    Add { edge: usize, slot: usize, mask: Option<usize>, reference: Option<usize> },
}
