//! What is assigned to: a variable, or a part of one.

use std::rc::Rc;

use aim_symbolic::Scalar;
use quote::ToTokens;
use syn::{Expr, ExprMethodCall, UnOp};

use super::algebra::Algebra;
use super::condition::Condition;
use super::expected::Expected;
use super::map::{Affine, Map, Quaternion};
use super::place_types::type_of;
use super::value::{Place, Step, Struct, Value};
use super::{Translation, is_place, lists, square, strip};
use crate::differentiate::messages;

impl Translation<'_> {
    /// Runs `target = value`.
    pub(super) fn assign(&mut self, target: &Expr, value: Value) -> Value {
        match strip(target) {
            Expr::Tuple(tuple) => match value {
                Value::Tuple(values) if values.len() == tuple.elems.len() => {
                    self.assign_each(tuple.elems.iter(), values)
                }
                other => self.refuse_known(&other, target, messages::pattern_of(&other.describe())),
            },
            Expr::Array(array) => match value {
                Value::Array(values) if values.len() == array.elems.len() => {
                    self.assign_each(array.elems.iter(), values)
                }
                other => self.refuse_known(&other, target, messages::pattern_of(&other.describe())),
            },
            Expr::Infer(_) => Value::nothing(),
            _ => self.assign_part(target, value),
        }
    }

    fn assign_each<'e>(&mut self, targets: impl Iterator<Item = &'e Expr>, values: Vec<Value>) -> Value {
        let mut done = Value::nothing();
        for (target, value) in targets.zip(values) {
            let one = self.assign(target, value);
            if one.is_unknown() {
                done = one;
            }
        }
        done
    }

    fn assign_part(&mut self, target: &Expr, value: Value) -> Value {
        if self.is_reference(target) {
            return self.refuse(target, messages::rebound_reference());
        }
        let (errors, exits) = (self.report.count(), self.frame.exits());
        match self.place(target) {
            // Control goes elsewhere on the way there.
            None if self.report.count() == errors && self.frame.exits() > exits => Value::Never,
            Some(_) if matches!(value, Value::Reference(_)) => self.refuse(target, messages::mutable_borrow()),
            Some(place) => self.write(target, &place, value),
            None => Value::Unknown,
        }
    }

    /// Gives a place a value.
    pub(super) fn write(&mut self, target: &impl ToTokens, place: &Place, value: Value) -> Value {
        let Place { variable, ref steps } = *place;
        if self.frame.is_fixed(variable) {
            return self.refuse(target, messages::captured());
        }
        let whole = self.frame.value(variable).clone();
        if value.is_unknown() || whole.is_unknown() && !steps.is_empty() {
            self.frame.assign(variable, Value::Unknown);
            return if steps.is_empty() { Value::nothing() } else { Value::Unknown };
        }
        match replaced(self.algebra, &whole, steps, value) {
            Some(whole) => {
                self.frame.assign(variable, whole);
                Value::nothing()
            }
            None => self.refuse(target, messages::no_part_to_assign(&whole.describe())),
        }
    }

    /// The type of what stands at a place; `None` after an error.
    pub(super) fn type_of_place(&mut self, target: &Expr) -> Option<Expected> {
        match strip(target) {
            Expr::Tuple(_) | Expr::Array(_) | Expr::Infer(_) => Some(Expected::Any),
            target => {
                let place = self.place(target)?;
                let value = self.read(&place);
                Some(type_of(&value, self.precision))
            }
        }
    }

    /// `&mut target`
    pub(super) fn reference(&mut self, target: &Expr) -> Value {
        self.place(target).map_or(Value::Unknown, |place| Value::Reference(Rc::new(place)))
    }

    /// An iterator over references to the elements of an array that is changed; `None` if it is none.
    pub(super) fn references(&mut self, target: &Place) -> Option<Value> {
        let Value::Array(values) = self.read(target) else { return None };
        let references = (0..values.len()).map(|index| {
            let steps = target.steps.iter().cloned().chain([Step::Index(index)]).collect();
            Value::Reference(Rc::new(Place { variable: target.variable, steps }))
        });
        Some(Value::iterator(references))
    }

    /// The value itself, of a reference that of its place.
    pub(super) fn referenced(&mut self, value: Value) -> Value {
        match value {
            Value::Reference(place) => self.read(&place),
            value => value,
        }
    }

    pub(super) fn read(&mut self, place: &Place) -> Value {
        let whole = self.frame.value(place.variable).clone();
        place.steps.iter().try_fold(whole, |whole, step| part_of(self.algebra, &whole, step)).unwrap_or(Value::Unknown)
    }

    /// A method that changes a part of its receiver, or lends it to be changed; `None` if it is another one.
    pub(super) fn changing_method(&mut self, call: &ExprMethodCall) -> Option<Value> {
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let name = call.method.to_string();
        if let Some(value) = self.list_method(call).or_else(|| self.option_method(call)) {
            return Some(value);
        }
        match (name.as_str(), arguments.as_slice()) {
            ("iter_mut", []) => {
                let place = self.still_place(&call.receiver)?;
                self.references(&place)
            }
            ("swap", [one, other]) => {
                let array = self.still_place(&call.receiver)?;
                let Value::Array(_) = self.read(&array) else { return None };
                let [one, other] = [one, other].map(|index| {
                    let mut place = array.clone();
                    place.steps.push(self.step(index)?);
                    Some(place)
                });
                Some(self.swapped(&call.method, [&one?, &other?]))
            }
            _ => None,
        }
    }

    /// `mem::swap(&mut one, &mut other)`
    pub(super) fn exchanged(&mut self, target: &impl ToTokens, one: &Expr, other: &Expr) -> Value {
        if [one, other]
            .into_iter()
            .any(|lent| matches!(strip(lent), Expr::Reference(of) if self.is_reference(&of.expr)))
        {
            return self.refuse(target, messages::rebound_reference());
        }
        let [one, other] = [one, other].map(|lent| match strip(lent) {
            Expr::Reference(reference) => &*reference.expr,
            place => place,
        });
        match (self.place(one), self.place(other)) {
            (Some(one), Some(other)) => self.swapped(target, [&one, &other]),
            _ => Value::Unknown,
        }
    }

    /// `take` and `replace` of an option; `None` if it is another method, or of something else.
    fn option_method(&mut self, call: &ExprMethodCall) -> Option<Value> {
        let is_one = call.method == "take" && call.args.is_empty() || call.method == "replace" && call.args.len() == 1;
        if !is_one || !is_place(&call.receiver) {
            return None;
        }
        let place = self.still_place(&call.receiver)?;
        let before = self.read(&place);
        if !matches!(before, Value::Optional(_)) {
            return None;
        }
        let now = match call.args.first() {
            Some(value) => Value::some(self.expression(value)),
            None => Value::none(),
        };
        let written = self.write(&call.method, &place, now);
        Some(if written.is_unknown() { written } else { before })
    }

    /// `mem::replace(&mut place, value)`
    pub(super) fn replaced(&mut self, target: &impl ToTokens, lent: &Expr, value: &Expr) -> Value {
        let place = match strip(lent) {
            Expr::Reference(reference) => &*reference.expr,
            place => place,
        };
        let Some(place) = self.place(place) else { return Value::Unknown };
        let value = self.expression(value);
        let before = self.read(&place);
        let written = self.write(target, &place, value);
        if written.is_unknown() { written } else { before }
    }

    /// Whether an expression is a variable that is a `&mut`.
    fn is_reference(&self, target: &Expr) -> bool {
        let Expr::Path(path) = strip(target) else { return false };
        let variable = path.path.get_ident().and_then(|name| self.frame.find(&name.to_string()));
        variable.is_some_and(|variable| {
            matches!(self.frame.value(variable), Value::Reference(_)) || self.frame.is_lent_parameter(variable)
        })
    }

    /// Gives each of two places the value of the other.
    fn swapped(&mut self, target: &impl ToTokens, places: [&Place; 2]) -> Value {
        let [one, other] = places;
        let [first, second] = [self.read(other), self.read(one)];
        self.write(target, one, first);
        self.write(target, other, second)
    }

    /// What an expression names whose value has been looked at, or will be: nothing is changed on the way there.
    pub(super) fn still_place(&mut self, target: &Expr) -> Option<Place> {
        let (place, has_effect) = self.tracked(|this| this.place(target));
        if has_effect {
            self.refuse(target, messages::receiver_effect());
            return None;
        }
        place
    }

    /// The step to an element of an array; `None` after an error.
    fn step(&mut self, index: &Expr) -> Option<Step> {
        let value = self.expression(index);
        match (self.algebra.known_index(&value), &value) {
            (Some(known), _) => Some(Step::Index(known)),
            (None, Value::Integer(chosen)) => Some(Step::Chosen(*chosen)),
            _ => {
                self.refuse_known(&value, index, messages::index_unknown());
                None
            }
        }
    }

    /// What this expression names; `None` after an error.
    pub(super) fn place(&mut self, target: &Expr) -> Option<Place> {
        match strip(target) {
            Expr::Path(path) => {
                // A constant is not assigned to: the compiler says so.
                let variable = self.frame.find(&path.path.get_ident()?.to_string())?;
                Some(match self.frame.value(variable) {
                    Value::Reference(place) => (**place).clone(),
                    _ => Place { variable, steps: Vec::new() },
                })
            }
            Expr::Field(field) => {
                let mut place = self.place(&field.base)?;
                place.steps.push(Step::Field(field.member.clone()));
                Some(place)
            }
            Expr::Index(index) => {
                let mut place = self.place(&index.expr)?;
                place.steps.push(self.step(&index.index)?);
                Some(place)
            }
            Expr::Unary(unary) if matches!(unary.op, UnOp::Deref(_)) => {
                let place = self.place(&unary.expr)?;
                let followed = match strip(&unary.expr) {
                    Expr::Path(path) => path.path.get_ident().and_then(|name| self.frame.find(&name.to_string())),
                    _ => None,
                };
                let value = followed.map_or(Value::Unknown, |variable| self.frame.value(variable).clone());
                if matches!(value, Value::Reference(_)) || followed.is_some_and(|place| self.frame.is_lent(place)) {
                    return Some(place);
                }
                self.refuse_known(&value, &unary.op, messages::assigned_through_reference());
                None
            }
            other => {
                self.refuse(other, messages::not_assignable());
                None
            }
        }
    }
}

