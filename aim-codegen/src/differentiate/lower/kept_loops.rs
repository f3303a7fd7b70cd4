//! Kept loops: loops over slices, and up to whole numbers without a known bound. A single iteration is run and stands
//! for all of them: the variables that it changes are inputs, and their values at its end are those that the next
//! iteration begins with.

use std::rc::Rc;

use aim_symbolic::Scalar;
use quote::ToTokens;
use syn::{ExprForLoop, ExprLoop, ExprWhile, Label};

use super::algebra::Algebra;
use super::condition::Condition;
use super::enums::TAG;
use super::extra_inputs::{ExtraInput, KeptLoop, State};
use super::frame::{Exit, Target};
use super::map::{Affine, Map, Quaternion};
use super::value::{Element, LoopSequence, Optional, Slice, Struct, Value};
use super::{Translation, columns};
use crate::differentiate::messages;

/// The ways in which an iteration ends the loop.
struct LoopExits {
    /// Condition of leaving the loop, and the value that it is left with.
    exit_condition: Condition,
    break_value: Value,
    /// Exits to targets outside the loop.
    exits: Vec<Exit>,
}

/// Kind of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Number,
    Whole,
    Flag,
}

impl Value {
    /// Returns the numbers of a value; `None` if it contains anything else.
    fn numbers(&self, a: &mut Algebra) -> Option<Vec<(Scalar, Kind)>> {
        let each = |values: &[&Self], a: &mut Algebra| {
            let numbers: Option<Vec<_>> = values.iter().map(|value| value.numbers(a)).collect();
            Some(numbers?.concat())
        };
        let plain = |numbers: &[Scalar]| Some(numbers.iter().map(|&number| (number, Kind::Number)).collect());
        match self {
            Self::Scalar(x) => plain(&[*x]),
            Self::Integer(x) => Some(vec![(*x, Kind::Whole)]),
            Self::Truth(condition) => Some(vec![(a.number_of(condition), Kind::Flag)]),
            Self::Planar(v) => plain(&a.parts(*v)[..2]),
            Self::Vector(v) => plain(&a.parts(*v)),
            Self::Four(parts) => plain(parts),
            Self::Quaternion(q) => {
                let (u, w) = q.parts;
                plain(&[a.parts(u).as_slice(), &[w]].concat())
            }
            Self::Matrix(m) => {
                let columns = m.columns(a).map(|column| a.parts(column));
                plain(columns.as_flattened())
            }
            Self::Square(columns) => plain(&columns.concat()),
            Self::Homogeneous(_) => plain(&columns(a, self)?.concat()),
            Self::Affine(m) => {
                let columns = m.map.columns(a).into_iter().chain([m.translation]).map(|column| a.parts(column));
                plain(columns.collect::<Vec<_>>().as_flattened())
            }
            Self::Tuple(values) | Self::Array(values) => each(&values.iter().collect::<Vec<_>>(), a),
            Self::Struct(of) => each(&of.fields.iter().map(|(_, value)| value).collect::<Vec<_>>(), a),
            Self::List(items) => {
                let flags = items.iter().map(|item| Self::Truth(item.is_there.clone()));
                let parts: Vec<Self> = flags.zip(items).flat_map(|(flag, item)| [flag, item.value.clone()]).collect();
                each(&parts.iter().collect::<Vec<_>>(), a)
            }
            Self::Slice(slice) => Some(vec![(slice.first, Kind::Whole), (slice.len, Kind::Whole)]),
            // Never assigned: the option is always `None`.
            Self::Optional(optional) if optional.value.is_never() => Some(Vec::new()),
            Self::Optional(optional) => each(&[&Self::Truth(optional.is_some.clone()), &optional.value], a),
            Self::Never => Some(Vec::new()),
            _ => None,
        }
    }

