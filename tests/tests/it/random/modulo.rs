//! Exact arithmetic modulo a prime: two different rational functions agree at a random point with a probability of
//! about their degree over 2⁶¹.

use std::ops::{Add, Div, Mul, Neg, Sub};

use aim_symbolic::Number;

/// An element of the field of 2⁶¹ − 1 elements; `None` for a number that is no dyadic fraction, or after a division by
/// 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Modulo(pub(super) Option<u64>);

pub(super) const PRIME: u64 = (1 << 61) - 1;

fn times(a: u64, b: u64) -> u64 {
    u64::try_from(u128::from(a) * u128::from(b) % u128::from(PRIME)).expect("a remainder")
}

/// Returns 1 / a by Fermat's little theorem: a^(p − 2).
fn inverse(mut a: u64) -> u64 {
    let (mut left, mut product) = (PRIME - 2, 1);
    while left > 0 {
        if left & 1 == 1 {
            product = times(product, a);
        }
        a = times(a, a);
        left >>= 1;
    }
    product
}

impl Modulo {
    fn with(self, other: Self, op: impl Fn(u64, u64) -> Option<u64>) -> Self {
        Self(self.0.zip(other.0).and_then(|(a, b)| op(a, b)))
    }
}

impl Add for Modulo {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.with(other, |a, b| Some((a + b) % PRIME))
    }
}

impl Neg for Modulo {
    type Output = Self;

    fn neg(self) -> Self {
        Self(self.0.map(|a| (PRIME - a) % PRIME))
    }
}

impl Sub for Modulo {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Modulo {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self.with(other, |a, b| Some(times(a, b)))
    }
}

impl Div for Modulo {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        self.with(other, |a, b| (b != 0).then(|| times(a, inverse(b))))
    }
}

impl Number for Modulo {
    fn constant(value: f64) -> Self {
        const UNIT: f64 = 1_048_576.0;
        let whole = value * UNIT;
        if whole.fract() != 0.0 || whole.abs() > 1e15 {
            return Self(None);
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, below 10¹⁵, not negative")]
        let size = Self(Some(times(whole.abs() as u64, inverse(UNIT as u64))));
        if whole < 0.0 { -size } else { size }
    }

    fn tiny() -> Self {
        Self(None)
    }

    fn sqrt(self) -> Self {
        Self(None)
    }

    fn select_less(_: Self, _: Self, _: Self, _: Self) -> Self {
        Self(None)
    }
}
