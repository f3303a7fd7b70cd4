//! Emits the rigs under test.

use std::fs;
use std::path::PathBuf;

use aim_codegen::emit::{Rig, rust};
use aim_codegen::kernels;

// The tests reach these two modules through the library.
#[allow(dead_code, unreachable_pub, missing_docs, reason = "the build script needs but a part of the module")]
#[path = "src/random.rs"]
mod random;
#[allow(unreachable_pub, reason = "the module is public where the library holds it")]
#[path = "src/rigs.rs"]
mod rigs;

fn main() {
    println!("cargo::rerun-if-changed=src/random.rs");
    println!("cargo::rerun-if-changed=src/rigs.rs");
    let out = PathBuf::from(std::env::var_os("OUT_DIR").expect("cargo sets it"));
    let mut rust = String::new();
    let mut names = Vec::new();
    for spec in rigs::rigs() {
        let kernels = kernels(&spec);
        let rig = Rig { spec: &spec, kernels: &kernels };
        let item = rust::Item::of(&spec, quote::quote!(::aim));
        rust += &aim_codegen::format_rust(rust::emit_with_struct(&rig, &item));
        rust += &format!("\naim_tests::requested_kernels!({});\n", spec.name);
        names.push(spec.name.clone());
    }
    let arms: String = names.iter().enumerate().map(|(i, name)| format!("{i} => $f({name}::RIG),")).collect();
    rust += &format!(
        "macro_rules! with_rig {{ ($number:expr, $f:expr) => {{ match $number {{ {arms} _ => unreachable!() }} }} }}"
    );
    fs::write(out.join("rigs.rs"), rust).expect("the output folder is writable");
}
