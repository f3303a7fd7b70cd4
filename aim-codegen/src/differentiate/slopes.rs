//! Derivatives with respect to a value: values of its own type, with a derivative in place of each number that varies.
//! Truth values, whole numbers and the variants of options and enums do not vary; a derivative repeats them unchanged.

use proc_macro2::{Literal, TokenStream};
use quote::quote;
use syn::Member;

use super::messages;
use super::types::{Precision, Shape, Type};
use crate::declare::report::text::Text;
use crate::emit::body::local;

impl Type {
    /// Returns the error if derivatives with respect to a value of this type, or to its tangent, do not exist.
    pub(super) fn no_variable(&self, name: &str, tangent: bool) -> Option<Text> {
        if self.dimension() == 0 {
            return Some(messages::constant_variable(name));
        }
        self.no_part(name, tangent)
    }

    fn no_part(&self, name: &str, tangent: bool) -> Option<Text> {
        match &self.shape {
            Shape::Rigid if !tangent => Some(messages::rigid_variable(name)),
            Shape::Slice(_) => Some(messages::slice_in_variable(name)),
            Shape::Optional(_) | Shape::Enum(..) if tangent && self.dimension() > 0 => {
                Some(messages::tangent_of_choice(name))
            }
            Shape::Array(inner, _) | Shape::Optional(inner) => inner.no_part(name, tangent),
            Shape::Tuple(parts) => parts.iter().find_map(|part| part.no_part(name, tangent)),
            Shape::Struct(of, _, false) => Some(messages::partial_struct(of)),
            Shape::Struct(_, fields, true) => fields.iter().find_map(|(_, field)| field.no_part(name, tangent)),
            Shape::Enum(of, variants) => variants.iter().find_map(|variant| match variant.is_whole {
                true => variant.fields.iter().find_map(|(_, field)| field.no_part(name, tangent)),
                false => Some(messages::partial_struct(of)),
            }),
            _ => None,
        }
    }

    /// Returns `true` if the type is a single number that does not vary.
    pub(super) fn is_discrete(&self) -> bool {
        matches!(self.shape, Shape::Truth | Shape::Integer | Shape::Choice(_))
    }

    /// Returns `true` if the type contains numbers that do not vary.
    pub(super) fn holds_discrete(&self) -> bool {
        let mut found = false;
        self.leaves(&mut |leaf| found |= leaf.is_discrete());
        found
    }

    /// Returns the number of its numbers that vary.
    pub(super) fn dimension(&self) -> usize {
        let mut dimension = 0;
        self.leaves(&mut |leaf| dimension += if leaf.is_discrete() { 0 } else { leaf.components() });
        dimension
    }

    /// Returns the varying numbers of the value that `place` names.
    pub(super) fn varying(&self, place: &TokenStream, number: Precision) -> Vec<TokenStream> {
        let (mut numbers, mut varies) = (Vec::new(), Vec::new());
        self.numbers(place, number, &mut numbers);
        self.leaves(&mut |leaf| varies.extend(vec![!leaf.is_discrete(); leaf.components()]));
        numbers.into_iter().zip(varies).filter_map(|(number, varies)| varies.then_some(number)).collect()
    }

    /// Builds the derivative with respect to the value that `place` names from the derivatives with respect to its
    /// varying numbers.
    pub(super) fn build_slope(&self, place: &TokenStream, numbers: &[TokenStream]) -> TokenStream {
        let mut rest = numbers;
        self.slope_from(place, &mut rest)
    }

    fn slope_from(&self, place: &TokenStream, rest: &mut &[TokenStream]) -> TokenStream {
        match &self.shape {
            _ if self.is_discrete() => place.clone(),
            Shape::Array(element, length) => {
                let places = (0..*length).map(Literal::usize_unsuffixed).map(|index| quote!(#place[#index]));
                let parts: Vec<TokenStream> = places.map(|place| element.slope_from(&place, rest)).collect();
                quote!([#(#parts),*])
            }
            Shape::Tuple(parts) => {
                let members = (0..parts.len()).map(Member::from).map(|member| quote!(#place.#member));
                let parts: Vec<TokenStream> =
                    parts.iter().zip(members).map(|(part, place)| part.slope_from(&place, rest)).collect();
                quote!((#(#parts,)*))
            }
            Shape::Struct(_, fields, _) => {
                let values = fields.iter().map(|(member, field)| {
                    let value = field.slope_from(&quote!(#place.#member), rest);
                    quote!(#member: #value)
                });
                let (ty, values) = (self.path(), values.collect::<Vec<_>>());
                quote!(#ty { #(#values),* })
            }
            Shape::Optional(inner) => {
                let value = local("value");
                let inner = inner.slope_from(&quote!((*#value)), rest);
                quote!((match &#place {
                    ::core::option::Option::Some(#value) => ::core::option::Option::Some(#inner),
                    ::core::option::Option::None => ::core::option::Option::None,
                }))
            }
            Shape::Enum(_, variants) => {
                let ty = self.path();
                let arms = variants.iter().map(|variant| {
                    let (mut patterns, mut values) = (Vec::new(), Vec::new());
                    for (index, (member, field)) in variant.fields.iter().enumerate() {
                        let value = local(&format!("value{index}"));
                        let slope = field.slope_from(&quote!((*#value)), rest);
                        patterns.push(quote!(#member: #value));
                        values.push(quote!(#member: #slope));
                    }
                    let name = &variant.name;
                    quote!(#ty::#name { #(#patterns),* } => #ty::#name { #(#values),* },)
                });
                let arms: Vec<TokenStream> = arms.collect();
                quote!((match &#place { #(#arms)* }))
            }
            _ => {
                let (numbers, after) = rest.split_at_checked(self.components()).unwrap_or_default();
                *rest = after;
                self.build(numbers)
            }
        }
    }
}
