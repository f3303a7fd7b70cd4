//! `if` and `match`: runs both branches, and selects between values that differ.

use quote::ToTokens;
use syn::{Arm, BinOp, Expr, ExprIf, ExprMatch, Local, Pat};

use super::condition::Condition;
use super::expected::Expected;
use super::value::Value;
use super::{Translation, extents};
use crate::differentiate::messages;

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
                this.frame.hide_names(depth);
                otherwise.map_or(Value::nothing(), |otherwise| this.expression_as(otherwise, expected))
            },
        );
        self.frame.end_scope(depth);
        value
    }

    /// Runs `let pattern = value else { otherwise };`.
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
                let names = this.frame.hide_names(depth);
                let value = this.expression(otherwise);
                this.frame.restore_names(depth, names);
                value
            },
        )
    }

    /// Evaluates a condition and binds the names in its patterns; `None` after an error.
    pub(super) fn condition(&mut self, expression: &Expr) -> Option<Condition> {
        match expression {
            Expr::Paren(paren) => self.condition(&paren.expr),
            Expr::Let(e) => {
                let value = self.moved_value(&e.expr, &Expected::Any);
                self.pattern(&e.pat, &value)
            }
            Expr::Binary(both) if matches!(both.op, BinOp::And(_)) && has_let(expression) => {
                // If the pattern does not match, its names have no values.
                match self.condition(&both.left)? {
                    Condition::Known(false) => Some(Condition::Known(false)),
                    left => {
                        let right = self.run_under(&both.op, &left, |this| this.condition(&both.right));
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

    /// Runs `act`; also returns `true` if it assigned to variables.
    pub(super) fn tracked<T>(&mut self, act: impl FnOnce(&mut Self) -> T) -> (T, bool) {
        self.frame.begin_branch(Condition::Known(true));
        let made = act(self);
        let assigned = self.frame.end_branch();
        let assigns = !assigned.is_empty();
        self.frame.assign_all(assigned);
        (made, assigns)
    }

    /// Runs `act` under a condition: its assignments take effect only where the condition holds.
    pub(super) fn run_under<T>(
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

    /// Runs two branches and merges their assignments. If the condition is known, only the branch that is taken is run:
    /// the other may index out of bounds.
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
            // After an error, run both branches to find further errors.
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
                self.frame.assign_all(otherwise_assigned);
                self.frame.assume(condition.clone().not());
            }
            (false, true) => {
                self.frame.assign_all(then_assigned);
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
        let value = self.moved_value(&choice.expr, &Expected::Any);
        if value.is_unknown() {
            return value;
        }
        self.arms((choice, expected), &value, &choice.arms)
    }

    fn arms(&mut self, (choice, expected): (&ExprMatch, &Expected), value: &Value, arms: &[Arm]) -> Value {
        let Some((arm, rest)) = arms.split_first() else { return Value::Never };
        let depth = self.frame.depth();
        let mut condition = self.pattern(&arm.pat, value);
        // A `match` is exhaustive, so the last arm is taken unconditionally. If its pattern never matches, no branch
        // has constructed a value for it.
        if rest.is_empty() && condition.is_some() {
            if matches!(condition, Some(Condition::Known(false))) {
                return self.leave_scope(&choice.match_token, depth, Value::Never);
            }
            condition = Some(Condition::Known(true));
        }
        let found = self.branch(
            &choice.match_token,
            condition,
            |this| this.moved_value(&arm.body, expected),
            |this| {
                this.frame.hide_names(depth);
                this.arms((choice, expected), value, rest)
            },
        );
        self.leave_scope(&choice.match_token, depth, found)
    }
}

/// Returns `true` if a condition contains a `let`.
fn has_let(condition: &Expr) -> bool {
    match condition {
        Expr::Let(_) => true,
        Expr::Binary(both) => has_let(&both.left) || has_let(&both.right),
        _ => false,
    }
}
