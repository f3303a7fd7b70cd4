//! Compiles rig declarations to the code that aims them.
//!
//! A declaration is parsed and checked ([`declare`]) and becomes a [`RigSpec`]. [`objective::kernels`] states the
//! objectives for that rig and derives a program for each. A back end of [`emit`] writes the programs as source text.
//! Once the checks have passed, no later step can fail.
//!
//! The derive macro, a `build.rs` and the command-line tool all use this crate, so they emit the same code.

#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "toml")]
pub mod build;
pub mod declare;
mod differentiate;
pub mod emit;
mod names;
pub mod objective;
mod spec;

use objective::{FirstLink, OBJECTIVES};

pub use aim_model::{Angles, LimitsFrom, RangeOfMotion, Role};
pub use differentiate::differentiate;
pub use differentiate::file::Differentiated;
pub use names::snake_case;
pub use objective::{Kernel, Objective, kernels};
pub use spec::{AngleRange, Budget, Budgets, EffectorSpec, Frame, JointSpec, NaturalSpec, RigSpec};

/// Expands `#[derive(AimRig)]`: returns the implementation, or all errors of the declaration.
#[must_use]
pub fn derive(input: proc_macro2::TokenStream) -> proc_macro2::TokenStream {
    let input: syn::DeriveInput = match syn::parse2(input) {
        Ok(input) => input,
        Err(error) => return error.into_compile_error(),
    };
    match declare::from_derive_input(&input) {
        Ok(declared) => {
            let kernels = requested_kernels(&declared.spec);
            let rig = emit::Rig { spec: &declared.spec, kernels: &kernels };
            let krate = declared.krate.unwrap_or_else(|| quote::quote!(::aim));
            emit::rust::emit(
                &rig,
                &emit::rust::Item { name: declared.ident, fields: declared.fields, vis: declared.vis, krate },
            )
        }
        Err(errors) => {
            let mut tokens = errors.into_compile_error();
            tokens.extend(emit::fallback(&input));
            tokens
        }
    }
}

/// Derives the kernels that the declaration requests with `kernels(…)`.
fn requested_kernels(spec: &RigSpec) -> Vec<Kernel> {
    let objectives = OBJECTIVES.into_iter().filter(|objective| spec.kernels.contains(&objective.name));
    objectives.flat_map(|objective| objective.kernels(spec, FirstLink::Given)).collect()
}

/// Emits the Rust code of a rig that was not declared as a struct: the struct itself, and the implementations that the
/// derive would add to it.
///
/// `krate` is the path of the facade crate; `::aim` in user code.
#[must_use]
pub fn rust_of(spec: &RigSpec, krate: proc_macro2::TokenStream) -> proc_macro2::TokenStream {
    let kernels = requested_kernels(spec);
    let rig = emit::Rig { spec, kernels: &kernels };
    emit::rust::emit_with_struct(&rig, &emit::rust::Item::of(spec, krate))
}

/// Formats emitted Rust as a readable source file.
///
/// Also shortens compile times: the compiler computes columns from the start of a line, which is slow in a file of one
/// long line.
#[cfg(feature = "toml")]
#[must_use]
pub fn format_rust(tokens: proc_macro2::TokenStream) -> String {
    match syn::parse2(tokens.clone()) {
        Ok(file) => prettyplease::unparse(&file),
        // Unformatted, but still correct.
        Err(_) => tokens.to_string(),
    }
}
