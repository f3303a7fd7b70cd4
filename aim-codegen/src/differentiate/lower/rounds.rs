//! [`Rounds`]: the sequences that kept loops iterate over: slices, ranges whose end depends on arguments, and iterators
//! over them. Elements are built when the loop is run, for the one iteration that stands for all.

use std::rc::Rc;

use aim_symbolic::{Function, Scalar};
use syn::{BinOp, Expr, ExprMethodCall, parse_quote};

use super::algebra::Algebra;
use super::condition::Condition;
use super::expected::Expected;
use super::frame::Target;
use super::iterators::ranks;
use super::outside::Outside;
use super::value::{Callable, Element, Items, Rounds, Slice, Value};
use super::{Translation, place_types, strip};
use crate::differentiate::messages;

/// Methods of slices of any length and of iterators over them.
pub(super) const METHODS: &[&str] = &[
    "len",
    "is_empty",
    "first",
    "last",
    "get",
    "split_first",
    "split_last",
    "split_at",
    "windows",
    "chunks_exact",
    "chunks",
    "iter",
    "copied",
    "cloned",
    "enumerate",
    "map",
    "filter",
    "filter_map",
    "take_while",
    "skip_while",
    "map_while",
    "zip",
    "rev",
    "cycle",
    "skip",
    "step_by",
    "take",
    "sum",
    "product",
    "fold",
    "reduce",
    "min_by",
    "max_by",
    "for_each",
    "count",
    "any",
    "all",
    "find",
    "position",
];

impl Rounds {
    pub(super) fn of(count: Scalar, items: Items) -> Self {
        Self { count, items: Rc::new(items) }
    }

    /// Iterates over `count` whole numbers from `first` on.
    pub(super) fn numbers(a: &mut Algebra, first: Scalar, count: Scalar) -> Self {
        let one = a.number(1.0);
        Self::of(count, Items::Numbers).stepped(count, first, one)
    }

    /// Iterates over the elements of a slice.
    pub(super) fn over(slice: Rc<Slice>) -> Self {
        Self::of(slice.len, Items::Elements(slice))
    }

    /// Iterates until something else ends the loop.
    pub(super) fn without_end(a: &mut Algebra) -> Self {
        Self::of(a.number(f64::INFINITY), Items::Nothing)
    }

    /// Repeats these elements without end; if there are none, there is no iteration.
    pub(super) fn cycled(self, a: &mut Algebra) -> Self {
        let (one, none, endless) = (a.number(1.0), a.number(0.0), a.number(f64::INFINITY));
        let count = Condition::less(a, self.count, one).select(a, none, endless);
        Self::of(count, Items::Cycled { items: self.items, len: self.count })
    }

    /// Selects `count` elements, those with the indices first + step k.
    pub(super) fn stepped(self, count: Scalar, first: Scalar, step: Scalar) -> Self {
        Self::of(count, Items::Stepped { items: self.items, first, step })
    }
}

/// Returns first + step k.
fn stepped(a: &mut Algebra, first: Scalar, step: Scalar, k: Scalar) -> Scalar {
    let more = a.mul(step, k);
    a.add(first, more)
}

