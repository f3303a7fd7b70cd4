//! Iterators: those over arrays, lists and ranges, whose elements are all known by number. Which of them are there may depend
//! on arguments: each has a condition.

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
use super::value::{Element, Optional, Rounds, Value};
use super::{Translation, extents, is_place};
use crate::differentiate::messages;

/// The longest range.
const LONGEST: i64 = 10_000;

/// The longest range that may end before its end and is written out.
const LONGEST_OPEN: i64 = 300;

/// When a method asks its iterator for elements.
#[derive(Clone, Copy, PartialEq)]
enum Course {
    /// For each when it is asked for one itself.
    InStep,
    /// Later, and for more, for fewer or in another order.
    Later,
    /// At once, until it has what it looks for: the rest is left to whoever has kept the iterator.
    Partly,
    /// At once for all.
    Whole,
}

/// A method of iterators.
struct Method {
    name: &'static str,
    /// The number of its arguments.
    arguments: usize,
    course: Course,
    /// Whether it calls a function with elements.
    calls: bool,
}

impl Method {
    /// Of elements as they are.
    const fn plain(name: &'static str, arguments: usize, course: Course) -> Self {
        Self { name, arguments, course, calls: false }
    }

    /// One whose last argument is a function of elements.
    const fn calling(name: &'static str, arguments: usize, course: Course) -> Self {
        Self { name, arguments, course, calls: true }
    }
}

const METHODS: &[Method] = &[
    Method::plain("iter", 0, Course::InStep),
    Method::plain("into_iter", 0, Course::InStep),
    Method::plain("copied", 0, Course::InStep),
    Method::plain("cloned", 0, Course::InStep),
    Method::plain("clone", 0, Course::InStep),
    Method::plain("enumerate", 0, Course::InStep),
    Method::plain("zip", 1, Course::Later),
    Method::plain("chain", 1, Course::InStep),
    Method::plain("rev", 0, Course::Later),
    Method::plain("cycle", 0, Course::Later),
    Method::plain("skip", 1, Course::InStep),
    Method::plain("take", 1, Course::Later),
    Method::plain("step_by", 1, Course::Later),
    Method::calling("map", 1, Course::InStep),
    Method::plain("flatten", 0, Course::Later),
    Method::calling("flat_map", 1, Course::InStep),
    Method::calling("filter", 1, Course::InStep),
    Method::calling("filter_map", 1, Course::InStep),
    Method::calling("take_while", 1, Course::Later),
    Method::calling("skip_while", 1, Course::Later),
    Method::calling("map_while", 1, Course::Later),
    Method::calling("scan", 2, Course::Later),
    Method::calling("find", 1, Course::Partly),
    Method::calling("find_map", 1, Course::Partly),
    Method::calling("position", 1, Course::Partly),
    Method::calling("any", 1, Course::Partly),
    Method::calling("all", 1, Course::Partly),
    Method::plain("next", 0, Course::Partly),
    Method::plain("nth", 1, Course::Partly),
    Method::plain("collect", 0, Course::Whole),
    Method::plain("unzip", 0, Course::Whole),
    Method::calling("partition", 1, Course::Whole),
    Method::calling("for_each", 1, Course::Whole),
    Method::calling("fold", 2, Course::Whole),
    Method::calling("reduce", 1, Course::Whole),
    Method::calling("min_by", 1, Course::Whole),
    Method::calling("max_by", 1, Course::Whole),
    Method::plain("last", 0, Course::Whole),
    Method::plain("len", 0, Course::Whole),
    Method::plain("count", 0, Course::Whole),
    Method::plain("sum", 0, Course::Whole),
    Method::plain("product", 0, Course::Whole),
];

/// The names of all methods.
pub(super) fn names() -> Vec<&'static str> {
    METHODS.iter().map(|method| method.name).collect()
}

/// The method of this name.
fn method(name: &Ident) -> Option<&'static Method> {
    METHODS.iter().find(|method| name == method.name)
}

/// Whether iterators have a method of this name.
pub(super) fn has_method(name: &Ident) -> bool {
    method(name).is_some()
}

/// Whether a method goes through all of the iterator that it is called on, at once: by itself, or as the iterator that it makes
/// is gone through so.
pub(super) fn drains(name: &Ident, is_drained: bool) -> bool {
    match method(name).map(|method| method.course) {
        // That many are known without a look at them.
        Some(Course::Whole) => name != "len",
        Some(Course::InStep) => is_drained,
        _ => false,
    }
}

/// Whether a function that is passed to a method of this value is called later, or not with each element.
pub(super) fn is_lazy(receiver: &Value, name: &Ident) -> bool {
    let is_later = |method: &Method| method.calls && matches!(method.course, Course::InStep | Course::Later);
    matches!(receiver, Value::Iterator(_)) && method(name).is_some_and(is_later)
}

