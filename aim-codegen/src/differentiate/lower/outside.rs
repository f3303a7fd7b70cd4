//! Inputs that are not the numbers of arguments: what a loop that stays a loop reads from the round before, and the elements of
//! slices.

use aim_symbolic::Scalar;

/// Where an input comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outside {
    /// The number of a loop's round, from 0.
    Round(usize),
    /// A number of an element of the slice of this place among those of the arguments.
    Element { slice: usize, at: At, number: usize },
    /// A state of a loop, as it is before a round.
    Before(usize, usize),
    /// The same after the last round.
    After(usize, usize),
}

/// Which element of a slice it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum At {
    /// The one of the number of a loop's round, and so many more.
    Round(usize, i64),
    /// The one of this number.
    Known(usize),
    /// The one of a number that is computed.
    Chosen(Scalar),
}

/// A loop that stays a loop.
#[derive(Clone, Debug)]
pub(crate) struct KeptLoop {
    /// The loop in a round of which it stands.
    pub(crate) within: Option<usize>,
    /// How many rounds there are, if it is more than 0.
    pub(crate) count: Scalar,
    pub(crate) states: Vec<State>,
    /// 1 where a round is the last one, if one may be.
    pub(crate) leaves: Option<Scalar>,
}

/// A number that a round changes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    /// Before the first round.
    pub(crate) first: Scalar,
    /// What a round finds, an input.
    pub(crate) before: Scalar,
    /// What it makes of it.
    pub(crate) next: Scalar,
    /// What is left after the last round, an input.
    pub(crate) after: Scalar,
    /// Whether it has derivatives: a count or a flag has none.
    pub(crate) varies: bool,
}
