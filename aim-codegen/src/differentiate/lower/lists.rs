//! `Vec`: a list of all elements that may be present, each with the condition of its presence. Construction, methods
//! that change the length, and sorting.

use std::rc::Rc;

use aim_symbolic::Scalar;
use quote::quote;
use syn::{Expr, ExprMethodCall};

use super::algebra::Algebra;
use super::condition::Condition;
use super::iterators::ranks;
use super::value::{Callable, Element, Value};
use super::{Translation, is_place};
use crate::differentiate::messages;

/// Methods that change an array or a list as a whole, with the number of their arguments.
const CHANGING: &[(&str, usize)] = &[
    ("push", 1),
    ("pop", 0),
    ("insert", 2),
    ("remove", 1),
    ("clear", 0),
    ("truncate", 1),
    ("retain", 1),
    ("extend", 1),
    ("extend_from_slice", 1),
    ("copy_from_slice", 1),
    ("clone_from_slice", 1),
    ("fill", 1),
    ("reverse", 0),
    ("rotate_left", 1),
    ("rotate_right", 1),
    ("sort", 0),
    ("sort_unstable", 0),
    ("sort_by", 1),
    ("sort_unstable_by", 1),
];

/// Longest array that is sorted. Sorting compares every pair of elements, because the order is not known.
const LONGEST_SORTED: usize = 16;

/// Returns the names of these methods.
pub(super) fn methods() -> impl Iterator<Item = &'static str> {
    CHANGING.iter().map(|(name, _)| *name)
}

impl Element {
    /// Returns `self` where the condition holds, else `otherwise`; `None` if their values are of different kinds.
    pub(super) fn select(&self, a: &mut Algebra, condition: &Condition, otherwise: &Self) -> Option<Self> {
        let is_there = Condition::either(condition, &self.is_there, &otherwise.is_there);
        // Absent values need no select.
        let value = match (&self.is_there, &otherwise.is_there) {
            (Condition::Known(false), _) => otherwise.value.clone(),
            (_, Condition::Known(false)) => self.value.clone(),
            _ => self.value.select(a, condition, &otherwise.value)?,
        };
        Some(Self { is_there, value })
    }
}

impl Value {
    /// Creates a list of the elements that may be present.
    pub(super) fn list(items: impl IntoIterator<Item = Element>) -> Self {
        let is_there = |item: &Element| !matches!(item.is_there, Condition::Known(false));
        let items: Vec<Element> = items.into_iter().filter(is_there).collect();
        if items.iter().all(|item| matches!(item.is_there, Condition::Known(true))) {
            return Self::Array(items.into_iter().map(|item| item.value).collect());
        }
        Self::List(items)
    }
}

/// Selects between two lists; `None` if some of their elements are of different kinds.
pub(super) fn select(
    a: &mut Algebra,
    condition: &Condition,
    then: &[Element],
    otherwise: &[Element],
) -> Option<Vec<Element>> {
    let nothing = Element { is_there: Condition::Known(false), value: Value::Never };
    let items = (0..then.len().max(otherwise.len())).map(|place| {
        let [then, otherwise] = [then, otherwise].map(|items| items.get(place).unwrap_or(&nothing));
        then.select(a, condition, otherwise)
    });
    items.collect()
}

/// Returns the element that `index` present elements precede; `None` if there are none, or of several kinds.
pub(super) fn ranked(a: &mut Algebra, items: &[Element], index: Scalar) -> Option<Value> {
    let ranks = ranks(a, items);
    items.iter().zip(ranks).rev().try_fold(Value::Never, |found, (item, rank)| {
        let is_here = item.is_there.clone().and(Condition::equal(a, rank, index));
        item.value.select(a, &is_here, &found)
    })
}

/// Replaces the element that `index` present elements precede.
pub(super) fn with_ranked(a: &mut Algebra, items: &[Element], index: Scalar, value: &Value) -> Option<Value> {
    let ranks = ranks(a, items);
    let items = items.iter().zip(ranks).map(|(item, rank)| {
        let is_here = item.is_there.clone().and(Condition::equal(a, rank, index));
        Some(Element { is_there: item.is_there.clone(), value: value.select(a, &is_here, &item.value)? })
    });
    Some(Value::list(items.collect::<Option<Vec<Element>>>()?))
}

