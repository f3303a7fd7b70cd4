//! Iterators over arrays, lists and ranges with a known number of elements. Whether an element is present may depend on
//! arguments: each has a condition.

mod adaptors;
mod consumers;

use std::rc::Rc;

use aim_symbolic::Scalar;
use quote::ToTokens;
use syn::{Expr, ExprMethodCall, ExprRange, Ident, RangeLimits};

use super::algebra::Algebra;
use super::condition::Condition;
use super::expected::Expected;
use super::extents::Extents;
use super::value::{Callable, Element, LoopSequence, Optional, Place, Value};
use super::{Translation, extents, is_place, methods};
use crate::differentiate::messages;

/// Maximum length of a range.
const LONGEST: i64 = 10_000;

/// Maximum length of a range without known ends that is unrolled.
const LONGEST_OPEN: i64 = 300;

/// Order in which a method takes elements from its iterator.
#[derive(Clone, Copy, PartialEq)]
enum Consumption {
    /// One for each element that is taken from it.
    OneByOne,
    /// Lazily, but more, fewer, or in another order.
    Lazy,
    /// At once, up to the element that it searches for; the rest stays in the iterator.
    UntilFound,
    /// At once, all of them.
    All,
}

/// A method of iterators.
struct Method {
    name: &'static str,
    /// Number of its arguments.
    arguments: usize,
    consumption: Consumption,
    /// `true` if it calls a function with elements.
    calls: bool,
}

impl Method {
    /// Describes a method that takes no function.
    const fn plain(name: &'static str, arguments: usize, consumption: Consumption) -> Self {
        Self { name, arguments, consumption, calls: false }
    }

    /// Describes a method whose last argument is a function of elements.
    const fn calling(name: &'static str, arguments: usize, consumption: Consumption) -> Self {
        Self { name, arguments, consumption, calls: true }
    }
}

const METHODS: &[Method] = &[
    Method::plain("iter", 0, Consumption::OneByOne),
    Method::plain("into_iter", 0, Consumption::OneByOne),
    Method::plain("copied", 0, Consumption::OneByOne),
    Method::plain("cloned", 0, Consumption::OneByOne),
    Method::plain("clone", 0, Consumption::OneByOne),
    Method::plain("enumerate", 0, Consumption::OneByOne),
    Method::plain("zip", 1, Consumption::Lazy),
    Method::plain("chain", 1, Consumption::OneByOne),
    Method::plain("rev", 0, Consumption::Lazy),
    Method::plain("cycle", 0, Consumption::Lazy),
    Method::plain("skip", 1, Consumption::OneByOne),
    Method::plain("take", 1, Consumption::Lazy),
    Method::plain("step_by", 1, Consumption::Lazy),
    Method::calling("map", 1, Consumption::OneByOne),
    Method::calling("inspect", 1, Consumption::OneByOne),
    Method::plain("flatten", 0, Consumption::Lazy),
    Method::calling("flat_map", 1, Consumption::OneByOne),
    Method::calling("filter", 1, Consumption::OneByOne),
    Method::calling("filter_map", 1, Consumption::OneByOne),
    Method::calling("take_while", 1, Consumption::Lazy),
    Method::calling("skip_while", 1, Consumption::Lazy),
    Method::calling("map_while", 1, Consumption::Lazy),
    Method::calling("scan", 2, Consumption::Lazy),
    Method::calling("find", 1, Consumption::UntilFound),
    Method::calling("find_map", 1, Consumption::UntilFound),
    Method::calling("position", 1, Consumption::UntilFound),
    Method::calling("any", 1, Consumption::UntilFound),
    Method::calling("all", 1, Consumption::UntilFound),
    Method::calling("try_fold", 2, Consumption::UntilFound),
    Method::plain("next", 0, Consumption::UntilFound),
    Method::plain("nth", 1, Consumption::UntilFound),
    Method::plain("collect", 0, Consumption::All),
    Method::plain("unzip", 0, Consumption::All),
    Method::calling("partition", 1, Consumption::All),
    Method::calling("for_each", 1, Consumption::All),
    Method::calling("fold", 2, Consumption::All),
    Method::calling("reduce", 1, Consumption::All),
    Method::calling("min_by", 1, Consumption::All),
    Method::calling("max_by", 1, Consumption::All),
    Method::calling("min_by_key", 1, Consumption::All),
    Method::calling("max_by_key", 1, Consumption::All),
    Method::plain("last", 0, Consumption::All),
    Method::plain("len", 0, Consumption::All),
    Method::plain("count", 0, Consumption::All),
    Method::plain("sum", 0, Consumption::All),
    Method::plain("product", 0, Consumption::All),
];

