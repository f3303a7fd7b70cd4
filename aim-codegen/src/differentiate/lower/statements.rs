//! Statements, which are run one after another over the variables of the [`Frame`](super::frame::Frame).

use std::rc::Rc;

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::token::Comma;
use syn::{Block, Expr, Item, Label, Lifetime, Pat, Stmt};

use super::condition::Condition;
use super::expected::Expected;
use super::frame::Target;
use super::value::{Place, Value};
use super::{Translation, functions, numbers};
use crate::differentiate::messages;
use crate::differentiate::names::{self, Meaning, is_of_std};

impl Translation<'_> {
    /// Evaluates a block.
    pub(super) fn block(&mut self, block: &Block) -> Value {
        self.block_as(block, &Expected::Any)
    }

    /// Evaluates a block whose expected type is known.
    pub(super) fn block_as(&mut self, block: &Block, expected: &Expected) -> Value {
        let (depth, scope) = (self.frame.depth(), self.frame.scope.clone());
        self.declare_items(block, depth);
        let mut value = Value::nothing();
        let mut faulty = false;
        for (place, statement) in block.stmts.iter().enumerate() {
            value = match statement {
                // A variable that is the value of the block has the block's expected type.
                Stmt::Local(local) if is_end(&local.pat, &block.stmts[place + 1..]) => self.local(local, expected),
                statement => self.statement(statement, expected),
            };
            faulty |= matches!(value, Value::Unknown);
            // The following statements are not reached.
            if value.is_never() {
                break;
            }
        }
        value = self.leave_scope(block, depth, value);
        self.frame.scope = scope;
        // A faulty statement may have been meant as the value.
        if faulty { Value::Unknown } else { value }
    }

    /// Declares the items of a block, which are visible in all of it.
    fn declare_items(&mut self, block: &Block, depth: usize) {
        self.import(block);
        for statement in &block.stmts {
            let (name, ty, value) = match statement {
                Stmt::Item(Item::Const(item)) => (&item.ident, &item.ty, &item.expr),
                Stmt::Item(Item::Static(item)) if is_unchanged(item) => (&item.ident, &item.ty, &item.expr),
                _ => continue,
            };
            let expected = self.expected(ty);
            let value = self.expression_as(value, &expected);
            self.frame.declare(name.to_string(), value);
            self.frame.make_constant();
        }
        for statement in &block.stmts {
            if let Stmt::Item(Item::Fn(item)) = statement {
                let function = functions::inner(item, &self.frame, depth);
                self.frame.declare(item.sig.ident.to_string(), Value::Function(function));
            }
        }
    }

    /// Records the imports of a block.
    fn import(&mut self, block: &Block) {
        let uses = block.stmts.iter().filter_map(|statement| match statement {
            Stmt::Item(Item::Use(item)) => Some(names::imports(&item.tree)),
            _ => None,
        });
        let (named, all): (Vec<_>, Vec<_>) = uses.flatten().partition(|(name, _)| name.is_some());
        if named.is_empty() && all.is_empty() {
            return;
        }
        let mut scope = (*self.frame.scope).clone();
        for (_, path) in all {
            let there: Vec<String> = match self.items.meaning(&scope, &path) {
                Meaning::Own(module) => self.items.names_in(&module).map(str::to_owned).collect(),
                Meaning::External(path) => {
                    scope.has_foreign_glob |= !is_of_std(&path) && !path.iter().any(|segment| segment == "glam");
                    numbers::names_at(&path).map(str::to_owned).collect()
                }
            };
            let of_name = |name: String| (name.clone(), [path.as_slice(), &[name]].concat());
            scope.imports.extend(there.into_iter().map(of_name));
        }
        // Named imports shadow glob imports.
        scope.imports.extend(named.into_iter().filter_map(|(name, path)| Some((name?, path))));
        self.frame.scope = Rc::new(scope);
    }

    fn statement(&mut self, statement: &Stmt, expected: &Expected) -> Value {
        match statement {
            Stmt::Local(local) => self.local(local, &Expected::Any),
            Stmt::Item(Item::Const(_) | Item::Use(_) | Item::Fn(_)) => Value::nothing(),
            Stmt::Item(Item::Static(item)) if is_unchanged(item) => Value::nothing(),
            Stmt::Item(item) => self.refuse(item, messages::inner_item()),
            Stmt::Macro(statement) => self.macro_call(&statement.mac),
            Stmt::Expr(expression, None) => self.moved_value(expression, expected),
            Stmt::Expr(expression, Some(semicolon)) => {
                let exits = self.frame.exit_count();
                let (value, assigns) = self.tracked(|this| this.expression(expression));
                let has_effect = assigns || self.frame.exit_count() > exits;
                match &value {
                    Value::Tuple(parts) if parts.is_empty() => value,
                    Value::Never => value,
                    _ if has_effect && !value.is_unknown() => Value::nothing(),
                    _ => self.refuse_known(&value, semicolon, messages::no_effect()),
                }
            }
        }
    }

    /// Runs `let`.
    fn local(&mut self, local: &syn::Local, otherwise: &Expected) -> Value {
        let expected = match &local.pat {
            Pat::Type(typed) => self.expected(&typed.ty),
            _ => otherwise.clone(),
        };
        // The compiler ensures that it is assigned before it is read.
        let value = local.init.as_ref().map_or(Value::Never, |init| self.moved_value(&init.expr, &expected));
        if let Some((token, otherwise)) = local.init.as_ref().and_then(|init| init.diverge.as_ref()) {
            return self.let_else(local, value, (token, otherwise));
        }
        let never = local.init.is_some() && value.is_never();
        self.bind(&local.pat, value);
        if never { Value::Never } else { Value::nothing() }
    }

    /// Evaluates a macro call. Only assertions and a few other macros of the standard library are known.
    pub(super) fn macro_call(&mut self, call: &syn::Macro) -> Value {
        let name = call.path.segments.last().map(|segment| segment.ident.to_string()).unwrap_or_default();
        match name.strip_prefix("debug_").unwrap_or(&name) {
            "assert" | "assert_eq" | "assert_ne" if self.has_effect(call) => {
                self.refuse(&call.path, messages::effect_of_assertion())
            }
            "assert" => {
                self.assume_asserted(call);
                Value::nothing()
            }
            "assert_eq" | "assert_ne" => Value::nothing(),
            "vec" => self.list(call),
            "matches" => self.matches_macro(call),
            // These diverge, so that the value is that of the other branch.
            "panic" | "unreachable" | "todo" | "unimplemented" => Value::Never,
            "print" | "println" | "eprint" | "eprintln" | "dbg" => self.refuse(&call.path, messages::printing(&name)),
            _ => self.refuse(&call.path, messages::macro_call()),
        }
    }

    /// Returns `value` in place of an error. The error's expression is evaluated only to reject changes of variables.
    pub(super) fn without_error_effect(&mut self, error: &Expr, value: Value) -> Value {
        let before = self.report_counts();
        let (_, has_effect) = self.tracked(|this| this.expression(error));
        self.forget_reports_since(before);
        if has_effect { self.refuse(error, messages::effect_of_error()) } else { value }
    }

    /// Assumes the condition of an assertion from here on, as far as it is supported.
    fn assume_asserted(&mut self, call: &syn::Macro) {
        let written = call.parse_body_with(Punctuated::<Expr, Comma>::parse_terminated).unwrap_or_default();
        let before = self.report_counts();
        if let Some(asserted) = written.first().and_then(|asserted| self.condition(asserted)) {
            self.frame.assume(asserted);
        }
        self.forget_reports_since(before);
    }

    /// Returns `true` if the arguments of a macro change a variable; unsupported parts are ignored.
    fn has_effect(&mut self, call: &syn::Macro) -> bool {
        let written = call.parse_body_with(Punctuated::<Expr, Comma>::parse_terminated).unwrap_or_default();
        let before = self.report_counts();
        self.frame.begin_branch(Condition::Known(true));
        written.iter().for_each(|part| _ = self.expression(part));
        let changed = self.frame.end_branch();
        self.forget_reports_since(before);
        !changed.is_empty()
    }

    /// Binds the names of a pattern to the parts of a value.
    pub(super) fn bind(&mut self, pattern: &Pat, value: Value) {
        let lender = match (pattern, &value) {
            (Pat::Slice(_), Value::Reference(place)) => Some(place.clone()),
            _ => None,
        };
        let value = match pattern {
            Pat::Tuple(_) | Pat::Slice(_) | Pat::Struct(_) | Pat::TupleStruct(_) => self.lent_parts(value),
            Pat::Reference(_) => self.referenced(value),
            _ => value,
        };
        let value = match pattern {
            // A vector that is converted with `into` or `from`.
            Pat::Tuple(_) => value.components(self.algebra).map_or(value, Value::Tuple),
            Pat::Slice(_) => value.components(self.algebra).map_or(value, Value::Array),
            _ => value,
        };
        match pattern {
            // The only variant of an enum.
            Pat::Struct(syn::PatStruct { path, .. }) | Pat::TupleStruct(syn::PatTupleStruct { path, .. })
                if !value.is_unknown() && self.variant(&names::segments(path)).is_some() =>
            {
                self.pattern(pattern, &value);
            }
            Pat::Ident(name) => {
                if let Some(by_ref) = &name.by_ref {
                    self.refuse(by_ref, messages::pattern());
                }
                if let Some((at, _)) = &name.subpat {
                    self.refuse(at, messages::pattern());
                }
                self.declare(name, value);
            }
            Pat::Type(typed) => self.bind(&typed.pat, value),
            Pat::Paren(paren) => self.bind(&paren.pat, value),
            Pat::Reference(reference) => self.bind(&reference.pat, value),
            Pat::Wild(_) => {}
            Pat::Tuple(tuple) => {
                let is_tuple = matches!(value, Value::Tuple(_));
                self.bind_parts(tuple, &tuple.elems, value, (is_tuple, None));
            }
            Pat::Slice(slice) => {
                let is_array = matches!(value, Value::Array(_));
                self.bind_parts(slice, &slice.elems, value, (is_array, lender));
            }
            Pat::Struct(of) => {
                for field in &of.fields {
                    let part = self.moved_part(&value, &field.member);
                    self.bind(&field.pat, part);
                }
            }
            Pat::TupleStruct(of) => {
                for (pattern, part) in self.parts_of(of, &value) {
                    self.bind(pattern, part);
                }
            }
            other => _ = self.refuse(other, messages::pattern()),
        }
    }

    fn declare(&mut self, name: &syn::PatIdent, value: Value) {
        self.frame.declare(name.ident.to_string(), value);
        if name.mutability.is_some() {
            self.frame.allow_changes();
        }
    }

    /// Binds the names of patterns to the parts of a value. `..` stands for the remaining parts, by reference if
    /// `lender` is given.
    fn bind_parts(
        &mut self,
        whole: &impl ToTokens,
        patterns: &Punctuated<Pat, Comma>,
        value: Value,
        (fits, lender): (bool, Option<Rc<Place>>),
    ) {
        let first_left = patterns.iter().position(is_rest);
        let count = patterns.len() - usize::from(first_left.is_some());
        let values = match value {
            Value::Tuple(values) | Value::Array(values)
                if fits && (values.len() == count || first_left.is_some() && values.len() > count) =>
            {
                values
            }
            other => {
                vec![self.refuse_known(&other, whole, messages::pattern_of(&other.describe())); count]
            }
        };
        let left = values.len() - count;
        let mut values = values.into_iter();
        for pattern in patterns {
            let value = if is_rest(pattern) {
                let rest = Value::Array(values.by_ref().take(left).collect());
                lender.as_ref().zip(first_left).map_or(rest, |(lender, first)| lender.lent_part(first, left))
            } else {
                values.next().unwrap_or(Value::Unknown)
            };
            match pattern {
                Pat::Rest(_) => {}
                Pat::Ident(name) if is_rest(pattern) => self.declare(name, value),
                pattern => self.bind(pattern, value),
            }
        }
    }

    /// Runs a block that a `break` with its label leaves.
    pub(super) fn labelled_block(&mut self, label: &Label, block: &Block, expected: &Expected) -> Value {
        let whole = self.frame.begin_block(label.name.ident.to_string());
        let value = self.block_as(block, expected);
        let is_unknown = matches!(value, Value::Unknown);
        if !value.is_unknown() {
            self.frame.exit(whole, value);
        }
        let is_left = self.frame.has_exits(whole);
        match self.frame.end_region(self.algebra, false) {
            _ if is_unknown => Value::Unknown,
            None => self.refuse(label, messages::variable_of_two_kinds()),
            Some(_) if !is_left => Value::Never,
            Some(break_value) => break_value,
        }
    }

    /// Runs `return`, `break` or `continue`.
    pub(super) fn jump(&mut self, expression: &Expr) -> Value {
        let (target, value) = match expression {
            Expr::Return(e) => {
                let expected = self.frame.result_type.clone();
                let value = e.expr.as_ref().map_or(Value::nothing(), |value| self.moved_value(value, &expected));
                (Some(Target::Function), value)
            }
            Expr::Break(e) => {
                let value = e.expr.as_ref().map_or(Value::nothing(), |value| self.moved_value(value, &Expected::Any));
                (self.loop_of(e.label.as_ref()).map(Target::Loop), value)
            }
            Expr::Continue(e) => (self.loop_of(e.label.as_ref()).map(Target::Iteration), Value::nothing()),
            _ => (None, Value::Unknown),
        };
        match target {
            Some(_) if matches!(value, Value::Unknown) => value,
            Some(target) => {
                self.frame.exit(target, value);
                Value::Never
            }
            // The compiler reports a missing loop.
            None => Value::Unknown,
        }
    }

    fn loop_of(&self, label: Option<&Lifetime>) -> Option<usize> {
        self.frame.find_loop(label.map(|label| label.ident.to_string()).as_deref())
    }
}

