//! Lowered expressions made anew, with some of their nodes exchanged.

use crate::ir::table::Table;
use crate::lower::fold::Fold;
use crate::{Graph, Op, Scalar, ScalarNode};

/// How often each scalar is used, by others and as an output.
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

    /// Everything used, in an order that depends on the expression alone.
    pub(crate) fn order(&self) -> &[Scalar] {
        &self.order
    }

    /// How many operations there are.
    pub(crate) fn operations(&self, g: &Graph) -> usize {
        let is_operation = |s: &&Scalar| g.scalar_node(**s).op().is_some_and(|op| op.is_step());
        self.order.iter().filter(is_operation).count()
    }

    /// Whether `s` is used in one place only.
    pub(crate) fn once(&self, s: Scalar) -> bool {
        self.counts.copied(s).is_none_or(|count| count == 1)
    }
}

pub(crate) fn operands(node: ScalarNode) -> impl Iterator<Item = Scalar> {
    node.op().into_iter().flat_map(Op::operands)
}

/// Makes expressions anew, each once.
pub(crate) struct Rebuild<'f> {
    pub(crate) fold: &'f mut Fold,
    done: Table<Scalar, Scalar>,
}

/// Offers something else in the place of a node.
pub(crate) trait Exchange: Sized {
    /// What takes the place of `s`, its own parts made anew by `rebuild`; `None` to keep `s`.
    fn exchange(&mut self, rebuild: &mut Rebuild<'_>, s: Scalar) -> Option<Scalar>;
}

impl<'f> Rebuild<'f> {
    /// `outputs` made anew.
    pub(crate) fn outputs(fold: &'f mut Fold, outputs: &[Scalar], exchange: &mut impl Exchange) -> Vec<Scalar> {
        let mut rebuild = Self { fold, done: Table::default() };
        outputs.iter().map(|&s| rebuild.scalar(exchange, s)).collect()
    }

    pub(crate) fn scalar(&mut self, exchange: &mut impl Exchange, s: Scalar) -> Scalar {
        if let Some(&done) = self.done.get(s) {
            return done;
        }
        let made = exchange.exchange(self, s).unwrap_or_else(|| self.kept(exchange, s));
        self.done.insert(s, made);
        made
    }

    /// The scalar with its operands made anew.
    fn kept(&mut self, exchange: &mut impl Exchange, s: Scalar) -> Scalar {
        let Some(op) = self.fold.g.scalar_node(s).op() else { return s };
        let op = op.map(|part| self.scalar(exchange, part));
        self.fold.op(op)
    }
}