/// `whole` with another value at the end of these steps.
fn replaced(a: &mut Algebra, whole: &Value, steps: &[Step], value: Value) -> Option<Value> {
    let Some((step, rest)) = steps.split_first() else { return Some(value) };
    let part = part_of(a, whole, step)?;
    let part = replaced(a, &part, rest, value)?;
    with_part(a, whole, step, part)
}

fn part_of(a: &mut Algebra, whole: &Value, step: &Step) -> Option<Value> {
    match step {
        Step::Field(member) => whole.field(a, &super::fields::name_of(member)),
        Step::Index(index) => whole.element(a, *index),
        Step::Chosen(index) => whole.chosen(a, *index),
    }
}

/// `whole` with one of its parts replaced.
fn with_part(a: &mut Algebra, whole: &Value, step: &Step, part: Value) -> Option<Value> {
    if let Value::List(items) = whole {
        let index = match step {
            Step::Index(index) => a.whole(*index),
            Step::Chosen(index) => Value::Integer(*index),
            Step::Field(_) => return None,
        };
        let Value::Integer(index) = index else { return None };
        return lists::with_ranked(a, items, index, &part);
    }
    if let Step::Chosen(chosen) = step {
        let mut changed = whole.clone();
        for index in 0..whole.elements(a).len() {
            let Value::Integer(number) = a.whole(index) else { return None };
            let (is_here, step) = (Condition::equal(a, *chosen, number), Step::Index(index));
            let before = part_of(a, whole, &step)?;
            let now = part.select(a, &is_here, &before)?;
            changed = with_part(a, &changed, &step, now)?;
        }
        return Some(changed);
    }
    let name = match step {
        Step::Field(member) => super::fields::name_of(member),
        _ => String::new(),
    };
    let place = |letters: &str| match step {
        Step::Index(index) => Some(*index),
        Step::Chosen(_) => None,
        Step::Field(_) if name.len() == 1 => letters.find(&name),
        Step::Field(_) => None,
    };
    Some(match (whole, part) {
        (Value::Planar(v), Value::Scalar(x)) => Value::Planar(with_component(a, *v, place("xy")?, x)?),
        (Value::Vector(v), Value::Scalar(x)) => Value::Vector(with_component(a, *v, place("xyz")?, x)?),
        (Value::Four(parts), Value::Scalar(x)) => {
            let mut parts = *parts;
            *parts.get_mut(place("xyzw")?)? = x;
            Value::Four(parts)
        }
        (Value::Quaternion(q), Value::Scalar(x)) => {
            let (u, w) = q.parts?;
            let place = place("xyzw")?;
            Value::Quaternion(if place == 3 {
                Quaternion::from_parts(u, x)
            } else {
                Quaternion::from_parts(with_component(a, u, place, x)?, w)
            })
        }
        (Value::Matrix(m), Value::Vector(v)) => {
            let mut columns = m.columns(a);
            columns[super::fields::column(&name)?] = v;
            Value::Matrix(Map::Columns(columns))
        }
        (Value::Square(_) | Value::Homogeneous(_), part) => {
            let mut columns = square::columns(a, whole)?;
            *columns.get_mut(super::fields::column(&name)?)? = square::numbers(a, &part);
            Value::Square(columns)
        }
        (Value::Affine(m), Value::Vector(v)) if name == "translation" => {
            Value::Affine(Affine { map: m.map.clone(), translation: v })
        }
        (Value::Affine(m), Value::Matrix(map)) if name == "matrix3" => {
            Value::Affine(Affine { map, translation: m.translation })
        }
        (Value::Array(values), part) => {
            let Step::Index(index) = step else { return None };
            Value::Array(with(values, *index, part)?)
        }
        (Value::Tuple(values), part) => Value::Tuple(with(values, name.parse().ok()?, part)?),
        (Value::Struct(of), part) => {
            let fields = of
                .fields
                .iter()
                .map(|(known, value)| (known.clone(), if *known == name { part.clone() } else { value.clone() }));
            Value::Struct(Rc::new(Struct { name: of.name.clone(), fields: fields.collect() }))
        }
        _ => return None,
    })
}

fn with(values: &[Value], place: usize, value: Value) -> Option<Vec<Value>> {
    let mut values = values.to_vec();
    *values.get_mut(place)? = value;
    Some(values)
}

fn with_component(a: &mut Algebra, v: aim_symbolic::Vector, place: usize, x: Scalar) -> Option<aim_symbolic::Vector> {
    let mut parts = a.parts(v);
    *parts.get_mut(place)? = x;
    Some(a.vector(parts))
}
