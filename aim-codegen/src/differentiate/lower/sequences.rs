//! Iterators: those over arrays and ranges, whose elements are all known by number.

use std::rc::Rc;

use syn::{Expr, ExprMethodCall, ExprRange, RangeLimits};

use super::value::{Callable, Value};
use super::{Translation, operators};
use crate::differentiate::messages;

/// The longest range.
const LONGEST: i64 = 10_000;

/// The methods of iterators, for messages.
const METHODS: &[&str] = &[
    "iter",
    "into_iter",
    "copied",
    "cloned",
    "enumerate",
    "zip",
    "chain",
    "rev",
    "skip",
    "take",
    "step_by",
    "map",
    "fold",
    "sum",
    "product",
    "windows",
    "chunks_exact",
    "len",
];

/// Those of them that arrays have, too.
const OF_ARRAYS: &[&str] = &["iter", "into_iter", "map", "windows", "chunks_exact", "len"];

impl Value {
    /// The elements of what a loop can go over.
    pub(super) fn items(self) -> Option<Vec<Self>> {
        match self {
            Self::Array(values) | Self::Sequence(values) => Some(values),
            _ => None,
        }
    }
}

impl Translation<'_> {
    /// A range of known whole numbers.
    pub(super) fn range(&mut self, range: &ExprRange) -> Value {
        let (Some(start), Some(end)) = (&range.start, &range.end) else {
            return self.refuse(range, messages::range_without_end());
        };
        let mut ends = [0; 2];
        for (place, bound) in ends.iter_mut().zip([start, end]) {
            let value = self.expression(bound);
            match self.algebra.known_integer(&value) {
                Some(known) => *place = known,
                None => return self.refuse_known(&value, bound, messages::rounds_unknown()),
            }
        }
        let [start, end] = ends;
        let end = if matches!(range.limits, RangeLimits::Closed(_)) { end.saturating_add(1) } else { end };
        if end.saturating_sub(start) > LONGEST {
            return self.refuse(range, messages::range_too_long(LONGEST));
        }
        Value::Sequence((start..end).map(|i| self.algebra.integer(i)).collect())
    }

    /// A method of an array or an iterator; `None` if it is none of theirs.
    pub(super) fn sequence_method(&mut self, receiver: &Value, call: &ExprMethodCall) -> Option<Value> {
        let is_array = matches!(receiver, Value::Array(_));
        let items = receiver.clone().items()?;
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        // Of an array these can only be methods of a trait.
        let is_of_iterators = name == "count" || METHODS.contains(&name.as_str());
        if is_array && is_of_iterators && !OF_ARRAYS.contains(&name.as_str()) {
            return Some(self.refuse(&call.method, messages::trait_method(&name)));
        }
        Some(match (name.as_str(), arguments.as_slice()) {
            ("iter" | "into_iter" | "copied" | "cloned", []) => Value::Sequence(items),
            ("clone" | "as_slice" | "as_ref" | "into" | "to_owned", []) => receiver.clone(),
            ("len" | "count", []) => self.algebra.whole(items.len()),
            ("rev", []) => Value::Sequence(items.into_iter().rev().collect()),
            ("enumerate", []) => {
                let numbered = items.into_iter().enumerate();
                Value::Sequence(numbered.map(|(i, item)| Value::Tuple(vec![self.algebra.whole(i), item])).collect())
            }
            ("zip" | "chain", [other]) => {
                let value = self.expression(other);
                match value.items() {
                    Some(others) if name == "zip" => {
                        let pairs = items.into_iter().zip(others);
                        Value::Sequence(pairs.map(|(a, b)| Value::Tuple(vec![a, b])).collect())
                    }
                    Some(others) => Value::Sequence(items.into_iter().chain(others).collect()),
                    None => self.refuse(*other, messages::not_iterable("this")),
                }
            }
            ("skip" | "take" | "step_by" | "windows" | "chunks_exact", [count]) => {
                let value = self.expression(count);
                let Some(count_known) = self.algebra.known_index(&value) else {
                    return Some(self.refuse_known(&value, *count, messages::index_unknown()));
                };
                match (name.as_str(), count_known) {
                    ("skip", n) => Value::Sequence(items.into_iter().skip(n).collect()),
                    ("take", n) => Value::Sequence(items.into_iter().take(n).collect()),
                    (_, 0) => self.refuse(*count, messages::index_outside("a loop")),
                    ("step_by", n) => Value::Sequence(items.into_iter().step_by(n).collect()),
                    ("windows", n) => {
                        Value::Sequence(items.windows(n).map(|part| Value::Array(part.to_vec())).collect())
                    }
                    (_, n) => Value::Sequence(items.chunks_exact(n).map(|part| Value::Array(part.to_vec())).collect()),
                }
            }
            ("map", [function]) => {
                let function = self.function_argument(function, 1)?;
                let mapped = self.mapped(call, &function, items);
                match mapped {
                    Some(values) if is_array => Value::Array(values),
                    Some(values) => Value::Sequence(values),
                    None => Value::Unknown,
                }
            }
            ("fold", [start, function]) => {
                let mut value = self.expression(start);
                let function = self.function_argument(function, 2)?;
                for item in items {
                    value = self.inline(&call.method, &function, vec![value, item]);
                }
                value
            }
            ("sum" | "product", []) => self.total(call, &name, items),
            _ => self.refuse(&call.method, messages::unknown_method(&name, &receiver.describe(), METHODS)),
        })
    }

    /// What a function makes of each; `None` where one of them is unknown.
    fn mapped(&mut self, call: &ExprMethodCall, function: &Rc<Callable>, items: Vec<Value>) -> Option<Vec<Value>> {
        let mut values = Vec::with_capacity(items.len());
        for item in items {
            let value = self.inline(&call.method, function, vec![item]);
            if value.is_unknown() {
                return None;
            }
            values.push(value);
        }
        Some(values)
    }

    fn total(&mut self, call: &ExprMethodCall, name: &str, items: Vec<Value>) -> Value {
        let operator: syn::BinOp = if name == "sum" { syn::parse_quote!(+) } else { syn::parse_quote!(*) };
        let mut items = items.into_iter();
        let Some(mut total) = items.next() else {
            return self.refuse(&call.method, messages::empty_sum());
        };
        for item in items {
            if total.is_unknown() || item.is_unknown() {
                return Value::Unknown;
            }
            total = match operators::binary(self.algebra, &operator, &total, &item) {
                Some(total) => total,
                None => {
                    self.refuse(&call.method, messages::no_operation(&operator, &total.describe(), &item.describe()))
                }
            };
        }
        total
    }
}
