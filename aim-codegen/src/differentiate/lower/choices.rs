//! `if` and `match`: both branches are run, and what differs where they meet is selected.

use aim_symbolic::Scalar;
use quote::ToTokens;
use syn::{Arm, Expr, ExprIf, ExprMatch, Pat, RangeLimits};

use super::condition::Condition;
use super::value::Value;
use super::{CHOICE, Translation, operators};
use crate::differentiate::messages;

impl Translation<'_> {
    pub(super) fn choice(&mut self, choice: &ExprIf) -> Value {
        if let Expr::Let(pattern) = &*choice.cond {
            return self.unsupported(&pattern.let_token, "`if let`", CHOICE);
        }
        let condition = self.condition(&choice.cond);
        let otherwise = choice.else_branch.as_ref().map(|(_, otherwise)| &**otherwise);
        self.branch(
            &choice.if_token,
            condition,
            |this| this.block(&choice.then_branch),
            |this| otherwise.map_or(Value::nothing(), |otherwise| this.expression(otherwise)),
        )
    }

    /// A condition; `None` after an error.
    fn condition(&mut self, expression: &Expr) -> Option<Condition> {
        match self.expression(expression) {
            Value::Truth(condition) => Some(condition),
            other => {
                self.refuse_known(&other, expression, messages::not_a_condition(&other.describe()));
                None
            }
        }
    }

    /// Runs two branches and joins what they make of the variables. Where it is known which one is taken, the other is not
    /// run: it may index what does not exist.
    fn branch(
        &mut self,
        place: &impl ToTokens,
        condition: Option<Condition>,
        then: impl FnOnce(&mut Self) -> Value,
        otherwise: impl FnOnce(&mut Self) -> Value,
    ) -> Value {
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
            (true, false) => self.frame.take(otherwise_assigned),
            (false, true) => self.frame.take(then_assigned),
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

    pub(super) fn match_arms(&mut self, choice: &ExprMatch) -> Value {
        let value = self.expression(&choice.expr);
        if value.is_unknown() {
            return value;
        }
        self.arms(choice, &value, &choice.arms)
    }

    fn arms(&mut self, choice: &ExprMatch, value: &Value, arms: &[Arm]) -> Value {
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
            |this| this.expression(&arm.body),
            |this| {
                this.frame.hide(depth);
                this.arms(choice, value, rest)
            },
        );
        self.frame.leave(depth);
        found
    }

    /// Whether a value matches a pattern, whose names it is given; `None` after an error.
    fn pattern(&mut self, pattern: &Pat, value: &Value) -> Option<Condition> {
        match pattern {
            Pat::Paren(paren) => self.pattern(&paren.pat, value),
            Pat::Reference(reference) => self.pattern(&reference.pat, value),
            Pat::Guard(guard) => {
                let matched = self.pattern(&guard.pat, value);
                let guard = self.condition(&guard.guard);
                matched.zip(guard).map(|(matched, guard)| matched.and(guard))
            }
            Pat::Lit(literal) => self.equal_to(&Expr::Lit(literal.clone()), value),
            Pat::Ident(name)
                if name.subpat.is_none() && self.items.constant(None, &name.ident.to_string()).is_some() =>
            {
                let path = &name.ident;
                self.equal_to(&syn::parse_quote!(#path), value)
            }
            Pat::Path(path) => self.equal_to(&Expr::Path(path.clone()), value),
            Pat::Or(or) => or.cases.iter().try_fold(Condition::Known(false), |matched, case| {
                let next = self.pattern(case, value)?;
                Some(matched.or(next))
            }),
            Pat::Range(range) => {
                let x = number(value);
                let low = match &range.start {
                    Some(start) => {
                        let start = number(&self.expression(start))?;
                        Condition::at_most(self.algebra, start, x?)
                    }
                    None => Condition::Known(true),
                };
                let high = match &range.end {
                    Some(end) => {
                        let end = number(&self.expression(end))?;
                        match range.limits {
                            RangeLimits::Closed(_) => Condition::at_most(self.algebra, x?, end),
                            RangeLimits::HalfOpen(_) => Condition::less(self.algebra, x?, end),
                        }
                    }
                    None => Condition::Known(true),
                };
                Some(low.and(high))
            }
            Pat::Tuple(tuple) => match value {
                Value::Tuple(values) if values.len() == tuple.elems.len() => {
                    tuple.elems.iter().zip(values).try_fold(Condition::Known(true), |matched, (part, value)| {
                        let next = self.pattern(part, value)?;
                        Some(matched.and(next))
                    })
                }
                other => {
                    self.refuse(tuple, messages::pattern_of(&other.describe()));
                    None
                }
            },
            Pat::Wild(_) | Pat::Ident(_) => {
                self.bind(pattern, value.clone());
                Some(Condition::Known(true))
            }
            other => {
                self.refuse(other, messages::match_pattern());
                None
            }
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

fn number(value: &Value) -> Option<Scalar> {
    match value {
        Value::Scalar(x) | Value::Integer(x) => Some(*x),
        _ => None,
    }
}