/// Returns the names of all methods.
pub(super) fn names() -> Vec<&'static str> {
    METHODS.iter().map(|method| method.name).collect()
}

/// Returns the method with this name.
fn method(name: &Ident) -> Option<&'static Method> {
    METHODS.iter().find(|method| name == method.name)
}

/// Returns `true` if iterators have a method with this name.
pub(super) fn has_method(name: &Ident) -> bool {
    method(name).is_some()
}

/// Returns `true` if a method consumes its whole iterator at once: by itself, or if its result is consumed at once
/// (`is_drained`).
pub(super) fn drains(name: &Ident, is_drained: bool) -> bool {
    match method(name).map(|method| method.consumption) {
        // `len` does not look at the elements.
        Some(Consumption::All) => name != "len",
        Some(Consumption::OneByOne) => is_drained,
        _ => false,
    }
}

/// Returns `true` if a method takes an iterator by value.
pub(super) fn consumes(name: &Ident) -> bool {
    method(name).is_some_and(|method| method.consumption != Consumption::UntilFound && method.name != "clone")
}

/// Returns `true` if the function that is passed to a method of this value is called later, or not with each element.
pub(super) fn is_lazy(receiver: &Value, name: &Ident) -> bool {
    let is_later =
        |method: &Method| method.calls && matches!(method.consumption, Consumption::OneByOne | Consumption::Lazy);
    matches!(receiver, Value::Iterator(_)) && method(name).is_some_and(is_later)
}

impl Element {
    /// Creates an element that is present.
    pub(super) fn new(value: Value) -> Self {
        Self { is_there: Condition::Known(true), value }
    }

    /// Adds a condition to the element's presence.
    pub(super) fn and_where(self, condition: Condition) -> Self {
        Self { is_there: self.is_there.and(condition), value: self.value }
    }
}

impl Value {
    /// Creates an iterator over all of these values.
    pub(super) fn iterator(values: impl IntoIterator<Item = Self>) -> Self {
        Self::Iterator(values.into_iter().map(Element::new).collect())
    }

    /// Creates an iterator over the elements that may be present.
    pub(super) fn iterator_of(items: impl IntoIterator<Item = Element>) -> Self {
        Self::Iterator(items.into_iter().filter(|item| !matches!(item.is_there, Condition::Known(false))).collect())
    }

    /// Returns the elements of a value that a loop can iterate over.
    pub(super) fn items(self) -> Option<Vec<Element>> {
        match self {
            Self::Array(values) => Some(values.into_iter().map(Element::new).collect()),
            Self::List(items) | Self::Iterator(items) => Some(items),
            Self::Optional(option) if matches!(option.is_some, Condition::Known(false)) => Some(Vec::new()),
            Self::Optional(option) => {
                let Optional { is_some, value } = &*option;
                Some(vec![Element { is_there: is_some.clone(), value: value.clone() }])
            }
            _ => None,
        }
    }
}

/// Returns the values of the elements, if all of them are certainly present.
pub(super) fn all_there(items: Vec<Element>) -> Result<Vec<Value>, Vec<Element>> {
    if items.iter().any(|item| !matches!(item.is_there, Condition::Known(true))) {
        return Err(items);
    }
    Ok(items.into_iter().map(|item| item.value).collect())
}

