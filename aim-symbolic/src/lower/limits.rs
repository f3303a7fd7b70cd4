//! Functions that are smooth where their closed form is 0 / 0: lowered to a series there and to the closed form
//! elsewhere.
//!
//! Both are computed, and a select chooses: `Tiny < margin ? closed : series`. Number types without an order use the
//! closed form wherever the margin is not 0. Only the highest required order is computed as a series; lower orders
//! follow from it by recurrences that do not lose digits.

use rustc_hash::FxHashMap;

use crate::ir::node::Node;
use crate::ir::smooth::factorial;
use crate::lower::fold::Fold;
use crate::{Op, Scalar, ScalarNode, Stumpff};

/// The number of terms in the series of Stumpff functions. They are used for s < 1, so the first omitted term is below
/// 1/18!.
const STUMPFF_TERMS: u8 = 9;

/// The degree of the series of arc functions. They are used for s/q < 1/8, so the first omitted term is below 2⁻⁵⁴.
const ARC_TERMS: u8 = 18;

/// The highest required orders, by argument.
#[derive(Clone, Debug, Default)]
pub(crate) struct HighestOrders {
    /// The highest even and the highest odd order of Stumpff functions.
    stumpff: FxHashMap<(bool, Scalar), [u8; 2]>,
    arc: FxHashMap<(Scalar, Scalar), u8>,
}

impl HighestOrders {
    /// Notes the orders that occur among the nodes.
    pub(crate) fn record_orders(&mut self, g: &crate::Graph, nodes: &[Node]) {
        for node in nodes {
            let Node::Scalar(s) = *node else { continue };
            match g.scalar_node(s) {
                ScalarNode::Stumpff(Stumpff { hyperbolic, order }, s) => {
                    let highest = self.stumpff.entry((hyperbolic, s)).or_default();
                    let highest = &mut highest[usize::from(order % 2)];
                    *highest = order.max(*highest);
                }
                ScalarNode::Arc(order, s, w) => {
                    let highest = self.arc.entry((s, w)).or_default();
                    *highest = order.max(*highest);
                }
                _ => {}
            }
        }
    }

    /// Returns the highest required order of the same parity.
    pub(crate) fn of_stumpff(&self, Stumpff { hyperbolic, order }: Stumpff, s: Scalar) -> u8 {
        self.stumpff.get(&(hyperbolic, s)).map_or(order, |highest| highest[usize::from(order % 2)].max(order))
    }

    /// Returns the highest required order.
    pub(crate) fn of_arc(&self, order: u8, s: Scalar, w: Scalar) -> u8 {
        self.arc.get(&(s, w)).map_or(order, |&highest| highest.max(order))
    }
}

impl Fold {
    /// 1 / a, or 0 unless a > [`Op::Tiny`].
    pub(crate) fn guarded_reciprocal(&mut self, a: Scalar) -> Scalar {
        // A constant far above `Tiny` of every number type needs no guard.
        if let Some(length) = self.constant_of(a)
            && length > 1e-18
        {
            return self.g.constant(1.0 / length);
        }
        let (one, zero) = (self.g.constant(1.0), self.g.constant(0.0));
        let reciprocal = self.g.div(one, a);
        self.where_above_tiny(a, reciprocal, zero)
    }

    fn where_above_tiny(&mut self, margin: Scalar, then: Scalar, otherwise: Scalar) -> Scalar {
        let tiny = self.g.intern_scalar(ScalarNode::Op(Op::Tiny));
        self.g.intern_scalar(ScalarNode::Op(Op::SelectLess(tiny, margin, then, otherwise)))
    }

    /// `a x + b` with constants a and b.
    fn linear(&mut self, a: f64, x: Scalar, b: f64) -> Scalar {
        let [a, b] = [a, b].map(|c| self.g.constant(c));
        let product = self.mul(a, x);
        self.add(product, b)
    }

    /// Σ cⱼ xʲ by Horner's rule.
    fn polynomial(&mut self, coefficients: &[f64], x: Scalar) -> Scalar {
        let zero = self.g.constant(0.0);
        coefficients.iter().rev().fold(zero, |sum, &c| {
            let (product, c) = (self.mul(sum, x), self.g.constant(c));
            self.add(product, c)
        })
    }

    /// A Stumpff function whose series starts from order `highest`, which is required, too.
    pub(crate) fn stumpff(&mut self, function: Stumpff, highest: u8, s: Scalar) -> Scalar {
        let closed = self.stumpff_closed(function, s);
        if function.order == 0 {
            return closed;
        }
        let margin = self.linear(1.0, s, -1.0);
        let series = self.stumpff_series(function, highest, s);
        self.where_above_tiny(margin, closed, series)
    }

