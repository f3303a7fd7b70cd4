//! Slices among the arguments and the fields of structs; their length is only known at run time.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};
use syn::Member;

use super::items::Items;
use super::lower::Scope;
use super::types::{Shape, Type};

impl Type {
    /// Returns the type of a borrowed slice; `None` for any other type, and if its elements are not supported.
    pub(super) fn slice(written: &syn::Type, scope: &Scope, items: &Items) -> Option<Self> {
        let (slice, element) = slice_of(written)?;
        let element = Self::parse_in(scope, element, items).ok()?;
        if element.borrowed || element.has_slice() {
            return None;
        }
        let precision = element.precision;
        let mut ty = Self::made(slice.to_token_stream(), Shape::Slice(Box::new(element)), precision);
        ty.borrowed = true;
        Some(ty)
    }

    /// Returns `true` for a slice, and for a type that contains one.
    pub(super) fn has_slice(&self) -> bool {
        match &self.shape {
            Shape::Slice(_) => true,
            Shape::Tuple(parts) => parts.iter().any(Self::has_slice),
            Shape::Struct(_, fields, _) => fields.iter().any(|(_, field)| field.has_slice()),
            // Other types contain no slices.
            _ => false,
        }
    }

    /// Appends the slices of the value that `place` names: the expression of each, and the type of its elements.
    pub(super) fn slices<'t>(&'t self, place: &TokenStream, to: &mut Vec<(TokenStream, &'t Self)>) {
        match &self.shape {
            Shape::Slice(element) => to.push((place.clone(), element)),
            Shape::Tuple(parts) => {
                for (index, part) in parts.iter().enumerate() {
                    let member = Member::from(index);
                    part.slices(&quote!(#place.#member), to);
                }
            }
            Shape::Struct(_, fields, _) => {
                for (member, field) in fields {
                    field.slices(&quote!(#place.#member), to);
                }
            }
            // Other types contain no slices.
            _ => {}
        }
    }
}

/// Returns a borrowed slice's type and its element type.
pub(super) fn slice_of(ty: &syn::Type) -> Option<(&syn::Type, &syn::Type)> {
    let syn::Type::Reference(reference) = ty else { return None };
    let syn::Type::Slice(slice) = &*reference.elem else { return None };
    reference.mutability.is_none().then_some((&*reference.elem, &*slice.elem))
}
