//! What is assigned to: a variable, or a part of one.

use aim_symbolic::Scalar;
use syn::{Expr, Member, UnOp};

use super::algebra::Algebra;
use super::map::{Affine, Map, Quaternion};
use super::value::{Struct, Value};
use super::{Translation, square, strip};
use crate::differentiate::messages;

/// A step from a value to a part of it.
enum Step {
    Field(Member),
    Index(usize),
}

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
        let mut steps = Vec::new();
        let Some(place) = self.place(target, &mut steps) else { return Value::Unknown };
        if place < self.frame.captured() {
            return self.refuse(target, messages::captured());
        }
        if steps.is_empty() {
            self.frame.assign(place, value);
            return Value::nothing();
        }
        let whole = self.frame.value(place).clone();
        if whole.is_unknown() || value.is_unknown() {
            self.frame.assign(place, Value::Unknown);
            return Value::Unknown;
        }
        match replaced(self.algebra, &whole, &steps, value) {
            Some(whole) => {
                self.frame.assign(place, whole);
                Value::nothing()
            }
            None => self.refuse(target, messages::no_part_to_assign(&whole.describe())),
        }
    }

    /// The variable of a place and the way from it; `None` after an error.
    fn place(&mut self, target: &Expr, steps: &mut Vec<Step>) -> Option<usize> {
        match strip(target) {
            Expr::Path(path) => {
                let name = path.path.get_ident()?;
                // A constant is not assigned to: the compiler says so.
                self.frame.find(&name.to_string())
            }
            Expr::Field(field) => {
                let place = self.place(&field.base, steps)?;
                steps.push(Step::Field(field.member.clone()));
                Some(place)
            }
            Expr::Index(index) => {
                let place = self.place(&index.expr, steps)?;
                let value = self.expression(&index.index);
                match self.algebra.known_index(&value) {
                    Some(known) => steps.push(Step::Index(known)),
                    None => {
                        self.refuse_known(&value, &index.index, messages::index_unknown());
                        return None;
                    }
                }
                Some(place)
            }
            Expr::Unary(unary) if matches!(unary.op, UnOp::Deref(_)) => {
                let inner = self.expression(&unary.expr);
                self.refuse_known(&inner, &unary.op, messages::assigned_through_reference());
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
    }
}

/// `whole` with one of its parts replaced.
fn with_part(a: &mut Algebra, whole: &Value, step: &Step, part: Value) -> Option<Value> {
    let name = match step {
        Step::Field(member) => super::fields::name_of(member),
        Step::Index(_) => String::new(),
    };
    let place = |letters: &str| match step {
        Step::Index(index) => Some(*index),
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
            Value::Struct(std::rc::Rc::new(Struct { name: of.name.clone(), fields: fields.collect() }))
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
