//! Maxima back end: the derived programs as functions.

use std::fmt::Write;

use aim_symbolic::print;

use super::Rig;

/// Emits the batch file.
#[must_use]
pub fn emit(rig: &Rig<'_>) -> String {
    let mut out = format!(
        "/* Programs of the rig {}, written by aim {}. Do not edit: generate again.\n   \
         Each function returns its outputs as a list; sines and cosines are arguments of their own. */\n",
        rig.spec.name,
        env!("CARGO_PKG_VERSION")
    );
    for function in rig.functions() {
        let program = &function.kernel.program;
        let _ = writeln!(out, "\n/* {} {}. */", function.outputs(rig.spec), program.count());
        out += &print::maxima(&function.name(rig.spec), program);
    }
    out
}
