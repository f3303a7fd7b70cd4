//! Substitution of generic parameters by the arguments that a path gives.

use proc_macro2::{Group, Literal, TokenStream, TokenTree};
use quote::quote;

use super::items::{Items, Parameter};
use super::lower::Scope;
use super::{lower, names};

/// Generic parameters of a struct or an enum, each with its argument.
pub(super) type GenericArguments = Vec<(String, TokenStream)>;

/// Returns the argument of each parameter; `None` if their numbers differ.
pub(super) fn generic_arguments(
    parameters: &[Parameter],
    path: &syn::Path,
    scope: &Scope,
    items: &Items,
) -> Option<GenericArguments> {
    let written = names::arguments(path);
    let arguments = parameters.iter().zip(&written).map(|(parameter, written)| {
        let length = match (parameter.is_length, syn::parse2(quote!(#written))) {
            (true, Ok(length)) => lower::length(&length, items, scope).map(Literal::usize_unsuffixed),
            _ => None,
        };
        (parameter.name.clone(), length.map_or_else(|| quote!(#written), |length| quote!(#length)))
    });
    (parameters.len() == written.len()).then(|| arguments.collect())
}

/// Returns a type with the generic parameters of the path's item replaced by the path's arguments; `None` if their
/// numbers differ.
pub(super) fn substituted(
    ty: &syn::Type,
    parameters: &[Parameter],
    path: &syn::Path,
    scope: &Scope,
    items: &Items,
) -> Option<syn::Type> {
    syn::parse2(substitute(quote!(#ty), &generic_arguments(parameters, path, scope, items)?)).ok()
}

/// Replaces parameters in tokens by their arguments.
pub(super) fn substitute(tokens: TokenStream, arguments: &GenericArguments) -> TokenStream {
    if arguments.is_empty() {
        return tokens;
    }
    let replaced = tokens.into_iter().map(|token| match &token {
        TokenTree::Ident(word) => match arguments.iter().find(|(name, _)| word == name) {
            Some((_, instead)) => instead.clone(),
            None => token.into(),
        },
        TokenTree::Group(group) => {
            let mut inner = Group::new(group.delimiter(), substitute(group.stream(), arguments));
            inner.set_span(group.span());
            TokenTree::Group(inner).into()
        }
        _ => token.into(),
    });
    replaced.collect()
}
