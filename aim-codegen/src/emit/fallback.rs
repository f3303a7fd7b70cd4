//! Stub implementations for a faulty declaration, so that the compiler reports only the declaration's own errors.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, quote};
use syn::{Data, DeriveInput};

use super::rust::{Item, conversions, pose};
use crate::declare::parse::item;

/// Emits stubs of everything that the derive would implement for the item. The user then reads the errors of the
/// declaration, and not also that `Thug` has no `RIG`.
#[must_use]
pub fn fallback(input: &DeriveInput) -> TokenStream {
    // One joint for each field, so that correct uses of a faulty declaration cause no further errors.
    let fields: Vec<syn::Ident> = match &input.data {
        Data::Struct(data) => data.fields.iter().filter_map(|field| field.ident.clone()).collect(),
        Data::Enum(_) | Data::Union(_) => Vec::new(),
    };
    let count = if let Data::Struct(data) = &input.data { data.fields.len() } else { 0 };
    let joints = Literal::usize_unsuffixed(count);
    let krate = item::crate_override(input).unwrap_or_else(|| quote!(::aim));
    let private = quote!(#krate::__private);
    let item = Item { name: input.ident.clone(), fields, vis: input.vis.to_token_stream(), krate };
    // Without fields, the pose struct's type parameter would be unused, which is an error.
    let pose = (!item.fields.is_empty()).then(|| [pose(&item), conversions(&item)]).into_iter().flatten();
    let name = &input.ident;
    let (generics, arguments, clause) = input.generics.split_for_impl();
    // Never runs, because the errors beside it stop compilation; must still compile without warnings.
    let body = quote!({ ::core::unreachable!() });
    let [f32, usize] = [quote!(::core::primitive::f32), quote!(::core::primitive::usize)];
    let name_of = quote!(::core::option::Option<&::core::primitive::str>);
    // Generic rigs are an error. `&'static Self` would be another, because their type parameters may not be `'static`.
    let is_static = input.generics.params.is_empty();
    let aim_rig = is_static.then(|| {
        quote! {
            #[automatically_derived]
            impl #generics #private::AimRig for #name #arguments #clause {
                type Array<__T: ::core::marker::Copy> = [__T; #joints];
                const RIG: &'static Self = ::core::unreachable!();
                const DESCRIPTION: &'static #private::Description<'static> = ::core::unreachable!();
                fn array<__T: ::core::marker::Copy>(_: __T) -> [__T; #joints] #body
                fn from_joints(_: [#private::Joint; #joints]) -> Self #body
            }
        }
    });
    quote! {
        #(#pose)*
        #[automatically_derived]
        impl #generics #private::Rig for #name #arguments #clause {
            fn description(&self) -> #private::Description<'_> #body
            fn joint_name(&self, _: #usize) -> #name_of #body
            fn bone_name(&self, _: #usize, _: #usize) -> #name_of #body
            fn residual_jacobian(&self, _: &[[#f32; 12]], _: &[#f32; 3], _: &[[#f32; 4]], _: &mut [#f32]) #body
            fn aim_gradient(&self, _: #usize, _: &[#f32; 12], _: &[#f32; 3], _: &[#f32; 4]) -> [#f32; 3] #body
        }
        #aim_rig
    }
}
