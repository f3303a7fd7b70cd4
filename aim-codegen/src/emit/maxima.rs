//! Maxima: the derived programs as functions, and the check that they are what they claim to be.

use std::fmt::Write;

use aim_symbolic::print;

use super::Rig;
use crate::names::snake_case;

/// The batch file.
pub fn emit(rig: &Rig<'_>) -> String {
    let name = snake_case(&rig.spec.name);
    let mut out = format!(
        "/* Programs of the rig {}, written by aim {}. Do not edit: generate again.\n   \
         Each function returns its outputs as a list; sines and cosines are arguments of their own. */\n",
        rig.spec.name,
        env!("CARGO_PKG_VERSION")
    );
    for (joint, program) in rig.spec.joints.iter().zip(&rig.programs.joints) {
        let _ = writeln!(out, "\n/* aim, d aim / d pitch, d aim / d heading; {}. */", program.count());
        out += &print::maxima(&format!("{name}_{}_aim_gradient", snake_case(&joint.name)), program);
    }
    let chain = &rig.programs.chain_value_gradient;
    let _ =
        writeln!(out, "\n/* aim, then its derivatives, pitch before heading, joint by joint; {}. */", chain.count());
    out += &print::maxima(&format!("{name}_chain_value_gradient"), chain);
    let chain = &rig.programs.chain_residual_jacobian;
    let _ = writeln!(out, "\n/* residual (left, up), then the derivatives of each; {}. */", chain.count());
    out += &print::maxima(&format!("{name}_chain_residual_jacobian"), chain);
    out
}
