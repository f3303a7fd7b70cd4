//! Sharing of products of components: in `(a b) c` and `(b c) d` the product `b c` is computed once.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::ir::table::Table;
use crate::lower::fold::Fold;
use crate::lower::rebuild::{Exchange, Missing, Rebuild, Uses, operands};
use crate::{Op, Scalar, ScalarNode};

/// A factor of a product, `true` if it is a divisor.
type Factor = (bool, Scalar);

/// A product or quotient, flattened into its factors.
struct FactorChain {
    root: Scalar,
    factors: Vec<Factor>,
    changed: bool,
}

impl FactorChain {
    /// Combines several constants into one, which is dropped if it is 1. A factor a + a counts as 2 a.
    fn with_one_constant(mut self, fold: &mut Fold) -> Self {
        let (mut constant, mut count, mut factors) = (1.0, 0, Vec::new());
        for &(below, s) in &self.factors {
            let (c, rest) = fold.constant_of(s).map_or_else(|| fold.multiple(s), |c| (c, s));
            count += usize::from(c != 1.0);
            constant = if below { constant / c } else { constant * c };
            if fold.constant_of(rest).is_none() {
                factors.push((below, rest));
            }
        }
        if count > 1 && constant.is_finite() {
            if constant != 1.0 || factors.is_empty() {
                factors.push((false, fold.g.constant(constant)));
            }
            (self.factors, self.changed) = (factors, true);
        }
        self
    }

    /// `k (a b + c d) = (k a) b + (k c) d`, if `k a` and `k c` exist already.
    fn by_known(mut self, fold: &mut Fold, uses: &Uses, known: &FxHashSet<[Scalar; 2]>) -> Self {
        let found = self.factors.iter().enumerate().find_map(|(place, &(below, sum))| {
            let terms = if below || !uses.once(sum) { None } else { products_of_sum(fold, uses, sum) }?;
            self.factors.iter().enumerate().find_map(|(other, &(below, k))| {
                let knows = |a: Scalar| known.contains(&[k.min(a), k.max(a)]);
                let terms: Option<Vec<[Scalar; 2]>> = terms
                    .iter()
                    .map(|&[a, b]| if knows(a) { Some([a, b]) } else { knows(b).then_some([b, a]) })
                    .collect();
                terms.filter(|_| !below && place != other).map(|terms| (place, other, k, terms))
            })
        });
        if let Some((place, other, k, terms)) = found {
            let mut sum = fold.g.constant(0.0);
            for [a, b] in terms {
                let product = fold.mul(k, a);
                let product = fold.mul(product, b);
                sum = fold.add(sum, product);
            }
            self.factors.remove(place.max(other));
            self.factors.remove(place.min(other));
            self.factors.push((false, sum));
            self.changed = true;
        }
        self
    }
}

/// Returns the terms of a sum if there are several, all are products of two, and neither the sum nor a term has another
/// use.
fn products_of_sum(fold: &Fold, uses: &Uses, sum: Scalar) -> Option<Vec<[Scalar; 2]>> {
    let (mut all, mut open) = (Vec::new(), vec![sum]);
    while let Some(s) = open.pop() {
        match fold.g.scalar_node(s) {
            ScalarNode::Op(Op::Add(a, b)) if uses.once(s) && open.len() < MOST_FACTORS => open.extend([b, a]),
            ScalarNode::Op(Op::Mul(a, b)) if uses.once(s) => all.push([a, b]),
            _ => return None,
        }
    }
    (all.len() > 1).then_some(all)
}

/// Which products are taken apart. Taking apart more of them may save or cost operations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OpenProducts {
    /// Products that are a factor of exactly one other product and have no other use.
    Private,
    /// Also products that have other uses.
    Shared,
    /// Also products that have other uses, and quotients.
    Quotients,
    /// Also products that have other uses, and products with sums.
    Sums,
}

/// Limit on the number of pairs of factors that are multiplied first, the most shared ones first.
const MAX_SHARED_PAIRS: usize = 48;

/// Limit on the number of factors of a product that is rearranged: a high power is better computed by squaring.
const MOST_FACTORS: usize = 12;

/// Returns `outputs`, which must be lowered, with the factors of products in the order in which they share most.
pub(crate) fn share_products(fold: &mut Fold, outputs: &[Scalar], open: OpenProducts, joins: bool) -> Vec<Scalar> {
    let uses = Uses::count(&fold.g, outputs);
    let mut chains = chains(fold, &uses, outputs, open, joins);
    for _ in 0..MAX_SHARED_PAIRS {
        let Some(pair) = most_shared(&chains) else { break };
        let [(_, a), (over, b)] = pair;
        let made = if over { fold.div(a, b) } else { fold.mul(a, b) };
        for chain in &mut chains {
            if chain.factors.len() > 2
                && let Some(below) = remove_pair(&mut chain.factors, pair)
            {
                chain.factors.push((below, made));
                chain.changed = true;
            }
        }
    }
    chains.retain(|chain| chain.changed);
    if chains.is_empty() {
        return outputs.to_vec();
    }
    let mut changed = Table::default();
    for chain in chains {
        changed.insert(chain.root, chain.factors);
    }
    Rebuild::outputs(fold, outputs, &mut changed)
}

