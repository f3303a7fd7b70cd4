//! Decides conditions by those that hold on the current branch, and by [`Extents`], the ranges of whole numbers. This
//! ends the unrolling of loops and of functions that call themselves until a number passes a bound.

use std::collections::HashMap;

use aim_symbolic::{Function, Op, Scalar, ScalarNode};

use super::algebra::Algebra;
use super::bounds::Bound;
use super::condition::{Condition, DEEPEST};

/// Smallest and largest possible value of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    pub(super) least: f64,
    pub(super) most: f64,
    /// `true` if it is certainly whole.
    pub(super) is_whole: bool,
}

impl Extent {
    const UNKNOWN: Self = Self { least: f64::NEG_INFINITY, most: f64::INFINITY, is_whole: false };

    /// Returns the extent of a sum or product of whole numbers, which are not rounded; unknown for other numbers.
    fn made(self, other: Self, ends: impl Fn(f64, f64) -> f64) -> Self {
        if !self.is_whole || !other.is_whole {
            return Self::UNKNOWN;
        }
        let pairs =
            [(self.least, other.least), (self.least, other.most), (self.most, other.least), (self.most, other.most)];
        let ends = pairs.map(|(x, y)| ends(x, y));
        // 0 · ∞.
        if ends.iter().any(|end| end.is_nan()) {
            return Self { is_whole: true, ..Self::UNKNOWN };
        }
        let [least, most] = [f64::min, f64::max].map(|of| ends.into_iter().reduce(of).unwrap_or(f64::NAN));
        Self { least, most, is_whole: true }
    }

    /// Returns the extent of a sum or a product. It is not negative if neither operand is, however it is rounded.
    fn sum_or_product(self, other: Self, ends: impl Fn(f64, f64) -> f64) -> Self {
        let made = self.made(other, ends);
        if self.least >= 0.0 && other.least >= 0.0 { made.at_least(0.0) } else { made }
    }

    fn at_most(self, most: f64) -> Self {
        Self { most: self.most.min(most), ..self }
    }

    fn at_least(self, least: f64) -> Self {
        Self { least: self.least.max(least), ..self }
    }

    /// Narrows the extent to a bound.
    fn within(self, bound: Bound) -> Self {
        let Bound { above, at, strict, .. } = bound;
        match (above, strict && self.is_whole) {
            (true, true) => self.at_least(at.floor() + 1.0),
            (true, false) => self.at_least(at),
            (false, true) => self.at_most(at.ceil() - 1.0),
            (false, false) => self.at_most(at),
        }
    }
}

/// Extents of numbers where the given conditions hold.
pub(super) struct Extents<'a> {
    a: &'a Algebra,
    bounds: Vec<Bound>,
    known: HashMap<Scalar, Extent>,
}

/// Maximum number of parts of a number that are examined.
const MOST_PARTS: usize = 256;

