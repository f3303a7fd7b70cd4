//! Rebuilds lowered expressions with some of their nodes replaced.

use crate::ir::table::Table;
use crate::lower::fold::Fold;
use crate::{Graph, Op, Scalar, ScalarNode};

/// The number of uses of each scalar, as an operand and as an output.
pub(crate) struct Uses {
    counts: Table<Scalar, usize>,
    order: Vec<Scalar>,
}

impl Uses {
    pub(crate) fn count(g: &Graph, outputs: &[Scalar]) -> Self {
        let mut uses = Self { counts: Table::default(), order: Vec::new() };
        let mut stack: Vec<Scalar> = outputs.iter().rev().copied().collect();
        while let Some(s) = stack.pop() {
            let count = uses.counts.copied(s).unwrap_or(0) + 1;
            uses.counts.insert(s, count);
            if count == 1 {
                uses.order.push(s);
                stack.extend(operands(g.scalar_node(s)));
            }
        }
        uses
    }

    /// Returns everything used, in an order that depends only on the expression.
    pub(crate) fn order(&self) -> &[Scalar] {
        &self.order
    }

    /// Returns the number of operations.
    pub(crate) fn operations(&self, g: &Graph) -> usize {
        let is_operation = |s: &&Scalar| g.scalar_node(**s).op().is_some_and(|op| op.is_step());
        self.order.iter().filter(is_operation).count()
    }

    /// Returns `true` if `s` is used in only one place.
    pub(crate) fn once(&self, s: Scalar) -> bool {
        self.counts.copied(s).is_none_or(|count| count == 1)
    }
}

pub(crate) fn operands(node: ScalarNode) -> impl Iterator<Item = Scalar> {
    node.op().into_iter().flat_map(Op::operands)
}

/// Rebuilds expressions, each once.
pub(crate) struct Rebuild<'f> {
    pub(crate) fold: &'f mut Fold,
    done: Table<Scalar, Scalar>,
}

/// A scalar that has to be rebuilt first.
pub(crate) struct Missing(Scalar);

/// Supplies replacements of nodes.
pub(crate) trait Exchange: Sized {
    /// Returns the replacement of `s`, built from operands that `rebuild` has rebuilt, or `None` to keep `s`. On
    /// `Err(Missing)` it is called again after the missing operand is rebuilt.
    fn exchange(&mut self, rebuild: &mut Rebuild<'_>, s: Scalar) -> Result<Option<Scalar>, Missing>;
}

impl<'f> Rebuild<'f> {
    /// Returns `outputs` rebuilt.
    pub(crate) fn outputs(fold: &'f mut Fold, outputs: &[Scalar], exchange: &mut impl Exchange) -> Vec<Scalar> {
        let mut rebuild = Self { fold, done: Table::default() };
        let mut rebuilt = Vec::new();
        for &output in outputs {
            let mut pending = vec![output];
            while let Some(&s) = pending.last() {
                match rebuild.rebuild(exchange, s) {
                    Ok(_) => {
                        pending.pop();
                    }
                    Err(Missing(part)) => pending.push(part),
                }
            }
            rebuilt.extend(rebuild.done.get(output));
        }
        rebuilt
    }

    fn rebuild(&mut self, exchange: &mut impl Exchange, s: Scalar) -> Result<Scalar, Missing> {
        if let Some(&done) = self.done.get(s) {
            return Ok(done);
        }
        let rebuilt = match exchange.exchange(self, s)? {
            Some(rebuilt) => rebuilt,
            None => self.rebuild_operands(s)?,
        };
        self.done.insert(s, rebuilt);
        Ok(rebuilt)
    }

    /// Returns the rebuilt scalar, or the error that it is missing.
    pub(crate) fn scalar(&self, s: Scalar) -> Result<Scalar, Missing> {
        self.done.copied(s).ok_or(Missing(s))
    }

    /// Rebuilds the scalar with rebuilt operands and the same operation.
    fn rebuild_operands(&mut self, s: Scalar) -> Result<Scalar, Missing> {
        let Some(op) = self.fold.g.scalar_node(s).op() else { return Ok(s) };
        let mut missing = None;
        let op = op.map(|part| {
            let rebuilt = self.scalar(part);
            rebuilt.unwrap_or_else(|part| {
                missing.get_or_insert(part);
                s
            })
        });
        match missing {
            Some(missing) => Err(missing),
            None => Ok(self.fold.op(op)),
        }
    }
}
