//! `aim generate`: emits a rig's solver, or a differentiated function, as source code.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use aim_codegen::emit::{self, Precision, Rig};
use aim_codegen::objective::{functions, notation};
use aim_codegen::{Differentiated, RigSpec, kernels};
use aim_symbolic::print::{self, Notation};
use aim_symbolic::{Derivation, Singular};
use quote::quote;

use crate::args::{self, Language};
use crate::explain;
use crate::failure::{Failure, Result};
use crate::files;
use crate::outputs::Outputs;

pub(super) fn run(arguments: &args::Generate) -> Result {
    let code = match (&arguments.function, arguments.lang) {
        (Some(function), Some(language)) => differentiated(&arguments.rig, function, language)?,
        (Some(function), None) => trace_of(&arguments.rig, function)?,
        (None, Some(language)) => emit(&files::load_rig(&arguments.rig)?, language),
        (None, None) => trace(&files::load_rig(&arguments.rig)?),
    };
    if let Some(existing) = &arguments.check {
        return check(existing, &code, arguments);
    }
    match &arguments.output {
        Some(path) => {
            Outputs::reading([(
                Some(&arguments.rig),
                if arguments.function.is_some() { "the input" } else { "the rig" },
            )])
            .writes(path, "-o")?;
            files::write(path, code.as_bytes())
        }
        None => files::print(&code),
    }
}

fn load_function(path: &Path, function: &str) -> Result<Differentiated> {
    let text = files::read_text(path, "expected a Rust file")?;
    Ok(Differentiated::from_file(&path.display().to_string(), &text, function)?)
}

/// Returns the source code of a function of a Rust file and of its derivatives.
fn differentiated(path: &Path, function: &str, language: Language) -> Result<String> {
    let derived = load_function(path, function)?;
    let what = format!("The derivatives of {function}");
    match language {
        Language::C => Ok(emit::c::emit_procedures(&what, &derived.procedures())),
        Language::Wgsl if derived.precision() == Precision::Double => {
            Err(Failure::in_file(path, format!("{function} uses f64, which WGSL does not have; write it in f32")))
        }
        Language::Wgsl if derived.has_infinities() => Err(Failure::in_file(
            path,
            format!("{function} contains an infinity, which WGSL cannot express; use f32::MAX"),
        )),
        Language::Wgsl => Ok(emit::wgsl::emit_procedures(&what, &derived.procedures())),
        Language::Rust => Err(Failure::in_file(
            path,
            "#[differentiate] already generates the Rust code in place; use --lang c or wgsl",
        )),
        Language::Latex | Language::Maxima => {
            Err(Failure::in_file(path, "functions can be generated in C and WGSL only; use --lang c or wgsl"))
        }
    }
}

fn emit(spec: &RigSpec, language: Language) -> String {
    let kernels = kernels(spec);
    let rig = Rig { spec, kernels: &kernels };
    match language {
        Language::C => emit::c::emit(&rig),
        Language::Wgsl => emit::wgsl::emit(&rig),
        Language::Latex => explain::latex(&explain::formulas(&rig)),
        Language::Maxima => emit::maxima::emit(&rig),
        Language::Rust => rust(&rig),
    }
}

/// Returns the trace of a rig's derivation: operation counts, and the rules that lowered them.
fn trace(spec: &RigSpec) -> String {
    let mut out = heading(&spec.name);
    let kernels = kernels(spec);
    for function in functions(&kernels) {
        let kernel = function.kernel;
        // A kernel that several joints share is listed once.
        if function.joint.is_some_and(|joint| joint != kernel.joints[0]) {
            continue;
        }
        let _ = writeln!(out, "\n{}: {}", function.subject(spec), kernel.objective.title);
        out += &steps(&kernel.statement(spec).derivation(), &notation(spec, kernel.objective.scope));
    }
    out
}

/// Returns the trace of the derivation of a function of a Rust file.
fn trace_of(path: &Path, function: &str) -> Result<String> {
    let derived = load_function(path, function)?;
    Ok(format!("{}\n{}", heading(function), steps(&derived.derivation(), &derived.notation())))
}

fn heading(name: &str) -> String {
    format!("{name}: operation count after each step, derivatives included (sines and cosines are inputs)\n")
}

/// Returns the steps of a derivation and the singular points of its statement, one per line.
fn steps(derivation: &Derivation, notation: &Notation) -> String {
    let mut out = String::new();
    for (i, step) in derivation.steps.iter().enumerate() {
        if i == 0 {
            let _ = writeln!(out, "{:>6}  as stated", step.before.total());
        }
        let rules: Vec<String> = step
            .rules
            .iter()
            .map(|(rule, times)| if *times > 1 { format!("{rule} (x{times})") } else { rule.to_string() })
            .collect();
        let _ = writeln!(out, "{:>6}  {}", step.after.total(), rules.join(", "));
    }
    for Singular { at, convention } in &derivation.singular {
        let at = print::text(&print::condition(&derivation.graph, *at, notation));
        let _ = writeln!(out, "singular where {at}: {convention}");
    }
    out
}

/// Returns the solver as formatted Rust code.
fn rust(rig: &Rig<'_>) -> String {
    let tokens = emit::rust::emit_with_struct(rig, &emit::rust::Item::of(rig.spec, quote!(::aim)));
    let header = format!(
        "// The rig {}, derived and written by aim {}. Do not edit: generate again.\n",
        rig.spec.name,
        env!("CARGO_PKG_VERSION")
    );
    header + &aim_codegen::format_rust(tokens)
}

/// Checks that the file `existing` contains `code`, apart from line endings.
fn check(existing: &Path, code: &str, arguments: &args::Generate) -> Result {
    let found = fs::read_to_string(existing)
        .map_err(|error| Failure::in_file(existing, format!("cannot read: {error}; generate it first with -o")))?;
    if found.lines().eq(code.lines()) {
        return Ok(());
    }
    let language = arguments.lang.map(|language| format!("{language:?}").to_lowercase()).unwrap_or_default();
    let function = arguments.function.as_ref().map(|name| format!(" --function {name}")).unwrap_or_default();
    Err(Failure::Check(format!(
        "{} is stale: it differs from what {} generates now. Regenerate it:\n  aim generate {}{function} --lang {language} -o {}",
        existing.display(),
        arguments.rig.display(),
        arguments.rig.display(),
        existing.display()
    )))
}
