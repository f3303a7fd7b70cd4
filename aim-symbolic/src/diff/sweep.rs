//! What a sweep passed on its way.

use crate::ir::node::Node;
use crate::{Scalar, Variable};

/// How derivatives were taken: everything that the sweep passed, in that order.
#[derive(Clone, Debug)]
pub struct Swept {
    /// Which way.
    pub course: Course,
    /// What was passed.
    pub passages: Vec<Passage>,
}

/// Which way a sweep went.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Course {
    /// From this value back to the variables.
    Back(Scalar),
    /// From this variable forward to the values.
    Forward(Variable),
}

/// A part of the expression on the way of a sweep.
#[derive(Clone, Debug)]
pub struct Passage {
    /// The part.
    pub node: Node,
    /// On the way back the derivative of the value by the part, on the way forward the part's derivative by the variable.
    pub derivative: Node,
    /// On the way back, what the part adds to the value's derivatives by variables.
    pub gives: Vec<(Variable, Scalar)>,
}
