//! Emits the companion functions: signatures, bodies, and stubs if there was an error.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};
use syn::{Attribute, ItemFn, WherePredicate};

use super::arguments::{Argument, Arguments};
use super::companion::{Companion, Derived};
use super::lanes;
use super::manifold::VaryingPart;
use super::types::{Shape, Type};
use crate::emit::body::{Arithmetic, Body, counted};

/// Everything that companions are emitted from.
#[derive(Clone, Copy)]
pub(super) struct Companions<'a> {
    pub(super) item: &'a ItemFn,
    pub(super) arguments: &'a Arguments,
    pub(super) krate: &'a TokenStream,
    /// Assertions of what the function's names are assumed to mean.
    pub(super) assertions: &'a TokenStream,
    /// `true` if the arguments are [in lanes](Arguments::in_lanes).
    pub(super) of_lanes: bool,
}

impl Companions<'_> {
    /// Emits the companion, with a stub body if there is no program; `None` if the function has no result, or none that
    /// this companion applies to.
    pub(super) fn companion(&self, companion: Companion, derived: Option<&Derived>) -> Option<TokenStream> {
        let result = self.arguments.result.as_ref()?;
        if companion.is_of_a_number() && !matches!(result.shape, Shape::Scalar) {
            return None;
        }
        let suffix = self.arguments.suffix(companion)?;
        let of_lanes = if self.of_lanes { "_lanes" } else { "" };
        let name = format_ident!("{}_{suffix}{of_lanes}", self.item.sig.ident);
        let (krate, number) = (self.krate, self.number());
        let private = quote!(#krate::__private);
        let mut inputs = self.arguments.inputs(companion);
        let precision = self.arguments.precision();
        if let Some(derived) = derived {
            let arithmetic = (Arithmetic::Generic(&number), &private);
            derived.kept_loops.add_inputs(&mut inputs, arithmetic, precision, &self.arguments.slices());
        }
        let input = |i: usize| inputs[i].clone();
        let program = derived.map(|derived| &derived.program);
        let body = program.map(|program| Body {
            program,
            number: Arithmetic::Generic(&number),
            private: &private,
            input: &input,
        });
        let (loops, mut outputs) = match (derived, &body) {
            (Some(derived), Some(body)) => derived.kept_loops.outputs_through_loops(body, &input, result.components()),
            _ => Default::default(),
        };
        // The last output is positive if there is a value.
        let is_some = if self.arguments.is_optional { outputs.pop() } else { None };
        let (mut returns, mut value) = self.returned(companion, result, &number, &outputs);
        if self.arguments.is_optional {
            returns = quote!(::core::option::Option<#returns>);
            value = quote!(if #is_some > 0.0 { ::core::option::Option::Some(#value) } else { ::core::option::Option::None });
        }
        let body = body.map(|body| {
            let steps = body.steps();
            let assertions = self.assertions;
            quote!(#assertions #loops #steps #value)
        });
        Some(self.function(&name, companion, &self.doc(companion, suffix, derived), &returns, body))
    }

    /// Returns the generic parameters and the `where` clause: the function's lifetimes, or the number type in lanes, where
    /// types have no lifetimes.
    fn generics(&self) -> (TokenStream, TokenStream) {
        let generics = &self.item.sig.generics;
        if self.of_lanes {
            return (lanes::generics(self.krate), TokenStream::new());
        }
        let lifetimes: Vec<_> = generics.lifetimes().collect();
        if lifetimes.is_empty() {
            return Default::default();
        }
        let bounds = generics.where_clause.iter().flat_map(|clause| &clause.predicates);
        let bounds = bounds.filter(|bound| matches!(bound, WherePredicate::Lifetime(_)));
        (quote!(<#(#lifetimes),*>), quote!(where #(#bounds),*))
    }

    /// Returns the number type.
    fn number(&self) -> TokenStream {
        if self.of_lanes {
            return lanes::number();
        }
        let number = format_ident!("{}", self.arguments.precision().name());
        quote!(::core::primitive::#number)
    }

    /// Returns the companion's return type, and its value built from the program's outputs. Without a program there are
    /// no outputs, and the value is not used.
    fn returned(
        &self,
        companion: Companion,
        result: &Type,
        number: &TokenStream,
        outputs: &[TokenStream],
    ) -> (TokenStream, TokenStream) {
        let (original, size) = (&result.tokens, result.components());
        let count: usize = self.arguments.variables().iter().map(|variable| variable.slope.dimension()).sum();
        let rest = outputs.get(size..).unwrap_or_default();
        let value = outputs.get(..size).map_or_else(TokenStream::new, |numbers| result.build(numbers));
        let matrix = |numbers: &[TokenStream]| {
            let entry = |i: usize, k: usize| numbers.get(triangle(count, i.min(k), i.max(k)));
            let rows = (0..count).map(|i| (0..count).filter_map(|k| entry(i, k)).collect::<Vec<_>>());
            let (size, rows) = (Literal::usize_unsuffixed(count), rows.map(|row| quote!([#(#row),*])));
            (quote!([[#number; #size]; #size]), quote!([#(#rows),*]))
        };
        match companion {
            Companion::First => {
                let (types, derivatives) = self.derivatives(result, rest);
                (quote!((#original, (#(#types,)*))), quote!((#value, (#(#derivatives,)*))))
            }
            Companion::Vjp | Companion::Hvp => {
                let (types, derivatives) = self.gradient(rest);
                (quote!((#original, (#(#types,)*))), quote!((#value, (#(#derivatives,)*))))
            }
            Companion::Jvp => {
                let tangent = if rest.is_empty() { TokenStream::new() } else { result.build(rest) };
                (quote!((#original, #original)), quote!((#value, #tangent)))
            }
            Companion::Hessian | Companion::GaussNewton => {
                let (types, derivatives) = self.gradient(rest);
                let (square, rows) = matrix(rest.get(count..).unwrap_or_default());
                (quote!((#original, (#(#types,)*), #square)), quote!((#value, (#(#derivatives,)*), #rows)))
            }
        }
    }

    /// Returns types and values of the derivatives of one number with respect to each variable.
    fn gradient(&self, mut rest: &[TokenStream]) -> (Vec<TokenStream>, Vec<TokenStream>) {
        let by = |variable: &Argument| {
            let (numbers, after) = rest.split_at_checked(variable.slope.dimension()).unwrap_or_default();
            rest = after;
            (variable.slope.tokens.clone(), variable.build_slope(numbers))
        };
        self.arguments.variables().into_iter().map(by).unzip()
    }

    /// Returns types and values of the derivatives of the result with respect to each variable. `rest` holds, for each
    /// component of each variable, the derivatives of all numbers of the result.
    fn derivatives(&self, result: &Type, mut rest: &[TokenStream]) -> (Vec<TokenStream>, Vec<TokenStream>) {
        if matches!(result.shape, Shape::Scalar) {
            return self.gradient(rest);
        }
        let (original, size) = (&result.tokens, result.components());
        let by = |variable: &Argument| {
            let count = variable.slope.dimension();
            let (numbers, after) = rest.split_at_checked(count * size).unwrap_or_default();
            rest = after;
            match (&result.shape, &variable.slope.shape) {
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
                // One row for each component of the result.
                _ => {
                    let (length, row) = (Literal::usize_unsuffixed(size), &variable.slope.tokens);
                    let rows = (0..size).map(|i| {
                        let row: Vec<TokenStream> = numbers.iter().skip(i).step_by(size).cloned().collect();
                        variable.build_slope(&row)
                    });
                    (quote!([#row; #length]), quote!([#(#rows),*]))
                }
            }
        };
        self.arguments.variables().into_iter().map(by).unzip()
    }

    fn doc(&self, companion: Companion, suffix: &str, derived: Option<&Derived>) -> String {
        let function = self.item.sig.ident.to_string();
        let name = |variable: &Argument| {
            let name = variable.name.as_ref()?;
            let tangent = matches!(variable.varying_part, VaryingPart::Tangent(_));
            Some(if tangent { format!("the tangent of `{name}`") } else { format!("`{name}`") })
        };
        let names: Vec<String> = self.arguments.variables().into_iter().filter_map(name).collect();
        let names = names.join(", ");
        let count = derived.map(|derived| format!(" {}.", counted(derived.count()))).unwrap_or_default();
        let words = match companion {
            Companion::First if suffix == "jacobian" => format!("The value of `{function}` and its Jacobian"),
            Companion::First => format!("The value of `{function}` and its gradient"),
            Companion::Hessian => format!("The value of `{function}`, its gradient and its Hessian"),
            Companion::Jvp => format!("The value of `{function}` and its derivative along `along_…`"),
            Companion::Vjp => format!("The value of `{function}` and the gradient of its product with `weights`"),
            Companion::Hvp => {
                format!("The derivative of `{function}` along `along_…`, and its Hessian times that direction")
            }
            Companion::GaussNewton => format!("The value r of `{function}`, Jᵀr and JᵀJ"),
        };
        let of_lanes = if self.of_lanes { ", of as many points as a number of the type `S` has lanes" } else { "" };
        let optional = if self.arguments.is_optional { " `None` where that has no value." } else { "" };
        format!("{words} by {names}{of_lanes}.{optional}{count}")
    }

    fn function(
        &self,
        name: &Ident,
        companion: Companion,
        doc: &str,
        returns: &TokenStream,
        body: Option<TokenStream>,
    ) -> TokenStream {
        let ItemFn { attrs, vis, .. } = self.item;
        let kept = attrs.iter().filter(|attribute| is_kept(attribute));
        let own = self.arguments.list.iter().map(|Argument { called, declared, .. }| quote!(#called: #declared));
        let extra = self.arguments.extra_parameters(companion);
        let extra = extra.into_iter().map(|(name, Type { tokens, .. })| quote!(#name: #tokens));
        let inputs = own.chain(extra);
        let (generics, bounds) = self.generics();
        let body = body.unwrap_or_else(|| quote!(::core::unreachable!()));
        quote! {
            #(#kept)*
            #[doc = #doc]
            #[allow(
                dead_code,
                unreachable_pub,
                unused_qualifications,
                unused_variables,
                unused_mut,
                unused_assignments,
                clippy::all,
                clippy::pedantic,
                clippy::nursery,
                reason = "derived code: its arguments are those of the function beside it"
            )]
            #[inline]
            #[must_use]
            #vis fn #name #generics(#(#inputs),*) -> #returns #bounds {
                #body
            }
        }
    }
}

/// Returns `true` if an attribute of the user's function also applies to its companions.
fn is_kept(attribute: &Attribute) -> bool {
    ["cfg", "allow", "deprecated"].iter().any(|known| attribute.path().is_ident(known))
}

/// Returns the index of the second derivative with respect to the variables `i` ≤ `k` of `count` in the upper triangle,
/// row by row.
fn triangle(count: usize, i: usize, k: usize) -> usize {
    i * (2 * count + 1 - i) / 2 + (k - i)
}
