//! Types of arguments and results, recognised by the last segment of their paths. Emits the code that takes their
//! values apart and builds them.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};
use syn::{Ident, Member};

use super::generic_arguments::{GenericArguments, generic_arguments, substitute, substituted};
use super::items::{Enumeration, Items, Structure};
use super::lower::Scope;
use super::names::{self, Meaning, segments};
use super::{lower, messages};
use crate::declare::report::text::Text;
pub(super) use crate::emit::Precision;

/// Structure of a type's values.
#[derive(Clone)]
pub(super) enum Shape {
    Truth,
    Integer,
    Scalar,
    Planar,
    Vector,
    Four,
    Quaternion,
    Matrix,
    /// A square matrix of two or four columns.
    Square(usize),
    Rigid,
    Array(Box<Type>, usize),
    /// A borrowed slice of unknown length.
    Slice(Box<Type>),
    /// An option: 1 or 0, then the numbers of the value inside, all 0 if there is none.
    Optional(Box<Type>),
    Tuple(Vec<Type>),
    /// Index of an enum variant; the field is the number of variants.
    Choice(usize),
    /// An enum of the module: its name and its variants.
    Enum(String, Vec<Variant>),
    /// A struct of the module: its name, its fields of supported types, and `true` if those are all its fields.
    Struct(String, Vec<(Member, Type)>, bool),
}

/// A variant of an enum.
#[derive(Clone)]
pub(super) struct Variant {
    pub(super) name: Ident,
    /// The fields of supported types.
    pub(super) fields: Vec<(Member, Type)>,
    /// `true` if those are all its fields.
    pub(super) is_whole: bool,
}

/// Supported types, by name.
const KNOWN: [(&str, Shape, Precision); 22] = [
    ("f32", Shape::Scalar, Precision::Single),
    ("f64", Shape::Scalar, Precision::Double),
    ("Vec2", Shape::Planar, Precision::Single),
    ("DVec2", Shape::Planar, Precision::Double),
    ("Vec3", Shape::Vector, Precision::Single),
    ("Vec3A", Shape::Vector, Precision::Single),
    ("DVec3", Shape::Vector, Precision::Double),
    ("Vec4", Shape::Four, Precision::Single),
    ("DVec4", Shape::Four, Precision::Double),
    ("Quat", Shape::Quaternion, Precision::Single),
    ("DQuat", Shape::Quaternion, Precision::Double),
    ("Mat3", Shape::Matrix, Precision::Single),
    ("Mat3A", Shape::Matrix, Precision::Single),
    ("DMat3", Shape::Matrix, Precision::Double),
    ("Mat2", Shape::Square(2), Precision::Single),
    ("DMat2", Shape::Square(2), Precision::Double),
    ("Mat4", Shape::Square(4), Precision::Single),
    ("DMat4", Shape::Square(4), Precision::Double),
    ("Rigid", Shape::Rigid, Precision::Single),
    ("Affine3A", Shape::Rigid, Precision::Single),
    ("DRigid", Shape::Rigid, Precision::Double),
    ("DAffine3", Shape::Rigid, Precision::Double),
];

const INTEGERS: [&str; 10] = ["u8", "u16", "u32", "u64", "usize", "i8", "i16", "i32", "i64", "isize"];

/// Returns the shape and precision of the type with this name.
pub(super) fn named(name: &str) -> Option<(Shape, Precision)> {
    KNOWN.iter().find(|(known, ..)| *known == name).map(|(_, shape, precision)| (shape.clone(), *precision))
}

/// Returns `true` if the type with this name is an integer type.
pub(super) fn is_integer(name: &str) -> bool {
    INTEGERS.contains(&name)
}

/// Returns `true` if the type with this name is an unsigned integer type.
pub(super) fn is_unsigned(name: &str) -> bool {
    is_integer(name) && name.starts_with('u')
}

