//! Selects between two values by a condition.

use std::rc::Rc;

use super::algebra::Algebra;
use super::condition::Condition;
use super::map::{Affine, Map};
use super::value::{Optional, Order, Slice, Struct, Value};
use super::{lists, square};

impl Struct {
    /// Returns the same struct with other values in its fields.
    pub(super) fn with(&self, values: Vec<Value>) -> Rc<Self> {
        let fields = self.fields.iter().zip(values).map(|((name, _), value)| (name.clone(), value)).collect();
        Rc::new(Self { name: self.name.clone(), fields })
    }
}

impl Value {
    /// Returns `self` where the condition holds, else `otherwise`; `None` if their kinds differ.
    pub(crate) fn select(&self, a: &mut Algebra, condition: &Condition, otherwise: &Self) -> Option<Self> {
        let each = |a: &mut Algebra, then: &[Self], otherwise: &[Self]| -> Option<Vec<Self>> {
            if then.len() != otherwise.len() {
                return None;
            }
            then.iter().zip(otherwise).map(|(then, otherwise)| then.select(a, condition, otherwise)).collect()
        };
        Some(match (self, otherwise) {
            (Self::Unknown, _) | (_, Self::Unknown) => Self::Unknown,
            (Self::Never, value) | (value, Self::Never) => value.clone(),
            _ if matches!(condition, Condition::Known(true)) => self.clone(),
            _ if matches!(condition, Condition::Known(false)) => otherwise.clone(),
            (Self::Integer(x), Self::Integer(y)) => Self::Integer(condition.select(a, *x, *y)),
            (Self::Scalar(x), Self::Scalar(y)) => Self::Scalar(condition.select(a, *x, *y)),
            (Self::Planar(v), Self::Planar(w)) => Self::Planar(condition.select_vector(a, *v, *w)),
            (Self::Vector(v), Self::Vector(w)) => Self::Vector(condition.select_vector(a, *v, *w)),
            (Self::Four(x), Self::Four(y)) => Self::Four(core::array::from_fn(|k| condition.select(a, x[k], y[k]))),
            (Self::Truth(x), Self::Truth(y)) => Self::Truth(Condition::either(condition, x, y)),
            (Self::Quaternion(q), Self::Quaternion(r)) => Self::Quaternion(q.select(a, condition, r)),
            (Self::Matrix(m), Self::Matrix(n)) => Self::Matrix(Map::select(a, condition, m, n)),
            (Self::Homogeneous(m), Self::Homogeneous(n)) => {
                let [m, n] = [m, n].map(|m| Self::Affine(m.clone()));
                match m.select(a, condition, &n)? {
                    Self::Affine(m) => Self::Homogeneous(m),
                    _ => return None,
                }
            }
            (Self::Square(_) | Self::Homogeneous(_), Self::Square(_) | Self::Homogeneous(_)) => {
                let (m, n) = (square::columns(a, self)?, square::columns(a, otherwise)?);
                if m.len() != n.len() {
                    return None;
                }
                Self::Square(square::zip(a, &m, &n, |a, x, y| condition.select(a, x, y)))
            }
            (Self::Affine(m), Self::Affine(n)) => Self::Affine(Affine {
                map: Map::select(a, condition, &m.map, &n.map),
                translation: condition.select_vector(a, m.translation, n.translation),
            }),
            (Self::Optional(x), Self::Optional(y)) => {
                let is_some = Condition::either(condition, &x.is_some, &y.is_some);
                // Absent values need no select.
                Self::Optional(Rc::new(Optional { is_some, value: x.value.select(a, condition, &y.value)? }))
            }
            (Self::Ordering(x), Self::Ordering(y)) => Self::Ordering(Rc::new(Order {
                less: Condition::either(condition, &x.less, &y.less),
                greater: Condition::either(condition, &x.greater, &y.greater),
            })),
            // Parts of the same slice.
            (Self::Slice(x), Self::Slice(y)) if x.place == y.place => {
                let (first, len) = (condition.select(a, x.first, y.first), condition.select(a, x.len, y.len));
                Self::Slice(Rc::new(Slice { first, len, ..(**x).clone() }))
            }
            (Self::Tuple(x), Self::Tuple(y)) => Self::Tuple(each(a, x, y)?),
            (Self::Array(x), Self::Array(y)) if x.len() == y.len() => Self::Array(each(a, x, y)?),
            (Self::Array(_) | Self::List(_), Self::Array(_) | Self::List(_)) => {
                Self::list(lists::select(a, condition, &self.clone().items()?, &otherwise.clone().items()?)?)
            }
            (Self::Iterator(x), Self::Iterator(y)) => Self::Iterator(lists::select(a, condition, x, y)?),
            (Self::Struct(x), Self::Struct(y)) if x.name == y.name => {
                let [then, otherwise] =
                    [x, y].map(|of| of.fields.iter().map(|(_, value)| value.clone()).collect::<Vec<_>>());
                Self::Struct(x.with(each(a, &then, &otherwise)?))
            }
            _ => return None,
        })
    }
}