impl Translation<'_> {
    /// Returns the element of an iteration of this loop; `None` after an error.
    pub(super) fn item_of_round(&mut self, items: &Items, number: usize) -> Option<Element> {
        let round = self.algebra.outside(Outside::Round(number));
        self.item_at(items, round)
    }

    fn item_at(&mut self, items: &Items, index: Scalar) -> Option<Element> {
        let value = match items {
            Items::Nothing => Value::nothing(),
            Items::Numbers => Value::Integer(index),
            Items::Elements(slice) => slice.element(self, index),
            Items::Parts { slice, size, step } => {
                let zero = self.algebra.number(0.0);
                let step = self.algebra.count(*step);
                let first = stepped(self.algebra, zero, step, index);
                let elements = (0..*size).map(|k| {
                    let k = self.algebra.count(k);
                    let index = self.algebra.add(first, k);
                    slice.element(self, index)
                });
                Value::Array(elements.collect())
            }
            Items::Chunks { slice, size } => {
                let first = self.algebra.mul(*size, index);
                let left = self.algebra.sub(slice.len, first);
                let len = self.smaller(*size, left);
                Value::Slice(Rc::new(slice.part(self.algebra, first, len)))
            }
            // Skipped elements are evaluated as well, so they must not have side effects.
            Items::Stepped { items, first, step } => {
                let index = stepped(self.algebra, *first, *step, index);
                self.item_aside(items, index)?
            }
            Items::Listed(all) => all.chosen(self.algebra, index).unwrap_or(Value::Unknown),
            Items::Cycled { items, len } => {
                let a = &mut *self.algebra;
                let turns = a.div(index, *len);
                let turns = a.call(Function::Floor, turns);
                let before = a.mul(*len, turns);
                let index = a.sub(index, before);
                self.item_aside(items, index)?
            }
            Items::Numbered(items) => Value::Tuple(vec![Value::Integer(index), self.item_at(items, index)?.value]),
            Items::Made(items, call, function) => {
                let item = self.item_at(items, index)?;
                return self.made_item(item, call, function);
            }
            // One of the two may be asked for an element once more at its end. That is not modelled, so neither may
            // have side effects.
            Items::Paired(both, call) => self.without_effect(call, |this| {
                let [one, other] = [&both[0], &both[1]].map(|items| this.item_at(items, index));
                Some(Value::Tuple(vec![one?.value, other?.value]))
            })?,
        };
        (!value.is_unknown()).then(|| Element::new(value))
    }

    /// Returns an element whose evaluation must not change variables.
    fn item_aside(&mut self, items: &Items, index: Scalar) -> Option<Value> {
        let made = |this: &mut Self| Some(this.item_at(items, index)?.value);
        match items.made_by() {
            Some(call) => self.without_effect(call, made),
            None => made(self),
        }
    }

    /// Pairs known elements with those of an iteration that leaves none out; `None` after an error.
    pub(super) fn with_each(
        &mut self,
        items: Vec<Element>,
        rounds: &Rounds,
        pair: impl Fn(Value, Value) -> Value,
    ) -> Option<Value> {
        let ranks = ranks(self.algebra, &items);
        let pairs = items.into_iter().zip(ranks).map(|(Element { is_there, value }, rank)| {
            let is_there = is_there.and(Condition::less(self.algebra, rank, rounds.count));
            let round = self.item_aside(&rounds.items, rank)?;
            Some(Element { is_there, value: pair(value, round) })
        });
        let pairs: Option<Vec<Element>> = pairs.collect();
        pairs.map(Value::iterator_of)
    }

    /// Returns the iteration without its first elements.
    fn without_first(&mut self, rounds: &Rounds, first: Scalar) -> Rounds {
        let (count, one) = (self.algebra.sub(rounds.count, first), self.algebra.number(1.0));
        rounds.clone().stepped(count, first, one)
    }

    /// Applies `map`, `filter`, `take_while` and the like to an element; `None` after an error.
    fn made_item(&mut self, item: Element, call: &ExprMethodCall, function: &Rc<Callable>) -> Option<Element> {
        let Element { is_there, value } = item.clone();
        let made = self.under(call, &is_there, |this| this.inline(&call.method, function, vec![value]));
        let (holds, value) = match made {
            value if call.method == "map" => return (!value.is_unknown()).then_some(Element { is_there, value }),
            Value::Truth(holds) => (holds, item.value),
            Value::Optional(made) => (made.is_some.clone(), made.value.clone()),
            other => {
                self.refuse_known(&other, &call.args, messages::not_a_condition(&other.describe()));
                return None;
            }
        };
        if call.method.to_string().ends_with("_while") {
            let ends = is_there.clone().and(holds.clone().not());
            self.leave_loop(call, ends, |_| {});
        }
        Some(Element { is_there: is_there.and(holds), value })
    }

    /// Leaves the innermost loop if a condition holds, after calling `act`.
    fn leave_loop(&mut self, call: &ExprMethodCall, holds: Condition, act: impl FnOnce(&mut Self)) -> Value {
        let whole = Target::Loop(self.frame.loops() - 1);
        let end = |this: &mut Self| {
            act(this);
            this.frame.exit(whole, Value::nothing());
            Value::Never
        };
        self.branch(&call.method, Some(holds), end, |_| Value::nothing())
    }

    /// Evaluates a method of a slice, or of an iterator over one; `None` for any other receiver.
    pub(super) fn rounds_method(
        &mut self,
        receiver: &Value,
        call: &ExprMethodCall,
        expected: &Expected,
    ) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let rounds = match (receiver, name.as_str(), arguments.as_slice()) {
            (Value::Slice(slice), ..) => {
                if let Some(value) = self.slice_method(slice, &name, &arguments) {
                    return value;
                }
                Rounds::over(slice.clone())
            }
            (Value::Rounds(rounds), ..) => (**rounds).clone(),
            _ => return None,
        };
        let errors = self.report.count();
        let consumed = self.consumed_rounds(&rounds, call, expected);
        if consumed.is_some() || self.report.count() > errors {
            return consumed;
        }
        let (is_whole, is_indexed) = (rounds.items.is_whole(), rounds.items.is_indexed());
        let made = match (name.as_str(), arguments.as_slice()) {
            ("iter" | "into_iter" | "copied" | "cloned" | "clone", []) => rounds,
            ("enumerate", []) if is_whole => Rounds::of(rounds.count, Items::Numbered(rounds.items)),
            ("map" | "filter" | "filter_map" | "take_while" | "map_while", [function]) => {
                let function = self.function_argument(function, 1)?;
                Rounds::of(rounds.count, Items::Made(rounds.items, call.clone(), function))
            }
            ("rev", []) if is_indexed => {
                let (count, one) = (rounds.count, self.algebra.number(1.0));
                let (last, back) = (self.algebra.sub(count, one), self.algebra.number(-1.0));
                rounds.stepped(count, last, back)
            }
            ("cycle", []) if is_indexed => rounds.cycled(self.algebra),
            ("skip", [count]) if is_indexed => {
                let first = self.count(count)?;
                self.without_first(&rounds, first)
            }
            ("skip_while", [function]) if is_indexed => {
                let function = self.function_argument(function, 1)?;
                let count = Value::Integer(rounds.count);
                let found = self.without_effect(call, |this| {
                    Some(this.sought(call, &rounds, count, |this, item| {
                        let holds = this.answer(call, &function, item)?;
                        Some((holds.not(), this.number_of_round()?))
                    }))
                })?;
                let Value::Integer(first) = found else { return Some(found) };
                self.without_first(&rounds, first)
            }
            ("step_by", [count]) if is_indexed => {
                let Some(more) = self.known_count(count)?.checked_sub(1) else {
                    return Some(self.refuse(*count, messages::index_outside("a step size")));
                };
                let step = more + 1;
                let (count, zero) = (self.parts(rounds.count, step, more), self.algebra.number(0.0));
                let step = self.algebra.count(step);
                rounds.stepped(count, zero, step)
            }
            ("take", [count]) if is_whole => {
                let count = self.count(count)?;
                let rounds = Rounds { count: self.smaller(rounds.count, count), ..rounds };
                match self.algebra.known_index(&Value::Integer(rounds.count)) {
                    Some(count) if is_indexed && rounds.items.is_listed() => {
                        let items = (0..count).map(|index| {
                            let index = self.algebra.count(index);
                            self.item_at(&rounds.items, index)
                        });
                        return Some(Value::iterator_of(items.collect::<Option<Vec<_>>>()?));
                    }
                    _ => rounds,
                }
            }
            ("zip", [other]) if is_whole => {
                let other = match strip(other) {
                    Expr::Range(range) if range.end.is_none() => None,
                    other => Some(self.expression(other)),
                };
                let other = match other {
                    Some(Value::Slice(slice)) => Rounds::over(slice),
                    Some(Value::Rounds(other)) if other.items.is_whole() => (*other).clone(),
                    Some(other) if is_indexed => {
                        let items = self.items_of(&call.args, other)?;
                        return self.with_each(items, &rounds, |item, round| Value::Tuple(vec![round, item]));
                    }
                    Some(other) => return Some(self.refuse_known(&other, &call.args, messages::zip_of_kept_loop())),
                    None => return Some(self.refuse(&call.args, messages::zip_of_kept_loop())),
                };
                let count = self.smaller(rounds.count, other.count);
                Rounds::of(count, Items::Paired([rounds.items, other.items], call.clone()))
            }
            _ => {
                let of_slice = matches!(*rounds.items, Items::Elements(_));
                let kind = if of_slice { "a slice" } else { "an iterator of unknown length" };
                return Some(self.refuse(&call.method, messages::unknown_method(&name, kind, METHODS)));
            }
        };
        Some(Value::Rounds(Rc::new(made)))
    }

    /// Evaluates a method that consumes all elements; `None` if it is another one, or after an error.
    fn consumed_rounds(&mut self, rounds: &Rounds, call: &ExprMethodCall, expected: &Expected) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        Some(match (name.as_str(), arguments.as_slice()) {
            ("for_each", [function]) => {
                let function = self.function_argument(function, 1)?;
                self.kept_loop(&call.method, None, rounds, |this, item| {
                    this.inline(&call.method, &function, vec![item])
                })
            }
            ("fold", [start, function]) => {
                let start = self.expression_as(start, expected);
                let function = self.function_argument(function, 2)?;
                self.gathered(call, rounds, start, |this, folded, item| {
                    this.inline(&call.method, &function, vec![folded, item])
                })
            }
            ("reduce", [function]) => {
                let function = self.function_argument(function, 2)?;
                self.best(call, rounds, |this, best, item| this.inline(&call.method, &function, vec![best, item]))
            }
            ("min_by" | "max_by", [function]) => {
                let function = self.function_argument(function, 2)?;
                self.best(call, rounds, |this, best, item| this.better(call, &function, best, item))
            }
            ("last", []) => self.best(call, rounds, |_, _, item| item),
            ("sum" | "product", []) => {
                let expected = self.expected_of_call(call, expected);
                let of_items = if expected.name().is_none() { self.type_of_items(rounds)? } else { None };
                let ty = expected.name().or(of_items.as_deref());
                let neutral = ty.and_then(|ty| place_types::neutral(self.algebra, ty, name == "sum"));
                let Some(neutral) = neutral else { return Some(self.refuse(&call.method, messages::empty_sum(&name))) };
                let operator: BinOp = if name == "sum" { parse_quote!(+) } else { parse_quote!(*) };
                self.gathered(call, rounds, neutral, |this, total, item| {
                    this.operation(&call.method, &operator, &total, &item)
                })
            }
            ("count" | "len", []) => {
                let (zero, one) = (self.algebra.integer(0), self.algebra.integer(1));
                self.gathered(call, rounds, zero, |this, total, _| {
                    this.operation(&call.method, &parse_quote!(+), &total, &one)
                })
            }
            ("any" | "all", [function]) => {
                let (function, is_any) = (self.function_argument(function, 1)?, name == "any");
                let truth = |known| Value::Truth(Condition::Known(known));
                self.sought(call, rounds, truth(!is_any), |this, item| {
                    let holds = this.answer(call, &function, item)?;
                    Some((if is_any { holds } else { holds.not() }, truth(is_any)))
                })
            }
            ("find", [function]) => {
                let function = self.function_argument(function, 1)?;
                self.sought(call, rounds, Value::none(), |this, item| {
                    Some((this.answer(call, &function, item.clone())?, Value::some(item)))
                })
            }
            ("position", [function]) if rounds.items.is_whole() => {
                let function = self.function_argument(function, 1)?;
                self.sought(call, rounds, Value::none(), |this, item| {
                    let round = this.number_of_round()?;
                    Some((this.answer(call, &function, item)?, Value::some(round)))
                })
            }
            _ => return None,
        })
    }

    /// Returns the index of the innermost loop's iteration, from 0.
    fn number_of_round(&mut self) -> Option<Value> {
        let number = *self.kept.last()?;
        Some(Value::Integer(self.algebra.outside(Outside::Round(number))))
    }

    /// Returns the result of a predicate for an element; `None` after an error.
    fn answer(&mut self, call: &ExprMethodCall, function: &Rc<Callable>, item: Value) -> Option<Condition> {
        match self.inline(&call.method, function, vec![item]) {
            Value::Truth(holds) => Some(holds),
            other => {
                self.refuse_known(&other, &call.args, messages::not_a_condition(&other.describe()));
                None
            }
        }
    }

    /// Returns the type of the elements, determined by building one; `None` after an error.
    #[expect(clippy::option_option, reason = "a type without a name is no error")]
    fn type_of_items(&mut self, rounds: &Rounds) -> Option<Option<String>> {
        let (frame, mark) = (self.frame.clone(), self.mark());
        self.frame.begin(Target::Loop(self.frame.loops()), None);
        let number = self.begin_kept_loop(rounds.count);
        let item = self.item_of_round(&rounds.items, number);
        self.kept.pop();
        self.frame = frame;
        self.take_back(mark);
        item.map(|item| self.type_name(&item.value))
    }

    /// Folds the elements: each iteration computes a value from that of the previous one.
    fn gathered(
        &mut self,
        call: &ExprMethodCall,
        rounds: &Rounds,
        start: Value,
        mut next: impl FnMut(&mut Self, Value, Value) -> Value,
    ) -> Value {
        self.with_variable(call, rounds, start, |this, variable, item| {
            let before = this.frame.value(variable).clone();
            let next = next(this, before, item);
            if next.is_unknown() {
                return next;
            }
            this.frame.assign(variable, next);
            Value::nothing()
        })
    }

    /// Folds like [`gathered`](Self::gathered), with an option that holds the first element after the first iteration.
    fn best(
        &mut self,
        call: &ExprMethodCall,
        rounds: &Rounds,
        mut next: impl FnMut(&mut Self, Value, Value) -> Value,
    ) -> Value {
        self.gathered(call, rounds, Value::none(), |this, best, item| {
            let Value::Optional(best) = best else { return Value::Unknown };
            let there = |this: &mut Self| next(this, best.value.clone(), item.clone());
            let made = this.branch(&call.method, Some(best.is_some.clone()), there, |_| item.clone());
            if made.is_unknown() { made } else { Value::some(made) }
        })
    }

    /// Returns the value of the first iteration in which a condition holds, or else `start`.
    fn sought(
        &mut self,
        call: &ExprMethodCall,
        rounds: &Rounds,
        start: Value,
        mut ask: impl FnMut(&mut Self, Value) -> Option<(Condition, Value)>,
    ) -> Value {
        self.with_variable(call, rounds, start, |this, variable, item| {
            let Some((holds, found)) = ask(this, item) else { return Value::Unknown };
            this.leave_loop(call, holds, |this| this.frame.assign(variable, found))
        })
    }

    /// Runs iterations that change an unnamed variable, and returns its final value.
    fn with_variable(
        &mut self,
        call: &ExprMethodCall,
        rounds: &Rounds,
        start: Value,
        mut round: impl FnMut(&mut Self, usize, Value) -> Value,
    ) -> Value {
        let variable = self.frame.depth();
        self.frame.declare(String::new(), start);
        let done = self.kept_loop(&call.method, None, rounds, |this, item| round(this, variable, item));
        let made = self.frame.value(variable).clone();
        self.frame.leave(variable);
        if done.is_unknown() { done } else { made }
    }

    fn smaller(&mut self, x: Scalar, y: Scalar) -> Scalar {
        Condition::less(self.algebra, x, y).select(self.algebra, x, y)
    }
}
