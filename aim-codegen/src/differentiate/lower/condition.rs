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
    /// a ≤ b: nothing is smaller than that.
    pub(crate) fn at_most(a: Scalar, b: Scalar) -> Self {
        Self::Not(Rc::new(Self::Less(b, a)))
    }

    pub(crate) fn equal(a: Scalar, b: Scalar) -> Self {
        Self::And(Rc::new((Self::at_most(a, b), Self::at_most(b, a))))
    }

    pub(crate) fn not(self) -> Self {
        match self {
            Self::Known(truth) => Self::Known(!truth),
            Self::Not(inner) => (*inner).clone(),
            other => Self::Not(Rc::new(other)),
        }
    }

    pub(crate) fn select(&self, a: &mut Algebra, then: Scalar, otherwise: Scalar) -> Scalar {
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
