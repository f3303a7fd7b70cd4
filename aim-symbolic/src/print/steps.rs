//! Programs written step by step: which operations stand inside others, and where parentheses are needed.

use crate::{Op, Program, Value};

/// Strength that binds a written expression together, the loosest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Dot,
    Product,
    Atom,
}

/// A notation for single operations.
pub trait Printer {
    /// A piece of what is written.
    type Text;
    /// An operation on written operands, which are in parentheses where they need to be.
    fn operation(&self, op: Op<Self::Text>) -> Self::Text;
    /// An operand in parentheses.
    fn group(&self, operand: Self::Text) -> Self::Text;
    /// The name of a step's result.
    fn step(&self, number: usize) -> Self::Text;
}

/// A program in a notation. Inputs, constants, negations and what is needed once are written in place.
#[derive(Debug)]
pub struct Written<'a, P> {
    /// The program.
    pub program: &'a Program,
    /// The notation.
    pub printer: &'a P,
}

impl<P: Printer> Written<'_, P> {
    /// The program's steps, each with its number.
    pub fn steps(&self) -> impl Iterator<Item = (usize, P::Text)> {
        self.program.steps().map(|(number, op)| (number, self.operation(op)))
    }

    /// The program's outputs.
    #[must_use]
    pub fn outputs(&self) -> Vec<P::Text> {
        self.program.outputs().iter().map(|&v| self.operand(v)).collect()
    }

    /// An operation with everything that stands inside it.
    ///
    /// Sums and products round, so they are grouped as they are computed: a sum on the right of a sum, or a product on the
    /// right of a product, is in parentheses.
    #[must_use]
    pub fn operation(&self, op: Op) -> P::Text {
        let looser = match op {
            Op::Add(..) | Op::Sub(..) => [None, Some(Binding::Sum)],
            Op::Mul(..) | Op::Div(..) => [Some(Binding::Sum), Some(Binding::Product)],
            Op::Neg(_) => [Some(Binding::Product), None],
            _ => [None; 2],
        };
        let mut looser = looser.into_iter();
        self.printer.operation(op.map(|v| self.above(v, looser.next().flatten())))
    }

    /// A value where it is used.
    #[must_use]
    pub fn operand(&self, v: Value) -> P::Text {
        self.above(v, None)
    }

    /// A value where it is used, in parentheses unless it binds more tightly than `looser`.
    fn above(&self, v: Value, looser: Option<Binding>) -> P::Text {
        let op = self.program.ops()[v.index()];
        if op.is_step() && !self.program.is_inline(v) {
            return self.printer.step(self.program.step_number(v));
        }
        let own = match op {
            Op::Add(..) | Op::Sub(..) => Binding::Sum,
            Op::Mul(..) | Op::Div(..) => Binding::Product,
            _ => Binding::Atom,
        };
        let text = self.operation(op);
        if looser.is_some_and(|looser| own <= looser) { self.printer.group(text) } else { text }
    }
}
