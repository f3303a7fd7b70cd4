//! [`Bound`]: a condition on one number, which may decide another condition: if x < 0, then −x < 0 is false.

use aim_symbolic::{Op, Scalar, ScalarNode};

use super::algebra::Algebra;
use super::condition::Condition;

/// The condition `x < at`, or `x > at` if `above`. Equality also satisfies it, unless `strict`.
#[derive(Clone, Copy)]
pub(super) struct Bound {
    pub(super) x: Scalar,
    pub(super) above: bool,
    pub(super) at: f64,
    pub(super) strict: bool,
}

/// The number `k x + c`.
#[derive(Clone, Copy)]
pub(super) struct Linear {
    pub(super) x: Option<Scalar>,
    pub(super) k: f64,
    pub(super) c: f64,
}

impl Linear {
    pub(super) fn of(a: &Algebra, mut s: Scalar) -> Self {
        let (mut k, mut c) = (1.0, 0.0);
        loop {
            if let Some(constant) = a.constant_of(s) {
                return Self { x: None, k: 0.0, c: c + k * constant };
            }
            s = match a.g.scalar_node(s) {
                ScalarNode::Op(Op::Neg(inner)) => {
                    k = -k;
                    inner
                }
                ScalarNode::Op(op @ (Op::Add(one, other) | Op::Sub(one, other))) => {
                    let sign = if matches!(op, Op::Add(..)) { 1.0 } else { -1.0 };
                    match (a.constant_of(one), a.constant_of(other)) {
                        (Some(one), None) => {
                            (k, c) = (k * sign, c + k * one);
                            other
                        }
                        (None, Some(other)) => {
                            c += k * sign * other;
                            one
                        }
                        _ => return Self { x: Some(s), k, c },
                    }
                }
                ScalarNode::Op(Op::Mul(one, other)) => match (a.constant_of(one), a.constant_of(other)) {
                    (Some(factor), None) => {
                        k *= factor;
                        other
                    }
                    (None, Some(factor)) => {
                        k *= factor;
                        one
                    }
                    _ => return Self { x: Some(s), k, c },
                },
                _ => return Self { x: Some(s), k, c },
            };
        }
    }
}

impl Bound {
    /// Returns the bound that a comparison sets to one number; `None` if it compares several, or is a combination.
    pub(super) fn of(a: &Algebra, condition: &Condition) -> Option<Self> {
        match condition {
            Condition::Less(one, other) => {
                let (one, other) = (Linear::of(a, *one), Linear::of(a, *other));
                let x = one.x.or(other.x)?;
                if [one.x, other.x].into_iter().flatten().any(|of| of != x) {
                    return None;
                }
                let k = one.k - other.k;
                let at = (other.c - one.c) / k;
                at.is_finite().then_some(Self { x, above: k < 0.0, at, strict: true })
            }
            Condition::Not(inner) => {
                let bound = Self::of(a, inner)?;
                Some(Self { above: !bound.above, strict: !bound.strict, ..bound })
            }
            _ => None,
        }
    }

    /// Returns `true` if `other` holds wherever this bound does, `false` if it holds nowhere there, `None` if that
    /// depends.
    pub(super) fn decides(self, other: Self) -> Option<bool> {
        let (here, there) = if self.above { (-self.at, -other.at) } else { (self.at, other.at) };
        if self.x != other.x {
            None
        } else if self.above == other.above {
            (here < there || here == there && (self.strict || !other.strict)).then_some(true)
        } else {
            (there > here || here == there && (self.strict || other.strict)).then_some(false)
        }
    }
}
