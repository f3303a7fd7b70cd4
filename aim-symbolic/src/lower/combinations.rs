//! Linear combinations with constant coefficients, written as one sum of multiples where that is shorter: what is
//! interpolated between interpolated points is a sum of four products.

use crate::ir::node::Node;
use crate::ir::table::Table;
use crate::lower::fold::Fold;
use crate::lower::rebuild::{Exchange, Missing, Rebuild, operands};
use crate::{Graph, Op, Scalar, ScalarNode};

/// Limit on the number of terms of a combination; a longer sum is a term itself.
const MOST_TERMS: usize = 64;

/// Limit on how much larger rounding errors may become.
const MOST_LOSS: f64 = 4.0;

/// A sum of multiples of terms.
#[derive(Clone, Default)]
struct Combination {
    /// Terms and their coefficients, sorted by term.
    terms: Vec<(Scalar, f64)>,
    /// Bound on the rounding error of the sum as it is stated, for terms that are almost equal to 1.
    error: f64,
    /// The group of sums that have parts in common.
    group: usize,
}

impl Combination {
    /// Returns `a + k b` with the error of computing it.
    fn plus(&self, k: f64, other: &Self) -> Self {
        let mut terms = self.terms.clone();
        for &(term, factor) in &other.terms {
            match terms.binary_search_by_key(&term, |&(known, _)| known) {
                Ok(place) => terms[place].1 += k * factor,
                Err(place) => terms.insert(place, (term, k * factor)),
            }
        }
        terms.retain(|&(_, factor)| factor != 0.0);
        let mut sum = Self { terms, error: self.error + k.abs() * other.error, group: self.group };
        sum.error += sum.total();
        sum
    }

    /// Returns the value for terms that are almost equal to 1.
    fn total(&self) -> f64 {
        self.terms.iter().map(|(_, factor)| factor).sum::<f64>().abs()
    }

    /// Returns the number of operations of the sum of multiples, with equal coefficients taken out.
    fn operations(&self) -> usize {
        let mut factors: Vec<f64> = self.terms.iter().map(|(_, factor)| factor.abs()).filter(|&k| k != 1.0).collect();
        factors.sort_unstable_by(f64::total_cmp);
        factors.dedup();
        (self.terms.len() + factors.len()).saturating_sub(1)
    }

    fn keeps_digits(&self) -> bool {
        let products: f64 = self.terms.iter().map(|(_, factor)| factor.abs()).filter(|&k| k != 1.0).sum();
        products + self.total() <= MOST_LOSS * self.error
    }
}

/// Returns the operands of a linear operation with their factors; `None` for any other operation. Sums with a constant
/// are kept as they are, so that it keeps its digits.
fn linear_parts(g: &Graph, s: Scalar) -> Option<Vec<(f64, Scalar)>> {
    let constant = |s| g.constant_of(s);
    let ScalarNode::Op(op) = g.scalar_node(s) else { return None };
    let parts = match op {
        Op::Add(a, b) => vec![(1.0, a), (1.0, b)],
        Op::Sub(a, b) => vec![(1.0, a), (-1.0, b)],
        Op::Neg(a) => vec![(-1.0, a)],
        Op::Mul(a, b) => match (constant(a), constant(b)) {
            (Some(c), None) => vec![(c, b)],
            (None, Some(c)) => vec![(c, a)],
            _ => return None,
        },
        _ => return None,
    };
    parts.iter().all(|&(_, part)| constant(part).is_none()).then_some(parts)
}

/// Returns `outputs`, which must be lowered, with combinations as sums of multiples where that is shorter; `None` if it
/// is shorter nowhere.
pub(crate) fn combine(fold: &mut Fold, outputs: &[Scalar]) -> Option<Vec<Scalar>> {
    let scalar = |node| if let Node::Scalar(s) = node { Some(s) } else { None };
    let order: Vec<Scalar> = fold.g.order(outputs).into_iter().filter_map(scalar).collect();
    // Terms are the numbers that anything but a combination uses.
    let mut terms = Table::default();
    for &s in outputs {
        terms.insert(s, ());
    }
    for &s in &order {
        if linear_parts(&fold.g, s).is_none() {
            for part in operands(fold.g.scalar_node(s)) {
                terms.insert(part, ());
            }
        }
    }
    let mut combinations: Table<Scalar, Combination> = Table::default();
    // For each group the number of operations that it takes, and that it would take; `None` if it has to stay.
    let mut costs: Vec<Option<(usize, usize)>> = Vec::new();
    let mut merged: Vec<usize> = Vec::new();
    let find = |merged: &[usize], mut group: usize| {
        while merged[group] != group {
            group = merged[group];
        }
        group
    };
    for &s in &order {
        let Some(parts) = linear_parts(&fold.g, s) else { continue };
        let mut sum: Option<Combination> = None;
        let mut group = costs.len();
        costs.push(Some((usize::from(fold.g.scalar_node(s).op().is_some_and(|op| op.is_step())), 0)));
        merged.push(group);
        for (k, part) in parts {
            let of_part = match combinations.get(part) {
                Some(known) if !terms.contains(part) => {
                    let (other, own) = (find(&merged, known.group), group);
                    if other != own {
                        merged[own] = other;
                        costs[other] = costs[other].zip(costs[own]).map(|((a, b), (c, d))| (a + c, b + d));
                        group = other;
                    }
                    known.clone()
                }
                _ => Combination { terms: vec![(part, 1.0)], ..Combination::default() },
            };
            sum = Some(match sum {
                None if k.abs() == 1.0 => Combination {
                    terms: of_part.terms.iter().map(|&(term, factor)| (term, k * factor)).collect(),
                    ..of_part
                },
                sum => sum.unwrap_or_default().plus(k, &of_part),
            });
        }
        let mut sum = sum.unwrap_or_default();
        sum.group = group;
        if sum.terms.len() > MOST_TERMS {
            terms.insert(s, ());
            costs[group] = None;
        }
        if terms.contains(s) {
            let fits = sum.keeps_digits();
            costs[group] = costs[group].filter(|_| fits).map(|(now, then)| (now, then + sum.operations()));
        }
        combinations.insert(s, sum);
    }
    let (mut shorter, mut found) = (Table::default(), false);
    for &s in order.iter().filter(|s| terms.contains(**s)) {
        if let Some(combination) = combinations.get(s)
            && costs[find(&merged, combination.group)].is_some_and(|(now, then)| then < now)
        {
            found |= shorter.insert(s, combination.terms.clone());
        }
    }
    found.then(|| Rebuild::outputs(fold, outputs, &mut shorter))
}

impl Exchange for Table<Scalar, Vec<(Scalar, f64)>> {
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
