//! `aim generate`: the solver as source text.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use aim_codegen::emit::{self, Rig};
use aim_codegen::objective::functions;
use aim_codegen::{RigSpec, kernels};
use quote::quote;

use crate::args::{self, Language};
use crate::explain;
use crate::failure::{Failure, Result};
use crate::files;
use crate::outputs::Outputs;

pub(super) fn run(arguments: &args::Generate) -> Result {
    let spec = files::load_rig(&arguments.rig)?;
    let code = match arguments.lang {
        Some(language) => emit(&spec, language),
        None => trace(&spec),
    };
    if let Some(existing) = &arguments.check {
        return check(existing, &code, arguments);
    }
    match &arguments.output {
        Some(path) => {
            Outputs::reading([(Some(&arguments.rig), "the rig itself")]).writes(path, "-o")?;
            files::write(path, code.as_bytes())
        }
        None => files::print(&code),
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

/// The book-keeping of the derivation: operation counts, and the rules that brought them down.
fn trace(spec: &RigSpec) -> String {
    let mut out = format!(
        "{}: operations if rewriting stopped there and derivatives were taken of what was there (sines and cosines given)\n",
        spec.name
    );
    let kernels = kernels(spec);
    for function in functions(&kernels) {
        let kernel = function.kernel;
        // Equal kernels once.
        if function.joint.is_some_and(|joint| joint != kernel.joints[0]) {
            continue;
        }
        let _ = writeln!(out, "\n{}: {}", function.subject(spec), kernel.objective.title);
        for (i, step) in kernel.statement(spec).derivation().steps.iter().enumerate() {
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
    }
    out
}

/// The solver in Rust, formatted.
fn rust(rig: &Rig<'_>) -> String {
    let tokens = emit::rust::emit_with_struct(rig, &emit::rust::Item::of(rig.spec, quote!(::aim)));
    let header = format!(
        "// The rig {}, derived and written by aim {}. Do not edit: generate again.\n",
        rig.spec.name,
        env!("CARGO_PKG_VERSION")
    );
    header + &aim_codegen::format_rust(tokens)
}

/// Whether `existing` holds `code`, line ends aside.
fn check(existing: &Path, code: &str, arguments: &args::Generate) -> Result {
    let found = fs::read_to_string(existing)
        .map_err(|error| Failure::in_file(existing, format!("cannot be read ({error}); generate it first with -o")))?;
    if found.lines().eq(code.lines()) {
        return Ok(());
    }
    let language = arguments.lang.map(|language| format!("{language:?}").to_lowercase()).unwrap_or_default();
    Err(Failure::Check(format!(
        "{} is stale: it is not what {} gives now. Write it again:\n  aim generate {} --lang {language} -o {}",
        existing.display(),
        arguments.rig.display(),
        arguments.rig.display(),
        existing.display()
    )))
}
