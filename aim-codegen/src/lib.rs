//! From what the user declared to the code that aims it.
//!
//! A declaration passes every check and becomes a [`RigSpec`]; [`objective::kernels`] states the objectives for it
//! and derives their programs; a back end of [`emit`] writes them down. Nothing after the checks can fail.
//!
//! The derive macro, a `build.rs` and the command all come through here, so their code is the same.

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

/// What `#[derive(AimRig)]` expands to: the implementation, or every error of the declaration.
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

/// The kernels that a declaration asks for by `kernels(…)`.
fn requested_kernels(spec: &RigSpec) -> Vec<Kernel> {
    let objectives = OBJECTIVES.into_iter().filter(|objective| spec.kernels.contains(&objective.name));
    objectives.flat_map(|objective| objective.kernels(spec, FirstLink::Given)).collect()
}

/// The Rust code of a rig that was not declared as a struct: the struct that a derive would have found, and what the
/// derive makes of it.
///
/// `krate` is the path of the facade, `::aim` for its users.
#[must_use]
pub fn rust_of(spec: &RigSpec, krate: proc_macro2::TokenStream) -> proc_macro2::TokenStream {
    let kernels = requested_kernels(spec);
    let rig = emit::Rig { spec, kernels: &kernels };
    emit::rust::emit_with_struct(&rig, &emit::rust::Item::of(spec, krate))
}

/// Emitted Rust as a readable file's text.
///
/// A file of one long line is also slow to compile: the compiler measures every place in it from the line's start.
#[cfg(feature = "toml")]
#[must_use]
pub fn format_rust(tokens: proc_macro2::TokenStream) -> String {
    match syn::parse2(tokens.clone()) {
        Ok(file) => prettyplease::unparse(&file),
        // Not formatted, but as right as before.
        Err(_) => tokens.to_string(),
    }
}
