//! Iterators: those over arrays and ranges, whose elements are all known by number.

use std::rc::Rc;

use proc_macro2::TokenStream;
use quote::ToTokens;
use syn::{Expr, ExprClosure, ExprMethodCall, ExprRange, Ident, RangeLimits};

use super::condition::Condition;
use super::expected::Expected;
use super::functions::each_word;
use super::place_types::neutral;
use super::value::{Callable, Value};
use super::{Translation, arrays, is_place, lists, operators, strip};
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
    "flatten",
    "flat_map",
    "filter",
    "filter_map",
    "take_while",
    "skip_while",
    "map_while",
    "scan",
    "find",
    "find_map",
    "position",
    "collect",
    "unzip",
    "for_each",
    "fold",
    "reduce",
    "min_by",
    "max_by",
    "any",
    "all",
    "next",
    "nth",
    "last",
    "sum",
    "product",
    "windows",
    "chunks",
    "chunks_exact",
    "len",
];

/// Those of them that go on later, or stop before the end.
const LAZY: &[&str] = &[
    "map",
    "flat_map",
    "filter",
    "filter_map",
    "take_while",
    "skip_while",
    "map_while",
    "scan",
    "any",
    "all",
    "find",
    "find_map",
    "position",
];

/// Those that leave the rest of the iterator to whoever has kept it.
const ADVANCING: &[&str] = &["next", "nth", "any", "all", "find", "find_map", "position", "by_ref"];

/// Those that go through all elements at once.
const DRAINING: &[&str] =
    &["collect", "unzip", "sum", "product", "fold", "for_each", "reduce", "min_by", "max_by", "last", "count"];

/// Those of which each element is asked for where one of theirs is.
const PASSING: &[&str] = &["copied", "cloned", "enumerate", "map", "filter", "filter_map", "flat_map", "skip", "chain"];

/// Whether a method goes through all of the iterator that it is called on, at once: by itself, or as the iterator that it makes
/// is gone through so.
pub(super) fn drains(method: &Ident, is_drained: bool) -> bool {
    let is_one_of = |names: &[&str]| names.iter().any(|name| method == name);
    is_one_of(DRAINING) || is_drained && is_one_of(PASSING)
}

/// Whether a function that is passed to a method of this value need not be called with each element.
pub(super) fn is_lazy(receiver: &Value, method: &Ident) -> bool {
    matches!(receiver, Value::Sequence(_) | Value::Filtered(_)) && LAZY.iter().any(|name| method == name)
}

