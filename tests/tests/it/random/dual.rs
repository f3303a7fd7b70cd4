//! Dual numbers over any number type.

use std::ops::{Add, Div, Mul, Neg, Sub};

use aim_symbolic::{Function, Number};

/// A value and its derivative.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dual<T> {
    pub(super) value: T,
    pub(super) slope: T,
}

impl<T: Number> Dual<T> {
    pub(super) fn fixed(value: T) -> Self {
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
        assert_eq!(function, Function::Sin, "no other is written");
        Self { value: self.value.call(Function::Sin), slope: self.slope * self.value.call(Function::Cos) }
    }
}
