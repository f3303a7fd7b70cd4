//! Factoring of sums of components: `a b + a c = a (b + c)`, if neither product is used elsewhere. Also joins terms of
//! which, by the result of a comparison, one is always 0.

use crate::ir::table::Table;
use crate::lower::fold::Fold;
use crate::lower::products::OpenProducts;
use crate::lower::rebuild::{Exchange, Missing, Rebuild, Uses};
use crate::lower::sides::Join;
use crate::{Graph, Op, Scalar, ScalarNode};

/// Returns `outputs`, which must be lowered, with every sum factored.
pub(crate) fn factor(fold: &mut Fold, outputs: &[Scalar], open: OpenProducts, joins: bool) -> Vec<Scalar> {
    let uses = Uses::count(&fold.g, outputs);
    let mut factoring = Factoring { uses, open, joins, terms: Table::default() };
    let order = factoring.uses.order().to_vec();
    if !order.into_iter().any(|s| factoring.terms_to_factor(fold, s).is_some()) {
        return outputs.to_vec();
    }
    Rebuild::outputs(fold, outputs, &mut factoring)
}

/// Limit on the depth to which sums of sums are collected; deeper sums are factored in parts.
const DEEPEST: usize = 24;

/// A term of a sum, `true` if it is subtracted.
type Term = (bool, Scalar);

/// A factor of a product, `true` if it is a divisor.
type Factor = (bool, Scalar);

struct Factoring {
    uses: Uses,
    open: OpenProducts,
    /// `true` if multiples of the same number are joined.
    joins: bool,
    /// The terms of the sums that are in progress or done.
    terms: Table<Scalar, Vec<Term>>,
}

impl Exchange for Factoring {
    /// Rebuilds the sum `s` if some of its products have a common factor or some of its terms exclude each other.
    fn exchange(&mut self, rebuild: &mut Rebuild<'_>, s: Scalar) -> Result<Option<Scalar>, Missing> {
        if !self.terms.contains(s) {
            let Some(mut terms) = self.terms_to_factor(rebuild.fold, s) else { return Ok(None) };
            self.join_sides(rebuild.fold, &mut terms);
            self.terms.insert(s, terms);
        }
        match self.terms.copied(s) {
            Some(terms) => self.sum(rebuild, terms, 0).map(Some),
            None => Ok(None),
        }
    }
}

impl Factoring {
    /// Returns the terms of a sum if some have a common factor or exclude each other.
    fn terms_to_factor(&self, fold: &mut Fold, s: Scalar) -> Option<Vec<Term>> {
        if !matches!(fold.g.scalar_node(s), ScalarNode::Op(Op::Add(..) | Op::Sub(..))) {
            return None;
        }
        let mut terms = Vec::new();
        self.collect(&fold.g, s, false, 0, &mut terms);
        if cfg!(not(aim_small)) && self.open == OpenProducts::Sums {
            terms = terms.into_iter().flat_map(|term| self.spread(fold, term)).collect();
        }
        let is_shorter = cfg!(not(aim_small)) && self.joins && join_like(fold, &mut terms);
        let has_common = self.common(&fold.g, &terms).is_some();
        (is_shorter || has_common || fold.exclude_each_other(terms.iter().map(|&(_, s)| s))).then_some(terms)
    }

    /// Collects the terms of a sum, through partial sums that have no other use.
    fn collect(&self, g: &Graph, s: Scalar, negative: bool, depth: usize, terms: &mut Vec<Term>) {
        if depth > 0 && (!self.uses.once(s) || depth > DEEPEST) {
            terms.push((negative, s));
            return;
        }
        match g.scalar_node(s) {
            ScalarNode::Op(Op::Add(a, b)) => {
                self.collect(g, a, negative, depth + 1, terms);
                self.collect(g, b, negative, depth + 1, terms);
            }
            ScalarNode::Op(Op::Sub(a, b)) => {
                self.collect(g, a, negative, depth + 1, terms);
                self.collect(g, b, !negative, depth + 1, terms);
            }
            ScalarNode::Op(Op::Neg(a)) => self.collect(g, a, !negative, depth + 1, terms),
            _ => terms.push((negative, s)),
        }
    }

