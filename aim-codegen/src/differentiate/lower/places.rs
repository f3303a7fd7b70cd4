//! Places, the targets of assignments: a variable, or a part of one.

use std::rc::Rc;

use aim_symbolic::Scalar;
use quote::ToTokens;
use syn::{Expr, ExprMethodCall, UnOp};

use super::algebra::Algebra;
use super::condition::Condition;
use super::expected::Expected;
use super::fields::name_of;
use super::map::{Affine, Map, Quaternion};
use super::place_types::type_of;
use super::value::{Optional, Place, Step, Struct, Value};
use super::{Translation, is_place, lending, lists, square, strip};
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
        match self.target(target, Self::place) {
            Ok(_) if matches!(value, Value::Reference(_)) => self.refuse(target, messages::mutable_borrow()),
            Ok(place) => self.write(target, &place, value),
            Err(value) => value,
        }
    }

    /// Returns the place that is assigned to; if there is none, the value of the assignment.
    pub(super) fn target(
        &mut self,
        target: &Expr,
        find: impl FnOnce(&mut Self, &Expr) -> Option<Place>,
    ) -> Result<Place, Value> {
        let (errors, exits) = (self.report.count(), self.frame.exit_count());
        find(self, target).ok_or_else(|| {
            // Control flow leaves while the place is evaluated.
            let leaves = self.report.count() == errors && self.frame.exit_count() > exits;
            if leaves { Value::Never } else { Value::Unknown }
        })
    }

    /// Assigns a value to a place.
    pub(super) fn write(&mut self, target: &impl ToTokens, place: &Place, value: Value) -> Value {
        let Place { variable, ref steps } = *place;
        if self.frame.is_fixed(variable) {
            return self.refuse(target, messages::captured());
        }
        if !steps.is_empty() && !self.frame.is_changeable(variable) {
            return self.refuse(target, messages::assigned_through_reference());
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

    /// Returns the type of the value at a place; `None` after an error.
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

    /// Evaluates an expression that is moved: a variable that is a `&mut` stays a reference.
    pub(super) fn moved_value(&mut self, expression: &Expr, expected: &Expected) -> Value {
        if self.is_reference(expression) {
            self.reference(expression)
        } else {
            self.expression_as(expression, expected)
        }
    }

    /// Leaves a scope with a value; `depth` is the number of variables when it was entered. Reports a reference to a
    /// variable of the scope.
    pub(super) fn leave_scope(&mut self, scope: &impl ToTokens, depth: usize, value: Value) -> Value {
        self.frame.end_scope(depth);
        let stays = |place: &Rc<Place>| (place.variable < depth).then(|| Value::Reference(place.clone()));
        value.with_references(&stays).unwrap_or_else(|| self.refuse(scope, messages::mutable_borrow()))
    }

    /// Evaluates `&mut target`.
    pub(super) fn reference(&mut self, target: &Expr) -> Value {
        if is_place(target) {
            return self.place(target).map_or(Value::Unknown, |place| Value::Reference(Rc::new(place)));
        }
        match self.expression(target) {
            value @ Value::Reference(_) => value,
            value if value.is_unknown() => value,
            // A temporary value.
            value => {
                let variable = self.frame.depth();
                self.frame.declare(String::new(), value);
                self.frame.allow_changes();
                Value::Reference(Rc::new(Place { variable, steps: Vec::new() }))
            }
        }
    }

    /// Returns the value that a reference points to; any other value unchanged.
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

    /// Evaluates a method that changes a part of its receiver, or lends it mutably; `None` if it is another one.
    pub(super) fn changing_method(&mut self, call: &ExprMethodCall) -> Option<Value> {
        let arguments: Vec<&Expr> = call.args.iter().collect();
        let name = call.method.to_string();
        if let Some(value) = self.list_method(call).or_else(|| self.option_method(call)) {
            return Some(value);
        }
        if lending::LENDING.contains(&&*name) {
            let place = self.still_place(&call.receiver)?;
            return self.lending_method(call, &place).or_else(|| self.lent_by_list(call, &place));
        }
        match (name.as_str(), arguments.as_slice()) {
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

    /// Evaluates `mem::swap(&mut one, &mut other)`.
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

    /// Evaluates a method that changes an option, or lends its content mutably; `None` if it is another method, or of
    /// another receiver.
    fn option_method(&mut self, call: &ExprMethodCall) -> Option<Value> {
        let name = call.method.to_string();
        let count = match name.as_str() {
            "take" | "as_mut" => 0,
            "replace" | "insert" | "get_or_insert" | "get_or_insert_with" => 1,
            _ => return None,
        };
        if call.args.len() != count || !is_place(&call.receiver) {
            return None;
        }
        let place = self.still_place(&call.receiver)?;
        let before = self.read(&place);
        let Value::Optional(optional) = &before else { return None };
        let Optional { is_some, value: inside } = (**optional).clone();
        if name == "as_mut" {
            return Some(Value::some_if(is_some, place.lent(Step::Inside)));
        }
        let new = match call.args.first() {
            None => Value::none(),
            Some(function) if name == "get_or_insert_with" => {
                let function = self.function_argument(function, 0)?;
                let is_none = is_some.clone().not();
                self.run_under(call, &is_none, |this| this.inline(&call.method, &function, Vec::new()))
            }
            Some(value) => self.expression(value),
        };
        let now = match name.as_str() {
            "take" => new,
            "replace" | "insert" => Value::some(new),
            _ => Value::some(self.either_value(call, &is_some, &inside, &new)),
        };
        let written = self.write(&call.method, &place, now);
        Some(match name.as_str() {
            _ if written.is_unknown() => written,
            "take" | "replace" => before,
            _ => place.lent(Step::Inside),
        })
    }

    /// Evaluates `mem::replace(&mut place, value)`.
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

    /// Returns `true` if an expression is a variable that is a `&mut`.
    pub(super) fn is_reference(&self, target: &Expr) -> bool {
        let Expr::Path(path) = strip(target) else { return false };
        let variable = path.path.get_ident().and_then(|name| self.frame.find(&name.to_string()));
        variable.is_some_and(|variable| {
            matches!(self.frame.value(variable), Value::Reference(_)) || self.frame.is_lent_parameter(variable)
        })
    }

    /// Exchanges the values of two places.
    fn swapped(&mut self, target: &impl ToTokens, places: [&Place; 2]) -> Value {
        let [one, other] = places;
        let [first, second] = [self.read(other), self.read(one)];
        self.write(target, one, first);
        self.write(target, other, second)
    }

    /// Returns the place that an expression names. Reports side effects, because the expression is evaluated twice.
    pub(super) fn still_place(&mut self, target: &Expr) -> Option<Place> {
        let (place, has_effect) = self.tracked(|this| this.place(target));
        if has_effect {
            self.refuse(target, messages::receiver_effect());
            return None;
        }
        place
    }

    /// Returns the step to an element of an array; `None` after an error.
    pub(super) fn step(&mut self, index: &Expr) -> Option<Step> {
        let value = self.expression_as(index, &Expected::Named("usize".into()));
        match (self.algebra.known_index(&value), &value) {
            (Some(known), _) => Some(Step::Index(known)),
            (None, Value::Integer(chosen)) => Some(Step::Computed(*chosen)),
            _ => {
                self.refuse_known(&value, index, messages::index_unknown());
                None
            }
        }
    }

    /// Returns the step to a part of an array with known bounds; `None` after an error.
    fn range_step(&mut self, array: &Place, range: &syn::ExprRange) -> Option<Step> {
        let whole = self.read(array);
        let Value::Array(values) = &whole else {
            self.refuse_known(&whole, range, messages::no_part_to_assign(&whole.describe()));
            return None;
        };
        let first = range.start.as_deref().map_or(Some(0), |start| self.known_count(start))?;
        let end = range.end.as_deref().map_or(Some(values.len()), |end| {
            let is_closed = matches!(range.limits, syn::RangeLimits::Closed(_));
            Some(self.known_count(end)? + usize::from(is_closed))
        })?;
        if first > end || end > values.len() {
            self.refuse(range, messages::index_outside(&whole.describe()));
            return None;
        }
        Some(Step::Part { first, len: end - first })
    }

    /// Returns the place that the `index_mut` of a struct of the module lends; `None` after an error.
    fn own_index_mut(&mut self, index: &syn::ExprIndex, place: Place, ty: &str) -> Option<Place> {
        let at = self.expression(&index.index);
        let arguments = vec![Value::Reference(Rc::new(place)), at];
        let several = self.functions(Some(ty), "index_mut");
        let lent = match self.function_for(&several, &[Value::Unknown, arguments[1].clone()]) {
            Some(own) => self.inline(&index.index, &own, arguments),
            None => self.refuse_known(&arguments[1], &index.index, messages::no_index_mut(ty)),
        };
        match lent {
            Value::Reference(place) => Some((*place).clone()),
            value => {
                self.refuse_known(&value, &index.index, messages::mutable_borrow());
                None
            }
        }
    }

    /// Returns the place that an expression names; `None` after an error.
    pub(super) fn place(&mut self, target: &Expr) -> Option<Place> {
        match strip(target) {
            Expr::Path(path) => {
                // The compiler rejects assignments to constants.
                let variable = self.frame.find(&path.path.get_ident()?.to_string())?;
                Some(match self.frame.value(variable) {
                    Value::Reference(place) => (**place).clone(),
                    _ => Place { variable, steps: Vec::new() },
                })
            }
            Expr::Field(field) => {
                let mut place = self.place(&field.base)?;
                place.steps.push(Step::Field(name_of(&field.member)));
                Some(place)
            }
            Expr::Index(index) => {
                let mut place = self.place(&index.expr)?;
                if let Value::Struct(of) = self.read(&place) {
                    return self.own_index_mut(index, place, &of.name);
                }
                let step = match strip(&index.index) {
                    Expr::Range(range) => self.range_step(&place, range)?,
                    index => self.step(index)?,
                };
                place.steps.push(step);
                Some(place)
            }
            // `*row.last_mut()?`
            Expr::Unary(unary)
                if matches!(unary.op, UnOp::Deref(_))
                    && matches!(strip(&unary.expr), Expr::MethodCall(_) | Expr::Call(_) | Expr::Try(_)) =>
            {
                match self.expression(&unary.expr) {
                    Value::Reference(place) => Some((*place).clone()),
                    value => {
                        self.refuse_known(&value, &unary.op, messages::assigned_through_reference());
                        None
                    }
                }
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

/// Returns `whole` with the part at the end of these steps replaced.
fn replaced(a: &mut Algebra, whole: &Value, steps: &[Step], value: Value) -> Option<Value> {
    let Some((step, rest)) = steps.split_first() else { return Some(value) };
    let part = part_of(a, whole, step)?;
    let part = replaced(a, &part, rest, value)?;
    with_part(a, whole, step, part)
}

fn part_of(a: &mut Algebra, whole: &Value, step: &Step) -> Option<Value> {
    match step {
        Step::Field(name) => whole.field(a, name),
        Step::Inside => match whole {
            Value::Optional(of) => Some(of.value.clone()),
            _ => None,
        },
        Step::Index(index) => whole.element(a, *index),
        Step::Computed(index) => whole.select_element(a, *index),
        Step::Part { first, len } => match whole {
            Value::Array(values) => values.get(*first..first + len).map(|part| Value::Array(part.to_vec())),
            _ => None,
        },
    }
}

/// Returns `whole` with one of its parts replaced.
fn with_part(a: &mut Algebra, whole: &Value, step: &Step, part: Value) -> Option<Value> {
    if let Value::List(items) = whole {
        let index = match step {
            Step::Index(index) => a.count(*index),
            Step::Computed(index) => *index,
            Step::Field(_) | Step::Inside | Step::Part { .. } => return None,
        };
        return lists::with_ranked(a, items, index, &part);
    }
    if let Step::Computed(chosen) = step {
        let mut changed = whole.clone();
        for index in 0..whole.elements(a).len() {
            let number = a.count(index);
            let (is_here, step) = (Condition::equal(a, *chosen, number), Step::Index(index));
            let before = part_of(a, whole, &step)?;
            let now = part.select(a, &is_here, &before)?;
            changed = with_part(a, &changed, &step, now)?;
        }
        return Some(changed);
    }
    let name = match step {
        Step::Field(name) => name.clone(),
        _ => String::new(),
    };
    let place = |letters: &str| match step {
        Step::Index(index) => Some(*index),
        Step::Computed(_) | Step::Inside | Step::Part { .. } => None,
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
            let (u, w) = q.parts;
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
        (Value::Array(values), part) => match (step, part) {
            (Step::Index(index), part) => Value::Array(with(values, *index, part)?),
            (Step::Part { first, len }, Value::Array(part)) if part.len() == *len => {
                let mut values = values.clone();
                values.get_mut(*first..first + len)?.clone_from_slice(&part);
                Value::Array(values)
            }
            _ => return None,
        },
        (Value::Optional(of), value) => {
            let Step::Inside = step else { return None };
            Value::Optional(Rc::new(Optional { is_some: of.is_some.clone(), value }))
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
