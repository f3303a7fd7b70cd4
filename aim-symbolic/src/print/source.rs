//! What all back ends that write text share: a program as steps of infix source.

use crate::{Function, Op, Program, Value};

/// How a language writes what the languages write differently.
pub trait Dialect {
    /// The input with this index.
    fn input(&self, index: usize) -> String;
    /// A constant.
    fn constant(&self, value: f64) -> String;
    /// The smallest length that is divided by.
    fn tiny(&self) -> String;
    /// A square root.
    fn sqrt(&self, a: &str) -> String;
    /// `then` where `a < b`, else `otherwise`.
    fn select_less(&self, a: &str, b: &str, then: &str, otherwise: &str) -> String;
    /// A function of the mathematical library.
    fn call(&self, function: Function, a: &str) -> String {
        format!("{}({a})", function.name())
    }
    /// The angle of the point (`x`, `y`).
    fn atan2(&self, y: &str, x: &str) -> String {
        format!("atan2({y}, {x})")
    }
    /// A product.
    fn mul(&self, a: &str, b: &str) -> String {
        format!("{a} * {b}")
    }
    /// A quotient.
    fn div(&self, a: &str, b: &str) -> String {
        format!("{a} / {b}")
    }
    /// `a` with the other sign, as an operand.
    fn neg(&self, a: &str) -> String {
        format!("-{a}")
    }
    /// An expression as an operand of a tighter one.
    fn group(&self, a: &str) -> String {
        format!("({a})")
    }
    /// The result of a step.
    fn step(&self, number: usize) -> String {
        format!("v{number}")
    }
}

/// The program's steps as `(name, expression)`, and its outputs. Inputs, constants, negations and what is needed once are
/// written in place.
pub fn steps(program: &Program, dialect: &dyn Dialect) -> (Vec<(String, String)>, Vec<String>) {
    let writer = Writer { program, dialect };
    let steps = program.steps().map(|(number, op)| (dialect.step(number), writer.operation(op).0)).collect();
    (steps, program.outputs().iter().map(|&v| writer.operand(v).0).collect())
}

/// What binds an expression together, the loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    Sum,
    Product,
    Atom,
}

struct Writer<'a> {
    program: &'a Program,
    dialect: &'a dyn Dialect,
}

impl Writer<'_> {
    fn operation(&self, op: Op) -> (String, Binding) {
        let d = self.dialect;
        let at = |v: Value| self.operand(v).0;
        match op {
            // Grouped as it is computed, since sums and products round.
            Op::Add(a, b) => (format!("{} + {}", at(a), self.above(b, Binding::Sum)), Binding::Sum),
            Op::Sub(a, b) => (format!("{} - {}", at(a), self.above(b, Binding::Sum)), Binding::Sum),
            Op::Mul(a, b) => (d.mul(&self.above_sum(a), &self.above(b, Binding::Product)), Binding::Product),
            Op::Div(a, b) => (d.div(&self.above_sum(a), &self.above(b, Binding::Product)), Binding::Product),
            Op::Sqrt(a) => (d.sqrt(&at(a)), Binding::Atom),
            Op::SelectLess(a, b, c, d) => (self.dialect.select_less(&at(a), &at(b), &at(c), &at(d)), Binding::Atom),
            Op::Call(function, a) => (d.call(function, &at(a)), Binding::Atom),
            Op::Atan2(y, x) => (d.atan2(&at(y), &at(x)), Binding::Atom),
            Op::Input(i) => (d.input(i as usize), Binding::Atom),
            Op::Constant(c) => (d.constant(c.value()), Binding::Atom),
            Op::Tiny => (d.tiny(), Binding::Atom),
            Op::Neg(a) => (d.neg(&self.above(a, Binding::Product)), Binding::Atom),
        }
    }

    fn operand(&self, v: Value) -> (String, Binding) {
        match self.program.ops()[v.index()] {
            op @ (Op::Input(_) | Op::Constant(_) | Op::Tiny | Op::Neg(_)) => self.operation(op),
            op if self.program.is_inline(v) => self.operation(op),
            _ => (self.dialect.step(self.program.step_number(v)), Binding::Atom),
        }
    }

    /// The operand, in parentheses unless it binds more tightly.
    fn above(&self, v: Value, binding: Binding) -> String {
        let (text, own) = self.operand(v);
        if own > binding { text } else { self.dialect.group(&text) }
    }

    fn above_sum(&self, v: Value) -> String {
        self.above(v, Binding::Sum)
    }
}
