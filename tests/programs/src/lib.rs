//! Random functions in ordinary Rust: the code that `#[differentiate]` generates is compared with dual numbers through
//! the same function.

use num_dual::Dual64;

/// A dual number: a value with its derivative.
pub type Dual = Dual64;

/// Returns a constant.
#[must_use]
pub fn c(number: f64) -> Dual {
    Dual::from(number)
}

/// Returns a whole number as a constant.
#[must_use]
pub fn of(number: i32) -> Dual {
    Dual::from(f64::from(number))
}

/// Methods that floating-point numbers have and dual numbers lack.
pub trait Number {
    /// Returns the greater of two numbers.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// Returns the lesser of two numbers.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// Restricts the number to an interval.
    #[must_use]
    fn clamp(self, low: Self, high: Self) -> Self;
    /// Returns the absolute value.
    #[must_use]
    fn abs(self) -> Self;
}

impl Number for Dual {
    fn max(self, other: Self) -> Self {
        if self.re < other.re { other } else { self }
    }

    fn min(self, other: Self) -> Self {
        if self.re > other.re { other } else { self }
    }

    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }

    fn abs(self) -> Self {
        if self.re < 0.0 { -self } else { self }
    }
}