/// Returns `true` if a pattern is the name that the block ends with, not shadowed in between.
fn is_end(pattern: &Pat, rest: &[Stmt]) -> bool {
    let Pat::Ident(name) = pattern else { return false };
    let is_it = |pattern: &Pat| match pattern {
        Pat::Type(typed) => matches!(&*typed.pat, Pat::Ident(other) if other.ident == name.ident),
        pattern => matches!(pattern, Pat::Ident(other) if other.ident == name.ident),
    };
    match rest {
        [between @ .., Stmt::Expr(Expr::Path(path), None)] => {
            path.path.is_ident(&name.ident)
                && !between.iter().any(|other| matches!(other, Stmt::Local(other) if is_it(&other.pat)))
        }
        _ => false,
    }
}

/// Returns `true` if a `static` is immutable.
fn is_unchanged(item: &syn::ItemStatic) -> bool {
    matches!(item.mutability, syn::StaticMutability::None)
}

/// Returns `true` if a pattern is `..` or `name @ ..`.
pub(super) fn is_rest(pattern: &Pat) -> bool {
    match pattern {
        Pat::Rest(_) => true,
        Pat::Ident(name) => name.subpat.as_ref().is_some_and(|(_, inner)| matches!(**inner, Pat::Rest(_))),
        _ => false,
    }
}
