//! Iterators that leave elements out. Which ones may depend on arguments: each element has the condition that it is there.

use std::rc::Rc;

use syn::{Expr, ExprMethodCall};

use super::condition::Condition;
use super::expected::Expected;
use super::place_types::neutral;
use super::value::{Callable, Optional, Place, Value};
use super::{Translation, operators};
use crate::differentiate::messages;

/// The condition that an element is there, and the element.
type Maybe = (Condition, Value);

/// The methods of those that are left, for messages.
const METHODS: &[&str] = &[
    "copied",
    "cloned",
    "rev",
    "chain",
    "map",
    "filter",
    "filter_map",
    "for_each",
    "fold",
    "reduce",
    "min_by",
    "max_by",
    "any",
    "all",
    "sum",
    "product",
    "count",
    "next",
    "last",
];

impl Value {
    /// The elements of what a loop can go over, with their conditions.
    pub(super) fn maybe_items(self) -> Option<Vec<Maybe>> {
        match self {
            Self::Filtered(items) => Some(items),
            other => other.items().map(|items| items.into_iter().map(|item| (Condition::Known(true), item)).collect()),
        }
    }

    /// An iterator over those elements that are there.
    pub(super) fn filtered(items: impl Iterator<Item = Maybe>) -> Self {
        let items: Vec<Maybe> = items.filter(|(is_there, _)| !matches!(is_there, Condition::Known(false))).collect();
        if items.iter().any(|(is_there, _)| !matches!(is_there, Condition::Known(_))) {
            return Self::Filtered(items);
        }
        Self::Sequence(items.into_iter().map(|(_, item)| item).collect())
    }
}

