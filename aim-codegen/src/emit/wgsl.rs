//! WGSL: a function for each kernel and joint, in `f32`, as a module of its own without an entry point.
//!
//! Inputs and results are arrays by value in the order of C's, so that what is packed for one serves the other. A step is
//! a `let`, which WGSL never evaluates while compiling: there, an overflow that a guard takes out would be an error.

use std::fmt::Write;

use aim_symbolic::print::steps;

use super::Rig;
use super::text::{self, Expressions, Parameters, Target};
use crate::objective::Function;

/// The module.
pub fn emit(rig: &Rig<'_>) -> String {
    let mut header = text::header(rig.spec);
    header.push("Lengths are in any one unit, derivatives per radian. Inputs must be finite.".to_owned());
    let mut out = comment(&header);
    for function in rig.functions() {
        write_function(&mut out, rig, &function);
    }
    out
}

fn comment(lines: &[String]) -> String {
    lines.iter().map(|line| format!("// {line}\n")).collect()
}

fn write_function(out: &mut String, rig: &Rig<'_>, function: &Function<'_>) {
    let program = &function.kernel.program;
    let parameters = Parameters::of(function.kernel.objective.scope, rig.spec);
    let _ = writeln!(out, "\n{}fn {}(", comment(&text::doc(function, rig.spec, TARGET)), function.name(rig.spec));
    for (name, elements) in parameters.list(TARGET.name) {
        let _ = writeln!(out, "    {name}: {},", elements.map_or_else(|| "f32".to_owned(), array));
    }
    let result = array(program.outputs().len());
    let _ = writeln!(out, ") -> {result} {{");
    let expressions = Expressions {
        parameters,
        target: TARGET,
        suffix: "",
        select_less: |a, b, then, otherwise| format!("select({otherwise}, {then}, {a} < {b})"),
    };
    let (steps, outputs) = steps(program, &expressions);
    for (step, expression) in steps {
        let _ = writeln!(out, "    let {step} = {expression};");
    }
    let _ = writeln!(out, "    return {result}(");
    for output in outputs {
        let _ = writeln!(out, "        {output},");
    }
    *out += "    );\n}\n";
}

fn array(length: usize) -> String {
    format!("array<f32, {length}>")
}

/// `target` alone is a word that WGSL reserves.
const TARGET: Target = Target { name: "target_point", again: "it" };
