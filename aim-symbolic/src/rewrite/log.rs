//! The record of applied rules and of derivative sweeps.

use crate::Scalar;
use crate::diff::sweep::SweepRecord;
use crate::ir::node::Node;
use crate::rewrite::rules::Rule;

/// One application of a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rewrite {
    /// The rule.
    pub rule: Rule,
    /// The node to which it was applied.
    pub from: Node,
    /// The replacement.
    pub to: Node,
}

/// The applied rules in order, with a limit on their number, and the derivative sweeps.
#[derive(Clone, Debug, Default)]
pub(crate) struct Log {
    pub(crate) applied: Vec<Rewrite>,
    /// Limit on the total number of applications; `None` for no limit.
    pub(crate) limit: Option<usize>,
    /// The derivative sweeps.
    pub(crate) sweeps: Vec<SweepRecord>,
    /// The expressions that were differentiated.
    pub(crate) values: Vec<Scalar>,
    /// All requested expressions as they were immediately after differentiation.
    pub(crate) derived: Vec<Scalar>,
    /// The number of applications before differentiation.
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