impl Translation<'_> {
    /// Evaluates `vec![…]`.
    pub(super) fn list(&mut self, list: &syn::Macro) -> Value {
        let elements = &list.tokens;
        match syn::parse2::<Expr>(quote!([#elements])) {
            Ok(array) => self.expression(&array),
            Err(_) => self.refuse(&list.path, messages::macro_call()),
        }
    }

    /// Evaluates a method that changes an array or a list as a whole; `None` if it is another one.
    pub(super) fn list_method(&mut self, call: &ExprMethodCall) -> Option<Value> {
        let name = call.method.to_string();
        if !CHANGING.contains(&(&name, call.args.len())) || !is_place(&call.receiver) {
            return None;
        }
        let place = self.still_place(&call.receiver)?;
        let list @ (Value::Array(_) | Value::List(_)) = self.read(&place) else { return None };
        let mut items = list.items()?;
        // The error has been reported.
        let Some(result) = self.changed(call, &name, &mut items).filter(|result| !result.is_unknown()) else {
            return Some(Value::Unknown);
        };
        let written = self.write(&call.method, &place, Value::list(items));
        Some(if written.is_unknown() { written } else { result })
    }

    /// Changes `items` by a method and returns the method's value; `None` after an error.
    fn changed(&mut self, call: &ExprMethodCall, name: &str, items: &mut Vec<Element>) -> Option<Value> {
        let arguments: Vec<&Expr> = call.args.iter().collect();
        match (name, arguments.as_slice()) {
            ("pop", []) => {
                let last = self.first(call, items.iter().rev().cloned().collect());
                let mut is_after = Condition::Known(false);
                for item in items.iter_mut().rev() {
                    let was_there = item.is_there.clone();
                    item.is_there = was_there.clone().and(is_after.clone());
                    is_after = is_after.or(was_there);
                }
                return Some(last);
            }
            ("clear", []) => items.clear(),
            ("reverse", []) => items.reverse(),
            ("sort" | "sort_unstable", []) => {
                let Value::Function(compare) = self.closure(&syn::parse_quote!(|a, b| a.cmp(b))) else { return None };
                return self.sorted(call, &compare, items);
            }
            ("sort_by" | "sort_unstable_by", [compare]) => {
                let compare = self.function_argument(compare, 2)?;
                return self.sorted(call, &compare, items);
            }
            ("retain", [function]) => {
                *items = self.filtered(call, function, items)?;
            }
            ("truncate", [length]) => {
                let Value::Integer(length) = self.expression(length) else { return None };
                let ranks = ranks(self.algebra, items);
                for (item, rank) in items.iter_mut().zip(ranks) {
                    item.is_there = item.is_there.clone().and(Condition::less(self.algebra, rank, length));
                }
            }
            ("extend" | "extend_from_slice", [others]) => items.extend(self.iterated(others)?),
            // With another length it panics.
            ("copy_from_slice" | "clone_from_slice", [others]) => *items = self.iterated(others)?,
            ("insert", [place, value]) => {
                let (place, value) = (self.count(place)?, self.expression(value));
                let mut ranks = ranks(self.algebra, items).into_iter();
                let mut inserted = Vec::with_capacity(2 * items.len() + 1);
                // Insert before the element that `place` present elements precede, or at the end.
                let mut here = |a: &mut Algebra, is_there: Condition| {
                    let is_there = is_there.and(Condition::equal(a, ranks.next()?, place));
                    Some(Element { is_there, value: value.clone() })
                };
                for item in items.drain(..) {
                    inserted.push(here(self.algebra, item.is_there.clone())?);
                    inserted.push(item);
                }
                inserted.push(here(self.algebra, Condition::Known(true))?);
                *items = inserted;
            }
            ("remove", [place]) => {
                let index = self.count(place)?;
                let Some(removed) = ranked(self.algebra, items, index) else {
                    return Some(self.refuse(*place, messages::index_outside("this array")));
                };
                let ranks = ranks(self.algebra, items);
                let left = items.drain(..).zip(ranks);
                *items = left
                    .map(|(item, rank)| item.and_where(Condition::equal(self.algebra, rank, index).not()))
                    .collect();
                return Some(removed);
            }
            ("rotate_left" | "rotate_right", [count]) => {
                let count = self.known_count(count)?;
                if items.iter().any(|item| !matches!(item.is_there, Condition::Known(true))) || count > items.len() {
                    return Some(self.refuse(&call.args, messages::index_outside("this array")));
                }
                if name == "rotate_left" { items.rotate_left(count) } else { items.rotate_right(count) }
            }
            (_, [value]) => {
                let value = self.expression(value);
                if value.is_unknown() {
                    return Some(value);
                }
                if name == "push" {
                    items.push(Element::new(value));
                } else {
                    items.iter_mut().for_each(|item| item.value = value.clone());
                }
            }
            _ => return None,
        }
        Some(Value::nothing())
    }

    /// Bubble sort: exchanges neighbours that are out of order, so it is stable. Absent elements go last, because their
    /// values may be NaN, which has no order. `None` after an error.
    fn sorted(&mut self, call: &ExprMethodCall, compare: &Rc<Callable>, items: &mut [Element]) -> Option<Value> {
        if items.len() > LONGEST_SORTED {
            return Some(self.refuse(&call.method, messages::sorted_too_long(LONGEST_SORTED)));
        }
        for end in (1..items.len()).rev() {
            for first in 0..end {
                let [one, other] = [items[first].clone(), items[first + 1].clone()];
                let order = match self.inline(&call.method, compare, vec![one.value.clone(), other.value.clone()]) {
                    Value::Ordering(order) => order,
                    order => {
                        let text = messages::not_an_ordering(&order.describe());
                        return Some(self.refuse_known(&order, &call.method, text));
                    }
                };
                let is_gap = one.is_there.clone().not();
                let is_wrong = other.is_there.clone().and(is_gap.or(order.greater.clone()));
                items[first] = other.select(self.algebra, &is_wrong, &one)?;
                items[first + 1] = one.select(self.algebra, &is_wrong, &other)?;
            }
        }
        let is_unknown = items.iter().any(|item| item.value.is_unknown());
        Some(if is_unknown { Value::Unknown } else { Value::nothing() })
    }
}
