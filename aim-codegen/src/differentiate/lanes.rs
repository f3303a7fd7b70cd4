//! Companions over numbers in lanes: generic over the number type, which may be a vector of `wide`.
//!
//! | a value of | in lanes |
//! |---|---|
//! | a number, a whole number, a `bool` | one number; 1 for `true`, 0 for `false` |
//! | a vector, a quaternion, a matrix, a transform | the array of its numbers |
//! | an array, a tuple | an array, a tuple of its elements in lanes |
//! | an `Option` | 1 and the value inside, or 0 and any value |
//! | a struct | the tuple of its fields |
//! | an enum | the index of its variant, then the fields of all variants; those of other variants may be anything |

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::arguments::{Argument, Arguments};
use super::messages;
use super::types::{Shape, Type};
use crate::declare::SourcePlace;
use crate::declare::report::Report;

/// Returns the number type.
pub(super) fn number() -> TokenStream {
    quote!(S)
}

/// Returns the generic parameters of a companion.
pub(super) fn generics(krate: &TokenStream) -> TokenStream {
    let number = number();
    quote!(<#number: #krate::__private::Real>)
}

impl Arguments {
    /// Returns the arguments and the result in lanes. `None` if one of their types has no such form, which is reported
    /// at `place`.
    pub(super) fn in_lanes(&self, place: &SourcePlace, report: &mut Report) -> Option<Self> {
        if let Some(partial) = self.list.iter().map(|argument| &argument.ty).find(|ty| !ty.is_whole()) {
            return report.refuse(place, messages::no_lanes(&partial.tokens.to_string()));
        }
        if let Some(slice) = self.list.iter().find(|argument| argument.ty.has_slice()) {
            return report.refuse(place, messages::no_lanes(&slice.ty.tokens.to_string()));
        }
        if self.is_optional {
            return report.refuse(place, messages::no_lanes_of_nothing());
        }
        if let Some(part) = self.variables().iter().find(|variable| variable.slope.holds_discrete()) {
            return report.refuse(place, messages::no_lanes_by(&part.ty.tokens.to_string()));
        }
        let list = self.list.iter().map(|argument| {
            let (ty, slope) = (argument.ty.in_lanes(), argument.slope.in_lanes());
            let tokens = &ty.tokens;
            Argument {
                name: argument.name.clone(),
                called: argument.called.clone(),
                pattern: argument.pattern.clone(),
                declared: if ty.borrowed { quote!(&#tokens) } else { tokens.clone() },
                variable: argument.variable,
                varying_part: argument.varying_part,
                ty,
                slope,
            }
        });
        let result = self.result.as_ref().map(Type::in_lanes);
        let Self { is_optional, is_wrong, .. } = *self;
        Some(Self { list: list.collect(), faulty: Vec::new(), result, is_optional, is_wrong })
    }
}

impl Type {
    /// Returns the type of the same value in lanes.
    fn in_lanes(&self) -> Self {
        let scalar = || Self::made(number(), Shape::Scalar, self.precision);
        let array = |element: Self, length: usize| {
            let (tokens, count) = (&element.tokens, Literal::usize_unsuffixed(length));
            Self::made(quote!([#tokens; #count]), Shape::Array(Box::new(element.clone()), length), self.precision)
        };
        let tuple = |parts: Vec<Self>| {
            let types = parts.iter().map(|part| &part.tokens);
            Self::made(quote!((#(#types,)*)), Shape::Tuple(parts.clone()), self.precision)
        };
        let mut ty = match &self.shape {
            Shape::Truth | Shape::Integer | Shape::Choice(_) | Shape::Scalar => scalar(),
            Shape::Planar
            | Shape::Vector
            | Shape::Four
            | Shape::Quaternion
            | Shape::Matrix
            | Shape::Square(_)
            | Shape::Rigid => array(scalar(), self.components()),
            Shape::Array(element, length) => array(element.in_lanes(), *length),
            // Slices have been rejected before.
            Shape::Slice(element) => element.in_lanes(),
            Shape::Optional(inner) => tuple(vec![scalar(), inner.in_lanes()]),
            Shape::Tuple(parts) => tuple(parts.iter().map(Self::in_lanes).collect()),
            Shape::Enum(_, variants) => {
                let fields = variants.iter().flat_map(|variant| &variant.fields).map(|(_, field)| field.in_lanes());
                tuple([scalar()].into_iter().chain(fields).collect())
            }
            Shape::Struct(_, fields, _) => tuple(fields.iter().map(|(_, field)| field.in_lanes()).collect()),
        };
        ty.borrowed = self.borrowed;
        ty
    }
}
