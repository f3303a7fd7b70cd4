//! Loops that are written out round by round, as far as that comes to an end; the others are [kept](super::kept).

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

/// The most nodes of a function's graph. What is derived of more takes minutes to compile.
const MOST_NODES: usize = 20_000;

/// A round of a loop.
enum Round {
    /// There is none.
    Over,
    /// Its value.
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
        // Numbers that nobody asks for count how often something is tried.
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

    /// The rounds of a loop over a range that may stay a loop, where all of its numbers are known to be there.
    fn range_to_keep(&mut self, e: &ExprForLoop, items: &[Element]) -> Option<Rounds> {
        let is_there = |item: &Element| matches!(item.is_there, Condition::Known(true));
        let is_range = matches!(strip(&e.expr), Expr::Range(_)) && items.iter().all(is_there);
        let first = items.first().filter(|_| is_range && self.most_open < MOST_OPEN_ROUNDS)?;
        let Value::Integer(first) = first.value else { return None };
        let count = self.algebra.count(items.len());
        Some(Rounds::numbers(self.algebra, first, count))
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

    /// True once the graph has outgrown its bound.
    pub(super) fn is_too_large(&self) -> bool {
        self.algebra.g.len() - self.given_up > MOST_NODES
    }

    /// Reports that the graph has outgrown its bound, unless it is a loop that may stay one.
    pub(super) fn refuse_too_large(&mut self, place: &impl ToTokens) -> Value {
        self.is_endless = true;
        self.refuse(place, messages::too_large(MOST_NODES, MOST_ROUNDS))
    }
}
