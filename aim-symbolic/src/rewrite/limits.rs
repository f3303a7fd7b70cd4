//! Rules for products that are 0 / 0 somewhere but have a limit there. Part of
//! [`LIMITS`](crate::rewrite::rules::LIMITS).
//!
//! A product is split into powers of its factors, counted in halves, so that |v| is a half power of v · v. A function
//! that vanishes like a power of a length r, such as sin r or 1 − cos r, is that power times a
//! [smooth](crate::ir::smooth) function of r²; so is a sum in which every term vanishes like that. If powers of a
//! factor cancel between numerator and denominator and none remains in the denominator, the product is restated without
//! them: it no longer divides by something that can be 0, and its derivatives are right there, too.

use rustc_hash::FxHashSet;

use super::product::{Product, terms};
use super::vanishing::{Quotients, Vanishing};
use crate::{Graph, Op, Scalar, ScalarNode, Vector, VectorNode};

/// `a b / a = b`, also where a is 0, and `sin r / r`, which becomes a series near 0.
pub(crate) fn cancelled_division(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    if !matches!(g.scalar_node(s), ScalarNode::Op(Op::Mul(..) | Op::Div(..)) | ScalarNode::Dot(..)) {
        return None;
    }
    let (product, ()) = cancelled(g, |g, product, whole| product.times(g, s, 2, whole))?;
    let stated = product.stated(g);
    Some(stated.unwrap_or_else(|| g.constant(1.0)))
}

/// Cancels the factors of a vector: `|v| (v / |v|) = v`.
pub(crate) fn cancelled_scale(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Scale(..) = g.vector_node(v) else { return None };
    let (product, rest) = cancelled(g, |g, product, whole| product.times_vector(g, v, whole))?;
    Some(match product.stated(g) {
        Some(factor) => g.scale(factor, rest),
        None => rest,
    })
}

/// Returns the product that `collect` accumulates and the part that it leaves, if anything in the product cancels.
fn cancelled<R: Copy>(
    g: &mut Graph,
    collect: impl Fn(&mut Graph, &mut Product, &[Scalar]) -> Option<R>,
) -> Option<(Product, R)> {
    let mut all = Product::new();
    let rest_of_all = collect(g, &mut all, &[])?;
    let divisors = all.divisors(g);
    if divisors.is_empty() {
        return None;
    }
    for (round, find) in [Vanishing::of, Vanishing::of_any].into_iter().enumerate() {
        let vanishing = all.vanishing(g, &divisors, find);
        if round > 0 && vanishing.is_empty() {
            break;
        }
        // The argument of a function may itself be a product, which must then not be taken apart.
        let whole: Vec<Scalar> = vanishing.iter().map(|(_, found)| found.base()).collect();
        let (mut product, mut rest) = (all.clone(), rest_of_all);
        if !whole.is_empty() {
            product = Product::new();
            rest = collect(g, &mut product, &whole)?;
        }
        if product.cancel(g, &vanishing)? {
            return Some((product, rest));
        }
    }
    None
}

impl Product {
    /// Returns the denominators, also those within sums, followed by the factors with which they may vanish, each once.
    /// Empty if there are no denominators.
    fn divisors(&self, g: &mut Graph) -> Vec<Scalar> {
        let mut divisors = self.below.clone();
        for &factor in &self.above {
            for term in terms(g, factor).into_iter().filter(|&term| term != factor) {
                divisors.extend(Self::of(g, term).map_or(Vec::new(), |product| product.below));
            }
        }
        if !divisors.is_empty() {
            divisors.extend(&self.above);
            divisors.extend(self.powers.iter().filter_map(|&(factor, _)| Vanishing::base_of_function(g, factor)));
        }
        let mut known = FxHashSet::default();
        divisors.retain(|&divisor| known.insert(divisor) && !g.is_never_zero(divisor));
        divisors
    }

    /// Returns the factors that vanish with a length or with one of the divisors.
    fn vanishing(
        &self,
        g: &mut Graph,
        divisors: &[Scalar],
        find: impl Fn(&mut Graph, Scalar, &[Scalar]) -> Vec<Vanishing>,
    ) -> Vec<(Scalar, Vanishing)> {
        let mut all = Vec::new();
        for &(factor, _) in &self.powers {
            let found = find(g, factor, divisors).into_iter().filter(|found| found.is_free_in(g, self, factor));
            all.extend(found.map(|found| (factor, found)));
        }
        all
    }

    /// Cancels powers that appear in both numerator and denominator. Returns `false` if there are none, `None` if the
    /// product becomes too long.
    fn cancel(&mut self, g: &mut Graph, vanishing: &[(Scalar, Vanishing)]) -> Option<bool> {
        let mut bases: Vec<Scalar> = Vec::new();
        for base in self.powers.iter().map(|&(s, _)| s).chain(vanishing.iter().map(|(_, found)| found.base())) {
            if !bases.contains(&base) {
                bases.push(base);
            }
        }
        let mut any = false;
        for base in bases {
            let functions: Vec<&(Scalar, Vanishing)> =
                vanishing.iter().filter(|(_, found)| found.base() == base).collect();
            // A function of negative order is infinite at 0 and counts for the opposite side.
            let sides = [&self.above, &self.below];
            let functions_in = |side: usize| {
                functions.iter().any(|(s, found)| sides[if found.halves() < 0 { 1 - side } else { side }].contains(s))
            };
            let is_in = |side: usize| sides[side].contains(&base) || functions_in(side);
            let halves: i32 = functions.iter().map(|(s, found)| found.halves() * self.power_of(*s) / 2).sum();
            if !is_in(0) || !is_in(1) || self.power_of(base) + halves < 0 {
                continue;
            }
            any = true;
            let by_itself = self.above.contains(&base) && self.power_of(base) >= 0;
            if by_itself && !functions_in(1) {
                continue;
            }
            let mut quotients = Quotients::by(base);
            for (s, found) in functions {
                found.take_out(g, self, *s, &mut quotients)?;
            }
        }
        Some(any)
    }
}
