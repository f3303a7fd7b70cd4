//! Arithmetic of operations on numbers. The interpreter and the emitted code use the same operations, so results agree
//! bit for bit.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::ir::op::{Function, Op};

/// A number type in which programs can run.
pub trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The value nearest to `value`.
    fn constant(value: f64) -> Self;
    /// The smallest length by which a guarded division divides: the square of it is still a normal number.
    fn tiny() -> Self;
    /// The square root.
    fn sqrt(self) -> Self;
    /// `then` where `a < b`, else `otherwise`.
    fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self;
    /// Applies a function of the mathematics library; NaN for types that lack them.
    fn call(self, _function: Function) -> Self {
        Self::constant(f64::NAN)
    }
    /// The angle of the point (`x`, `self`), measured from the first axis; NaN for types without such functions.
    fn atan2(self, _x: Self) -> Self {
        Self::constant(f64::NAN)
    }
    /// `self` to the power `exponent`; NaN for types without such functions.
    fn pow(self, _exponent: Self) -> Self {
        Self::constant(f64::NAN)
    }
}

macro_rules! number {
    ($float:ident, $tiny:literal) => {
        impl Number for $float {
            #[allow(
                clippy::cast_possible_truncation,
                trivial_numeric_casts,
                reason = "rounding the constant to this type is the purpose"
            )]
            fn constant(value: f64) -> Self {
                value as Self
            }

            fn tiny() -> Self {
                $tiny
            }

            fn sqrt(self) -> Self {
                self.sqrt()
            }

            fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
                if a < b { then } else { otherwise }
            }

            fn call(self, function: Function) -> Self {
                match function {
                    Function::Sin => self.sin(),
                    Function::Cos => self.cos(),
                    Function::Tan => self.tan(),
                    Function::Asin => self.asin(),
                    Function::Acos => self.acos(),
                    Function::Exp => self.exp(),
                    Function::Ln => self.ln(),
                    Function::Sinh => self.sinh(),
                    Function::Cosh => self.cosh(),
                    Function::Tanh => self.tanh(),
                    Function::Floor => self.floor(),
                }
            }

            fn atan2(self, x: Self) -> Self {
                self.atan2(x)
            }

            fn pow(self, exponent: Self) -> Self {
                self.powf(exponent)
            }
        }
    };
}

number!(f32, 1.084_202_2e-19);
number!(f64, 1.491_668_146_240_041_3e-154);

impl<T: Number> Op<T> {
    /// Returns the result of the operation on these numbers. A missing input counts as 0.
    pub(crate) fn value(self, inputs: &[T]) -> T {
        match self {
            Self::Input(i) => inputs.get(i as usize).copied().unwrap_or_else(|| T::constant(0.0)),
            Self::Constant(c) => T::constant(c.value()),
            Self::Tiny => T::tiny(),
            Self::Add(a, b) => a + b,
            Self::Sub(a, b) => a - b,
            Self::Mul(a, b) => a * b,
            Self::Div(a, b) => a / b,
            Self::Neg(a) => -a,
            Self::Sqrt(a) => a.sqrt(),
            Self::Call(function, a) => a.call(function),
            Self::Atan2(y, x) => y.atan2(x),
            Self::Pow(a, b) => a.pow(b),
            Self::SelectLess(a, b, then, otherwise) => T::select_less(a, b, then, otherwise),
        }
    }
}