    /// Fills absent parts of options and enums with the shape of `other`, made of zeros.
    fn shaped_like(&self, a: &mut Algebra, other: &Self) -> Self {
        match (self, other) {
            (Self::Never, Self::Never) => Self::Never,
            (Self::Never, inner) => {
                let zero = a.number(0.0);
                inner.of_numbers(a, &mut core::iter::repeat(zero)).unwrap_or(Self::Never)
            }
            (Self::Optional(one), Self::Optional(other)) => {
                let value = one.value.shaped_like(a, &other.value);
                Self::Optional(Rc::new(Optional { is_some: one.is_some.clone(), value }))
            }
            (Self::Struct(of), Self::Struct(other)) if of.fields.len() == other.fields.len() => {
                let fields = of.fields.iter().zip(&other.fields);
                let fields = fields.map(|((name, value), (_, other))| (name.clone(), value.shaped_like(a, other)));
                Self::Struct(Rc::new(Struct { name: of.name.clone(), fields: fields.collect() }))
            }
            (Self::Tuple(values), Self::Tuple(others)) if values.len() == others.len() => {
                Self::Tuple(values.iter().zip(others).map(|(value, other)| value.shaped_like(a, other)).collect())
            }
            (Self::Array(values), Self::List(others)) if values.len() == others.len() => {
                let values = values.iter().zip(others).map(|(value, other)| value.shaped_like(a, &other.value));
                Self::List(values.map(Element::new).collect())
            }
            (Self::List(items), Self::List(others)) if items.len() == others.len() => {
                let items = items.iter().zip(others).map(|(item, other)| Element {
                    is_there: item.is_there.clone(),
                    value: item.value.shaped_like(a, &other.value),
                });
                Self::List(items.collect())
            }
            (Self::Array(values), Self::Array(others)) if values.len() == others.len() => {
                Self::Array(values.iter().zip(others).map(|(value, other)| value.shaped_like(a, other)).collect())
            }
            (value, _) => value.clone(),
        }
    }

    /// Rebuilds the value from other numbers.
    fn of_numbers(&self, a: &mut Algebra, from: &mut impl Iterator<Item = Scalar>) -> Option<Self> {
        fn take<const N: usize>(from: &mut impl Iterator<Item = Scalar>) -> Option<[Scalar; N]> {
            let taken: Vec<Scalar> = from.take(N).collect();
            taken.try_into().ok()
        }
        let mut each = |values: &[Self], a: &mut Algebra| -> Option<Vec<Self>> {
            values.iter().map(|value| value.of_numbers(a, from)).collect()
        };
        Some(match self {
            Self::Tuple(values) => Self::Tuple(each(values, a)?),
            Self::Array(values) => Self::Array(each(values, a)?),
            Self::Struct(of) => {
                let values: Vec<Self> = of.fields.iter().map(|(_, value)| value.clone()).collect();
                let names = of.fields.iter().map(|(name, _)| name.clone());
                let fields = names.zip(each(&values, a)?).collect();
                Self::Struct(Rc::new(Struct { name: of.name.clone(), fields }))
            }
            Self::List(items) => {
                let items = items.iter().map(|item| {
                    let parts = each(&[Self::Truth(item.is_there.clone()), item.value.clone()], a)?;
                    let [Self::Truth(is_there), value] = <[Self; 2]>::try_from(parts).ok()? else { return None };
                    Some(Element { is_there, value })
                });
                Self::List(items.collect::<Option<_>>()?)
            }
            Self::Slice(slice) => {
                let [first, len] = take(from)?;
                Self::Slice(Rc::new(Slice { first, len, ..(**slice).clone() }))
            }
            Self::Optional(optional) if optional.value.is_never() => self.clone(),
            Self::Optional(optional) => {
                let parts = each(&[Self::Truth(optional.is_some.clone()), optional.value.clone()], a)?;
                let [Self::Truth(is_some), value] = <[Self; 2]>::try_from(parts).ok()? else { return None };
                Self::Optional(Rc::new(Optional { is_some, value }))
            }
            Self::Never => Self::Never,
            Self::Scalar(_) => Self::Scalar(from.next()?),
            Self::Integer(_) => Self::Integer(from.next()?),
            Self::Truth(_) => Self::Truth(Condition::Less(a.number(0.0), from.next()?)),
            Self::Planar(_) => {
                let ([x, y], zero) = (take(from)?, a.number(0.0));
                Self::Planar(a.vector([x, y, zero]))
            }
            Self::Vector(_) => Self::Vector(a.vector(take(from)?)),
            Self::Four(_) => Self::Four(take(from)?),
            Self::Quaternion(_) => {
                let u = a.vector(take(from)?);
                Self::Quaternion(Quaternion::from_parts(u, from.next()?))
            }
            Self::Matrix(_) => {
                let columns = [take(from)?, take(from)?, take(from)?];
                Self::Matrix(Map::Columns(columns.map(|column| a.vector(column))))
            }
            Self::Square(columns) => {
                Self::Square(columns.iter().map(|column| from.by_ref().take(column.len()).collect()).collect())
            }
            Self::Homogeneous(_) => Self::Square((0..4).map(|_| from.by_ref().take(4).collect()).collect()),
            Self::Affine(_) => {
                let [x, y, z, translation] = [take(from)?, take(from)?, take(from)?, take(from)?].map(|v| a.vector(v));
                Self::Affine(Affine { map: Map::Columns([x, y, z]), translation })
            }
            _ => return None,
        })
    }
}

