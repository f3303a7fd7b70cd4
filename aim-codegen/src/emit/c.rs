//! C: one function a joint and two for the chain, in float, with nothing but `sqrtf` of the library.

use std::fmt::Write;

use aim_symbolic::print::{Dialect, steps};
use aim_symbolic::{Function, Program};

use super::Rig;
use super::inputs::{Inputs, TINY, library_name, literal};
use crate::names::snake_case;

/// The source file.
pub fn emit(rig: &Rig<'_>) -> String {
    let name = snake_case(&rig.spec.name);
    let joints = rig.spec.joints.len();
    let mut out = String::new();
    header(&mut out, rig);
    for (joint, program) in rig.spec.joints.iter().zip(&rig.programs.joints) {
        let signature = format!(
            "void {name}_{}_aim_gradient(const float effector_to_joint[12], const float target[3],\n    \
             float sin_p, float cos_p, float sin_h, float cos_h, float out[3])",
            snake_case(&joint.name)
        );
        let doc = format!(
            "Aim of joint {}, d aim / d pitch, d aim / d heading.\n \
             * effector_to_joint: rows m0, m1, m2 of the 3x3, then the translation (row vectors, rigid);\n \
             * target in the joint's space; zeros where the target is on the effector.",
            joint.name
        );
        function(&mut out, &doc, &signature, program, Inputs::Joint);
    }
    let chain_inputs =
        format!("const float links[{}], const float target[3], const float sin_cos[{}]", 12 * joints, 4 * joints);
    let layout = "links: effector to joint 0, then joint i-1 to joint i; target in the last joint's space;\n \
                  * sin_cos: sin_p, cos_p, sin_h, cos_h per joint from the effector inward.";
    let angles = rig.spec.angles();
    function(
        &mut out,
        &format!("The chain's aim, then its {angles} derivatives, pitch before heading, joint by joint.\n * {layout}"),
        &format!("void {name}_chain_value_gradient({chain_inputs},\n    float out[{}])", 1 + angles),
        &rig.programs.chain_value_gradient,
        Inputs::Chain { joints },
    );
    function(
        &mut out,
        &format!(
            "The chain's stereographic residual (left, up), then the {angles} derivatives of the first and of the \
             second.\n * {layout}"
        ),
        &format!("void {name}_chain_residual_jacobian({chain_inputs},\n    float out[{}])", 2 + 2 * angles),
        &rig.programs.chain_residual_jacobian,
        Inputs::Chain { joints },
    );
    out += "\n#ifdef __cplusplus\n}\n#endif\n";
    out
}

fn header(out: &mut String, rig: &Rig<'_>) {
    let spec = rig.spec;
    let _ = write!(
        out,
        "/* Aim solver kernels of the rig {}, derived and written by aim {}. Do not edit: generate again.\n \
         * Pitch turns a joint's forward towards its up, heading towards its left; pitch acts first.\n",
        spec.name,
        env!("CARGO_PKG_VERSION")
    );
    for joint in &spec.joints {
        let frame = joint.frame;
        let _ =
            writeln!(out, " * {}: up {:?}, forward {:?}, left {:?}", joint.name, frame.up, frame.forward, frame.left);
    }
    *out += " * Inputs must be finite. The same bits as in Rust come of compiling without contraction (-ffp-contract=off). */\n#include <math.h>\n\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n";
}

fn function(out: &mut String, doc: &str, signature: &str, program: &Program, inputs: Inputs) {
    let _ = writeln!(out, "\n/* {doc}\n * {}. */\n{signature}\n{{", program.count());
    for parameter in parameters(inputs) {
        let _ = writeln!(out, "    (void){parameter};");
    }
    let (steps, outputs) = steps(program, &C(inputs));
    for (step, expression) in steps {
        let _ = writeln!(out, "    const float {step} = {expression};");
    }
    for (i, output) in outputs.iter().enumerate() {
        let _ = writeln!(out, "    out[{i}] = {output};");
    }
    *out += "}\n";
}

/// The parameters, any of which a program may leave unused.
fn parameters(inputs: Inputs) -> &'static [&'static str] {
    match inputs {
        Inputs::Joint => &["effector_to_joint", TARGET, "sin_p", "cos_p", "sin_h", "cos_h"],
        Inputs::Chain { .. } => &["links", TARGET, "sin_cos"],
    }
}

const TARGET: &str = "target";

struct C(Inputs);

impl Dialect for C {
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
        format!("sqrtf({a})")
    }

    fn select_less(&self, a: &str, b: &str, then: &str, otherwise: &str) -> String {
        format!("{a} < {b} ? {then} : {otherwise}")
    }

    fn call(&self, function: Function, a: &str) -> String {
        format!("{}f({a})", library_name(function))
    }

    fn atan2(&self, y: &str, x: &str) -> String {
        format!("atan2f({y}, {x})")
    }
}
