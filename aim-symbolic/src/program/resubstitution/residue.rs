//! Numbers modulo a prime, which decide whether two expressions are equal.

use core::hash::{Hash, Hasher};
use core::ops::{Add, Mul, Neg, Sub};

use rustc_hash::FxHasher;

use crate::{Function, Op};

/// 2⁶¹ − 1
const PRIME: u64 = (1 << 61) - 1;

/// A number modulo 2⁶¹ − 1. Functions that are not rational have pseudorandom values, equal for equal operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Residue(u64);

impl Residue {
    pub(super) const ZERO: Self = Self(0);
    const ONE: Self = Self(1);
    const TWO: Self = Self(2);

    /// Returns the result of an operation.
    pub(super) fn result(op: Op<Self>) -> Self {
        match op {
            Op::Constant(c) => Self::constant(c.value()),
            Op::Add(a, b) => a + b,
            Op::Sub(a, b) => a - b,
            Op::Mul(a, b) => a * b,
            Op::Div(a, b) if b == Self::ZERO => Self::random(("quotient", a)),
            Op::Div(a, b) => a * b.inverse(),
            Op::Neg(a) => -a,
            Op::Call(Function::Sin, a) => a.circle().0,
            Op::Call(Function::Cos, a) => a.circle().1,
            Op::Input(i) => Self::random(("input", i)),
            Op::Tiny => Self::random("tiny"),
            Op::Sqrt(a) => Self::random(("root", a)),
            Op::SelectLess(a, b, then, otherwise) => Self::random((a, b, then, otherwise)),
            Op::Call(function, a) => Self::random((function, a)),
            Op::Atan2(y, x) => Self::random(("angle", y, x)),
            Op::Pow(a, b) => Self::random(("power", a, b)),
        }
    }

    fn constant(value: f64) -> Self {
        // value = (1 + fraction / 2⁵²) 2^(exponent − 1023); subnormal numbers lack the leading 1.
        let bits = value.abs().to_bits();
        let (exponent, fraction) = (bits >> 52, bits & ((1 << 52) - 1));
        let whole = if exponent == 0 { fraction } else { fraction | 1 << 52 };
        // 1075 ≡ 38 modulo 61
        let shift = (exponent.max(1) + 61 - 38) % 61;
        let positive = Self::of(u128::from(whole) << shift);
        if !value.is_finite() {
            Self::random(bits)
        } else if value < 0.0 {
            -positive
        } else {
            positive
        }
    }

    /// Reduces by 2⁶¹ ≡ 1.
    fn of(x: u128) -> Self {
        let low = |x: u128| Self(u64::try_from(x & u128::from(PRIME)).unwrap_or_default());
        low(x) + low(x >> 61)
    }

    /// Returns a pseudorandom residue that depends only on `key`.
    pub(super) fn random(key: impl Hash) -> Self {
        let mut hasher = FxHasher::default();
        key.hash(&mut hasher);
        // The finaliser of SplitMix64: changing one bit of the key changes half of the bits.
        let mut x = hasher.finish();
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        Self::of(u128::from(x ^ (x >> 31)))
    }

    /// Returns 1 / x = x to the power of 2⁶¹ − 3; 0 for 0.
    pub(super) fn inverse(self) -> Self {
        let (mut power, mut square) = (Self::ONE, self);
        for bit in 0..61 {
            if bit != 1 {
                power = power * square;
            }
            square = square * square;
        }
        power
    }

    /// Returns a number in 0…1.
    pub(super) fn unit(self) -> f64 {
        let high = u32::try_from(self.0 >> 29).unwrap_or_default();
        f64::from(high) / f64::from(u32::MAX)
    }

    /// Returns a number below `count`, which must be a power of two.
    pub(super) fn among(self, count: usize) -> usize {
        usize::try_from(self.0).unwrap_or_default() & count.wrapping_sub(1)
    }

    /// Returns one bit of 64, chosen by bits that [`among`](Self::among) does not use.
    pub(super) fn bit(self) -> u64 {
        1 << ((self.0 >> 54) % 64)
    }

    /// Returns the same residue for x and −x.
    pub(super) fn unsigned(self) -> Self {
        Self(self.0.min((-self).0))
    }

    /// Returns sine and cosine as the coordinates of a pseudorandom point on the unit circle.
    fn circle(self) -> (Self, Self) {
        let t = Self::random(("circle", self.unsigned()));
        let over = (Self::ONE + t * t).inverse();
        let sine = Self::TWO * t * over;
        (if self == self.unsigned() { sine } else { -sine }, (Self::ONE - t * t) * over)
    }
}

impl Add for Residue {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let sum = self.0 + other.0;
        Self(if sum >= PRIME { sum - PRIME } else { sum })
    }
}

impl Neg for Residue {
    type Output = Self;

    fn neg(self) -> Self {
        if self.0 == 0 { self } else { Self(PRIME - self.0) }
    }
}

impl Sub for Residue {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self(if self.0 >= other.0 { self.0 - other.0 } else { self.0 + PRIME - other.0 })
    }
}

impl Mul for Residue {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self::of(u128::from(self.0) * u128::from(other.0))
    }
}
