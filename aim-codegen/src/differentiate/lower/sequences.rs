//! Iterators: those over arrays and ranges, whose elements are all known by number.

use std::rc::Rc;

use proc_macro2::{TokenStream, TokenTree};
use quote::ToTokens;
use syn::{Expr, ExprClosure, ExprMethodCall, ExprRange, RangeLimits};

use super::condition::Condition;
use super::expected::Expected;
use super::place_types::neutral;
use super::value::{Callable, Value};
use super::{Translation, operators, strip};
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
    "for_each",
    "fold",
    "reduce",
    "min_by",
    "max_by",
    "any",
    "all",
    "next",
    "last",
    "sum",
    "product",
    "windows",
    "chunks",
    "chunks_exact",
    "len",
];

/// Those of them that arrays have, too.
const OF_ARRAYS: &[&str] = &["iter", "into_iter", "map", "windows", "chunks", "chunks_exact", "first", "last", "len"];

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
            ("next" | "any" | "all", _) if !is_array && is_place(&call.receiver) => {
                self.refuse(&call.method, messages::iterator_kept(&name))
            }
            ("iter" | "into_iter" | "copied" | "cloned", []) => Value::Sequence(items),
            ("clone" | "as_slice" | "as_ref" | "into" | "to_owned", []) => receiver.clone(),
            ("len" | "count", []) => self.algebra.whole(items.len()),
            ("rev", []) => Value::Sequence(items.into_iter().rev().collect()),
            ("enumerate", []) => {
                let numbered = items.into_iter().enumerate();
                Value::Sequence(numbered.map(|(i, item)| Value::Tuple(vec![self.algebra.whole(i), item])).collect())
            }
            ("zip", [other]) => self.zipped(Value::Sequence(items), other),
            ("chain", [other]) => match self.expression(other).items() {
                Some(others) => Value::Sequence(items.into_iter().chain(others).collect()),
                None => self.refuse(*other, messages::not_iterable("this")),
            },
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
            ("filter", [function]) => self.filtered(function, items),
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

    /// Pairs of what two iterators go over.
    pub(super) fn zipped(&mut self, one: Value, other: &Expr) -> Value {
        let others = self.expression(other);
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

    /// The elements for which a condition holds, which has to be known.
    fn filtered(&mut self, function: &Expr, items: Vec<Value>) -> Value {
        let Some(condition) = self.function_argument(function, 1) else { return Value::Unknown };
        let mut left = Vec::new();
        for item in items {
            match self.inline(function, &condition, vec![item.clone()]) {
                Value::Truth(Condition::Known(true)) => left.push(item),
                Value::Truth(Condition::Known(false)) => {}
                other => return self.refuse_known(&other, function, messages::filter_unknown()),
            }
        }
        Value::Sequence(left)
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
    fn better(&mut self, call: &ExprMethodCall, compare: &Rc<Callable>, best: Value, item: Value) -> Value {
        let order = match self.inline(&call.method, compare, vec![best.clone(), item.clone()]) {
            Value::Ordering(order) => order,
            other => return self.refuse_known(&other, &call.method, messages::not_an_ordering(&other.describe())),
        };
        let stays = if call.method == "min_by" { order.greater.clone().not() } else { order.greater.clone() };
        best.select(self.algebra, &stays, &item)
            .unwrap_or_else(|| self.refuse(&call.method, messages::branches_differ(&best.describe(), &item.describe())))
    }

    /// The sum or the product of all; of none, what its type has for that.
    fn total(&mut self, call: &ExprMethodCall, items: Vec<Value>, expected: &Expected) -> Value {
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
        if let Some(ty) = ty.filter(|ty| self.items.structure(ty).is_some()) {
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

/// Whether an expression is a variable or a part of one.
fn is_place(expression: &Expr) -> bool {
    match strip(expression) {
        Expr::Path(_) => true,
        Expr::Field(field) => is_place(&field.base),
        Expr::Index(index) => is_place(&index.expr),
        Expr::Unary(unary) => is_place(&unary.expr),
        Expr::Reference(reference) => is_place(&reference.expr),
        _ => false,
    }
}

/// Whether a word stands among these tokens.
fn has_word(tokens: TokenStream, word: &str) -> bool {
    tokens.into_iter().any(|token| match token {
        TokenTree::Group(group) => has_word(group.stream(), word),
        TokenTree::Ident(found) => found == word,
        _ => false,
    })
}