impl Element {
    /// One that is there.
    pub(super) fn new(value: Value) -> Self {
        Self { is_there: Condition::Known(true), value }
    }

    /// The same where another condition holds, too.
    pub(super) fn where_too(self, condition: Condition) -> Self {
        Self { is_there: self.is_there.and(condition), value: self.value }
    }
}

impl Value {
    /// An iterator over all of these.
    pub(super) fn iterator(values: impl IntoIterator<Item = Self>) -> Self {
        Self::Iterator(values.into_iter().map(Element::new).collect())
    }

    /// An iterator over those that are there.
    pub(super) fn iterator_of(items: impl IntoIterator<Item = Element>) -> Self {
        Self::Iterator(items.into_iter().filter(|item| !matches!(item.is_there, Condition::Known(false))).collect())
    }

    /// The elements of what a loop can go over.
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

/// The elements, if all of them are there.
pub(super) fn all_there(items: Vec<Element>) -> Result<Vec<Value>, Vec<Element>> {
    if items.iter().any(|item| !matches!(item.is_there, Condition::Known(true))) {
        return Err(items);
    }
    Ok(items.into_iter().map(|item| item.value).collect())
}

/// How many are there before each, and in all.
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
    /// A range of whole numbers. Where it begins and ends may depend on arguments, within bounds that are known.
    pub(super) fn range(&mut self, range: &ExprRange) -> Value {
        let (Some(start), Some(end)) = (&range.start, &range.end) else {
            return self.refuse(range, messages::range_without_end());
        };
        let values = [start, end].map(|bound| self.expression(bound));
        let mut ends = Vec::new();
        for (value, bound) in values.into_iter().zip([start, end]) {
            match value {
                Value::Integer(end) => ends.push(end),
                value => return self.refuse_known(&value, bound, messages::rounds_unknown()),
            }
        }
        let [first, last] = ends[..] else { return Value::Unknown };
        let mut extents = Extents::new(self.algebra, self.frame.facts());
        let [least, most] = [extents.of(first).least, extents.of(last).most].map(|end| {
            // Whole numbers beyond these are longer ranges than any.
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
            return Value::Rounds(Rc::new(Rounds::numbers(a, first, count)));
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

    /// A method of an iterator over these.
    pub(super) fn iterator_method(&mut self, items: &[Element], call: &ExprMethodCall, expected: &Expected) -> Value {
        let name = call.method.to_string();
        let Some(method) = method(&call.method).filter(|method| method.arguments == call.args.len()) else {
            return self.refuse(&call.method, messages::unknown_method(&name, "an iterator", &names()));
        };
        let items = items.to_vec();
        let value = match method.course {
            Course::InStep | Course::Later => self.adapted(items, call),
            Course::Partly => self.searched(items, call),
            Course::Whole => self.consumed(items, call, expected),
        };
        // What is missing was reported.
        value.unwrap_or(Value::Unknown)
    }

    /// What a method looks for. An iterator that is kept goes on behind what ended the search.
    fn searched(&mut self, items: Vec<Element>, call: &ExprMethodCall) -> Option<Value> {
        let (found, ends) = self.found(&items, call)?;
        if !is_place(&call.receiver) || found.is_unknown() {
            return Some(found);
        }
        let place = self.still_place(&call.receiver)?;
        let mut is_behind = Condition::Known(false);
        let rest = items.into_iter().zip(ends).map(|(item, ends)| {
            let left = item.where_too(is_behind.clone());
            is_behind = is_behind.clone().or(ends);
            left
        });
        let rest = Value::iterator_of(rest.collect::<Vec<_>>());
        let written = self.write(&call.method, &place, rest);
        Some(if written.is_unknown() { written } else { found })
    }

    /// What a method makes that must not change variables, as it is not said when.
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

    /// What a loop can go over; `None` after an error.
    pub(super) fn iterated(&mut self, over: &Expr) -> Option<Vec<Element>> {
        let value = self.expression(over);
        self.items_of(over, value)
    }

    /// The elements of a value; `None` after an error.
    pub(super) fn items_of(&mut self, place: &impl ToTokens, value: Value) -> Option<Vec<Element>> {
        let kind = value.describe();
        let is_unknown = value.is_unknown();
        let items = value.items();
        if items.is_none() && !is_unknown {
            self.refuse(place, messages::not_iterable(&kind));
        }
        items
    }

    /// A known number that an argument is; `None` after an error.
    pub(super) fn known_count(&mut self, argument: &Expr) -> Option<usize> {
        let value = self.expression(argument);
        let known = self.algebra.known_index(&value);
        if known.is_none() {
            self.refuse_known(&value, argument, messages::index_unknown());
        }
        known
    }

    /// A whole number that an argument is; `None` after an error.
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