/// Adds a state to a loop, from its value before the first iteration and its value after an iteration. Returns its
/// final value.
fn add_state(a: &mut Algebra, number: usize, first: Scalar, next: Scalar, kind: Kind) -> Scalar {
    let k = a.loops[number].states.len();
    let [before, after] =
        [ExtraInput::StateBefore(number, k), ExtraInput::StateAfter(number, k)].map(|which| a.extra_input(which));
    a.loops[number].states.push(State { first, before, next, after, varies: kind == Kind::Number });
    after
}

impl Translation<'_> {
    /// Runs a `for` loop that is not unrolled.
    pub(super) fn run_kept_for(&mut self, e: &ExprForLoop, sequence: &LoopSequence) -> Value {
        self.run_kept_loop(&e.for_token, e.label.as_ref(), sequence, |this, item| {
            this.bind(&e.pat, item);
            this.block(&e.body)
        })
    }

    /// Runs a `while` loop without a known bound.
    pub(super) fn run_kept_while(&mut self, e: &ExprWhile) -> Value {
        let sequence = LoopSequence::without_end(self.algebra);
        self.run_kept_loop(&e.while_token, e.label.as_ref(), &sequence, |this, _| {
            let loop_end = Target::Loop(this.frame.loop_depth() - 1);
            let Some(condition) = this.condition(&e.cond) else { return Value::Unknown };
            let end = |this: &mut Self| {
                this.frame.exit(loop_end, Value::nothing());
                Value::Never
            };
            match this.branch(&e.while_token, Some(condition), |_| Value::nothing(), end) {
                Value::Never => Value::Never,
                _ => this.block(&e.body),
            }
        })
    }

    /// Runs a `loop` without a known bound.
    pub(super) fn run_kept_endless(&mut self, e: &ExprLoop) -> Value {
        let sequence = LoopSequence::without_end(self.algebra);
        self.run_kept_loop(&e.loop_token, e.label.as_ref(), &sequence, |this, _| this.block(&e.body))
    }

    /// Runs one iteration of a loop, which stands for all of them.
    pub(super) fn run_kept_loop(
        &mut self,
        place: &impl ToTokens,
        label: Option<&Label>,
        sequence: &LoopSequence,
        mut iteration: impl FnMut(&mut Self, Value) -> Value,
    ) -> Value {
        let number = self.begin_kept_loop(sequence.count);
        let label = label.map(|label| label.name.ident.to_string());
        let loop_exits = self.find_states(place, label.as_deref(), number, sequence, &mut iteration);
        self.open_kept_loops.pop();
        let Some(loop_exits) = loop_exits else { return Value::Unknown };
        let LoopExits { mut exit_condition, break_value, exits } = loop_exits;
        // Without a bound, the loop can only end by an exit.
        let continues = self.algebra.constant_of(sequence.count) != Some(f64::INFINITY)
            || !matches!(exit_condition, Condition::Known(false));
        // The value of each outer exit, and the condition that it was taken, are states as well: after the loop,
        // control continues at the exit's target.
        let mut outer_exits = Vec::new();
        for (place_of_first, Exit { target, .. }) in exits.iter().enumerate() {
            if exits[..place_of_first].iter().any(|exit| exit.target == *target) {
                continue;
            }
            let same = exits.iter().filter(|exit| exit.target == *target).rev();
            let is_taken = same.clone().map(|exit| exit.condition.clone()).fold(Condition::Known(false), Condition::or);
            exit_condition = exit_condition.or(is_taken.clone());
            // The earliest exit has precedence.
            let value = same
                .map(|exit| (&exit.condition, &exit.value))
                .try_fold(Value::Never, |other, (condition, value)| value.select(self.algebra, condition, &other));
            let state = value.and_then(|value| {
                let Value::Truth(is_taken_after) =
                    self.exit_state(number, &is_taken, &Value::Truth(is_taken.clone()))?
                else {
                    return None;
                };
                Some((is_taken_after, self.exit_state(number, &is_taken, &value)?))
            });
            match state {
                Some(state) => outer_exits.push((*target, state)),
                None => return self.refuse(place, messages::state_of_kept_loop("the returned value")),
            }
        }
        let Some(break_value) = self.exit_state(number, &exit_condition, &break_value) else {
            return self.refuse_known(&break_value, place, messages::state_of_kept_loop(&break_value.describe()));
        };
        let a = &mut *self.algebra;
        let exit_condition = (!matches!(exit_condition, Condition::Known(false))).then(|| a.number_of(&exit_condition));
        // Run no iteration where control does not reach the loop: it might not terminate there.
        let reached = self.frame.reach_condition(a);
        let zero = a.number(0.0);
        let count = reached.select(a, sequence.count, zero);
        (a.loops[number].count, a.loops[number].exit_flag) = (count, exit_condition);
        for (target, (is_taken, value)) in outer_exits {
            self.frame.begin_branch(is_taken.clone());
            self.frame.exit(target, value);
            self.frame.end_branch();
            self.frame.assume(is_taken.not());
        }
        match (continues, break_value) {
            (false, _) => Value::Never,
            (true, Value::Never) => Value::nothing(),
            (true, break_value) => break_value,
        }
    }

    /// Begins a kept loop and returns its index.
    pub(super) fn begin_kept_loop(&mut self, count: Scalar) -> usize {
        let (number, within) = (self.algebra.loops.len(), self.open_kept_loops.last().copied());
        self.algebra.loops.push(KeptLoop { within, count, states: Vec::new(), exit_flag: None });
        self.open_kept_loops.push(number);
        number
    }

    /// Replaces numbers that are absent by 0: where `holds` is false, in an option that is `None`, and in an enum's
    /// other variants. Otherwise an undefined number could become NaN, and so would the derivatives that iterations
    /// compute from it.
    fn zero_where_absent(&mut self, value: &Value, holds: &Condition) -> Value {
        match value {
            Value::Optional(of) if !of.value.is_never() => {
                let is_some = of.is_some.clone();
                let value = self.zero_where_absent(&of.value, &holds.clone().and(is_some.clone()));
                Value::Optional(Rc::new(Optional { is_some, value }))
            }
            Value::Tuple(values) => {
                Value::Tuple(values.iter().map(|value| self.zero_where_absent(value, holds)).collect())
            }
            Value::Array(values) => {
                Value::Array(values.iter().map(|value| self.zero_where_absent(value, holds)).collect())
            }
            Value::List(items) => {
                let items = items.iter().map(|item| {
                    let value = self.zero_where_absent(&item.value, &holds.clone().and(item.is_there.clone()));
                    Element { is_there: item.is_there.clone(), value }
                });
                Value::List(items.collect())
            }
            Value::Struct(of) => {
                let mut holds_of = vec![holds.clone(); of.fields.len()];
                if let (Some(Value::Integer(tag)), Some(of)) = (of.field(TAG), self.items.enumeration(&of.name)) {
                    let sizes = of.variants.iter().map(|variant| variant.fields.len());
                    holds_of = vec![holds.clone()];
                    for (number, size) in sizes.enumerate() {
                        let number = self.algebra.count(number);
                        let is_it = Condition::equal(self.algebra, *tag, number);
                        holds_of.extend(core::iter::repeat_n(holds.clone().and(is_it), size));
                    }
                }
                let fields = of.fields.iter().zip(holds_of);
                let fields = fields.map(|((name, value), holds)| (name.clone(), self.zero_where_absent(value, &holds)));
                Value::Struct(Rc::new(Struct { name: of.name.clone(), fields: fields.collect() }))
            }
            value => {
                let a = &mut *self.algebra;
                let mut zeros = core::iter::repeat(a.number(0.0));
                let nothing = value.of_numbers(a, &mut zeros);
                nothing.and_then(|nothing| value.select(a, holds, &nothing)).unwrap_or_else(|| value.clone())
            }
        }
    }

    /// Returns the final value of something that an iteration leaves the loop with; `None` if it cannot be a state.
    fn exit_state(&mut self, number: usize, exit_condition: &Condition, value: &Value) -> Option<Value> {
        let value = &self.zero_where_absent(value, exit_condition);
        let a = &mut *self.algebra;
        let numbers = value.numbers(a)?;
        let zero = a.number(0.0);
        let final_values: Vec<Scalar> =
            numbers.into_iter().map(|(next, kind)| add_state(a, number, zero, next, kind)).collect();
        value.of_numbers(a, &mut final_values.into_iter())
    }

    /// Finds the variables that an iteration changes, and sets them to their values after the loop. `None` after an
    /// error.
    fn find_states(
        &mut self,
        place: &impl ToTokens,
        label: Option<&str>,
        number: usize,
        sequence: &LoopSequence,
        iteration: &mut impl FnMut(&mut Self, Value) -> Value,
    ) -> Option<LoopExits> {
        // Iterate to a fixed point: a changed variable, or a value assigned to an empty option or enum, may lead to
        // further changes.
        let mut changed: Vec<(usize, Value)> = Vec::new();
        let (after, loop_exits, inputs) = loop {
            let mut inputs = 0_usize..;
            let mut before = Vec::with_capacity(changed.len());
            for (variable, made) in &changed {
                let variable = *variable;
                let a = &mut *self.algebra;
                let value = self.frame.value(variable).shaped_like(a, made);
                let numbers = value.numbers(a).map(|numbers| numbers.len());
                let taken: Vec<Scalar> = inputs
                    .by_ref()
                    .take(numbers.unwrap_or_default())
                    .map(|k| a.extra_input(ExtraInput::StateBefore(number, k)))
                    .collect();
                match value.of_numbers(a, &mut taken.into_iter()) {
                    Some(value) if numbers.is_some() => before.push((variable, value)),
                    _ => {
                        self.refuse_known(&value, place, messages::state_of_kept_loop(&value.describe()));
                        return None;
                    }
                }
            }
            let (progress, before_run) = (self.progress(), self.report_counts());
            let (after, loop_exits) = self.run_iteration(place, label, number, sequence, before, iteration);
            let a = &mut *self.algebra;
            let mut grows = false;
            for (variable, made) in &after {
                let size = |value: &Value, a: &mut Algebra| value.numbers(a).map(|numbers| numbers.len());
                if let Some((_, known)) = changed.iter_mut().find(|(known, _)| known == variable) {
                    let both = known.shaped_like(a, made);
                    grows |= size(&both, a) != size(known, a);
                    *known = both;
                } else {
                    changed.push((*variable, made.clone()));
                    grows = true;
                }
            }
            if !grows {
                break (after, loop_exits?, inputs.start);
            }
            // Errors of an iteration with incomplete states are meaningless.
            self.forget_reports_since(before_run);
            self.roll_back(progress);
        };
        for (variable, _) in changed {
            let first = self.frame.value(variable).clone();
            let made = after.iter().find(|(known, _)| *known == variable).map(|(_, next)| next.clone());
            let next = made.unwrap_or_else(|| first.clone());
            let a = &mut *self.algebra;
            let first = first.shaped_like(a, &next);
            let next = next.shaped_like(a, &first);
            let [first, next] = [first, next].map(|value| self.zero_where_absent(&value, &Condition::Known(true)));
            let a = &mut *self.algebra;
            let (Some(numbers), Some(nexts)) = (first.numbers(a), next.numbers(a)) else {
                self.refuse_known(&next, place, messages::state_of_kept_loop(&next.describe()));
                return None;
            };
            if !numbers.iter().map(|(_, kind)| kind).eq(nexts.iter().map(|(_, kind)| kind)) {
                let message = match next {
                    Value::List(_) => messages::state_of_kept_loop("a list that grows"),
                    _ => messages::variable_of_two_kinds(),
                };
                self.refuse(place, message);
                return None;
            }
            let mut final_values = Vec::new();
            for ((first, kind), (next, _)) in numbers.into_iter().zip(nexts) {
                final_values.push(add_state(a, number, first, next, kind));
            }
            let value = first.of_numbers(a, &mut final_values.into_iter())?;
            self.frame.assign(variable, value);
        }
        if self.algebra.loops[number].states.len() != inputs {
            // Otherwise states would be mixed up.
            self.refuse(place, messages::state_of_kept_loop("a value whose type changes"));
            return None;
        }
        Some(loop_exits)
    }

    /// Runs an iteration with these variables. Returns the variables' values afterwards, and the ways in which it ends;
    /// `None` after an error.
    fn run_iteration(
        &mut self,
        place: &impl ToTokens,
        label: Option<&str>,
        number: usize,
        sequence: &LoopSequence,
        before: Vec<(usize, Value)>,
        iteration: &mut impl FnMut(&mut Self, Value) -> Value,
    ) -> (Vec<(usize, Value)>, Option<LoopExits>) {
        let (errors, exits, loops) = (self.report.count(), self.frame.exit_count(), self.frame.loop_depth());
        let (loop_end, iteration_end) = (Target::Loop(loops), Target::Iteration(loops));
        self.frame.begin_branch(Condition::Known(true));
        self.frame.assign_all(before);
        self.frame.begin_region(loop_end, label.map(str::to_owned));
        let depth = self.frame.depth();
        self.frame.begin_region(iteration_end, None);
        let done = match self.item_of_iteration(&sequence.items, number) {
            Some(Element { is_there, value }) => {
                self.branch(place, Some(is_there), |this| iteration(this, value), |_| Value::nothing())
            }
            None => Value::Unknown,
        };
        self.frame.end_scope(depth);
        if matches!(done, Value::Unknown) && self.report.count() == 0 {
            self.refuse(place, messages::unknown_iteration());
        }
        let continues = !done.is_never() || self.frame.has_exits(iteration_end);
        let inner = self.frame.end_region(self.algebra, !done.is_never());
        let exit_condition = self.frame.exit_condition(loop_end);
        let break_value = self.frame.take_break_value(self.algebra, loop_end);
        let outer = self.frame.end_region(self.algebra, continues);
        let mut after = self.frame.end_branch();
        if self.report.count() > errors {
            self.frame.forget_exits(exits);
            return (after, None);
        }
        let Some(exits) = self.frame.take_exits_beyond(exits) else {
            self.refuse(place, messages::exit_of_kept_loop());
            return (after, None);
        };
        // Values of the variables where control exits to an outer loop.
        let to_loops = exits.iter().rev().filter(|exit| exit.target != Target::Function);
        let assigned = to_loops.flat_map(|exit| exit.assigned.iter().map(|assigned| (&exit.condition, assigned)));
        let joined = assigned.into_iter().try_for_each(|(condition, (variable, value))| {
            let a = &mut *self.algebra;
            let known = after.iter().position(|(known, _)| known == variable);
            let before = self.frame.value(*variable);
            let now = value.select(a, condition, known.map_or(before, |known| &after[known].1))?;
            match known {
                Some(known) => after[known].1 = now,
                None if now.numbers(a) == before.numbers(a) => {}
                None => after.push((*variable, now)),
            }
            Some(())
        });
        match (inner, outer, break_value, joined) {
            (Some(_), Some(_), Some(break_value), Some(())) => {
                (after, Some(LoopExits { exit_condition, break_value, exits }))
            }
            _ => {
                self.refuse(place, messages::state_of_kept_loop("a list that grows, or a value whose type changes,"));
                (after, None)
            }
        }
    }
}
