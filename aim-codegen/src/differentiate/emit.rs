//! The functions beside the user's: signatures, bodies, and stubs where there was an error.

use aim_symbolic::Program;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use syn::{Attribute, FnArg, ItemFn, Pat};

use super::arguments::{Arguments, pattern_argument};
use super::types::{Shape, Type};
use crate::emit::body::{Arithmetic, Body, counted};

/// The source of the companions.
pub(super) struct Companions<'a> {
    pub(super) item: &'a ItemFn,
    pub(super) arguments: &'a Arguments,
    pub(super) krate: &'a TokenStream,
    /// What the inputs of the programs are called.
    pub(super) inputs: &'a [TokenStream],
}

/// A further part of a companion's result: its type and, of the program's outputs, its value, each with a comma before it.
type More<'a> = (TokenStream, &'a dyn Fn(&[TokenStream]) -> TokenStream);

impl Companions<'_> {
    /// `…_gradient` of a number, `…_jacobian` of a vector; with a stub for a body where there is no program.
    pub(super) fn first_derivatives(&self, program: Option<&Program>) -> Option<TokenStream> {
        let result = self.arguments.result.as_ref()?;
        let (suffix, words) =
            if matches!(result.shape, Shape::Scalar) { ("gradient", "gradient") } else { ("jacobian", "Jacobian") };
        Some(self.companion(result, (suffix, words), program, None))
    }

    /// `…_hessian` of a number.
    pub(super) fn hessian(&self, program: Option<&Program>) -> Option<TokenStream> {
        let result = self.arguments.result.as_ref().filter(|result| matches!(result.shape, Shape::Scalar))?;
        let original = &result.tokens;
        let count: usize = self.arguments.variables().iter().map(|variable| variable.ty.components()).sum();
        let size = Literal::usize_unsuffixed(count);
        let rows = |outputs: &[TokenStream]| {
            let rows = (0..count).map(|i| {
                let entries = (0..count).map(|k| &outputs[1 + count + triangle(count, i.min(k), i.max(k))]);
                quote!([#(#entries),*])
            });
            quote!(, [#(#rows),*])
        };
        let more: More<'_> = (quote!(, [[#original; #size]; #size]), &rows);
        Some(self.companion(result, ("hessian", "Hessian"), program, Some(more)))
    }

    /// A function beside the user's: of the value, its derivatives by each variable, and, if there is `more`, something of
    /// that type.
    fn companion(
        &self,
        result: &Type,
        (suffix, words): (&str, &str),
        program: Option<&Program>,
        more: Option<More<'_>>,
    ) -> TokenStream {
        let name = format_ident!("{}_{suffix}", self.item.sig.ident);
        let (krate, number) = (self.krate, format_ident!("{}", self.arguments.precision().name()));
        let (private, number) = (quote!(#krate::__private), quote!(::core::primitive::#number));
        let input = |i: usize| self.inputs[i].clone();
        let body = program.map(|program| Body {
            program,
            number: Arithmetic::Generic(&number),
            private: &private,
            input: &input,
        });
        let outputs: Vec<TokenStream> = body.iter().flat_map(Body::results).collect();
        let (types, derivatives) = self.derivatives(result, &outputs);
        let (more_type, more) = more.unzip();
        let original = &result.tokens;
        let returns = quote!((#original, (#(#types,)*) #more_type));
        let body = body.map(|body| {
            let (steps, value) = (body.steps(), result.build(&outputs[..result.components()]));
            let more = more.map(|more| more(&outputs));
            quote!(#steps (#value, (#(#derivatives,)*) #more))
        });
        self.function(&name, &self.doc(words, program), &returns, body)
    }

    /// The types and the values of the derivatives by each variable. The outputs hold the value, then by each component
    /// of each variable the derivative of the value; without a program there are none, and the values are of no use.
    fn derivatives(&self, result: &Type, outputs: &[TokenStream]) -> (Vec<TokenStream>, Vec<TokenStream>) {
        let (original, size) = (&result.tokens, result.components());
        let mut rest = outputs.get(size..).unwrap_or_default();
        let by = |variable: &Type| {
            let count = variable.components();
            let (numbers, after) = rest.split_at_checked(count * size).unwrap_or_default();
            rest = after;
            match (&result.shape, &variable.shape) {
                (Shape::Scalar, _) => (variable.tokens.clone(), variable.build(numbers)),
                (Shape::Planar | Shape::Vector | Shape::Four, Shape::Scalar) => {
                    (original.clone(), result.build(numbers))
                }
                (Shape::Vector, Shape::Vector) => {
                    let matrix = result.matrix(self.krate);
                    (matrix.clone(), quote!(<#matrix>::from_cols_array(&[#(#numbers),*])))
                }
                (Shape::Planar | Shape::Vector | Shape::Four, _) => {
                    let length = Literal::usize_unsuffixed(count);
                    let vectors = numbers.chunks(size).map(|numbers| result.build(numbers));
                    (quote!([#original; #length]), quote!([#(#vectors),*]))
                }
                // A row a component of the result.
                _ => {
                    let (length, row) = (Literal::usize_unsuffixed(size), &variable.tokens);
                    let rows = (0..size).map(|i| {
                        let row: Vec<TokenStream> = numbers.iter().skip(i).step_by(size).cloned().collect();
                        variable.build(&row)
                    });
                    (quote!([#row; #length]), quote!([#(#rows),*]))
                }
            }
        };
        self.arguments.variables().into_iter().map(|variable| &variable.ty).map(by).unzip()
    }

    fn doc(&self, what: &str, program: Option<&Program>) -> String {
        let function = self.item.sig.ident.to_string();
        let names = self.arguments.variables().into_iter().filter_map(|variable| variable.name.as_ref());
        let names = names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        let count = program.map(|program| format!(" {}.", counted(program.count()))).unwrap_or_default();
        format!("The value of `{function}` and its {what} by {names}.{count}")
    }

    fn function(&self, name: &Ident, doc: &str, returns: &TokenStream, body: Option<TokenStream>) -> TokenStream {
        let ItemFn { attrs, vis, sig, .. } = self.item;
        let kept = attrs.iter().filter(|attribute| is_kept(attribute));
        let inputs = sig.inputs.iter().enumerate().map(|(index, input)| match input {
            FnArg::Typed(typed) => {
                let ty = &typed.ty;
                match &*typed.pat {
                    Pat::Ident(name) => {
                        let name = &name.ident;
                        quote!(#name: #ty)
                    }
                    _ => {
                        let name = pattern_argument(index);
                        quote!(#name: #ty)
                    }
                }
            }
            FnArg::Receiver(receiver) => quote!(#receiver),
        });
        let body = body.unwrap_or_else(|| quote!(::core::unreachable!()));
        quote! {
            #(#kept)*
            #[doc = #doc]
            #[allow(
                dead_code,
                unreachable_pub,
                unused_variables,
                clippy::all,
                clippy::pedantic,
                clippy::nursery,
                reason = "derived code: its arguments are those of the function beside it"
            )]
            #[inline]
            #[must_use]
            #vis fn #name(#(#inputs),*) -> #returns {
                #body
            }
        }
    }
}

/// Attributes of the user's function that hold for its companions, too.
fn is_kept(attribute: &Attribute) -> bool {
    ["cfg", "allow", "deprecated"].iter().any(|known| attribute.path().is_ident(known))
}

/// Where the second derivative by the variables `i` ≤ `k` of `count` stands in the upper triangle, row by row.
fn triangle(count: usize, i: usize, k: usize) -> usize {
    i * (2 * count + 1 - i) / 2 + (k - i)
}
