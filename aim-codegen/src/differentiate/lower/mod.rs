//! Interprets the function's body symbolically and builds its value in the graph. Unsupported code is an error at its
//! place; a value that depends on it is unknown, and causes no further errors.

mod algebra;
mod arrays;
mod bounds;
mod calls;
mod casts;
mod choices;
mod condition;
mod constants;
mod defaults;
mod enums;
mod expected;
mod extents;
mod extra_inputs;
mod fields;
mod frame;
mod functions;
mod generics;
mod iterators;
mod kept_loops;
mod lending;
mod lists;
mod loop_sequences;
mod loops;
mod map;
mod methods;
mod numbers;
mod operators;
mod optional;
mod overloads;
mod paths;
mod patterns;
mod place_types;
mod places;
mod select;
mod slices;
mod square;
mod statements;
mod translation;
mod value;

#[cfg(test)]
mod tests;

use std::rc::Rc;

use proc_macro2::Span;
use quote::ToTokens;
use syn::{Expr, Ident, UnOp};

pub(super) use self::algebra::Algebra;
pub(super) use self::condition::Condition;
pub(super) use self::enums::{TAG, field_of};
use self::expected::Expected;
pub(super) use self::extra_inputs::{ElementIndex, ExtraInput, KeptLoop, State};
use self::frame::Frame;
pub(super) use self::functions::each_word;
pub(super) use self::map::{Affine, Map, Quaternion};
pub(super) use self::numbers::names_at;
pub(super) use self::square::columns;
pub(super) use self::translation::{Translation, length};
pub(super) use self::value::{Callable, Optional, Scope, Slice, Struct, Value};
use super::messages;
use super::names::{Meaning, is_of_std, segments};
use crate::declare::report::text::Text;
use crate::differentiate::constants::{Assumption, Constant};
use crate::emit::Precision;

