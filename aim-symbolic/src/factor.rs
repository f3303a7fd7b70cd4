//! Sum factoring on components: `a b + a c = a (b + c)`, where neither product is needed elsewhere.

use std::collections::HashMap;

use crate::fold::Fold;
use crate::{Scalar, ScalarNode};

/// The rule's name.
pub(crate) const FACTOR: &str = "common factor of products";

/// `outputs`, which are lowered, with every sum factored.
pub(crate) fn factor(fold: &mut Fold<'_>, outputs: &[Scalar]) -> Vec<Scalar> {
    let uses = uses(fold, outputs);
    let mut factoring = Factoring { fold, uses, done: HashMap::new() };
    outputs.iter().map(|&s| factoring.scalar(s)).collect()
}

/// How often each scalar is used, by others and as an output.
fn uses(fold: &Fold<'_>, outputs: &[Scalar]) -> HashMap<Scalar, usize> {
    let mut uses: HashMap<Scalar, usize> = HashMap::new();
    let mut stack: Vec<Scalar> = outputs.to_vec();
    while let Some(s) = stack.pop() {
        let count = uses.entry(s).or_default();
        *count += 1;
        if *count == 1 {
            stack.extend(operands(fold.g.scalar_node(s)));
        }
    }
    uses
}

fn operands(node: ScalarNode) -> impl Iterator<Item = Scalar> {
    let parts = match node {
        ScalarNode::Add(a, b)
        | ScalarNode::Sub(a, b)
        | ScalarNode::Mul(a, b)
        | ScalarNode::Div(a, b)
        | ScalarNode::Atan2(a, b) => [Some(a), Some(b), None, None],
        ScalarNode::Neg(a) | ScalarNode::Sqrt(a) | ScalarNode::Reciprocal(a) | ScalarNode::Call(_, a) => {
            [Some(a), None, None, None]
        }
        ScalarNode::SelectLess(a, b, c, d) => [Some(a), Some(b), Some(c), Some(d)],
        _ => [None; 4],
    };
    parts.into_iter().flatten()
}

/// A term of a sum and whether it is subtracted.
type Term = (bool, Scalar);

struct Factoring<'f, 'g> {
    fold: &'f mut Fold<'g>,
    uses: HashMap<Scalar, usize>,
    done: HashMap<Scalar, Scalar>,
}

impl Factoring<'_, '_> {
    fn scalar(&mut self, s: Scalar) -> Scalar {
        if let Some(&done) = self.done.get(&s) {
            return done;
        }
        let factored = match self.fold.g.scalar_node(s) {
            ScalarNode::Add(a, b) => self.sum_of(s).unwrap_or_else(|| {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.fold.add(a, b)
            }),
            ScalarNode::Sub(a, b) => self.sum_of(s).unwrap_or_else(|| {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.fold.sub(a, b)
            }),
            ScalarNode::Mul(a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.fold.mul(a, b)
            }
            ScalarNode::Div(a, b) => {
                let (a, b) = (self.scalar(a), self.scalar(b));
                self.fold.div(a, b)
            }
            ScalarNode::Neg(a) => {
                let a = self.scalar(a);
                self.fold.neg(a)
            }
            ScalarNode::Sqrt(a) => {
                let a = self.scalar(a);
                self.fold.sqrt(a)
            }
            ScalarNode::Call(function, a) => {
                let a = self.scalar(a);
                self.fold.call(function, a)
            }
            ScalarNode::Atan2(y, x) => {
                let (y, x) = (self.scalar(y), self.scalar(x));
                self.fold.g.atan2(y, x)
            }
            ScalarNode::SelectLess(a, b, then, otherwise) => {
                let [a, b, then, otherwise] = [a, b, then, otherwise].map(|s| self.scalar(s));
                self.fold.select_less(a, b, then, otherwise)
            }
            _ => s,
        };
        self.done.insert(s, factored);
        factored
    }

    /// The sum `s` where some of its products have a common factor.
    fn sum_of(&mut self, s: Scalar) -> Option<Scalar> {
        let mut terms = Vec::new();
        self.collect(s, false, true, &mut terms);
        self.common(&terms)?;
        Some(self.sum(terms))
    }

    /// The terms of a sum, through partial sums that nothing else needs.
    fn collect(&self, s: Scalar, negative: bool, root: bool, terms: &mut Vec<Term>) {
        if !root && self.uses.get(&s).is_some_and(|&uses| uses > 1) {
            terms.push((negative, s));
            return;
        }
        match self.fold.g.scalar_node(s) {
            ScalarNode::Add(a, b) => {
                self.collect(a, negative, false, terms);
                self.collect(b, negative, false, terms);
            }
            ScalarNode::Sub(a, b) => {
                self.collect(a, negative, false, terms);
                self.collect(b, !negative, false, terms);
            }
            ScalarNode::Neg(a) => self.collect(a, !negative, false, terms),
            _ => terms.push((negative, s)),
        }
    }

    /// The factors of a product that nothing else needs.
    fn factors(&self, s: Scalar) -> Option<(Scalar, Scalar)> {
        let once = self.uses.get(&s).is_none_or(|&uses| uses == 1);
        match self.fold.g.scalar_node(s) {
            ScalarNode::Mul(a, b) if once => Some((a, b)),
            _ => None,
        }
    }

    fn has_factor(&self, s: Scalar, factor: Scalar) -> bool {
        self.factors(s).is_some_and(|(a, b)| a == factor || b == factor)
    }

    /// The factor that most of the terms have; the first of several, `None` where each has its own.
    fn common(&self, terms: &[Term]) -> Option<Scalar> {
        let mut best: Option<(usize, Scalar)> = None;
        for &(_, term) in terms {
            let Some((a, b)) = self.factors(term) else { continue };
            for factor in [a, b] {
                let count = terms.iter().filter(|(_, t)| self.has_factor(*t, factor)).count();
                if count > best.map_or(1, |(most, _)| most) {
                    best = Some((count, factor));
                }
            }
        }
        best.map(|(_, factor)| factor)
    }

    fn sum(&mut self, terms: Vec<Term>) -> Scalar {
        let Some(factor) = self.common(&terms) else {
            let terms = terms.into_iter().map(|(negative, s)| (negative, self.scalar(s))).collect();
            return self.plain_sum(terms);
        };
        let (with, without): (Vec<Term>, Vec<Term>) = terms.into_iter().partition(|&(_, t)| self.has_factor(t, factor));
        let cofactors = with
            .into_iter()
            .map(|(negative, term)| match self.factors(term) {
                Some((a, b)) if a == factor => (negative, b),
                Some((a, _)) => (negative, a),
                None => unreachable!("only products have a factor"),
            })
            .collect();
        let inner = self.sum(cofactors);
        let factor = self.scalar(factor);
        let product = self.fold.mul(factor, inner);
        if without.is_empty() {
            return product;
        }
        let rest = self.sum(without);
        self.fold.add(product, rest)
    }

    fn plain_sum(&mut self, terms: Vec<Term>) -> Scalar {
        let (subtracted, added): (Vec<Term>, Vec<Term>) = terms.into_iter().partition(|&(negative, _)| negative);
        let total = |all: Vec<Term>, fold: &mut Fold<'_>| all.into_iter().map(|(_, s)| s).reduce(|a, b| fold.add(a, b));
        let (added, subtracted) = (total(added, self.fold), total(subtracted, self.fold));
        match (added, subtracted) {
            (Some(a), Some(b)) => self.fold.sub(a, b),
            (Some(a), None) => a,
            (None, Some(b)) => self.fold.neg(b),
            (None, None) => self.fold.g.constant(0.0),
        }
    }
}
