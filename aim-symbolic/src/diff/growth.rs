//! Decides whether 0 times an expression is 0, which fails if the expression may be infinite or NaN.
//!
//! The inputs are only known to be finite, and a product of two inputs can already overflow. So each expression has a
//! degree: sums of inputs are taken for finite, products of inputs are not. A guarded reciprocal is at most the square
//! root of the largest finite number, so that a product of two of them is finite; it has half the degree of an input.

use crate::ir::node::Node;
use crate::ir::table::NodeTable;
use crate::{Attitude, Function, Graph, Op, Rotation, Scalar, ScalarNode, Vector, VectorNode};

/// The degree of expressions that may be infinite or NaN.
const UNBOUNDED: u8 = u8::MAX;

/// The degree of an input, and the largest degree that is taken for finite.
const FINITE: u8 = 2;

/// The degrees of the nodes of a sweep.
#[derive(Default)]
pub(crate) struct Growth {
    known: NodeTable<u8>,
}

impl Growth {
    /// Computes the degrees of `order`, in which each node comes after its operands.
    pub(crate) fn of(g: &Graph, order: &[Node]) -> Self {
        let mut growth = Self::default();
        for &node in order {
            let degree = growth.degree(g, node, None);
            growth.known.insert(node, degree);
        }
        growth
    }

    /// Returns `true` if `change`, an expression of the adjoint and of nodes with known degrees, is 0 wherever the
    /// adjoint is 0.
    pub(crate) fn keeps_zero(&self, g: &Graph, change: Node, adjoint: Node) -> bool {
        self.degree(g, change, Some(adjoint)) <= FINITE
    }

    fn degree(&self, g: &Graph, node: Node, zero: Option<Node>) -> u8 {
        if zero == Some(node) {
            return 0;
        }
        if let Some(known) = self.known.copied(node) {
            return known;
        }
        let of = DegreeRules { growth: self, g, zero };
        match node {
            Node::Scalar(s) => of.scalar_node(g.scalar_node(s)),
            Node::Vector(v) => of.vector_node(g.vector_node(v)),
        }
    }
}

/// Computes the degree of a node from those of its operands.
#[derive(Clone, Copy)]
struct DegreeRules<'a> {
    growth: &'a Growth,
    g: &'a Graph,
    /// The node that is assumed to be 0.
    zero: Option<Node>,
}

impl DegreeRules<'_> {
    fn scalar(self, s: Scalar) -> u8 {
        self.growth.degree(self.g, Node::Scalar(s), self.zero)
    }

    fn vector(self, v: impl Into<Vector>) -> u8 {
        self.growth.degree(self.g, Node::Vector(v.into()), self.zero)
    }

    fn scalar_node(self, node: ScalarNode) -> u8 {
        match node {
            ScalarNode::Op(Op::Input(_)) => FINITE,
            ScalarNode::Op(Op::Constant(c)) if c.value().is_finite() => 0,
            ScalarNode::Op(Op::Tiny) => 0,
            ScalarNode::Op(Op::Add(a, b) | Op::Sub(a, b)) => self.scalar(a).max(self.scalar(b)),
            ScalarNode::Op(Op::Mul(a, b)) => self.scalar(a).saturating_add(self.scalar(b)),
            ScalarNode::Op(Op::Div(a, b)) if self.g.constant_of(b).is_some_and(|c| c != 0.0) => self.scalar(a),
            ScalarNode::Op(Op::Neg(a)) => self.scalar(a),
            ScalarNode::Op(Op::SelectLess(_, _, then, otherwise)) => self.scalar(then).max(self.scalar(otherwise)),
            ScalarNode::Op(Op::Call(Function::Sin | Function::Cos, a)) => bounded(self.scalar(a)),
            ScalarNode::Op(Op::Atan2(y, x)) => bounded(self.scalar(y).max(self.scalar(x))),
            // The guard makes it finite even if the operand is NaN.
            ScalarNode::Reciprocal(_) => FINITE / 2,
            ScalarNode::Dot(v, w) => self.vector(v).saturating_add(self.vector(w)),
            ScalarNode::Norm(v) => self.vector(v).saturating_mul(2),
            ScalarNode::Component(v, _) => self.vector(v),
            ScalarNode::Real(_, _, w) => self.scalar(w),
            _ => UNBOUNDED,
        }
    }

    fn vector_node(self, node: VectorNode) -> u8 {
        match node {
            VectorNode::Components(c) => c.into_iter().map(|c| self.scalar(c)).max().unwrap_or(0),
            VectorNode::Add(v, w) | VectorNode::Sub(v, w) => self.vector(v).max(self.vector(w)),
            VectorNode::Neg(v) | VectorNode::Perp(_, v) => self.vector(v),
            VectorNode::Scale(k, v) => self.scalar(k).saturating_add(self.vector(v)),
            VectorNode::Rotate(rotation, v) => self.vector(v).saturating_add(self.rotation(rotation)),
            VectorNode::Normalize(v) => bounded(self.vector(v)),
            VectorNode::Cross(v, w) => self.vector(v).saturating_add(self.vector(w)),
            VectorNode::Across(v, u) => self.vector(v).saturating_add(bounded(self.vector(u))),
            VectorNode::Motion(_, Attitude::Quaternion(u, w)) => self.vector(u).max(self.scalar(w)),
            VectorNode::Motion(_, Attitude::Turn(v)) => self.vector(v),
            VectorNode::Imaginary(_, u, _) => self.vector(u),
            VectorNode::Solve(..) => UNBOUNDED,
        }
    }

    /// Returns the degree of a rotation, which preserves lengths: 0 if its numbers are finite.
    fn rotation(self, rotation: Rotation) -> u8 {
        let degrees = self.g.numbers(rotation).into_iter().map(|node| self.growth.degree(self.g, node, self.zero));
        bounded(degrees.max().unwrap_or(0))
    }
}

/// Returns the degree of an expression whose absolute value is at most about 1 if its operands are finite.
fn bounded(degree: u8) -> u8 {
    if degree <= FINITE { 0 } else { UNBOUNDED }
}
