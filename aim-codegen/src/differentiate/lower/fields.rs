//! Parts of values: fields, swizzles, elements.

use aim_symbolic::Scalar;
use quote::ToTokens;
use syn::{Expr, ExprField, ExprIndex, Member};

use super::algebra::Algebra;
use super::condition::Condition;
use super::expected::Expected;
use super::iterators::ranks;
use super::map::Map;
use super::value::Value;
use super::{Translation, is_place, lists, square, strip};
use crate::differentiate::messages;

/// Returns a field's name as written.
pub(super) fn name_of(member: &Member) -> String {
    match member {
        Member::Named(name) => name.to_string(),
        Member::Unnamed(index) => index.index.to_string(),
    }
}

/// Returns the index of a matrix's column, by its name.
pub(super) fn column(name: &str) -> Option<usize> {
    ["x_axis", "y_axis", "z_axis", "w_axis"].iter().position(|known| *known == name)
}

impl Value {
    /// Returns a field of the value.
    pub(super) fn field(&self, a: &mut Algebra, name: &str) -> Option<Self> {
        let letter = |letters: &str| if name.len() == 1 { letters.find(name) } else { None };
        match self {
            Self::Planar(v) => letter("xy").map(|axis| Self::Scalar(a.component(*v, axis))),
            Self::Vector(v) => letter("xyz").map(|axis| Self::Scalar(a.component(*v, axis))),
            Self::Four(parts) => letter("xyzw").map(|axis| Self::Scalar(parts[axis])),
            Self::Quaternion(q) => {
                let (u, w) = q.parts;
                if matches!(q.map, Map::Rotation(_)) {
                    a.unit_parts.insert(w, u);
                }
                letter("xyzw").map(|axis| Self::Scalar(if axis == 3 { w } else { a.component(u, axis) }))
            }
            Self::Matrix(m) => column(name).filter(|&axis| axis < 3).map(|axis| Self::Vector(m.column(a, axis))),
            Self::Square(_) | Self::Homogeneous(_) => {
                let columns = square::columns(a, self)?;
                columns.get(column(name)?).map(|column| square::vector(a, column))
            }
            Self::Affine(m) => match name {
                "matrix3" => Some(Self::Matrix(m.map.clone())),
                "translation" => Some(Self::Vector(m.translation)),
                _ => Self::Matrix(m.map.clone()).field(a, name),
            },
            Self::Tuple(values) => name.parse::<usize>().ok().and_then(|index| values.get(index).cloned()),
            Self::Struct(of) => of.field(name).cloned(),
            _ => None,
        }
    }

    /// Returns the components of a vector; `None` for any other value.
    pub(super) fn components(&self, a: &mut Algebra) -> Option<Vec<Self>> {
        let count = match self {
            Self::Planar(_) => 2,
            Self::Vector(_) => 3,
            Self::Four(_) => 4,
            _ => return None,
        };
        (0..count).map(|place| self.element(a, place)).collect()
    }

    /// Returns an element of the value.
    pub(super) fn element(&self, a: &mut Algebra, place: usize) -> Option<Self> {
        match self {
            Self::Array(values) => values.get(place).cloned(),
            Self::List(items) if place < items.len() => {
                let place = a.count(place);
                lists::ranked(a, items, place)
            }
            Self::Planar(v) if place < 2 => Some(Self::Scalar(a.component(*v, place))),
            Self::Vector(v) if place < 3 => Some(Self::Scalar(a.component(*v, place))),
            Self::Four(parts) => parts.get(place).map(|&x| Self::Scalar(x)),
            _ => None,
        }
    }

    /// Returns all elements of the value.
    pub(super) fn elements(&self, a: &mut Algebra) -> Vec<Self> {
        (0..).map_while(|place| self.element(a, place)).collect()
    }

    /// Returns the element at a computed index; `None` if there are no elements, or elements of several kinds. If the
    /// index is out of bounds, where the function panics, returns the first or the last element.
    pub(super) fn select_element(&self, a: &mut Algebra, place: Scalar) -> Option<Self> {
        if let Self::List(items) = self {
            return lists::ranked(a, items, place);
        }
        let mut elements = self.elements(a).into_iter().enumerate().rev();
        let (_, last) = elements.next()?;
        elements.try_fold(last, |chosen, (index, element)| {
            let next = a.count(index + 1);
            let is_here = Condition::less(a, place, next);
            element.select(a, &is_here, &chosen)
        })
    }
}

