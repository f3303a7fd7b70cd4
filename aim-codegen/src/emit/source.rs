//! What the back ends for C-like languages share: operations as infix source text.

use aim_symbolic::{Op, Program, Value};

/// How a language writes what the languages write differently.
pub(super) trait Dialect {
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
}

/// The program's steps as `(number, expression)`, and its outputs. Inputs, constants and negations are written in place.
pub(super) fn steps(program: &Program, dialect: &dyn Dialect) -> (Vec<(usize, String)>, Vec<String>) {
    let name = |v: Value| operand(program, dialect, v);
    let mut steps = Vec::new();
    for (number, op) in program.steps() {
        let expression = match op {
            Op::Input(_) | Op::Constant(_) | Op::Tiny | Op::Neg(_) => continue,
            Op::Add(a, b) => format!("{} + {}", name(a), name(b)),
            Op::Sub(a, b) => format!("{} - {}", name(a), name(b)),
            Op::Mul(a, b) => format!("{} * {}", name(a), name(b)),
            Op::Div(a, b) => format!("{} / {}", name(a), name(b)),
            Op::Sqrt(a) => dialect.sqrt(&name(a)),
            Op::SelectLess(a, b, c, d) => dialect.select_less(&name(a), &name(b), &name(c), &name(d)),
        };
        steps.push((number, expression));
    }
    (steps, program.outputs().iter().map(|&v| name(v)).collect())
}

fn operand(program: &Program, dialect: &dyn Dialect, v: Value) -> String {
    match program.ops()[v.index()] {
        Op::Input(i) => dialect.input(i as usize),
        Op::Constant(c) => dialect.constant(c.value()),
        Op::Tiny => dialect.tiny(),
        Op::Neg(a) => format!("-{}", operand(program, dialect, a)),
        _ => format!("v{}", program.step_number(v)),
    }
}
