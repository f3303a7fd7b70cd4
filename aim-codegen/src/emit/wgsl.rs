//! WGSL back end: a function for each kernel and joint, or for each differentiated function, in `f32`. The result is a
//! module of its own, without an entry point.
//!
//! Inputs and results are arrays by value, in the same order as in C, so that data packed for one serves the other.
//! Each step is a `let` declaration, which WGSL does not evaluate at shader creation; there, an overflow that a guard
//! discards would be an error.

use std::fmt::Write;

use aim_symbolic::print::steps;

use super::Rig;
use super::text::{self, Expressions, Language, Procedure};

/// Emits the module of a rig's kernels.
#[must_use]
pub fn emit(rig: &Rig<'_>) -> String {
    let functions = rig.functions();
    let procedures: Vec<Procedure<'_>> =
        functions.iter().map(|function| text::procedure(function, rig.spec, &WGSL)).collect();
    let mut header = text::header(rig.spec);
    header.push("Lengths are in any one unit, derivatives per radian. Inputs must be finite.".to_owned());
    module(&header, &procedures)
}

/// Emits the module of these functions, which compute in single precision.
#[must_use]
pub fn emit_procedures(what: &str, procedures: &[Procedure<'_>]) -> String {
    module(&[text::written(what), "Inputs must be finite.".to_owned()], procedures)
}

fn module(header: &[String], procedures: &[Procedure<'_>]) -> String {
    let mut out = comment(header);
    for procedure in procedures {
        write_function(&mut out, procedure);
    }
    out
}

fn comment(lines: &[String]) -> String {
    lines.iter().map(|line| format!("// {line}\n")).collect()
}

fn write_function(out: &mut String, procedure: &Procedure<'_>) {
    let _ = writeln!(out, "\n{}fn {}(", comment(&procedure.doc), procedure.name);
    for (name, elements) in &procedure.parameters {
        let _ = writeln!(out, "    {name}: {},", elements.map_or_else(|| "f32".to_owned(), array));
    }
    let result = array(procedure.program.outputs().len());
    let _ = writeln!(out, ") -> {result} {{");
    let (steps, outputs) = steps(procedure.program, &Expressions { procedure, language: &WGSL });
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

const WGSL: Language = Language {
    target: "target_point",
    suffixes: ["", ""],
    select_less: |a, b, then, otherwise| format!("select({otherwise}, {then}, {a} < {b})"),
    // WGSL's `pow` is exp2(b log2(a)), which is undefined for a ≤ 0 even if b is a whole number.
    pow: |a, b, _| {
        if b.trim_end_matches('f').parse::<f64>().is_ok_and(|b| b.fract() != 0.0) {
            return format!("pow({a}, {b})");
        }
        let size = format!("pow(abs({a}), {b})");
        let whole = format!("select({size}, -{size}, abs({b}) % 2.0f == 1.0f)");
        let power = format!("select(pow({a}, {b}), {whole}, ({a} < 0.0f) & (floor({b}) == {b}))");
        format!("select({power}, 1.0f, {b} == 0.0f)")
    },
};