impl Translation<'_> {
    pub(super) fn field(&mut self, field: &ExprField) -> Value {
        let base = self.expression(&field.base);
        self.part(&base, &field.member)
    }

    /// Returns a field of a value; reports an error if it has no such field.
    fn part(&mut self, base: &Value, member: &Member) -> Value {
        let part = self.moved_part(base, member);
        self.referenced(part)
    }

    /// Like [`part`](Self::part), but returns a reference unresolved.
    pub(super) fn moved_part(&mut self, base: &Value, member: &Member) -> Value {
        if base.is_unknown() {
            return Value::Unknown;
        }
        let name = name_of(member);
        if let Some(value) = base.field(self.algebra, &name) {
            return value;
        }
        match base {
            Value::Struct(of) => {
                let known: Vec<&str> = of.fields.iter().map(|(name, _)| name.as_str()).collect();
                self.refuse(member, messages::unknown_struct_field(&name, &of.name, &known))
            }
            _ => self.refuse_known(base, member, messages::unknown_field(&name, &base.describe())),
        }
    }

    pub(super) fn index(&mut self, index: &ExprIndex) -> Value {
        let mut base = self.expression(&index.expr);
        if let Expr::Range(range) = strip(&index.index) {
            return self.slice(&base, range);
        }
        let expected = match base {
            Value::Array(_) | Value::List(_) | Value::Slice(_) => Expected::Named("usize".into()),
            _ => Expected::Any,
        };
        let (place, has_effect) = self.tracked(|this| this.expression_as(&index.index, &expected));
        if has_effect && is_place(&index.expr) {
            // A place is read after its index has been evaluated.
            let read = self.still_place(&index.expr);
            base = read.map_or(Value::Unknown, |place| self.read(&place));
        }
        if base.is_unknown() || place.is_unknown() {
            return Value::Unknown;
        }
        if let Value::Struct(of) = &base {
            let several = self.functions(Some(&of.name), "index");
            if let Some(own) = self.function_for(&several, &[base.clone(), place.clone()]) {
                return self.inline(&index.index, &own, vec![base, place]);
            }
        }
        if let (Value::Slice(slice), Value::Integer(place)) = (&base, &place) {
            return self.element_of(slice, *place);
        }
        let Some(known) = self.algebra.known_index(&place) else {
            return match place {
                Value::Integer(place) => {
                    let chosen = base.select_element(self.algebra, place);
                    chosen.unwrap_or_else(|| self.refuse(&index.index, messages::no_such_choice(&base.describe())))
                }
                _ => self.refuse(&index.index, messages::index_unknown()),
            };
        };
        let value = base.element(self.algebra, known);
        value.unwrap_or_else(|| self.refuse_known(&base, &index.index, messages::index_outside(&base.describe())))
    }

    /// Evaluates `array[start..end]`. If the range is out of bounds, where the function panics, returns the existing
    /// elements.
    fn slice(&mut self, base: &Value, range: &syn::ExprRange) -> Value {
        if let Value::Slice(slice) = base {
            return self.part_of_slice(slice, range).unwrap_or(Value::Unknown);
        }
        let (Value::Array(_) | Value::List(_), Some(items)) = (base, base.clone().items()) else {
            return self.refuse_known(base, range, messages::index_outside(&base.describe()));
        };
        let bound = |this: &mut Self, end: &Option<Box<Expr>>| match end {
            None => Some(None),
            Some(end) => this.count(end).map(Some),
        };
        let (Some(start), Some(end)) = (bound(self, &range.start), bound(self, &range.end)) else {
            return Value::Unknown;
        };
        let is_closed = matches!(range.limits, syn::RangeLimits::Closed(_));
        let a = &mut *self.algebra;
        let known = [start, end].map(|bound| bound.and_then(|bound| a.known_index(&Value::Integer(bound))));
        let end_known = known[1].map_or(items.len(), |end| end + usize::from(is_closed));
        if end_known > items.len() || known[0].is_some_and(|start| start > end_known) {
            return self.refuse(&range.to_token_stream(), messages::index_outside(&base.describe()));
        }
        let ranks = ranks(a, &items);
        Value::list(items.into_iter().zip(ranks).map(|(item, rank)| {
            let is_behind = start.map_or(Condition::Known(true), |start| Condition::at_most(a, start, rank));
            let is_before = end.map_or(Condition::Known(true), |end| match is_closed {
                true => Condition::at_most(a, rank, end),
                false => Condition::less(a, rank, end),
            });
            item.and_where(is_behind.and(is_before))
        }))
    }
}
