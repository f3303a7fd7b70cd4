//! [`Value`]: what an expression of the function stands for.

use std::rc::Rc;

use aim_symbolic::{Scalar, Vector};

use super::algebra::Algebra;
use super::condition::Condition;
use super::functions::Callable;
use super::map::{Affine, Map, Quaternion};
use super::places::Place;
use super::square::{self, Columns};

/// What an expression stands for.
#[derive(Clone, Debug)]
pub(crate) enum Value {
    Scalar(Scalar),
    /// A whole number; one that is known is a constant.
    Integer(Scalar),
    Truth(Condition),
    /// A vector of two: its third component is 0.
    Planar(Vector),
    Vector(Vector),
    /// A vector of four.
    Four([Scalar; 4]),
    Quaternion(Quaternion),
    Matrix(Map),
    /// A matrix of two or four columns.
    Square(Columns),
    /// A matrix of four columns that is an affine transform.
    Homogeneous(Affine),
    Affine(Affine),
    Tuple(Vec<Self>),
    Array(Vec<Self>),
    Struct(Rc<Struct>),
    Function(Rc<Callable>),
    /// `&mut` of a place.
    Reference(Rc<Place>),
    /// What an iterator goes over.
    Sequence(Vec<Self>),
    /// Of an expression that control does not come out of.
    Never,
    /// What an error was reported for: nothing more is said about it.
    Unknown,
}

/// A value of a struct of the module.
#[derive(Clone, Debug)]
pub(crate) struct Struct {
    pub(crate) name: String,
    /// The fields that are understood, by name or by number.
    pub(crate) fields: Vec<(String, Value)>,
}

impl Struct {
    /// The same struct with other values in its fields.
    fn with(&self, values: Vec<Value>) -> Rc<Self> {
        let fields = self.fields.iter().zip(values).map(|((name, _), value)| (name.clone(), value)).collect();
        Rc::new(Self { name: self.name.clone(), fields })
    }

    pub(crate) fn field(&self, name: &str) -> Option<&Value> {
        self.fields.iter().find(|(known, _)| known == name).map(|(_, value)| value)
    }
}

impl Value {
    /// Its kind, for a message.
    pub(crate) fn describe(&self) -> String {
        match self {
            Self::Scalar(_) => "a number".into(),
            Self::Integer(_) => "a whole number".into(),
            Self::Truth(_) => "a condition".into(),
            Self::Planar(_) => "a vector of two".into(),
            Self::Vector(_) => "a vector".into(),
            Self::Four(_) => "a vector of four".into(),
            Self::Quaternion(_) => "a quaternion".into(),
            Self::Matrix(_) => "a matrix".into(),
            Self::Square(columns) if columns.len() == 2 => "a matrix of two".into(),
            Self::Square(_) | Self::Homogeneous(_) => "a matrix of four".into(),
            Self::Affine(_) => "a transform".into(),
            Self::Tuple(values) if values.is_empty() => "nothing".into(),
            Self::Tuple(values) => format!("a tuple of {}", values.len()),
            Self::Array(values) => format!("an array of {}", values.len()),
            Self::Struct(of) => format!("a `{}`", of.name),
            Self::Function(_) => "a function".into(),
            Self::Reference(_) => "a reference that changes what it refers to".into(),
            Self::Sequence(values) => format!("an iterator over {}", values.len()),
            Self::Never | Self::Unknown => "an expression".into(),
        }
    }

    /// The value of an expression that has none.
    pub(crate) fn nothing() -> Self {
        Self::Tuple(Vec::new())
    }

    pub(crate) fn is_never(&self) -> bool {
        matches!(self, Self::Never)
    }

    /// Whether nothing more can be said about it.
    pub(crate) fn is_unknown(&self) -> bool {
        matches!(self, Self::Unknown | Self::Never)
    }

    /// `self` where the condition holds, else `otherwise`; `None` where they are of two kinds.
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
            (Self::Integer(x), Self::Integer(y)) => Self::Integer(condition.select(a, *x, *y)),
            (Self::Scalar(x), Self::Scalar(y)) => Self::Scalar(condition.select(a, *x, *y)),
            (Self::Planar(v), Self::Planar(w)) => Self::Planar(condition.select_vector(a, *v, *w)),
            (Self::Vector(v), Self::Vector(w)) => Self::Vector(condition.select_vector(a, *v, *w)),
            (Self::Four(x), Self::Four(y)) => Self::Four(core::array::from_fn(|k| condition.select(a, x[k], y[k]))),
            (Self::Truth(x), Self::Truth(y)) => {
                let then = condition.clone().and(x.clone());
                let otherwise = condition.clone().not().and(y.clone());
                Self::Truth(then.or(otherwise))
            }
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
            (Self::Tuple(x), Self::Tuple(y)) => Self::Tuple(each(a, x, y)?),
            (Self::Array(x), Self::Array(y)) => Self::Array(each(a, x, y)?),
            (Self::Struct(x), Self::Struct(y)) if x.name == y.name => {
                let [then, otherwise] =
                    [x, y].map(|of| of.fields.iter().map(|(_, value)| value.clone()).collect::<Vec<_>>());
                Self::Struct(x.with(each(a, &then, &otherwise)?))
            }
            _ => return None,
        })
    }
}
