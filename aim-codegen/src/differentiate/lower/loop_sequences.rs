//! [`LoopSequence`]: the sequences that kept loops iterate over: slices, ranges whose end depends on arguments, and iterators
//! over them. Elements are built when the loop is run, for the one iteration that stands for all.

use std::rc::Rc;

use aim_symbolic::{Function, Scalar};
use syn::{BinOp, Expr, ExprMethodCall, parse_quote};

use super::algebra::Algebra;
use super::condition::Condition;
use super::expected::Expected;
use super::extra_inputs::ExtraInput;
use super::frame::Target;
use super::iterators::ranks;
use super::value::{Callable, Element, LoopSequence, SequenceItems, Slice, Value};
use super::{Translation, methods, place_types, strip};
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

impl LoopSequence {
    pub(super) fn of(count: Scalar, items: SequenceItems) -> Self {
        Self { count, items: Rc::new(items) }
    }

    /// Iterates over `count` whole numbers from `first` on.
    pub(super) fn numbers(a: &mut Algebra, first: Scalar, count: Scalar) -> Self {
        let one = a.number(1.0);
        Self::of(count, SequenceItems::Numbers).stepped(count, first, one)
    }

    /// Iterates over the elements of a slice.
    pub(super) fn over(slice: Rc<Slice>) -> Self {
        Self::of(slice.len, SequenceItems::Elements(slice))
    }

    /// Iterates until something else ends the loop.
    pub(super) fn without_end(a: &mut Algebra) -> Self {
        Self::of(a.number(f64::INFINITY), SequenceItems::Nothing)
    }

    /// Repeats these elements without end; if there are none, there is no iteration.
    pub(super) fn cycled(self, a: &mut Algebra) -> Self {
        let (one, none, endless) = (a.number(1.0), a.number(0.0), a.number(f64::INFINITY));
        let count = Condition::less(a, self.count, one).select(a, none, endless);
        Self::of(count, SequenceItems::Cycled { items: self.items, len: self.count })
    }

    /// Selects `count` elements, those with the indices first + step k.
    pub(super) fn stepped(self, count: Scalar, first: Scalar, step: Scalar) -> Self {
        Self::of(count, SequenceItems::Stepped { items: self.items, first, step })
    }
}

/// Returns first + step k.
fn stepped(a: &mut Algebra, first: Scalar, step: Scalar, k: Scalar) -> Scalar {
    let more = a.mul(step, k);
    a.add(first, more)
}

