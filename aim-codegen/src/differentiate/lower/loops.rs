//! Loops that are unrolled iteration by iteration, as long as that ends; all others are [kept](super::kept_loops).

use std::rc::Rc;

use quote::ToTokens;
use syn::{Expr, ExprForLoop, ExprLoop, ExprWhile, Lifetime, Pat};

use super::condition::Condition;
use super::expected::Expected;
use super::frame::Target;
use super::translation::{MAX_ITERATIONS, MAX_OPEN_ITERATIONS};
use super::value::{Element, LoopSequence, Value};
use super::{Translation, strip};
use crate::differentiate::messages;

/// Maximum number of nodes in a function's graph. Code derived from more takes minutes to compile.
const MOST_NODES: usize = 20_000;

/// An iteration of a loop.
enum Iteration {
    /// No further iteration: the loop ends.
    Finished,
    /// Value of the iteration.
    Ran(Value),
}

impl Translation<'_> {
    pub(super) fn for_loop(&mut self, e: &ExprForLoop) -> Value {
        let over = self.moved_value(&e.expr, &Expected::Any);
        if over.is_unknown() {
            return over;
        }
        let kind = over.describe();
        let over = match over {
            Value::Slice(slice) => Value::LoopSequence(Rc::new(LoopSequence::over(slice))),
            over => self.own_iterator(&e.expr, over),
        };
        if over.is_unknown() {
            return over;
        }
        if let Value::LoopSequence(sequence) = &over {
            return self.run_kept_for(e, sequence);
        }
        let items = match over {
            Value::Reference(place) => self.references(&place).and_then(Value::items),
            over => over.items(),
        };
        let Some(items) = items else {
            return self.refuse(&e.expr, messages::not_iterable(&kind));
        };
        let label = e.label.as_ref().map(|label| &label.name);
        let (keepable, exits) = (self.keepable_range(e, &items), self.frame.exit_count());
        // A counter that the body ignores counts attempts.
        let is_counter = keepable.is_some() && matches!(*e.pat, Pat::Wild(_));
        let unroll = |this: &mut Self| {
            let mut attempts = 0;
            this.each(&e.for_token, label, items.clone(), |this, item| {
                attempts += 1;
                if is_counter && attempts > this.max_open_iterations && this.frame.exit_count() > exits {
                    this.is_endless = true;
                    return this.refuse(&e.expr, messages::unknown_iteration_count());
                }
                this.bind(&e.pat, item);
                this.block(&e.body)
            })
        };
        match keepable {
            Some(sequence) => {
                let keep = |this: &mut Self| this.run_kept_for(e, &sequence);
                self.unroll_or_keep(core::ptr::from_ref(e).cast(), &unroll, &keep)
            }
            None => unroll(self),
        }
    }

    /// Returns the iterations of a loop over a range that may be kept, if all of its numbers are certainly present.
    fn keepable_range(&mut self, e: &ExprForLoop, items: &[Element]) -> Option<LoopSequence> {
        let is_there = |item: &Element| matches!(item.is_there, Condition::Known(true));
        let is_range = matches!(strip(&e.expr), Expr::Range(_)) && items.iter().all(is_there);
        let first = items.first().filter(|_| is_range && self.max_open_iterations < MAX_OPEN_ITERATIONS)?;
        let Value::Integer(first) = first.value else { return None };
        let count = self.algebra.count(items.len());
        Some(LoopSequence::numbers(self.algebra, first, count))
    }

    /// Runs an iteration with each element that is present.
    pub(super) fn each(
        &mut self,
        token: &impl ToTokens,
        label: Option<&Lifetime>,
        items: Vec<Element>,
        mut iteration: impl FnMut(&mut Self, Value) -> Value,
    ) -> Value {
        let mut items = items.into_iter();
        self.run_iterations(token, label, |this| match items.next() {
            Some(Element { is_there, value }) => {
                Iteration::Ran(this.branch(token, Some(is_there), |this| iteration(this, value), |_| Value::nothing()))
            }
            None => Iteration::Finished,
        })
    }

    pub(super) fn while_loop(&mut self, e: &ExprWhile) -> Value {
        let unroll = |this: &mut Self| this.unroll_while(e);
        self.unroll_or_keep(core::ptr::from_ref(e).cast(), &unroll, &|this| this.run_kept_while(e))
    }

    pub(super) fn endless_loop(&mut self, e: &ExprLoop) -> Value {
        let unroll = |this: &mut Self| this.unroll_loop(e);
        self.unroll_or_keep(core::ptr::from_ref(e).cast(), &unroll, &|this| this.run_kept_endless(e))
    }

    /// Unrolls a loop; keeps it if unrolling does not end. A loop of many iterations that may end early is kept if
    /// possible.
    fn unroll_or_keep(
        &mut self,
        place: *const (),
        unroll: &dyn Fn(&mut Self) -> Value,
        keep: &dyn Fn(&mut Self) -> Value,
    ) -> Value {
        if self.endless.contains(&place) {
            return keep(self);
        }
        let (frame, before, progress) = (self.frame.clone(), self.report_counts(), self.progress());
        (self.is_endless, self.is_open) = (false, false);
        let value = unroll(self);
        let (is_endless, is_open) = (core::mem::take(&mut self.is_endless), self.is_open);
        let fails = is_open && self.report.count() > before.errors;
        if !is_endless && !fails {
            return value;
        }
        let may_unroll = is_endless && self.max_open_iterations < MAX_OPEN_ITERATIONS;
        self.frame = frame.clone();
        let forgotten = self.report.forget(before.errors);
        self.forget_reports_since(before);
        self.roll_back(progress);
        if !may_unroll {
            self.endless.push(place);
        }
        let value = keep(self);
        if self.report.count() > before.errors && may_unroll {
            self.frame = frame;
            self.forget_reports_since(before);
            self.roll_back(progress);
            let many = core::mem::replace(&mut self.max_open_iterations, MAX_OPEN_ITERATIONS);
            let value = self.unroll_or_keep(place, unroll, keep);
            self.max_open_iterations = many;
            return value;
        }
        // If an iteration is faulty in itself, the error has already been reported.
        if !is_endless && self.report.count() > before.errors {
            self.report.forget(before.errors);
            self.report.restore(forgotten);
        }
        value
    }

    fn unroll_while(&mut self, e: &ExprWhile) -> Value {
        let label = e.label.as_ref().map(|label| &label.name);
        let loop_end = Target::Loop(self.frame.loop_depth());
        let mut open_iterations = 0;
        self.run_iterations(&e.while_token, label, |this| match this.condition(&e.cond) {
            Some(Condition::Known(false)) => Iteration::Finished,
            Some(Condition::Known(true)) => Iteration::Ran(this.block(&e.body)),
            // No known condition ends the loop.
            Some(_) if open_iterations == this.max_open_iterations || this.is_too_large() => {
                this.is_endless = true;
                Iteration::Ran(this.refuse(&e.cond, messages::unknown_iteration_count()))
            }
            Some(condition) => {
                (open_iterations, this.is_open) = (open_iterations + 1, true);
                let end = |this: &mut Self| {
                    this.frame.exit(loop_end, Value::nothing());
                    Value::Never
                };
                this.branch(&e.while_token, Some(condition), |_| Value::nothing(), end);
                Iteration::Ran(this.block(&e.body))
            }
            None => Iteration::Ran(Value::Unknown),
        })
    }

    fn unroll_loop(&mut self, e: &ExprLoop) -> Value {
        let label = e.label.as_ref().map(|label| &label.name);
        let loop_end = Target::Loop(self.frame.loop_depth());
        let mut open_iterations = 0;
        self.run_iterations(&e.loop_token, label, |this| {
            if this.frame.has_exits(loop_end) {
                (open_iterations, this.is_open) = (open_iterations + 1, true);
            }
            // No known condition ends the loop.
            if open_iterations > this.max_open_iterations {
                this.is_endless = true;
                return Iteration::Ran(this.refuse(&e.loop_token, messages::unknown_iteration_count()));
            }
            Iteration::Ran(this.block(&e.body))
        })
    }

    /// Runs the iterations of a loop.
    fn run_iterations(
        &mut self,
        token: &impl ToTokens,
        label: Option<&Lifetime>,
        mut iteration: impl FnMut(&mut Self) -> Iteration,
    ) -> Value {
        let loops = self.frame.loop_depth();
        let (loop_end, iteration_end) = (Target::Loop(loops), Target::Iteration(loops));
        self.frame.begin_region(loop_end, label.map(|label| label.ident.to_string()));
        let (mut ends, mut value, errors) = (true, Value::nothing(), self.report.count());
        loop {
            let depth = self.frame.depth();
            self.frame.begin_region(iteration_end, None);
            let done = iteration(self);
            self.frame.end_scope(depth);
            let (never, unknown) = match &done {
                Iteration::Finished => (false, false),
                Iteration::Ran(value) => (value.is_never(), matches!(value, Value::Unknown)),
            };
            let continues = !never || self.frame.has_exits(iteration_end);
            if self.frame.end_region(self.algebra, !never).is_none() {
                value = self.refuse(token, messages::variable_of_two_kinds());
            }
            if matches!(done, Iteration::Finished) {
                break;
            }
            // Report the errors of one iteration only.
            if unknown || self.report.count() > errors {
                value = Value::Unknown;
                break;
            }
            if !continues || self.frame.certainly_exits(loop_end) {
                ends = false;
                break;
            }
            self.iterations_run += 1;
            if self.iterations_run > MAX_ITERATIONS || self.is_too_large() {
                value = self.refuse_too_large(token);
                break;
            }
        }
        let left = self.frame.has_exits(loop_end);
        match self.frame.end_region(self.algebra, ends) {
            _ if value.is_unknown() => value,
            None => self.refuse(token, messages::variable_of_two_kinds()),
            Some(_) if !ends && !left => Value::Never,
            Some(break_value) => break_value,
        }
    }

    /// Returns `true` if the graph exceeds its maximum size.
    pub(super) fn is_too_large(&self) -> bool {
        self.algebra.g.len() - self.abandoned_nodes > MOST_NODES
    }

    /// Reports that the graph exceeds its maximum size. The error is dropped if the loop can be kept.
    pub(super) fn refuse_too_large(&mut self, place: &impl ToTokens) -> Value {
        self.is_endless = true;
        self.refuse(place, messages::too_large(MOST_NODES, MAX_ITERATIONS))
    }
}
