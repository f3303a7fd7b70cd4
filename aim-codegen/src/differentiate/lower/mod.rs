//! The function's body → the value of its result, built in the graph. Everything that cannot be told is an error at
//! its place; what depends on it is then unknown, and nothing more is said about it.

mod algebra;
mod calls;
mod choices;
mod condition;
mod constants;
mod defaults;
mod fields;
mod frame;
mod functions;
mod map;
mod methods;
mod operators;
mod paths;
mod places;
mod select;
mod sequences;
mod square;
mod statements;
mod translation;
mod value;

#[cfg(test)]
mod tests;

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Expr, UnOp};

pub(super) use self::algebra::Algebra;
pub(super) use self::condition::Condition;
use self::frame::Frame;
pub(super) use self::map::{Affine, Map, Quaternion};
pub(super) use self::square::columns;
pub(super) use self::translation::{Translation, length};
pub(super) use self::value::{Callable, Struct, Value};
use super::messages;

impl Translation<'_> {
    /// The value of a function of these arguments; of those at fault nothing is known.
    pub(super) fn function<'p>(
        &mut self,
        block: &syn::Block,
        arguments: impl Iterator<Item = (&'p syn::Pat, Value)>,
        faulty: &[syn::Ident],
    ) -> Value {
        for (pattern, value) in arguments {
            self.bind(pattern, value);
        }
        for name in faulty {
            self.frame.declare(name.to_string(), Value::Unknown);
        }
        let end = self.block(block);
        let value = self.frame.result(self.algebra, end).map(|(value, _)| value);
        value.unwrap_or_else(|| self.refuse(&block.stmts.last(), messages::returns_differ()))
    }

    /// The value of an expression of these names.
    pub(super) fn formula(&mut self, expression: &Expr, names: Vec<(String, Value)>) -> Value {
        self.frame = Frame::new(names);
        self.expression(expression)
    }

    /// The value of an expression.
    pub(super) fn expression(&mut self, expression: &Expr) -> Value {
        match expression {
            Expr::Group(group) => self.expression(&group.expr),
            Expr::Paren(paren) => self.expression(&paren.expr),
            Expr::Lit(literal) => self.literal(&literal.lit),
            Expr::Path(path) => self.path(path),
            Expr::Unary(unary) => self.unary(unary),
            Expr::Binary(binary) => self.binary(binary),
            Expr::Reference(reference) => {
                if reference.mutability.is_some() {
                    self.reference(&reference.expr)
                } else {
                    self.expression(&reference.expr)
                }
            }
            Expr::MethodCall(call) => self.method_call(call),
            Expr::Call(call) => self.call(call),
            Expr::Struct(of) => self.structure(of),
            Expr::Field(field) => self.field(field),
            Expr::Index(index) => self.index(index),
            Expr::Range(range) => self.range(range),
            Expr::Cast(cast) => self.cast(cast),
            Expr::If(choice) => self.choice(choice),
            Expr::Match(choice) => self.match_arms(choice),
            Expr::ForLoop(e) => self.for_loop(e),
            Expr::While(e) => self.while_loop(e),
            Expr::Loop(e) => self.endless_loop(e),
            Expr::Return(_) | Expr::Break(_) | Expr::Continue(_) => self.jump(expression),
            Expr::Closure(closure) => self.closure(closure),
            Expr::Assign(assign) => match self.expression(&assign.right) {
                Value::Never => Value::Never,
                value => self.assign(&assign.left, value),
            },
            Expr::Macro(e) => self.macro_call(&e.mac),
            Expr::Block(block) => match &block.label {
                Some(label) => self.unsupported(label, "a labelled block", "write it as a block without a label"),
                None => self.block(&block.block),
            },
            Expr::Tuple(tuple) => Value::Tuple(tuple.elems.iter().map(|element| self.expression(element)).collect()),
            Expr::Array(array) => Value::Array(array.elems.iter().map(|element| self.expression(element)).collect()),
            Expr::Repeat(repeat) => {
                let (value, length) = (self.expression(&repeat.expr), self.expression(&repeat.len));
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
            syn::Lit::Float(number) => number.base10_parse::<f64>().ok(),
            syn::Lit::Int(number) if number.suffix().starts_with('f') => number.base10_parse::<f64>().ok(),
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
            Some(number) if number.is_finite() => Value::Scalar(self.algebra.number(number)),
            _ => {
                self.unsupported(literal, "this literal", "only numbers, `true` and `false` can be part of a function")
            }
        }
    }

    fn path(&mut self, path: &syn::ExprPath) -> Value {
        let segments: Vec<String> = path.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        if let (None, [name]) = (&path.qself, segments.as_slice()) {
            if let Some(place) = self.frame.find(name) {
                let value = self.frame.value(place).clone();
                return self.referenced(value);
            }
            if self.items.constant(None, name).is_none() && self.items.function(None, name).is_none() {
                let text = self.unseen(name, messages::outside_name(name, &self.frame.names()));
                return self.refuse(&path.path, text);
            }
        }
        if let [before @ .., module, name] = segments.as_slice()
            && module == "consts"
            && before.last().is_none_or(|number| number == "f32" || number == "f64")
            && let Some(value) = constants::mathematical(name)
        {
            return Value::Scalar(self.algebra.number(value));
        }
        if let Some((ty, name)) = paths::type_and_name(path) {
            let (ty, name) = (ty.map(|ty| self.resolved(&ty)), name.to_string());
            let beside = ty.is_some() || segments.len() == 1 || segments[0] == "self";
            if beside && let Some(function) = self.items.function(ty.as_deref(), &name) {
                return Value::Function(function.clone());
            }
            if beside && let Some(expression) = self.items.constant(ty.as_deref(), &name) {
                return self.constant(&name, ty, expression);
            }
            if let Some(ty) = ty
                && let Some(value) = constants::associated(self.algebra, &ty, &name)
            {
                return value;
            }
        }
        self.refuse(&path.path, messages::outside_constant(&paths::path_text(path)))
    }

    /// The value of a constant of the module. One that is made of itself is the compiler's to refuse.
    fn constant(&mut self, name: &str, of: Option<String>, expression: &Expr) -> Value {
        if self.constants.iter().any(|known| known == name) {
            return Value::Unknown;
        }
        self.constants.push(name.to_owned());
        let mut frame = Frame::new(Vec::new());
        frame.self_type = of;
        let outer = core::mem::replace(&mut self.frame, frame);
        let value = self.expression(expression);
        self.frame = outer;
        self.constants.pop();
        value
    }

    /// The name of a type, of which this is another in the module.
    fn resolved(&self, name: &str) -> String {
        match &self.frame.self_type {
            Some(known) if name == "Self" => known.clone(),
            _ => self.items.resolved(name),
        }
    }

    fn unary(&mut self, unary: &syn::ExprUnary) -> Value {
        let operand = self.expression(&unary.expr);
        if operand.is_unknown() {
            return operand;
        }
        if let (UnOp::Neg(_), Value::Struct(of)) = (&unary.op, &operand)
            && let Some(function) = self.items.function(Some(&of.name), "neg").cloned()
        {
            return self.inline(&unary.op, &function, vec![operand]);
        }
        let value = match (&unary.op, &operand) {
            (UnOp::Deref(_), _) => Some(operand.clone()),
            (UnOp::Not(_), Value::Truth(condition)) => Some(Value::Truth(condition.clone().not())),
            (UnOp::Neg(_), _) => operators::negate(self.algebra, &operand),
            _ => None,
        };
        value.unwrap_or_else(|| self.refuse(&unary.op, messages::no_unary(&operand.describe())))
    }

    fn binary(&mut self, binary: &syn::ExprBinary) -> Value {
        let assigned = operators::assigned(&binary.op);
        if matches!(binary.op, syn::BinOp::And(_) | syn::BinOp::Or(_)) && has_effect(binary.right.to_token_stream()) {
            return self.refuse(&binary.right, messages::effect_of_condition());
        }
        let (left, right) = (self.expression(&binary.left), self.expression(&binary.right));
        if left.is_unknown() || right.is_unknown() {
            return Value::Unknown;
        }
        let operator = assigned.as_ref().unwrap_or(&binary.op);
        if let (Value::Struct(of), Some(name)) = (&left, operators::method(&binary.op))
            && let Some(function) = self.items.function(Some(&of.name), name).cloned()
        {
            let left = if assigned.is_some() { self.reference(&binary.left) } else { left };
            return self.inline(&binary.op, &function, vec![left, right]);
        }
        let value = match operators::binary(self.algebra, operator, &left, &right) {
            Some(value) => value,
            None => {
                let text = messages::no_operation(operator, &left.describe(), &right.describe());
                self.refuse(&binary.op, text)
            }
        };
        if assigned.is_some() { self.assign(&binary.left, value) } else { value }
    }

    /// `value as type`
    fn cast(&mut self, cast: &syn::ExprCast) -> Value {
        let value = self.expression(&cast.expr);
        let ty = cast.ty.to_token_stream().to_string();
        let is_integer = |ty: &str| {
            ["usize", "isize"].contains(&ty) || (ty.starts_with(['u', 'i']) && ty[1..].parse::<u8>().is_ok())
        };
        match (&value, ty.as_str(), self.algebra.known_integer(&value)) {
            (Value::Unknown | Value::Never, ..) => value,
            (Value::Integer(x), "f32" | "f64", _) => Value::Scalar(*x),
            (Value::Scalar(_), number, _) if self.precision.is_some_and(|known| known.name() == number) => value,
            (Value::Integer(_), ty, Some(whole)) if is_integer(ty) => self.algebra.integer(wrapped(whole, ty)),
            (Value::Truth(condition), ty, _) if is_integer(ty) => {
                let (one, zero) = (self.algebra.number(1.0), self.algebra.number(0.0));
                Value::Integer(condition.select(self.algebra, one, zero))
            }
            (Value::Scalar(_), ty, _) if is_integer(ty) => {
                self.unsupported(&cast.as_token, "a number that is cut off", "take the whole number as an argument")
            }
            _ => self.unsupported(
                &cast.as_token,
                "a cast",
                "a function computes in one number type: write the number or take an argument of that type",
            ),
        }
    }

    fn unsupported_expression(&mut self, expression: &Expr) -> Value {
        match expression {
            Expr::Let(e) => self.unsupported(&e.let_token, "`if let`", CHOICE),
            Expr::Try(e) => self.unsupported(&e.question_token, "`?`", "every step must have a value"),
            Expr::Unsafe(e) => self.unsupported(&e.unsafe_token, "`unsafe`", "there is nothing to be unsafe about"),
            other => self.unsupported(other, "this expression", "use `let`, arithmetic, calls, `if` and `for`"),
        }
    }
}

