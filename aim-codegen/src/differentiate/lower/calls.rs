//! Calls: methods, associated functions, glam's short constructors, and resolution of their names.

use std::rc::Rc;

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::token::Comma;
use syn::{Expr, ExprCall, ExprMethodCall, ExprStruct, Ident};

use super::algebra::Algebra;
use super::expected::Expected;
use super::fields::name_of;
use super::map::Quaternion;
use super::methods::{self, CallError, Function};
use super::paths::{path_text, type_and_name};
use super::place_types::names_of_type;
use super::value::{Callable, LoopSequence, Scope, SequenceItems, Struct, Value};
use super::{Translation, iterators, square, strip};
use crate::differentiate::items::Structure;
use crate::differentiate::messages;
use crate::differentiate::names::{Meaning, segments};
use crate::differentiate::types::{self, Shape};

/// glam's lower-case functions, with the type that each constructs and the function that it abbreviates.
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

/// A called function.
struct Callee<'a> {
    /// Name as written.
    name: &'a Ident,
    /// Name of the entry in the tables.
    function: String,
    tables: &'static [&'static [Function]],
    /// The type that it is a function of, in words.
    kind: String,
}

impl Translation<'_> {
    pub(super) fn method_call(&mut self, call: &ExprMethodCall, expected: &Expected) -> Value {
        let errors = self.report.count();
        if let Some(value) = self.changing_method(call).or_else(|| self.contained(call)) {
            return value;
        }
        if self.report.count() > errors {
            return Value::Unknown;
        }
        let is_drained = core::mem::take(&mut self.is_drained);
        // Collecting into an option ends at the first `None`.
        let may_end = call.method == "collect" && matches!(self.expected_of_call(call, expected), Expected::Optional);
        self.is_drained = matches!(strip(&call.receiver), Expr::MethodCall(_))
            && iterators::drains(&call.method, is_drained)
            && !may_end;
        let (receiver, has_effect) = self.tracked(|this| this.expression(&call.receiver));
        self.is_drained = false;
        if receiver.is_unknown() {
            call.args.iter().for_each(|argument| _ = self.expression(argument));
            return receiver;
        }
        // A reference that the previous method returned.
        let lent = matches!(receiver, Value::Reference(_)).then(|| receiver.clone());
        let receiver = self.referenced(receiver);
        if let (Some(ty), true) = (expected.name(), call.method == "into" && call.args.is_empty()) {
            let several = self.functions(Some(ty), "from");
            if let Some(function) = self.function_for(&several, core::slice::from_ref(&receiver)) {
                return self.inline(&call.method, &function, vec![receiver]);
            }
        }
        let receiver = match &receiver {
            Value::Struct(of)
                if iterators::consumes(&call.method)
                    && self.own_functions(&of.name, &call.method.to_string()).is_empty() =>
            {
                self.own_iterator(&call.receiver, receiver)
            }
            _ => receiver,
        };
        if receiver.is_unknown() {
            return receiver;
        }
        let value = if is_drained || !iterators::is_lazy(&receiver, &call.method) {
            self.sequence_method(&receiver, call, expected)
        } else {
            self.without_effect(call, |this| this.sequence_method(&receiver, call, expected))
        };
        if let Some(value) = value {
            return value;
        }
        if let Some(value) = self.optional_method(&receiver, call, expected) {
            return value;
        }
        if self.report.count() > errors {
            return Value::Unknown;
        }
        if let (Some(value), true) = (self.swizzle(&receiver, &call.method.to_string()), call.args.is_empty()) {
            return value;
        }
        if let Some(value) = self.column_or_row(&receiver, call) {
            return value;
        }
        if let Some(value) = self.own_method(&receiver, (lent, has_effect), call) {
            return value;
        }
        if let Value::Struct(of) = &receiver
            && methods::methods_of(&receiver).is_empty()
        {
            if call.method == "clone" {
                return receiver;
            }
            let (name, known) = (call.method.to_string(), self.items.functions_of(&of.name));
            let text = methods::unknown_method(&name, &receiver.describe(), &known);
            return self.refuse(&call.method, text);
        }
        if let Some(turbofish) = &call.turbofish {
            return self.refuse(turbofish, messages::no_generics());
        }
        if let Some(value) = self.saturating_difference(call, &receiver, expected) {
            return value;
        }
        let (function, tables, kind) = (call.method.to_string(), methods::methods_of(&receiver), receiver.describe());
        self.apply(&Callee { name: &call.method, function, tables, kind }, Some(receiver), &call.args)
    }

    /// Evaluates `v.xz()` and the like: components in another order.
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

    /// Evaluates `m.col(k)` or `m.row(k)` of a 2×2 or 4×4 matrix; `None` for any other call.
    fn column_or_row(&mut self, receiver: &Value, call: &ExprMethodCall) -> Option<Value> {
        let name = call.method.to_string();
        let (Value::Square(_) | Value::Homogeneous(_), "col" | "row", Some(index), 1) =
            (receiver, name.as_str(), call.args.first(), call.args.len())
        else {
            return None;
        };
        let mut columns = square::columns(self.algebra, receiver)?;
        if name == "row" {
            columns = square::transposed(&columns);
        }
        let value = self.expression(index);
        let Some(index) = self.algebra.known_index(&value) else {
            return Some(self.refuse_known(&value, index, messages::index_unknown()));
        };
        Some(match columns.get(index) {
            Some(column) => square::vector(self.algebra, column),
            None => self.refuse(&call.args, messages::index_outside("a matrix")),
        })
    }

    /// Evaluates a method that the module defines for a struct of its own, or by a trait for numbers; `None` if there
    /// is none.
    fn own_method(
        &mut self,
        receiver: &Value,
        (lent, has_effect): (Option<Value>, bool),
        call: &ExprMethodCall,
    ) -> Option<Value> {
        let name = call.method.to_string();
        let ty = self.type_name(receiver)?;
        let several = match receiver {
            Value::Struct(_) => self.own_functions(&ty, &name),
            _ => {
                let types = names_of_type(receiver, self.precision).map(|ty| self.own_functions(ty, &name));
                let mut types = types.filter(|functions| !functions.is_empty());
                let several = types.next()?;
                if types.next().is_some() {
                    drop(types);
                    return Some(self.refuse(&call.method, messages::several_functions(&name)));
                }
                several
            }
        };
        let receiver = match several.as_slice() {
            [] => return None,
            [function] if function.changed.first() == Some(&true) && lent.is_some() => lent?,
            // Evaluating the receiver again would repeat its side effects.
            [function] if function.changed.first() == Some(&true) && has_effect => {
                return Some(self.refuse(&call.receiver, messages::receiver_effect()));
            }
            [function] if function.changed.first() == Some(&true) => self.reference(&call.receiver),
            _ => receiver.clone(),
        };
        Some(self.one_of(&call.method, &several, Some(receiver), &call.args))
    }

    /// Returns the functions of this name that the module defines for a type. Empty if an inherent function has
    /// precedence, or might have: the inherent functions of types outside the module are not all known.
    fn own_functions(&self, ty: &str, name: &str) -> Vec<Rc<Callable>> {
        let is_own = self.items.defines(ty);
        let may_be = is_own || types::named(ty).is_some_and(|(shape, _)| !methods::is_of_type(&shape, name));
        if may_be { self.functions(Some(ty), name) } else { Vec::new() }
    }

    pub(super) fn call(&mut self, call: &ExprCall, expected: &Expected) -> Value {
        let Expr::Path(path) = strip(&call.func) else {
            return match self.expression(&call.func) {
                Value::Function(function) => self.inline_written(&call.func, &function, None, &call.args),
                other => self.refuse_known(&other, &call.func, messages::call_of_value()),
            };
        };
        if let (None, Some((ty, tag))) = (&path.qself, self.variant(&segments(&path.path))) {
            let expected = self.expected_fields(&ty, tag);
            let fields = call.args.iter().zip(expected);
            let fields = fields.map(|(value, (name, expected))| (name, self.expression_as(value, &expected))).collect();
            return self.of_variant(&ty, tag, fields);
        }
        let Some((ty, name)) = type_and_name(path) else {
            return self.refuse(&path.path, messages::unknown_function(&path_text(path)));
        };
        let text = name.to_string();
        if let (None, Some(local)) = (&path.qself, path.path.get_ident().and_then(|_| self.frame.find(&text))) {
            return match self.frame.value(local).clone() {
                Value::Function(function) => self.inline_written(name, &function, None, &call.args),
                other => self.refuse_known(&other, name, messages::call_of_value()),
            };
        }
        match ty {
            Some(ty) => {
                let ty = self.resolved(&ty);
                self.call_of_type(call, path, (&ty, name), expected)
            }
            None if text == "Self" => {
                let own = self.resolved(&[text]);
                self.call_of_item(call, path, &own, expected)
            }
            None => match self.items.meaning(&self.frame.scope, &segments(&path.path)) {
                Meaning::Own(own) => self.call_of_item(call, path, &own, expected),
                Meaning::External(outside) => self.call_of_external(call, path, &outside, expected),
            },
        }
    }

    /// Evaluates `Type::function(…)`.
    fn call_of_type(
        &mut self,
        call: &ExprCall,
        path: &syn::ExprPath,
        (ty, name): (&str, &Ident),
        expected: &Expected,
    ) -> Value {
        let text = name.to_string();
        // `<Type as Trait>::function` belongs to the trait; otherwise inherent functions have precedence.
        let of_trait = path
            .qself
            .as_ref()
            .filter(|qself| qself.position > 0)
            .map(|qself| path.path.segments[qself.position - 1].ident.to_string());
        // `T::function` of a generic parameter belongs to one of its traits.
        let is_generic = path.path.segments.first().is_some_and(|first| {
            path.path.segments.len() == 2 && self.frame.scope.generics.iter().any(|known| first.ident == known)
        });
        let mut several = match &of_trait {
            None if !is_generic => self.own_functions(ty, &text),
            _ => self.functions(Some(ty), &text),
        };
        if is_generic {
            several.retain(|function| function.of_trait.is_some());
        } else if of_trait.is_some() || several.iter().any(|function| function.of_trait.is_none()) {
            several.retain(|function| function.of_trait == of_trait);
        }
        // Types outside the module have other functions besides those that the module defines.
        if !several.is_empty() && !self.items.defines(ty) {
            let arguments: Vec<Value> = call.args.iter().map(|argument| self.expression(argument)).collect();
            if arguments.iter().any(Value::is_unknown) {
                return Value::Unknown;
            }
            several = self.function_for(&several, &arguments).into_iter().collect();
        }
        let is_default = text == "default" && several.iter().all(|function| function.of_trait.is_some());
        if is_default && call.args.is_empty() {
            let is_known = ty == "Default" || expected.name() == Some(ty);
            let of = if is_known { expected.clone() } else { Expected::Named(ty.to_owned()) };
            let of = self.type_called(path).unwrap_or(of);
            return self.default_value(&path.path, &of);
        }
        if !several.is_empty() {
            let called = self.type_called(path);
            several = several.iter().map(|function| self.specialised(function, called.as_ref(), expected)).collect();
            return self.one_of(&path.path, &several, None, &call.args);
        }
        if path.path.segments.last().is_some_and(|last| !last.arguments.is_none()) {
            return self.refuse(&path.path, messages::no_generics());
        }
        match (ty, text.as_str()) {
            ("Vec", "new" | "with_capacity") => Value::Array(Vec::new()),
            (ty, "from") if types::is_integer(ty) && call.args.len() == 1 => match self.expression(&call.args[0]) {
                Value::Truth(holds) => Value::Integer(self.algebra.number_of(&holds)),
                Value::Integer(number) => Value::Integer(number),
                other => self.refuse_known(&other, &path.path, messages::unknown_function(&path_text(path))),
            },
            // Smart pointers are transparent.
            ("Box" | "Rc" | "Arc", "new") if call.args.len() == 1 => self.expression(&call.args[0]),
            _ => self.call_of_glam(call, path, name, (ty, text)),
        }
    }

    /// Returns the generic type at the start of a function's path; `None` if it has no arguments.
    fn type_called(&mut self, path: &syn::ExprPath) -> Option<Expected> {
        let mut ty = path.path.clone();
        ty.segments.pop();
        ty.segments.pop_punct();
        let ty = self.expected(&syn::Type::Path(syn::TypePath { attrs: Vec::new(), qself: None, path: ty }));
        matches!(&ty, Expected::Generic(_, known) if !known.is_empty()).then_some(ty)
    }

    /// Evaluates a call of one of the module's functions, or of a tuple struct's constructor.
    fn call_of_item(&mut self, call: &ExprCall, path: &syn::ExprPath, own: &str, expected: &Expected) -> Value {
        let mut several = self.functions(None, own);
        if !several.is_empty() {
            for function in &mut several {
                *function = self.with_result(function, expected);
                *function = self.with_arguments(function, &path.path);
            }
            return self.one_of(&path.path, &several, None, &call.args);
        }
        let name = self.items.resolved(&Scope::default(), &own.split("::").map(str::to_owned).collect::<Vec<_>>());
        let Some(structure) = self.items.structure(&name) else {
            let text = self.not_found_message(own, messages::unknown_function(&path_text(path)));
            return self.refuse(&path.path, text);
        };
        let of = self.constructed(&path.path, &name, expected);
        let expected = self.field_types(structure, &of);
        let values = call.args.iter().enumerate().map(|(index, value)| {
            let value = self.expression_as(value, expected.get(index).unwrap_or(&Expected::Any));
            (index.to_string(), value)
        });
        Value::Struct(Rc::new(Struct { fields: values.collect(), name }))
    }

    /// Returns the type that a constructor's path makes: with the generic arguments in the path, or else those of the
    /// expected type.
    fn constructed(&mut self, path: &syn::Path, name: &str, expected: &Expected) -> Expected {
        let written = syn::TypePath { attrs: Vec::new(), qself: None, path: path.clone() };
        match self.expected(&syn::Type::Path(written)) {
            Expected::Generic(name, known) => Expected::Generic(name, known),
            _ if expected.name() == Some(name) => expected.clone(),
            _ => Expected::Any,
        }
    }

    /// Returns the types of a struct's fields, in the order of its declaration.
    pub(super) fn field_types(&mut self, structure: &Structure, of: &Expected) -> Vec<Expected> {
        self.within(structure.scope.clone(), |this| {
            this.declare_arguments(structure, of);
            structure.fields.iter().map(|(_, ty)| this.expected(ty)).collect()
        })
    }

    /// Evaluates a call of a free function outside the module.
    fn call_of_external(
        &mut self,
        call: &ExprCall,
        path: &syn::ExprPath,
        outside: &[String],
        expected: &Expected,
    ) -> Value {
        let name =
            path.path.segments.last().map_or_else(|| path.path.to_token_stream(), |last| last.ident.to_token_stream());
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let text = outside.last().cloned().unwrap_or_default();
        let is_in_std = |this: &Self, module: &str| this.is_in_std(outside, module, path.span());
        match (text.as_str(), arguments.as_slice(), expected) {
            ("from_fn", [function], _) if is_in_std(self, "array") => {
                let (element, length) = match expected {
                    Expected::Array(element, length) => ((**element).clone(), *length),
                    _ => (Expected::Any, None),
                };
                if let Some(length) = self.written_length(path).or(length) {
                    return self.array_of(call, length, function, &element);
                }
                return self.refuse(&call.func, messages::from_fn_unknown());
            }
            // The error's value is not tracked.
            ("Err", [error], _) => return self.without_error_effect(error, Value::none()),
            ("Some" | "Ok", [value], _) => {
                let value = self.moved_value(value, &Expected::Any);
                return Value::some(value);
            }
            ("replace", [place, value], _) if is_in_std(self, "mem") => {
                return self.replaced(&call.func, place, value);
            }
            ("swap", [one, other], _) if is_in_std(self, "mem") => return self.exchanged(&call.func, one, other),
            ("zip", [one, other], _) if is_in_std(self, "iter") => {
                let zipped = self.iterated(one).and_then(|items| self.zipped(items, other));
                return zipped.unwrap_or(Value::Unknown);
            }
            ("once", [value], _) if is_in_std(self, "iter") => return Value::iterator([self.expression(value)]),
            ("repeat", [value], _) if is_in_std(self, "iter") => {
                let (value, one) = (self.expression(value), self.algebra.count(1));
                let once = LoopSequence::of(one, SequenceItems::Listed(Value::Array(vec![value])));
                return Value::LoopSequence(Rc::new(once.cycled(self.algebra)));
            }
            ("repeat_n", [value, count], _) if is_in_std(self, "iter") => {
                let (value, count) = (self.expression(value), self.known_count(count));
                return count.map_or(Value::Unknown, |count| Value::iterator(vec![value; count]));
            }
            _ => {}
        }
        if path.path.segments.last().is_some_and(|last| !last.arguments.is_none()) {
            return self.refuse(&path.path, messages::no_generics());
        }
        match (SHORT.iter().find(|(short, ..)| text == *short), path.path.segments.last()) {
            (Some((_, ty, function)), Some(last)) => {
                self.call_of_glam(call, path, &last.ident, (ty, (*function).to_owned()))
            }
            _ => {
                let text = self.not_found_message(&text, messages::unknown_function(&outside.join("::")));
                self.refuse(&name, text)
            }
        }
    }

    /// Returns a function of a glam type, or of numbers, as a closure that can be passed on; `None` if there is none of
    /// this name.
    pub(super) fn passed(&mut self, path: &syn::ExprPath, ty: &str, name: &str) -> Option<Value> {
        let (shape, _) = types::named(ty)?;
        let mut entries = methods::functions_of(&shape).iter().copied().flatten();
        let count = entries.find(|function| function.name == name)?.count();
        let names: Vec<Ident> = (0..count).map(|index| quote::format_ident!("argument_{index}")).collect();
        Some(self.closure(&syn::parse_quote!(|#(#names),*| #path(#(#names),*))))
    }

    /// Evaluates a function of a glam type, or of numbers.
    fn call_of_glam(
        &mut self,
        call: &ExprCall,
        path: &syn::ExprPath,
        name: &Ident,
        (ty, function): (&str, String),
    ) -> Value {
        let Some((shape, _)) = types::named(ty).filter(|_| !self.items.defines(ty)) else {
            let text = path_text(path);
            let text = self.not_found_message(&text, messages::unknown_function(&text));
            return self.refuse(&path.path, text);
        };
        if function == "from_euler" {
            return self.euler(&shape, name, call);
        }
        let (tables, kind) = (methods::functions_of(&shape), format!("`{ty}`"));
        self.apply(&Callee { name, function, tables, kind }, None, &call.args)
    }

    /// Returns the default value of a type.
    pub(super) fn default_value(&mut self, place: &impl ToTokens, of: &Expected) -> Value {
        let errors = self.report.count();
        let value = self.default_of(place, of);
        value.unwrap_or_else(|| {
            if self.report.count() > errors { Value::Unknown } else { self.refuse(place, messages::no_default()) }
        })
    }

    /// Returns the length in `from_fn::<f64, 4, _>`.
    fn written_length(&mut self, path: &syn::ExprPath) -> Option<usize> {
        let syn::PathArguments::AngleBracketed(written) = &path.path.segments.last()?.arguments else { return None };
        let length: Expr = match written.args.iter().nth(1)? {
            syn::GenericArgument::Const(length) => length.clone(),
            // The parser reads the name of a constant as a type.
            syn::GenericArgument::Type(syn::Type::Path(name)) => syn::parse_quote!(#name),
            _ => return None,
        };
        let length = self.expression(&length);
        self.algebra.known_index(&length)
    }

    /// Evaluates `array::from_fn` with a known length.
    fn array_of(&mut self, call: &ExprCall, length: usize, function: &Expr, element: &Expected) -> Value {
        let Some(function) = self.function_argument(function, 1) else { return Value::Unknown };
        let values: Vec<Value> = (0..length)
            .map(|index| {
                let index = self.algebra.count_value(index);
                self.inline_as(&call.func, &function, vec![index], element)
            })
            .collect();
        if values.iter().any(Value::is_unknown) { Value::Unknown } else { Value::Array(values) }
    }

    /// Evaluates `Type { field: value, … }`.
    pub(super) fn structure(&mut self, of: &ExprStruct, expected: &Expected) -> Value {
        if let Some((ty, tag)) = self.variant(&segments(&of.path)) {
            let known = self.expected_fields(&ty, tag);
            let fields = of.fields.iter().map(|field| {
                let name = name_of(&field.member);
                let expected = known.iter().find(|(known, _)| *known == name).map(|(_, expected)| expected);
                (name, self.moved_value(&field.expr, expected.unwrap_or(&Expected::Any)))
            });
            let fields = fields.collect();
            return self.of_variant(&ty, tag, fields);
        }
        let name = self.resolved(&segments(&of.path));
        let structure = self.items.structure(&name);
        let declared = structure.map(|structure| structure.fields.as_slice()).unwrap_or_default();
        let constructed = self.constructed(&of.path, &name, expected);
        let types = structure.map_or_else(Vec::new, |structure| self.field_types(structure, &constructed));
        let mut fields: Vec<(String, Value)> = Vec::new();
        for field in &of.fields {
            let place = declared.iter().position(|(member, _)| *member == field.member);
            let expected = place.map_or(&Expected::Any, |place| &types[place]);
            fields.push((name_of(&field.member), self.moved_value(&field.expr, expected)));
        }
        if let Some(rest) = &of.rest {
            match self.expression_as(rest, &Expected::Named(name.clone())) {
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
        if structure.is_some() {
            // Use the order of the declaration, so that two values have their fields at the same positions.
            let place = |(name, _): &(String, Value)| declared.iter().position(|(member, _)| name_of(member) == *name);
            fields.sort_by_key(place);
            return Value::Struct(Rc::new(Struct { name, fields }));
        }
        self.structure_of_glam(of, &name, fields)
    }

    /// Evaluates a struct expression of a glam type, by its constructor.
    fn structure_of_glam(&mut self, of: &ExprStruct, name: &str, mut fields: Vec<(String, Value)>) -> Value {
        let constructor = match types::named(name) {
            Some((Shape::Planar | Shape::Vector | Shape::Four, _)) => "new",
            Some((Shape::Rigid, _)) => "from_mat3_translation",
            Some((Shape::Matrix, _)) => "from_cols",
            _ => {
                let text = self.not_found_message(name, messages::outside_struct(name));
                return self.refuse(&of.path, text);
            }
        };
        // `x_axis` and the like, and `matrix3` before `translation`, are in alphabetical order; only `w` comes last.
        fields.sort_by_key(|(name, _)| (name == "w", name.clone()));
        let values: Vec<Value> = fields.into_iter().map(|(_, value)| value).collect();
        let tables = types::named(name).map_or(&[][..], |(shape, _)| methods::functions_of(&shape));
        match methods::call(tables, constructor, self.algebra, &values) {
            Some(Ok(value)) => value,
            _ => self.refuse(&of.path, messages::outside_struct(name)),
        }
    }

    /// Evaluates a call; a method's receiver precedes the written arguments.
    fn apply(&mut self, callee: &Callee<'_>, receiver: Option<Value>, written: &Punctuated<Expr, Comma>) -> Value {
        let of_a_method = receiver.is_some();
        let mut arguments: Vec<Value> = receiver.into_iter().collect();
        let Callee { name, function, tables, kind } = callee;
        let known = tables.iter().copied().flatten().map(|function| function.name);
        let unknown = || methods::unknown_method(function, kind, &known.clone().collect::<Vec<_>>());
        // Report an unknown function without evaluating its arguments, which may be valid for that function only.
        if known.clone().all(|known| known != function) && Value::without(&arguments).is_none() {
            let text = unknown();
            return self.refuse_any(&arguments.iter().collect::<Vec<_>>(), *name, text);
        }
        arguments.extend(written.iter().map(|argument| self.expression(argument)));
        if let Some(without) = Value::without(&arguments) {
            return without;
        }
        let text = match methods::call(tables, function, self.algebra, &arguments) {
            Some(Ok(value)) => return value,
            Some(Err((CallError::Message(text), _))) if !written.is_empty() => return self.refuse(written, text),
            Some(Err((CallError::Message(text) | CallError::Refused(text), _))) => text,
            Some(Err((CallError::Arguments, _))) => {
                let found: Vec<String> = arguments[usize::from(of_a_method)..].iter().map(Value::describe).collect();
                let named = tables.iter().copied().flatten().filter(|known| known.name == function);
                let mut takes: Vec<String> = named.map(|known| known.takes(of_a_method)).collect();
                takes.dedup();
                let text = messages::wrong_arguments(function, &takes.join(", or "), &found.join(", "));
                return self.refuse_any(&arguments.iter().collect::<Vec<_>>(), *name, text);
            }
            None => unknown(),
        };
        self.refuse(*name, text)
    }

    /// Evaluates `from_euler(EulerRot::YXZ, a, b, c)`: rotations about those axes, the first outermost; innermost with
    /// `Ex`.
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

/// Returns the axes of an `EulerRot`, and `true` if it is extrinsic.
fn euler_axes(name: &str) -> Option<([usize; 3], bool)> {
    let (letters, extrinsic) = match name.strip_suffix("Ex") {
        Some(letters) => (letters, true),
        None => (name, false),
    };
    let axes: Option<Vec<usize>> = letters.chars().map(|letter| "XYZ".find(letter)).collect();
    Some((axes?.try_into().ok()?, extrinsic))
}
