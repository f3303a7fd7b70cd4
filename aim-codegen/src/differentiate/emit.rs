//! The functions beside the user's: signatures, bodies, and stubs where there was an error.

use aim_symbolic::Program;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use syn::{Attribute, FnArg, ItemFn, Pat};

use super::arguments::Arguments;
use super::types::{Shape, Type};
use crate::emit::body::{Arithmetic, Body, counted};

/// The source of the companions.
pub(super) struct Companions<'a> {
    pub(super) item: &'a ItemFn,
    pub(super) arguments: &'a Arguments,
    pub(super) krate: &'a TokenStream,
}

/// A companion's program and the expressions of its inputs.
pub(super) struct Derived<'a> {
    pub(super) program: &'a Program,
    pub(super) inputs: &'a [TokenStream],
}

/// A further part of a companion's result: its type and its value, each with a comma before it.
type More<'a> = (TokenStream, &'a dyn Fn(&Outputs<'_>) -> TokenStream);

impl Companions<'_> {
    /// `…_gradient` of a number, `…_jacobian` of a vector; with a stub for a body where there is no program.
    pub(super) fn first_derivatives(&self, derived: Option<&Derived<'_>>) -> Option<TokenStream> {
        let result = self.arguments.result.as_ref()?;
        let (suffix, words) =
            if result.shape == Shape::Scalar { ("gradient", "gradient") } else { ("jacobian", "Jacobian") };
        Some(self.companion(result, (suffix, words), derived, None))
    }

    /// `…_hessian` of a number.
    pub(super) fn hessian(&self, derived: Option<&Derived<'_>>) -> Option<TokenStream> {
        let result = self.arguments.result.as_ref().filter(|result| result.shape == Shape::Scalar)?;
        let original = &result.tokens;
        let count: usize = self.arguments.variables().iter().map(|variable| variable.ty.components()).sum();
        let size = Literal::usize_unsuffixed(count);
        let rows = |outputs: &Outputs<'_>| {
            let rows = (0..count).map(|i| {
                let entries = (0..count).map(|k| outputs.number(1 + count + triangle(count, i.min(k), i.max(k))));
                quote!([#(#entries),*])
            });
            quote!(, [#(#rows),*])
        };
        let more: More<'_> = (quote!(, [[#original; #size]; #size]), &rows);
        Some(self.companion(result, ("hessian", "Hessian"), derived, Some(more)))
    }

    /// A function beside the user's: of the value, its derivatives by each variable, and, if there is `more`, something of
    /// that type.
    fn companion(
        &self,
        result: &Type,
        (suffix, words): (&str, &str),
        derived: Option<&Derived<'_>>,
        more: Option<More<'_>>,
    ) -> TokenStream {
        let name = format_ident!("{}_{suffix}", self.item.sig.ident);
        let original = &result.tokens;
        let derivatives = self.arguments.variables().into_iter().map(|variable| self.derivative_type(&variable.ty));
        let (more_type, more) = more.unzip();
        let returns = quote!((#original, (#(#derivatives,)*) #more_type));
        let body = derived.map(|derived| {
            let outputs = Outputs::new(self, derived);
            let steps = outputs.steps();
            let value = result.build(&outputs.numbers(0, result.components()));
            let derivatives = self.derivatives(&outputs);
            let more = more.map(|more| more(&outputs));
            quote!(#steps (#value, (#(#derivatives,)*) #more))
        });
        self.function(&name, &self.doc(words, derived), &returns, body)
    }

    /// The type of a derivative by a variable of this type.
    fn derivative_type(&self, variable: &Type) -> TokenStream {
        let Some(result) = &self.arguments.result else { return TokenStream::new() };
        let original = &result.tokens;
        match (result.shape, variable.shape) {
            (Shape::Scalar, _) => {
                let ty = &variable.tokens;
                quote!(#ty)
            }
            (_, Shape::Scalar) => quote!(#original),
            (Shape::Vector, Shape::Vector) => {
                let matrix = result.matrix(self.krate);
                quote!(#matrix)
            }
            (_, other) => {
                let length = Literal::usize_unsuffixed(other.components());
                quote!([#original; #length])
            }
        }
    }

    /// The derivatives by each variable. The outputs hold the value, then by each component of each variable the
    /// derivative of the value.
    fn derivatives(&self, outputs: &Outputs<'_>) -> Vec<TokenStream> {
        let Some(result) = &self.arguments.result else { return Vec::new() };
        let size = result.components();
        let mut at = size;
        let mut derivatives = Vec::new();
        for variable in self.arguments.variables() {
            let count = variable.ty.components();
            let numbers = outputs.numbers(at, count * size);
            at += count * size;
            derivatives.push(match (result.shape, variable.ty.shape) {
                (Shape::Scalar, _) => variable.ty.build(&numbers),
                (_, Shape::Scalar) => result.build(&numbers),
                (Shape::Vector, Shape::Vector) => {
                    let matrix = result.matrix(self.krate);
                    quote!(<#matrix>::from_cols_array(&[#(#numbers),*]))
                }
                _ => {
                    let vectors = numbers.chunks(size).map(|numbers| result.build(numbers));
                    quote!([#(#vectors),*])
                }
            });
        }
        derivatives
    }

    fn doc(&self, what: &str, derived: Option<&Derived<'_>>) -> String {
        let function = self.item.sig.ident.to_string();
        let names = self.arguments.variables().into_iter().filter_map(|variable| variable.name.as_ref());
        let names = names.map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
        let count = derived.map(|derived| format!(" {}.", counted(derived.program.count()))).unwrap_or_default();
        format!("The value of `{function}` and its {what} by {names}.{count}")
    }

    fn function(&self, name: &Ident, doc: &str, returns: &TokenStream, body: Option<TokenStream>) -> TokenStream {
        let ItemFn { attrs, vis, sig, .. } = self.item;
        let kept = attrs.iter().filter(|attribute| is_kept(attribute));
        let inputs = sig.inputs.iter().map(|input| match input {
            FnArg::Typed(typed) => {
                let ty = &typed.ty;
                match &*typed.pat {
                    Pat::Ident(name) => {
                        let name = &name.ident;
                        quote!(#name: #ty)
                    }
                    _ => quote!(_: #ty),
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

/// A program's outputs as expressions.
struct Outputs<'a> {
    derived: &'a Derived<'a>,
    number: TokenStream,
    private: TokenStream,
}

impl<'a> Outputs<'a> {
    fn new(companions: &Companions<'_>, derived: &'a Derived<'a>) -> Self {
        let krate = companions.krate;
        let number = companions.arguments.result.as_ref().map_or("f32", |result| result.precision.name());
        let number = format_ident!("{number}");
        Self { derived, number: quote!(::core::primitive::#number), private: quote!(#krate::__private) }
    }

    fn with_body<T>(&self, of: impl FnOnce(&Body<'_>) -> T) -> T {
        let Self { derived, number, private } = self;
        let input = |i: usize| derived.inputs[i].clone();
        let number = Arithmetic::Generic(number);
        of(&Body { program: derived.program, number, private, input: &input })
    }

    fn steps(&self) -> TokenStream {
        self.with_body(|body| body.steps())
    }

    fn number(&self, output: usize) -> TokenStream {
        self.with_body(|body| body.operand(self.derived.program.outputs()[output]))
    }

    fn numbers(&self, from: usize, count: usize) -> Vec<TokenStream> {
        (from..from + count).map(|output| self.number(output)).collect()
    }
}