/// Those of them that arrays have, too.
const OF_ARRAYS: &[&str] = &[
    "iter",
    "iter_mut",
    "into_iter",
    "map",
    "windows",
    "chunks",
    "chunks_exact",
    "first",
    "last",
    "len",
    "is_empty",
    "swap",
];

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
    pub(super) fn sequence_method(
        &mut self,
        receiver: &Value,
        call: &ExprMethodCall,
        expected: &Expected,
    ) -> Option<Value> {
        let name = call.method.to_string();
        if ADVANCING.contains(&name.as_str())
            && matches!(receiver, Value::Sequence(_) | Value::Filtered(_))
            && is_place(&call.receiver)
        {
            return Some(self.refuse(&call.method, messages::iterator_kept(&name)));
        }
        if let Some(value) = self.filtering_method(receiver, call) {
            return Some(value);
        }
        if let Value::Filtered(items) = receiver {
            return Some(self.filtered_method(items.clone(), call, expected));
        }
        let is_array = matches!(receiver, Value::Array(_));
        let items = receiver.clone().items()?;
        let arguments: Vec<&Expr> = call.args.iter().collect();
        // Of an array these can only be methods of a trait.
        let is_of_iterators = name == "count" || METHODS.contains(&name.as_str());
        if is_array && is_of_iterators && !OF_ARRAYS.contains(&name.as_str()) {
            return Some(self.refuse(&call.method, messages::trait_method(&name)));
        }
        if is_array && let Some(value) = self.array_method(&items, call) {
            return Some(value);
        }
        Some(match (name.as_str(), arguments.as_slice()) {
            ("iter" | "into_iter" | "copied" | "cloned", []) => Value::Sequence(items),
            ("clone" | "as_slice" | "as_ref" | "into" | "to_owned" | "to_vec", []) => receiver.clone(),
            // How many there are is the same.
            ("try_into", []) => Value::some(Value::Array(items)),
            ("unzip", []) => {
                let parts = items.into_iter().map(|item| match item {
                    Value::Tuple(parts) => <[Value; 2]>::try_from(parts).ok(),
                    _ => None,
                });
                match parts.collect::<Option<Vec<_>>>() {
                    Some(pairs) => {
                        let (ones, others) = pairs.into_iter().map(|[one, other]| (one, other)).unzip();
                        Value::Tuple(vec![Value::Array(ones), Value::Array(others)])
                    }
                    None => Value::Unknown,
                }
            }
            ("nth", [index]) => {
                let value = self.expression(index);
                match self.algebra.known_index(&value) {
                    Some(known) => items.into_iter().nth(known).map_or_else(Value::none, Value::some),
                    None => self.refuse_known(&value, *index, messages::index_unknown()),
                }
            }
            ("collect", []) => self.collected(call, items, expected),
            ("is_empty", []) => Value::Truth(Condition::Known(items.is_empty())),
            ("len" | "count", []) => self.algebra.whole(items.len()),
            ("rev", []) => Value::Sequence(items.into_iter().rev().collect()),
            ("enumerate", []) => {
                let numbered = items.into_iter().enumerate();
                Value::Sequence(numbered.map(|(i, item)| Value::Tuple(vec![self.algebra.whole(i), item])).collect())
            }
            ("zip", [other]) => self.zipped(Value::Sequence(items), other),
            ("chain", [_]) => {
                let items = items.into_iter().map(|item| (Condition::Known(true), item)).collect();
                self.filtered_method(items, call, expected)
            }
            ("skip" | "take" | "step_by" | "windows" | "chunks" | "chunks_exact", [count]) => {
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
                    ("chunks", n) => Value::Sequence(items.chunks(n).map(|part| Value::Array(part.to_vec())).collect()),
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
            ("flatten", []) => self.flattened(call, items),
            ("flat_map", [function]) => {
                let function = self.function_argument(function, 1)?;
                let mapped = self.mapped(call, &function, items);
                mapped.map_or(Value::Unknown, |values| self.flattened(call, values))
            }
            ("for_each", [function]) => self.for_each(call, function, items),
            ("fold", [start, function]) => {
                let mut value = self.expression_as(start, expected);
                let function = self.function_argument(function, 2)?;
                for item in items {
                    value = self.inline(&call.method, &function, vec![value, item]);
                }
                value
            }
            ("reduce", [function]) => {
                let function = self.function_argument(function, 2)?;
                let reduced =
                    items.into_iter().reduce(|value, item| self.inline(&call.method, &function, vec![value, item]));
                reduced.map_or_else(Value::none, Value::some)
            }
            ("min_by" | "max_by", [function]) => {
                let function = self.function_argument(function, 2)?;
                let best = items.into_iter().reduce(|best, item| self.better(call, &function, best, item));
                best.map_or_else(Value::none, Value::some)
            }
            ("any" | "all", [function]) => {
                let function = self.function_argument(function, 1)?;
                let start = Condition::Known(name == "all");
                let join = if name == "all" { Condition::and } else { Condition::or };
                let truths = self.mapped(call, &function, items)?;
                truths
                    .into_iter()
                    .try_fold(start, |truth, next| match next {
                        Value::Truth(next) => Some(join(truth, next)),
                        _ => None,
                    })
                    .map_or(Value::Unknown, Value::Truth)
            }
            ("next" | "first", []) => items.into_iter().next().map_or_else(Value::none, Value::some),
            ("last", []) => items.into_iter().last().map_or_else(Value::none, Value::some),
            ("sum" | "product", []) => self.total(call, items, expected),
            _ => {
                let known = if is_array {
                    lists::methods().chain([OF_ARRAYS, arrays::METHODS].concat()).collect()
                } else {
                    METHODS.to_vec()
                };
                self.refuse(&call.method, messages::unknown_method(&name, &receiver.describe(), &known))
            }
        })
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

    /// What `collect` makes of these: a list, or an option of one, which is there where all of them are.
    fn collected(&mut self, call: &ExprMethodCall, items: Vec<Value>, expected: &Expected) -> Value {
        let written = call.turbofish.as_ref().and_then(|of| match of.args.first() {
            Some(syn::GenericArgument::Type(ty)) => Some(self.expected(ty)),
            _ => None,
        });
        if items.iter().any(Value::is_unknown) {
            return Value::Unknown;
        }
        match written.as_ref().unwrap_or(expected) {
            Expected::Any | Expected::Array(..) => Value::Array(items),
            Expected::Optional => {
                let mut all = (Condition::Known(true), Vec::with_capacity(items.len()));
                for item in items {
                    let Value::Optional(optional) = item else { return Value::Unknown };
                    all.0 = all.0.and(optional.is_some.clone());
                    all.1.push(optional.value.clone());
                }
                match all {
                    (Condition::Known(false), _) => Value::none(),
                    (is_some, values) => Value::some_if(is_some, Value::Array(values)),
                }
            }
            _ => self.refuse(&call.method, messages::not_a_list()),
        }
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

    /// Pairs of what two iterators go over.
    pub(super) fn zipped(&mut self, one: Value, other: &Expr) -> Value {
        let others = match (strip(other), &one) {
            // As many numbers as are asked for.
            (
                Expr::Range(ExprRange { start: Some(start), end: None, .. }),
                Value::Sequence(items) | Value::Array(items),
            ) => {
                let first = self.expression(start);
                match self.algebra.known_integer(&first) {
                    Some(first) => {
                        Value::Sequence((first..).zip(items).map(|(n, _)| self.algebra.integer(n)).collect())
                    }
                    None => self.refuse_known(&first, start, messages::rounds_unknown()),
                }
            }
            _ => self.expression(other),
        };
        if one.is_unknown() || others.is_unknown() {
            return Value::Unknown;
        }
        match (one.items(), others.items()) {
            (Some(items), Some(others)) => {
                let pairs = items.into_iter().zip(others);
                Value::Sequence(pairs.map(|(a, b)| Value::Tuple(vec![a, b])).collect())
            }
            _ => self.refuse(other, messages::not_iterable("this")),
        }
    }

    /// The elements of the elements.
    fn flattened(&mut self, call: &ExprMethodCall, items: Vec<Value>) -> Value {
        let mut all = Vec::new();
        for item in items {
            let item = self.referenced(item);
            let kind = item.describe();
            match item.items() {
                Some(inner) => all.extend(inner),
                None => return self.refuse(&call.method, messages::not_iterable(&kind)),
            }
        }
        Value::Sequence(all)
    }

    /// Calls a function with each. A closure that is written there is the body of a loop, so that it may change variables.
    fn for_each(&mut self, call: &ExprMethodCall, function: &Expr, items: Vec<Value>) -> Value {
        match strip(function) {
            Expr::Closure(ExprClosure { capture: None, inputs, body, .. })
                if inputs.len() == 1 && !has_word(body.to_token_stream(), "return") =>
            {
                let parameter = &inputs[0];
                self.each(&call.method, None, items, |this, item| {
                    this.bind(parameter, item);
                    this.expression(body)
                })
            }
            function => {
                let Some(function) = self.function_argument(function, 1) else { return Value::Unknown };
                self.mapped(call, &function, items).map_or(Value::Unknown, |_| Value::nothing())
            }
        }
    }

    /// The one of two that a comparison prefers: of equal ones `min_by` takes the first, `max_by` the last.
    pub(super) fn better(&mut self, call: &ExprMethodCall, compare: &Rc<Callable>, best: Value, item: Value) -> Value {
        let order = match self.inline(&call.method, compare, vec![best.clone(), item.clone()]) {
            Value::Ordering(order) => order,
            other => return self.refuse_known(&other, &call.method, messages::not_an_ordering(&other.describe())),
        };
        let stays = if call.method == "min_by" { order.greater.clone().not() } else { order.greater.clone() };
        best.select(self.algebra, &stays, &item)
            .unwrap_or_else(|| self.refuse(&call.method, messages::branches_differ(&best.describe(), &item.describe())))
    }

    /// The sum or the product of all; of none, what its type has for that.
    pub(super) fn total(&mut self, call: &ExprMethodCall, items: Vec<Value>, expected: &Expected) -> Value {
        let name = call.method.to_string();
        let written = call.turbofish.as_ref().and_then(|of| match of.args.first() {
            Some(syn::GenericArgument::Type(ty)) => Some(self.expected(ty)),
            _ => None,
        });
        let expected = written.as_ref().unwrap_or(expected);
        if items.iter().any(Value::is_unknown) {
            return Value::Unknown;
        }
        let of_items = items.first().and_then(|first| self.type_name(first));
        let ty = expected.name().map(str::to_owned).or(of_items);
        if let Some(ty) = ty.filter(|ty| self.items.defines(ty)) {
            // As the struct says, by `Sum` or `Product`.
            return match self.functions(Some(&ty), &name).as_slice() {
                [only] => self.inline(&call.method, only, vec![Value::Sequence(items)]),
                [] => self.refuse(&call.method, messages::unknown_method(&name, &format!("`{ty}`"), &[])),
                _ => self.refuse(&call.method, messages::several_functions(&name)),
            };
        }
        let operator: syn::BinOp = if name == "sum" { syn::parse_quote!(+) } else { syn::parse_quote!(*) };
        let mut items = items.into_iter();
        let Some(mut total) = items.next() else {
            let neutral = expected.name().and_then(|ty| neutral(self.algebra, ty, name == "sum"));
            return neutral.unwrap_or_else(|| self.refuse(&call.method, messages::empty_sum(&name)));
        };
        for item in items {
            if total.is_unknown() {
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

/// Whether a word stands among these tokens.
fn has_word(tokens: TokenStream, word: &str) -> bool {
    let mut has = false;
    each_word(tokens, &mut |found| has |= found == word);
    has
}
