//! [`Side`]: terms of sums that are 0 on one side of a comparison, and the rule by which they are [joined](Join).

use crate::Scalar;

/// A term that is 0 on one side of a comparison.
pub(crate) struct Side {
    pub(crate) compared: [Scalar; 2],
    /// `true` if the term is 0 unless the comparison holds, `false` if it is 0 unless it fails.
    pub(crate) holds: bool,
    /// The value of the term on the other side, without `factor`.
    pub(crate) base: Scalar,
    pub(crate) factor: Option<Scalar>,
}

/// Which pairs of terms are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Join {
    /// Terms whose other conditions agree, if joining them needs no additional product.
    Alike,
    /// Terms whose other conditions agree, even if joining them needs an additional product.
    Complements,
    /// Terms that are 0 on opposite sides of any comparison.
    Opposites,
}

impl Join {
    /// Returns the sides by which the two terms are joined, or `None` if they are not.
    pub(crate) fn of<'s>(self, first: &'s [Side], second: &'s [Side]) -> Option<(&'s Side, &'s Side)> {
        let same = |x: &Side, y: &Side| x.compared == y.compared && x.holds == y.holds;
        let opposite = |x: &Side, y: &Side| x.compared == y.compared && x.holds != y.holds;
        let complement = |x: &Side| {
            let mut others = first.iter().filter(|side| side.compared != x.compared);
            first.len() == second.len() && others.all(|x| second.iter().any(|y| same(x, y)))
        };
        let alike = |x: &Side, y: &Side| x.base == y.base || (x.factor.is_none() && y.factor.is_none());
        let fits = |x: &Side, y: &Side| match self {
            Self::Alike => complement(x) && alike(x, y),
            Self::Complements => complement(x),
            Self::Opposites => true,
        };
        let mut pairs = first.iter().flat_map(|x| second.iter().map(move |y| (x, y)));
        pairs.find(|(x, y)| opposite(x, y) && fits(x, y))
    }
}
