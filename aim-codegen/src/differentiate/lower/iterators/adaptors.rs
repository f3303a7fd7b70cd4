//! Iterator adaptors: methods that make an iterator from another.

use std::rc::Rc;

use syn::{Expr, ExprMethodCall, ExprRange};

use super::super::condition::Condition;
use super::super::value::{Callable, Element, LoopSequence, Optional, Place, SequenceItems, Value};
use super::super::{Translation, methods, strip};
use super::{all_there, ranks};
use crate::differentiate::messages;

/// Result of a predicate for one element.
pub(super) struct PredicateCall {
    /// Condition under which the predicate is called.
    is_called: Condition,
    /// Result of the predicate where it is called.
    pub(super) holds: Condition,
}

/// Returns the condition under which later elements are visited after this result.
fn continues_after(is_there: &Condition, result: &Condition, until: Option<bool>) -> Condition {
    match until {
        None => Condition::Known(true),
        Some(true) => is_there.clone().and(result.clone()).not(),
        Some(false) => is_there.clone().not().or(result.clone()),
    }
}

impl Translation<'_> {
    /// Evaluates an adaptor of an iterator over these elements; `None` after an error.
    pub(super) fn adaptor_method(&mut self, items: Vec<Element>, call: &ExprMethodCall) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        Some(match (name.as_str(), arguments.as_slice()) {
            ("rev", []) => Value::Iterator(items.into_iter().rev().collect()),
            ("enumerate", []) => {
                let ranks = ranks(self.algebra, &items);
                let numbered = items.into_iter().zip(ranks).map(|(Element { is_there, value }, rank)| Element {
                    is_there,
                    value: Value::Tuple(vec![Value::Integer(rank), value]),
                });
                Value::Iterator(numbered.collect())
            }
            ("zip", [other]) => self.zipped(items, other)?,
            ("chain", [other]) => Value::Iterator(items.into_iter().chain(self.iterated(other)?).collect()),
            ("skip" | "take", [count]) => {
                let count = self.count(count)?;
                let ranks = ranks(self.algebra, &items);
                Value::iterator_of(items.into_iter().zip(ranks).map(|(Element { is_there, value }, rank)| {
                    let is_before = Condition::less(self.algebra, rank, count);
                    Element { is_there: is_there.and(if name == "take" { is_before } else { is_before.not() }), value }
                }))
            }
            ("step_by", [count]) => match self.known_count(count)? {
                0 => self.refuse(*count, messages::index_outside("a step size")),
                count => Value::iterator(self.whole(items, call)?.into_iter().step_by(count)),
            },
            ("cycle", []) => {
                let values = self.whole(items, call)?;
                let count = self.algebra.count(values.len());
                let sequence = LoopSequence::of(count, SequenceItems::Listed(Value::Array(values)));
                Value::LoopSequence(Rc::new(sequence.cycled(self.algebra)))
            }
            ("map", [function]) => Value::Iterator(self.mapped(call, function, items)?),
            ("inspect", [function]) => {
                self.mapped(call, function, items.clone())?;
                Value::Iterator(items)
            }
            ("flatten", []) => self.flattened(call, items)?,
            ("flat_map", [function]) => {
                let mapped = self.mapped(call, function, items)?;
                self.flattened(call, mapped)?
            }
            ("filter", [function]) => Value::iterator_of(self.filtered(call, function, &items)?),
            ("take_while" | "skip_while", [function]) => {
                let results = self.call_predicate(call, function, &items, Some(false))?;
                Value::iterator_of(items.into_iter().zip(results).map(|(item, PredicateCall { is_called, holds })| {
                    let is_before = is_called.and(holds);
                    item.and_where(if name == "take_while" { is_before } else { is_before.not() })
                }))
            }
            ("filter_map" | "map_while", [function]) => {
                let function = self.function_argument(function, 1)?;
                let make = |this: &mut Self, item| this.inline(&call.method, &function, vec![item]);
                Value::iterator_of(self.some_results(call, items, (name == "map_while").then_some(false), make)?)
            }
            ("scan", [start, function]) => {
                let start = self.expression(start);
                let function = self.function_argument(function, 2)?;
                let function = Rc::new(Callable { changed: vec![true, false], ..(*function).clone() });
                let variable = self.frame.depth();
                // The accumulator has no name outside the function.
                self.frame.declare(String::new(), start);
                let state = Value::Reference(Rc::new(Place { variable, steps: Vec::new() }));
                let made = self.some_results(call, items, Some(false), |this, item| {
                    this.inline(&call.method, &function, vec![state.clone(), item])
                });
                self.frame.end_scope(variable);
                Value::iterator_of(made?)
            }
            // `iter`, `copied` and the like.
            _ => Value::Iterator(items),
        })
    }

    /// Returns the elements for a method that needs all of them to be present; `None` after an error.
    fn whole(&mut self, items: Vec<Element>, call: &ExprMethodCall) -> Option<Vec<Value>> {
        let all = all_there(items);
        if all.is_err() {
            let kind = "an iterator that filters elements by value";
            self.refuse(&call.method, methods::unknown_method(&call.method.to_string(), kind, &[]));
        }
        all.ok()
    }

    /// Applies a function to the elements that are present; `None` after an error.
    pub(in crate::differentiate::lower) fn mapped(
        &mut self,
        call: &ExprMethodCall,
        function: &Expr,
        items: Vec<Element>,
    ) -> Option<Vec<Element>> {
        let function = self.function_argument(function, 1)?;
        let map = |Element { is_there, value }: Element| {
            let value = self.run_under(call, &is_there, |this| this.inline(&call.method, &function, vec![value]));
            (!value.is_unknown()).then_some(Element { is_there, value })
        };
        items.into_iter().map(map).collect()
    }

    /// Calls a predicate for each element. With `until`, stops after the first element for which the predicate returns
    /// that value. `None` after an error.
    pub(super) fn call_predicate(
        &mut self,
        call: &ExprMethodCall,
        function: &Expr,
        items: &[Element],
        until: Option<bool>,
    ) -> Option<Vec<PredicateCall>> {
        let function = self.function_argument(function, 1)?;
        let mut continues = Condition::Known(true);
        let call_for = |Element { is_there, value }: &Element| {
            let is_called = is_there.clone().and(continues.clone());
            if matches!(is_called, Condition::Known(false)) {
                return Some(PredicateCall { holds: is_called.clone(), is_called });
            }
            match self.run_under(call, &is_called, |this| this.inline(&call.method, &function, vec![value.clone()])) {
                Value::Truth(holds) => {
                    continues = continues.clone().and(continues_after(is_there, &holds, until));
                    Some(PredicateCall { is_called, holds })
                }
                other => {
                    self.refuse_known(&other, &call.args, messages::not_a_condition(&other.describe()));
                    None
                }
            }
        };
        items.iter().map(call_for).collect()
    }

    /// Returns the elements that satisfy a predicate; `None` after an error.
    pub(in crate::differentiate::lower) fn filtered(
        &mut self,
        call: &ExprMethodCall,
        function: &Expr,
        items: &[Element],
    ) -> Option<Vec<Element>> {
        let results = self.call_predicate(call, function, items, None)?;
        Some(items.iter().cloned().zip(results).map(|(item, result)| item.and_where(result.holds)).collect())
    }

    /// Returns the values inside the options that a function returns for the elements. Stops after the first `Some` if
    /// `until` is `Some(true)`, after the first `None` if it is `Some(false)`. `None` after an error.
    pub(super) fn some_results(
        &mut self,
        call: &ExprMethodCall,
        items: Vec<Element>,
        until: Option<bool>,
        mut make: impl FnMut(&mut Self, Value) -> Value,
    ) -> Option<Vec<Element>> {
        let mut made = Vec::with_capacity(items.len());
        let mut continues = Condition::Known(true);
        for Element { is_there, value } in items {
            let is_called = is_there.clone().and(continues.clone());
            if matches!(is_called, Condition::Known(false)) {
                made.push(Element { is_there: is_called, value: Value::Never });
                continue;
            }
            match self.run_under(call, &is_called, |this| make(this, value)) {
                Value::Optional(optional) => {
                    let Optional { is_some, value } = &*optional;
                    continues = continues.and(continues_after(&is_there, is_some, until));
                    made.push(Element { is_there: is_called.and(is_some.clone()), value: value.clone() });
                }
                other => {
                    self.refuse_known(&other, &call.args, messages::not_an_option(&other.describe()));
                    return None;
                }
            }
        }
        Some(made)
    }

    /// Returns the elements of the elements; `None` after an error.
    fn flattened(&mut self, call: &ExprMethodCall, items: Vec<Element>) -> Option<Value> {
        let mut all = Vec::new();
        for Element { is_there, value } in items {
            let value = self.referenced(value);
            let kind = value.describe();
            let Some(inner) = value.items() else {
                return Some(self.refuse(&call.method, messages::not_iterable(&kind)));
            };
            all.extend(inner.into_iter().map(|item| item.and_where(is_there.clone())));
        }
        Some(Value::iterator_of(all))
    }

    /// Returns pairs of these elements and those of another iterator; `None` after an error.
    pub(in crate::differentiate::lower) fn zipped(&mut self, items: Vec<Element>, other: &Expr) -> Option<Value> {
        let pair = |one: Value, other: Value| Value::Tuple(vec![one, other]);
        let others = match strip(other) {
            // An open range has as many numbers as are needed.
            Expr::Range(ExprRange { start: Some(start), end: None, .. }) => {
                let first = self.expression(start);
                let Some(first) = self.algebra.known_integer(&first) else {
                    return Some(self.refuse_known(&first, start, messages::unknown_iteration_count()));
                };
                (first..).zip(&items).map(|(number, _)| Element::new(self.algebra.integer(number))).collect()
            }
            other => match self.expression(other) {
                Value::Slice(slice) => return self.zip_with_items(items, &LoopSequence::over(slice), pair),
                Value::LoopSequence(sequence) if sequence.items.is_indexed() => {
                    return self.zip_with_items(items, &sequence, pair);
                }
                value => self.items_of(other, value)?,
            },
        };
        Some(match (all_there(items), all_there(others)) {
            (Ok(ones), Ok(others)) => {
                Value::iterator(ones.into_iter().zip(others).map(|(one, other)| pair(one, other)))
            }
            (Err(items), Ok(others)) => self.partners(other, items, &Value::Array(others), pair)?,
            (Err(items), Err(others)) => self.partners(other, items, &Value::List(others), pair)?,
            (Ok(ones), Err(items)) => {
                self.partners(other, items, &Value::Array(ones), |other, one| pair(one, other))?
            }
        })
    }

    /// Returns pairs of elements that may be absent and elements of a list; `None` after an error.
    fn partners(
        &mut self,
        place: &Expr,
        items: Vec<Element>,
        others: &Value,
        pair: impl Fn(Value, Value) -> Value,
    ) -> Option<Value> {
        let Value::Integer(count) = self.counted(&others.clone().items()?)? else { return None };
        let ranks = ranks(self.algebra, &items);
        let mut pairs = Vec::with_capacity(items.len());
        for (Element { is_there, value }, rank) in items.into_iter().zip(ranks) {
            let is_there = is_there.and(Condition::less(self.algebra, rank, count));
            if matches!(is_there, Condition::Known(false)) {
                continue;
            }
            let other = others.select_element(self.algebra, rank);
            let other = other.unwrap_or_else(|| self.refuse(place, messages::no_such_choice(&others.describe())));
            pairs.push(Element { is_there, value: pair(value, other) });
        }
        Some(Value::Iterator(pairs))
    }
}
