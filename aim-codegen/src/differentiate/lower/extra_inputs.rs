//! Inputs that are not numbers of arguments: states and counters of kept loops, elements of slices, and constants that only
//! the compiler sees.

use aim_symbolic::Scalar;

/// Source of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ExtraInput {
    /// Index of an iteration of this loop, from 0.
    Iteration(usize),
    /// A number of an element of a slice; `slice` is the slice's index among all arguments.
    Element { slice: usize, index: ElementIndex, number: usize },
    /// State of a loop before an iteration: the loop's index and the state's.
    StateBefore(usize, usize),
    /// State of a loop after the last iteration: the loop's index and the state's.
    StateAfter(usize, usize),
    /// The constant of this index in [`Algebra::constants`](super::algebra::Algebra::constants), a number.
    Constant(usize),
    /// The constant of this index, of any type that can be cast to a number.
    CastConstant(usize),
}

/// Index of an element in a slice.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ElementIndex {
    /// Index of the iteration of this loop, plus an offset.
    Iteration(usize, i64),
    /// A constant index.
    Constant(usize),
    /// A computed index.
    Computed(Scalar),
}

/// A kept loop.
#[derive(Clone, Debug)]
pub(crate) struct KeptLoop {
    /// Index of the enclosing kept loop.
    pub(crate) within: Option<usize>,
    /// Number of iterations; none if it is not positive.
    pub(crate) count: Scalar,
    pub(crate) states: Vec<State>,
    /// 1 if an iteration is the last one, else 0; `None` if no iteration ends the loop early.
    pub(crate) exit_flag: Option<Scalar>,
}

/// A number that an iteration changes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct State {
    /// Value before the first iteration.
    pub(crate) first: Scalar,
    /// Value before an iteration, an input.
    pub(crate) before: Scalar,
    /// Value after an iteration.
    pub(crate) next: Scalar,
    /// Value after the last iteration, an input.
    pub(crate) after: Scalar,
    /// `true` if it has derivatives; counts and flags have none.
    pub(crate) varies: bool,
}
