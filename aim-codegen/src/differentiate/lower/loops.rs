//! Loops that are unrolled iteration by iteration, as long as that ends; all others are [kept](super::kept).

use std::rc::Rc;

use quote::ToTokens;
use syn::{Expr, ExprForLoop, ExprLoop, ExprWhile, Lifetime, Pat};

use super::condition::Condition;
use super::expected::Expected;
use super::frame::Target;
use super::translation::{MOST_OPEN_ROUNDS, MOST_ROUNDS};
use super::value::{Element, Rounds, Value};
use super::{Translation, strip};
use crate::differentiate::messages;

/// Maximum number of nodes in a function's graph. Code derived from more takes minutes to compile.
const MOST_NODES: usize = 20_000;

/// An iteration of a loop.
enum Round {
    /// No further iteration.
    Over,
    /// Value of the iteration.
    Of(Value),
}

impl Translation<'_> {
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
        let (kept, exits) = (self.range_to_keep(e, &items), self.frame.exits());
        // A counter that the body ignores counts attempts.
        let is_counter = kept.is_some() && matches!(*e.pat, Pat::Wild(_));
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
        match kept {
            Some(rounds) => {
                let kept = |this: &mut Self| this.kept_for(e, &rounds);
                self.written_or_kept(core::ptr::from_ref(e).cast(), &written, &kept)
            }
            None => written(self),
        }
    }

    /// Returns the iterations of a loop over a range that may be kept, if all of its numbers are certainly present.
    fn range_to_keep(&mut self, e: &ExprForLoop, items: &[Element]) -> Option<Rounds> {
        let is_there = |item: &Element| matches!(item.is_there, Condition::Known(true));
        let is_range = matches!(strip(&e.expr), Expr::Range(_)) && items.iter().all(is_there);
        let first = items.first().filter(|_| is_range && self.most_open < MOST_OPEN_ROUNDS)?;
        let Value::Integer(first) = first.value else { return None };
        let count = self.algebra.count(items.len());
        Some(Rounds::numbers(self.algebra, first, count))
    }

    /// Runs an iteration with each element that is present.
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

    pub(super) fn while_loop(&mut self, e: &ExprWhile) -> Value {
        let written = |this: &mut Self| this.written_while(e);
        self.written_or_kept(core::ptr::from_ref(e).cast(), &written, &|this| this.kept_while(e))
    }

    pub(super) fn endless_loop(&mut self, e: &ExprLoop) -> Value {
        let written = |this: &mut Self| this.written_loop(e);
        self.written_or_kept(core::ptr::from_ref(e).cast(), &written, &|this| this.kept_endless(e))
    }

    /// Unrolls a loop; keeps it if unrolling does not end. A loop of many iterations that may end early is kept if
    /// possible.
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
        // If an iteration is faulty in itself, the error has already been reported.
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
            // No known condition ends the loop.
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
            // No known condition ends the loop.
            if open_rounds > this.most_open {
                this.is_endless = true;
                return Round::Of(this.refuse(&e.loop_token, messages::rounds_unknown()));
            }
            Round::Of(this.block(&e.body))
        })
    }

    /// Runs the iterations of a loop.
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
            // Report the errors of one iteration only.
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

    /// Returns `true` if the graph exceeds its maximum size.
    pub(super) fn is_too_large(&self) -> bool {
        self.algebra.g.len() - self.given_up > MOST_NODES
    }

    /// Reports that the graph exceeds its maximum size. The error is dropped if the loop can be kept.
    pub(super) fn refuse_too_large(&mut self, place: &impl ToTokens) -> Value {
        self.is_endless = true;
        self.refuse(place, messages::too_large(MOST_NODES, MOST_ROUNDS))
    }
}
