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
use crate::rewrite::rules::{FACTOR, JOIN, Rules, SHARE};
use crate::{Graph, Scalar};

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effort {
    /// Enough to compare a program with others of its kind.
    Compare,
    /// The ways that mostly do it.
    Finish,
    /// All there is.
    Polish,
}

/// So many of the ways to arrange sums and products mostly do it.
const USUAL_TRIES: usize = 6;

/// Longer programs are not polished.
pub(crate) const MOST_OPERATIONS: usize = 400;

/// Sums and products in the arrangement that needs the fewest operations, of the few that are tried.
pub(crate) fn arranged(fold: &mut Fold, outputs: Vec<Scalar>, rules: &Rules<'_>, effort: Effort) -> Vec<Scalar> {
    // Whether it starts from the best so far, and what of products and of factors is opened.
    let tries = [
        (false, Open::Private, Open::Private),
        (false, Open::Shared, Open::Private),
        (true, Open::Shared, Open::Private),
        (true, Open::Quotients, Open::Shared),
        (false, Open::Quotients, Open::Shared),
        (true, Open::Quotients, Open::Private),
        (false, Open::Shared, Open::Quotients),
        (true, Open::Shared, Open::Shared),
        (false, Open::Shared, Open::Sums),
        (true, Open::Shared, Open::Shared),
    ];
    let joins = cfg!(not(aim_small)) && rules.has(&JOIN);
    let count = match effort {
        Effort::Compare => 1,
        Effort::Polish if cfg!(not(aim_small)) => tries.len(),
        Effort::Finish | Effort::Polish => USUAL_TRIES,
    };
    let (mut best, mut least) = (Vec::new(), usize::MAX);
    for (number, (of_best, products, factors)) in tries.into_iter().take(count).enumerate() {
        if number >= USUAL_TRIES && least > MOST_OPERATIONS {
            break;
        }
        let mut tried = if of_best { best.clone() } else { outputs.clone() };
        if rules.has(&SHARE) {
            tried = share_products(fold, &tried, products, joins);
        }
        if rules.has(&FACTOR) {
            tried = factor(fold, &tried, factors, joins);
        }
        let needed = if count > 1 { operations(&fold.g, &tried) } else { 0 };
        if needed < least {
            (best, least) = (tried, needed);
        }
    }
    best
}

fn operations(g: &Graph, outputs: &[Scalar]) -> usize {
    Uses::count(g, outputs).operations(g)
}
