//! Maxima: the program as a function that the computer algebra system can run, differentiate and check.

use crate::{Op, Program, Value};

/// The program as a Maxima function of its inputs, returning the list of its outputs.
///
/// Guards become their regular branch: Maxima's numbers are exact.
pub fn program(name: &str, program: &Program) -> String {
    let operand = |v: Value| operand(program, v);
    let mut locals = Vec::new();
    let mut steps = Vec::new();
    for (number, op) in program.steps() {
        let right = match op {
            Op::Input(_) | Op::Constant(_) | Op::Tiny | Op::Neg(_) => continue,
            Op::Add(a, b) => format!("{} + {}", operand(a), operand(b)),
            Op::Sub(a, b) => format!("{} - {}", operand(a), operand(b)),
            Op::Mul(a, b) => format!("{} * {}", operand(a), operand(b)),
            Op::Div(a, b) => format!("{} / {}", operand(a), operand(b)),
            Op::Sqrt(a) => format!("sqrt({})", operand(a)),
            Op::SelectLess(_, _, regular, _) => operand(regular),
        };
        locals.push(format!("v{number}"));
        steps.push(format!("  v{number}: {right},\n"));
    }
    let outputs: Vec<String> = program.outputs().iter().map(|&v| operand(v)).collect();
    format!(
        "{name}({}) := block([{}],\n{}  [{}])$\n",
        program.inputs().join(", "),
        locals.join(", "),
        steps.concat(),
        outputs.join(", ")
    )
}

fn operand(program: &Program, v: Value) -> String {
    match program.ops()[v.index()] {
        Op::Input(i) => program.inputs()[i as usize].clone(),
        Op::Constant(c) => format!("{}", c.value()),
        Op::Tiny => "0".to_owned(),
        Op::Neg(a) => format!("(-{})", operand(program, a)),
        _ => format!("v{}", program.step_number(v)),
    }
}
