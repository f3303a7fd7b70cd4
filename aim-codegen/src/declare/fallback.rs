//! What a faulty declaration expands to beside its errors: just enough that nothing else is reported.

use proc_macro2::{Literal, TokenStream};
use quote::quote;
use syn::{Data, DeriveInput};

use super::input;

/// Implements for the item, whatever it is, what the derive would have: the user then reads the errors of the
/// declaration, and not that `Thug` has no `default`.
pub fn fallback(input: &DeriveInput) -> TokenStream {
    let krate = input::crate_override(input).unwrap_or_else(|| quote!(::aim));
    let private = quote!(#krate::__private);
    let name = &input.ident;
    let (generics, arguments, clause) = input.generics.split_for_impl();
    let siblings = input::sibling_derives(input);
    let has = |derive: &str| siblings.iter().any(|sibling| sibling == derive);
    // As many joints as fields: a correct use of a wrong declaration is no mistake of its own.
    let joints = Literal::usize_unsuffixed(match &input.data {
        Data::Struct(data) => data.fields.len(),
        Data::Enum(_) | Data::Union(_) => 0,
    });
    // It never runs, as the errors beside it keep it from being compiled; but it must not warn either.
    let body = quote!({ ::core::unreachable!() });
    let default = (!has("Default")).then(|| {
        quote! {
            #[automatically_derived]
            impl #generics ::core::default::Default for #name #arguments #clause {
                fn default() -> Self #body
            }
        }
    });
    let debug = (!has("Debug")).then(|| {
        quote! {
            #[automatically_derived]
            impl #generics ::core::fmt::Debug for #name #arguments #clause {
                fn fmt(&self, _: &mut ::core::fmt::Formatter<'_>) -> ::core::fmt::Result #body
            }
        }
    });
    quote! {
        #default
        #debug
        #[automatically_derived]
        impl #generics #name #arguments #clause {
            #[doc(hidden)]
            pub const BONES: [&'static [&'static ::core::primitive::str]; 0] = [];
        }
        #[automatically_derived]
        impl #generics #private::AimRig for #name #arguments #clause {
            type Array<__T: ::core::marker::Copy> = [__T; #joints];
            fn array<__T: ::core::marker::Copy>(&self, _: __T) -> [__T; #joints] #body
            fn joint_infos(&self) -> &[#private::JointInfo] #body
            fn effector(&self) -> #private::Effector #body
            fn joints(&self) -> [#private::Joint; #joints] #body
            fn set_joints(&mut self, _: [#private::Joint; #joints]) #body
            fn aim_gradient<__S: #private::Scalar>(
                &self,
                _: ::core::primitive::usize,
                _: &[__S; 12],
                _: &[__S; 3],
                _: &[__S; 4],
            ) -> [__S; 3] #body
            fn chain_value_gradient<__S: #private::Scalar>(
                &self,
                _: &[[__S; 12]],
                _: &[__S; 3],
                _: &[[__S; 4]],
                _: &mut [__S],
            ) #body
            fn chain_residual_jacobian<__S: #private::Scalar>(
                &self,
                _: &[[__S; 12]],
                _: &[__S; 3],
                _: &[[__S; 4]],
                _: &mut [__S],
            ) #body
        }
    }
}
