//! Iterator consumers: methods that evaluate an iterator.

use std::rc::Rc;

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Expr, ExprClosure, ExprMethodCall};

use super::super::condition::Condition;
use super::super::expected::Expected;
use super::super::functions::each_word;
use super::super::place_types::neutral;
use super::super::value::{Callable, Element, Optional, Order, Value};
use super::super::{Translation, methods, strip};
use super::ranks;
use crate::differentiate::messages;

impl Translation<'_> {
    /// Evaluates a method that consumes all elements at once; `None` after an error.
    pub(super) fn consumer_method(
        &mut self,
        items: Vec<Element>,
        call: &ExprMethodCall,
        expected: &Expected,
    ) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        Some(match (name.as_str(), arguments.as_slice()) {
            ("collect", []) => self.collected(call, items, expected),
            ("unzip", []) => {
                let [mut ones, mut others] = [Vec::new(), Vec::new()];
                for Element { is_there, value } in items {
                    let Value::Tuple(parts) = value else { return None };
                    let [one, other] = <[Value; 2]>::try_from(parts).ok()?;
                    ones.push(Element { is_there: is_there.clone(), value: one });
                    others.push(Element { is_there, value: other });
                }
                Value::Tuple(vec![Value::list(ones), Value::list(others)])
            }
            ("partition", [function]) => {
                let results = self.call_predicate(call, function, &items, None)?;
                let [ones, others] = [true, false].map(|is_one| {
                    let those = items.iter().cloned().zip(results.iter().map(|result| result.holds.clone()));
                    those.map(move |(item, holds)| item.and_where(if is_one { holds } else { holds.not() }))
                });
                Value::Tuple(vec![Value::list(ones), Value::list(others)])
            }
            ("for_each", [function]) => self.for_each(call, function, items)?,
            ("fold", [start, function]) => {
                let start = self.expression_as(start, expected);
                let function = self.function_argument(function, 2)?;
                items.into_iter().fold(start, |folded, Element { is_there, value }| {
                    let next = self.run_under(call, &is_there, |this| {
                        this.inline(&call.method, &function, vec![folded.clone(), value])
                    });
                    self.either_value(call, &is_there, &next, &folded)
                })
            }
            ("reduce", [function]) => {
                let function = self.function_argument(function, 2)?;
                self.reduced(call, items, |this, one, other| this.inline(&call.method, &function, vec![one, other]))
            }
            ("min_by" | "max_by", [function]) => {
                let function = self.function_argument(function, 2)?;
                self.reduced(call, items, |this, best, item| this.better(call, &function, best, item))
            }
            ("min_by_key" | "max_by_key", [function]) => {
                let function = self.function_argument(function, 1)?;
                self.reduced(call, items, |this, best, item| {
                    let keys = [&best, &item].map(|value| this.inline(&call.method, &function, vec![value.clone()]));
                    match keys {
                        [Value::Integer(x), Value::Integer(y)] => {
                            let order = Order::of(this.algebra, x, y);
                            this.preferred(call, &order, &best, &item)
                        }
                        [key, _] => {
                            let text = messages::no_key(&key.describe());
                            this.refuse_known(&key, &call.method, text)
                        }
                    }
                })
            }
            ("last", []) => self.reduced(call, items, |_, _, item| item),
            ("len" | "count", []) => self.counted(&items)?,
            ("sum" | "product", []) => self.total(call, items, expected),
            _ => return None,
        })
    }

    /// Returns the value that a method searches for, and for each element the condition that it ends the search; `None`
    /// after an error.
    pub(super) fn found(&mut self, items: &[Element], call: &ExprMethodCall) -> Option<(Value, Vec<Condition>)> {
        let name = call.method.to_string();
        if name == "try_fold" {
            return self.folded_until_none(items, call);
        }
        let mut values: Vec<Value> = items.iter().map(|item| item.value.clone()).collect();
        let ends: Vec<Condition> = match (name.as_str(), call.args.first()) {
            ("nth", Some(index)) => {
                let index = self.count(index)?;
                let ranks = ranks(self.algebra, items);
                ranks.iter().map(|&rank| Condition::equal(self.algebra, rank, index)).collect()
            }
            ("find_map", Some(function)) => {
                let function = self.function_argument(function, 1)?;
                let make = |this: &mut Self, item| this.inline(&call.method, &function, vec![item]);
                let made = self.some_results(call, items.to_vec(), Some(true), make)?;
                values = made.iter().map(|item| item.value.clone()).collect();
                made.into_iter().map(|item| item.is_there).collect()
            }
            (_, Some(function)) => {
                let results = self.call_predicate(call, function, items, Some(name != "all"))?.into_iter();
                results.map(|result| if name == "all" { result.holds.not() } else { result.holds }).collect()
            }
            (_, None) => vec![Condition::Known(true); items.len()],
        };
        let ends = items.iter().zip(ends).map(|(item, ends)| item.is_there.clone().and(ends)).collect::<Vec<_>>();
        let any = || ends.iter().cloned().fold(Condition::Known(false), Condition::or);
        let found = match name.as_str() {
            "any" => Value::Truth(any()),
            "all" => Value::Truth(any().not()),
            _ => {
                if name == "position" {
                    values = ranks(self.algebra, items).into_iter().map(Value::Integer).collect();
                }
                let found = values.into_iter().zip(ends.iter().cloned());
                let found = found.map(|(value, is_there)| Element { is_there, value }).collect();
                self.first(call, found)
            }
        };
        Some((found, ends))
    }

    /// Evaluates `try_fold` and returns, for each element, the condition that it ends the fold; `None` after an error.
    fn folded_until_none(&mut self, items: &[Element], call: &ExprMethodCall) -> Option<(Value, Vec<Condition>)> {
        let start = self.expression(&call.args[0]);
        let function = self.function_argument(&call.args[1], 2)?;
        let (mut folded, mut ends) = (Value::some(start), Vec::with_capacity(items.len()));
        for Element { is_there, value } in items {
            let Value::Optional(before) = &folded else { return Some((folded, ends)) };
            let Optional { is_some, value: inside } = &**before;
            let is_called = is_some.clone().and(is_there.clone());
            if matches!(is_called, Condition::Known(false)) {
                ends.push(is_called);
                continue;
            }
            let arguments = vec![inside.clone(), value.clone()];
            let next = self.run_under(call, &is_called, |this| this.inline(&call.method, &function, arguments));
            let Value::Optional(after) = &next else {
                self.refuse_known(&next, &call.method, messages::not_an_option(&next.describe()));
                return None;
            };
            ends.push(is_called.clone().and(after.is_some.clone().not()));
            folded = self.either_value(call, &is_called, &next, &folded);
        }
        Some((folded, ends))
    }

    /// Returns the type in `collect::<…>()` and the like, or `expected` if none is written.
    pub(in crate::differentiate::lower) fn expected_of_call(
        &mut self,
        call: &ExprMethodCall,
        expected: &Expected,
    ) -> Expected {
        match call.turbofish.as_ref().and_then(|of| of.args.first()) {
            Some(syn::GenericArgument::Type(ty)) => self.expected(ty),
            _ => expected.clone(),
        }
    }

    /// Evaluates `collect`: returns a list, or an option of a list that is present if all elements are.
    fn collected(&mut self, call: &ExprMethodCall, items: Vec<Element>, expected: &Expected) -> Value {
        if items.iter().any(|item| item.value.is_unknown()) {
            return Value::Unknown;
        }
        match self.expected_of_call(call, expected) {
            Expected::Any | Expected::Array(..) => Value::list(items),
            Expected::Optional => {
                let mut is_some = Condition::Known(true);
                let mut inner = Vec::with_capacity(items.len());
                for Element { is_there, value } in items {
                    let Value::Optional(optional) = value else { return Value::Unknown };
                    is_some = is_some.and(is_there.clone().not().or(optional.is_some.clone()));
                    inner.push(Element { is_there, value: optional.value.clone() });
                }
                Value::some_if(is_some, Value::list(inner))
            }
            _ => self.refuse(&call.method, messages::not_a_list()),
        }
    }

    /// Calls a function with each element; `None` after an error. A closure written in place is run as the body of a
    /// loop, so that it may change variables.
    fn for_each(&mut self, call: &ExprMethodCall, function: &Expr, items: Vec<Element>) -> Option<Value> {
        match strip(function) {
            Expr::Closure(ExprClosure { capture: None, inputs, body, .. })
                if inputs.len() == 1 && !has_word(body.to_token_stream(), "return") =>
            {
                Some(self.each(&call.method, None, items, |this, item| {
                    this.bind(&inputs[0], item);
                    this.expression(body)
                }))
            }
            function => self.mapped(call, function, items).map(|_| Value::nothing()),
        }
    }

    /// Returns an option of the elements that are present, joined in pairs from the left.
    fn reduced(
        &mut self,
        call: &ExprMethodCall,
        items: Vec<Element>,
        mut join: impl FnMut(&mut Self, Value, Value) -> Value,
    ) -> Value {
        let reduced = items.into_iter().reduce(|left, item| {
            let both = left.is_there.clone().and(item.is_there.clone());
            let joined = self.run_under(call, &both, |this| join(this, left.value.clone(), item.value.clone()));
            let joined = self.either_value(call, &left.is_there, &joined, &item.value);
            Element {
                value: self.either_value(call, &item.is_there, &joined, &left.value),
                is_there: left.is_there.or(item.is_there),
            }
        });
        reduced.map_or_else(Value::none, |left| Value::some_if(left.is_there, left.value))
    }

    /// Returns the first element that is present.
    pub(in crate::differentiate::lower) fn first(&mut self, call: &ExprMethodCall, items: Vec<Element>) -> Value {
        let items = items.into_iter().filter(|item| !matches!(item.is_there, Condition::Known(false)));
        self.reduced(call, items.collect(), |_, first, _| first)
    }

    /// Returns the one of two values that a comparison prefers: of equal values `min_by` takes the first, `max_by` the
    /// last.
    pub(in crate::differentiate::lower) fn better(
        &mut self,
        call: &ExprMethodCall,
        compare: &Rc<Callable>,
        best: Value,
        item: Value,
    ) -> Value {
        let order = match self.inline(&call.method, compare, vec![best.clone(), item.clone()]) {
            Value::Ordering(order) => order,
            other => return self.refuse_known(&other, &call.method, messages::not_an_ordering(&other.describe())),
        };
        self.preferred(call, &order, &best, &item)
    }

    /// Returns the one of two values that a method prefers, by their order.
    fn preferred(&mut self, call: &ExprMethodCall, order: &Order, best: &Value, item: &Value) -> Value {
        let is_least = call.method == "min_by" || call.method == "min_by_key";
        let stays = if is_least { order.greater.clone().not() } else { order.greater.clone() };
        self.either_value(call, &stays, best, item)
    }

    /// Returns the number of elements that are present.
    pub(in crate::differentiate::lower) fn counted(&mut self, items: &[Element]) -> Option<Value> {
        ranks(self.algebra, items).last().map(|count| Value::Integer(*count))
    }

    /// Returns the sum or the product of all elements; if there are none, the neutral element of the type.
    fn total(&mut self, call: &ExprMethodCall, items: Vec<Element>, expected: &Expected) -> Value {
        let name = call.method.to_string();
        let expected = self.expected_of_call(call, expected);
        if items.iter().any(|item| item.value.is_unknown()) {
            return Value::Unknown;
        }
        let of_items = items.first().and_then(|first| self.type_name(&first.value));
        let ty = expected.name().map(str::to_owned).or_else(|| of_items.clone());
        if let Some(ty) = ty.filter(|ty| self.items.defines(ty)) {
            // The type's own `Sum` or `Product`.
            return match self.functions(Some(&ty), &name).as_slice() {
                [only] => self.inline(&call.method, only, vec![Value::Iterator(items)]),
                [] => self.refuse(&call.method, methods::unknown_method(&name, &format!("`{ty}`"), &[])),
                _ => self.refuse(&call.method, messages::several_functions(&name)),
            };
        }
        let neutral = of_items.as_deref().or(expected.name()).and_then(|ty| neutral(self.algebra, ty, name == "sum"));
        let operator: syn::BinOp = if name == "sum" { syn::parse_quote!(+) } else { syn::parse_quote!(*) };
        let mut total: Option<Value> = None;
        for Element { is_there, value } in items {
            let term = match (&is_there, &neutral) {
                (Condition::Known(true), _) => value,
                (is_there, Some(neutral)) => self.either_value(call, is_there, &value, neutral),
                (_, None) => self.refuse(&call.method, messages::empty_sum(&name)),
            };
            let next = match &total {
                None => term,
                Some(total) => self.operation(&call.method, &operator, total, &term),
            };
            if next.is_unknown() {
                return Value::Unknown;
            }
            total = Some(next);
        }
        total.or(neutral).unwrap_or_else(|| self.refuse(&call.method, messages::empty_sum(&name)))
    }
}

/// Returns `true` if these tokens contain the word.
fn has_word(tokens: TokenStream, word: &str) -> bool {
    let mut has = false;
    each_word(tokens, &mut |found| has |= found == word);
    has
}
