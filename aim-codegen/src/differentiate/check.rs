//! The test beside a function that compares its derivatives with central differences.

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::companion::Companion;
use super::emit::Companions;
use super::types::{Shape, Type};

impl Companions<'_> {
    /// The test, for a function whose companion returns derivatives; `None` without a result.
    pub(super) fn check(&self) -> Option<TokenStream> {
        let (krate, function) = (self.krate, &self.item.sig.ident);
        let result = self.arguments.result.as_ref()?;
        let suffix = self.arguments.suffix(Companion::First)?;
        let (name, test) =
            (format_ident!("{function}_{suffix}"), format_ident!("{function}_{suffix}_agrees_with_differences"));
        let (mut draws, mut made, mut variables) = (Vec::new(), Vec::new(), Vec::new());
        let mut count = 0;
        for argument in &self.arguments.list {
            let first = count;
            let value = self.made(&argument.ty, argument.variable.is_some(), &mut count, &mut draws);
            made.push(if argument.ty.borrowed { quote!(&#value) } else { value });
            if let Some(place) = argument.variable {
                variables.push((place, first..count));
            }
        }
        variables.sort_by_key(|(place, _)| *place);
        let places = variables.into_iter().flat_map(|(_, places)| places).map(Literal::usize_unsuffixed);
        let places: Vec<Literal> = places.collect();
        let precision = self.arguments.precision();
        let single = precision.name() == "f32";
        let numbers = |ty: &Type, place: &TokenStream| {
            let mut numbers = Vec::new();
            ty.numbers(place, precision, &mut numbers);
            quote!([#(#numbers as ::core::primitive::f64),*])
        };
        let (value, size) = (numbers(result, &quote!(value)), result.components());
        let slopes = self.slopes(result);
        let private = quote!(#krate::__private::differences);
        Some(quote! {
            #[cfg(test)]
            #[test]
            #[allow(trivial_numeric_casts, clippy::all, clippy::pedantic, reason = "written by `check = true`")]
            fn #test() {
                extern crate std;
                #private::agree(
                    ::core::stringify!(#function),
                    (&[#(#private::Draw::#draws),*], &[#(#places),*], #single),
                    |at: &[::core::primitive::f64; #count]| {
                        // Arguments that the function does not take are no points to judge.
                        let value = || {
                            let value = #function(#(#made),*);
                            #value
                        };
                        std::panic::catch_unwind(value).unwrap_or([::core::primitive::f64::NAN; #size])
                    },
                    |at: &[::core::primitive::f64; #count]| {
                        let (_, slopes) = #name(#(#made),*);
                        [#(#slopes),*]
                    },
                );
            }
        })
    }

    /// An argument of numbers that are drawn: `at[0]` and so on.
    fn made(&self, ty: &Type, varies: bool, count: &mut usize, draws: &mut Vec<TokenStream>) -> TokenStream {
        let number = format_ident!("{}", self.arguments.precision().name());
        let mut parts = Vec::new();
        ty.leaves(&mut |leaf: &Type| {
            let (draw, size) = match leaf.shape {
                Shape::Truth => (quote!(Truth), 1),
                Shape::Integer => (quote!(Integer), 1),
                Shape::Quaternion if !varies => (quote!(Quaternion), 1),
                Shape::Rigid => (quote!(Rigid), 1),
                _ => (quote!(Number), leaf.components()),
            };
            draws.extend(vec![draw; size]);
            for _ in 0..leaf.components() {
                let place = Literal::usize_unsuffixed(*count);
                *count += 1;
                let original = &leaf.tokens;
                parts.push(match leaf.shape {
                    Shape::Truth => quote!((at[#place] > 0.0)),
                    Shape::Integer => quote!((at[#place] as #original)),
                    _ => quote!((at[#place] as ::core::primitive::#number)),
                });
            }
        });
        ty.build(&parts)
    }

    /// By each number of the variables, the derivatives of all numbers of the result.
    fn slopes(&self, result: &Type) -> Vec<TokenStream> {
        let size = result.components();
        let precision = self.arguments.precision();
        let numbers = |ty: &Type, place: &TokenStream| {
            let mut numbers = Vec::new();
            ty.numbers(place, precision, &mut numbers);
            numbers
        };
        let mut slopes = Vec::new();
        for (index, variable) in self.arguments.variables().into_iter().enumerate() {
            let index = Literal::usize_unsuffixed(index);
            let (of_it, ty) = (quote!(slopes.#index), variable.ty.owned());
            let columns: Vec<Vec<TokenStream>> = match (&result.shape, &ty.shape) {
                (Shape::Scalar, _) => numbers(&ty, &of_it).into_iter().map(|number| vec![number]).collect(),
                (Shape::Planar | Shape::Vector | Shape::Four, Shape::Scalar) => vec![numbers(result, &of_it)],
                (Shape::Vector, Shape::Vector) => {
                    let columns =
                        (0..3).map(Literal::usize_unsuffixed).map(|k| numbers(result, &quote!(#of_it.col(#k))));
                    columns.collect()
                }
                (Shape::Planar | Shape::Vector | Shape::Four, _) => {
                    let columns = (0..ty.components()).map(Literal::usize_unsuffixed);
                    columns.map(|k| numbers(result, &quote!(#of_it[#k]))).collect()
                }
                _ => {
                    let rows = (0..size).map(Literal::usize_unsuffixed).map(|k| numbers(&ty, &quote!(#of_it[#k])));
                    let rows: Vec<Vec<TokenStream>> = rows.collect();
                    (0..ty.components()).map(|k| rows.iter().map(|row| row[k].clone()).collect()).collect()
                }
            };
            let columns = columns.into_iter().map(|column| quote!([#(#column as ::core::primitive::f64),*]));
            slopes.extend(columns);
        }
        slopes
    }
}
