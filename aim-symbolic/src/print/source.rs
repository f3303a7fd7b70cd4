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
    /// The result of a step.
    fn step(&self, number: usize) -> String {
        format!("v{number}")
    }
}

/// The program's steps as `(name, expression)`, and its outputs. Inputs, constants and negations are written in place.
pub fn steps(program: &Program, dialect: &dyn Dialect) -> (Vec<(String, String)>, Vec<String>) {
    let name = |v: Value| operand(program, dialect, v);
    let mut steps = Vec::new();
    for (number, op) in program.steps() {
        let expression = match op {
            Op::Input(_) | Op::Constant(_) | Op::Tiny | Op::Neg(_) => continue,
            Op::Add(a, b) => format!("{} + {}", name(a), name(b)),
            Op::Sub(a, b) => format!("{} - {}", name(a), name(b)),
            Op::Mul(a, b) => dialect.mul(&name(a), &name(b)),
            Op::Div(a, b) => dialect.div(&name(a), &name(b)),
            Op::Sqrt(a) => dialect.sqrt(&name(a)),
            Op::SelectLess(a, b, c, d) => dialect.select_less(&name(a), &name(b), &name(c), &name(d)),
            Op::Call(function, a) => dialect.call(function, &name(a)),
            Op::Atan2(y, x) => dialect.atan2(&name(y), &name(x)),
        };
        steps.push((dialect.step(number), expression));
    }
    (steps, program.outputs().iter().map(|&v| name(v)).collect())
}

fn operand(program: &Program, dialect: &dyn Dialect, v: Value) -> String {
    match program.ops()[v.index()] {
        Op::Input(i) => dialect.input(i as usize),
        Op::Constant(c) => dialect.constant(c.value()),
        Op::Tiny => dialect.tiny(),
        Op::Neg(a) => dialect.neg(&operand(program, dialect, a)),
        _ => dialect.step(program.step_number(v)),
    }
}
