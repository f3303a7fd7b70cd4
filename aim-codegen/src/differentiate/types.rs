//! Types of arguments and results, recognised by the last segment of their paths; how their values are taken apart and
//! put together in emitted code.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::messages;
use crate::declare::report::text::Text;
pub(super) use crate::emit::Precision;

/// What a type holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Shape {
    Scalar,
    Planar,
    Vector,
    Quaternion,
    Matrix,
    Rigid,
    Array(usize),
}

/// Names that are types of ours.
const KNOWN: [(&str, Shape, Precision); 16] = [
    ("f32", Shape::Scalar, Precision::Single),
    ("f64", Shape::Scalar, Precision::Double),
    ("Vec2", Shape::Planar, Precision::Single),
    ("DVec2", Shape::Planar, Precision::Double),
    ("Vec3", Shape::Vector, Precision::Single),
    ("Vec3A", Shape::Vector, Precision::Single),
    ("DVec3", Shape::Vector, Precision::Double),
    ("Quat", Shape::Quaternion, Precision::Single),
    ("DQuat", Shape::Quaternion, Precision::Double),
    ("Mat3", Shape::Matrix, Precision::Single),
    ("Mat3A", Shape::Matrix, Precision::Single),
    ("DMat3", Shape::Matrix, Precision::Double),
    ("Rigid", Shape::Rigid, Precision::Single),
    ("Affine3A", Shape::Rigid, Precision::Single),
    ("DRigid", Shape::Rigid, Precision::Double),
    ("DAffine3", Shape::Rigid, Precision::Double),
];

/// What the type of this name holds.
pub(super) fn named(name: &str) -> Option<(Shape, Precision)> {
    KNOWN.iter().find(|(known, ..)| *known == name).map(|&(_, shape, precision)| (shape, precision))
}

/// A type as the user wrote it.
pub(super) struct Type {
    pub(super) shape: Shape,
    pub(super) precision: Precision,
    /// Its tokens, without a reference.
    pub(super) tokens: TokenStream,
    /// Its name.
    pub(super) name: String,
    /// The path before its name, with the last `::`.
    module: TokenStream,
    /// Whether a value of it comes by reference.
    pub(super) borrowed: bool,
}

impl Type {
    /// Reads a type, in invisible groups and behind one reference too; or tells why it is none of ours, and where.
    pub(super) fn parse(written: &syn::Type) -> Result<Self, (TokenStream, Text)> {
        let unknown = || {
            let (tokens, known) = (quote!(#written), KNOWN.map(|(name, ..)| name));
            let text = messages::unknown_type(&tokens.to_string(), &known);
            (tokens, text)
        };
        match written {
            syn::Type::Group(group) => Self::parse(&group.elem),
            syn::Type::Paren(paren) => Self::parse(&paren.elem),
            syn::Type::Reference(reference) => {
                if let Some(mutability) = &reference.mutability {
                    return Err((quote!(#mutability), messages::mutable_reference()));
                }
                let inner = Self::parse(&reference.elem)?;
                if inner.borrowed { Err(unknown()) } else { Ok(Self { borrowed: true, ..inner }) }
            }
            syn::Type::Path(path) if path.qself.is_none() => {
                let last = path.path.segments.last().filter(|segment| segment.arguments.is_none());
                let known = last.and_then(|segment| named(&segment.ident.to_string()));
                let (shape, precision) = known.ok_or_else(unknown)?;
                let name = last.map(|last| last.ident.to_string()).unwrap_or_default();
                let (leading, segments) = (&path.path.leading_colon, &path.path.segments);
                let before = segments.iter().take(segments.len() - 1);
                let module = if segments.len() > 1 { quote!(#leading #(#before::)*) } else { quote!() };
                Ok(Self { shape, precision, tokens: quote!(#written), name, module, borrowed: false })
            }
            syn::Type::Array(array) => {
                let element = Self::parse(&array.elem)?;
                let length = match &array.len {
                    syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(length), .. }) => length.base10_parse().ok(),
                    _ => None,
                };
                match (element.shape, length) {
                    (Shape::Scalar, Some(length)) if !element.borrowed && length <= LONGEST => Ok(Self {
                        shape: Shape::Array(length),
                        precision: element.precision,
                        tokens: quote!(#written),
                        name: String::new(),
                        module: TokenStream::new(),
                        borrowed: false,
                    }),
                    _ => Err(unknown()),
                }
            }
            _ => Err(unknown()),
        }
    }

    /// Its numbers.
    pub(super) fn components(&self) -> usize {
        self.shape.components()
    }

    /// One of the numbers of the argument `name`.
    pub(super) fn component(&self, name: &Ident, index: usize) -> TokenStream {
        let field = |names: &[&str]| {
            let fields = names.iter().map(|name| format_ident!("{name}"));
            quote!(#name #(.#fields)*)
        };
        match self.shape {
            Shape::Scalar if self.borrowed => quote!(*#name),
            Shape::Scalar => quote!(#name),
            Shape::Planar | Shape::Vector | Shape::Quaternion => field(&[XYZW[index]]),
            Shape::Matrix => field(&[COLUMNS[index / 3], XYZW[index % 3]]),
            Shape::Rigid if index < 9 => field(&["matrix3", COLUMNS[index / 3], XYZW[index % 3]]),
            Shape::Rigid => field(&["translation", XYZW[index - 9]]),
            Shape::Array(_) => {
                let index = Literal::usize_unsuffixed(index);
                quote!(#name[#index])
            }
        }
    }

    /// A value of this type from its numbers.
    pub(super) fn build(&self, components: &[TokenStream]) -> TokenStream {
        let ty = &self.tokens;
        match self.shape {
            Shape::Scalar => quote!(#(#components)*),
            Shape::Planar | Shape::Vector => quote!(<#ty>::new(#(#components),*)),
            Shape::Quaternion => quote!(<#ty>::from_xyzw(#(#components),*)),
            Shape::Matrix | Shape::Rigid => quote!(<#ty>::from_cols_array(&[#(#components),*])),
            Shape::Array(_) => quote!([#(#components),*]),
        }
    }

    /// The matrix whose columns are vectors of this type's number type: beside the user's own vector type where that
    /// has a path, else from the facade.
    pub(super) fn matrix(&self, krate: &TokenStream) -> TokenStream {
        let name = match self.precision {
            Precision::Single => format_ident!("Mat3"),
            Precision::Double => format_ident!("DMat3"),
        };
        let module = &self.module;
        if module.is_empty() { quote!(#krate::glam::#name) } else { quote!(#module #name) }
    }
}

/// Longer arrays of numbers would make a program nobody wants to compile.
const LONGEST: usize = 256;

const XYZW: [&str; 4] = ["x", "y", "z", "w"];
const COLUMNS: [&str; 3] = ["x_axis", "y_axis", "z_axis"];

impl Shape {
    /// How many numbers it is made of.
    pub(super) fn components(self) -> usize {
        match self {
            Self::Scalar => 1,
            Self::Planar => 2,
            Self::Vector => 3,
            Self::Quaternion => 4,
            Self::Matrix => 9,
            Self::Rigid => 12,
            Self::Array(length) => length,
        }
    }
}
