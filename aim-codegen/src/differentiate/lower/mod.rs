//! The function's body → the value of its result, built in the graph. Everything that cannot be told is an error at
//! its place; what depends on it is then unknown, and nothing more is said about it.

mod algebra;
mod calls;
mod condition;
mod constants;
mod map;
mod methods;
mod operators;
mod paths;
mod value;

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::token::Comma;
use syn::{Block, Expr, Member, Pat, Stmt, UnOp};

pub(super) use self::algebra::Algebra;
use self::condition::Condition;
pub(super) use self::map::{Affine, Map, Quaternion};
pub(super) use self::value::Value;
use super::messages;
use crate::declare::report::Report;
use crate::declare::report::text::Text;

/// The translation of one body.
pub(super) struct Translation<'a> {
    pub(super) algebra: &'a mut Algebra,
    pub(super) report: &'a mut Report,
    /// The names in scope, the innermost last.
    names: Vec<(String, Value)>,
}

impl<'a> Translation<'a> {
    /// A body that knows these names.
    pub(super) fn new(algebra: &'a mut Algebra, report: &'a mut Report, names: Vec<(String, Value)>) -> Self {
        Self { algebra, report, names }
    }

    /// The value of a block.
    pub(super) fn block(&mut self, block: &Block) -> Value {
        let outside = self.names.len();
        let mut value = Value::Tuple(Vec::new());
        let mut faulty = false;
        for statement in &block.stmts {
            value = self.statement(statement);
            faulty |= value.is_unknown();
        }
        self.names.truncate(outside);
        // What comes of a faulty statement may have been meant to be the value.
        if faulty { Value::Unknown } else { value }
    }

    fn statement(&mut self, statement: &Stmt) -> Value {
        match statement {
            Stmt::Local(local) => {
                let value = match &local.init {
                    Some(init) => {
                        if let Some((otherwise, _)) = &init.diverge {
                            self.unsupported(otherwise, "`let … else`", CHOICE);
                        }
                        self.expression(&init.expr)
                    }
                    None => self.refuse(&local.pat, messages::let_without_value()),
                };
                self.bind(&local.pat, value);
            }
            Stmt::Item(syn::Item::Const(item)) => {
                let value = self.expression(&item.expr);
                self.names.push((item.ident.to_string(), value));
            }
            Stmt::Item(syn::Item::Use(_)) => {}
            Stmt::Item(item) => _ = self.refuse(item, messages::inner_item()),
            Stmt::Macro(statement) => _ = self.refuse(&statement.mac.path, messages::macro_call()),
            Stmt::Expr(expression, None) => return self.expression(expression),
            Stmt::Expr(expression, Some(semicolon)) => {
                let value = self.expression(expression);
                return self.refuse_known(&value, semicolon, messages::no_effect());
            }
        }
        Value::Tuple(Vec::new())
    }

    /// Gives the names of a pattern their values.
    fn bind(&mut self, pattern: &Pat, value: Value) {
        match pattern {
            Pat::Ident(name) => {
                let value = match &name.mutability {
                    // What is assigned to it later is no mistake of its own.
                    Some(mutability) => self.refuse(mutability, messages::mutable()),
                    None => value,
                };
                if let Some(by_ref) = &name.by_ref {
                    self.refuse(by_ref, messages::pattern());
                }
                if let Some((at, _)) = &name.subpat {
                    self.refuse(at, messages::pattern());
                }
                self.names.push((name.ident.to_string(), value));
            }
            Pat::Type(typed) => self.bind(&typed.pat, value),
            Pat::Paren(paren) => self.bind(&paren.pat, value),
            Pat::Reference(reference) => self.bind(&reference.pat, value),
            Pat::Wild(_) => {}
            Pat::Tuple(tuple) => {
                let is_tuple = matches!(value, Value::Tuple(_));
                self.bind_parts(tuple, &tuple.elems, value, is_tuple);
            }
            Pat::Slice(slice) => {
                let is_array = matches!(value, Value::Array(_));
                self.bind_parts(slice, &slice.elems, value, is_array);
            }
            other => _ = self.refuse(other, messages::pattern()),
        }
    }