    /// Expands a product with a sum, neither of which has another use, into terms.
    fn spread(&self, fold: &mut Fold, (negative, s): Term) -> Vec<Term> {
        let is_sum = |s| matches!(fold.g.scalar_node(s), ScalarNode::Op(Op::Add(..) | Op::Sub(..)));
        let (sum, other) = match fold.g.scalar_node(s) {
            ScalarNode::Op(Op::Mul(a, b)) if self.uses.once(s) && is_sum(a) && self.uses.once(a) => (a, b),
            ScalarNode::Op(Op::Mul(a, b)) if self.uses.once(s) && is_sum(b) && self.uses.once(b) => (b, a),
            _ => return vec![(negative, s)],
        };
        let mut terms = Vec::new();
        self.collect(&fold.g, sum, negative, 0, &mut terms);
        terms.into_iter().map(|(negative, term)| (negative, fold.mul(other, term))).collect()
    }

    /// Returns the factors of a product or quotient that has no other use. Depending on `open`, factors that are
    /// products are split, too, and products with other uses are included.
    fn factors(&self, g: &Graph, s: Scalar) -> Vec<Factor> {
        let parts = |s: Scalar| match g.scalar_node(s) {
            ScalarNode::Op(Op::Mul(a, b)) => vec![(false, a), (false, b)],
            _ => vec![(false, s)],
        };
        let opens = self.uses.once(s) || matches!(self.open, OpenProducts::Quotients | OpenProducts::Sums);
        match g.scalar_node(s) {
            ScalarNode::Op(Op::Mul(a, b)) if opens => match self.open {
                OpenProducts::Private => vec![(false, a), (false, b)],
                _ => [a, b].into_iter().flat_map(parts).collect(),
            },
            ScalarNode::Op(Op::Div(_, b)) if cfg!(not(aim_small)) && opens => vec![(true, b)],
            _ => Vec::new(),
        }
    }

    /// Returns a product without one of its factors. Only the product that contains the factor is taken apart.
    fn cofactor(&self, fold: &mut Fold, s: Scalar, factor: Factor) -> Option<Scalar> {
        if !self.factors(&fold.g, s).contains(&factor) {
            return None;
        }
        let (_, factor) = factor;
        if cfg!(not(aim_small))
            && let ScalarNode::Op(Op::Div(a, _)) = fold.g.scalar_node(s)
        {
            return Some(a);
        }
        let ScalarNode::Op(Op::Mul(a, b)) = fold.g.scalar_node(s) else { return None };
        if a == factor || b == factor {
            return Some(if a == factor { b } else { a });
        }
        [(a, b), (b, a)].into_iter().find_map(|(product, other)| {
            let ScalarNode::Op(Op::Mul(c, d)) = fold.g.scalar_node(product) else { return None };
            let rest = [(c, d), (d, c)].into_iter().find_map(|(own, rest)| (own == factor).then_some(rest))?;
            Some(fold.mul(rest, other))
        })
    }

    /// Returns the factor shared by the most terms, the first of several; `None` if no factor is shared.
    fn common(&self, g: &Graph, terms: &[Term]) -> Option<Factor> {
        let mut counts: Vec<(Factor, usize)> = Vec::new();
        for &(_, term) in terms {
            let all = self.factors(g, term);
            for (i, &factor) in all.iter().enumerate() {
                if all[..i].contains(&factor) {
                    continue;
                }
                match counts.iter_mut().find(|(known, _)| *known == factor) {
                    Some((_, count)) => *count += 1,
                    None => counts.push((factor, 1)),
                }
            }
        }
        let most = counts.into_iter().rev().max_by_key(|&(_, count)| count);
        most.filter(|&(_, count)| count > 1).map(|(factor, _)| factor)
    }

    /// Joins terms that are 0 on opposite sides of a comparison, the best matches first.
    fn join_sides(&self, fold: &mut Fold, terms: &mut Vec<Term>) {
        for join in [Join::Complements, Join::Opposites] {
            let mut i = 0;
            while i < terms.len() {
                let joined = (i + 1..terms.len()).find_map(|j| Some((j, self.joined(fold, terms[i], terms[j], join)?)));
                match joined {
                    Some((j, sum)) => {
                        terms[i].1 = sum;
                        terms.remove(j);
                    }
                    None => i += 1,
                }
            }
        }
    }