    /// The closed form: c₀ and c₁ by functions, the others by cₖ₊₂ = (1/k! − cₖ)/s.
    fn stumpff_closed(&mut self, function: Stumpff, s: Scalar) -> Scalar {
        use crate::Function::{Cos, Cosh, Sin, Sinh};
        let [even, odd] = if function.hyperbolic { [Cosh, Sinh] } else { [Cos, Sin] };
        match function.order {
            0 => {
                let r = self.sqrt(s);
                self.call(even, r)
            }
            1 => {
                let r = self.sqrt(s);
                let value = self.call(odd, r);
                self.div(value, r)
            }
            order => {
                let lower = self.stumpff_closed(function.of_order(order - 2), s);
                let limit = self.g.constant(1.0 / factorial(order - 2));
                let difference = if function.hyperbolic { self.sub(lower, limit) } else { self.sub(limit, lower) };
                self.div(difference, s)
            }
        }
    }

    /// The series of the highest order, and from there down cₖ = 1/k! − s cₖ₊₂.
    fn stumpff_series(&mut self, function: Stumpff, highest: u8, s: Scalar) -> Scalar {
        let sign: f64 = if function.hyperbolic { 1.0 } else { -1.0 };
        if function.order >= highest {
            let coefficient = |j: u8| sign.powi(j.into()) / factorial(function.order + 2 * j);
            let coefficients: Vec<f64> = (0..STUMPFF_TERMS).map(coefficient).collect();
            return self.polynomial(&coefficients, s);
        }
        let higher = self.stumpff_series(function.of_order(function.order + 2), highest, s);
        let product = self.mul(s, higher);
        self.linear(sign, product, 1.0 / factorial(function.order))
    }

    /// The derivative of this order of atan2(√s, w)/√s; its series starts from order `highest`, which is required, too.
    pub(crate) fn arc(&mut self, order: u8, highest: u8, s: Scalar, w: Scalar) -> Scalar {
        let square = self.mul(w, w);
        let q = self.add(s, square);
        let reciprocal = self.guarded_reciprocal(q);
        // w tⱼ = w (−2)ʲ j!/qʲ⁺¹
        let mut terms = vec![self.mul(w, reciprocal)];
        for j in 1..=highest {
            let last = terms[usize::from(j) - 1];
            let (next, factor) = (self.mul(last, reciprocal), self.g.constant(-2.0 * f64::from(j)));
            terms.push(self.mul(factor, next));
        }
        let closed = self.arc_closed(order, s, w, &terms);
        let ratio = self.mul(s, reciprocal);
        let series = self.arc_series(order, s, ratio, &terms);
        // s/q < 1/8 is 7 s < w². For negative w the closed form is always used.
        let (zero, minus_one) = (self.g.constant(0.0), self.g.constant(-1.0));
        let bound = self.select_less(zero, w, square, minus_one);
        let seven = self.g.constant(7.0);
        let above = self.mul(seven, s);
        let margin = self.sub(above, bound);
        self.where_above_tiny(margin, closed, series)
    }

    /// The closed form: a₀ by the function, the others by s aⱼ₊₁ = w tⱼ − (2j + 1) aⱼ.
    fn arc_closed(&mut self, order: u8, s: Scalar, w: Scalar, terms: &[Scalar]) -> Scalar {
        let Some(below) = order.checked_sub(1) else {
            let r = self.sqrt(s);
            let angle = self.op(Op::Atan2(r, w));
            let reciprocal = self.guarded_reciprocal(r);
            return self.mul(angle, reciprocal);
        };
        let lower = self.arc_closed(below, s, w, terms);
        let factor = self.g.constant(2.0 * f64::from(below) + 1.0);
        let product = self.mul(factor, lower);
        let difference = self.sub(terms[usize::from(below)], product);
        let reciprocal = self.guarded_reciprocal(s);
        self.mul(difference, reciprocal)
    }

    /// The series of the highest order, w tⱼ/(2j + 1) F(1, j + 1; j + 3/2; s/q), and from there down
    /// aⱼ = (w tⱼ − s aⱼ₊₁)/(2j + 1).
    fn arc_series(&mut self, order: u8, s: Scalar, ratio: Scalar, terms: &[Scalar]) -> Scalar {
        let odd = 2.0 * f64::from(order) + 1.0;
        let term = terms[usize::from(order)];
        let over = self.g.constant(1.0 / odd);
        if usize::from(order) + 1 == terms.len() {
            let mut coefficients = vec![1.0];
            for k in 0..ARC_TERMS {
                let k = f64::from(k);
                let last = coefficients[coefficients.len() - 1];
                coefficients.push(last * (f64::from(order) + 1.0 + k) / (f64::from(order) + 1.5 + k));
            }
            let sum = self.polynomial(&coefficients, ratio);
            let product = self.mul(term, sum);
            return self.mul(over, product);
        }
        let higher = self.arc_series(order + 1, s, ratio, terms);
        let product = self.mul(s, higher);
        let difference = self.sub(term, product);
        self.mul(over, difference)
    }
}
