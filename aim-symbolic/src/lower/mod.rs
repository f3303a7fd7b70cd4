//! Lowering: typed expressions become few operations on numbers. They are split into components and folded, their
//! products are shared and their sums factored.

mod combinations;
pub(crate) mod components;
pub(crate) mod factor;
pub(crate) mod fold;
mod limits;
pub(crate) mod products;
pub(crate) mod rebuild;
mod scales;
mod selects;
pub(crate) mod sides;

use self::combinations::combine;
use self::factor::factor;
use self::fold::Fold;
use self::products::{OpenProducts, share_products};
use self::rebuild::Uses;
pub(crate) use self::scales::scaled;
use crate::rewrite::rules::{FACTOR, JOIN, Rules, SHARE};
use crate::{Graph, Scalar};

/// The amount of search for a short program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Effort {
    /// Enough to compare a program with its alternatives.
    Compare,
    /// The arrangements that usually suffice.
    Finish,
    /// All arrangements.
    Polish,
    /// All arrangements, and resubstitution as far as it may lead to fewer operations than a rival has.
    Last {
        /// The rival's number of operations; `None` without a rival.
        rival: Option<usize>,
    },
}

/// The number of arrangements of sums and products that usually suffice.
const USUAL_TRIES: usize = 6;

/// Largest number of operations for which more than the usual arrangements are tried.
const MOST_OPERATIONS: usize = 400;

/// Limit on the operations that an arrangement may need beyond the best to be kept in a last effort.
const MOST_ABOVE: usize = 8;
/// Limit on the total number of operations of all arrangements that are kept in a last effort.
const MOST_IN_LAST: usize = 300;

/// Returns the arrangement of sums and products that needs the fewest operations among those tried; for a last effort
/// also the next best, in order.
pub(crate) fn best_arrangements(
    fold: &mut Fold,
    outputs: Vec<Scalar>,
    rules: &Rules<'_>,
    effort: Effort,
) -> Vec<Vec<Scalar>> {
    let is_last = cfg!(not(aim_small)) && matches!(effort, Effort::Last { .. });
    let mut outputs = outputs;
    if is_last
        && rules.has(&FACTOR)
        && let Some(combined) = combine(fold, &outputs)
    {
        let [now, then] = [&outputs, &combined].map(|outputs| {
            let first = try_arrangements(fold, outputs, rules, Effort::Compare, false);
            first.first().map_or(0, |(_, arrangement)| operations(&fold.g, arrangement))
        });
        outputs = if then < now { combined } else { outputs };
    }
    let mut all = try_arrangements(fold, &outputs, rules, effort, false);
    if is_last && rules.has(&JOIN) && all.iter().any(|&(needed, _)| needed <= MOST_IN_LAST) {
        all.extend(try_arrangements(fold, &outputs, rules, effort, true));
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

/// Returns the arrangements that were tried, each with its number of operations, or with 0 if it is the only one.
fn try_arrangements(
    fold: &mut Fold,
    outputs: &[Scalar],
    rules: &Rules<'_>,
    effort: Effort,
    joins: bool,
) -> Vec<(usize, Vec<Scalar>)> {
    // For each try: whether it starts from the best result so far, and which products to open for sharing and for
    // factoring.
    let tries = [
        (false, OpenProducts::Private, OpenProducts::Private),
        (false, OpenProducts::Shared, OpenProducts::Private),
        (true, OpenProducts::Shared, OpenProducts::Private),
        (true, OpenProducts::Quotients, OpenProducts::Shared),
        (false, OpenProducts::Quotients, OpenProducts::Shared),
        (true, OpenProducts::Quotients, OpenProducts::Private),
        (false, OpenProducts::Shared, OpenProducts::Quotients),
        (true, OpenProducts::Shared, OpenProducts::Shared),
        (false, OpenProducts::Shared, OpenProducts::Sums),
        (true, OpenProducts::Shared, OpenProducts::Shared),
    ];
    let count = match effort {
        Effort::Compare => 1,
        Effort::Polish | Effort::Last { .. } if cfg!(not(aim_small)) => tries.len(),
        Effort::Finish | Effort::Polish | Effort::Last { .. } => USUAL_TRIES,
    };
    let (mut all, mut best, mut least) = (Vec::new(), outputs.to_vec(), usize::MAX);
    let mut shared: Vec<(Vec<Scalar>, OpenProducts, Vec<Scalar>)> = Vec::new();
    for (number, (of_best, products, factors)) in tries.into_iter().take(count).enumerate() {
        if number >= USUAL_TRIES && least > MOST_OPERATIONS {
            break;
        }
        let start = if of_best { &best } else { outputs };
        let known = shared.iter().find(|(from, open, _)| *open == products && from == start);
        let mut arrangement = match known {
            Some((.., made)) => made.clone(),
            None if rules.has(&SHARE) => share_products(fold, start, products, joins),
            None => start.to_vec(),
        };
        if known.is_none() {
            shared.push((start.to_vec(), products, arrangement.clone()));
        }
        if rules.has(&FACTOR) {
            arrangement = factor(fold, &arrangement, factors, joins);
        }
        let needed = if count > 1 { operations(&fold.g, &arrangement) } else { 0 };
        if needed < least {
            (best, least) = (arrangement.clone(), needed);
        }
        all.push((needed, arrangement));
    }
    all
}

fn operations(g: &Graph, outputs: &[Scalar]) -> usize {
    Uses::count(g, outputs).operations(g)
}