/// Returns the smallest and the largest number of an integer type. The ends of wide types are infinite, because no
/// count reaches them.
pub(super) fn ends(name: &str) -> (f64, f64) {
    match name {
        "u8" => (0.0, u8::MAX.into()),
        "i8" => (i8::MIN.into(), i8::MAX.into()),
        "u16" => (0.0, u16::MAX.into()),
        "i16" => (i16::MIN.into(), i16::MAX.into()),
        "u32" => (0.0, u32::MAX.into()),
        "i32" => (i32::MIN.into(), i32::MAX.into()),
        "u64" | "u128" | "usize" => (0.0, f64::INFINITY),
        _ => (f64::NEG_INFINITY, f64::INFINITY),
    }
}

/// Iterates over the types of this precision whose shape satisfies `is_it`.
pub(super) fn named_like(
    precision: Option<Precision>,
    is_it: impl Fn(&Shape) -> bool,
) -> impl Iterator<Item = &'static str> {
    let fits = move |precision_of: Precision| precision.is_none_or(|precision| precision == precision_of);
    let like = KNOWN.iter().filter(move |(_, shape, precision)| fits(*precision) && is_it(shape));
    like.map(|(name, ..)| *name)
}

/// A type as the user wrote it.
#[derive(Clone)]
pub(super) struct Type {
    pub(super) shape: Shape,
    /// Number type; `None` if it holds no floating-point numbers.
    pub(super) precision: Option<Precision>,
    /// Tokens of the type, without a reference.
    pub(super) tokens: TokenStream,
    /// Path before its name, including the last `::`.
    module: TokenStream,
    /// `true` if its values are passed by reference.
    pub(super) borrowed: bool,
}

type TypeError = (TokenStream, Text);

