//! C: a function for each kernel and joint, in float, with nothing but `sqrtf` of the library.

use std::fmt::Write;

use aim_symbolic::print::steps;

use super::Rig;
use super::text::{self, Expressions, Parameters, Target};
use crate::objective::{Function, Scope};

/// The source file.
pub fn emit(rig: &Rig<'_>) -> String {
    let mut header = text::header(rig.spec);
    header.push(
        "Inputs must be finite. The same bits as in Rust come of compiling without contraction (-ffp-contract=off)."
            .to_owned(),
    );
    let mut out = comment(&header);
    out += "#include <math.h>\n\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n";
    for function in rig.functions() {
        write_function(&mut out, rig, &function);
    }
    out += "\n#ifdef __cplusplus\n}\n#endif\n";
    out
}

fn comment(lines: &[String]) -> String {
    format!("/* {} */\n", lines.join("\n * "))
}

fn write_function(out: &mut String, rig: &Rig<'_>, function: &Function<'_>) {
    let program = &function.kernel.program;
    let scope = function.kernel.objective.scope;
    let parameters = Parameters::of(scope, rig.spec);
    let _ = write!(out, "\n{}void {}(", comment(&text::doc(function, rig.spec, TARGET)), function.name(rig.spec));
    let declared: Vec<String> = parameters
        .list(TARGET.name)
        .into_iter()
        .map(|(name, elements)| match elements {
            Some(elements) => format!("const float {name}[{elements}]"),
            None => format!("float {name}"),
        })
        .collect();
    // Arrays of a joint in the first line, numbers in the second.
    let first_line = if scope == Scope::Joint { 2 } else { declared.len() };
    let result = format!("float out[{}]", program.outputs().len());
    let second_line: Vec<&str> = declared[first_line..].iter().chain([&result]).map(String::as_str).collect();
    let _ = writeln!(out, "{},\n    {})\n{{", declared[..first_line].join(", "), second_line.join(", "));
    // Any of them may be unused.
    for (name, _) in parameters.list(TARGET.name) {
        let _ = writeln!(out, "    (void){name};");
    }
    let expressions = Expressions {
        parameters,
        target: TARGET,
        suffix: "f",
        select_less: |a, b, then, otherwise| format!("{a} < {b} ? {then} : {otherwise}"),
    };
    let (steps, outputs) = steps(program, &expressions);
    for (step, expression) in steps {
        let _ = writeln!(out, "    const float {step} = {expression};");
    }
    for (i, output) in outputs.iter().enumerate() {
        let _ = writeln!(out, "    out[{i}] = {output};");
    }
    *out += "}\n";
}

const TARGET: Target = Target { name: "target", again: "the target" };
