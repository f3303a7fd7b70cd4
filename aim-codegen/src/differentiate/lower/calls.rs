//! Calls: methods, functions of a type, glam's short constructors, and what their names lead to.

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::token::Comma;
use syn::{Expr, ExprCall, ExprMethodCall, Ident};

use super::algebra::Algebra;
use super::map::Quaternion;
use super::methods::{self, Fault, Function};
use super::paths::{path_text, type_and_name};
use super::value::Value;
use super::{Translation, strip, whole_number};
use crate::declare::report::text::Text;
use crate::differentiate::messages;
use crate::differentiate::types::{self, Shape};

/// glam's functions in lower case, with the types that they make and the functions that they are short for.
const SHORT: &[(&str, &str, &str)] = &[
    ("vec2", "Vec2", "new"),
    ("dvec2", "DVec2", "new"),
    ("vec3", "Vec3", "new"),
    ("vec3a", "Vec3A", "new"),
    ("dvec3", "DVec3", "new"),
    ("quat", "Quat", "from_xyzw"),
    ("dquat", "DQuat", "from_xyzw"),
    ("mat3", "Mat3", "from_cols"),
    ("mat3a", "Mat3A", "from_cols"),
    ("dmat3", "DMat3", "from_cols"),
];

/// What is called.
struct Callee<'a> {
    /// As it is written.
    name: &'a Ident,
    /// The entry of the tables.
    function: String,
    tables: &'static [&'static [Function]],
    /// What it is a function of, in words.
    kind: String,
}

impl Translation<'_> {
    pub(super) fn method_call(&mut self, call: &ExprMethodCall) -> Value {
        let receiver = self.expression(&call.receiver);
        if let Some(turbofish) = &call.turbofish {
            return self.refuse(turbofish, messages::no_generics());
        }
        let (function, tables, kind) = (call.method.to_string(), methods::methods_of(&receiver), receiver.describe());
        self.apply(&Callee { name: &call.method, function, tables, kind }, Some(receiver), &call.args)
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
        let (ty, function) = match (ty, SHORT.iter().find(|(short, ..)| name == short)) {
            (Some(ty), _) => (ty, name.to_string()),
            (None, Some((_, ty, function))) => ((*ty).to_owned(), (*function).to_owned()),
            // It is a closure, and that was said.
            (None, None) if self.named(&name.to_string()).is_some_and(Value::is_unknown) => return Value::Unknown,
            (None, None) => return self.refuse(name, messages::unknown_function(&name.to_string())),
        };
        let Some((shape, _)) = types::named(&ty) else {
            return self.refuse(&path.path, messages::unknown_function(&path_text(path)));
        };
        if function == "from_euler" {
            return self.euler(shape, name, call);
        }
        let (tables, kind) = (methods::functions_of(shape), format!("`{ty}`"));
        self.apply(&Callee { name, function, tables, kind }, None, &call.args)
    }

    /// The value of a call; a method has its receiver before the arguments as written.
    fn apply(&mut self, callee: &Callee<'_>, receiver: Option<Value>, written: &Punctuated<Expr, Comma>) -> Value {
        let of_a_method = receiver.is_some();
        let mut arguments: Vec<Value> = receiver.into_iter().collect();
        arguments.extend(written.iter().map(|argument| self.expression(argument)));
        if arguments.iter().any(Value::is_unknown) {
            return Value::Unknown;
        }
        let Callee { name, function, tables, kind } = callee;
        if let (Some(text), Some(last)) = (needs_literal(function), written.last().filter(|last| !is_whole(last))) {
            return self.refuse(last, text);
        }
        let text = match methods::call(tables, function, self.algebra, &arguments) {
            Some(Ok(value)) => return value,
            Some(Err((Fault::Text(text), _))) if !written.is_empty() => return self.refuse(written, text),
            Some(Err((Fault::Text(text), _))) => text,
            Some(Err((Fault::Arguments, function))) => {
                let found: Vec<String> = arguments[usize::from(of_a_method)..].iter().map(Value::describe).collect();
                messages::wrong_arguments(function.name, &function.takes(of_a_method), &found.join(", "))
            }
            None => {
                let known: Vec<&str> = tables.iter().copied().flatten().map(|function| function.name).collect();
                messages::unknown_method(function, kind, &known)
            }
        };
        self.refuse(*name, text)
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

/// What is said where the last argument of this function is no whole number as written, if it has to be. Integers are not
/// computed with: `7 / 2` is 3 to the user's function and would be 3.5 in the graph.
fn needs_literal(function: &str) -> Option<Text> {
    match function {
        "powi" => Some(messages::power_not_literal()),
        "col" | "row" => Some(messages::index_not_literal()),
        _ => None,
    }
}

/// Whether this is a whole number as written, of either sign.
fn is_whole(expression: &Expr) -> bool {
    match strip(expression) {
        Expr::Unary(unary) => matches!(unary.op, syn::UnOp::Neg(_)) && whole_number(&unary.expr).is_some(),
        other => whole_number(other).is_some(),
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
