//! [`Sparse`]: numbers of which the compiler knows which are 0 and which are 1.

use core::ops::{Add, Div, Mul, Neg, Sub};

use glam::Affine3A;

use super::{Scalar, sealed::Sealed};

/// An `f32` that knows whether it is 0 or 1, so that nothing is computed with those: for a kernel that is inlined where
/// a link is the identity by declaration. The same numbers as with `f32`, but for the sign of a zero; and where a guard
/// would have something to guard against, infinity or NaN: its caller has to give up on those.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sparse {
    value: f32,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Zero,
    One,
    Other,
}

impl Sparse {
    const ONE: Self = Self { value: 1.0, kind: Kind::One };
    /// The link that changes nothing.
    pub(crate) const IDENTITY: [Self; 12] = {
        let (zero, one) = (Self::ZERO, Self::ONE);
        [one, zero, zero, zero, one, zero, zero, zero, one, zero, zero, zero]
    };

    /// Any link. Written out: a map over as many is a call.
    #[inline(always)]
    pub(crate) fn link(transform: &Affine3A) -> [Self; 12] {
        let [a, b, c, d, e, f, g, h, i, x, y, z] = transform.to_cols_array();
        let of = Self::of;
        [of(a), of(b), of(c), of(d), of(e), of(f), of(g), of(h), of(i), of(x), of(y), of(z)]
    }

    #[inline(always)]
    pub(crate) fn of(value: f32) -> Self {
        Self { value, kind: Kind::Other }
    }

    #[inline(always)]
    pub(crate) fn value(self) -> f32 {
        self.value
    }
}

impl Sealed for Sparse {}

impl Add for Sparse {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        match (self.kind, other.kind) {
            (Kind::Zero, _) => other,
            (_, Kind::Zero) => self,
            _ => Self::of(self.value + other.value),
        }
    }
}

impl Sub for Sparse {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        match (self.kind, other.kind) {
            (Kind::Zero, _) => -other,
            (_, Kind::Zero) => self,
            _ => Self::of(self.value - other.value),
        }
    }
}

impl Mul for Sparse {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        match (self.kind, other.kind) {
            (Kind::Zero, _) | (_, Kind::Zero) => Self::ZERO,
            (Kind::One, _) => other,
            (_, Kind::One) => self,
            _ => Self::of(self.value * other.value),
        }
    }
}

impl Div for Sparse {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self::of(self.value / other.value)
    }
}

impl Neg for Sparse {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        match self.kind {
            Kind::Zero => self,
            _ => Self::of(-self.value),
        }
    }
}

impl Scalar for Sparse {
    const ZERO: Self = Self { value: 0.0, kind: Kind::Zero };
    const TINY: Self = Self { value: <f32 as Scalar>::TINY, kind: Kind::Other };

    #[inline(always)]
    fn constant(value: f64) -> Self {
        match value {
            0.0 => Self::ZERO,
            1.0 => Self::ONE,
            _ => Self::of(<f32 as Scalar>::constant(value)),
        }
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        Self::of(<f32 as Scalar>::sqrt(self.value))
    }

    #[inline(always)]
    fn select_less(_: Self, _: Self, then: Self, _: Self) -> Self {
        then
    }
}
