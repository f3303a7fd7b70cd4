//! [`Condition`]: what a value may depend on.

use std::rc::Rc;

use aim_symbolic::{Scalar, Vector};

use super::algebra::Algebra;

/// A comparison, or a combination of comparisons.
#[derive(Clone, Debug)]
pub(crate) enum Condition {
    Known(bool),
    /// a < b
    Less(Scalar, Scalar),
    Not(Rc<Self>),
    And(Rc<(Self, Self)>),
    Or(Rc<(Self, Self)>),
}

impl Condition {
    /// x < y, known of constants.
    pub(crate) fn less(a: &Algebra, x: Scalar, y: Scalar) -> Self {
        match (a.constant_of(x), a.constant_of(y)) {
            (Some(x), Some(y)) => Self::Known(x < y),
            _ => Self::Less(x, y),
        }
    }

    /// x ≤ y: nothing is smaller than that.
    pub(crate) fn at_most(a: &Algebra, x: Scalar, y: Scalar) -> Self {
        Self::less(a, y, x).not()
    }

    pub(crate) fn equal(a: &Algebra, x: Scalar, y: Scalar) -> Self {
        Self::at_most(a, x, y).and(Self::at_most(a, y, x))
    }

    pub(crate) fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Known(true), condition) | (condition, Self::Known(true)) => condition,
            (Self::Known(false), _) | (_, Self::Known(false)) => Self::Known(false),
            (one, other) => Self::And(Rc::new((one, other))),
        }
    }

    pub(crate) fn or(self, other: Self) -> Self {
        match (self, other) {
            (Self::Known(false), condition) | (condition, Self::Known(false)) => condition,
            (Self::Known(true), _) | (_, Self::Known(true)) => Self::Known(true),
            (one, other) => Self::Or(Rc::new((one, other))),
        }
    }

    pub(crate) fn not(self) -> Self {
        match self {
            Self::Known(truth) => Self::Known(!truth),
            Self::Not(inner) => (*inner).clone(),
            other => Self::Not(Rc::new(other)),
        }
    }

    pub(crate) fn select(&self, a: &mut Algebra, then: Scalar, otherwise: Scalar) -> Scalar {
        if then == otherwise {
            return then;
        }
        match self {
            Self::Known(true) => then,
            Self::Known(false) => otherwise,
            Self::Less(x, y) => a.select_less(*x, *y, then, otherwise),
            Self::Not(inner) => inner.select(a, otherwise, then),
            Self::And(both) => {
                let inner = both.1.select(a, then, otherwise);
                both.0.select(a, inner, otherwise)
            }
            Self::Or(either) => {
                let inner = either.1.select(a, then, otherwise);
                either.0.select(a, then, inner)
            }
        }
    }

    pub(crate) fn select_vector(&self, a: &mut Algebra, then: Vector, otherwise: Vector) -> Vector {
        if then == otherwise {
            return then;
        }
        a.zip(then, otherwise, |a, then, otherwise| self.select(a, then, otherwise))
    }
}
