//! Lowered expressions made anew, with some of their nodes exchanged.

use crate::fold::Fold;
use crate::table::Table;
use crate::{Graph, Scalar, ScalarNode};

/// How often each scalar is used, by others and as an output.
pub(crate) struct Uses {
    counts: Table<Scalar, usize>,
    order: Vec<Scalar>,
}

impl Uses {
    pub(crate) fn of(g: &Graph, outputs: &[Scalar]) -> Self {
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
        let is_operation = |s: &&Scalar| {
            !matches!(
                g.scalar_node(**s),
                ScalarNode::Constant(_) | ScalarNode::Input(_) | ScalarNode::Tiny | ScalarNode::Neg(_)
            )
        };
        self.order.iter().filter(is_operation).count()
    }

    /// Whether `s` is used in one place only.
    pub(crate) fn once(&self, s: Scalar) -> bool {
        self.counts.copied(s).is_none_or(|count| count == 1)
    }
}

pub(crate) fn operands(node: ScalarNode) -> impl Iterator<Item = Scalar> {
    let parts = match node {
        ScalarNode::Add(a, b)
        | ScalarNode::Sub(a, b)
        | ScalarNode::Mul(a, b)
        | ScalarNode::Div(a, b)
        | ScalarNode::Atan2(a, b) => [Some(a), Some(b), None, None],
        ScalarNode::Neg(a) | ScalarNode::Sqrt(a) | ScalarNode::Reciprocal(a) | ScalarNode::Call(_, a) => {
            [Some(a), None, None, None]
        }
        ScalarNode::SelectLess(a, b, c, d) => [Some(a), Some(b), Some(c), Some(d)],
        _ => [None; 4],
    };
    parts.into_iter().flatten()
}

/// Makes expressions anew, each once.
pub(crate) struct Rebuild<'f, 'g> {
    pub(crate) fold: &'f mut Fold<'g>,
    done: Table<Scalar, Scalar>,
}

/// Offers something else in the place of a node.
pub(crate) trait Exchange: Sized {
    /// What takes the place of `s`, its own parts made anew by `rebuild`; `None` to keep `s`.
    fn exchange(&mut self, rebuild: &mut Rebuild<'_, '_>, s: Scalar) -> Option<Scalar>;
}

impl<'f, 'g> Rebuild<'f, 'g> {
    /// `outputs` made anew.
    pub(crate) fn outputs(fold: &'f mut Fold<'g>, outputs: &[Scalar], exchange: &mut impl Exchange) -> Vec<Scalar> {
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

    fn kept(&mut self, exchange: &mut impl Exchange, s: Scalar) -> Scalar {
        let node = self.fold.g.scalar_node(s);
        let mut parts = operands(node).map(|part| self.scalar(exchange, part)).collect::<Vec<_>>().into_iter();
        let mut part = || parts.next().unwrap_or(s);
        match node {
            ScalarNode::Add(..) => self.fold.add(part(), part()),
            ScalarNode::Sub(..) => self.fold.sub(part(), part()),
            ScalarNode::Mul(..) => self.fold.mul(part(), part()),
            ScalarNode::Div(..) => self.fold.div(part(), part()),
            ScalarNode::Neg(_) => self.fold.neg(part()),
            ScalarNode::Sqrt(_) => self.fold.sqrt(part()),
            ScalarNode::Call(function, _) => self.fold.call(function, part()),
            ScalarNode::Atan2(..) => self.fold.g.atan2(part(), part()),
            ScalarNode::SelectLess(..) => self.fold.select_less(part(), part(), part(), part()),
            _ => s,
        }
    }
}
