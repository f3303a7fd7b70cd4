//! WGSL: one function a joint and two for the chain, in `f32`, as a module of its own without an entry point.
//!
//! Inputs and results are arrays by value in the order of C's, so that what is packed for one serves the other. A step is
//! a `let`, which WGSL never evaluates while compiling: there, an overflow that a guard takes out would be an error.

use std::fmt::Write;

use aim_symbolic::print::{Dialect, steps};
use aim_symbolic::{Function, Program};

use super::Rig;
use super::inputs::{Inputs, TINY, library_name, literal};
use crate::names::snake_case;

/// The module.
pub fn emit(rig: &Rig<'_>) -> String {
    let name = snake_case(&rig.spec.name);
    let joints = rig.spec.joints.len();
    let mut out = String::new();
    header(&mut out, rig);
    for (joint, program) in rig.spec.joints.iter().zip(&rig.programs.joints) {
        let doc = format!(
            "Aim of joint {}, d aim / d pitch, d aim / d heading.\n\
             effector_to_joint: rows m0, m1, m2 of the 3x3, then the translation (row vectors, rigid);\n\
             target_point in the joint's space; zeros where it is on the effector.",
            joint.name
        );
        let function = format!("{name}_{}_aim_gradient", snake_case(&joint.name));
        write_function(&mut out, &doc, &function, program, Inputs::Joint);
    }
    let layout = "links: effector to joint 0, then joint i-1 to joint i; target_point in the last joint's space;\n\
                  sin_cos: sin_p, cos_p, sin_h, cos_h per joint from the effector inward.";
    let angles = rig.spec.angles();
    write_function(
        &mut out,
        &format!("The chain's aim, then its {angles} derivatives, pitch before heading, joint by joint.\n{layout}"),
        &format!("{name}_chain_value_gradient"),
        &rig.programs.chain_value_gradient,
        Inputs::Chain { joints },
    );
    write_function(
        &mut out,
        &format!(
            "The chain's stereographic residual (left, up), then the {angles} derivatives of the first and of the \
             second.\n{layout}"
        ),
        &format!("{name}_chain_residual_jacobian"),
        &rig.programs.chain_residual_jacobian,
        Inputs::Chain { joints },
    );
    out
}

fn header(out: &mut String, rig: &Rig<'_>) {
    let spec = rig.spec;
    let _ = write!(
        out,
        "// Aim solver kernels of the rig {}, derived and written by aim {}. Do not edit: generate again.\n\
         // Pitch turns a joint's forward towards its up, heading towards its left; pitch acts first.\n",
        spec.name,
        env!("CARGO_PKG_VERSION")
    );
    for joint in &spec.joints {
        let frame = joint.frame;
        let _ =
            writeln!(out, "// {}: up {:?}, forward {:?}, left {:?}", joint.name, frame.up, frame.forward, frame.left);
    }
    *out += "// Lengths are in any one unit, derivatives per radian. Inputs must be finite.\n";
}

fn write_function(out: &mut String, doc: &str, name: &str, program: &Program, inputs: Inputs) {
    out.push('\n');
    for line in doc.lines() {
        let _ = writeln!(out, "// {line}");
    }
    let _ = writeln!(out, "// {}.\nfn {name}(", program.count());
    for (parameter, kind) in parameters(inputs) {
        let _ = writeln!(out, "    {parameter}: {kind},");
    }
    let result = array(program.outputs().len());
    let _ = writeln!(out, ") -> {result} {{");
    let (steps, outputs) = steps(program, &Wgsl(inputs));
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

/// Names and types. `target` alone is a word that WGSL reserves.
fn parameters(inputs: Inputs) -> Vec<(&'static str, String)> {
    match inputs {
        Inputs::Joint => {
            let angles = ["sin_p", "cos_p", "sin_h", "cos_h"].map(|name| (name, "f32".to_owned()));
            [("effector_to_joint", array(12)), (TARGET, array(3))].into_iter().chain(angles).collect()
        }
        Inputs::Chain { joints } => {
            vec![("links", array(12 * joints)), (TARGET, array(3)), ("sin_cos", array(4 * joints))]
        }
    }
}

const TARGET: &str = "target_point";

struct Wgsl(Inputs);

impl Dialect for Wgsl {
    fn input(&self, index: usize) -> String {
        self.0.name(index, TARGET)
    }

    fn constant(&self, value: f64) -> String {
        literal(value)
    }

    fn tiny(&self) -> String {
        TINY.to_owned()
    }

    fn sqrt(&self, a: &str) -> String {
        format!("sqrt({a})")
    }

    fn select_less(&self, a: &str, b: &str, then: &str, otherwise: &str) -> String {
        format!("select({otherwise}, {then}, {a} < {b})")
    }

    fn call(&self, function: Function, a: &str) -> String {
        format!("{}({a})", library_name(function))
    }
}