    /// Gives the names of the patterns the values of the parts.
    fn bind_parts(&mut self, whole: &impl ToTokens, patterns: &Punctuated<Pat, Comma>, value: Value, fits: bool) {
        let values = match value {
            Value::Tuple(values) | Value::Array(values) if fits && values.len() == patterns.len() => values,
            other => {
                vec![self.refuse_known(&other, whole, messages::pattern_of(&other.describe())); patterns.len()]
            }
        };
        for (pattern, value) in patterns.iter().zip(values) {
            self.bind(pattern, value);
        }
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
                if let Some(mutability) = &reference.mutability {
                    return self.refuse(mutability, messages::mutable());
                }
                self.expression(&reference.expr)
            }
            Expr::MethodCall(call) => self.method_call(call),
            Expr::Call(call) => self.call(call),
            Expr::Field(field) => self.field(field),
            Expr::Index(index) => self.index(index),
            Expr::If(choice) => self.choice(choice),
            Expr::Block(block) => match &block.label {
                Some(label) => self.unsupported(label, "a labelled block", "write it as a block without a label"),
                None => self.block(&block.block),
            },
            Expr::Tuple(tuple) => Value::Tuple(tuple.elems.iter().map(|element| self.expression(element)).collect()),
            Expr::Array(array) => Value::Array(array.elems.iter().map(|element| self.expression(element)).collect()),
            Expr::Repeat(repeat) => {
                let value = self.expression(&repeat.expr);
                match (whole_number(&repeat.len), strip(&repeat.len)) {
                    (Some(length @ 0..=256), _) => Value::Array(vec![value; length]),
                    (_, length @ Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(_), .. })) => {
                        self.unsupported(length, "so long an array", "arrays hold up to 256 numbers")
                    }
                    (_, other) => self.unsupported(other, "a length that is no number", "write the number"),
                }
            }
            other => self.unsupported_expression(other),
        }
    }

    fn literal(&mut self, literal: &syn::Lit) -> Value {
        let number = match literal {
            syn::Lit::Float(number) => number.base10_parse::<f64>().ok(),
            syn::Lit::Int(number) => number.base10_parse::<f64>().ok(),
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
        if let (None, Some(name)) = (&path.qself, path.path.get_ident()) {
            let name_text = name.to_string();
            let known: Vec<&str> = self.names.iter().map(|(known, _)| known.as_str()).collect();
            return match self.named(&name_text) {
                Some(value) => value.clone(),
                None => self.refuse(name, messages::outside_name(&name_text, &known)),
            };
        }
        let segments: Vec<String> = path.path.segments.iter().map(|segment| segment.ident.to_string()).collect();
        if let [.., module, name] = segments.as_slice()
            && module == "consts"
            && let Some(value) = constants::mathematical(name)
        {
            return Value::Scalar(self.algebra.number(value));
        }
        if let Some((Some(ty), name)) = paths::type_and_name(path)
            && let Some(value) = constants::associated(self.algebra, &ty, &name.to_string())
        {
            return value;
        }
        self.refuse(&path.path, messages::outside_constant(&paths::path_text(path)))
    }

    /// The value of a name in scope.
    fn named(&self, name: &str) -> Option<&Value> {
        self.names.iter().rev().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    fn unary(&mut self, unary: &syn::ExprUnary) -> Value {
        let operand = self.expression(&unary.expr);
        if operand.is_unknown() {
            return operand;
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
        let (left, right) = (self.expression(&binary.left), self.expression(&binary.right));
        if is_assignment(&binary.op) {
            // Of a name that is unknown because it is `mut`, that was said.
            return self.refuse_known(&left, &binary.op, messages::assignment());
        }
        if left.is_unknown() || right.is_unknown() {
            return Value::Unknown;
        }
        operators::binary(self.algebra, &binary.op, &left, &right).unwrap_or_else(|| {
            let text = messages::no_operation(&binary.op, &left.describe(), &right.describe());
            self.refuse(&binary.op, text)
        })
    }

    fn choice(&mut self, choice: &syn::ExprIf) -> Value {
        let condition = self.expression(&choice.cond);
        let then = self.block(&choice.then_branch);
        let Some((_, otherwise)) = &choice.else_branch else {
            return self.refuse_known(&then, &choice.if_token, messages::if_without_else());
        };
        let otherwise = self.expression(otherwise);
        let Value::Truth(condition) = condition else {
            let text = messages::not_a_condition(&condition.describe());
            return self.refuse_known(&condition, &choice.cond, text);
        };
        then.select(self.algebra, &condition, &otherwise).unwrap_or_else(|| {
            let text = messages::branches_differ(&then.describe(), &otherwise.describe());
            self.refuse(&choice.if_token, text)
        })
    }

    fn field(&mut self, field: &syn::ExprField) -> Value {
        let base = self.expression(&field.base);
        if base.is_unknown() {
            return base;
        }
        let name = match &field.member {
            Member::Named(name) => name.to_string(),
            Member::Unnamed(index) => index.index.to_string(),
        };
        let a = &mut *self.algebra;
        let letter = |letters: &str| if name.len() == 1 { letters.find(&name) } else { None };
        let column = || ["x_axis", "y_axis", "z_axis"].iter().position(|known| *known == name);
        let value = match &base {
            Value::Planar(v) => letter("xy").map(|axis| Value::Scalar(a.component(*v, axis))),
            Value::Vector(v) => letter("xyz").map(|axis| Value::Scalar(a.component(*v, axis))),
            Value::Quaternion(q) => match (letter("xyzw"), q.parts) {
                (Some(3), Some((_, w))) => Some(Value::Scalar(w)),
                (Some(axis), Some((u, _))) => Some(Value::Scalar(a.component(u, axis))),
                (Some(_), None) => return self.refuse(&field.member, messages::quaternion_of_matrix()),
                (None, _) => None,
            },
            Value::Matrix(m) => column().map(|axis| Value::Vector(m.column(a, axis))),
            Value::Affine(m) => match name.as_str() {
                "matrix3" => Some(Value::Matrix(m.map.clone())),
                "translation" => Some(Value::Vector(m.translation)),
                _ => column().map(|axis| Value::Vector(m.map.column(a, axis))),
            },
            Value::Tuple(values) => name.parse::<usize>().ok().and_then(|index| values.get(index).cloned()),
            _ => None,
        };
        value.unwrap_or_else(|| self.refuse(&field.member, messages::unknown_field(&name, &base.describe())))
    }

    fn index(&mut self, index: &syn::ExprIndex) -> Value {
        let base = self.expression(&index.expr);
        let Some(place) = whole_number(&index.index) else {
            return self.refuse(&index.index, messages::index_not_literal());
        };
        let value = match &base {
            Value::Unknown => return base,
            Value::Array(values) => values.get(place).cloned(),
            Value::Planar(v) if place < 2 => Some(Value::Scalar(self.algebra.component(*v, place))),
            Value::Vector(v) if place < 3 => Some(Value::Scalar(self.algebra.component(*v, place))),
            _ => None,
        };
        value.unwrap_or_else(|| self.refuse(&index.index, messages::index_outside(&base.describe())))
    }

    /// Reports what has no value.
    pub(super) fn refuse(&mut self, place: &impl ToTokens, text: Text) -> Value {
        self.report.error_in(place, text);
        Value::Unknown
    }

    /// The same because of a value; of an unknown one all has been said.
    fn refuse_known(&mut self, value: &Value, place: &impl ToTokens, text: Text) -> Value {
        if value.is_unknown() { Value::Unknown } else { self.refuse(place, text) }
    }

    fn unsupported(&mut self, place: &impl ToTokens, what: &str, help: &str) -> Value {
        self.refuse(place, messages::unsupported(what, help))
    }

    fn unsupported_expression(&mut self, expression: &Expr) -> Value {
        const LOOP: &str = "write the terms one by one: what is derived has no loops";
        match expression {
            Expr::Assign(assign) => {
                let left = self.expression(&assign.left);
                self.refuse_known(&left, &assign.eq_token, messages::assignment())
            }
            Expr::ForLoop(e) => self.unsupported(&e.for_token, "a loop", LOOP),
            Expr::While(e) => self.unsupported(&e.while_token, "a loop", LOOP),
            Expr::Loop(e) => self.unsupported(&e.loop_token, "a loop", LOOP),
            Expr::Match(e) => self.unsupported(&e.match_token, "`match`", CHOICE),
            Expr::Let(e) => self.unsupported(&e.let_token, "`if let`", CHOICE),
            Expr::Return(e) => {
                self.unsupported(&e.return_token, "`return`", "make it the last expression, or a branch of an `if`")
            }
            Expr::Macro(e) => self.refuse(&e.mac.path, messages::macro_call()),
            Expr::Closure(e) => self.unsupported(&e.inputs_begin, "a closure", "bind what it gives with `let`"),
            Expr::Cast(e) => self.unsupported(
                &e.as_token,
                "a cast",
                "a function computes in one number type: write the number or take an argument of that type",
            ),
            Expr::Struct(e) => {
                self.unsupported(&e.path, "a struct in braces", "call `new`, as in `Vec3::new(x, y, z)`")
            }
            Expr::Try(e) => self.unsupported(&e.question_token, "`?`", "every step must have a value"),
            Expr::Unsafe(e) => self.unsupported(&e.unsafe_token, "`unsafe`", "there is nothing to be unsafe about"),
            other => self.unsupported(other, "this expression", "use `let`, arithmetic, calls and `if`"),
        }
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

/// A whole number as written.
fn whole_number(expression: &Expr) -> Option<usize> {
    match strip(expression) {
        Expr::Lit(syn::ExprLit { lit: syn::Lit::Int(number), .. }) => number.base10_parse().ok(),
        _ => None,
    }
}

/// `=` behind another operator; comparisons end in it, too.
fn is_assignment(operator: &syn::BinOp) -> bool {
    let text = operator.to_token_stream().to_string();
    text.ends_with('=') && !matches!(text.as_str(), "==" | "!=" | "<=" | ">=")
}

const CHOICE: &str = "write it with `if` and `else`";