    /// Returns the sum of two terms, up to the sign of the first.
    fn joined(&self, fold: &mut Fold, (negative, a): Term, (other_negative, b): Term, join: Join) -> Option<Scalar> {
        // A product that is used elsewhere is kept.
        let is_kept = |s| !self.uses.once(s) && matches!(fold.g.scalar_node(s), ScalarNode::Op(Op::Mul(..)));
        let join = if is_kept(a) || is_kept(b) { Join::Alike } else { join };
        fold.sum_of_sides(a, b, negative != other_negative, join)
    }

    /// Builds the sum with common factors taken out, recursively in the cofactors up to a depth limit.
    fn sum(&self, rebuild: &mut Rebuild<'_>, mut terms: Vec<Term>, depth: usize) -> Result<Scalar, Missing> {
        let mut products = Vec::new();
        while depth < DEEPEST
            && let Some(factor) = self.common(&rebuild.fold.g, &terms)
        {
            let (mut cofactors, mut without) = (Vec::new(), Vec::new());
            for (negative, term) in terms {
                match self.cofactor(rebuild.fold, term, factor) {
                    Some(rest) => cofactors.push((negative, rest)),
                    None => without.push((negative, term)),
                }
            }
            let inner = self.sum(rebuild, cofactors, depth + 1)?;
            let (below, factor) = factor;
            let factor = rebuild.scalar(factor)?;
            products.push(if below { rebuild.fold.div(inner, factor) } else { rebuild.fold.mul(factor, inner) });
            terms = without;
        }
        let terms: Result<Vec<Term>, Missing> =
            terms.into_iter().map(|(negative, s)| Ok((negative, rebuild.scalar(s)?))).collect();
        let rest = Some(terms?).filter(|terms| !terms.is_empty() || products.is_empty());
        let rest = rest.map(|terms| plain_sum(rebuild.fold, terms));
        let total = products
            .into_iter()
            .rev()
            .fold(rest, |rest, product| Some(rest.map_or(product, |rest| rebuild.fold.add(product, rest))));
        Ok(total.unwrap_or_else(|| rebuild.fold.g.constant(0.0)))
    }
}

/// Joins multiples of the same number into one term, or none if they cancel. Returns `true` if there were any.
fn join_like(fold: &mut Fold, terms: &mut Vec<Term>) -> bool {
    let before = terms.len();
    let mut i = 0;
    while i < terms.len() {
        let (c, x) = fold.multiple(terms[i].1);
        let is_like = |j: &usize| fold.g.constant_of(x).is_none() && fold.multiple(terms[*j].1).1 == x;
        let Some(j) = (i + 1..terms.len()).find(is_like) else {
            i += 1;
            continue;
        };
        let (negative, other) = terms.remove(j);
        let (d, _) = fold.multiple(other);
        let total = c + if negative == terms[i].0 { d } else { -d };
        let (size, negative) = (fold.g.constant(total.abs()), terms[i].0 != (total < 0.0));
        terms[i] = (negative, fold.mul(size, x));
        if total == 0.0 {
            terms.remove(i);
        }
    }
    terms.len() < before
}

/// Builds the sum in a canonical order of terms, so that equal sums become one node.
fn plain_sum(fold: &mut Fold, mut terms: Vec<Term>) -> Scalar {
    terms.sort_unstable_by_key(|&(_, term)| term);
    let (subtracted, added): (Vec<Term>, Vec<Term>) = terms.into_iter().partition(|&(negative, _)| negative);
    let mut total = |all: Vec<Term>| all.into_iter().map(|(_, s)| s).reduce(|a, b| fold.add(a, b));
    match (total(added), total(subtracted)) {
        (Some(a), Some(b)) => fold.sub(a, b),
        (Some(a), None) => a,
        (None, Some(b)) => fold.neg(b),
        (None, None) => fold.g.constant(0.0),
    }
}
