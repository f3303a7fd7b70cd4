//! Maxima output: the program as a function that the computer algebra system can run, differentiate and check.

use super::source::{Dialect, steps};
use crate::{Function, Program};

/// Returns the program as a Maxima function of its inputs that returns the list of its outputs.
///
/// Guards are replaced by their regular branch, since Maxima computes with exact numbers.
#[must_use]
pub fn program(name: &str, program: &Program) -> String {
    let (steps, outputs) = steps(program, &Maxima { inputs: program.inputs() });
    let locals: Vec<&str> = steps.iter().map(|(name, _)| name.as_str()).collect();
    let lines: String = steps.iter().map(|(name, right)| format!("  {name}: {right},\n")).collect();
    format!(
        "{name}({}) := block([{}],\n{lines}  [{}])$\n",
        program.inputs().join(", "),
        locals.join(", "),
        outputs.join(", ")
    )
}

struct Maxima<'a> {
    inputs: &'a [String],
}

/// The text of the smallest length, which marks a guard. No other operand is written like this.
const TINY: &str = "(0)";

impl Dialect for Maxima<'_> {
    fn input(&self, index: usize) -> String {
        self.inputs[index].clone()
    }

    fn constant(&self, value: f64) -> String {
        format!("{value}")
    }

    fn tiny(&self) -> String {
        TINY.to_owned()
    }

    fn sqrt(&self, a: &str) -> String {
        format!("sqrt({a})")
    }

    fn select_less(&self, a: &str, b: &str, then: &str, otherwise: &str) -> String {
        if a == TINY { then.to_owned() } else { format!("(if {a} < {b} then {then} else {otherwise})") }
    }

    fn call(&self, function: Function, a: &str) -> String {
        let name = match function {
            Function::Ln => "log",
            other => other.name(),
        };
        format!("{name}({a})")
    }

    fn neg(&self, a: &str) -> String {
        format!("(-{a})")
    }
}
