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
    /// The same, and numbers made of others as far as that may lead to fewer operations than a rival has.
    Last {
        /// The rival's operations.
        rival: Option<usize>,
    },
}

/// So many of the ways to arrange sums and products mostly do it.
const USUAL_TRIES: usize = 6;

/// Longer programs are not polished.
const MOST_OPERATIONS: usize = 400;

/// Of the last arrangements those are kept that need hardly more than the best, by so many operations, and as many as have so many
/// together.
const MOST_ABOVE: usize = 8;
const MOST_IN_LAST: usize = 300;

/// Sums and products in the arrangement that needs the fewest operations, of the few that are tried; for a last effort the next best
/// after it.
pub(crate) fn arranged(fold: &mut Fold, outputs: Vec<Scalar>, rules: &Rules<'_>, effort: Effort) -> Vec<Vec<Scalar>> {
    let is_last = matches!(effort, Effort::Last { .. });
    let mut all = tried(fold, &outputs, rules, effort, false);
    if is_last && rules.has(&JOIN) && all.iter().any(|&(needed, _)| needed <= MOST_IN_LAST) {
        all.extend(tried(fold, &outputs, rules, effort, true));
    }
    all.sort_by_key(|&(needed, _)| needed);
    let least = all.first().map_or(0, |&(needed, _)| needed);
    let most = if is_last { (MOST_IN_LAST / least.max(1)).max(1) } else { 1 };
    let mut near: Vec<Vec<Scalar>> = Vec::new();
    for (_, arrangement) in all.into_iter().take_while(|&(needed, _)| needed <= least + MOST_ABOVE) {
        if near.len() < most && !near.contains(&arrangement) {
            near.push(arrangement);
        }
    }
    near
}

/// Arrangements, each with how many operations it needs, where there is another.
fn tried(
    fold: &mut Fold,
    outputs: &[Scalar],
    rules: &Rules<'_>,
    effort: Effort,
    joins: bool,
) -> Vec<(usize, Vec<Scalar>)> {
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
    let count = match effort {
        Effort::Compare => 1,
        Effort::Polish | Effort::Last { .. } if cfg!(not(aim_small)) => tries.len(),
        Effort::Finish | Effort::Polish | Effort::Last { .. } => USUAL_TRIES,
    };
    let (mut all, mut best, mut least) = (Vec::new(), outputs.to_vec(), usize::MAX);
    let mut shared: Vec<(Vec<Scalar>, Open, Vec<Scalar>)> = Vec::new();
    for (number, (of_best, products, factors)) in tries.into_iter().take(count).enumerate() {
        if number >= USUAL_TRIES && least > MOST_OPERATIONS {
            break;
        }
        let start = if of_best { &best } else { outputs };
        let known = shared.iter().find(|(from, open, _)| *open == products && from == start);
        let mut tried = match known {
            Some((.., made)) => made.clone(),
            None if rules.has(&SHARE) => share_products(fold, start, products, joins),
            None => start.to_vec(),
        };
        if known.is_none() {
            shared.push((start.to_vec(), products, tried.clone()));
        }
        if rules.has(&FACTOR) {
            tried = factor(fold, &tried, factors, joins);
        }
        let needed = if count > 1 { operations(&fold.g, &tried) } else { 0 };
        if needed < least {
            (best, least) = (tried.clone(), needed);
        }
        all.push((needed, tried));
    }
    all
}

fn operations(g: &Graph, outputs: &[Scalar]) -> usize {
    Uses::count(g, outputs).operations(g)
}
