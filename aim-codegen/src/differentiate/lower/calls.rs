//! Calls: methods, functions of a type, glam's short constructors, and what their names lead to.

use quote::ToTokens;
use syn::{Expr, ExprCall, ExprMethodCall, Ident};

use super::algebra::Algebra;
use super::map::Quaternion;
use super::methods::{self, Fault, Function};
use super::paths::{path_text, type_and_name};
use super::value::Value;
use super::{Translation, strip, whole_number};
use crate::differentiate::messages;
use crate::differentiate::types::{self, Shape};

/// glam's functions in lower case, with the types that they make.
const SHORT: &[(&str, &str)] = &[
    ("vec2", "Vec2"),
    ("dvec2", "DVec2"),
    ("vec3", "Vec3"),
    ("vec3a", "Vec3A"),
    ("dvec3", "DVec3"),
    ("quat", "Quat"),
    ("dquat", "DQuat"),
    ("mat3", "Mat3"),
    ("mat3a", "Mat3A"),
    ("dmat3", "DMat3"),
];

impl Translation<'_> {
    pub(super) fn method_call(&mut self, call: &ExprMethodCall) -> Value {
        let receiver = self.expression(&call.receiver);
        if let Some(turbofish) = &call.turbofish {
            return self.refuse(turbofish, messages::no_generics());
        }
        if call.method == "powi" {
            return self.power(&receiver, &call.method, call.args.iter());
        }
        let mut arguments = vec![receiver];
        arguments.extend(call.args.iter().map(|argument| self.expression(argument)));
        let receiver = &arguments[0];
        if arguments.iter().any(Value::is_unknown) {
            return Value::Unknown;
        }
        if call.method == "into" && arguments.len() == 1 && matches!(receiver, Value::Vector(_) | Value::Matrix(_)) {
            return receiver.clone();
        }
        let tables = methods::methods_of(receiver);
        let found = methods::call(tables, &call.method.to_string(), self.algebra, &arguments);
        match found {
            Some(found) => self.called(found, &call.method, &call.args, &arguments, true),
            None => {
                let kind = receiver.describe();
                self.unknown_function(&call.method, tables, &kind)
            }
        }
    }

    pub(super) fn call(&mut self, call: &ExprCall) -> Value {
        let Expr::Path(path) = strip(&call.func) else {
            for argument in &call.args {
                self.expression(argument);
            }
            return self.refuse(&call.func, messages::call_of_value());
        };
        let Some((ty, name)) = type_and_name(path) else {
            return self.refuse(&path.path, messages::unknown_function(&path_text(path)));
        };
        if path.path.segments.last().is_some_and(|last| !last.arguments.is_none()) {
            return self.refuse(&path.path, messages::no_generics());
        }
        let (ty, name_text) = match ty {
            Some(ty) => (ty, name.to_string()),
            None => match SHORT.iter().find(|(short, _)| name == short) {
                Some((short, ty)) => {
                    let function = match *short {
                        "quat" | "dquat" => "from_xyzw",
                        "mat3" | "mat3a" | "dmat3" => "from_cols",
                        _ => "new",
                    };
                    ((*ty).to_owned(), function.to_owned())
                }
                // It is a closure, and that was said.
                None if self.named(&name.to_string()).is_some_and(Value::is_unknown) => return Value::Unknown,
                None => return self.refuse(name, messages::unknown_function(&name.to_string())),
            },
        };
        let Some((shape, _)) = types::named(&ty) else {
            return self.refuse(&path.path, messages::unknown_function(&path_text(path)));
        };
        if name_text == "from_euler" {
            return self.euler(shape, name, call);
        }
        if name_text == "powi" {
            let mut arguments = call.args.iter();
            let receiver = arguments.next().map_or(Value::Unknown, |receiver| self.expression(receiver));
            return self.power(&receiver, name, arguments);
        }
        let arguments: Vec<Value> = call.args.iter().map(|argument| self.expression(argument)).collect();
        if arguments.iter().any(Value::is_unknown) {
            return Value::Unknown;
        }
        let tables = methods::functions_of(shape);
        match methods::call(tables, &name_text, self.algebra, &arguments) {
            Some(found) => self.called(found, name, &call.args, &arguments, false),
            None => self.unknown_function(name, tables, &format!("`{ty}`")),
        }
    }

    /// What a found function gave, or its fault at the name.
    fn called(
        &mut self,
        found: Result<Value, (Fault, &'static Function)>,
        name: &Ident,
        written: &impl ToTokens,
        arguments: &[Value],
        of_a_method: bool,
    ) -> Value {
        let (fault, function) = match found {
            Ok(value) => return value,
            Err(fault) => fault,
        };
        match fault {
            Fault::Text(text) if written.to_token_stream().is_empty() => self.refuse(name, text),
            Fault::Text(text) => self.refuse(written, text),
            Fault::Arguments => {
                let found = arguments[usize::from(of_a_method)..].iter().map(Value::describe).collect::<Vec<_>>();
                let text = messages::wrong_arguments(function.name, &function.takes(of_a_method), &found.join(", "));
                self.refuse(name, text)
            }
        }
    }

    fn unknown_function(&mut self, name: &Ident, tables: &'static [&'static [Function]], kind: &str) -> Value {
        let known: Vec<&str> = tables.iter().copied().flatten().map(|function| function.name).collect();
        self.refuse(name, messages::unknown_method(&name.to_string(), kind, &known))
    }

    /// `x.powi(n)`, with a number as written for n.
    fn power<'e>(&mut self, receiver: &Value, name: &Ident, mut arguments: impl Iterator<Item = &'e Expr>) -> Value {
        let exponent = arguments.next().map(strip);
        let whole = exponent.and_then(|exponent| match exponent {
            Expr::Unary(unary) if matches!(unary.op, syn::UnOp::Neg(_)) => {
                whole_number(&unary.expr).and_then(i32::checked_neg)
            }
            other => whole_number(other),
        });
        match (receiver, whole) {
            (Value::Unknown, _) => Value::Unknown,
            (Value::Scalar(x), Some(exponent)) => Value::Scalar(self.algebra.power(*x, exponent)),
            (Value::Scalar(_), None) => {
                let place = exponent.map_or_else(|| name.to_token_stream(), ToTokens::to_token_stream);
                self.refuse(&place, messages::power_not_literal())
            }
            (other, _) => self.unknown_function(name, methods::methods_of(other), &other.describe()),
        }
    }

    /// `from_euler(EulerRot::YXZ, a, b, c)`: the turns about those axes, the first outermost; with `Ex`, innermost.
    fn euler(&mut self, shape: Shape, name: &Ident, call: &ExprCall) -> Value {
        let mut arguments = call.args.iter();
        let order = arguments.next();
        let angles: Vec<Value> = arguments.map(|argument| self.expression(argument)).collect();
        if angles.iter().any(Value::is_unknown) {
            return Value::Unknown;
        }
        let axes = order.map(strip).and_then(|order| match order {
            Expr::Path(path) => path.path.segments.last().and_then(|last| euler_axes(&last.ident.to_string())),
            _ => None,
        });
        let (Some((mut axes, extrinsic)), [Value::Scalar(x), Value::Scalar(y), Value::Scalar(z)]) =
            (axes, angles.as_slice())
        else {
            let order = order.filter(|_| axes.is_none());
            let place = order.map_or_else(|| name.to_token_stream(), ToTokens::to_token_stream);
            return self.refuse(&place, messages::euler_order());
        };
        let mut angles = [*x, *y, *z];
        if extrinsic {
            axes.reverse();
            angles.reverse();
        }
        let a: &mut Algebra = self.algebra;
        let [outer, middle, inner] = [0, 1, 2].map(|k| Quaternion::turn(a, axes[k], angles[k]));
        let rotation = outer.compose(a, &middle).compose(a, &inner);
        match shape {
            Shape::Quaternion => Value::Quaternion(rotation),
            Shape::Matrix => Value::Matrix(rotation.map),
            _ => self.refuse(name, messages::euler_order()),
        }
    }
}

/// The axes of an `EulerRot`, and whether it is an extrinsic one.
fn euler_axes(name: &str) -> Option<([usize; 3], bool)> {
    let (letters, extrinsic) = match name.strip_suffix("Ex") {
        Some(letters) => (letters, true),
        None => (name, false),
    };
    let axes: Option<Vec<usize>> = letters.chars().map(|letter| "XYZ".find(letter)).collect();
    Some((axes?.try_into().ok()?, extrinsic))
}
