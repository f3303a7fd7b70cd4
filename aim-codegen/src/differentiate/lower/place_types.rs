//! Types of places, as far as they are written or follow from values.

use syn::Expr;

use super::Translation;
use super::algebra::Algebra;
use super::expected::Expected;
use super::value::Value;
use crate::differentiate::items::Alias;
use crate::differentiate::names::{Meaning, segments};
use crate::differentiate::types::{self, Precision, Shape};

impl Expected {
    /// Returns `true` if a value may be of this type.
    pub(super) fn fits(&self, value: &Value) -> bool {
        match (self, value) {
            (Self::Any | Self::Other, _)
            | (_, Value::Unknown | Value::Never | Value::Function(_) | Value::Iterator(_)) => true,
            (Self::Array(element, _), Value::List(items)) => items.iter().all(|item| element.fits(&item.value)),
            (Self::Array(element, length), Value::Array(values)) => {
                length.is_none_or(|length| length == values.len()) && values.iter().all(|value| element.fits(value))
            }
            (Self::Tuple(parts), Value::Tuple(values)) => {
                parts.len() == values.len() && parts.iter().zip(values).all(|(part, value)| part.fits(value))
            }
            (Self::Named(name) | Self::Generic(name, _), Value::Struct(of)) => *name == of.name,
            (Self::Optional, value) => matches!(value, Value::Optional(_)),
            (Self::Named(name), Value::Integer(_)) => types::is_integer(name),
            (Self::Named(name), Value::Truth(_)) => name == "bool",
            (Self::Named(name), value) => types::named(name).is_some_and(|(shape, _)| is_of(value, &shape)),
            _ => false,
        }
    }
}

fn is_of(value: &Value, shape: &Shape) -> bool {
    match (value, shape) {
        (Value::Square(columns), Shape::Square(count)) => columns.len() == *count,
        (Value::Scalar(_), Shape::Scalar)
        | (Value::Planar(_), Shape::Planar)
        | (Value::Vector(_), Shape::Vector)
        | (Value::Four(_), Shape::Four)
        | (Value::Quaternion(_), Shape::Quaternion)
        | (Value::Matrix(_), Shape::Matrix)
        | (Value::Homogeneous(_), Shape::Square(4))
        | (Value::Affine(_), Shape::Rigid) => true,
        _ => false,
    }
}

/// Returns the type of a value, as far as it is determined.
pub(super) fn type_of(value: &Value, precision: Option<Precision>) -> Expected {
    match value {
        Value::Struct(of) => Expected::Named(of.name.clone()),
        Value::Array(values) => {
            let element = values.first().map_or(Expected::Any, |first| type_of(first, precision));
            Expected::Array(Box::new(element), Some(values.len()))
        }
        Value::Tuple(values) => Expected::Tuple(values.iter().map(|value| type_of(value, precision)).collect()),
        Value::Truth(_) => Expected::Named("bool".into()),
        Value::Integer(_) => Expected::Named("i64".into()),
        value => names_of_type(value, precision).next().map_or(Expected::Any, |name| Expected::Named(name.to_owned())),
    }
}

/// Iterates over the names of a value's type, if it is a number or of glam: those with the same numbers, such as `Vec3`
/// and `Vec3A`, are not told apart.
pub(super) fn names_of_type(value: &Value, precision: Option<Precision>) -> impl Iterator<Item = &'static str> {
    types::named_like(precision, |shape| is_of(value, shape))
}

impl Translation<'_> {
    /// Resolves a type as it is written in the function that is being run.
    pub(super) fn expected(&mut self, ty: &syn::Type) -> Expected {
        match ty {
            syn::Type::Group(group) => self.expected(&group.elem),
            syn::Type::Paren(paren) => self.expected(&paren.elem),
            syn::Type::Reference(reference) => self.expected(&reference.elem),
            syn::Type::Slice(slice) => Expected::Array(Box::new(self.expected(&slice.elem)), None),
            syn::Type::Array(array) => {
                let length = self.known_length(&array.len);
                Expected::Array(Box::new(self.expected(&array.elem)), length)
            }
            syn::Type::Tuple(tuple) => Expected::Tuple(tuple.elems.iter().map(|part| self.expected(part)).collect()),
            syn::Type::Path(path) if path.qself.is_none() => {
                let scope = self.frame.scope.clone();
                let path = &path.path;
                match (&scope.self_written, &scope.self_type) {
                    _ if !path.is_ident("Self") => {}
                    (Some(written), _) => return self.expected(written),
                    (None, Some(known)) => return Expected::Named(known.clone()),
                    (None, None) => return Expected::Any,
                }
                if let Some(name) = path.get_ident().filter(|name| scope.generics.iter().any(|of| *name == of)) {
                    return self.generic(&name.to_string()).map_or(Expected::Any, Expected::Named);
                }
                match path.segments.last() {
                    Some(last) if last.ident == "Option" || last.ident == "Result" => return Expected::Optional,
                    Some(_) if self.is_other(path) => return Expected::Other,
                    Some(last) if last.arguments.is_none() => {}
                    Some(last) => return self.expected_generic(path, last),
                    None => return Expected::Any,
                }
                match self.items.meaning(&scope, &segments(path)) {
                    Meaning::Own(name) => match self.items.alias(&name) {
                        Some(Alias { scope, ty, .. }) => self.within(scope.clone(), |this| this.expected(ty)),
                        None => Expected::Named(name),
                    },
                    outside => Expected::Named(outside.into_type()),
                }
            }
            _ => Expected::Any,
        }
    }

    /// Returns `true` if a path resolves to an unsupported collection, also by another name.
    fn is_other(&self, path: &syn::Path) -> bool {
        let name = self.items.meaning(&self.frame.scope, &segments(path)).into_type();
        OTHERS.contains(&name.as_str())
    }

    /// Resolves a type that may be omitted.
    pub(super) fn expected_of(&mut self, ty: Option<&syn::Type>) -> Expected {
        ty.map_or(Expected::Any, |ty| self.expected(ty))
    }

    /// Returns the length of an array, if it is known; reports no errors.
    pub(super) fn known_length(&mut self, length: &Expr) -> Option<usize> {
        let before = self.report_counts();
        let value = self.expression(length);
        self.forget_reports_since(before);
        self.algebra.known_index(&value)
    }
}

/// Unsupported collections.
const OTHERS: [&str; 7] = ["HashMap", "HashSet", "BTreeMap", "BTreeSet", "BinaryHeap", "VecDeque", "LinkedList"];

/// Returns the neutral element of a type's sum or product.
pub(super) fn neutral(a: &mut Algebra, name: &str, of_sums: bool) -> Option<Value> {
    if types::is_integer(name) {
        return Some(a.integer(if of_sums { 0 } else { 1 }));
    }
    let (shape, _) = types::named(name)?;
    let constant = match shape {
        Shape::Scalar => return Some(Value::Scalar(a.number(if of_sums { 0.0 } else { 1.0 }))),
        Shape::Planar | Shape::Vector | Shape::Four if of_sums => "ZERO",
        Shape::Planar | Shape::Vector | Shape::Four => "ONE",
        Shape::Matrix | Shape::Square(_) if of_sums => "ZERO",
        Shape::Matrix | Shape::Square(_) | Shape::Quaternion | Shape::Rigid if !of_sums => "IDENTITY",
        _ => return None,
    };
    super::constants::associated(a, name, constant)
}
