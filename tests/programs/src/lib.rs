//! Random functions in ordinary Rust: what `#[differentiate]` makes of them beside dual numbers through the same text.

use num_dual::Dual64;

/// A number with its derivative.
pub type Dual = Dual64;

/// A constant.
#[must_use]
pub fn c(number: f64) -> Dual {
    Dual::from(number)
}

/// A whole number.
#[must_use]
pub fn of(number: i32) -> Dual {
    Dual::from(f64::from(number))
}

/// What floating-point numbers have, and dual ones have not.
pub trait Number {
    /// The greater one.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// The lesser one.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// The nearest one between two.
    #[must_use]
    fn clamp(self, low: Self, high: Self) -> Self;
    /// Without its sign.
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