impl Translation<'_> {
    /// Runs a function with these arguments; those in `faulty` are unknown.
    pub(super) fn function<'p>(
        &mut self,
        block: &syn::Block,
        result: &syn::ReturnType,
        arguments: impl Iterator<Item = (&'p syn::Pat, Value)>,
        faulty: &[Ident],
    ) -> Value {
        for (pattern, value) in arguments {
            self.bind(pattern, value);
        }
        for name in faulty {
            self.frame.declare(name.to_string(), Value::Unknown);
        }
        let expected = match result {
            syn::ReturnType::Type(_, ty) => self.expected(ty),
            syn::ReturnType::Default => Expected::Any,
        };
        self.frame.result_type = expected.clone();
        let end = self.block_as(block, &expected);
        let value = self.frame.result(self.algebra, end).map(|(value, _)| value);
        value.unwrap_or_else(|| self.refuse(&block.stmts.last(), messages::returns_differ()))
    }

    /// Evaluates an expression of these names.
    pub(super) fn formula(&mut self, expression: &Expr, names: Vec<(String, Value)>) -> Value {
        self.frame = Frame::new(names, Rc::default());
        self.expression(expression)
    }

    /// Evaluates an expression.
    pub(super) fn expression(&mut self, expression: &Expr) -> Value {
        self.expression_as(expression, &Expected::Any)
    }

    /// Evaluates an expression whose expected type is known.
    fn expression_as(&mut self, expression: &Expr, expected: &Expected) -> Value {
        let value = self.expression_by_kind(expression, expected);
        self.rounded_to(expected, value)
    }

    fn expression_by_kind(&mut self, expression: &Expr, expected: &Expected) -> Value {
        match expression {
            Expr::Group(group) => self.expression_as(&group.expr, expected),
            Expr::Paren(paren) => self.expression_as(&paren.expr, expected),
            Expr::Lit(literal) => self.literal(&literal.lit),
            Expr::Path(path) => self.path(path),
            Expr::Unary(unary) => self.unary(unary),
            Expr::Binary(binary) => self.binary(binary),
            Expr::Reference(reference) => {
                if reference.mutability.is_some() {
                    self.reference(&reference.expr)
                } else {
                    self.expression_as(&reference.expr, expected)
                }
            }
            Expr::MethodCall(call) => self.method_call(call, expected),
            Expr::Call(call) => self.call(call, expected),
            Expr::Struct(of) => self.structure(of, expected),
            Expr::Field(field) => self.field(field),
            Expr::Index(index) => self.index(index),
            Expr::Range(range) => self.range(range),
            Expr::Cast(cast) => self.cast(cast),
            Expr::If(choice) => self.choice(choice, expected),
            Expr::Match(choice) => self.match_arms(choice, expected),
            Expr::ForLoop(e) => self.for_loop(e),
            Expr::While(e) => self.while_loop(e),
            Expr::Loop(e) => self.endless_loop(e),
            Expr::Return(_) | Expr::Break(_) | Expr::Continue(_) => self.jump(expression),
            Expr::Closure(closure) => self.closure(closure),
            Expr::Assign(assign) => self.assignment(assign),
            Expr::Try(e) => self.try_value(e),
            Expr::Macro(e) => self.macro_call(&e.mac),
            Expr::Block(block) => match &block.label {
                Some(label) => self.labelled_block(label, &block.block, expected),
                None => self.block_as(&block.block, expected),
            },
            Expr::Tuple(tuple) => {
                let parts = tuple.elems.iter().enumerate();
                Value::Tuple(parts.map(|(index, part)| self.moved_value(part, expected.part(index))).collect())
            }
            Expr::Array(array) => {
                let elements = array.elems.iter().enumerate();
                Value::Array(elements.map(|(index, part)| self.moved_value(part, expected.part(index))).collect())
            }
            Expr::Repeat(repeat) => {
                let value = self.expression_as(&repeat.expr, expected.part(0));
                let length = self.expression(&repeat.len);
                match self.algebra.known_index(&length) {
                    Some(length @ 0..=LONGEST_ARRAY) => Value::Array(vec![value; length]),
                    Some(_) => self.refuse(&repeat.len, messages::array_too_long(LONGEST_ARRAY)),
                    None => self.refuse_known(&length, &repeat.len, messages::length_unknown()),
                }
            }
            other => self.unsupported_expression(other),
        }
    }

    fn literal(&mut self, literal: &syn::Lit) -> Value {
        let number = match literal {
            syn::Lit::Float(number) => number.base10_parse::<f64>().ok().map(|value| (value, number.suffix())),
            syn::Lit::Int(number) if number.suffix().starts_with('f') => {
                number.base10_parse::<f64>().ok().map(|value| (value, number.suffix()))
            }
            syn::Lit::Int(number) => {
                return match number.base10_parse::<i64>() {
                    Ok(number) => self.algebra.integer(number),
                    Err(_) => self.refuse(literal, messages::integer_overflow()),
                };
            }
            syn::Lit::Bool(truth) => return Value::Truth(Condition::Known(truth.value)),
            _ => None,
        };
        match number {
            Some((number, suffix)) if number.is_finite() => {
                let value = Value::Scalar(self.algebra.number(number));
                self.rounded_to(&Expected::Named(suffix.to_owned()), value)
            }
            _ => self.unsupported(literal, "this literal", "only numbers, `true` and `false` are supported"),
        }
    }

    fn path(&mut self, path: &syn::ExprPath) -> Value {
        if let (None, Some(name)) = (&path.qself, path.path.get_ident())
            && let Some(place) = self.frame.find(&name.to_string())
        {
            let value = self.frame.value(place).clone();
            return self.referenced(value);
        }
        if let (None, Some((ty, tag))) = (&path.qself, self.variant(&segments(&path.path))) {
            return self.of_variant(&ty, tag, Vec::new());
        }
        let value = match paths::type_and_name(path) {
            Some((Some(ty), name)) => self.associated(&ty, &name.to_string()).or_else(|| {
                let ty = self.resolved(&ty);
                self.passed(path, &ty, &name.to_string())
            }),
            Some((None, _)) => self.item(&segments(&path.path)),
            None => None,
        };
        let value = value.or_else(|| self.unit_struct(&segments(&path.path)));
        let value = value.or_else(|| {
            let constant = self.path_of_constant(path)?;
            self.constant_of_file(&constant).or_else(|| self.constant_beside(constant))
        });
        value.unwrap_or_else(|| {
            let text = match path.path.get_ident() {
                Some(name) if self.frame.scope.lengths.iter().any(|known| name == known) => {
                    messages::generic_unknown(&name.to_string())
                }
                Some(name) if !self.reads_constants && name.to_string().starts_with(char::is_uppercase) => {
                    let name = name.to_string();
                    self.not_found_message(&name, messages::constant_elsewhere(&name))
                }
                Some(name) => {
                    let name = name.to_string();
                    self.not_found_message(&name, messages::outside_name(&name, &self.frame.names()))
                }
                None => {
                    let text = paths::path_text(path);
                    self.not_found_message(&text, messages::outside_constant(&text))
                }
            };
            self.refuse(&path.path, text)
        })
    }

    /// Returns an integer or a boolean that stands in the same file, outside of the known items.
    fn constant_of_file(&mut self, path: &syn::Path) -> Option<Value> {
        let (name, items, before) = (segments(path).pop()?, self.items, self.report_counts());
        let constant = items.surroundings.constant(&name).filter(|_| path.leading_colon.is_none())?;
        let value = items.surroundings.within(|| self.constant(&name, constant));
        if self.report.count() > before.errors {
            self.forget_reports_since(before);
            return None;
        }
        let number = match &value {
            Value::Truth(Condition::Known(holds)) => i64::from(*holds),
            value => self.algebra.known_integer(value)?,
        };
        let idents = path.segments.iter().map(|segment| segment.ident.clone());
        self.assume(Assumption::Integer(idents.collect(), number));
        Some(value)
    }

    /// Records what a path outside of the known items is assumed to mean, for the compiler to confirm in the companion.
    /// Returns `false` if it cannot: in another module, or after a glob import in the function, the path may mean
    /// something else there.
    pub(super) fn assume(&self, assumption: Assumption) -> bool {
        let means_the_same = self.frame.scope.means_the_same_in_companions();
        if means_the_same {
            self.items.surroundings.assume(assumption);
        }
        means_the_same
    }

    /// Returns `true` if `path`, written at `span`, is that of an item of a module of the standard library, or is assumed
    /// to be.
    pub(super) fn is_in_std(&self, path: &[String], module: &str, span: Span) -> bool {
        match path {
            [.., before, _] if before != module => false,
            _ if is_of_std(path) => true,
            [name] => self.assume(Assumption::Item(Ident::new(name, span), Some(module.to_owned()))),
            [before, _] => self.assume(Assumption::Item(Ident::new(before, span), None)),
            _ => false,
        }
    }

    /// Returns a constant that the macro cannot see, beside the function or imported there, as an input that the companion
    /// reads. It has to be a number of the function's type, which the compiler checks, unless it is [cast](Self::cast).
    fn constant_beside(&mut self, path: syn::Path) -> Option<Value> {
        if !self.reads_constants {
            return None;
        }
        let known = self.algebra.constants.iter().position(|known| segments(known) == segments(&path));
        let index = known.unwrap_or_else(|| {
            self.algebra.constants.push(path);
            self.algebra.constants.len() - 1
        });
        Some(Value::Scalar(self.algebra.extra_input(ExtraInput::Constant(index))))
    }

    /// Returns the path of a constant outside of the known items, as it is written where the companion stands; `None` for
    /// other paths. Functions of inner modules cannot name such constants, as their paths mean something else there.
    fn path_of_constant(&self, path: &syn::ExprPath) -> Option<syn::Path> {
        let is_constant = |name: &str| {
            name.contains(char::is_alphabetic) && name.chars().all(|c| c.is_uppercase() || c.is_numeric() || c == '_')
        };
        let is_module = |name: &String| name.starts_with(char::is_lowercase);
        let scope = &self.frame.scope;
        if path.qself.is_some() || !scope.means_the_same_in_companions() {
            return None;
        }
        let Meaning::External(path_in_module) = self.items.meaning(scope, &segments(&path.path)) else { return None };
        let (name, modules) = path_in_module.split_last()?;
        let is_hidden = scope.lengths.contains(name) || self.items.is_conditional(name);
        if is_hidden || !is_constant(name) || !modules.iter().all(is_module) {
            return None;
        }
        let span = path.path.segments.last()?.ident.span();
        let idents = path_in_module.iter().map(|segment| syn::PathSegment::from(Ident::new(segment, span)));
        Some(syn::Path { leading_colon: path.path.leading_colon, segments: idents.collect() })
    }

    /// Returns the value of a unit struct.
    fn unit_struct(&self, path: &[String]) -> Option<Value> {
        let name = self.resolved(path);
        let structure = self.items.structure(&name).filter(|structure| structure.fields.is_empty());
        structure.map(|_| Value::Struct(Rc::new(Struct { name, fields: Vec::new() })))
    }

    /// Returns an associated item of a type: a function or a constant.
    fn associated(&mut self, ty: &[String], name: &str) -> Option<Value> {
        let ty = self.resolved(ty);
        if ty == "Ordering"
            && let Some(ordering) = Value::ordering(name)
        {
            return Some(ordering);
        }
        if let Some(function) = self.only_function(Some(&ty), name) {
            return Some(Value::Function(function));
        }
        if let Some(constant) = self.items.constant(Some(&ty), name) {
            return Some(self.constant(&format!("{ty}::{name}"), constant));
        }
        (!self.items.defines(&ty)).then(|| constants::associated(self.algebra, &ty, name))?
    }

    /// Resolves a path without a type: a function or a constant of the module, or a mathematical constant.
    fn item(&mut self, path: &[String]) -> Option<Value> {
        // A generic parameter shadows an item of the module.
        if matches!(path, [name] if self.frame.scope.lengths.contains(name)) {
            return None;
        }
        match self.items.meaning(&self.frame.scope, path) {
            Meaning::Own(name) => {
                if let Some(function) = self.only_function(None, &name) {
                    return Some(Value::Function(function));
                }
                let constant = self.items.constant(None, &name)?;
                Some(self.constant(&name, constant))
            }
            Meaning::External(path) => {
                if path == ["None"] {
                    return Some(Value::none());
                }
                let (name, modules) = path.split_last()?;
                if modules.last().map_or(self.frame.scope.module.is_empty(), |last| last == "Ordering")
                    && let Some(ordering) = Value::ordering(name)
                {
                    return Some(ordering);
                }
                let is_known = match modules {
                    // The name may be imported outside the code that the attribute sees. If the file defines it, it is read.
                    [] => name.len() > 1 && self.items.surroundings.constant(name).is_none(),
                    [before @ .., module] => {
                        module == "consts" && before.last().is_none_or(|last| last == "f32" || last == "f64")
                    }
                };
                let value = numbers::mathematical(name).filter(|_| is_known)?;
                if !is_of_std(&path) && !self.assume(Assumption::Number(path.clone())) {
                    return None;
                }
                let is_single = modules.iter().any(|module| module == "f32");
                let value = Value::Scalar(self.algebra.number(value));
                Some(if is_single { self.rounded_to(&Expected::Named("f32".into()), value) } else { value })
            }
        }
    }

    /// Evaluates a constant of the module. The compiler rejects one that depends on itself.
    fn constant(&mut self, name: &str, constant: &Constant) -> Value {
        if self.constants.iter().any(|known| known == name) {
            return Value::Unknown;
        }
        self.constants.push(name.to_owned());
        let value = self.within(constant.scope.clone(), |this| {
            let expected = this.expected_of(constant.ty.as_ref());
            this.expression_as(&constant.value, &expected)
        });
        self.constants.pop();
        value
    }

    /// Resolves a path to the name of a type: the full name, or the last segment if it is outside the module.
    fn resolved(&self, path: &[String]) -> String {
        match (&*self.frame.scope, path) {
            (Scope { self_type: Some(known), .. }, [name]) if name == "Self" => known.clone(),
            // A generic parameter shadows an item of the module.
            (scope, [name, ..]) if scope.generics.contains(name) => self.generic(name).unwrap_or_default(),
            (scope, path) => self.items.resolved(scope, path),
        }
    }

    fn assignment(&mut self, assign: &syn::ExprAssign) -> Value {
        let expected = match strip(&assign.right) {
            // The meaning of these depends on the type of the place.
            Expr::Call(_) | Expr::MethodCall(_) => {
                // Evaluate the place for its type only: its side effects happen when it is assigned.
                let (exits, errors) = (self.frame.exit_count(), self.report.count());
                self.frame.begin_branch(Condition::Known(true));
                let expected = self.type_of_place(&assign.left);
                self.frame.end_branch();
                self.frame.forget_exits(exits);
                // Without an error, control flow leaves while the place is evaluated.
                match expected {
                    Some(expected) => expected,
                    None if self.report.count() == errors => Expected::Any,
                    None => return Value::Unknown,
                }
            }
            _ => Expected::Any,
        };
        match self.expression_as(&assign.right, &expected) {
            Value::Never => Value::Never,
            value => self.assign(&assign.left, value),
        }
    }

    fn unary(&mut self, unary: &syn::ExprUnary) -> Value {
        let operand = self.expression(&unary.expr);
        let operand = self.referenced(operand);
        if operand.is_unknown() {
            return operand;
        }
        if let (UnOp::Neg(_), Value::Struct(of)) = (&unary.op, &operand)
            && let Some(function) = self.only_function(Some(&of.name), "neg")
        {
            return self.inline(&unary.op, &function, vec![operand]);
        }
        let value = match (&unary.op, &operand) {
            (UnOp::Deref(_), _) => Some(operand.clone()),
            (UnOp::Not(_), Value::Truth(condition)) => Some(Value::Truth(condition.clone().not())),
            (UnOp::Not(_), Value::Struct(of)) if of.is_mask() => {
                let parts = of.fields.iter().map(|(_, part)| match part {
                    Value::Truth(condition) => Value::Truth(condition.clone().not()),
                    other => other.clone(),
                });
                Some(Value::Struct(of.with(parts.collect())))
            }
            (UnOp::Neg(_), _) => operators::negate(self.algebra, &operand),
            _ => None,
        };
        value.unwrap_or_else(|| self.refuse(&unary.op, messages::no_unary(&operand.describe())))
    }

    fn binary(&mut self, binary: &syn::ExprBinary) -> Value {
        if short_circuits(&binary.op) {
            return self.short_circuit(binary);
        }
        let Some(operator) = operators::assigned(&binary.op) else {
            // A sum of thousands of terms nests in its left operands: evaluate them without recursion.
            let mut nested = vec![binary];
            let mut first = &*binary.left;
            while let Expr::Binary(inner) = first
                && !short_circuits(&inner.op)
                && operators::assigned(&inner.op).is_none()
            {
                nested.push(inner);
                first = &inner.left;
            }
            let first = self.expression(first);
            return nested.into_iter().rev().fold(first, |left, binary| {
                let expected = self.right_operand(&binary.op, &left);
                let right = self.expression_as(&binary.right, &expected);
                self.operator(&binary.op, left, right)
            });
        };
        // The right operand is evaluated first, and the place only once.
        let (right, has_effect) = self.tracked(|this| this.expression(&binary.right));
        let find = if has_effect { Self::still_place } else { Self::place };
        let place = match self.target(&binary.left, find) {
            Ok(place) => place,
            Err(value) => return value,
        };
        let left = self.read(&place);
        if let Some(without) = Value::without(&[left.clone(), right.clone()]) {
            return without;
        }
        match self.own_operator(&binary.op, &left, &right) {
            // An overloaded operator evaluates the place first.
            Some(Ok(_)) if has_effect && !place.steps.is_empty() => {
                self.refuse(&binary.left, messages::receiver_effect())
            }
            Some(Ok(function)) => self.inline(&binary.op, &function, vec![Value::Reference(Rc::new(place)), right]),
            Some(Err(text)) => self.refuse(&binary.op, text),
            None => {
                let value = self.operation(&binary.op, &operator, &left, &right);
                self.write(&binary.left, &place, value)
            }
        }
    }

    /// Applies an operator, built-in or overloaded, to two values.
    fn operator(&mut self, operator: &syn::BinOp, left: Value, right: Value) -> Value {
        let operands = [left, right];
        if let Some(without) = Value::without(&operands) {
            return without;
        }
        let [left, right] = operands;
        match self.own_operator(operator, &left, &right) {
            Some(Ok(function)) => self.inline(operator, &function, vec![left, right]),
            Some(Err(text)) => self.refuse(operator, text),
            None => match self.equality(operator, &left, &right) {
                Some(value) => value,
                None => self.operation(operator, operator, &left, &right),
            },
        }
    }

    /// Applies a built-in operator to two values.
    pub(super) fn operation(
        &mut self,
        place: &impl ToTokens,
        operator: &syn::BinOp,
        left: &Value,
        right: &Value,
    ) -> Value {
        if operators::compares(operator) && self.is_ambiguous(left, right) {
            return self.refuse(place, messages::rounded_constants());
        }
        let mut sides = [left, right].into_iter();
        let is_rounded = match operator {
            syn::BinOp::Div(_) | syn::BinOp::Rem(_) => sides.any(|value| self.may_have_wrapped(value)),
            syn::BinOp::Sub(_) => sides.all(|value| self.may_have_wrapped(value)),
            _ => false,
        };
        if is_rounded {
            return self.refuse(place, messages::wrapped_whole_number());
        }
        let value = operators::binary(self.algebra, operator, left, right);
        if let Value::Integer(_) = left
            && [Some(left), Some(right), value.as_ref()]
                .into_iter()
                .flatten()
                .any(|value| self.is_too_large_to_count(value))
            && !matches!(value, Some(Value::Truth(_)))
        {
            return self.refuse(place, messages::large_whole_number());
        }
        value.unwrap_or_else(|| {
            let text = self.no_operation(operator, left, right);
            self.refuse_any(&[left, right], place, text)
        })
    }

    /// Returns the message about an operation without a value.
    fn no_operation(&self, operator: &syn::BinOp, left: &Value, right: &Value) -> Text {
        match (operator, left, self.algebra.known_integer(left), self.algebra.known_integer(right)) {
            (syn::BinOp::Div(_) | syn::BinOp::Rem(_), Value::Integer(_), _, Some(0)) => messages::division_by_zero(),
            (_, _, Some(_), Some(_)) if operators::is_of_bits(operator) => messages::lost_bits(operator),
            (_, _, Some(_), Some(_)) => messages::integer_overflow(),
            (_, Value::Integer(_), ..) if operators::is_of_bits(operator) => messages::bits_unknown(operator),
            _ => messages::no_operation(operator, &left.describe(), &right.describe()),
        }
    }

    /// Returns `true` if two known numbers are so close, so large or so small that single precision may compare them
    /// differently than the double precision used here.
    fn is_ambiguous(&self, left: &Value, right: &Value) -> bool {
        let (Value::Scalar(x), Value::Scalar(y), Some(Precision::Single)) = (left, right, self.precision) else {
            return false;
        };
        let (Some(x), Some(y)) = (self.algebra.known(*x), self.algebra.known(*y)) else { return false };
        let is_beyond =
            |x: f64| x.is_finite() && x.abs() > f32::MAX.into() || x != 0.0 && x.abs() < f32::MIN_POSITIVE.into();
        is_beyond(x) || is_beyond(y) || x != y && (x - y).abs() <= NEAR * x.abs().max(y.abs())
    }

    /// Evaluates `left && right` or `left || right`: the right side is run only where the left side does not decide.
    fn short_circuit(&mut self, binary: &syn::ExprBinary) -> Value {
        let is_and = matches!(binary.op, syn::BinOp::And(_));
        let left = match self.expression(&binary.left) {
            Value::Truth(left) => left,
            other => {
                return self.refuse_known(&other, &binary.left, messages::not_a_condition(&other.describe()));
            }
        };
        let right_runs = if is_and { left.clone() } else { left.clone().not() };
        if matches!(right_runs, Condition::Known(false)) {
            return Value::Truth(left);
        }
        match self.run_under(&binary.op, &right_runs, |this| this.expression(&binary.right)) {
            Value::Truth(right) => Value::Truth(if is_and { left.and(right) } else { left.or(right) }),
            // If the right side diverges, control flow continues only where the left side decides.
            Value::Never if matches!(right_runs, Condition::Known(true)) => Value::Never,
            Value::Never => Value::Truth(left),
            other => self.refuse_known(&other, &binary.right, messages::not_a_condition(&other.describe())),
        }
    }

    fn unsupported_expression(&mut self, expression: &Expr) -> Value {
        match expression {
            Expr::Let(e) => self.unsupported(&e.let_token, "`let` in this place", CHOICE),
            Expr::Unsafe(e) => self.unsupported(&e.unsafe_token, "`unsafe`", "remove it: only safe code is supported"),
            other => self.unsupported(other, "this expression", "use `let`, arithmetic, calls, `if` and `for`"),
        }
    }
}

/// Relative distance within which rounding may reverse the order of two constants.
const NEAR: f64 = 1e-5;

/// Returns `true` for `&&` and `||`, whose right operand may not be evaluated.
fn short_circuits(operator: &syn::BinOp) -> bool {
    matches!(operator, syn::BinOp::And(_) | syn::BinOp::Or(_))
}

/// Returns `true` if an expression is a variable or a part of one.
fn is_place(expression: &Expr) -> bool {
    match strip(expression) {
        Expr::Path(_) => true,
        Expr::Field(field) => is_place(&field.base),
        Expr::Index(index) => is_place(&index.expr),
        Expr::Unary(unary) => is_place(&unary.expr),
        Expr::Reference(reference) => is_place(&reference.expr),
        _ => false,
    }
}

/// Removes parentheses and invisible groups around an expression.
fn strip(expression: &Expr) -> &Expr {
    match expression {
        Expr::Group(group) => strip(&group.expr),
        Expr::Paren(paren) => strip(&paren.expr),
        other => other,
    }
}

/// Maximum length of an array.
const LONGEST_ARRAY: usize = 4096;

const CHOICE: &str = "write it with `if` and `else`";
