//! Scalar constructors that fold: 0, ±1 and constants leave, negations move outward, operands stand in a fixed order.
//!
//! Every fold is exact for finite operands (only the sign of a zero may differ), so folded and unfolded programs agree.

use crate::{Graph, Scalar, ScalarNode};

impl Graph {
    fn negated(&self, a: Scalar) -> Option<Scalar> {
        match self.scalar_node(a) {
            ScalarNode::Neg(inner) => Some(inner),
            _ => None,
        }
    }

    pub(crate) fn fold_neg(&mut self, a: Scalar) -> Scalar {
        if let Some(inner) = self.negated(a) {
            return inner;
        }
        if let Some(c) = self.constant_of(a) {
            return self.constant(-c);
        }
        self.neg(a)
    }

    pub(crate) fn fold_add(&mut self, a: Scalar, b: Scalar) -> Scalar {
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => return self.constant(x + y),
            (Some(0.0), None) => return b,
            (None, Some(0.0)) => return a,
            _ => {}
        }
        match (self.negated(a), self.negated(b)) {
            (Some(a), Some(b)) => {
                let sum = self.fold_add(a, b);
                self.fold_neg(sum)
            }
            (Some(a), None) => self.fold_sub(b, a),
            (None, Some(b)) => self.fold_sub(a, b),
            (None, None) => self.add(a.min(b), a.max(b)),
        }
    }

    pub(crate) fn fold_sub(&mut self, a: Scalar, b: Scalar) -> Scalar {
        if a == b {
            return self.constant(0.0);
        }
        match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => return self.constant(x - y),
            (Some(0.0), None) => return self.fold_neg(b),
            (None, Some(0.0)) => return a,
            _ => {}
        }
        match (self.negated(a), self.negated(b)) {
            (Some(a), Some(b)) => self.fold_sub(b, a),
            (Some(a), None) => {
                let sum = self.fold_add(a, b);
                self.fold_neg(sum)
            }
            (None, Some(b)) => self.fold_add(a, b),
            // One of a − b and b − a is the negation of the other.
            (None, None) if b < a => {
                let difference = self.sub(b, a);
                self.fold_neg(difference)
            }
            (None, None) => self.sub(a, b),
        }
    }

    /// `a` without its sign, and whether it had one.
    fn unsigned(&mut self, a: Scalar) -> (bool, Scalar) {
        match (self.negated(a), self.constant_of(a)) {
            (Some(inner), _) => (true, inner),
            (None, Some(c)) if c < 0.0 => (true, self.constant(-c)),
            _ => (false, a),
        }
    }

    pub(crate) fn fold_mul(&mut self, a: Scalar, b: Scalar) -> Scalar {
        let ((minus_a, a), (minus_b, b)) = (self.unsigned(a), self.unsigned(b));
        let product = match (self.constant_of(a), self.constant_of(b)) {
            (Some(x), Some(y)) => self.constant(x * y),
            (Some(0.0), None) | (None, Some(1.0)) => a,
            (None, Some(0.0)) | (Some(1.0), None) => b,
            _ => self.mul(a.min(b), a.max(b)),
        };
        if minus_a == minus_b { product } else { self.fold_neg(product) }
    }

    pub(crate) fn fold_div(&mut self, a: Scalar, b: Scalar) -> Scalar {
        let ((minus_a, a), (minus_b, b)) = (self.unsigned(a), self.unsigned(b));
        let quotient = match (self.constant_of(a), self.constant_of(b)) {
            (_, Some(1.0)) => a,
            _ => self.div(a, b),
        };
        if minus_a == minus_b { quotient } else { self.fold_neg(quotient) }
    }
}
