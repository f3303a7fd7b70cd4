//! [`Condition`]: a condition that values are selected by.

use std::cell::Cell;
use std::rc::Rc;

use aim_symbolic::{Scalar, Vector};

use super::algebra::Algebra;

/// Maximum depth to which combinations are examined.
pub(super) const DEEPEST: usize = 8;

/// A comparison, or a combination of comparisons.
#[derive(Clone, Debug)]
pub(crate) enum Condition {
    Known(bool),
    /// a < b.
    Less(Scalar, Scalar),
    Not(Rc<Self>),
    And(Rc<Operands>),
    Or(Rc<Operands>),
}

/// The operands of a combination.
#[derive(Debug)]
pub(crate) struct Operands {
    one: Condition,
    other: Condition,
    /// Cached number: 1 where the combination holds, else 0.
    flag: Cell<Option<Scalar>>,
}

impl Operands {
    fn new(one: Condition, other: Condition) -> Rc<Self> {
        Rc::new(Self { one, other, flag: Cell::new(None) })
    }
}

impl Condition {
    /// Returns the condition x < y; decided if both are constant.
    pub(crate) fn less(a: &Algebra, x: Scalar, y: Scalar) -> Self {
        match (a.known(x), a.known(y)) {
            (Some(x), Some(y)) => Self::Known(x < y),
            _ => Self::Less(x, y),
        }
    }

    /// Returns the condition that a whole number is a valid index into `count` elements.
    pub(super) fn is_index(a: &mut Algebra, index: Scalar, count: Scalar) -> Self {
        let zero = a.number(0.0);
        Self::less(a, index, zero).not().and(Self::less(a, index, count))
    }

    /// Returns the condition x ≤ y, as ¬(y < x).
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
            (one, other) => Self::And(Operands::new(one, other)),
        }
    }

    pub(crate) fn or(self, other: Self) -> Self {
        match (self, other) {
            (Self::Known(false), condition) | (condition, Self::Known(false)) => condition,
            (Self::Known(true), _) | (_, Self::Known(true)) => Self::Known(true),
            (one, other) => Self::Or(Operands::new(one, other)),
        }
    }

    pub(crate) fn not(self) -> Self {
        match self {
            Self::Known(truth) => Self::Known(!truth),
            Self::Not(inner) => (*inner).clone(),
            other => Self::Not(Rc::new(other)),
        }
    }

    /// Returns the condition that is `then` where `condition` holds, else `otherwise`.
    pub(crate) fn either(condition: &Self, then: &Self, otherwise: &Self) -> Self {
        if let (Self::Known(x), Self::Known(y)) = (then, otherwise)
            && x == y
        {
            return then.clone();
        }
        condition.clone().and(then.clone()).or(condition.clone().not().and(otherwise.clone()))
    }

    /// Returns the operands of a combination.
    pub(super) fn parts(&self) -> Option<(Self, Self)> {
        match self {
            Self::And(operands) | Self::Or(operands) => Some((operands.one.clone(), operands.other.clone())),
            _ => None,
        }
    }

    /// Returns the conditions whose conjunction this is, splitting combinations down to `depth`.
    pub(super) fn conjuncts(self, depth: usize) -> Vec<Self> {
        let parts = match &self {
            _ if depth == 0 => None,
            Self::And(_) => self.parts(),
            Self::Not(inner) if matches!(**inner, Self::Or(_)) => {
                inner.parts().map(|(one, other)| (one.not(), other.not()))
            }
            _ => None,
        };
        match parts {
            Some((one, other)) => [one, other].into_iter().flat_map(|part| part.conjuncts(depth - 1)).collect(),
            None => vec![self],
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
            Self::And(_) | Self::Or(_) => {
                let (zero, flag) = (a.number(0.0), self.flag(a));
                a.select_less(zero, flag, then, otherwise)
            }
        }
    }

    /// Returns 1 where the condition holds, else 0. A combination is evaluated once, however often it is used.
    fn flag(&self, a: &mut Algebra) -> Scalar {
        let (zero, one) = (a.number(0.0), a.number(1.0));
        let (Self::And(operands) | Self::Or(operands)) = self else { return self.select(a, one, zero) };
        if let Some(known) = operands.flag.get() {
            return known;
        }
        let other = operands.other.flag(a);
        let flag = match self {
            Self::And(_) => operands.one.select(a, other, zero),
            _ => operands.one.select(a, one, other),
        };
        operands.flag.set(Some(flag));
        flag
    }

    pub(crate) fn select_vector(&self, a: &mut Algebra, then: Vector, otherwise: Vector) -> Vector {
        if then == otherwise {
            return then;
        }
        a.zip(then, otherwise, |a, then, otherwise| self.select(a, then, otherwise))
    }
}
