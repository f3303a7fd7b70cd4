//! The record of what was rewritten and how derivatives were taken.

use crate::Scalar;
use crate::diff::sweep::Swept;
use crate::ir::node::Node;
use crate::rewrite::rules::Rule;

/// One application of a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rewrite {
    /// The rule.
    pub rule: Rule,
    /// What it was applied to.
    pub from: Node,
    /// What it made of that.
    pub to: Node,
}

/// What was done, in order, and how many more rules may be applied.
#[derive(Clone, Debug, Default)]
pub(crate) struct Log {
    pub(crate) applied: Vec<Rewrite>,
    /// How many may be applied in all; `None` for as many as there are.
    pub(crate) limit: Option<usize>,
    /// How derivatives were taken.
    pub(crate) sweeps: Vec<Swept>,
    /// What they were taken of, and what was wanted as it was just after that.
    pub(crate) values: Vec<Scalar>,
    pub(crate) derived: Vec<Scalar>,
    /// How many rules had been applied before.
    pub(crate) before_sweeps: usize,
}

impl Log {
    pub(crate) fn limited(limit: usize) -> Self {
        Self { limit: Some(limit), ..Self::default() }
    }

    pub(crate) fn may_apply(&self) -> bool {
        self.limit.is_none_or(|limit| self.applied.len() < limit)
    }
}
