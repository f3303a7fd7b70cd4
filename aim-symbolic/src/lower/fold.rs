//! Folding constructors of scalars: drop 0, ±1 and constants, move negations outward, and put operands in a fixed
//! order.
//!
//! Folds of 0, ±1 and signs are exact for finite operands, except that the sign of a zero may differ. Constants are
//! computed in f64 and rounded once, to the type in which the program runs.

use crate::lower::sides::Join;
use crate::rewrite::rules::{CONSTANTS, NEGATIONS, ORDER, Rules};
use crate::{Function, Graph, Number, Op, Scalar, ScalarNode};

/// Limit on the depth to which sums are searched for terms to cancel.
const DEEPEST_SUM: u32 = 6;

/// A graph whose scalars are folded as they are built.
#[derive(Clone, Debug)]
pub struct Fold {
    /// The graph.
    pub g: Graph,
    constants: bool,
    negations: bool,
    order: bool,
}

impl Fold {
    /// Wraps a graph. Of the rules only [`CONSTANTS`], [`NEGATIONS`] and [`ORDER`] are considered.
    #[must_use]
    pub fn new(g: Graph, rules: &Rules<'_>) -> Self {
        Self { g, constants: rules.has(&CONSTANTS), negations: rules.has(&NEGATIONS), order: rules.has(&ORDER) }
    }

    fn ordered(&self, a: Scalar, b: Scalar) -> (Scalar, Scalar) {
        if self.order && b < a { (b, a) } else { (a, b) }
    }

    /// Returns the value of a constant, or `None` if constants are not folded.
    #[must_use]
    pub fn constant_of(&self, a: Scalar) -> Option<f64> {
        if self.constants { self.g.constant_of(a) } else { None }
    }

    /// Builds the folded result of an operation.
    pub(crate) fn op(&mut self, op: Op<Scalar>) -> Scalar {
        match op {
            Op::Add(a, b) => self.add(a, b),
            Op::Sub(a, b) => self.sub(a, b),
            Op::Mul(a, b) => self.mul(a, b),
            Op::Div(a, b) => self.div(a, b),
            Op::Neg(a) => self.neg(a),
            Op::Sqrt(a) => self.sqrt(a),
            Op::SelectLess(a, b, then, otherwise) => self.select_less(a, b, then, otherwise),
            Op::Call(function, a) => self.call(function, a),
            Op::Constant(_) | Op::Input(_) | Op::Tiny | Op::Atan2(..) | Op::Pow(..) => {
                self.g.intern_scalar(ScalarNode::Op(op))
            }
        }
    }

    /// √a
    pub fn sqrt(&mut self, a: Scalar) -> Scalar {
        match self.constant_of(a) {
            Some(x) if x >= 0.0 => self.g.constant(x.sqrt()),
            _ => self.g.sqrt(a),
        }
    }

    /// A function of `a`. A sign of the argument is dropped for even functions and moved out of odd ones.
    pub fn call(&mut self, function: Function, a: Scalar) -> Scalar {
        let value = self.constant_of(a).map(|x| x.call(function));
        match (value, self.negated(a), function) {
            (Some(value), ..) if value.is_finite() => self.g.constant(value),
            (_, Some(inner), Function::Cos | Function::Cosh) => self.g.call(function, inner),
            (_, Some(inner), Function::Sin | Function::Tan | Function::Asin | Function::Sinh | Function::Tanh) => {
                let positive = self.g.call(function, inner);
                self.neg(positive)
            }
            _ => self.g.call(function, a),
        }
    }

    fn negated(&self, a: Scalar) -> Option<Scalar> {
        if !self.negations {
            return None;
        }
        match self.g.scalar_node(a) {
            ScalarNode::Op(Op::Neg(inner)) => Some(inner),
            _ => None,
        }
    }

    /// −a
    pub fn neg(&mut self, a: Scalar) -> Scalar {
        if let Some(inner) = self.negated(a) {
            return inner;
        }
        if let Some(c) = self.constant_of(a) {
            return self.g.constant(-c);
        }
        self.g.neg(a)
    }

