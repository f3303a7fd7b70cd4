//! Lengths as factors of products, by which functions vanish.

use super::product::Product;
use crate::{Graph, Op, Scalar, ScalarNode};

/// A product of factors and a length. The length is a norm, a root, or a number of any sign.
#[derive(Clone)]
pub(super) struct Length {
    pub(super) coefficient: f64,
    /// Other factors and their powers in halves.
    pub(super) others: Vec<(Scalar, i32)>,
    pub(super) base: Scalar,
    /// 1 if the length is the root of the base, 2 if it is the base itself, 4 if it is its square.
    pub(super) halves: i32,
}

impl Length {
    /// Returns the base, or its root, without other factors.
    pub(super) fn plain(base: Scalar, halves: i32) -> Self {
        Self { coefficient: 1.0, others: Vec::new(), base, halves }
    }

    /// Splits off one of the `divisors` if it is a factor of `s`; else splits `s` into a constant and the rest.
    pub(super) fn of(g: &mut Graph, s: Scalar, divisors: &[Scalar]) -> Option<Self> {
        Self::of_power(g, s, divisors, &[1, 2]).or_else(|| Self::of_constant(g, s))
    }

    /// Splits off one of the `divisors` if `s` has one of these powers of it, in halves.
    pub(super) fn of_power(g: &mut Graph, s: Scalar, divisors: &[Scalar], powers: &[i32]) -> Option<Self> {
        let mut product = Product::of(g, s)?;
        let &base = divisors.iter().find(|&&base| base != s && powers.contains(&product.power_of(base)))?;
        let halves = product.remove(base);
        Some(Self { coefficient: product.coefficient, others: product.powers, base, halves })
    }

    /// Returns the same length by one of the factors of its base, if that is a product.
    pub(super) fn of_product(g: &mut Graph, length: &Self) -> Option<Self> {
        let mut product =
            Product::of(g, length.base).filter(|_| length.others.is_empty() && length.coefficient == 1.0)?;
        let &(base, halves) = product.powers.iter().find(|&&(factor, halves)| factor != length.base && halves > 0)?;
        product.remove(base);
        let coefficient = if length.halves == 1 { product.coefficient.sqrt() } else { product.coefficient };
        let part = |halves: i32| halves * length.halves / 2;
        let is_whole = |halves: i32| halves * length.halves % 2 == 0;
        let is_found = product.coefficient > 0.0
            && [2, 4].contains(&halves)
            && product.powers.iter().all(|&(_, halves)| is_whole(halves));
        let others = product.powers.iter().map(|&(factor, halves)| (factor, part(halves))).collect();
        is_found.then_some(Self { coefficient, others, base, halves: part(halves) })
    }

    fn of_constant(g: &mut Graph, mut s: Scalar) -> Option<Self> {
        let mut coefficient = 1.0;
        let (base, halves) = loop {
            match g.scalar_node(s) {
                ScalarNode::Op(Op::Constant(_)) => return None,
                ScalarNode::Op(Op::Neg(a)) => (coefficient, s) = (-coefficient, a),
                ScalarNode::Op(Op::Mul(a, b)) => match (g.constant_of(a), g.constant_of(b)) {
                    (Some(c), _) => (coefficient, s) = (coefficient * c, b),
                    (_, Some(c)) => (coefficient, s) = (coefficient * c, a),
                    _ => break (s, 2),
                },
                ScalarNode::Op(Op::Div(a, b)) if g.constant_of(b).is_some() => {
                    (coefficient, s) = (coefficient / g.constant_of(b)?, a);
                }
                ScalarNode::Norm(v) => break (g.dot(v, v), 1),
                ScalarNode::Op(Op::Sqrt(base)) => break (base, 1),
                _ => break (s, 2),
            }
        };
        Some(Self { coefficient, ..Self::plain(base, halves) })
    }

    pub(super) fn square(&self, g: &mut Graph) -> Scalar {
        let mut square = self.base;
        (1..self.halves).for_each(|_| square = g.mul(square, self.base));
        if self.coefficient.abs() != 1.0 {
            let factor = g.constant(self.coefficient * self.coefficient);
            square = g.mul(factor, square);
        }
        let mut others = Product::new();
        self.others.iter().for_each(|&(factor, power)| others.power(factor, 2 * power));
        match others.stated(g) {
            Some(factor) => g.mul(factor, square),
            None => square,
        }
    }
}
