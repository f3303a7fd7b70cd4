//! The arguments that an item's generic parameters stand for where it is named.

use proc_macro2::{Group, Literal, TokenStream, TokenTree};
use quote::quote;

use super::items::{Items, Parameter};
use super::lower::Scope;
use super::{lower, names};

/// Generic parameters of a struct or an enum, and the arguments that they stand for.
pub(super) type Given = Vec<(String, TokenStream)>;

/// The arguments of a type, by its parameters; `None` where there are not as many.
pub(super) fn given(parameters: &[Parameter], path: &syn::Path, scope: &Scope, items: &Items) -> Option<Given> {
    let written = names::arguments(path);
    let given = parameters.iter().zip(&written).map(|(parameter, written)| {
        let length = match (parameter.is_length, syn::parse2(quote!(#written))) {
            (true, Ok(length)) => lower::length(&length, items, scope).map(Literal::usize_unsuffixed),
            _ => None,
        };
        (parameter.name.clone(), length.map_or_else(|| quote!(#written), |length| quote!(#length)))
    });
    (parameters.len() == written.len()).then(|| given.collect())
}

/// A type with what stands for the parameters of a path's item in their place; `None` where there are not as many.
pub(super) fn written_out(
    ty: &syn::Type,
    parameters: &[Parameter],
    path: &syn::Path,
    scope: &Scope,
    items: &Items,
) -> Option<syn::Type> {
    syn::parse2(with(quote!(#ty), &given(parameters, path, scope, items)?)).ok()
}

/// Tokens with what stands for parameters in their place.
pub(super) fn with(tokens: TokenStream, given: &Given) -> TokenStream {
    if given.is_empty() {
        return tokens;
    }
    let replaced = tokens.into_iter().map(|token| match &token {
        TokenTree::Ident(word) => match given.iter().find(|(name, _)| word == name) {
            Some((_, instead)) => instead.clone(),
            None => token.into(),
        },
        TokenTree::Group(group) => {
            let mut inner = Group::new(group.delimiter(), with(group.stream(), given));
            inner.set_span(group.span());
            TokenTree::Group(inner).into()
        }
        _ => token.into(),
    });
    replaced.collect()
}
