//! Folding of selects: known results of comparisons, choices of signs, and sums with terms that exclude each other.

use rustc_hash::FxHashMap;

use crate::lower::fold::Fold;
use crate::lower::sides::{Join, Side};
use crate::{Op, Scalar, ScalarNode};

/// Limit on the depth to which nested selects are searched.
const DEEPEST_CHOICE: u32 = 2;

impl Fold {
    /// `then` if `a < b`, else `otherwise`. Folds if both branches are equal or the comparison is between constants.
    pub fn select_less(&mut self, a: Scalar, b: Scalar, then: Scalar, otherwise: Scalar) -> Scalar {
        if let (Some(x), Some(y)) = (self.constant_of(a), self.constant_of(b)) {
            return if x < y { then } else { otherwise };
        }
        let then = self.where_known([a, b], true, then, DEEPEST_CHOICE);
        let otherwise = self.where_known([a, b], false, otherwise, DEEPEST_CHOICE);
        if then == otherwise {
            return then;
        }
        match (self.choice(then), self.choice(otherwise)) {
            // If a second comparison selects the same value in both branches, it becomes the outer one.
            (Some(([c, d], [p, r])), Some((same, [q, s]))) if [c, d] == same && (p == q || r == s) => {
                let (p, r) = (self.select_less(a, b, p, q), self.select_less(a, b, r, s));
                self.select_less(c, d, p, r)
            }
            _ => self.g.select_less(a, b, then, otherwise),
        }
    }

    /// Simplifies `s`, given the result of a comparison.
    fn where_known(&mut self, compared: [Scalar; 2], holds: bool, s: Scalar, depth: u32) -> Scalar {
        let Some(([a, b], [then, otherwise])) = self.choice(s) else { return s };
        if [a, b] == compared {
            return if holds { then } else { otherwise };
        }
        let Some(depth) = depth.checked_sub(1) else { return s };
        let known = [then, otherwise].map(|branch| self.where_known(compared, holds, branch, depth));
        if known == [then, otherwise] { s } else { self.select_less(a, b, known[0], known[1]) }
    }

    /// Returns the operands of the comparison and the branches of a select.
    fn choice(&self, s: Scalar) -> Option<([Scalar; 2], [Scalar; 2])> {
        match self.g.scalar_node(s) {
            ScalarNode::Op(Op::SelectLess(a, b, then, otherwise)) => Some(([a, b], [then, otherwise])),
            _ => None,
        }
    }

    /// A select of −1, 0 and 1, times `b`, becomes a select of −b, 0 and b.
    pub(crate) fn chosen(&mut self, choice: Scalar, b: Scalar) -> Option<Scalar> {
        let ([x, y], factors) = self.choice(choice)?;
        if !self.is_sign(choice, DEEPEST_CHOICE) {
            return None;
        }
        let [then, otherwise] = factors.map(|factor| self.mul(factor, b));
        Some(self.select_less(x, y, then, otherwise))
    }

    /// Returns `true` if `s` is a select of −1, 0 and 1.
    fn is_sign(&self, s: Scalar, depth: u32) -> bool {
        match (self.constant_of(s), self.choice(s)) {
            (Some(c), _) => c == 0.0 || c.abs() == 1.0,
            (None, Some((_, branches))) => depth > 0 && branches.into_iter().all(|s| self.is_sign(s, depth - 1)),
            (None, None) => false,
        }
    }

    /// Collects the comparisons on one side of which `s` is 0, each with the result for which it is not, and the value
    /// in that case.
    fn masks(&mut self, s: Scalar, depth: u32, found: &mut Vec<Side>) {
        let Some((compared, [then, otherwise])) = self.choice(s) else { return };
        let zero = self.g.constant(0.0);
        let (holds, base) = match (then == zero, otherwise == zero) {
            (false, true) => (true, then),
            (true, false) => (false, otherwise),
            _ => return,
        };
        found.push(Side { compared, holds, base, factor: None });
        if depth < DEEPEST_CHOICE {
            let first = found.len();
            self.masks(base, depth + 1, found);
            for inner in &mut found[first..] {
                inner.base = self.g.where_less(compared[0], compared[1], holds, inner.base);
            }
        }
    }

    /// Collects the comparisons on one side of which a term is 0; the term may be a product with a select.
    fn sides(&mut self, term: Scalar) -> Vec<Side> {
        let mut found = Vec::new();
        match self.g.scalar_node(term) {
            ScalarNode::Op(Op::Mul(a, b)) => {
                for (mask, factor) in [(a, b), (b, a)] {
                    let first = found.len();
                    self.masks(mask, 0, &mut found);
                    found[first..].iter_mut().for_each(|side| side.factor = Some(factor));
                }
            }
            _ => self.masks(term, 0, &mut found),
        }
        found
    }

    /// Returns `true` if two of the terms are 0 on opposite sides of a comparison.
    pub(crate) fn exclude_each_other(&mut self, terms: impl Iterator<Item = Scalar>) -> bool {
        let mut seen: FxHashMap<[Scalar; 2], bool> = FxHashMap::default();
        let mut sides = terms.flat_map(|term| self.sides(term));
        sides.any(|side| *seen.entry(side.compared).or_insert(side.holds) != side.holds)
    }

    /// Returns the sum or difference of two terms that are 0 on opposite sides of a comparison, as one select.
    pub(crate) fn sum_of_sides(&mut self, a: Scalar, b: Scalar, negative: bool, join: Join) -> Option<Scalar> {
        let (first, second) = (self.sides(a), self.sides(b));
        let (x, y) = join.of(&first, &second)?;
        let one = self.g.constant(1.0);
        let [p, q] = [x, y].map(|side| side.factor.unwrap_or(one));
        let (common, sides) =
            if x.base == y.base { (x.base, [p, q]) } else { (one, [self.mul(x.base, p), self.mul(y.base, q)]) };
        let sides = if negative { [sides[0], self.neg(sides[1])] } else { sides };
        let [then, otherwise] = if x.holds { sides } else { [sides[1], sides[0]] };
        let chosen = self.select_less(x.compared[0], x.compared[1], then, otherwise);
        Some(self.mul(common, chosen))
    }
}
