//! What can be called: tables of functions, each with the kinds of its arguments and what it makes of them.
//!
//! A method is a function whose first argument is the receiver, so `v.dot(w)` and `Vec3::dot(v, w)` are one entry.

mod construct;
mod formula;
mod function;
mod quaternion;
mod scalar;
mod transform;
mod vector;

pub(super) use self::function::{Fault, Function};
use super::algebra::Algebra;
use super::value::Value;
use crate::differentiate::types::Shape;

/// The methods of a value.
pub(super) fn methods_of(receiver: &Value) -> &'static [&'static [Function]] {
    match receiver {
        Value::Scalar(_) => &[scalar::METHODS, scalar::FORMULAS],
        Value::Planar(_) => &[vector::PLANAR, vector::PLANAR_FORMULAS, vector::EITHER, vector::EITHER_FORMULAS],
        Value::Vector(_) => &[vector::METHODS, vector::FORMULAS, vector::EITHER, vector::EITHER_FORMULAS],
        Value::Quaternion(_) => &[quaternion::METHODS],
        Value::Matrix(_) => &[transform::MATRIX],
        Value::Affine(_) => &[transform::AFFINE],
        Value::Truth(_) | Value::Tuple(_) | Value::Array(_) | Value::Unknown => &[],
    }
}

/// The functions of a type that make a value of it, and its methods.
pub(super) fn functions_of(shape: Shape) -> &'static [&'static [Function]] {
    match shape {
        Shape::Scalar => &[scalar::METHODS, scalar::FORMULAS],
        Shape::Planar => {
            &[construct::PLANAR, vector::PLANAR, vector::PLANAR_FORMULAS, vector::EITHER, vector::EITHER_FORMULAS]
        }
        Shape::Vector => {
            &[construct::VECTOR, vector::METHODS, vector::FORMULAS, vector::EITHER, vector::EITHER_FORMULAS]
        }
        Shape::Quaternion => &[construct::QUATERNION, quaternion::METHODS],
        Shape::Matrix => &[construct::MATRIX, transform::MATRIX],
        Shape::Rigid => &[construct::AFFINE, transform::AFFINE],
        Shape::Array(_) => &[],
    }
}

/// Calls the function of this name in these tables; `None` if there is none.
///
/// Methods of vectors of two are those of vectors, whose third component is 0.
pub(super) fn call(
    tables: &[&'static [Function]],
    name: &str,
    a: &mut Algebra,
    arguments: &[Value],
) -> Option<Result<Value, (Fault, &'static Function)>> {
    let mut fault = None;
    for function in tables.iter().copied().flatten().filter(|function| function.name == name) {
        match function.call(a, arguments) {
            Ok(value) => return Some(Ok(value)),
            Err(found) => fault = Some(Err((found, function))),
        }
        if let Some(lifted) = lifted(arguments) {
            match function.call(a, &lifted) {
                Ok(Value::Vector(v)) => return Some(Ok(Value::Planar(v))),
                Ok(value) => return Some(Ok(value)),
                Err(found @ Fault::Text(_)) => fault = Some(Err((found, function))),
                Err(Fault::Arguments) => {}
            }
        }
    }
    fault
}

/// Vectors of two as vectors; `None` where there are none, or others among them.
fn lifted(arguments: &[Value]) -> Option<Vec<Value>> {
    if !matches!(arguments.first(), Some(Value::Planar(_))) {
        return None;
    }
    arguments
        .iter()
        .map(|argument| match argument {
            Value::Planar(v) => Some(Value::Vector(*v)),
            Value::Vector(_) => None,
            other => Some(other.clone()),
        })
        .collect()
}
