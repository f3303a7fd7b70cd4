//! A derive macro's input → the neutral tree. Reports nothing.

use proc_macro2::{Span, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Data, DeriveInput, Fields, Meta};

use super::place::Place;
use super::tokens::{entries, word_of};
use super::tree::{Attribute, Entry, ItemFacts, Joint, Kind, Notation, Rig, Section, Value, Word};

/// Reads the whole input.
pub(crate) fn read(input: &DeriveInput) -> Rig {
    let mut item = ItemFacts::default();
    let joints = match &input.data {
        Data::Struct(data) => match &data.fields {
            Fields::Named(fields) => fields.named.iter().map(|field| read_joint(field, &mut item)).collect(),
            Fields::Unnamed(_) => wrong_shape(&mut item, "a tuple struct", &input.ident),
            Fields::Unit => wrong_shape(&mut item, "a unit struct", &input.ident),
        },
        Data::Enum(data) => wrong_shape(&mut item, "an enum", &data.enum_token),
        Data::Union(data) => wrong_shape(&mut item, "a union", &data.union_token),
    };
    let generics = &input.generics;
    if !generics.params.is_empty() {
        item.generics = Some(Place::of(&generics.params));
    } else if let Some(clause) = &generics.where_clause {
        item.generics = Some(Place::of(clause));
    } else if let (Some(less), Some(_)) = (&generics.lt_token, &generics.gt_token) {
        // `struct Thug<>` is harmless, but there is no reason to write it.
        item.generics = Some(Place::of(less));
    }
    for attribute in &input.attrs {
        if attribute.path().is_ident("joint") {
            item.misplaced.push(Word { text: "joint".into(), place: Place::of(attribute.path()) });
        } else if attribute.path().is_ident("derive") {
            read_derives(&attribute.meta, &mut item);
        }
    }
    Rig {
        notation: Notation::Rust,
        name: Some(name_of(&input.ident)),
        section: read_section(&input.attrs, "aim", &input.ident),
        joints,
        item,
    }
}

/// The path of `crate = …`, whatever else is wrong.
pub(crate) fn crate_override(input: &DeriveInput) -> Option<TokenStream> {
    let section = read_section(&input.attrs, "aim", &input.ident);
    section.entries.into_iter().find_map(|entry| match entry {
        Entry::Item(item) if item.key.text == "crate" => match item.value.kind {
            Kind::Path(path) => Some(path),
            _ => None,
        },
        _ => None,
    })
}

/// The sibling derives that a macro can see: those of later `#[derive]` attributes. Rustc takes those of its own
/// attribute and of earlier ones away before it calls us, and then reports the conflict itself.
pub(crate) fn sibling_derives(input: &DeriveInput) -> Vec<String> {
    let mut item = ItemFacts::default();
    for attribute in input.attrs.iter().filter(|attribute| attribute.path().is_ident("derive")) {
        read_derives(&attribute.meta, &mut item);
    }
    item.derives.into_iter().map(|word| word.text).collect()
}

fn wrong_shape(item: &mut ItemFacts, what: &'static str, tokens: &impl ToTokens) -> Vec<Joint> {
    item.wrong_shape = Some((what, Place::of(tokens)));
    Vec::new()
}

fn read_joint(field: &syn::Field, item: &mut ItemFacts) -> Joint {
    for attribute in field.attrs.iter().filter(|attribute| attribute.path().is_ident("aim")) {
        item.misplaced.push(Word { text: "aim".into(), place: Place::of(attribute.path()) });
    }
    let name = field.ident.as_ref();
    // Fields of a named struct have names; a call site span is only what keeps this total.
    let fallback = proc_macro2::Ident::new("_joint", Span::call_site());
    let section = read_section(&field.attrs, "joint", name.unwrap_or(&fallback));
    Joint { name: name.map(name_of), section }
}

fn read_section(attributes: &[syn::Attribute], name: &str, owner: &syn::Ident) -> Section {
    let ours = attributes.iter().filter(|attribute| attribute.path().is_ident(name));
    let mut section = Section { place: Place::span(owner.span()), attributes: Vec::new(), entries: Vec::new() };
    for attribute in ours {
        let place = Place::of(attribute.path());
        let list = match &attribute.meta {
            Meta::List(list) => Some(list.tokens.clone()),
            Meta::Path(_) | Meta::NameValue(_) => None,
        };
        section.attributes.push(Attribute { place, has_list: list.is_some() });
        section.entries.extend(entries(list.unwrap_or_default()));
    }
    section
}

fn read_derives(meta: &Meta, item: &mut ItemFacts) {
    let Meta::List(list) = meta else { return };
    for token in list.tokens.clone() {
        if let TokenTree::Ident(ident) = token {
            if ident == "Default" || ident == "Debug" {
                item.derives.push(word_of(&ident));
            }
        }
    }
}

fn name_of(ident: &syn::Ident) -> Value {
    let Word { text, place } = word_of(ident);
    Value { kind: Kind::Text(text), place }
}
