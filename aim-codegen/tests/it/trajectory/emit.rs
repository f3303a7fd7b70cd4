//! Emits the kernels of a trajectory's cost as Rust, for the runtime's own use.

use aim_codegen::emit::body::{Arithmetic, Body, counted, local};
use aim_symbolic::Program;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::objective::TrajectoryPrograms;

/// Returns the kernels as a module of the runtime.
pub(crate) fn emit(programs: &TrajectoryPrograms) -> TokenStream {
    let place = function("place", "α and β.", &programs.place);
    let gradient = function("term_gradient", "The term and its nine derivatives.", &programs.term_gradient);
    let rounded = function("rounded_place", "α and β, rounded.", &programs.rounded_place);
    let hessian = function(
        "rounded_term_hessian",
        "The rounded term, its nine derivatives, and the lower triangle of its second derivatives, row by row.",
        &programs.rounded_term_hessian,
    );
    quote!(#place #gradient #rounded #hessian)
}

fn function(name: &str, doc: &str, program: &Program) -> TokenStream {
    let [points, others] = ["points", "others"].map(local);
    let input = |i: usize| {
        let [point, axis, place] = [i / 3, i % 3, i.saturating_sub(9)].map(Literal::usize_unsuffixed);
        if i < 9 { quote!(#points[#point][#axis]) } else { quote!(#others[#place]) }
    };
    let (number, private) = (quote!(S), quote!(crate));
    let body = Body { program, number: Arithmetic::Generic(&number), private: &private, input: &input };
    let (steps, results) = (body.steps(), body.results());
    let further = program.inputs().len().saturating_sub(9);
    let parameter = (further > 0).then(|| {
        let further = Literal::usize_unsuffixed(further);
        quote!(, #others: &[S; #further])
    });
    let (name, outputs) = (format_ident!("{name}"), Literal::usize_unsuffixed(program.outputs().len()));
    let doc = format!("{doc} {}.", counted(program.count()));
    quote! {
        #[doc = #doc]
        #[inline]
        pub(super) fn #name<S: crate::Scalar>(#points: &[[S; 3]; 3] #parameter) -> [S; #outputs] {
            #steps
            [#(#results),*]
        }
    }
}
