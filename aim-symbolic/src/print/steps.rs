//! Programs as a sequence of steps: places operations inside others and sets parentheses where they are needed.

use crate::{Op, Program, Value};

/// The binding strength of a written expression, weakest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Binding {
    Sum,
    Dot,
    Product,
    Atom,
}

/// A notation for single operations.
pub trait Printer {
    /// A fragment of the output.
    type Text;
    /// Writes an operation. Its operands are written already, with parentheses where needed.
    fn operation(&self, op: Op<Self::Text>) -> Self::Text;
    /// Puts an operand in parentheses.
    fn group(&self, operand: Self::Text) -> Self::Text;
    /// Returns the name of a step's result.
    fn step(&self, number: usize) -> Self::Text;
}

/// A program in a notation. Inputs, constants, negations and values that are used once are written in place.
#[derive(Debug)]
pub struct ProgramWriter<'a, P> {
    /// The program.
    pub program: &'a Program,
    /// The notation.
    pub printer: &'a P,
}

impl<P: Printer> ProgramWriter<'_, P> {
    /// Returns the program's steps, each with its number.
    pub fn steps(&self) -> impl Iterator<Item = (usize, P::Text)> {
        self.program.steps().map(|(number, op)| (number, self.operation(op)))
    }

    /// Returns the program's outputs.
    #[must_use]
    pub fn outputs(&self) -> Vec<P::Text> {
        self.program.outputs().iter().map(|&v| self.operand(v)).collect()
    }

    /// Writes an operation with everything that is written inside it.
    ///
    /// Sums and products are grouped as they are computed, since grouping affects rounding: a sum as the right operand
    /// of a sum, or a product as the right operand of a product, is in parentheses.
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

    /// Writes a value where it is used.
    #[must_use]
    pub fn operand(&self, v: Value) -> P::Text {
        self.above(v, None)
    }

    /// Writes a value where it is used, in parentheses unless it binds more tightly than `looser`.
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
