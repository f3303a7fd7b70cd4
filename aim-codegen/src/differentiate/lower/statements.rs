//! Statements: they are run one after another, over the variables of the [`Frame`](super::frame::Frame). A loop is run
//! round by round.

use std::rc::Rc;

use quote::ToTokens;
use syn::punctuated::Punctuated;
use syn::token::Comma;
use syn::{Block, Expr, ExprForLoop, ExprLoop, ExprWhile, Item, Label, Lifetime, Pat, Stmt};

use super::condition::Condition;
use super::expected::Expected;
use super::frame::Target;
use super::translation::MOST_ROUNDS;
use super::value::{Element, Items, Place, Rounds, Value};
use super::{Translation, functions, numbers, strip};
use crate::differentiate::messages;
use crate::differentiate::names::{self, Meaning};

/// The most nodes of a function's graph. What is derived of more takes minutes to compile.
const MOST_NODES: usize = 20_000;

/// The most rounds that are written out of which it is not known whether they are run: of what can be no loop in the code, and of
/// what can, which is smaller then, and ends where it is left.
pub(super) const MOST_OPEN_ROUNDS: usize = 200;
pub(super) const MANY_OPEN_ROUNDS: usize = 16;

impl Translation<'_> {
    /// The value of a block.
    pub(super) fn block(&mut self, block: &Block) -> Value {
        self.block_as(block, &Expected::Any)
    }

    /// The value of a block, of whose place the type is known.
    pub(super) fn block_as(&mut self, block: &Block, expected: &Expected) -> Value {
        let (depth, scope) = (self.frame.depth(), self.frame.scope.clone());
        self.declare_items(block, depth);
        let mut value = Value::nothing();
        let mut faulty = false;
        for (place, statement) in block.stmts.iter().enumerate() {
            value = match statement {
                // What is the value at the end is of the type of that.
                Stmt::Local(local) if is_end(&local.pat, &block.stmts[place + 1..]) => self.local(local, expected),
                statement => self.statement(statement, expected),
            };
            faulty |= matches!(value, Value::Unknown);
            // What follows is not reached.
            if value.is_never() {
                break;
            }
        }
        value = self.left(block, depth, value);
        self.frame.scope = scope;
        // What comes of a faulty statement may have been meant to be the value.
        if faulty { Value::Unknown } else { value }
    }

    /// Items are known in all of a block.
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

    /// Notes what a block has from elsewhere.
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
                Meaning::Outside(path) => numbers::names_at(&path).map(str::to_owned).collect(),
            };
            let of_name = |name: String| (name.clone(), [path.as_slice(), &[name]].concat());
            scope.imports.extend(there.into_iter().map(of_name));
        }
        // Names that are written out hide those of whole modules.
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
            Stmt::Expr(expression, None) => self.moved(expression, expected),
            Stmt::Expr(expression, Some(semicolon)) => {
                let exits = self.frame.exits();
                let (value, assigns) = self.tracked(|this| this.expression(expression));
                let has_effect = assigns || self.frame.exits() > exits;
                match &value {
                    Value::Tuple(parts) if parts.is_empty() => value,
                    Value::Never => value,
                    _ if has_effect && !value.is_unknown() => Value::nothing(),
                    _ => self.refuse_known(&value, semicolon, messages::no_effect()),
                }
            }
        }
    }

    /// `let`
    fn local(&mut self, local: &syn::Local, otherwise: &Expected) -> Value {
        let expected = match &local.pat {
            Pat::Type(typed) => self.expected(&typed.ty),
            _ => otherwise.clone(),
        };
        // It is assigned before it is read, or the compiler says so.
        let value = local.init.as_ref().map_or(Value::Never, |init| self.moved(&init.expr, &expected));
        if let Some((token, otherwise)) = local.init.as_ref().and_then(|init| init.diverge.as_ref()) {
            return self.let_else(local, value, (token, otherwise));
        }
        let never = local.init.is_some() && value.is_never();
        self.bind(&local.pat, value);
        if never { Value::Never } else { Value::nothing() }
    }

    /// A macro's meaning cannot be seen, but that of assertions is known.
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
            // Nothing comes of these, so that the other branch is the value.
            "vec" => self.list(call),
            "matches" => self.matches_macro(call),
            "panic" | "unreachable" | "todo" | "unimplemented" => Value::Never,
            _ => self.refuse(&call.path, messages::macro_call()),
        }
    }

    /// The value of what makes an error, which nothing is known of, but that it must not change variables.
    pub(super) fn without_error_effect(&mut self, error: &Expr, value: Value) -> Value {
        let said = self.said();
        let (_, has_effect) = self.tracked(|this| this.expression(error));
        self.unsay(said);
        if has_effect { self.refuse(error, messages::effect_of_error()) } else { value }
    }

    /// What an assertion asserts holds from there on, as far as it is understood.
    fn assume_asserted(&mut self, call: &syn::Macro) {
        let written = call.parse_body_with(Punctuated::<Expr, Comma>::parse_terminated).unwrap_or_default();
        let said = self.said();
        if let Some(asserted) = written.first().and_then(|asserted| self.condition(asserted)) {
            self.frame.assume(asserted);
        }
        self.unsay(said);
    }

    /// Whether what a macro is given changes a variable. What of it is not understood does not matter.
    fn has_effect(&mut self, call: &syn::Macro) -> bool {
        let written = call.parse_body_with(Punctuated::<Expr, Comma>::parse_terminated).unwrap_or_default();
        let said = self.said();
        self.frame.begin_branch(Condition::Known(true));
        written.iter().for_each(|part| _ = self.expression(part));
        let changed = self.frame.end_branch();
        self.unsay(said);
        !changed.is_empty()
    }

    /// Gives the names of a pattern their values.
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
            // What is written with `into` or `from`.
            Pat::Tuple(_) => value.components(self.algebra).map_or(value, Value::Tuple),
            Pat::Slice(_) => value.components(self.algebra).map_or(value, Value::Array),
            _ => value,
        };
        match pattern {
            // The only variant of an enum.
            Pat::Struct(syn::PatStruct { path, .. }) | Pat::TupleStruct(syn::PatTupleStruct { path, .. })
                if self.variant(&names::segments(path)).is_some() =>
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

    /// Gives the names of the patterns the values of the parts; `..` stands for those that are left, of what is lent for that part.
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

    pub(super) fn for_loop(&mut self, e: &ExprForLoop) -> Value {
        let over = self.moved(&e.expr, &Expected::Any);
        if over.is_unknown() {
            return over;
        }
        let kind = over.describe();
        let over = match over {
            Value::Slice(slice) => Value::Rounds(Rc::new(Rounds::over(slice))),
            over => over,
        };
        if let Value::Rounds(rounds) = &over {
            return self.kept_for(e, rounds);
        }
        let items = match over {
            Value::Reference(place) => self.references(&place).and_then(Value::items),
            over => over.items(),
        };
        let Some(items) = items else {
            return self.refuse(&e.expr, messages::not_iterable(&kind));
        };
        let label = e.label.as_ref().map(|label| &label.name);
        let count = self.algebra.count(items.len());
        let exits = self.frame.exits();
        // Numbers that nobody asks for.
        let is_counter = matches!((&*e.pat, strip(&e.expr)), (Pat::Wild(_), Expr::Range(_)))
            && items.iter().all(|item| matches!(item.is_there, Condition::Known(true)));
        let written = |this: &mut Self| {
            let mut rounds = 0;
            this.each(&e.for_token, label, items.clone(), |this, item| {
                rounds += 1;
                if is_counter && rounds > this.most_open && this.frame.exits() > exits {
                    this.is_endless = true;
                    return this.refuse(&e.expr, messages::rounds_unknown());
                }
                this.bind(&e.pat, item);
                this.block(&e.body)
            })
        };
        let kept = |this: &mut Self| this.kept_for(e, &Rounds::of(count, Items::Numbers));
        if is_counter && self.most_open < MOST_OPEN_ROUNDS {
            self.written_or_kept(core::ptr::from_ref(e).cast(), &written, &kept)
        } else {
            written(self)
        }
    }

    /// Runs a round with each of the elements that are there.
    pub(super) fn each(
        &mut self,
        token: &impl ToTokens,
        label: Option<&Lifetime>,
        items: Vec<Element>,
        mut round: impl FnMut(&mut Self, Value) -> Value,
    ) -> Value {
        let mut items = items.into_iter();
        self.rounds(token, label, |this| match items.next() {
            Some(Element { is_there, value }) => {
                Round::Of(this.branch(token, Some(is_there), |this| round(this, value), |_| Value::nothing()))
            }
            None => Round::Over,
        })
    }

    /// A block that `break` with its label leaves.
    pub(super) fn labelled_block(&mut self, label: &Label, block: &Block, expected: &Expected) -> Value {
        let whole = self.frame.begin_block(label.name.ident.to_string());
        let value = self.block_as(block, expected);
        let is_unknown = matches!(value, Value::Unknown);
        if !value.is_unknown() {
            self.frame.exit(whole, value);
        }
        let is_left = self.frame.has_exits(whole);
        match self.frame.end(self.algebra, false) {
            _ if is_unknown => Value::Unknown,
            None => self.refuse(label, messages::variable_of_two_kinds()),
            Some(_) if !is_left => Value::Never,
            Some(brought) => brought,
        }
    }

    pub(super) fn while_loop(&mut self, e: &ExprWhile) -> Value {
        let written = |this: &mut Self| this.written_while(e);
        self.written_or_kept(core::ptr::from_ref(e).cast(), &written, &|this| this.kept_while(e))
    }

    pub(super) fn endless_loop(&mut self, e: &ExprLoop) -> Value {
        let written = |this: &mut Self| this.written_loop(e);
        self.written_or_kept(core::ptr::from_ref(e).cast(), &written, &|this| this.kept_endless(e))
    }

    /// Writes a loop out, round by round; or, if no end of it comes in sight, keeps it. One of many rounds that may be left before its
    /// end is kept where it can be.
    fn written_or_kept(
        &mut self,
        place: *const (),
        written: &dyn Fn(&mut Self) -> Value,
        kept: &dyn Fn(&mut Self) -> Value,
    ) -> Value {
        if self.endless.contains(&place) {
            return kept(self);
        }
        let (frame, before, mark) = (self.frame.clone(), self.said(), self.mark());
        (self.is_endless, self.is_open) = (false, false);
        let value = written(self);
        let (is_endless, is_open) = (core::mem::take(&mut self.is_endless), self.is_open);
        let fails = is_open && self.report.count() > before.errors;
        if !is_endless && !fails {
            return value;
        }
        let may_be_written = is_endless && self.most_open < MOST_OPEN_ROUNDS;
        self.frame = frame.clone();
        let said = self.report.forget(before.errors);
        self.unsay(before);
        self.take_back(mark);
        if !may_be_written {
            self.endless.push(place);
        }
        let value = kept(self);
        if self.report.count() > before.errors && may_be_written {
            self.frame = frame;
            self.unsay(before);
            self.take_back(mark);
            let many = core::mem::replace(&mut self.most_open, MOST_OPEN_ROUNDS);
            let value = self.written_or_kept(place, written, kept);
            self.most_open = many;
            return value;
        }
        // Where a round is wrong by itself, that was said.
        if !is_endless && self.report.count() > before.errors {
            self.report.forget(before.errors);
            self.report.restore(said);
        }
        value
    }

    fn written_while(&mut self, e: &ExprWhile) -> Value {
        let label = e.label.as_ref().map(|label| &label.name);
        let whole = Target::Loop(self.frame.loops());
        let mut open_rounds = 0;
        self.rounds(&e.while_token, label, |this| match this.condition(&e.cond) {
            Some(Condition::Known(false)) => Round::Over,
            Some(Condition::Known(true)) => Round::Of(this.block(&e.body)),
            // As far as is known it goes on until something else ends it.
            Some(_) if open_rounds == this.most_open || this.is_too_large() => {
                this.is_endless = true;
                Round::Of(this.refuse(&e.cond, messages::rounds_unknown()))
            }
            Some(condition) => {
                (open_rounds, this.is_open) = (open_rounds + 1, true);
                let end = |this: &mut Self| {
                    this.frame.exit(whole, Value::nothing());
                    Value::Never
                };
                this.branch(&e.while_token, Some(condition), |_| Value::nothing(), end);
                Round::Of(this.block(&e.body))
            }
            None => Round::Of(Value::Unknown),
        })
    }

    fn written_loop(&mut self, e: &ExprLoop) -> Value {
        let label = e.label.as_ref().map(|label| &label.name);
        let whole = Target::Loop(self.frame.loops());
        let mut open_rounds = 0;
        self.rounds(&e.loop_token, label, |this| {
            if this.frame.has_exits(whole) {
                (open_rounds, this.is_open) = (open_rounds + 1, true);
            }
            // As far as is known it goes on.
            if open_rounds > this.most_open {
                this.is_endless = true;
                return Round::Of(this.refuse(&e.loop_token, messages::rounds_unknown()));
            }
            Round::Of(this.block(&e.body))
        })
    }

    /// Runs the rounds of a loop.
    fn rounds(
        &mut self,
        token: &impl ToTokens,
        label: Option<&Lifetime>,
        mut round: impl FnMut(&mut Self) -> Round,
    ) -> Value {
        let loops = self.frame.loops();
        let (whole, once) = (Target::Loop(loops), Target::Round(loops));
        self.frame.begin(whole, label.map(|label| label.ident.to_string()));
        let (mut ends, mut value, errors) = (true, Value::nothing(), self.report.count());
        loop {
            let depth = self.frame.depth();
            self.frame.begin(once, None);
            let done = round(self);
            self.frame.leave(depth);
            let (never, unknown) = match &done {
                Round::Over => (false, false),
                Round::Of(value) => (value.is_never(), matches!(value, Value::Unknown)),
            };
            let goes_on = !never || self.frame.has_exits(once);
            if self.frame.end(self.algebra, !never).is_none() {
                value = self.refuse(token, messages::variable_of_two_kinds());
            }
            if matches!(done, Round::Over) {
                break;
            }
            // One round says what is wrong.
            if unknown || self.report.count() > errors {
                value = Value::Unknown;
                break;
            }
            if !goes_on || self.frame.certainly_exits(whole) {
                ends = false;
                break;
            }
            self.rounds_run += 1;
            if self.rounds_run > MOST_ROUNDS || self.is_too_large() {
                value = self.refuse_too_large(token);
                break;
            }
        }
        let left = self.frame.has_exits(whole);
        match self.frame.end(self.algebra, ends) {
            _ if value.is_unknown() => value,
            None => self.refuse(token, messages::variable_of_two_kinds()),
            Some(_) if !ends && !left => Value::Never,
            Some(brought) => brought,
        }
    }

    /// Whether the graph has outgrown its bound.
    pub(super) fn is_too_large(&self) -> bool {
        self.algebra.g.len() - self.given_up > MOST_NODES
    }

    /// Reports that the graph has outgrown its bound, unless it is a loop that may stay one.
    pub(super) fn refuse_too_large(&mut self, place: &impl ToTokens) -> Value {
        self.is_endless = true;
        self.refuse(place, messages::too_large(MOST_NODES, MOST_ROUNDS))
    }

    /// `return`, `break` or `continue`.
    pub(super) fn jump(&mut self, expression: &Expr) -> Value {
        let (target, value) = match expression {
            Expr::Return(e) => {
                let expected = self.frame.result_type.clone();
                let value = e.expr.as_ref().map_or(Value::nothing(), |value| self.moved(value, &expected));
                (Some(Target::Function), value)
            }
            Expr::Break(e) => {
                let value = e.expr.as_ref().map_or(Value::nothing(), |value| self.moved(value, &Expected::Any));
                (self.loop_of(e.label.as_ref()).map(Target::Loop), value)
            }
            Expr::Continue(e) => (self.loop_of(e.label.as_ref()).map(Target::Round), Value::nothing()),
            _ => (None, Value::Unknown),
        };
        match target {
            Some(_) if matches!(value, Value::Unknown) => value,
            Some(target) => {
                self.frame.exit(target, value);
                Value::Never
            }
            // There is no such loop: the compiler says so.
            None => Value::Unknown,
        }
    }

    fn loop_of(&self, label: Option<&Lifetime>) -> Option<usize> {
        self.frame.find_loop(label.map(|label| label.ident.to_string()).as_deref())
    }
}

/// Whether a pattern is the name that a block ends with, which nothing hides until then.
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

/// Whether a `static` is a constant.
fn is_unchanged(item: &syn::ItemStatic) -> bool {
    matches!(item.mutability, syn::StaticMutability::None)
}

/// Whether a pattern is `..` or `name @ ..`.
pub(super) fn is_rest(pattern: &Pat) -> bool {
    match pattern {
        Pat::Rest(_) => true,
        Pat::Ident(name) => name.subpat.as_ref().is_some_and(|(_, inner)| matches!(**inner, Pat::Rest(_))),
        _ => false,
    }
}

/// A round of a loop.
enum Round {
    /// There is none.
    Over,
    /// Its value.
    Of(Value),
}
