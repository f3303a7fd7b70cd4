//! [`Value`]: what an expression of the function stands for.

use std::rc::Rc;

use aim_symbolic::{Scalar, Vector};

use super::algebra::Algebra;
use super::condition::Condition;
use super::map::{Affine, Map, Quaternion};

/// What an expression stands for.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Scalar(Scalar),
    Truth(Condition),
    /// A vector of two: its third component is 0.
    Planar(Vector),
    Vector(Vector),
    Quaternion(Quaternion),
    Matrix(Map),
    Affine(Affine),
    Tuple(Vec<Self>),
    Array(Vec<Self>),
    /// What an error was reported for: nothing more is said about it.
    Unknown,
}

impl Value {
    /// Its kind, for a message.
    pub(crate) fn describe(&self) -> String {
        match self {
            Self::Scalar(_) => "a number".into(),
            Self::Truth(_) => "a condition".into(),
            Self::Planar(_) => "a vector of two".into(),
            Self::Vector(_) => "a vector".into(),
            Self::Quaternion(_) => "a quaternion".into(),
            Self::Matrix(_) => "a matrix".into(),
            Self::Affine(_) => "a transform".into(),
            Self::Tuple(values) if values.is_empty() => "nothing".into(),
            Self::Tuple(values) => format!("a tuple of {}", values.len()),
            Self::Array(values) => format!("an array of {}", values.len()),
            Self::Unknown => "an expression".into(),
        }
    }

    pub(crate) fn is_unknown(&self) -> bool {
        matches!(self, Self::Unknown)
    }

    /// `self` where the condition holds, else `otherwise`; `None` where they are of two kinds.
    pub(crate) fn select(&self, a: &mut Algebra, condition: &Condition, otherwise: &Self) -> Option<Self> {
        let each = |a: &mut Algebra, then: &[Self], otherwise: &[Self]| -> Option<Vec<Self>> {
            if then.len() != otherwise.len() {
                return None;
            }
            then.iter().zip(otherwise).map(|(then, otherwise)| then.select(a, condition, otherwise)).collect()
        };
        let maps =
            |then: &Map, otherwise: &Map| Map::Select(Rc::new((condition.clone(), then.clone(), otherwise.clone())));
        Some(match (self, otherwise) {
            (Self::Unknown, _) | (_, Self::Unknown) => Self::Unknown,
            (Self::Scalar(x), Self::Scalar(y)) => Self::Scalar(condition.select(a, *x, *y)),
            (Self::Planar(v), Self::Planar(w)) => Self::Planar(condition.select_vector(a, *v, *w)),
            (Self::Vector(v), Self::Vector(w)) => Self::Vector(condition.select_vector(a, *v, *w)),
            (Self::Truth(x), Self::Truth(y)) => {
                let then = Condition::And(Rc::new((condition.clone(), x.clone())));
                let opposite = Condition::Not(Rc::new(condition.clone()));
                let otherwise = Condition::And(Rc::new((opposite, y.clone())));
                Self::Truth(Condition::Or(Rc::new((then, otherwise))))
            }
            (Self::Quaternion(q), Self::Quaternion(r)) => {
                let parts = q
                    .parts
                    .zip(r.parts)
                    .map(|((u, w), (v, x))| (condition.select_vector(a, u, v), condition.select(a, w, x)));
                Self::Quaternion(Quaternion { map: maps(&q.map, &r.map), parts })
            }
            (Self::Matrix(m), Self::Matrix(n)) => Self::Matrix(maps(m, n)),
            (Self::Affine(m), Self::Affine(n)) => Self::Affine(Affine {
                map: maps(&m.map, &n.map),
                translation: condition.select_vector(a, m.translation, n.translation),
            }),
            (Self::Tuple(x), Self::Tuple(y)) => Self::Tuple(each(a, x, y)?),
            (Self::Array(x), Self::Array(y)) => Self::Array(each(a, x, y)?),
            _ => return None,
        })
    }
}
