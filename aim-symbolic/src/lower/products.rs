//! Shared products on components: of `(a b) c` and `(b c) d` the product `b c` is made once.

use rustc_hash::FxHashMap;

use crate::ir::table::Table;
use crate::lower::fold::Fold;
use crate::lower::rebuild::{Exchange, Missing, Rebuild, Uses, operands};
use crate::{Op, Scalar, ScalarNode};

/// A product of more than one factor.
struct Chain {
    root: Scalar,
    factors: Vec<Scalar>,
    changed: bool,
}

/// Which products are taken apart: to take shared ones apart may lose or gain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Open {
    /// Those that are a factor of one other product and nothing else.
    Private,
    /// Those that others need too.
    Shared,
}

/// How many pairs of factors are joined: of a long program those that most products have.
const MOST_ROUNDS: usize = 48;

/// Products of more factors stay as they are: a high power is better squared than taken apart.
const MOST_FACTORS: usize = 12;

/// `outputs`, which are lowered, with products in the order in which they share most.
pub(crate) fn share_products(fold: &mut Fold, outputs: Vec<Scalar>, open: Open) -> Vec<Scalar> {
    let uses = Uses::count(&fold.g, &outputs);
    let mut chains = chains(fold, &uses, &outputs, open);
    for _ in 0..MOST_ROUNDS {
        let Some((a, b)) = most_shared(&chains) else { break };
        let product = fold.mul(a, b);
        for chain in &mut chains {
            if chain.factors.len() > 2 && remove_pair(&mut chain.factors, a, b) {
                chain.factors.push(product);
                chain.changed = true;
            }
        }
    }
    if !chains.iter().any(|chain| chain.changed) {
        return outputs;
    }
    let mut changed = Table::default();
    for chain in chains.into_iter().filter(|chain| chain.changed) {
        changed.insert(chain.root, chain.factors);
    }
    Rebuild::outputs(fold, &outputs, &mut Shared { chains: changed })
}

struct Shared {
    chains: Table<Scalar, Vec<Scalar>>,
}

impl Exchange for Shared {
    fn exchange(&mut self, rebuild: &mut Rebuild<'_>, s: Scalar) -> Result<Option<Scalar>, Missing> {
        let Some(factors) = self.chains.get(s) else { return Ok(None) };
        let factors: Result<Vec<Scalar>, Missing> = factors.iter().map(|&factor| rebuild.scalar(factor)).collect();
        Ok(factors?.into_iter().reduce(|a, b| rebuild.fold.mul(a, b)))
    }
}

/// The products that something else than a product needs, each with its factors.
fn chains(fold: &Fold, uses: &Uses, outputs: &[Scalar], open: Open) -> Vec<Chain> {
    let is_product = |s: Scalar| matches!(fold.g.scalar_node(s), ScalarNode::Op(Op::Mul(..)));
    let mut roots = Table::default();
    let mut inner = Table::default();
    let mut sort = |part: Scalar, in_product: bool| {
        if is_product(part) {
            let opens = in_product && (open == Open::Shared || uses.once(part));
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
    roots
        .map(|root| {
            let mut factors = Vec::new();
            collect(fold, &inner, root, &mut factors);
            Chain { root, factors, changed: false }
        })
        .filter(|chain| chain.factors.len() <= MOST_FACTORS)
        .collect()
}

fn collect(fold: &Fold, inner: &Table<Scalar, ()>, s: Scalar, factors: &mut Vec<Scalar>) {
    if factors.len() > MOST_FACTORS {
        return;
    }
    if let ScalarNode::Op(Op::Mul(a, b)) = fold.g.scalar_node(s) {
        for part in [a, b] {
            if inner.contains(part) {
                collect(fold, inner, part, factors);
            } else {
                factors.push(part);
            }
        }
    }
}

/// The pair of factors that most chains have, the first of several; only pairs that save something.
fn most_shared(chains: &[Chain]) -> Option<(Scalar, Scalar)> {
    // How many chains have the pair, and which pair came first. Only chains of more than two factors gain by one.
    let mut found: FxHashMap<(Scalar, Scalar), (usize, usize)> = FxHashMap::default();
    for chain in chains.iter().filter(|chain| chain.factors.len() > 2) {
        let mut seen: Vec<(Scalar, Scalar)> = Vec::new();
        for (i, &a) in chain.factors.iter().enumerate() {
            for &b in &chain.factors[i + 1..] {
                let pair = (a.min(b), a.max(b));
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
            && let Some((count, _)) = found.get_mut(&(a.min(b), a.max(b)))
        {
            *count += 1;
        }
    }
    let shared = found.into_iter().filter(|(_, (count, _))| *count > 1);
    shared.max_by_key(|(_, (count, place))| (*count, usize::MAX - place)).map(|(pair, _)| pair)
}

fn remove_pair(factors: &mut Vec<Scalar>, a: Scalar, b: Scalar) -> bool {
    let Some(i) = factors.iter().position(|&f| f == a) else { return false };
    let Some(j) = factors.iter().enumerate().position(|(j, &f)| j != i && f == b) else { return false };
    factors.remove(i.max(j));
    factors.remove(i.min(j));
    true
}
