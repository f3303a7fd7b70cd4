//! Calls: methods, functions of a type, glam's short constructors, and what their names lead to.

use std::rc::Rc;

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::token::Comma;
use syn::{Expr, ExprCall, ExprMethodCall, ExprStruct, Ident};

use super::algebra::Algebra;
use super::defaults::is_default;
use super::fields::name_of;
use super::map::Quaternion;
use super::methods::{self, Fault, Function};
use super::paths::{path_text, type_and_name};
use super::value::{Callable, Struct, Value};
use super::{Translation, strip};
use crate::differentiate::messages;
use crate::differentiate::types::{self, Shape};

/// glam's functions in lower case, with the types that they make and the functions that they are short for.
const SHORT: &[(&str, &str, &str)] = &[
    ("vec2", "Vec2", "new"),
    ("dvec2", "DVec2", "new"),
    ("vec3", "Vec3", "new"),
    ("vec3a", "Vec3A", "new"),
    ("dvec3", "DVec3", "new"),
    ("vec4", "Vec4", "new"),
    ("dvec4", "DVec4", "new"),
    ("mat2", "Mat2", "from_cols"),
    ("dmat2", "DMat2", "from_cols"),
    ("mat4", "Mat4", "from_cols"),
    ("dmat4", "DMat4", "from_cols"),
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
        if let Some(value) = self.changing_method(call) {
            return value;
        }
        let receiver = self.expression(&call.receiver);
        if receiver.is_unknown() {
            call.args.iter().for_each(|argument| _ = self.expression(argument));
            return receiver;
        }
        if let Some(value) = self.sequence_method(&receiver, call) {
            return value;
        }
        if let (Some(value), true) = (self.swizzle(&receiver, &call.method.to_string()), call.args.is_empty()) {
            return value;
        }
        if let Value::Struct(of) = &receiver {
            return self.struct_method(of.clone(), receiver, call);
        }
        if let Some(turbofish) = &call.turbofish {
            return self.refuse(turbofish, messages::no_generics());
        }
        let (function, tables, kind) = (call.method.to_string(), methods::methods_of(&receiver), receiver.describe());
        self.apply(&Callee { name: &call.method, function, tables, kind }, Some(receiver), &call.args)
    }

    /// `v.xz()` and the like: components in another order.
    fn swizzle(&mut self, v: &Value, letters: &str) -> Option<Value> {
        let count = match v {
            Value::Planar(_) => 2,
            Value::Vector(_) => 3,
            Value::Four(_) => 4,
            _ => return None,
        };
        let places = letters.chars().map(|letter| "xyzw"[..count].find(letter)).collect::<Option<Vec<usize>>>()?;
        let parts = places.iter().map(|&place| match v.element(self.algebra, place) {
            Some(Value::Scalar(part)) => Some(part),
            _ => None,
        });
        match *parts.collect::<Option<Vec<_>>>()?.as_slice() {
            [x, y] => {
                let zero = self.algebra.number(0.0);
                Some(Value::Planar(self.algebra.vector([x, y, zero])))
            }
            [x, y, z] => Some(Value::Vector(self.algebra.vector([x, y, z]))),
            [x, y, z, w] => Some(Value::Four([x, y, z, w])),
            _ => None,
        }
    }

    /// A method that the module has for a struct of its own.
    fn struct_method(&mut self, of: Rc<Struct>, receiver: Value, call: &ExprMethodCall) -> Value {
        let name = call.method.to_string();
        if let Some(function) = self.items.function(Some(&of.name), &name) {
            let function = function.clone();
            let lent = function.changed.first() == Some(&true);
            let receiver = if lent { self.reference(&call.receiver) } else { receiver };
            return self.inline_written(&call.method, &function, Some(receiver), &call.args);
        }
        if name == "clone" {
            return receiver;
        }
        let text = messages::unknown_method(&name, &receiver.describe(), &self.items.functions_of(&of.name));
        self.refuse(&call.method, text)
    }

    /// Calls a function with arguments as written; a method has its receiver before them.
    fn inline_written(
        &mut self,
        place: &impl ToTokens,
        function: &Rc<Callable>,
        receiver: Option<Value>,
        written: &Punctuated<Expr, Comma>,
    ) -> Value {
        let mut arguments: Vec<Value> = receiver.into_iter().collect();
        let first = arguments.len();
        for (index, argument) in written.iter().enumerate() {
            let lent = function.changed.get(first + index) == Some(&true);
            arguments.push(match strip(argument) {
                // A reference that is passed on.
                place @ Expr::Path(_) if lent => self.reference(place),
                argument => self.expression(argument),
            });
        }
        self.inline(place, function, arguments)
    }

    pub(super) fn call(&mut self, call: &ExprCall) -> Value {
        let Expr::Path(path) = strip(&call.func) else {
            return match self.expression(&call.func) {
                Value::Function(function) => self.inline_written(&call.func, &function, None, &call.args),
                other => self.refuse_known(&other, &call.func, messages::call_of_value()),
            };
        };
        let Some((ty, name)) = type_and_name(path) else {
            return self.refuse(&path.path, messages::unknown_function(&path_text(path)));
        };
        let (text, segments) = (name.to_string(), &path.path.segments);
        if let (None, Some(local)) = (&ty, path.path.get_ident().and_then(|_| self.frame.find(&text))) {
            return match self.frame.value(local).clone() {
                Value::Function(function) => self.inline_written(name, &function, None, &call.args),
                other => self.refuse_known(&other, name, messages::call_of_value()),
            };
        }
        let ty = ty.map(|ty| self.resolved(&ty));
        if ty.is_some() || segments.len() == 1 || segments[0].ident == "self" {
            if let Some(function) = self.items.function(ty.as_deref(), &text).cloned() {
                return self.inline_written(&path.path, &function, None, &call.args);
            }
            let of_tuple = self.resolved(&text);
            if ty.is_none() && self.items.fields(&of_tuple).is_some() {
                let fields = call.args.iter().enumerate().map(|(i, value)| (i.to_string(), self.expression(value)));
                return Value::Struct(Rc::new(Struct { fields: fields.collect(), name: of_tuple }));
            }
        }
        if let ("default", Some(name), true) = (text.as_str(), &ty, call.args.is_empty())
            && let Ok(of) = syn::parse_str(name)
            && let Some(value) = self.default_of(&of)
        {
            return value;
        }
        if let ("from_fn", Some(length), [of_place]) = (text.as_str(), self.expected.take(), &call_arguments(call)[..])
        {
            return self.array_of(call, length, of_place);
        }
        if segments.last().is_some_and(|last| !last.arguments.is_none()) {
            return self.refuse(&path.path, messages::no_generics());
        }
        let (ty, function) = match (ty, SHORT.iter().find(|(short, ..)| name == short)) {
            (Some(ty), _) => (ty, text),
            (None, Some((_, ty, function))) => ((*ty).to_owned(), (*function).to_owned()),
            (None, None) => {
                let text = self.unseen(&text, messages::unknown_function(&text));
                return self.refuse(name, text);
            }
        };
        let Some((shape, _)) = types::named(&ty).filter(|_| self.items.fields(&ty).is_none()) else {
            return self.refuse(&path.path, messages::unknown_function(&path_text(path)));
        };
        if function == "from_euler" {
            return self.euler(&shape, name, call);
        }
        let (tables, kind) = (methods::functions_of(&shape), format!("`{ty}`"));
        self.apply(&Callee { name, function, tables, kind }, None, &call.args)
    }

    /// `array::from_fn` of a length that is known from the type.
    fn array_of(&mut self, call: &ExprCall, length: usize, function: &Expr) -> Value {
        let Some(function) = self.function_argument(function, 1) else { return Value::Unknown };
        let values: Vec<Value> = (0..length)
            .map(|index| {
                let index = self.algebra.whole(index);
                self.inline(&call.func, &function, vec![index])
            })
            .collect();
        if values.iter().any(Value::is_unknown) { Value::Unknown } else { Value::Array(values) }
    }

    /// `Type { field: value, … }`
    pub(super) fn structure(&mut self, of: &ExprStruct) -> Value {
        let name = of.path.segments.last().map(|last| last.ident.to_string()).unwrap_or_default();
        let name = self.resolved(&name);
        let mut fields: Vec<(String, Value)> = Vec::new();
        for field in &of.fields {
            fields.push((name_of(&field.member), self.expression(&field.expr)));
        }
        if let Some(rest) = of.rest.as_deref().filter(|rest| is_default(rest)) {
            for (member, ty) in self.items.fields(&name).map(<[_]>::to_vec).unwrap_or_default() {
                if fields.iter().all(|(written, _)| *written != name_of(&member)) {
                    let Some(value) = self.default_of(&ty) else {
                        return self.refuse(rest, messages::outside_struct(&name));
                    };
                    fields.push((name_of(&member), value));
                }
            }
        } else if let Some(rest) = &of.rest {
            match self.expression(rest) {
                Value::Struct(rest) => {
                    for (known, value) in &rest.fields {
                        if fields.iter().all(|(written, _)| written != known) {
                            fields.push((known.clone(), value.clone()));
                        }
                    }
                }
                other => return self.refuse_known(&other, rest, messages::outside_struct(&name)),
            }
        }
        if fields.iter().any(|(_, value)| value.is_unknown()) {
            return Value::Unknown;
        }
        if let Some(declared) = self.items.fields(&name) {
            // In the order of the declaration, so that two values have their fields at the same places.
            let place = |(name, _): &(String, Value)| declared.iter().position(|(member, _)| name_of(member) == *name);
            fields.sort_by_key(place);
            return Value::Struct(Rc::new(Struct { name, fields }));
        }
        // glam's own: by their constructors.
        let constructor = match types::named(&name) {
            Some((Shape::Planar | Shape::Vector | Shape::Four, _)) => "new",
            Some((Shape::Rigid, _)) => "from_mat3_translation",
            Some((Shape::Matrix, _)) => "from_cols",
            _ => {
                let text = self.unseen(&name, messages::outside_struct(&name));
                return self.refuse(&of.path, text);
            }
        };
        fields.sort_by_key(|(name, _)| name.clone());
        let values: Vec<Value> = fields.into_iter().map(|(_, value)| value).collect();
        let tables = types::named(&name).map_or(&[][..], |(shape, _)| methods::functions_of(&shape));
        match methods::call(tables, constructor, self.algebra, &values) {
            Some(Ok(value)) => value,
            _ => self.refuse(&of.path, messages::outside_struct(&name)),
        }
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
    fn euler(&mut self, shape: &Shape, name: &Ident, call: &ExprCall) -> Value {
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

fn call_arguments(call: &ExprCall) -> Vec<&Expr> {
    call.args.iter().collect()
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