impl Translation<'_> {
    /// A method of an iterator that leaves elements out or looks for one; `None` if it is none of them.
    pub(super) fn filtering_method(&mut self, receiver: &Value, call: &ExprMethodCall) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        if matches!(receiver, Value::Array(_)) {
            return None;
        }
        let items = receiver.clone().maybe_items()?;
        Some(match (name.as_str(), arguments.as_slice()) {
            ("filter" | "take_while" | "skip_while" | "find" | "position", [function]) => {
                let holds = match self.conditions(call, function, &items, &name) {
                    Ok(holds) => holds,
                    Err(refused) => return Some(refused),
                };
                let left = items.into_iter().zip(holds);
                match name.as_str() {
                    "take_while" => {
                        let mut goes_on = Condition::Known(true);
                        Value::filtered(left.map(|((is_there, item), holds)| {
                            goes_on = goes_on.clone().and(is_there.clone().not().or(holds));
                            (is_there.and(goes_on.clone()), item)
                        }))
                    }
                    "skip_while" => {
                        let mut begun = Condition::Known(false);
                        Value::filtered(left.map(|((is_there, item), holds)| {
                            begun = begun.clone().or(is_there.clone().and(holds.not()));
                            (is_there.and(begun.clone()), item)
                        }))
                    }
                    "filter" => Value::filtered(left.map(|((is_there, item), holds)| (is_there.and(holds), item))),
                    "position" if matches!(receiver, Value::Filtered(_)) => return None,
                    "position" => {
                        let indices = left.enumerate().map(|(index, (_, holds))| (holds, self.algebra.whole(index)));
                        let indices = indices.collect();
                        self.first(call, indices)
                    }
                    _ => self.first(call, left.map(|((is_there, item), holds)| (is_there.and(holds), item)).collect()),
                }
            }
            ("filter_map" | "map_while" | "find_map", [function]) => {
                let function = self.function_argument(function, 1)?;
                let made = self.those_made(call, items, name == "map_while", |this, item| {
                    this.inline(&call.method, &function, vec![item])
                });
                match made {
                    Ok(made) if name == "find_map" => self.first(call, made),
                    Ok(made) => Value::filtered(made.into_iter()),
                    Err(refused) => refused,
                }
            }
            ("scan", [start, function]) => {
                let start = self.expression(start);
                let function = self.function_argument(function, 2)?;
                let function = Rc::new(Callable { changed: vec![true, false], ..(*function).clone() });
                let variable = self.frame.depth();
                // It has no name outside of the function.
                self.frame.declare(String::new(), start);
                let state = Value::Reference(Rc::new(Place { variable, steps: Vec::new() }));
                let made = self.those_made(call, items, true, |this, item| {
                    this.inline(&call.method, &function, vec![state.clone(), item])
                });
                self.frame.leave(variable);
                made.map_or_else(|refused| refused, |made| Value::filtered(made.into_iter()))
            }
            _ => return None,
        })
    }

    /// What a function says of each of the elements; or what is refused about it.
    fn conditions(
        &mut self,
        call: &ExprMethodCall,
        function: &Expr,
        items: &[Maybe],
        name: &str,
    ) -> Result<Vec<Condition>, Value> {
        let function = self.function_argument(function, 1).ok_or(Value::Unknown)?;
        // While elements are taken or left out it is called, and not after that.
        let (ends, mut goes_on) = (name.ends_with("_while"), Condition::Known(true));
        let condition = |(is_there, item): &Maybe| {
            let is_asked = is_there.clone().and(goes_on.clone());
            if matches!(is_asked, Condition::Known(false)) {
                return Ok(Condition::Known(false));
            }
            match self.under(call, &is_asked, |this| this.inline(&call.method, &function, vec![item.clone()])) {
                Value::Truth(holds) => {
                    if ends {
                        goes_on = goes_on.clone().and(is_there.clone().not().or(holds.clone()));
                    }
                    Ok(holds)
                }
                other => Err(self.refuse_known(&other, &call.args, messages::not_a_condition(&other.describe()))),
            }
        };
        items.iter().map(condition).collect()
    }

    /// What a function makes of the elements, where it makes something of them; or until it does not. Or what is refused about it.
    fn those_made(
        &mut self,
        call: &ExprMethodCall,
        items: Vec<Maybe>,
        is_first_none_the_end: bool,
        mut make: impl FnMut(&mut Self, Value) -> Value,
    ) -> Result<Vec<Maybe>, Value> {
        let mut made = Vec::with_capacity(items.len());
        let mut goes_on = Condition::Known(true);
        for (is_there, item) in items {
            let is_there = is_there.and(goes_on.clone());
            if matches!(is_there, Condition::Known(false)) {
                continue;
            }
            match self.under(call, &is_there, |this| make(this, item)) {
                Value::Optional(optional) => {
                    let Optional { is_some, value } = &*optional;
                    if is_first_none_the_end {
                        goes_on = goes_on.and(is_there.clone().not().or(is_some.clone()));
                    }
                    made.push((is_there.and(is_some.clone()), value.clone()));
                }
                other => return Err(self.refuse_known(&other, &call.args, messages::not_an_option(&other.describe()))),
            }
        }
        Ok(made)
    }

    /// The first of those that are there.
    fn first(&mut self, call: &ExprMethodCall, items: Vec<Maybe>) -> Value {
        self.reduced(call, items, |_, first, _| first)
    }

    /// A method of an iterator that may leave out any of these.
    pub(super) fn filtered_method(&mut self, items: Vec<Maybe>, call: &ExprMethodCall, expected: &Expected) -> Value {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let value = match (name.as_str(), arguments.as_slice()) {
            ("iter" | "into_iter" | "copied" | "cloned", []) => Some(Value::Filtered(items)),
            ("rev", []) => Some(Value::Filtered(items.into_iter().rev().collect())),
            ("chain", [other]) => {
                let other = self.expression(other);
                let kind = other.describe();
                match other.maybe_items() {
                    Some(others) => Some(Value::filtered(items.into_iter().chain(others))),
                    None => Some(self.refuse(&call.args, messages::not_iterable(&kind))),
                }
            }
            ("map", [function]) => self.map_those(call, function, items).map(Value::Filtered),
            ("for_each", [function]) => self.map_those(call, function, items).map(|_| Value::nothing()),
            ("any" | "all", [function]) => self.map_those(call, function, items).map(|truths| {
                let is_all = name == "all";
                let of_each = truths.into_iter().map(|(is_there, truth)| match truth {
                    Value::Truth(truth) if is_all => Some(is_there.not().or(truth)),
                    Value::Truth(truth) => Some(is_there.and(truth)),
                    _ => None,
                });
                let join = if is_all { Condition::and } else { Condition::or };
                let joined = of_each.reduce(|one, other| one.zip(other).map(|(one, other)| join(one, other)));
                joined.flatten().map_or(Value::Unknown, Value::Truth)
            }),
            ("fold", [start, function]) => {
                let start = self.expression_as(start, expected);
                self.function_argument(function, 2).map(|function| {
                    items.into_iter().fold(start, |value, (is_there, item)| {
                        let next = self.under(call, &is_there, |this| {
                            this.inline(&call.method, &function, vec![value.clone(), item])
                        });
                        self.either_value(call, &is_there, &next, &value)
                    })
                })
            }
            ("reduce" | "min_by" | "max_by", [function]) => self.function_argument(function, 2).map(|function| {
                self.reduced(call, items, |this, best, item| {
                    if name == "reduce" {
                        this.inline(&call.method, &function, vec![best, item])
                    } else {
                        this.better(call, &function, best, item)
                    }
                })
            }),
            ("last", []) => Some(self.reduced(call, items, |_, _, item| item)),
            ("next", []) => Some(self.first(call, items)),
            ("sum" | "product", []) => {
                let neutral = items.first().and_then(|(_, first)| {
                    let ty = self.type_name(first)?;
                    neutral(self.algebra, &ty, name == "sum")
                });
                neutral.map(|neutral| {
                    let terms = items.iter().map(|(is_there, item)| self.either_value(call, is_there, item, &neutral));
                    let terms = terms.collect();
                    self.total(call, terms, expected)
                })
            }
            ("count", []) => self.counted(call, items.iter().map(|(is_there, _)| is_there)),
            _ => None,
        };
        value.unwrap_or_else(|| self.refuse(&call.method, messages::filter_unknown(&name, METHODS)))
    }

    /// The number of conditions that hold.
    pub(super) fn counted<'c>(
        &mut self,
        call: &ExprMethodCall,
        mut conditions: impl Iterator<Item = &'c Condition>,
    ) -> Option<Value> {
        let [none, one] = [0, 1].map(|count| self.algebra.integer(count));
        conditions.try_fold(none.clone(), |sum, holds| {
            let term = self.either_value(call, holds, &one, &none);
            operators::binary(self.algebra, &syn::parse_quote!(+), &sum, &term)
        })
    }

    /// Those that are there, each as a function makes it.
    fn map_those(&mut self, call: &ExprMethodCall, function: &Expr, items: Vec<Maybe>) -> Option<Vec<Maybe>> {
        let function = self.function_argument(function, 1)?;
        let map = |(is_there, item): Maybe| {
            let value = self.under(call, &is_there, |this| this.inline(&call.method, &function, vec![item]));
            (is_there, value)
        };
        Some(items.into_iter().map(map).collect())
    }

    /// An option of what is left of those that are there, joined two by two.
    fn reduced(
        &mut self,
        call: &ExprMethodCall,
        items: Vec<Maybe>,
        mut join: impl FnMut(&mut Self, Value, Value) -> Value,
    ) -> Value {
        let reduced = items.into_iter().reduce(|(is_some, value), (is_there, item)| {
            let both = is_some.clone().and(is_there.clone());
            let joined = self.under(call, &both, |this| join(this, value.clone(), item.clone()));
            let joined = self.either_value(call, &is_some, &joined, &item);
            (is_some.or(is_there.clone()), self.either_value(call, &is_there, &joined, &value))
        });
        reduced.map_or_else(Value::none, |(is_some, value)| Value::some_if(is_some, value))
    }
}