/// True if an expression assigns to anything, or lends it to be changed.
fn has_effect(tokens: TokenStream) -> bool {
    let (mut before, mut assigns) = (' ', false);
    for token in tokens {
        let mut now = ' ';
        match &token {
            TokenTree::Group(group) if has_effect(group.stream()) => return true,
            TokenTree::Ident(word) if before == '&' && word == "mut" => return true,
            TokenTree::Punct(punct) => now = punct.as_char(),
            _ => {}
        }
        // `=` alone, not the end or the beginning of a comparison or an arrow.
        if assigns && !['=', '>'].contains(&now) {
            return true;
        }
        assigns = now == '=' && !['=', '<', '>', '!', '.'].contains(&before);
        before = now;
    }
    false
}

/// A whole number in an integer type; it wraps round.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "as `as` does")]
fn wrapped(whole: i64, ty: &str) -> i64 {
    match ty {
        "u8" => (whole as u8).into(),
        "u16" => (whole as u16).into(),
        "u32" => (whole as u32).into(),
        "i8" => (whole as i8).into(),
        "i16" => (whole as i16).into(),
        "i32" => (whole as i32).into(),
        // Of what is wider i64 has no more.
        _ => whole,
    }
}

/// An expression without its parentheses and invisible groups.
fn strip(expression: &Expr) -> &Expr {
    match expression {
        Expr::Group(group) => strip(&group.expr),
        Expr::Paren(paren) => strip(&paren.expr),
        other => other,
    }
}

/// The longest array.
const LONGEST_ARRAY: usize = 4096;

const CHOICE: &str = "write it with `if` and `else`";
