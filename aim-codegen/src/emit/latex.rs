//! LaTeX: each objective as stated and as rewritten, then the steps of its program.

use std::fmt::Write;

use aim_symbolic::print::{self, Formula, Notation};
use aim_symbolic::{Graph, Program, Scalar};

use super::Rig;
use crate::objective::{ChainInputs, JointInputs, Objective, chain_aim, chain_residual, joint_aim, notation};

/// The document.
pub fn emit(rig: &Rig<'_>) -> String {
    let spec = rig.spec;
    let mut out = format!(
        "% Derivation of the rig {}, written by aim {}. Do not edit: generate again.\n\
         \\documentclass{{article}}\n\\usepackage{{amsmath}}\n\\allowdisplaybreaks\n\\begin{{document}}\n\
         \\section*{{{}}}\n",
        spec.name,
        env!("CARGO_PKG_VERSION"),
        text(&spec.name)
    );
    let aim_symbol = Formula::upright("aim");
    for (joint, program) in rig.programs.joints.iter().enumerate() {
        let mut g = Graph::new();
        let inputs = JointInputs::declare(&mut g);
        let aim = joint_aim(&mut g, spec, joint, &inputs);
        let title = format!("Joint {}: aim and its gradient", spec.joints[joint].name);
        let notation = notation(spec, Objective::Joint(joint));
        section(&mut out, &title, &mut g, &[(&aim_symbol, aim)], program, &notation);
    }
    let mut g = Graph::new();
    let inputs = ChainInputs::declare(&mut g, spec.joints.len());
    let aim = chain_aim(&mut g, spec, &inputs);
    let notation = notation(spec, Objective::ChainAim);
    let values = [(&aim_symbol, aim)];
    section(&mut out, "Chain: aim and its gradient", &mut g, &values, &rig.programs.chain_value_gradient, &notation);
    let [left, up] = chain_residual(&mut g, spec, &inputs);
    let [s_left, s_up] = ["left", "up"].map(|side| Formula::italic("s").indexed(Formula::upright(side)));
    let (title, program) = ("Chain: residual and its Jacobian", &rig.programs.chain_residual_jacobian);
    section(&mut out, title, &mut g, &[(&s_left, left), (&s_up, up)], program, &notation);
    out += "\\end{document}\n";
    out
}

fn section(
    out: &mut String,
    title: &str,
    g: &mut Graph,
    values: &[(&Formula, Scalar)],
    program: &Program,
    notation: &Notation,
) {
    let _ = writeln!(out, "\\subsection*{{{}}}\n{}.", text(title), program.count());
    for &(name, value) in values {
        let rewritten = g.rewrite(value);
        let _ = writeln!(
            out,
            "As stated:\n{}With every rotation moved to where it cancels or costs least:\n{}",
            equations(g, name, value, notation),
            equations(g, name, rewritten, notation)
        );
    }
    let _ =
        writeln!(out, "Step by step:\n\\begin{{align*}}\n{}\\end{{align*}}", print::latex_program(program, notation));
}

/// The value, after what is needed more than once in it.
fn equations(g: &Graph, name: &Formula, value: Scalar, notation: &Notation) -> String {
    let defined = print::defined(g, &[value], notation);
    let mut equations = defined.equations(g);
    equations.push((name.clone(), print::scalar(g, value, &defined.notation)));
    let lines: Vec<String> =
        equations.iter().map(|(left, right)| format!("{} &= {}", print::latex(left), print::latex(right))).collect();
    format!("\\begin{{align*}}\n{}\n\\end{{align*}}\n", lines.join(" \\\\\n"))
}

fn text(plain: &str) -> String {
    plain.replace('_', r"\_")
}
