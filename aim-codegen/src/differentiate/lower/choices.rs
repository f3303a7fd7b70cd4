//! `if` and `match`: both branches are run, and what differs where they meet is selected.

use aim_symbolic::Scalar;
use quote::ToTokens;
use syn::{Arm, BinOp, Expr, ExprIf, ExprMatch, ExprMethodCall, Local, Member, Pat, RangeLimits};

use super::condition::Condition;
use super::expected::Expected;
use super::statements::is_rest;
use super::value::Value;
use super::{Translation, extents, operators, strip};
use crate::differentiate::messages;
use crate::differentiate::names::{Meaning, segments};

impl Translation<'_> {
    pub(super) fn choice(&mut self, choice: &ExprIf, expected: &Expected) -> Value {
        let depth = self.frame.depth();
        let condition = self.condition(&choice.cond);
        let otherwise = choice.else_branch.as_ref().map(|(_, otherwise)| &**otherwise);
        let value = self.branch(
            &choice.if_token,
            condition,
            |this| this.block_as(&choice.then_branch, expected),
            |this| {
                this.frame.hide(depth);
                otherwise.map_or(Value::nothing(), |otherwise| this.expression_as(otherwise, expected))
            },
        );
        self.frame.leave(depth);
        value
    }

    /// `let pattern = value else { otherwise };`
    pub(super) fn let_else(
        &mut self,
        local: &Local,
        value: Value,
        (token, otherwise): (&impl ToTokens, &Expr),
    ) -> Value {
        if value.is_unknown() {
            self.bind(&local.pat, Value::Unknown);
            return value;
        }
        let depth = self.frame.depth();
        let pattern = match &local.pat {
            Pat::Type(typed) => &typed.pat,
            pattern => pattern,
        };
        let condition = self.pattern(pattern, &value);
        if condition.is_none() {
            return Value::Unknown;
        }
        self.branch(
            token,
            condition,
            |_| Value::nothing(),
            |this| {
                let names = this.frame.hide(depth);
                let value = this.expression(otherwise);
                this.frame.show(depth, names);
                value
            },
        )
    }

    /// A condition, with the names that its patterns bind; `None` after an error.
    pub(super) fn condition(&mut self, expression: &Expr) -> Option<Condition> {
        match expression {
            Expr::Paren(paren) => self.condition(&paren.expr),
            Expr::Let(e) => {
                let value = self.moved(&e.expr, &Expected::Any);
                self.pattern(&e.pat, &value)
            }
            Expr::Binary(both) if matches!(both.op, BinOp::And(_)) && has_let(expression) => {
                // Where a pattern does not fit, its names have no values.
                match self.condition(&both.left)? {
                    Condition::Known(false) => Some(Condition::Known(false)),
                    left => {
                        let right = self.under(&both.op, &left, |this| this.condition(&both.right));
                        right.map(|right| left.and(right))
                    }
                }
            }
            _ => match self.expression(expression) {
                Value::Truth(condition) => Some(condition),
                other => {
                    self.refuse_known(&other, expression, messages::not_a_condition(&other.describe()));
                    None
                }
            },
        }
    }

    /// Does something, and tells whether it assigns to variables.
    pub(super) fn tracked<T>(&mut self, act: impl FnOnce(&mut Self) -> T) -> (T, bool) {
        self.frame.begin_branch(Condition::Known(true));
        let made = act(self);
        let assigned = self.frame.end_branch();
        let assigns = !assigned.is_empty();
        self.frame.take(assigned);
        (made, assigns)
    }

    /// Does something only where a condition holds: what that makes of variables counts there alone.
    pub(super) fn under<T>(
        &mut self,
        place: &impl ToTokens,
        condition: &Condition,
        act: impl FnOnce(&mut Self) -> T,
    ) -> T {
        if matches!(condition, Condition::Known(true)) {
            return act(self);
        }
        self.frame.begin_branch(condition.clone());
        let made = act(self);
        let assigned = self.frame.end_branch();
        if self.frame.merge(self.algebra, condition, &assigned, &Vec::new()).is_err() {
            self.refuse(place, messages::variable_of_two_kinds());
        }
        made
    }

    /// Runs two branches and joins what they make of the variables. Where it is known which one is taken, the other is not
    /// run: it may index what does not exist.
    pub(super) fn branch(
        &mut self,
        place: &impl ToTokens,
        condition: Option<Condition>,
        then: impl FnOnce(&mut Self) -> Value,
        otherwise: impl FnOnce(&mut Self) -> Value,
    ) -> Value {
        let condition = condition.map(|condition| extents::decided(self.algebra, condition, self.frame.facts()));
        let (known, condition) = match condition {
            Some(Condition::Known(true)) => return then(self),
            Some(Condition::Known(false)) => return otherwise(self),
            Some(condition) => (true, condition),
            // Run for what else is wrong.
            None => (false, Condition::Known(true)),
        };
        self.frame.begin_branch(condition.clone());
        let then = then(self);
        let then_assigned = self.frame.end_branch();
        self.frame.begin_branch(condition.clone().not());
        let otherwise = otherwise(self);
        let otherwise_assigned = self.frame.end_branch();
        match (then.is_never(), otherwise.is_never()) {
            _ if !known => return Value::Unknown,
            (true, true) => return Value::Never,
            (true, false) => {
                self.frame.take(otherwise_assigned);
                self.frame.assume(condition.clone().not());
            }
            (false, true) => {
                self.frame.take(then_assigned);
                self.frame.assume(condition.clone());
            }
            (false, false) => {
                if self.frame.merge(self.algebra, &condition, &then_assigned, &otherwise_assigned).is_err() {
                    return self.refuse(place, messages::variable_of_two_kinds());
                }
            }
        }
        then.select(self.algebra, &condition, &otherwise).unwrap_or_else(|| {
            let text = messages::branches_differ(&then.describe(), &otherwise.describe());
            self.refuse(place, text)
        })
    }

    pub(super) fn match_arms(&mut self, choice: &ExprMatch, expected: &Expected) -> Value {
        let value = self.moved(&choice.expr, &Expected::Any);
        if value.is_unknown() {
            return value;
        }
        self.arms((choice, expected), &value, &choice.arms)
    }

    fn arms(&mut self, (choice, expected): (&ExprMatch, &Expected), value: &Value, arms: &[Arm]) -> Value {
        let Some((arm, rest)) = arms.split_first() else { return Value::Never };
        let depth = self.frame.depth();
        let mut condition = self.pattern(&arm.pat, value);
        // The last arm is taken where no other is.
        if rest.is_empty() && condition.is_some() {
            condition = Some(Condition::Known(true));
        }
        let found = self.branch(
            &choice.match_token,
            condition,
            |this| this.moved(&arm.body, expected),
            |this| {
                this.frame.hide(depth);
                this.arms((choice, expected), value, rest)
            },
        );
        self.left(&choice.match_token, depth, found)
    }

    /// Whether a value matches a pattern, whose names it is given; `None` after an error.
    pub(super) fn pattern(&mut self, pattern: &Pat, value: &Value) -> Option<Condition> {
        if value.is_unknown() {
            // Its names are known, and nothing more is said about them.
            let errors = self.report.count();
            self.bind(pattern, Value::Unknown);
            self.report.forget(errors);
            return None;
        }
        if let Value::Reference(place) = value {
            match pattern {
                Pat::Paren(_) | Pat::Reference(_) | Pat::Guard(_) | Pat::Or(_) | Pat::Wild(_) => {}
                Pat::Ident(name) if self.is_variable(name) => {}
                Pat::Slice(slice) if slice.elems.iter().any(is_rest) => {
                    let is_long = !matches!(self.read(place), Value::Array(all) if all.len() + 1 < slice.elems.len());
                    if is_long {
                        self.bind(pattern, value.clone());
                    }
                    return Some(Condition::Known(is_long));
                }
                // It is taken apart, or compared by what it refers to.
                _ => {
                    let parts = self.lent_parts(value.clone());
                    let parts = self.referenced(parts);
                    return self.pattern(pattern, &parts);
                }
            }
        }
        if let Some((ty, tag)) = path_of(pattern).and_then(|path| self.variant(&path)) {
            return self.matches_variant(pattern, (&ty, tag), value);
        }
        match pattern {
            Pat::Paren(paren) => self.pattern(&paren.pat, value),
            Pat::Reference(reference) => {
                let value = self.referenced(value.clone());
                self.pattern(&reference.pat, &value)
            }
            Pat::Guard(guard) => {
                let matched = self.pattern(&guard.pat, value)?;
                self.guarded(matched, Some(&guard.guard))
            }
            Pat::Lit(literal) => self.equal_to(&Expr::Lit(literal.clone()), value),
            Pat::Ident(name) if name.ident == "None" && matches!(value, Value::Optional(_)) => match value {
                Value::Optional(optional) => Some(optional.is_some.clone().not()),
                _ => None,
            },
            Pat::Ident(name) if name.subpat.is_none() && self.is_constant(&name.ident) => {
                let path = &name.ident;
                self.equal_to(&syn::parse_quote!(#path), value)
            }
            Pat::Path(path) => self.equal_to(&Expr::Path(path.clone()), value),
            Pat::Or(or) => self.any_of(or, value),
            Pat::Range(range) => {
                let ends = [&range.start, &range.end].map(Option::as_deref);
                self.is_between(number(value), ends, &range.limits)
            }
            Pat::Tuple(tuple) => match value {
                Value::Tuple(values) if values.len() == tuple.elems.len() => {
                    self.patterns(tuple.elems.iter().zip(values))
                }
                other => {
                    self.refuse(tuple, messages::pattern_of(&other.describe()));
                    None
                }
            },
            Pat::Slice(slice) if !slice.elems.iter().any(is_rest) => match value {
                Value::Array(values) if values.len() == slice.elems.len() => {
                    self.patterns(slice.elems.iter().zip(values))
                }
                Value::Array(_) => Some(Condition::Known(false)),
                other => {
                    self.refuse(slice, messages::pattern_of(&other.describe()));
                    None
                }
            },
            Pat::TupleStruct(of) => match (value, of.path.segments.last()) {
                (Value::Optional(optional), Some(last)) if last.ident == "Err" => {
                    if !of.elems.iter().all(|element| matches!(element, Pat::Wild(_) | Pat::Rest(_))) {
                        self.refuse(of, messages::error_value());
                        return None;
                    }
                    Some(optional.is_some.clone().not())
                }
                (Value::Optional(optional), Some(last)) if last.ident == "Some" || last.ident == "Ok" => {
                    match &optional.is_some {
                        Condition::Known(false) => Some(Condition::Known(false)),
                        is_some => {
                            let inner = of.elems.first().map(|inner| self.pattern(inner, &optional.value));
                            inner.flatten().map(|inner| is_some.clone().and(inner))
                        }
                    }
                }
                _ => {
                    let parts = of.elems.iter().enumerate().map(|(index, _)| Member::from(index));
                    let parts: Vec<Value> = parts.map(|member| self.moved_part(value, &member)).collect();
                    self.patterns(of.elems.iter().zip(&parts))
                }
            },
            Pat::Struct(of) => {
                let parts: Vec<Value> = of.fields.iter().map(|field| self.moved_part(value, &field.member)).collect();
                self.patterns(of.fields.iter().map(|field| &*field.pat).zip(&parts))
            }
            // There are fewer than the pattern names.
            Pat::Slice(slice) if matches!(value, Value::Array(values) if values.len() + 1 < slice.elems.len()) => {
                Some(Condition::Known(false))
            }
            Pat::Wild(_) | Pat::Ident(_) | Pat::Slice(_) => {
                self.bind(pattern, value.clone());
                Some(Condition::Known(true))
            }
            other => {
                self.refuse(other, messages::match_pattern());
                None
            }
        }
    }

    /// The condition that a pattern matches and its guard holds; `None` after an error.
    pub(super) fn guarded(&mut self, matched: Condition, guard: Option<&Expr>) -> Option<Condition> {
        match (matched, guard) {
            (matched @ Condition::Known(false), _) | (matched, None) => Some(matched),
            (matched, Some(guard)) => {
                let guard = self.under(guard, &matched, |this| this.condition(guard))?;
                Some(matched.and(guard))
            }
        }
    }

    /// The condition that a value matches one of several patterns. What they bind has the values of the first that matches.
    fn any_of(&mut self, or: &syn::PatOr, value: &Value) -> Option<Condition> {
        let depth = self.frame.depth();
        let mut cases = Vec::new();
        for case in &or.cases {
            let matched = self.pattern(case, value)?;
            // What cannot match binds nothing.
            if !matches!(matched, Condition::Known(false)) {
                cases.push((matched, self.frame.variables()[depth..].to_vec()));
            }
            self.frame.leave(depth);
        }
        let Some((_, names)) = cases.last().cloned() else { return Some(Condition::Known(false)) };
        for (name, value) in names {
            let chosen = cases.iter().rev().skip(1).try_fold(value, |otherwise, (matched, bound)| {
                let (_, value) = bound.iter().find(|(known, _)| *known == name)?;
                value.select(self.algebra, matched, &otherwise)
            });
            let chosen = chosen.unwrap_or_else(|| self.refuse(or, messages::match_pattern()));
            self.frame.declare(name, chosen);
        }
        Some(cases.into_iter().fold(Condition::Known(false), |any, (matched, _)| any.or(matched)))
    }

    /// `(low..high).contains(&x)`; `None` for any other call.
    pub(super) fn contained(&mut self, call: &ExprMethodCall) -> Option<Value> {
        let (Expr::Range(range), "contains", Some(x), 1) =
            (strip(&call.receiver), call.method.to_string().as_str(), call.args.first(), call.args.len())
        else {
            return None;
        };
        let x = self.expression(x);
        let x = number(&self.referenced(x));
        let ends = [&range.start, &range.end].map(Option::as_deref);
        Some(self.is_between(x, ends, &range.limits).map_or(Value::Unknown, Value::Truth))
    }

    /// The condition that a number is in a range.
    fn is_between(
        &mut self,
        x: Option<Scalar>,
        [start, end]: [Option<&Expr>; 2],
        limits: &RangeLimits,
    ) -> Option<Condition> {
        let low = match start {
            Some(start) => {
                let start = number(&self.expression(start))?;
                Condition::at_most(self.algebra, start, x?)
            }
            None => Condition::Known(true),
        };
        let high = match end {
            Some(end) => {
                let end = number(&self.expression(end))?;
                match limits {
                    RangeLimits::Closed(_) => Condition::at_most(self.algebra, x?, end),
                    RangeLimits::HalfOpen(_) => Condition::less(self.algebra, x?, end),
                }
            }
            None => Condition::Known(true),
        };
        Some(low.and(high))
    }

    /// Whether each of several values matches its pattern.
    pub(super) fn patterns<'p>(&mut self, mut parts: impl Iterator<Item = (&'p Pat, &'p Value)>) -> Option<Condition> {
        parts.try_fold(Condition::Known(true), |matched, (pattern, value)| {
            let next = self.pattern(pattern, value)?;
            Some(matched.and(next))
        })
    }

    /// True of a pattern that is the name of a variable which it makes.
    fn is_variable(&self, name: &syn::PatIdent) -> bool {
        let is_variant = || self.variant(&[name.ident.to_string()]).is_some();
        name.subpat.is_none() && name.ident != "None" && !self.is_constant(&name.ident) && !is_variant()
    }

    /// Whether a name of a pattern is that of a constant, of the module or of a block.
    fn is_constant(&self, name: &syn::Ident) -> bool {
        if name.to_string().starts_with(char::is_uppercase) && self.frame.find(&name.to_string()).is_some() {
            return true;
        }
        match self.items.meaning(&self.frame.scope, &[name.to_string()]) {
            Meaning::Own(name) => self.items.constant(None, &name).is_some(),
            Meaning::Outside(_) => false,
        }
    }

    fn equal_to(&mut self, expected: &Expr, value: &Value) -> Option<Condition> {
        let expected_value = self.expression(expected);
        if expected_value.is_unknown() {
            return None;
        }
        match operators::binary(self.algebra, &syn::parse_quote!(==), value, &expected_value) {
            Some(Value::Truth(condition)) => Some(condition),
            _ => {
                self.refuse(expected, messages::pattern_of(&value.describe()));
                None
            }
        }
    }
}

/// The path of a pattern that may be a variant's.
fn path_of(pattern: &Pat) -> Option<Vec<String>> {
    match pattern {
        Pat::Ident(name) if name.by_ref.is_none() && name.subpat.is_none() => Some(vec![name.ident.to_string()]),
        Pat::Path(path) => Some(segments(&path.path)),
        Pat::TupleStruct(of) => Some(segments(&of.path)),
        Pat::Struct(of) => Some(segments(&of.path)),
        _ => None,
    }
}

/// Whether a pattern stands in a condition.
fn has_let(condition: &Expr) -> bool {
    match condition {
        Expr::Let(_) => true,
        Expr::Binary(both) => has_let(&both.left) || has_let(&both.right),
        _ => false,
    }
}

fn number(value: &Value) -> Option<Scalar> {
    match value {
        Value::Scalar(x) | Value::Integer(x) => Some(*x),
        _ => None,
    }
}