/// Returns the number of present elements before each one, and their total number.
pub(super) fn ranks(a: &mut Algebra, items: &[Element]) -> Vec<Scalar> {
    let mut rank = a.number(0.0);
    let mut ranks = vec![rank];
    for item in items {
        let one = a.number(1.0);
        let next = a.add(rank, one);
        rank = item.is_there.select(a, next, rank);
        ranks.push(rank);
    }
    ranks
}

impl Translation<'_> {
    /// Evaluates a range of whole numbers. Its ends may depend on arguments, within known bounds.
    pub(super) fn range(&mut self, range: &ExprRange) -> Value {
        let (Some(start), Some(end)) = (&range.start, &range.end) else {
            return self.refuse(range, messages::range_without_end());
        };
        let values = [start, end].map(|bound| self.expression(bound));
        let mut ends = Vec::new();
        for (value, bound) in values.into_iter().zip([start, end]) {
            match value {
                Value::Integer(end) => ends.push(end),
                value => return self.refuse_known(&value, bound, messages::unknown_iteration_count()),
            }
        }
        let [first, last] = ends[..] else { return Value::Unknown };
        let mut extents = Extents::new(self.algebra, self.frame.facts());
        let [least, most] = [extents.of(first).least, extents.of(last).most].map(|end| {
            // Ends beyond the range of `i64` saturate; the range is then too long in any case.
            #[expect(clippy::cast_possible_truncation, reason = "it was made of a whole number")]
            end.is_finite().then_some(end as i64)
        });
        let is_closed = matches!(range.limits, RangeLimits::Closed(_));
        let rounds = least.zip(most).map_or(i64::MAX, |(least, most)| most.saturating_sub(least));
        let is_known = [first, last].into_iter().all(|end| self.algebra.constant_of(end).is_some());
        let is_written = rounds <= if is_known { LONGEST } else { LONGEST_OPEN };
        let (true, Some(least), Some(most)) = (is_written, least, most) else {
            let a = &mut *self.algebra;
            let (count, more) = (a.sub(last, first), a.count(usize::from(is_closed)));
            let count = a.add(count, more);
            return Value::LoopSequence(Rc::new(LoopSequence::numbers(a, first, count)));
        };
        let most = if is_closed { most.saturating_add(1) } else { most };
        let mut items = Vec::new();
        for i in least..most {
            let Value::Integer(number) = self.algebra.integer(i) else { continue };
            let behind = Condition::at_most(self.algebra, first, number);
            let before = match is_closed {
                true => Condition::at_most(self.algebra, number, last),
                false => Condition::less(self.algebra, number, last),
            };
            let [behind, before] =
                [behind, before].map(|condition| extents::decided(self.algebra, condition, self.frame.facts()));
            items.push(Element { is_there: behind.and(before), value: Value::Integer(number) });
        }
        Value::iterator_of(items)
    }

    /// Returns the elements of a struct of the module that implements `Iterator`, up to the first `None`; any other
    /// value unchanged.
    pub(super) fn own_iterator(&mut self, place: &impl ToTokens, value: Value) -> Value {
        let Value::Struct(of) = &value else { return value };
        let is_of_trait = |next: &Rc<Callable>| next.of_trait.as_deref() == Some("Iterator");
        let Some(next) = self.only_function(Some(&of.name), "next").filter(is_of_trait) else { return value };
        let variable = self.frame.depth();
        self.frame.declare(String::new(), value);
        self.frame.allow_changes();
        let state = Value::Reference(Rc::new(Place { variable, steps: Vec::new() }));
        let (mut items, mut goes_on) = (Vec::new(), Condition::Known(true));
        let elements = loop {
            let most = match goes_on {
                Condition::Known(false) => break Value::iterator_of(items),
                Condition::Known(true) => LONGEST,
                _ => LONGEST_OPEN,
            };
            if i64::try_from(items.len()).is_ok_and(|count| count == most) {
                break self.refuse(place, messages::unknown_iteration_count());
            }
            // What the call leaves behind matters only if there is an element.
            self.frame.begin_branch(goes_on.clone());
            let found = self.inline(place, &next, vec![state.clone()]);
            let changed = self.frame.end_branch();
            self.frame.assign_all(changed);
            let Value::Optional(found) = &found else {
                break self.refuse_known(&found, place, messages::not_an_option(&found.describe()));
            };
            goes_on = goes_on.and(found.is_some.clone());
            items.push(Element { is_there: goes_on.clone(), value: found.value.clone() });
        };
        self.frame.end_scope(variable);
        elements
    }

    /// Evaluates a method of an iterator over these elements.
    pub(super) fn iterator_method(&mut self, items: &[Element], call: &ExprMethodCall, expected: &Expected) -> Value {
        let name = call.method.to_string();
        let Some(method) = method(&call.method).filter(|method| method.arguments == call.args.len()) else {
            return self.refuse(&call.method, methods::unknown_method(&name, "an iterator", &names()));
        };
        let items = items.to_vec();
        let value = match method.consumption {
            Consumption::OneByOne | Consumption::Lazy => self.adaptor_method(items, call),
            Consumption::UntilFound => self.search_method(items, call),
            Consumption::All => self.consumer_method(items, call, expected),
        };
        // The error has been reported.
        value.unwrap_or(Value::Unknown)
    }

    /// Evaluates a search. An iterator in a variable continues after the element that ended the search.
    fn search_method(&mut self, items: Vec<Element>, call: &ExprMethodCall) -> Option<Value> {
        let (found, ends) = self.found(&items, call)?;
        if !is_place(&call.receiver) || found.is_unknown() {
            return Some(found);
        }
        let place = self.still_place(&call.receiver)?;
        let mut is_behind = Condition::Known(false);
        let rest = items.into_iter().zip(ends).map(|(item, ends)| {
            let left = item.and_where(is_behind.clone());
            is_behind = is_behind.clone().or(ends);
            left
        });
        let rest = Value::iterator_of(rest.collect::<Vec<_>>());
        let written = self.write(&call.method, &place, rest);
        Some(if written.is_unknown() { written } else { found })
    }

    /// Evaluates a method that must not change variables, because the time of its calls is unspecified.
    pub(super) fn without_effect(
        &mut self,
        call: &ExprMethodCall,
        act: impl FnOnce(&mut Self) -> Option<Value>,
    ) -> Option<Value> {
        let depth = self.frame.depth();
        self.frame.begin_branch(Condition::Known(true));
        let value = act(self);
        let changed = self.frame.end_branch();
        if changed.iter().any(|(variable, _)| *variable < depth) {
            return Some(self.refuse(&call.method, messages::lazy_effect()));
        }
        value
    }

    /// Returns the elements that a loop iterates over; `None` after an error.
    pub(super) fn iterated(&mut self, over: &Expr) -> Option<Vec<Element>> {
        let value = self.expression(over);
        self.items_of(over, value)
    }

    /// Returns the elements of a value; `None` after an error.
    pub(super) fn items_of(&mut self, place: &impl ToTokens, value: Value) -> Option<Vec<Element>> {
        let value = self.own_iterator(place, value);
        let items = value.clone().items();
        if items.is_none() {
            self.refuse_known(&value, place, messages::not_iterable(&value.describe()));
        }
        items
    }

    /// Returns an argument that is a known whole number; `None` after an error.
    pub(super) fn known_count(&mut self, argument: &Expr) -> Option<usize> {
        let value = self.expression_as(argument, &Expected::Named("usize".into()));
        let known = self.algebra.known_index(&value);
        if known.is_none() {
            self.refuse_known(&value, argument, messages::index_unknown());
        }
        known
    }

    /// Returns an argument that is a whole number; `None` after an error.
    pub(super) fn count(&mut self, argument: &Expr) -> Option<Scalar> {
        match self.expression(argument) {
            Value::Integer(count) => Some(count),
            other => {
                self.refuse_known(&other, argument, messages::index_unknown());
                None
            }
        }
    }
}
