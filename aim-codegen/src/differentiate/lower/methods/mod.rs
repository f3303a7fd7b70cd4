//! What can be called: tables of functions, each with the kinds of its arguments and what it makes of them.
//!
//! A method is a function whose first argument is the receiver, so `v.dot(w)` and `Vec3::dot(v, w)` are one entry.

mod construct;
mod quaternion;
mod scalar;
mod transform;
mod vector;

use super::algebra::Algebra;
use super::value::Value;
use crate::differentiate::types::Shape;
use crate::text::Text;

/// Why a call came to nothing.
pub(super) enum Fault {
    /// The arguments are of other kinds.
    Arguments,
    /// They are wrong in another way.
    Text(Text),
}

impl From<Text> for Fault {
    fn from(text: Text) -> Self {
        Self::Text(text)
    }
}

/// A function, and the kinds of values that it takes.
pub(super) struct Function {
    pub(super) name: &'static str,
    takes: &'static [&'static str],
    make: fn(&mut Algebra, &[Value]) -> Result<Value, Fault>,
}

impl Function {
    pub(super) fn call(&self, a: &mut Algebra, arguments: &[Value]) -> Result<Value, Fault> {
        (self.make)(a, arguments)
    }

    /// Its arguments in words; those of a method stand without the receiver.
    pub(super) fn takes(&self, of_a_method: bool) -> String {
        let takes = &self.takes[usize::from(of_a_method)..];
        if takes.is_empty() {
            return "nothing".into();
        }
        takes.iter().map(|kind| words(kind)).collect::<Vec<_>>().join(", ")
    }
}

/// A variant of [`Value`] in words.
fn words(kind: &str) -> &'static str {
    match kind {
        "Scalar" => "a number",
        "Truth" => "a condition",
        "Planar" => "a vector of two",
        "Vector" => "a vector",
        "Quaternion" => "a quaternion",
        "Matrix" => "a matrix",
        "Affine" => "a transform",
        "Tuple" => "a tuple",
        _ => "an array",
    }
}

/// `name(argument: Kind, …) -> Kind { body }` as entries of a table; the kinds are the variants of [`Value`].
macro_rules! functions {
    ($(#[$doc:meta])* $table:ident($a:ident):
        $( $name:ident ( $($argument:ident : $kind:ident),* ) -> $result:ident $body:block )*
    ) => {
        $(#[$doc])*
        pub(super) const $table: &[$crate::differentiate::lower::methods::Function] = &[$(
            $crate::differentiate::lower::methods::Function {
                name: stringify!($name),
                takes: &[$(stringify!($kind)),*],
                make: |$a, arguments| {
                    let _ = &$a;
                    match arguments {
                        [$(Value::$kind($argument)),*] => {
                            $( let $argument = Clone::clone($argument); )*
                            let result = $body;
                            Ok(Value::$result(result))
                        }
                        _ => Err($crate::differentiate::lower::methods::Fault::Arguments),
                    }
                },
            },
        )*];
    };
}
use functions;

/// The methods of a value.
pub(super) fn methods_of(receiver: &Value) -> &'static [&'static [Function]] {
    match receiver {
        Value::Scalar(_) => &[scalar::METHODS],
        Value::Planar(_) => &[vector::PLANAR, vector::EITHER],
        Value::Vector(_) => &[vector::METHODS, vector::EITHER],
        Value::Quaternion(_) => &[quaternion::METHODS],
        Value::Matrix(_) => &[transform::MATRIX],
        Value::Affine(_) => &[transform::AFFINE],
        Value::Truth(_) | Value::Tuple(_) | Value::Array(_) | Value::Unknown => &[],
    }
}

/// The functions of a type that make a value of it, and its methods.
pub(super) fn functions_of(shape: Shape) -> &'static [&'static [Function]] {
    match shape {
        Shape::Scalar => &[scalar::METHODS],
        Shape::Planar => &[construct::PLANAR, vector::PLANAR, vector::EITHER],
        Shape::Vector => &[construct::VECTOR, vector::METHODS, vector::EITHER],
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