    /// a + b
    pub fn add(&mut self, a: Scalar, b: Scalar) -> Scalar {
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => return self.g.constant(x + y),
            (Some(0.0), None) => return b,
            (None, Some(0.0)) => return a,
            (Some(x), None) if x < 0.0 && self.negations => {
                let positive = self.g.constant(-x);
                return self.sub(b, positive);
            }
            (None, Some(y)) if y < 0.0 && self.negations => {
                let positive = self.g.constant(-y);
                return self.sub(a, positive);
            }
            _ => {}
        }
        match (self.negated(a), self.negated(b)) {
            (Some(a), Some(b)) => {
                let sum = self.add(a, b);
                self.neg(sum)
            }
            (Some(a), None) => self.sub(b, a),
            (None, Some(b)) => self.sub(a, b),
            (None, None) => {
                let sum = self.multiples(a, b, 1.0).or_else(|| self.restored(a, b)).or_else(|| self.restored(b, a));
                let sum = sum.or_else(|| self.sum_of_sides(a, b, false, Join::Alike));
                sum.unwrap_or_else(|| {
                    let (a, b) = self.ordered(a, b);
                    self.g.add(a, b)
                })
            }
        }
    }

    /// a − b
    pub fn sub(&mut self, a: Scalar, b: Scalar) -> Scalar {
        if a == b {
            return self.g.constant(0.0);
        }
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => return self.g.constant(x - y),
            (Some(0.0), None) => return self.neg(b),
            (None, Some(0.0)) => return a,
            (None, Some(y)) if y < 0.0 && self.negations => {
                let positive = self.g.constant(-y);
                return self.add(a, positive);
            }
            _ => {}
        }
        let joined = self.multiples(a, b, -1.0).or_else(|| self.left(a, b, DEEPEST_SUM));
        let joined = joined.or_else(|| self.sum_of_sides(a, b, true, Join::Alike));
        if let Some(joined) = joined {
            return joined;
        }
        match (self.negated(a), self.negated(b)) {
            (Some(a), Some(b)) => self.sub(b, a),
            (Some(a), None) => {
                let sum = self.add(a, b);
                self.neg(sum)
            }
            (None, Some(b)) => self.add(a, b),
            // a − b and b − a share one node; the other is its negation.
            (None, None) if self.order && self.negations && b < a => {
                let difference = self.g.sub(b, a);
                self.neg(difference)
            }
            (None, None) => self.g.sub(a, b),
        }
    }

    /// (a − b) + b = a
    fn restored(&self, difference: Scalar, b: Scalar) -> Option<Scalar> {
        match self.g.scalar_node(difference) {
            ScalarNode::Op(Op::Sub(a, subtracted)) if subtracted == b && self.constants => Some(a),
            _ => None,
        }
    }

    /// c a ± d a = (c ± d) a, with `sign` the sign of the second term.
    fn multiples(&mut self, a: Scalar, b: Scalar, sign: f64) -> Option<Scalar> {
        let ((c, x), (d, y)) = (self.multiple(a), self.multiple(b));
        let factor = c + sign * d;
        (x == y && (c, d) != (1.0, 1.0) && factor.is_finite()).then(|| {
            let factor = self.g.constant(factor);
            self.mul(factor, x)
        })
    }

    /// (a + b + c) − (b + c) = a, for sums up to this depth. Constants are not cancelled: (1 + x) − 1 may be meant to
    /// round.
    fn left(&mut self, a: Scalar, b: Scalar, depth: u32) -> Option<Scalar> {
        if cfg!(aim_small) || !self.constants || self.g.constant_of(b).is_some() {
            return None;
        }
        if a == b {
            return Some(self.g.constant(0.0));
        }
        let depth = depth.checked_sub(1)?;
        let terms = |g: &Graph, s| match g.scalar_node(s) {
            ScalarNode::Op(Op::Add(x, y)) => Some((x, y)),
            _ => None,
        };
        if let Some((x, y)) = terms(&self.g, a) {
            for (one, other) in [(x, y), (y, x)] {
                if let Some(left) = self.left(one, b, depth) {
                    return Some(self.add(left, other));
                }
            }
        }
        let (x, y) = terms(&self.g, b)?;
        let left = self.left(a, x, depth)?;
        self.left(left, y, depth)
    }

    /// Returns the constant factor of a product, 1 if there is none, and the other factor.
    pub(super) fn multiple(&self, a: Scalar) -> (f64, Scalar) {
        match self.g.scalar_node(a) {
            ScalarNode::Op(Op::Add(x, y)) if x == y && self.constants => (2.0, x),
            ScalarNode::Op(Op::Mul(x, y)) => match (self.constant_of(x), self.constant_of(y)) {
                (Some(c), None) => (c, y),
                (None, Some(c)) => (c, x),
                _ => (1.0, a),
            },
            _ => (1.0, a),
        }
    }

    /// c (d a) = a if c d = 1
    fn cancelled(&self, factor: Scalar, multiple: Scalar) -> Option<Scalar> {
        let (c, (d, a)) = (self.constant_of(factor)?, self.multiple(multiple));
        (c * d == 1.0).then_some(a)
    }

    /// √a √a = a
    fn square(&self, root: Scalar, other: Scalar) -> Option<Scalar> {
        match self.g.scalar_node(root) {
            ScalarNode::Op(Op::Sqrt(square)) if root == other && self.constants => Some(square),
            _ => None,
        }
    }

    /// Returns `true` if `a` has a sign, and `a` without it.
    fn unsigned(&mut self, a: Scalar) -> (bool, Scalar) {
        match (self.negated(a), self.constant_of(a)) {
            (Some(inner), _) => (true, inner),
            (None, Some(c)) if c < 0.0 && self.negations => (true, self.g.constant(-c)),
            _ => (false, a),
        }
    }

    /// a b
    pub fn mul(&mut self, a: Scalar, b: Scalar) -> Scalar {
        let ((minus_a, a), (minus_b, b)) = (self.unsigned(a), self.unsigned(b));
        let product = match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => self.g.constant(x * y),
            (Some(0.0), None) | (None, Some(1.0)) => a,
            (None, Some(0.0)) | (Some(1.0), None) => b,
            _ => {
                let shorter = self.square(a, b).or_else(|| self.cancelled(a, b)).or_else(|| self.cancelled(b, a));
                shorter.or_else(|| self.chosen(a, b)).or_else(|| self.chosen(b, a)).unwrap_or_else(|| {
                    let (a, b) = self.ordered(a, b);
                    self.g.mul(a, b)
                })
            }
        };
        if minus_a == minus_b { product } else { self.neg(product) }
    }

    /// a / b
    pub fn div(&mut self, a: Scalar, b: Scalar) -> Scalar {
        let ((minus_a, a), (minus_b, b)) = (self.unsigned(a), self.unsigned(b));
        let quotient = match (self.constant_of(a), self.constant_of(b)) {
            (_, Some(1.0)) | (Some(0.0), _) => a,
            (Some(x), Some(y)) if (x / y).is_finite() => self.g.constant(x / y),
            _ => self.g.div(a, b),
        };
        if minus_a == minus_b { quotient } else { self.neg(quotient) }
    }
}
