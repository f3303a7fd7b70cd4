//! Doubles that track the size of their terms.

use std::ops::{Add, Div, Mul, Neg, Sub};

use aim_symbolic::{Function, Number};

/// A number, and the sum of the magnitudes of its terms, to which its rounding error is proportional.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounded {
    pub(super) value: f64,
    pub(super) size: f64,
}

impl Add for Rounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, size: self.size + other.size }
    }
}

impl Neg for Rounded {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Sub for Rounded {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Rounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, size: self.size * other.size }
    }
}

impl Div for Rounded {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, size: (self.size + value.abs() * other.size) / other.value.abs() }
    }
}

impl Number for Rounded {
    fn constant(value: f64) -> Self {
        Self { value, size: value.abs() }
    }

    fn tiny() -> Self {
        Self::constant(0.0)
    }

    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        Self { value, size: value + self.size / value }
    }

    fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        if a.value < b.value { then } else { otherwise }
    }

    fn call(self, function: Function) -> Self {
        Self { value: self.value.call(function), size: 1.0 + self.size }
    }
}
