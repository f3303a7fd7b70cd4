//! Linear combinations with constant coefficients, written as one sum of multiples where that is shorter: what is
//! interpolated between interpolated points is a sum of four products.

use crate::ir::table::Table;
use crate::lower::fold::Fold;
use crate::lower::rebuild::{Exchange, Missing, Rebuild, operands};
use crate::lower::scales::{by_constant, combined, scalars_in_order};
use crate::{Graph, Op, Scalar, ScalarNode};

/// Limit on the number of terms of a combination; a longer sum is a term itself.
const MOST_TERMS: usize = 64;

/// Limit on how much larger rounding errors may become.
const MOST_LOSS: f64 = 4.0;

/// Terms and their coefficients, sorted by term.
type Terms = Vec<(Scalar, f64)>;

/// A sum of multiples of terms.
#[derive(Clone, Default)]
struct Combination {
    terms: Terms,
    /// Bound on the rounding error of the sum as it is stated, for terms that are almost equal to 1.
    error: f64,
    group: usize,
}

/// Combinations that have parts in common.
struct Group {
    /// The group of which this one has become a part, or itself.
    part_of: usize,
    /// The number of operations of the sums of multiples and as they are stated; the first is `None` if they would lose
    /// digits.
    costs: (Option<usize>, usize),
}

impl Group {
    fn add(&mut self, then: Option<usize>, now: usize) {
        self.costs = (self.costs.0.zip(then).map(|(a, b)| a + b), self.costs.1 + now);
    }
}

impl Combination {
    /// Returns the value for terms that are almost equal to 1.
    fn total(&self) -> f64 {
        self.terms.iter().map(|(_, k)| k).sum::<f64>().abs()
    }

    /// Returns the number of operations of the sum of multiples, with equal coefficients taken out; `None` if it loses
    /// digits or has too many terms.
    fn operations(&self) -> Option<usize> {
        let mut factors: Vec<f64> = self.terms.iter().map(|(_, k)| k.abs()).filter(|&k| k != 1.0).collect();
        let error = factors.iter().sum::<f64>() + self.total();
        factors.sort_unstable_by(f64::total_cmp);
        factors.dedup();
        let is_accurate = error <= MOST_LOSS * self.error && self.terms.len() <= MOST_TERMS;
        is_accurate.then(|| (self.terms.len() + factors.len()).saturating_sub(1))
    }
}

/// Returns the operands of a linear operation with their factors; `None` for any other operation. A sum with a constant
/// is a term, so that the constant keeps its digits.
fn linear_parts(g: &Graph, s: Scalar) -> Option<Vec<(f64, Scalar)>> {
    let parts = match g.scalar_node(s) {
        ScalarNode::Op(Op::Add(a, b)) => vec![(1.0, a), (1.0, b)],
        ScalarNode::Op(Op::Sub(a, b)) => vec![(1.0, a), (-1.0, b)],
        ScalarNode::Op(Op::Neg(a)) => vec![(-1.0, a)],
        _ => {
            let (c, a, over) = by_constant(g, s)?;
            vec![(if over { 1.0 / c } else { c }, a)]
        }
    };
    parts.iter().all(|&(_, part)| g.constant_of(part).is_none()).then_some(parts)
}

/// Returns `outputs`, which must be lowered, with combinations as sums of multiples where that is shorter; `None` if it
/// is shorter nowhere.
pub(crate) fn combine(fold: &mut Fold, outputs: &[Scalar]) -> Option<Vec<Scalar>> {
    let order = scalars_in_order(&fold.g, outputs);
    // Terms are the numbers that are used by anything but combinations.
    let mut terms = Table::default();
    let others = order.iter().filter(|s| linear_parts(&fold.g, **s).is_none());
    for s in others.flat_map(|&s| operands(fold.g.scalar_node(s))).chain(outputs.iter().copied()) {
        terms.insert(s, ());
    }
    let (mut combinations, mut groups) = (Table::<Scalar, Combination>::default(), Vec::<Group>::new());
    for &s in &order {
        let Some(parts) = linear_parts(&fold.g, s) else { continue };
        let is_step = fold.g.scalar_node(s).op().is_some_and(|op| op.is_step());
        let mut sum = Combination { group: groups.len(), ..Combination::default() };
        groups.push(Group { part_of: sum.group, costs: (Some(0), usize::from(is_step)) });
        for (k, part) in parts {
            let of_part = match combinations.copied(part) {
                Some(known) if !terms.contains(part) => {
                    let (own, other) = (sum.group, group_of(&groups, known.group));
                    if own != other {
                        let (then, now) = groups[own].costs;
                        groups[other].add(then, now);
                        (groups[own].part_of, sum.group) = (other, other);
                    }
                    known
                }
                _ => Combination { terms: vec![(part, 1.0)], ..Combination::default() },
            };
            sum.terms = combined(&sum.terms, k, &of_part.terms);
            sum.error += k.abs() * of_part.error;
        }
        sum.error += if is_step { sum.total() } else { 0.0 };
        if sum.terms.len() > MOST_TERMS || terms.contains(s) {
            terms.insert(s, ());
            groups[sum.group].add(sum.operations(), 0);
        }
        combinations.insert(s, sum);
    }
    let (mut shorter, mut found) = (Table::<Scalar, Terms>::default(), false);
    for s in order.into_iter().filter(|s| terms.contains(*s)) {
        let combination = combinations.copied(s).filter(|sum| {
            let (then, now) = groups[group_of(&groups, sum.group)].costs;
            then.is_some_and(|then| then < now)
        });
        found |= combination.is_some_and(|sum| shorter.insert(s, sum.terms));
    }
    found.then(|| Rebuild::outputs(fold, outputs, &mut shorter))
}

fn group_of(groups: &[Group], mut group: usize) -> usize {
    while groups[group].part_of != group {
        group = groups[group].part_of;
    }
    group
}

impl Exchange for Table<Scalar, Terms> {
    fn exchange(&mut self, rebuild: &mut Rebuild<'_>, s: Scalar) -> Result<Option<Scalar>, Missing> {
        let Some(terms) = self.copied(s) else { return Ok(None) };
        let mut sum = rebuild.fold.g.constant(0.0);
        for (term, factor) in terms {
            let (term, size) = (rebuild.scalar(term)?, rebuild.fold.g.constant(factor.abs()));
            let multiple = rebuild.fold.mul(size, term);
            sum = if factor < 0.0 { rebuild.fold.sub(sum, multiple) } else { rebuild.fold.add(sum, multiple) };
        }
        Ok(Some(sum))
    }
}
