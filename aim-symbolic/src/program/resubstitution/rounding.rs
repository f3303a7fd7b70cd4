//! Numbers with a bound on their accumulated rounding error.

use core::ops::{Add, Div, Mul, Neg, Sub};

use crate::{Function, Number};

/// A number and a bound on its rounding error, in units of the last place of 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounded {
    pub(super) value: f64,
    pub(super) bound: f64,
}

impl Rounded {
    /// A number without rounding error.
    fn exact(value: f64) -> Self {
        Self { value, bound: 0.0 }
    }

    /// The result of an operation: the error propagated from its operands, plus its own rounding.
    fn result(value: f64, propagated: f64) -> Self {
        Self { value, bound: propagated + value.abs() }
    }
}

impl Add for Rounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::result(self.value + other.value, self.bound + other.bound)
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
        let propagated = self.bound * other.value.abs() + other.bound * self.value.abs();
        Self::result(self.value * other.value, propagated)
    }
}

impl Div for Rounded {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        Self::result(quotient, (self.bound + quotient.abs() * other.bound) / other.value.abs())
    }
}

impl Number for Rounded {
    fn constant(value: f64) -> Self {
        Self::exact(value)
    }

    fn tiny() -> Self {
        Self::exact(f64::tiny())
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        Self::result(root, self.bound / (2.0 * root))
    }

    fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        if a.value < b.value { then } else { otherwise }
    }

    fn call(self, function: Function) -> Self {
        let x = self.value;
        let value = x.call(function);
        let slope = match function {
            Function::Sin => x.cos(),
            Function::Cos => x.sin(),
            Function::Tan => 1.0 + value * value,
            Function::Asin | Function::Acos => 1.0 / (1.0 - x * x).sqrt(),
            Function::Exp => value,
            Function::Ln => 1.0 / x,
            Function::Sinh => x.cosh(),
            Function::Cosh => x.sinh(),
            Function::Tanh => 1.0 - value * value,
            Function::Floor => 0.0,
        };
        Self::result(value, slope.abs() * self.bound)
    }

    fn atan2(self, x: Self) -> Self {
        let (y, square) = (self, self.value * self.value + x.value * x.value);
        let propagated = (y.bound * x.value.abs() + x.bound * y.value.abs()) / square;
        Self::result(y.value.atan2(x.value), propagated)
    }

    fn pow(self, exponent: Self) -> Self {
        let value = self.value.powf(exponent.value);
        let propagated = (exponent.value / self.value).abs() * self.bound + self.value.ln().abs() * exponent.bound;
        Self::result(value, value.abs() * propagated)
    }
}
