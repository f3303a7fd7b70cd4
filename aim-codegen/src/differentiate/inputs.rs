//! [`Inputs`]: an argument's numbers as values of the graph.

use std::rc::Rc;

use aim_symbolic::{Scalar, Vector};
use quote::ToTokens;

use super::lower::{Affine, Algebra, Condition, Map, Optional, Quaternion, Slice, Struct, TAG, Value, field_of};
use super::manifold::VaryingPart;
use super::types::{Shape, Type};

/// The numbers of an argument, consumed part by part.
pub(super) struct Inputs<'a> {
    a: &'a mut Algebra,
    numbers: std::vec::IntoIter<Scalar>,
    varying_part: VaryingPart,
    /// Inputs that derivatives are taken with respect to, in the order of the argument's parts.
    pub(super) variables: Vec<Scalar>,
    /// Number of slices so far, including those of earlier arguments.
    pub(super) slices: usize,
}

impl<'a> Inputs<'a> {
    pub(super) fn new(a: &'a mut Algebra, numbers: Vec<Scalar>, varying_part: VaryingPart, slices: usize) -> Self {
        Self { a, numbers: numbers.into_iter(), varying_part, variables: Vec::new(), slices }
    }

    /// Builds a value of type `ty` from the next numbers. Transforms are assumed rigid, quaternions that are not
    /// variables to have length 1; matrices are arbitrary. If derivatives are taken with respect to tangents,
    /// quaternions and matrices are rotations.
    pub(super) fn value(&mut self, ty: &Type) -> Value {
        let mut parts = |types: &[&Type]| -> Vec<Value> { types.iter().map(|ty| self.value(ty)).collect() };
        match &ty.shape {
            Shape::Array(element, length) => Value::Array(parts(&vec![&**element; *length])),
            Shape::Optional(inner) => {
                let is_some = match self.leaf(&Type::truth()) {
                    Value::Truth(condition) => condition,
                    _ => Condition::Known(true),
                };
                Value::Optional(Rc::new(Optional { is_some, value: self.value(inner) }))
            }
            Shape::Slice(element) => {
                let (len, place) = (self.next(), self.slices);
                self.slices += 1;
                self.a.set_extent(len, 0.0, f64::INFINITY);
                let (components, element) = (element.components(), element.clone());
                // Elements contain no slices.
                let make =
                    move |a: &mut Algebra, numbers| Inputs::new(a, numbers, VaryingPart::Nothing, 0).value(&element);
                let first = self.a.number(0.0);
                Value::Slice(Rc::new(Slice { place, components, make: Rc::new(make), first, len }))
            }
            Shape::Tuple(types) => Value::Tuple(parts(&types.iter().collect::<Vec<_>>())),
            Shape::Struct(name, fields, _) => {
                let values = parts(&fields.iter().map(|(_, ty)| ty).collect::<Vec<_>>());
                let names = fields.iter().map(|(member, _)| member.to_token_stream().to_string());
                Value::Struct(Rc::new(Struct { name: name.clone(), fields: names.zip(values).collect() }))
            }
            Shape::Enum(name, variants) => {
                let tag = self.leaf(&Type::choice(variants.len()));
                let mut fields = vec![(TAG.to_owned(), tag)];
                for variant in variants {
                    for (member, ty) in &variant.fields {
                        fields.push((field_of(&variant.name.to_string(), member), self.value(ty)));
                    }
                }
                Value::Struct(Rc::new(Struct { name: name.clone(), fields }))
            }
            _ => self.leaf(ty),
        }
    }

    /// Returns the next number. As many were declared as the type has, so there always is one.
    fn next(&mut self) -> Scalar {
        self.numbers.next().expect("a type has as many numbers as were declared for it")
    }

    fn take<const N: usize>(&mut self) -> [Scalar; N] {
        core::array::from_fn(|_| self.next())
    }

    fn column(&mut self) -> Vector {
        let numbers = self.take();
        self.a.vector(numbers)
    }

    /// Builds a value that is not composed of others. Each of its numbers varies independently, or its tangent does.
    fn leaf(&mut self, ty: &Type) -> Value {
        if let VaryingPart::Tangent(side) = self.varying_part {
            match ty.shape {
                Shape::Quaternion => {
                    let numbers = self.take();
                    let (q, step) = side.quaternion(self.a, numbers);
                    self.variables.extend(step);
                    return Value::Quaternion(q);
                }
                Shape::Matrix => {
                    let numbers = self.take();
                    let (m, step) = side.matrix(self.a, numbers);
                    self.variables.extend(step);
                    return Value::Matrix(m);
                }
                Shape::Rigid => {
                    let (numbers, translation) = (self.take(), self.column());
                    let (m, step) = side.rigid(self.a, numbers, translation);
                    self.variables.extend(step);
                    return Value::Affine(m);
                }
                _ => {}
            }
        }
        if self.varying_part != VaryingPart::Nothing && !ty.is_discrete() {
            self.variables.extend(self.numbers.as_slice().iter().take(ty.components()));
        }
        match ty.shape {
            Shape::Truth => {
                let zero = self.a.number(0.0);
                Value::Truth(Condition::Less(zero, self.next()))
            }
            Shape::Integer | Shape::Choice(_) => {
                let number = self.next();
                let (least, most) = ty.extent();
                self.a.set_extent(number, least, most);
                Value::Integer(number)
            }
            Shape::Planar => {
                let ([x, y], zero) = (self.take(), self.a.number(0.0));
                Value::Planar(self.a.vector([x, y, zero]))
            }
            Shape::Vector => Value::Vector(self.column()),
            Shape::Four => Value::Four(self.take()),
            Shape::Quaternion => {
                let (u, w) = (self.column(), self.next());
                Value::Quaternion(match self.varying_part {
                    VaryingPart::Nothing => Quaternion::unit(self.a, u, w),
                    _ => Quaternion::from_parts(u, w),
                })
            }
            Shape::Matrix => Value::Matrix(Map::Columns([0; 3].map(|_| self.column()))),
            Shape::Square(count) => {
                Value::Square((0..count).map(|_| (0..count).map(|_| self.next()).collect()).collect())
            }
            Shape::Rigid => {
                // glam's columns are the images of the axes, and so are the graph's rows.
                let rows = self.take();
                let map = Map::Rotation(self.a.g.matrix(rows));
                Value::Affine(Affine { map, translation: self.column() })
            }
            _ => Value::Scalar(self.next()),
        }
    }
}
