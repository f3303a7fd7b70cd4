//! LaTeX: each objective as stated and as rewritten, then the steps of its program.

use std::fmt::Write;

use aim_symbolic::{Graph, Program, Scalar, print};

use super::Rig;
use crate::objective::{ChainInputs, JointInputs, chain_aim, chain_residual, joint_aim};

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
    for (joint, program) in rig.programs.joints.iter().enumerate() {
        let mut g = Graph::new();
        let inputs = JointInputs::declare(&mut g);
        let aim = joint_aim(&mut g, spec, joint, &inputs);
        let title = format!("Joint {}: aim and its gradient", spec.joints[joint].name);
        section(&mut out, &title, &mut g, &[(r"\mathrm{aim}", aim)], program);
    }
    let mut g = Graph::new();
    let inputs = ChainInputs::declare(&mut g, spec.joints.len());
    let aim = chain_aim(&mut g, spec, &inputs);
    section(
        &mut out,
        "Chain: aim and its gradient",
        &mut g,
        &[(r"\mathrm{aim}", aim)],
        &rig.programs.chain_value_gradient,
    );
    let [left, up] = chain_residual(&mut g, spec, &inputs);
    let values = [(r"s_{\mathrm{left}}", left), (r"s_{\mathrm{up}}", up)];
    section(&mut out, "Chain: residual and its Jacobian", &mut g, &values, &rig.programs.chain_residual_jacobian);
    out += "\\end{document}\n";
    out
}

fn section(out: &mut String, title: &str, g: &mut Graph, values: &[(&str, Scalar)], program: &Program) {
    let _ = writeln!(out, "\\subsection*{{{}}}\n{}.", text(title), program.count());
    for &(name, value) in values {
        let rewritten = g.rewrite(value);
        let _ = writeln!(
            out,
            "As stated:\n\\begin{{multline*}}\n{name} = {}\n\\end{{multline*}}\n\
             With every rotation moved to where it cancels or costs least:\n\
             \\begin{{multline*}}\n{name} = {}\n\\end{{multline*}}",
            print::latex_scalar(g, value),
            print::latex_scalar(g, rewritten)
        );
    }
    let _ = writeln!(out, "Step by step:\n\\begin{{align*}}\n{}\\end{{align*}}", print::latex(program));
}

fn text(plain: &str) -> String {
    plain.replace('_', r"\_")
}
