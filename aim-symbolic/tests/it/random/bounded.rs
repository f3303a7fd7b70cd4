//! Running error analysis: doubles with a bound on their distance from the true value.

use std::ops::{Add, Div, Mul, Neg, Sub};

use aim_symbolic::{Function, Number};

use super::dual::Oracle;

/// Unit roundoff, enlarged slightly for the rounding of the bounds themselves.
const ROUNDING: f64 = 1.0001 * f64::EPSILON / 2.0;
/// Relative error bound of mathematical library functions.
const LIBRARY: f64 = 2.0 * f64::EPSILON;

/// Value with a bound on its error, infinite if nothing is known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bounded {
    pub(crate) value: f64,
    pub(crate) error: f64,
}

impl Bounded {
    pub(crate) fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    fn unknown() -> Self {
        Self { value: 0.0, error: f64::INFINITY }
    }

    /// Creates a rounded value with the error accumulated before rounding.
    fn new(value: f64, error: f64) -> Self {
        Self::with(value, error, ROUNDING)
    }

    fn with(value: f64, error: f64, rounding: f64) -> Self {
        let error = 1.000_001 * (error + rounding * value.abs());
        if value.is_finite() && error.is_finite() { Self { value, error } } else { Self::unknown() }
    }

    pub(crate) fn is_known(self) -> bool {
        self.error.is_finite()
    }

    /// Returns `true` if both may be the same number.
    pub(crate) fn meets(self, other: Self) -> bool {
        (self.value - other.value).abs() <= self.error + other.error
    }
}

impl Add for Bounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.error + other.error)
    }
}

impl Sub for Bounded {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::new(self.value - other.value, self.error + other.error)
    }
}

impl Mul for Bounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let error = self.value.abs() * other.error + other.value.abs() * self.error + self.error * other.error;
        Self::new(self.value * other.value, error)
    }
}

impl Div for Bounded {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let least = other.value.abs() - other.error;
        if least <= 0.0 || !self.is_known() || !other.is_known() {
            return Self::unknown();
        }
        let value = self.value / other.value;
        Self::new(value, (self.error + value.abs() * other.error) / least)
    }
}

impl Neg for Bounded {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, error: self.error }
    }
}

impl Number for Bounded {
    /// Constants other than whole numbers are treated as rounded, since rules compute with them.
    fn constant(value: f64) -> Self {
        let whole = value == value.trunc() && value.abs() < 1e15;
        if whole { Self::exact(value) } else { Self::new(value, 4.0 * ROUNDING * value.abs()) }
    }

    fn tiny() -> Self {
        Self::exact(f64::tiny())
    }

    fn sqrt(self) -> Self {
        let least = self.value - self.error;
        if self.value == 0.0 && self.error == 0.0 {
            return self;
        }
        if least <= 0.0 || !self.is_known() {
            return Self::unknown();
        }
        Self::new(self.value.sqrt(), self.error / (least.sqrt() + self.value.sqrt()))
    }

    fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        let either_way = (a.value - b.value).abs() <= a.error + b.error && a.error + b.error > 0.0;
        if either_way || !a.is_known() || !b.is_known() {
            return if then == otherwise { then } else { Self::unknown() };
        }
        if a.value < b.value { then } else { otherwise }
    }

    fn call(self, function: Function) -> Self {
        if !self.is_known() {
            return self;
        }
        let Self { value: x, error } = self;
        let value = x.call(function);
        // Largest slope within the error bounds.
        let slope = match function {
            Function::Sin | Function::Cos => 1.0,
            Function::Tan => {
                let cos = x.cos().abs() - error;
                if cos > 0.0 { 1.0 / (cos * cos) } else { f64::INFINITY }
            }
            Function::Asin | Function::Acos => {
                let rest = 1.0 - (x.abs() + error).powi(2);
                if rest > 0.0 { 1.0 / rest.sqrt() } else { f64::INFINITY }
            }
            Function::Exp => (x + error).exp(),
            Function::Ln if x - error > 0.0 => 1.0 / (x - error),
            Function::Ln => f64::INFINITY,
            Function::Sinh | Function::Cosh => (x.abs() + error).cosh(),
            Function::Tanh => 1.0,
            Function::Floor if (x - error).floor() == (x + error).floor() => 0.0,
            Function::Floor => f64::INFINITY,
        };
        // Constants of the order of 1 are used in argument reduction.
        let along = if error == 0.0 { 0.0 } else { slope * error };
        Self::with(value, along + f64::MIN_POSITIVE, LIBRARY)
    }

    fn atan2(self, x: Self) -> Self {
        let y = self;
        let error = y.error + x.error;
        let distance = y.value.hypot(x.value) - error;
        // The angle jumps across the negative axis.
        let jumps = x.value - x.error <= 0.0 && y.value.abs() <= y.error;
        if distance <= 0.0 || jumps || !error.is_finite() {
            return Self::unknown();
        }
        Self::with(y.value.atan2(x.value), error / distance, LIBRARY)
    }
}

impl Oracle for Bounded {
    fn is_zero(self) -> bool {
        self.value.abs() <= self.error
    }

    fn frozen(self) -> (Self, bool) {
        (self, false)
    }
}