impl Translation<'_> {
    /// Returns the element of an iteration of this loop; `None` after an error.
    pub(super) fn item_of_iteration(&mut self, items: &SequenceItems, number: usize) -> Option<Element> {
        let iteration = self.algebra.extra_input(ExtraInput::Iteration(number));
        self.item_at(items, iteration)
    }

    fn item_at(&mut self, items: &SequenceItems, index: Scalar) -> Option<Element> {
        let value = match items {
            SequenceItems::Nothing => Value::nothing(),
            SequenceItems::Numbers => Value::Integer(index),
            SequenceItems::Elements(slice) => slice.element(self, index),
            SequenceItems::Parts { slice, size, step } => {
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
            SequenceItems::Chunks { slice, size } => {
                let first = self.algebra.mul(*size, index);
                let left = self.algebra.sub(slice.len, first);
                let len = self.smaller(*size, left);
                Value::Slice(Rc::new(slice.part(self.algebra, first, len)))
            }
            // Skipped elements are evaluated as well, so they must not have side effects.
            SequenceItems::Stepped { items, first, step } => {
                let index = stepped(self.algebra, *first, *step, index);
                self.item_without_effect(items, index)?
            }
            SequenceItems::Listed(all) => all.select_element(self.algebra, index).unwrap_or(Value::Unknown),
            SequenceItems::Cycled { items, len } => {
                let a = &mut *self.algebra;
                let turns = a.div(index, *len);
                let turns = a.call(Function::Floor, turns);
                let before = a.mul(*len, turns);
                let index = a.sub(index, before);
                self.item_without_effect(items, index)?
            }
            SequenceItems::Numbered(items) => {
                Value::Tuple(vec![Value::Integer(index), self.item_at(items, index)?.value])
            }
            SequenceItems::Adapted(items, call, function) => {
                let item = self.item_at(items, index)?;
                return self.call_for_item(item, call, function);
            }
            // One of the two may be asked for an element once more at its end. That is not modelled, so neither may
            // have side effects.
            SequenceItems::Paired(both, call) => self.without_effect(call, |this| {
                let [one, other] = [&both[0], &both[1]].map(|items| this.item_at(items, index));
                Some(Value::Tuple(vec![one?.value, other?.value]))
            })?,
        };
        (!value.is_unknown()).then(|| Element::new(value))
    }

    /// Returns an element whose evaluation must not change variables.
    fn item_without_effect(&mut self, items: &SequenceItems, index: Scalar) -> Option<Value> {
        let made = |this: &mut Self| Some(this.item_at(items, index)?.value);
        match items.adapting_call() {
            Some(call) => self.without_effect(call, made),
            None => made(self),
        }
    }

    /// Pairs known elements with those of an iteration that leaves none out; `None` after an error.
    pub(super) fn zip_with_items(
        &mut self,
        items: Vec<Element>,
        sequence: &LoopSequence,
        pair: impl Fn(Value, Value) -> Value,
    ) -> Option<Value> {
        let ranks = ranks(self.algebra, &items);
        let pairs = items.into_iter().zip(ranks).map(|(Element { is_there, value }, rank)| {
            let is_there = is_there.and(Condition::less(self.algebra, rank, sequence.count));
            let iteration = self.item_without_effect(&sequence.items, rank)?;
            Some(Element { is_there, value: pair(value, iteration) })
        });
        let pairs: Option<Vec<Element>> = pairs.collect();
        pairs.map(Value::iterator_of)
    }

    /// Returns the iteration without its first elements.
    fn without_first(&mut self, sequence: &LoopSequence, first: Scalar) -> LoopSequence {
        let (count, one) = (self.algebra.sub(sequence.count, first), self.algebra.number(1.0));
        sequence.clone().stepped(count, first, one)
    }

    /// Applies `map`, `filter`, `take_while` and the like to an element; `None` after an error.
    fn call_for_item(&mut self, item: Element, call: &ExprMethodCall, function: &Rc<Callable>) -> Option<Element> {
        let Element { is_there, value } = item.clone();
        let made = self.run_under(call, &is_there, |this| this.inline(&call.method, function, vec![value]));
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
        let whole = Target::Loop(self.frame.loop_depth() - 1);
        let end = |this: &mut Self| {
            act(this);
            this.frame.exit(whole, Value::nothing());
            Value::Never
        };
        self.branch(&call.method, Some(holds), end, |_| Value::nothing())
    }

    /// Evaluates a method of a slice, or of an iterator over one; `None` for any other receiver.
    pub(super) fn loop_sequence_method(
        &mut self,
        receiver: &Value,
        call: &ExprMethodCall,
        expected: &Expected,
    ) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let sequence = match (receiver, name.as_str(), arguments.as_slice()) {
            (Value::Slice(slice), ..) => {
                if let Some(value) = self.slice_method(slice, &name, &arguments) {
                    return value;
                }
                LoopSequence::over(slice.clone())
            }
            (Value::LoopSequence(sequence), ..) => (**sequence).clone(),
            _ => return None,
        };
        let errors = self.report.count();
        let consumed = self.consuming_method(&sequence, call, expected);
        if consumed.is_some() || self.report.count() > errors {
            return consumed;
        }
        let (is_whole, is_indexed) = (sequence.items.is_whole(), sequence.items.is_indexed());
        let made = match (name.as_str(), arguments.as_slice()) {
            ("iter" | "into_iter" | "copied" | "cloned" | "clone", []) => sequence,
            ("enumerate", []) if is_whole => LoopSequence::of(sequence.count, SequenceItems::Numbered(sequence.items)),
            ("map" | "filter" | "filter_map" | "take_while" | "map_while", [function]) => {
                let function = self.function_argument(function, 1)?;
                LoopSequence::of(sequence.count, SequenceItems::Adapted(sequence.items, call.clone(), function))
            }
            ("rev", []) if is_indexed => {
                let (count, one) = (sequence.count, self.algebra.number(1.0));
                let (last, back) = (self.algebra.sub(count, one), self.algebra.number(-1.0));
                sequence.stepped(count, last, back)
            }
            ("cycle", []) if is_indexed => sequence.cycled(self.algebra),
            ("skip", [count]) if is_indexed => {
                let first = self.count(count)?;
                self.without_first(&sequence, first)
            }
            ("skip_while", [function]) if is_indexed => {
                let function = self.function_argument(function, 1)?;
                let count = Value::Integer(sequence.count);
                let found = self.without_effect(call, |this| {
                    Some(this.find_first(call, &sequence, count, |this, item| {
                        let holds = this.predicate_holds(call, &function, item)?;
                        Some((holds.not(), this.iteration_index()?))
                    }))
                })?;
                let Value::Integer(first) = found else { return Some(found) };
                self.without_first(&sequence, first)
            }
            ("step_by", [count]) if is_indexed => {
                let Some(more) = self.known_count(count)?.checked_sub(1) else {
                    return Some(self.refuse(*count, messages::index_outside("a step size")));
                };
                let step = more + 1;
                let (count, zero) = (self.parts(sequence.count, step, more), self.algebra.number(0.0));
                let step = self.algebra.count(step);
                sequence.stepped(count, zero, step)
            }
            ("take", [count]) if is_whole => {
                let count = self.count(count)?;
                let sequence = LoopSequence { count: self.smaller(sequence.count, count), ..sequence };
                match self.algebra.known_index(&Value::Integer(sequence.count)) {
                    Some(count) if is_indexed && sequence.items.is_listed() => {
                        let items = (0..count).map(|index| {
                            let index = self.algebra.count(index);
                            self.item_at(&sequence.items, index)
                        });
                        return Some(Value::iterator_of(items.collect::<Option<Vec<_>>>()?));
                    }
                    _ => sequence,
                }
            }
            ("zip", [other]) if is_whole => {
                let other = match strip(other) {
                    Expr::Range(range) if range.end.is_none() => None,
                    other => Some(self.expression(other)),
                };
                let other = match other {
                    Some(Value::Slice(slice)) => LoopSequence::over(slice),
                    Some(Value::LoopSequence(other)) if other.items.is_whole() => (*other).clone(),
                    Some(other) if is_indexed => {
                        let items = self.items_of(&call.args, other)?;
                        return self
                            .zip_with_items(items, &sequence, |item, iteration| Value::Tuple(vec![iteration, item]));
                    }
                    Some(other) => return Some(self.refuse_known(&other, &call.args, messages::zip_of_kept_loop())),
                    None => return Some(self.refuse(&call.args, messages::zip_of_kept_loop())),
                };
                let count = self.smaller(sequence.count, other.count);
                LoopSequence::of(count, SequenceItems::Paired([sequence.items, other.items], call.clone()))
            }
            _ => {
                let of_slice = matches!(*sequence.items, SequenceItems::Elements(_));
                let kind = if of_slice { "a slice" } else { "an iterator of unknown length" };
                return Some(self.refuse(&call.method, methods::unknown_method(&name, kind, METHODS)));
            }
        };
        Some(Value::LoopSequence(Rc::new(made)))
    }

    /// Evaluates a method that consumes all elements; `None` if it is another one, or after an error.
    fn consuming_method(
        &mut self,
        sequence: &LoopSequence,
        call: &ExprMethodCall,
        expected: &Expected,
    ) -> Option<Value> {
        let name = call.method.to_string();
        let arguments: Vec<&Expr> = call.args.iter().collect();
        Some(match (name.as_str(), arguments.as_slice()) {
            ("for_each", [function]) => {
                let function = self.function_argument(function, 1)?;
                self.run_kept_loop(&call.method, None, sequence, |this, item| {
                    this.inline(&call.method, &function, vec![item])
                })
            }
            ("fold", [start, function]) => {
                let start = self.expression_as(start, expected);
                let function = self.function_argument(function, 2)?;
                self.fold_items(call, sequence, start, |this, folded, item| {
                    this.inline(&call.method, &function, vec![folded, item])
                })
            }
            ("reduce", [function]) => {
                let function = self.function_argument(function, 2)?;
                self.reduce_items(call, sequence, |this, best, item| {
                    this.inline(&call.method, &function, vec![best, item])
                })
            }
            ("min_by" | "max_by", [function]) => {
                let function = self.function_argument(function, 2)?;
                self.reduce_items(call, sequence, |this, best, item| this.better(call, &function, best, item))
            }
            ("last", []) => self.reduce_items(call, sequence, |_, _, item| item),
            ("sum" | "product", []) => {
                let expected = self.expected_of_call(call, expected);
                let of_items = if expected.name().is_none() { self.type_of_items(sequence)? } else { None };
                let ty = expected.name().or(of_items.as_deref());
                let neutral = ty.and_then(|ty| place_types::neutral(self.algebra, ty, name == "sum"));
                let Some(neutral) = neutral else { return Some(self.refuse(&call.method, messages::empty_sum(&name))) };
                let operator: BinOp = if name == "sum" { parse_quote!(+) } else { parse_quote!(*) };
                self.fold_items(call, sequence, neutral, |this, total, item| {
                    this.operation(&call.method, &operator, &total, &item)
                })
            }
            ("count" | "len", []) => {
                let (zero, one) = (self.algebra.integer(0), self.algebra.integer(1));
                self.fold_items(call, sequence, zero, |this, total, _| {
                    this.operation(&call.method, &parse_quote!(+), &total, &one)
                })
            }
            ("any" | "all", [function]) => {
                let (function, is_any) = (self.function_argument(function, 1)?, name == "any");
                let truth = |known| Value::Truth(Condition::Known(known));
                self.find_first(call, sequence, truth(!is_any), |this, item| {
                    let holds = this.predicate_holds(call, &function, item)?;
                    Some((if is_any { holds } else { holds.not() }, truth(is_any)))
                })
            }
            ("find", [function]) => {
                let function = self.function_argument(function, 1)?;
                self.find_first(call, sequence, Value::none(), |this, item| {
                    Some((this.predicate_holds(call, &function, item.clone())?, Value::some(item)))
                })
            }
            ("position", [function]) if sequence.items.is_whole() => {
                let function = self.function_argument(function, 1)?;
                self.find_first(call, sequence, Value::none(), |this, item| {
                    let iteration = this.iteration_index()?;
                    Some((this.predicate_holds(call, &function, item)?, Value::some(iteration)))
                })
            }
            _ => return None,
        })
    }

    /// Returns the index of the innermost loop's iteration, from 0.
    fn iteration_index(&mut self) -> Option<Value> {
        let number = *self.open_kept_loops.last()?;
        Some(Value::Integer(self.algebra.extra_input(ExtraInput::Iteration(number))))
    }

    /// Returns the result of a predicate for an element; `None` after an error.
    fn predicate_holds(&mut self, call: &ExprMethodCall, function: &Rc<Callable>, item: Value) -> Option<Condition> {
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
    fn type_of_items(&mut self, sequence: &LoopSequence) -> Option<Option<String>> {
        let (frame, progress) = (self.frame.clone(), self.progress());
        self.frame.begin_region(Target::Loop(self.frame.loop_depth()), None);
        let number = self.begin_kept_loop(sequence.count);
        let item = self.item_of_iteration(&sequence.items, number);
        self.open_kept_loops.pop();
        self.frame = frame;
        self.roll_back(progress);
        item.map(|item| self.type_name(&item.value))
    }

    /// Folds the elements: each iteration computes a value from that of the previous one.
    fn fold_items(
        &mut self,
        call: &ExprMethodCall,
        sequence: &LoopSequence,
        start: Value,
        mut next: impl FnMut(&mut Self, Value, Value) -> Value,
    ) -> Value {
        self.with_variable(call, sequence, start, |this, variable, item| {
            let before = this.frame.value(variable).clone();
            let next = next(this, before, item);
            if next.is_unknown() {
                return next;
            }
            this.frame.assign(variable, next);
            Value::nothing()
        })
    }

    /// Folds like [`fold_items`](Self::gathered), with an option that holds the first element after the first iteration.
    fn reduce_items(
        &mut self,
        call: &ExprMethodCall,
        sequence: &LoopSequence,
        mut next: impl FnMut(&mut Self, Value, Value) -> Value,
    ) -> Value {
        self.fold_items(call, sequence, Value::none(), |this, best, item| {
            let Value::Optional(best) = best else { return Value::Unknown };
            let there = |this: &mut Self| next(this, best.value.clone(), item.clone());
            let made = this.branch(&call.method, Some(best.is_some.clone()), there, |_| item.clone());
            if made.is_unknown() { made } else { Value::some(made) }
        })
    }

    /// Returns the value of the first iteration in which a condition holds, or else `start`.
    fn find_first(
        &mut self,
        call: &ExprMethodCall,
        sequence: &LoopSequence,
        start: Value,
        mut ask: impl FnMut(&mut Self, Value) -> Option<(Condition, Value)>,
    ) -> Value {
        self.with_variable(call, sequence, start, |this, variable, item| {
            let Some((holds, found)) = ask(this, item) else { return Value::Unknown };
            this.leave_loop(call, holds, |this| this.frame.assign(variable, found))
        })
    }

    /// Runs iterations that change an unnamed variable, and returns its final value.
    fn with_variable(
        &mut self,
        call: &ExprMethodCall,
        sequence: &LoopSequence,
        start: Value,
        mut iteration: impl FnMut(&mut Self, usize, Value) -> Value,
    ) -> Value {
        let variable = self.frame.depth();
        self.frame.declare(String::new(), start);
        let done = self.run_kept_loop(&call.method, None, sequence, |this, item| iteration(this, variable, item));
        let made = self.frame.value(variable).clone();
        self.frame.end_scope(variable);
        if done.is_unknown() { done } else { made }
    }

    fn smaller(&mut self, x: Scalar, y: Scalar) -> Scalar {
        Condition::less(self.algebra, x, y).select(self.algebra, x, y)
    }
}