impl Exchange for Table<Scalar, Vec<Factor>> {
    fn exchange(&mut self, rebuild: &mut Rebuild<'_>, s: Scalar) -> Result<Option<Scalar>, Missing> {
        let Some(factors) = self.copied(s) else { return Ok(None) };
        let mut made: Option<Scalar> = None;
        // Divisors come last.
        let (below, above): (Vec<Factor>, Vec<Factor>) = factors.into_iter().partition(|&(below, _)| below);
        for (below, factor) in above.into_iter().chain(below) {
            let factor = rebuild.scalar(factor)?;
            let product = made.unwrap_or_else(|| rebuild.fold.g.constant(1.0));
            made = Some(if below { rebuild.fold.div(product, factor) } else { rebuild.fold.mul(product, factor) });
        }
        Ok(made)
    }
}

/// Returns the products that are used by anything but products, flattened into their factors.
fn chains(fold: &mut Fold, uses: &Uses, outputs: &[Scalar], open: OpenProducts, joins: bool) -> Vec<FactorChain> {
    let is_product = |s: Scalar| match fold.g.scalar_node(s) {
        ScalarNode::Op(Op::Mul(..)) => true,
        ScalarNode::Op(Op::Div(..)) => open == OpenProducts::Quotients,
        _ => false,
    };
    let mut roots = Table::default();
    let mut inner = Table::default();
    let mut sort = |part: Scalar, in_product: bool| {
        if is_product(part) {
            let opens = in_product && (open != OpenProducts::Private || uses.once(part));
            if opens {
                inner.insert(part, ())
            } else {
                roots.insert(part, ())
            };
        }
    };
    outputs.iter().for_each(|&s| sort(s, false));
    for &s in uses.order() {
        operands(fold.g.scalar_node(s)).for_each(|part| sort(part, is_product(s)));
    }
    let roots = uses.order().iter().copied().filter(|&s| roots.contains(s));
    let chains = roots.map(|root| {
        let mut factors = Vec::new();
        collect(fold, &inner, (false, root), &mut factors);
        FactorChain { root, factors, changed: false }
    });
    let short: Vec<FactorChain> = chains.filter(|chain| chain.factors.len() <= MOST_FACTORS).collect();
    if cfg!(aim_small) || !joins {
        return short;
    }
    let known = known_products(fold, uses);
    short.into_iter().map(|chain| chain.with_one_constant(fold).by_known(fold, uses, &known)).collect()
}

/// Returns the existing products, by their sorted factors.
fn known_products(fold: &Fold, uses: &Uses) -> FxHashSet<[Scalar; 2]> {
    let factors = |&s: &Scalar| match fold.g.scalar_node(s) {
        ScalarNode::Op(Op::Mul(a, b)) => Some([a.min(b), a.max(b)]),
        _ => None,
    };
    uses.order().iter().filter_map(factors).collect()
}

fn collect(fold: &Fold, inner: &Table<Scalar, ()>, (below, s): Factor, factors: &mut Vec<Factor>) {
    if factors.len() > MOST_FACTORS {
        return;
    }
    let (ScalarNode::Op(Op::Mul(a, b)) | ScalarNode::Op(Op::Div(a, b))) = fold.g.scalar_node(s) else { return };
    let over = matches!(fold.g.scalar_node(s), ScalarNode::Op(Op::Div(..)));
    for part in [(below, a), (below != over, b)] {
        if inner.contains(part.1) {
            collect(fold, inner, part, factors);
        } else if fold.g.constant_of(part.1) != Some(1.0) {
            factors.push(part);
        }
    }
}

/// Returns the pair in canonical order: two factors on the same side sorted, else the divisor second.
fn ordered([a, b]: [Factor; 2]) -> [Factor; 2] {
    match (a.0, b.0) {
        (false, true) => [a, b],
        (true, false) => [b, a],
        _ => [(false, a.1.min(b.1)), (false, a.1.max(b.1))],
    }
}

/// Returns the pair of factors that occurs in the most chains, the first of several; `None` if no pair saves an
/// operation.
fn most_shared(chains: &[FactorChain]) -> Option<[Factor; 2]> {
    // For each pair the number of chains with it, and its order of appearance. A pair saves an operation only if it
    // occurs in a chain of more than two factors.
    let mut found: FxHashMap<[Factor; 2], (usize, usize)> = FxHashMap::default();
    for chain in chains.iter().filter(|chain| chain.factors.len() > 2) {
        let mut seen: Vec<[Factor; 2]> = Vec::new();
        for (i, &a) in chain.factors.iter().enumerate() {
            for &b in &chain.factors[i + 1..] {
                let pair = ordered([a, b]);
                if !seen.contains(&pair) {
                    seen.push(pair);
                    let place = found.len();
                    found.entry(pair).or_insert((0, place)).0 += 1;
                }
            }
        }
    }
    if found.is_empty() {
        return None;
    }
    for chain in chains {
        if let [a, b] = chain.factors[..]
            && let Some((count, _)) = found.get_mut(&ordered([a, b]))
        {
            *count += 1;
        }
    }
    let shared = found.into_iter().filter(|(_, (count, _))| *count > 1);
    shared.max_by_key(|(_, (count, place))| (*count, usize::MAX - place)).map(|(pair, _)| pair)
}

/// Removes both factors. Returns `true` if both were divisors.
fn remove_pair(factors: &mut Vec<Factor>, pair: [Factor; 2]) -> Option<bool> {
    let places = (0..factors.len()).flat_map(|i| (i + 1..factors.len()).map(move |j| (i, j)));
    let (i, j) = places.into_iter().find(|&(i, j)| ordered([factors[i], factors[j]]) == pair)?;
    let below = factors.remove(j).0 && factors[i].0;
    factors.remove(i);
    Some(below)
}
