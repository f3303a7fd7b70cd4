//! Parses a derive macro's input into the neutral tree. Reports nothing.

use proc_macro2::{Span, TokenStream};
use quote::ToTokens;
use syn::{Data, DeriveInput, Fields, Meta};

use super::tokens::{entries, word_of};
use crate::declare::source_place::SourcePlace;
use crate::declare::tree::{Attribute, Entry, ItemFacts, Joint, Kind, Notation, Rig, Section, Value, Word};

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
        item.generics = Some(SourcePlace::of(&generics.params));
    } else if let Some(clause) = &generics.where_clause {
        item.generics = Some(SourcePlace::of(clause));
    } else if let (Some(less), Some(_)) = (&generics.lt_token, &generics.gt_token) {
        // `struct Thug<>` is harmless, but there is no reason to write it.
        item.generics = Some(SourcePlace::of(less));
    }
    for attribute in &input.attrs {
        if attribute.path().is_ident("joint") {
            item.misplaced.push(Word { text: "joint".into(), place: SourcePlace::of(attribute.path()) });
        }
    }
    Rig {
        notation: Notation::Rust,
        name: Some(name_of(&input.ident)),
        section: read_section(&input.attrs, "aim", input.ident.span()),
        joints,
        item,
    }
}

/// Returns the path of `crate = …`, even if the declaration has other errors.
pub(crate) fn crate_override(input: &DeriveInput) -> Option<TokenStream> {
    let section = read_section(&input.attrs, "aim", input.ident.span());
    section.entries.into_iter().find_map(|entry| match entry {
        Entry::Item(item) if item.key.text == "crate" => match item.value.kind {
            Kind::Path(path) => Some(path),
            _ => None,
        },
        _ => None,
    })
}

fn wrong_shape(item: &mut ItemFacts, what: &'static str, tokens: &impl ToTokens) -> Vec<Joint> {
    item.wrong_shape = Some((what, SourcePlace::of(tokens)));
    Vec::new()
}

fn read_joint(field: &syn::Field, item: &mut ItemFacts) -> Joint {
    for attribute in field.attrs.iter().filter(|attribute| attribute.path().is_ident("aim")) {
        item.misplaced.push(Word { text: "aim".into(), place: SourcePlace::of(attribute.path()) });
    }
    let name = field.ident.as_ref();
    // Fields of a struct with named fields always have a name; the call-site span is an unreachable fallback.
    let section = read_section(&field.attrs, "joint", name.map_or_else(Span::call_site, syn::Ident::span));
    if let (Some(name), false) = (name, section.attributes.is_empty()) {
        if !may_be_joint(&field.ty) {
            let text = field.ty.to_token_stream().to_string();
            let text = [("& ", "&"), (" < ", "<"), (" >", ">"), (" :: ", "::")]
                .iter()
                .fold(text, |text, (spaced, usual)| text.replace(spaced, usual));
            item.foreign.push((name.to_string(), Word { text, place: SourcePlace::of(&field.ty) }));
        }
    }
    Joint { name: name.map(name_of), section }
}

/// Returns `false` if the type certainly is not `Joint`, judged by its tokens. A path of any name may be an alias of
/// `Joint`, except for the names of numbers and other common types, which nobody uses for a different type.
fn may_be_joint(found: &syn::Type) -> bool {
    const OTHERS: &str = "bool char str String f32 f64 i8 i16 i32 i64 i128 isize u8 u16 u32 u64 u128 usize \
                          Vec2 Vec3 Vec3A Vec4 Quat Mat3 Mat4 Affine3A Transform Entity";
    match found {
        syn::Type::Group(group) => may_be_joint(&group.elem),
        syn::Type::Paren(paren) => may_be_joint(&paren.elem),
        syn::Type::Macro(_) => true,
        syn::Type::Path(path) => path
            .path
            .segments
            .last()
            .is_some_and(|last| last.arguments.is_none() && !OTHERS.split(' ').any(|other| last.ident == other)),
        _ => false,
    }
}

fn read_section(attributes: &[syn::Attribute], name: &str, owner: Span) -> Section {
    let ours = attributes.iter().filter(|attribute| attribute.path().is_ident(name));
    let mut section = Section { place: SourcePlace::span(owner), attributes: Vec::new(), entries: Vec::new() };
    for attribute in ours {
        let place = SourcePlace::of(attribute.path());
        let list = match &attribute.meta {
            Meta::List(list) => Some(list.tokens.clone()),
            Meta::Path(_) | Meta::NameValue(_) => None,
        };
        section.attributes.push(Attribute { place, has_list: list.is_some() });
        section.entries.extend(entries(list.unwrap_or_default()));
    }
    section
}

fn name_of(ident: &syn::Ident) -> Value {
    let Word { text, place } = word_of(ident);
    Value { kind: Kind::Text(text), place }
}
