//! Dual numbers over any number type, and the operations that the reference evaluation needs.

use std::ops::{Add, Div, Mul, Neg, Sub};

use aim_symbolic::{Function, Number};

use super::field::Field;

/// Number type in which expressions can be evaluated.
pub(crate) trait Oracle: Number {
    /// Returns `true` if the value is 0.
    fn is_zero(self) -> bool;

    /// Returns `true` if the value behaves like a length: the root of its square times something is a multiple of it.
    fn is_length(self) -> bool {
        true
    }

    /// Returns the value as a constant, and `true` if a derivative was dropped.
    fn frozen(self) -> (Self, bool);
}

impl Oracle for Field {
    fn is_zero(self) -> bool {
        self == Self::ZERO
    }

    fn is_length(self) -> bool {
        self.is_square()
    }

    fn frozen(self) -> (Self, bool) {
        (self, false)
    }
}

/// Value and its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dual<T> {
    pub(crate) value: T,
    pub(crate) slope: T,
}

impl<T: Number> Dual<T> {
    pub(crate) fn fixed(value: T) -> Self {
        Self { value, slope: T::constant(0.0) }
    }
}

impl<T: Number> Add for Dual<T> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl<T: Number> Sub for Dual<T> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl<T: Number> Mul for Dual<T> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl<T: Number> Div for Dual<T> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) / other.value }
    }
}

impl<T: Number> Neg for Dual<T> {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl<T: Number> Number for Dual<T> {
    fn constant(value: f64) -> Self {
        Self::fixed(T::constant(value))
    }

    fn tiny() -> Self {
        Self::fixed(T::tiny())
    }

    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        Self { value, slope: self.slope / (value + value) }
    }

    fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        let select = |then, otherwise| T::select_less(a.value, b.value, then, otherwise);
        Self { value: select(then.value, otherwise.value), slope: select(then.slope, otherwise.slope) }
    }

    fn call(self, function: Function) -> Self {
        let (x, one) = (self.value, T::constant(1.0));
        let value = x.call(function);
        let slope = match function {
            Function::Sin => self.slope * x.call(Function::Cos),
            Function::Cos => -self.slope * x.call(Function::Sin),
            Function::Tan => self.slope / (x.call(Function::Cos) * x.call(Function::Cos)),
            Function::Asin => self.slope / (one - x * x).sqrt(),
            Function::Acos => -self.slope / (one - x * x).sqrt(),
            Function::Exp => self.slope * value,
            // Outside the domain the slope is 0 by convention.
            Function::Ln => T::select_less(T::constant(0.0), x, self.slope / x, T::constant(0.0)),
            Function::Sinh => self.slope * x.call(Function::Cosh),
            Function::Cosh => self.slope * x.call(Function::Sinh),
            Function::Tanh => self.slope * (one - value * value),
            Function::Floor => T::constant(0.0),
        };
        Self { value, slope }
    }

    fn atan2(self, x: Self) -> Self {
        let y = self;
        let square = x.value * x.value + y.value * y.value;
        Self { value: y.value.atan2(x.value), slope: (y.slope * x.value - y.value * x.slope) / square }
    }
}

impl<T: Oracle> Oracle for Dual<T> {
    fn is_zero(self) -> bool {
        self.value.is_zero()
    }

    fn is_length(self) -> bool {
        self.value.is_length()
    }

    fn frozen(self) -> (Self, bool) {
        let (value, lost) = self.value.frozen();
        (Self::fixed(value), lost || !self.slope.is_zero())
    }
}
