//! Singular points of a statement: the points where it or its derivatives have no limit and their value is a
//! convention.

use crate::ir::node::Node;
use crate::{Function, Graph, Matrix, Op, Scalar, ScalarNode, Stumpff, Variable, Vector, VectorNode};

/// The convention for lengths and for quotients by lengths.
const NO_LENGTH: &str = "one over the length and the length's derivatives count as 0";

/// A condition on the variables under which derivatives have no limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Singular {
    /// The condition.
    pub at: Condition,
    /// The convention that applies there, in words.
    pub convention: &'static str,
}

/// An equation that holds only at singular points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// a = 0
    Zero(Scalar),
    /// |v| = 0
    NoLength(Vector),
    /// |a| = 1
    One(Scalar),
    /// a = 0 and b = 0
    Origin(Scalar, Scalar),
    /// a = b
    Equal(Scalar, Scalar),
    /// det M = 0
    NoInverse(Matrix),
}

impl Graph {
    /// Returns the conditions under which these expressions or their derivatives by `variables` have no limit, each
    /// once.
    ///
    /// The conditions are those of the individual nodes, and are listed even if the expression as a whole has a limit.
    /// Quotients that are 0 / 0 are taken as stated, so those with a limit must be rewritten beforehand.
    pub(crate) fn singular_points(&mut self, expressions: &[Scalar], variables: &[Variable]) -> Vec<Singular> {
        let order = self.order(expressions);
        let active = self.active(&order, variables);
        let mut found: Vec<Singular> = Vec::new();
        for node in order.into_iter().filter(|&node| active.contains(node)) {
            let singular = match node {
                Node::Scalar(s) => self.singular_scalar(s, |part| active.contains(Node::Scalar(part))),
                Node::Vector(v) => self.singular_vector(v, |part| active.contains(Node::Vector(part))),
            };
            if let Some((at, convention)) = singular
                && !matches!(at, Condition::NoLength(v) if self.is_never_zero_vector(v))
                && !found.iter().any(|known| known.at == at)
            {
                found.push(Singular { at, convention });
            }
        }
        found
    }

    /// Returns `true` if a component is a constant other than 0.
    fn is_never_zero_vector(&self, v: Vector) -> bool {
        let VectorNode::Components(c) = self.vector_node(v) else { return false };
        c.into_iter().any(|c| self.constant_of(c).is_some_and(|c| c != 0.0))
    }

    fn singular_scalar(&mut self, s: Scalar, active: impl Fn(Scalar) -> bool) -> Option<(Condition, &'static str)> {
        use Condition::{Equal, NoLength, One, Origin, Zero};
        let ScalarNode::Op(op) = self.scalar_node(s) else {
            return match self.scalar_node(s) {
                ScalarNode::Norm(v) => Some((NoLength(v), NO_LENGTH)),
                ScalarNode::Reciprocal(a) => match self.scalar_node(a) {
                    ScalarNode::Norm(v) => Some((NoLength(v), NO_LENGTH)),
                    _ => Some((Zero(a), "one over it counts as 0")),
                },
                _ => None,
            };
        };
        match op {
            Op::Div(_, b) if active(b) && !self.is_guarded_or_positive(b) => {
                Some((Zero(b), "the quotient is not finite"))
            }
            Op::Sqrt(a) if !self.is_guarded_or_positive(a) => Some((Zero(a), "the root's derivatives count as 0")),
            Op::Call(Function::Ln, a) => Some((Zero(a), "the logarithm's derivatives count as 0")),
            Op::Call(Function::Asin | Function::Acos, a) => Some((One(a), "the angle's derivatives count as 0")),
            Op::Call(Function::Floor, a) => Some((Equal(s, a), "the derivatives pass over the jump")),
            Op::Call(Function::Tan, a) => Some((Zero(self.call(Function::Cos, a)), "the tangent is not finite")),
            Op::Atan2(y, x) => {
                let at = match [y, x].map(|part| self.constant_of(part)) {
                    [None, None] => Origin(y, x),
                    [None, Some(0.0)] => Zero(y),
                    [Some(0.0), None] => Zero(x),
                    _ => return None,
                };
                Some((at, "the angle's derivatives count as 0"))
            }
            Op::Pow(a, _) if active(a) => Some((Zero(a), "the power's derivatives count as 0")),
            Op::SelectLess(a, b, ..) if !self.is_tiny(a) && (active(a) || active(b)) => {
                Some((Equal(a, b), "the derivatives are those of the branch that is taken"))
            }
            _ => None,
        }
    }

    /// Returns `true` if a division by `b` is guarded, or if `b` is a hyperbolic cosine.
    fn is_guarded_or_positive(&self, b: Scalar) -> bool {
        match self.scalar_node(b) {
            ScalarNode::Norm(_)
            | ScalarNode::Op(Op::Call(Function::Cosh, _))
            | ScalarNode::Stumpff(Stumpff { hyperbolic: true, order: 0 }, _) => true,
            ScalarNode::Op(Op::SelectLess(a, .., otherwise)) => {
                self.is_tiny(a) && self.constant_of(otherwise) == Some(1.0)
            }
            _ => false,
        }
    }

    /// Returns `true` for [`Op::Tiny`], by which stated expressions are guarded already.
    fn is_tiny(&self, a: Scalar) -> bool {
        self.scalar_node(a) == ScalarNode::Op(Op::Tiny)
    }

    fn singular_vector(&self, v: Vector, active: impl Fn(Vector) -> bool) -> Option<(Condition, &'static str)> {
        match self.vector_node(v) {
            VectorNode::Normalize(inner) => Some((Condition::NoLength(inner), "the direction counts as 0")),
            VectorNode::Solve(m, _) if m.columns.into_iter().any(active) => {
                Some((Condition::NoInverse(m), "the inverse is not finite"))
            }
            _ => None,
        }
    }
}
