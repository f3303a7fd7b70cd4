//! From typed expressions to few operations on numbers: components, folded, their products shared and their sums factored.

pub(crate) mod components;
pub(crate) mod factor;
pub(crate) mod fold;
mod limits;
pub(crate) mod products;
pub(crate) mod rebuild;
mod scales;
mod selects;
pub(crate) mod sides;

use self::factor::factor;
use self::fold::Fold;
use self::products::{Open, share_products};
use self::rebuild::Uses;
pub(crate) use self::scales::scaled;
use crate::rewrite::rules::{FACTOR, Rules, SHARE};
use crate::{Graph, Scalar};

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effort {
    /// Enough to compare a program with others of its kind.
    Compare,
    /// All there is.
    Finish,
}

/// Sums and products in the arrangement that needs the fewest operations, of the few that are tried.
pub(crate) fn arranged(fold: &mut Fold, outputs: Vec<Scalar>, rules: &Rules<'_>, effort: Effort) -> Vec<Scalar> {
    let arranged = |fold: &mut Fold, outputs: &[Scalar], products: Open, factors: Open| {
        let shared = if rules.has(&SHARE) { share_products(fold, outputs, products) } else { outputs.to_vec() };
        if rules.has(&FACTOR) { factor(fold, &shared, factors) } else { shared }
    };
    let mut best = arranged(fold, &outputs, Open::Private, Open::Private);
    if effort == Effort::Finish {
        let mut least = operations(&fold.g, &best);
        for (of_best, products, factors) in [
            (false, Open::Shared, Open::Private),
            (true, Open::Shared, Open::Private),
            (true, Open::Quotients, Open::Shared),
            (false, Open::Quotients, Open::Shared),
            (true, Open::Quotients, Open::Private),
        ] {
            let tried = arranged(fold, if of_best { &best } else { &outputs }, products, factors);
            let needed = operations(&fold.g, &tried);
            if needed < least {
                (best, least) = (tried, needed);
            }
        }
    }
    best
}

fn operations(g: &Graph, outputs: &[Scalar]) -> usize {
    Uses::count(g, outputs).operations(g)
}
