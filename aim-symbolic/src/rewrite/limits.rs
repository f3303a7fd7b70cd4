//! Rules for products that are 0 / 0 somewhere and have a limit there. Part of [`LIMITS`](crate::rewrite::rules::LIMITS).
//!
//! A product is taken apart into powers of its factors, in halves, so that |v| is half a power of v · v. Functions that
//! vanish like a power of a length r, such as sin r or 1 − cos r, are that power times a [smooth](crate::ir::smooth) function
//! of r²; so are sums of which every term is. Where powers of one factor above and below the line meet and none is left below,
//! the product is stated without them: nothing is divided by what could be 0, and its derivatives are right there, too.

use rustc_hash::FxHashSet;

use super::product::{Product, terms};
use super::vanishing::Vanishing;
use crate::{Graph, Op, Scalar, ScalarNode, Vector, VectorNode};

/// `a b / a = b`, also where a is 0, and `sin r / r`, a series there.
pub(crate) fn cancelled_division(g: &mut Graph, s: Scalar) -> Option<Scalar> {
    if !matches!(g.scalar_node(s), ScalarNode::Op(Op::Mul(..) | Op::Div(..)) | ScalarNode::Dot(..)) {
        return None;
    }
    let (product, ()) = cancelled(g, |g, product, whole| product.times(g, s, 2, whole))?;
    let stated = product.stated(g);
    Some(stated.unwrap_or_else(|| g.constant(1.0)))
}

/// The same of a vector's factors: `|v| (v / |v|) = v`.
pub(crate) fn cancelled_scale(g: &mut Graph, v: Vector) -> Option<Vector> {
    let VectorNode::Scale(..) = g.vector_node(v) else { return None };
    let (product, rest) = cancelled(g, |g, product, whole| product.times_vector(g, v, whole))?;
    Some(match product.stated(g) {
        Some(factor) => g.scale(factor, rest),
        None => rest,
    })
}

/// The product that `collect` multiplies together, if something of it cancels, with what `collect` leaves.
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
        // The argument of a function may be a product itself.
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
    /// What is divided by, also within sums, and then what that may vanish with, each once; nothing where nothing is divided by.
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

    /// The factors that vanish with a length, or with what is divided by.
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

    /// Takes away what is above and below the line; false where nothing is, `None` where that is too long.
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
            // Where a function is infinite, it is on the other side of the line.
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
            for (s, found) in functions {
                found.take_out(g, self, *s)?;
            }
        }
        Some(any)
    }
}