fn unknown(written: &syn::Type) -> TypeError {
    let known: Vec<&str> = KNOWN.iter().map(|(name, ..)| *name).collect();
    let tokens = quote!(#written);
    let name = match written {
        syn::Type::Path(path) => path.path.segments.last().map(|last| last.ident.to_string()),
        _ => None,
    };
    if let Some(name) = name.filter(|name| names::is_unsupported(name)) {
        return (tokens, messages::unsupported_type(&name));
    }
    let text = messages::unknown_type(&tokens.to_string(), &known);
    (tokens, text)
}

impl Type {
    /// Parses a type, also in invisible groups and behind one reference. Returns an error and its place if it is not
    /// supported.
    pub(super) fn parse(written: &syn::Type, items: &Items) -> Result<Self, TypeError> {
        Self::parse_in(&Scope::default(), written, items)
    }

    /// Parses a type that is written in `scope`, elsewhere in the module.
    pub(super) fn parse_in(scope: &Scope, written: &syn::Type, items: &Items) -> Result<Self, TypeError> {
        let unknown = || unknown(written);
        match written {
            syn::Type::Group(group) => Self::parse_in(scope, &group.elem, items),
            syn::Type::Paren(paren) => Self::parse_in(scope, &paren.elem, items),
            syn::Type::Reference(reference) => {
                if let Some(mutability) = &reference.mutability {
                    return Err((quote!(#mutability), messages::mutable_reference()));
                }
                if let syn::Type::Slice(slice) = &*reference.elem {
                    // Report an unsupported element type first: giving a length would not help.
                    Self::parse_in(scope, &slice.elem, items)?;
                    let element = slice.elem.to_token_stream().to_string();
                    return Err((quote!(#slice), messages::slice(&element)));
                }
                let inner = Self::parse_in(scope, &reference.elem, items)?;
                if inner.borrowed { Err(unknown()) } else { Ok(Self { borrowed: true, ..inner }) }
            }
            syn::Type::Path(path) if path.qself.is_none() => {
                let Some(last) = path.path.segments.last() else { return Err(unknown()) };
                if last.ident == "Option" && !last.arguments.is_none() {
                    return Self::of_option(scope, written, last, items);
                }
                let meaning = match &scope.self_type {
                    Some(of) if path.path.is_ident("Self") => Meaning::Own(of.clone()),
                    _ => items.meaning(scope, &segments(&path.path)),
                };
                // Tokens that name the type from the module that is read.
                let tokens_of = |name: &str| match syn::parse_str::<syn::Type>(name) {
                    Ok(ty) if !scope.module.is_empty() => {
                        let arguments = &last.arguments;
                        quote!(#ty #arguments)
                    }
                    _ => quote!(#written),
                };
                if let Meaning::Own(name) = &meaning {
                    if let Some(alias) = items.alias(name) {
                        let ty = substituted(&alias.ty, &alias.parameters, &path.path, scope, items);
                        let ty = ty.ok_or_else(unknown)?;
                        return Ok(Self { tokens: tokens_of(name), ..Self::parse_in(&alias.scope, &ty, items)? });
                    }
                    if let Some(structure) = items.structure(name) {
                        let arguments =
                            generic_arguments(&structure.parameters, &path.path, scope, items).ok_or_else(unknown)?;
                        let read =
                            items.once(name, || Self::of_struct(tokens_of(name), name, structure, &arguments, items));
                        return read.ok_or_else(unknown)?;
                    }
                    if let Some(enumeration) = items.enumeration(name) {
                        let arguments =
                            generic_arguments(&enumeration.parameters, &path.path, scope, items).ok_or_else(unknown)?;
                        let read =
                            items.once(name, || Self::of_enum(tokens_of(name), name, enumeration, &arguments, items));
                        return read.ok_or_else(unknown)?;
                    }
                    return Err(unknown());
                }
                if !last.arguments.is_none() {
                    return Err(unknown());
                }
                let name = meaning.into_type();
                let (shape, precision) = match name.as_str() {
                    "bool" => (Shape::Truth, None),
                    name if INTEGERS.contains(&name) => (Shape::Integer, None),
                    name => named(name).map(|(shape, precision)| (shape, Some(precision))).ok_or_else(unknown)?,
                };
                let (leading, segments) = (&path.path.leading_colon, &path.path.segments);
                let before = segments.iter().take(segments.len() - 1);
                let module = if segments.len() > 1 { quote!(#leading #(#before::)*) } else { quote!() };
                Ok(Self { shape, precision, tokens: quote!(#written), module, borrowed: false })
            }
            syn::Type::Array(array) => {
                let element = Self::parse_in(scope, &array.elem, items)?;
                let length = lower::length(&array.len, items, scope)
                    .ok_or_else(|| (quote!(#array), messages::length_unknown()))?;
                if element.borrowed || element.has_slice() {
                    return Err(unknown());
                }
                let precision = element.precision;
                Self::of_parts(quote!(#written), Shape::Array(Box::new(element), length), precision)
            }
            syn::Type::Tuple(tuple) if !tuple.elems.is_empty() => {
                let parts: Vec<Self> =
                    tuple.elems.iter().map(|part| Self::parse_in(scope, part, items)).collect::<Result<_, _>>()?;
                if parts.iter().any(|part| part.borrowed) {
                    return Err(unknown());
                }
                let precision = parts.iter().find_map(|part| part.precision);
                Self::of_parts(quote!(#written), Shape::Tuple(parts), precision)
            }
            _ => Err(unknown()),
        }
    }

    fn of_option(
        scope: &Scope,
        written: &syn::Type,
        last: &syn::PathSegment,
        items: &Items,
    ) -> Result<Self, TypeError> {
        if let syn::PathArguments::AngleBracketed(of) = &last.arguments
            && let Some(syn::GenericArgument::Type(inner)) = of.args.first()
        {
            let inner = Self::parse_in(scope, inner, items)?;
            if !inner.borrowed && !inner.has_slice() {
                let precision = inner.precision;
                return Self::of_parts(quote!(#written), Shape::Optional(Box::new(inner)), precision);
            }
        }
        Err(unknown(written))
    }

    /// Returns the type of truth values.
    pub(super) fn truth() -> Self {
        Self::made(quote!(::core::primitive::bool), Shape::Truth, None)
    }

    /// Returns the type of an index of one of `variants` enum variants.
    pub(super) fn choice(variants: usize) -> Self {
        Self::made(quote!(::core::primitive::usize), Shape::Choice(variants), None)
    }

    /// Returns a struct of the module. Fields of unsupported types are left out.
    fn of_struct(
        tokens: TokenStream,
        name: &str,
        structure: &Structure,
        arguments: &GenericArguments,
        items: &Items,
    ) -> Result<Self, TypeError> {
        let fields = Self::of_fields(&structure.scope, &structure.fields, arguments, items);
        let precision = fields.iter().find_map(|(_, ty)| ty.precision);
        let whole = fields.len() == structure.fields.len();
        Self::of_parts(tokens, Shape::Struct(name.to_owned(), fields, whole), precision)
    }

    /// Returns the types of the fields that are supported.
    fn of_fields(
        scope: &Scope,
        declared: &[(Member, syn::Type)],
        arguments: &GenericArguments,
        items: &Items,
    ) -> Vec<(Member, Self)> {
        let known = declared.iter().filter_map(|(member, ty)| {
            let ty = syn::parse2(substitute(quote!(#ty), arguments)).ok()?;
            let slice = Self::slice(&ty, scope, items);
            let ty = slice.or_else(|| Self::parse_in(scope, &ty, items).ok().filter(|ty| !ty.borrowed))?;
            Some((member.clone(), ty))
        });
        known.collect()
    }

    /// Returns an enum of the module.
    fn of_enum(
        tokens: TokenStream,
        name: &str,
        of: &Enumeration,
        arguments: &GenericArguments,
        items: &Items,
    ) -> Result<Self, TypeError> {
        let variants = of.variants.iter().map(|variant| {
            let mut fields = Self::of_fields(&of.scope, &variant.fields, arguments, items);
            fields.retain(|(_, ty)| !ty.has_slice());
            let is_whole = fields.len() == variant.fields.len();
            Variant { name: format_ident!("{}", variant.name), fields, is_whole }
        });
        let variants: Vec<_> = variants.collect();
        let precision = variants.iter().flat_map(|variant| &variant.fields).find_map(|(_, ty)| ty.precision);
        Self::of_parts(tokens, Shape::Enum(name.to_owned(), variants), precision)
    }

    fn of_parts(tokens: TokenStream, shape: Shape, precision: Option<Precision>) -> Result<Self, TypeError> {
        let ty = Self::made(tokens, shape, precision);
        if ty.components() > LONGEST { Err((ty.tokens, messages::too_many_numbers(LONGEST))) } else { Ok(ty) }
    }

    /// Returns a type that the user did not write.
    pub(super) fn made(tokens: TokenStream, shape: Shape, precision: Option<Precision>) -> Self {
        Self { shape, precision, tokens, module: TokenStream::new(), borrowed: false }
    }

    /// Returns a number type inside this type that differs from `expected`.
    pub(super) fn other_precision(&self, expected: Precision) -> Option<Precision> {
        match &self.shape {
            Shape::Array(element, _) | Shape::Slice(element) | Shape::Optional(element) => {
                element.other_precision(expected)
            }
            Shape::Tuple(parts) => parts.iter().find_map(|part| part.other_precision(expected)),
            Shape::Struct(_, fields, _) => fields.iter().find_map(|(_, field)| field.other_precision(expected)),
            Shape::Enum(_, variants) => {
                let mut fields = variants.iter().flat_map(|variant| &variant.fields);
                fields.find_map(|(_, field)| field.other_precision(expected))
            }
            _ => self.precision.filter(|&precision| precision != expected),
        }
    }

    /// Returns `true` if a function's result may have this type.
    pub(super) fn is_result(&self) -> bool {
        match &self.shape {
            Shape::Truth | Shape::Integer | Shape::Choice(_) => false,
            Shape::Slice(_) | Shape::Optional(_) | Shape::Enum(..) => false,
            Shape::Array(element, _) => element.is_result(),
            Shape::Tuple(parts) => parts.iter().all(Self::is_result),
            Shape::Struct(_, fields, whole) => *whole && fields.iter().all(|(_, field)| field.is_result()),
            _ => !self.borrowed,
        }
    }

    /// Returns the name of a struct and of its first field that keeps it from being a result; `None` if a struct does
    /// not.
    pub(super) fn field_without_numbers(&self, items: &Items) -> Option<(String, String)> {
        match &self.shape {
            Shape::Array(element, _) => element.field_without_numbers(items),
            Shape::Tuple(parts) => parts.iter().find_map(|part| part.field_without_numbers(items)),
            Shape::Struct(name, fields, _) => items.structure(name)?.fields.iter().find_map(|(member, _)| {
                let known = fields.iter().find(|(known, _)| known == member).map(|(_, ty)| ty);
                let is_result = known.is_some_and(Self::is_result);
                let inside = known.and_then(|ty| ty.field_without_numbers(items));
                inside.or_else(|| (!is_result).then(|| (name.clone(), member.to_token_stream().to_string())))
            }),
            _ => None,
        }
    }

    /// Returns the type of owned values.
    pub(super) fn owned(&self) -> Self {
        Self { borrowed: false, ..self.clone() }
    }

    /// Returns the smallest and the largest whole number of this type.
    pub(super) fn extent(&self) -> (f64, f64) {
        match self.shape {
            #[expect(clippy::cast_precision_loss, reason = "types have few variants")]
            Shape::Choice(variants) => (0.0, variants as f64 - 1.0),
            _ => ends(&self.tokens.to_string()),
        }
    }

    /// Returns the number of numbers in a value.
    pub(super) fn components(&self) -> usize {
        match &self.shape {
            // For a slice, its length.
            Shape::Truth | Shape::Integer | Shape::Choice(_) | Shape::Scalar | Shape::Slice(_) => 1,
            Shape::Planar => 2,
            Shape::Vector => 3,
            Shape::Four | Shape::Quaternion => 4,
            Shape::Matrix => 9,
            Shape::Square(count) => count * count,
            Shape::Rigid => 12,
            Shape::Array(element, length) => element.components().saturating_mul(*length),
            Shape::Optional(inner) => 1 + inner.components(),
            Shape::Tuple(parts) => parts.iter().map(Self::components).sum(),
            Shape::Struct(_, fields, _) => fields.iter().map(|(_, field)| field.components()).sum(),
            Shape::Enum(_, variants) => {
                let fields = variants.iter().flat_map(|variant| &variant.fields);
                1 + fields.map(|(_, field)| field.components()).sum::<usize>()
            }
        }
    }

    /// Appends the numbers of the value that `place` names, converted to this number type.
    pub(super) fn numbers(&self, place: &TokenStream, number: Precision, to: &mut Vec<TokenStream>) {
        let value = if self.borrowed { quote!((*#place)) } else { place.clone() };
        let number_type = format_ident!("{}", number.name());
        let fields = |fields: &[&str]| -> Vec<TokenStream> {
            fields.iter().map(|field| format_ident!("{field}")).map(|field| quote!(#place.#field)).collect()
        };
        let columns = |place: TokenStream, count: usize| -> Vec<TokenStream> {
            let parts = COLUMNS[..count].iter().flat_map(|column| XYZW[..count].iter().map(move |row| (column, row)));
            let parts = parts.map(|(column, row)| (format_ident!("{column}"), format_ident!("{row}")));
            parts.map(|(column, row)| quote!(#place.#column.#row)).collect()
        };
        match &self.shape {
            Shape::Truth => to.push(quote!((#value as ::core::primitive::u8 as ::core::primitive::#number_type))),
            Shape::Integer | Shape::Choice(_) => to.push(quote!((#value as ::core::primitive::#number_type))),
            Shape::Slice(_) => to.push(quote!((#place.len() as ::core::primitive::#number_type))),
            Shape::Scalar if self.borrowed => to.push(quote!(*#place)),
            Shape::Scalar => to.push(place.clone()),
            Shape::Planar | Shape::Vector | Shape::Four | Shape::Quaternion => {
                to.extend(fields(&XYZW[..self.components()]));
            }
            Shape::Matrix => to.extend(columns(place.clone(), 3)),
            Shape::Square(count) => to.extend(columns(place.clone(), *count)),
            Shape::Rigid => {
                to.extend(columns(quote!(#place.matrix3), 3));
                to.extend(
                    XYZW[..3].iter().map(|row| format_ident!("{row}")).map(|row| quote!(#place.translation.#row)),
                );
            }
            Shape::Optional(inner) => {
                to.push(quote!((#value.is_some() as ::core::primitive::u8 as ::core::primitive::#number_type)));
                let mut numbers = Vec::new();
                inner.numbers(&quote!((*value)), number, &mut numbers);
                to.extend(numbers.iter().map(|number| {
                    quote!((match &#value {
                        ::core::option::Option::Some(value) => #number,
                        ::core::option::Option::None => 0.0,
                    }))
                }));
            }
            // The index of the variant, then the fields of all variants; those of other variants are 0.
            Shape::Enum(_, variants) => {
                let ty = self.path();
                let names = variants.iter().map(|variant| &variant.name);
                let tags = (0_u32..).map(|tag| Literal::f64_unsuffixed(tag.into()));
                let arms = names.zip(tags).map(|(name, tag)| quote!(#ty::#name { .. } => #tag,));
                to.push(quote!((match &#value { #(#arms)* })));
                for Variant { name, fields, .. } in variants {
                    for (member, field) in fields {
                        let mut numbers = Vec::new();
                        field.numbers(&quote!((*value)), number, &mut numbers);
                        let otherwise = (variants.len() > 1).then(|| quote!(_ => 0.0,));
                        to.extend(numbers.iter().map(|number| {
                            quote!((match &#value { #ty::#name { #member: value, .. } => #number, #otherwise }))
                        }));
                    }
                }
            }
            Shape::Array(element, length) => {
                for index in (0..*length).map(Literal::usize_unsuffixed) {
                    element.numbers(&quote!(#place[#index]), number, to);
                }
            }
            Shape::Tuple(parts) => {
                for (index, part) in parts.iter().enumerate() {
                    let member = Member::from(index);
                    part.numbers(&quote!(#place.#member), number, to);
                }
            }
            Shape::Struct(_, fields, _) => {
                for (member, field) in fields {
                    field.numbers(&quote!(#place.#member), number, to);
                }
            }
        }
    }

    /// Visits the parts that are not composed of others, in the order of their numbers.
    pub(super) fn leaves(&self, each: &mut dyn FnMut(&Self)) {
        match &self.shape {
            Shape::Array(element, length) => (0..*length).for_each(|_| element.leaves(each)),
            Shape::Slice(_) => each(&Self::made(quote!(::core::primitive::usize), Shape::Integer, None)),
            Shape::Optional(inner) => {
                each(&Self::truth());
                inner.leaves(each);
            }
            Shape::Tuple(parts) => parts.iter().for_each(|part| part.leaves(each)),
            Shape::Struct(_, fields, _) => fields.iter().for_each(|(_, field)| field.leaves(each)),
            Shape::Enum(_, variants) => {
                each(&Self::choice(variants.len()));
                variants.iter().flat_map(|variant| &variant.fields).for_each(|(_, field)| field.leaves(each));
            }
            _ => each(self),
        }
    }

    /// Returns `true` if a value can be built from its numbers alone.
    pub(super) fn is_whole(&self) -> bool {
        match &self.shape {
            Shape::Array(element, _) | Shape::Slice(element) | Shape::Optional(element) => element.is_whole(),
            Shape::Tuple(parts) => parts.iter().all(Self::is_whole),
            Shape::Struct(_, fields, whole) => *whole && fields.iter().all(|(_, field)| field.is_whole()),
            Shape::Enum(_, variants) => variants
                .iter()
                .all(|variant| variant.is_whole && variant.fields.iter().all(|(_, field)| field.is_whole())),
            _ => true,
        }
    }

    /// Returns the path for constructors, without generic arguments: the compiler infers them.
    pub(super) fn path(&self) -> TokenStream {
        let Ok(mut path) = syn::parse2::<syn::Path>(self.tokens.clone()) else { return self.tokens.clone() };
        path.segments.iter_mut().for_each(|segment| segment.arguments = syn::PathArguments::None);
        quote!(#path)
    }

    /// Builds a value of this type from its numbers.
    pub(super) fn build(&self, components: &[TokenStream]) -> TokenStream {
        let mut from = components.iter();
        self.assemble(&mut |leaf| leaf.built(&mut from))
    }

    /// Builds a value of this type from its leaves.
    pub(super) fn assemble(&self, leaf: &mut dyn FnMut(&Self) -> TokenStream) -> TokenStream {
        match &self.shape {
            Shape::Array(element, length) => {
                let parts: Vec<TokenStream> = (0..*length).map(|_| element.assemble(leaf)).collect();
                quote!([#(#parts),*])
            }
            // The length is arbitrary for test values.
            Shape::Slice(element) => {
                let parts: Vec<TokenStream> = (0..MADE_UP).map(|_| element.assemble(leaf)).collect();
                quote!([#(#parts),*])
            }
            Shape::Optional(inner) => {
                let (is_some, inner) = (leaf(&Self::truth()), inner.assemble(leaf));
                quote!((if #is_some { ::core::option::Option::Some(#inner) } else { ::core::option::Option::None }))
            }
            Shape::Tuple(parts) => {
                let parts: Vec<TokenStream> = parts.iter().map(|part| part.assemble(leaf)).collect();
                quote!((#(#parts,)*))
            }
            Shape::Struct(_, fields, _) => {
                let ty = self.path();
                let values = fields.iter().map(|(_, field)| {
                    let value = field.assemble(leaf);
                    if field.borrowed { quote!(&#value) } else { value }
                });
                let (values, members) = (values.collect::<Vec<_>>(), fields.iter().map(|(member, _)| member));
                quote!(#ty { #(#members: #values),* })
            }
            Shape::Enum(_, variants) => {
                let (ty, choice) = (self.path(), leaf(&Self::choice(variants.len())));
                let values = variants.iter().map(|Variant { name, fields, .. }| {
                    let values: Vec<TokenStream> = fields.iter().map(|(_, field)| field.assemble(leaf)).collect();
                    let members = fields.iter().map(|(member, _)| member);
                    quote!(#ty::#name { #(#members: #values),* })
                });
                let (values, numbers) = (values.collect::<Vec<_>>(), (0..).map(Literal::usize_unsuffixed));
                quote!((match #choice { #(#numbers => #values,)* _ => ::core::unreachable!() }))
            }
            _ => leaf(self),
        }
    }

    /// Builds a value of a type that is not composed of others.
    fn built<'a>(&self, from: &mut impl Iterator<Item = &'a TokenStream>) -> TokenStream {
        let ty = &self.tokens;
        let mut take = |count: usize| -> Vec<&TokenStream> { from.by_ref().take(count).collect() };
        match &self.shape {
            Shape::Truth | Shape::Integer | Shape::Choice(_) | Shape::Scalar => {
                let number = take(1);
                quote!(#(#number)*)
            }
            Shape::Planar | Shape::Vector | Shape::Four => {
                let parts = take(self.components());
                quote!(<#ty>::new(#(#parts),*))
            }
            Shape::Quaternion => {
                let parts = take(4);
                quote!(<#ty>::from_xyzw(#(#parts),*))
            }
            Shape::Matrix | Shape::Square(_) | Shape::Rigid => {
                let parts = take(self.components());
                quote!(<#ty>::from_cols_array(&[#(#parts),*]))
            }
            Shape::Array(..)
            | Shape::Slice(_)
            | Shape::Optional(_)
            | Shape::Tuple(_)
            | Shape::Struct(..)
            | Shape::Enum(..) => TokenStream::new(),
        }
    }

    /// Returns the 3×3 matrix type with this type's precision.
    pub(super) fn matrix(&self, krate: &TokenStream) -> TokenStream {
        self.neighbour(if self.precision == Some(Precision::Double) { "DMat3" } else { "Mat3" }, krate)
    }

    /// Returns another type of glam: from the module of the user's type if it has a path, otherwise from the facade.
    pub(super) fn neighbour(&self, name: &str, krate: &TokenStream) -> TokenStream {
        let (module, name) = (&self.module, format_ident!("{name}"));
        // The facade's own transform types are not in glam's module.
        let is_facades = self.tokens.to_string().ends_with("Rigid");
        if module.is_empty() || is_facades { quote!(#krate::glam::#name) } else { quote!(#module #name) }
    }
}

/// Largest number of numbers in a type; more would make a program that takes too long to compile.
const LONGEST: usize = 1024;

/// Length of slices in test values.
const MADE_UP: usize = 4;

const XYZW: [&str; 4] = ["x", "y", "z", "w"];
const COLUMNS: [&str; 4] = ["x_axis", "y_axis", "z_axis", "w_axis"];
