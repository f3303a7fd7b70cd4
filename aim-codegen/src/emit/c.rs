//! C99 back end: a function for each kernel and joint, or for each differentiated function. Needs only `math.h`.

use std::fmt::Write;

use aim_symbolic::print::steps;

use super::Rig;
use super::text::{self, Expressions, Language, Precision, Procedure};

/// Emits the source file of a rig's kernels.
#[must_use]
pub fn emit(rig: &Rig<'_>) -> String {
    let functions = rig.functions();
    let procedures: Vec<Procedure<'_>> =
        functions.iter().map(|function| text::procedure(function, rig.spec, &C)).collect();
    file(text::header(rig.spec), &procedures)
}

/// Emits the source file of these functions.
#[must_use]
pub fn emit_procedures(what: &str, procedures: &[Procedure<'_>]) -> String {
    file(vec![text::written(what)], procedures)
}

fn file(mut header: Vec<String>, procedures: &[Procedure<'_>]) -> String {
    header.push(
        "Inputs must be finite. The same bits as in Rust come of compiling without contraction (-ffp-contract=off)."
            .to_owned(),
    );
    let mut out = comment(&header);
    out += "#include <math.h>\n\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n";
    for procedure in procedures {
        write_function(&mut out, procedure);
    }
    out += "\n#ifdef __cplusplus\n}\n#endif\n";
    out
}

fn comment(lines: &[String]) -> String {
    format!("/* {} */\n", lines.join("\n * "))
}

fn write_function(out: &mut String, procedure: &Procedure<'_>) {
    let number = match procedure.precision {
        Precision::Single => "float",
        Precision::Double => "double",
    };
    let _ = write!(out, "\n{}void {}(", comment(&procedure.doc), procedure.name);
    let mut declared: Vec<String> = procedure
        .parameters
        .iter()
        .map(|(name, elements)| match elements {
            Some(elements) => format!("const {number} {name}[{elements}]"),
            None => format!("{number} {name}"),
        })
        .collect();
    declared.push(format!("{number} out[{}]", procedure.program.outputs().len()));
    // Leading arrays on the first line, the rest on the second.
    let arrays = procedure.parameters.iter().take_while(|(_, elements)| elements.is_some()).count().max(1);
    let _ = writeln!(out, "{},\n    {})\n{{", declared[..arrays].join(", "), declared[arrays..].join(", "));
    // Parameters may be unused.
    for (name, _) in &procedure.parameters {
        let _ = writeln!(out, "    (void){name};");
    }
    let (steps, outputs) = steps(procedure.program, &Expressions { procedure, language: &C });
    for (step, expression) in steps {
        let _ = writeln!(out, "    const {number} {step} = {expression};");
    }
    for (i, output) in outputs.iter().enumerate() {
        let _ = writeln!(out, "    out[{i}] = {output};");
    }
    *out += "}\n";
}

const C: Language = Language {
    target: "target",
    suffixes: ["f", ""],
    select_less: |a, b, then, otherwise| format!("{a} < {b} ? {then} : {otherwise}"),
    pow: |a, b, suffix| format!("pow{suffix}({a}, {b})"),
};
