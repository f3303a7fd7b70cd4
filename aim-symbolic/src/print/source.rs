//! Programs as infix source text, shared by all back ends that write strings.

use super::steps::{Printer, ProgramWriter};
use crate::{Function, Op, Program};

/// The syntax in which languages differ.
pub trait Dialect {
    /// Returns the input with this index.
    fn input(&self, index: usize) -> String;
    /// Returns a constant.
    fn constant(&self, value: f64) -> String;
    /// Returns the smallest length by which a guarded division divides.
    fn tiny(&self) -> String;
    /// Returns a square root.
    fn sqrt(&self, a: &str) -> String;
    /// Returns `then` if `a < b`, else `otherwise`.
    fn select_less(&self, a: &str, b: &str, then: &str, otherwise: &str) -> String;
    /// Returns a call of a function of the mathematics library.
    fn call(&self, function: Function, a: &str) -> String {
        format!("{}({a})", function.name())
    }
    /// Returns the angle of the point (`x`, `y`).
    fn atan2(&self, y: &str, x: &str) -> String {
        format!("atan2({y}, {x})")
    }

    /// Returns `a` to the power `b`.
    fn pow(&self, a: &str, b: &str) -> String {
        format!("pow({a}, {b})")
    }
    /// Returns `−a`, as an operand.
    fn neg(&self, a: &str) -> String {
        format!("-{a}")
    }
}

/// Returns the program's steps as `(name, expression)`, and its outputs.
pub fn steps(program: &Program, dialect: &dyn Dialect) -> (Vec<(String, String)>, Vec<String>) {
    let source = Source(dialect);
    let written = ProgramWriter { program, printer: &source };
    (written.steps().map(|(number, text)| (source.step(number), text)).collect(), written.outputs())
}

/// Adapts a dialect to [`Printer`].
struct Source<'a>(&'a dyn Dialect);

impl Printer for Source<'_> {
    type Text = String;

    fn operation(&self, op: Op<String>) -> String {
        let dialect = self.0;
        match op {
            Op::Add(a, b) => format!("{a} + {b}"),
            Op::Sub(a, b) => format!("{a} - {b}"),
            Op::Mul(a, b) => format!("{a} * {b}"),
            Op::Div(a, b) => format!("{a} / {b}"),
            Op::Sqrt(a) => dialect.sqrt(&a),
            Op::SelectLess(a, b, then, otherwise) => dialect.select_less(&a, &b, &then, &otherwise),
            Op::Call(function, a) => dialect.call(function, &a),
            Op::Atan2(y, x) => dialect.atan2(&y, &x),
            Op::Pow(a, b) => dialect.pow(&a, &b),
            Op::Input(i) => dialect.input(i as usize),
            Op::Constant(c) => dialect.constant(c.value()),
            Op::Tiny => dialect.tiny(),
            Op::Neg(a) => dialect.neg(&a),
        }
    }

    fn group(&self, operand: String) -> String {
        format!("({operand})")
    }

    fn step(&self, number: usize) -> String {
        format!("v{number}")
    }
}