impl<'a> Extents<'a> {
    pub(super) fn new<'f>(a: &'a Algebra, facts: impl IntoIterator<Item = &'f Condition>) -> Self {
        let bounds = facts.into_iter().filter_map(|fact| Bound::of(a, fact)).collect();
        Self { a, bounds, known: HashMap::new() }
    }

    /// Decides a comparison that has the same result for all values of its sides.
    pub(super) fn decide(&mut self, condition: &Condition) -> Option<bool> {
        match condition {
            Condition::Less(x, y) => {
                let (x, y) = (self.of(*x), self.of(*y));
                if x.most < y.least { Some(true) } else { (x.least >= y.most).then_some(false) }
            }
            Condition::Not(inner) => self.decide(inner).map(|holds| !holds),
            _ => None,
        }
    }

    pub(super) fn of(&mut self, x: Scalar) -> Extent {
        if let Some(known) = self.known.get(&x) {
            return *known;
        }
        if self.known.len() == MOST_PARTS {
            return Extent::UNKNOWN;
        }
        self.known.insert(x, Extent::UNKNOWN);
        let extent = self.of_node(x);
        let extent =
            self.bounds.iter().filter(|bound| bound.x == x).fold(extent, |extent, bound| extent.within(*bound));
        self.known.insert(x, extent);
        extent
    }

    fn of_node(&mut self, x: Scalar) -> Extent {
        let ScalarNode::Op(op) = self.a.g.scalar_node(x) else { return Extent::UNKNOWN };
        match op {
            Op::Constant(constant) => {
                let value = constant.value();
                Extent { least: value, most: value, is_whole: value.fract() == 0.0 }
            }
            Op::Input(_) => match self.a.extent_of_input(x) {
                Some((least, most)) => Extent { least, most, is_whole: true },
                None => Extent::UNKNOWN,
            },
            Op::Neg(inner) => {
                let inner = self.of(inner);
                Extent { least: -inner.most, most: -inner.least, ..inner }
            }
            Op::Add(one, other) => self.of(one).sum_or_product(self.of(other), |x, y| x + y),
            Op::Sub(one, other) => self.of(one).made(self.of(other), |x, y| x - y),
            Op::Mul(one, other) => self.of(one).sum_or_product(self.of(other), |x, y| x * y),
            Op::Div(one, divisor) => {
                let (one, divisor) = (self.of(one), self.of(divisor));
                match divisor.least == divisor.most && divisor.least > 0.0 {
                    true => {
                        Extent { least: one.least / divisor.least, most: one.most / divisor.least, is_whole: false }
                    }
                    false => Extent::UNKNOWN,
                }
            }
            Op::Call(Function::Floor, inner) => {
                let inner = self.of(inner);
                Extent { least: inner.least.floor(), most: inner.most.floor(), is_whole: true }
            }
            Op::SelectLess(less, more, then, otherwise) => {
                let (below, above) = (self.of(less), self.of(more));
                let (mut one, mut other) = (self.of(then), self.of(otherwise));
                if below.least >= above.most {
                    return other;
                }
                if self.a.g.scalar_node(then) == ScalarNode::Op(Op::Neg(less)) {
                    one = one.at_least(-above.most);
                }
                if then == less {
                    one = one.at_most(above.most);
                }
                if then == more {
                    one = one.at_least(below.least);
                }
                if otherwise == more {
                    other = other.at_most(below.most);
                }
                if otherwise == less {
                    other = other.at_least(above.least);
                }
                let (least, most) = (one.least.min(other.least), one.most.max(other.most));
                Extent { least, most, is_whole: one.is_whole && other.is_whole }
            }
            _ => Extent::UNKNOWN,
        }
    }
}

/// Simplifies a condition by `facts`, conditions that hold: decides it, or removes the decided parts of a combination.
pub(super) fn decided<'a>(
    a: &Algebra,
    condition: Condition,
    facts: impl IntoIterator<Item = &'a Condition> + Clone,
) -> Condition {
    decided_within(a, condition, &facts, DEEPEST)
}

fn decided_within<'a>(
    a: &Algebra,
    condition: Condition,
    facts: &(impl IntoIterator<Item = &'a Condition> + Clone),
    depth: usize,
) -> Condition {
    if let (Some((one, other)), 1..) = (condition.parts(), depth) {
        let [one, other] = [one, other].map(|part| decided_within(a, part, facts, depth - 1));
        if ![&one, &other].into_iter().any(|part| matches!(part, Condition::Known(_))) {
            return condition;
        }
        return if matches!(condition, Condition::And(_)) { one.and(other) } else { one.or(other) };
    }
    if let Condition::Not(inner) = &condition
        && inner.parts().is_some()
    {
        return decided_within(a, (**inner).clone(), facts, depth).not();
    }
    let known = Bound::of(a, &condition).and_then(|bound| {
        let decide = |fact| Bound::of(a, fact)?.decides(bound);
        facts.clone().into_iter().find_map(decide)
    });
    known.or_else(|| Extents::new(a, facts.clone()).decide(&condition)).map_or(condition, Condition::Known)
}
