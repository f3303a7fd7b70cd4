//! Numbers with a bound on their accumulated rounding error.

use crate::{Function, Op};

/// A number and a bound on its rounding error, in units of the last place of 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rounded {
    pub(super) value: f64,
    pub(super) bound: f64,
}

impl Rounded {
    /// A number without rounding error.
    pub(super) fn exact(value: f64) -> Self {
        Self { value, bound: 0.0 }
    }

    /// Returns the result of an operation: its error is that propagated from the operands, plus its own rounding.
    pub(super) fn result(op: Op<Self>, inputs: &[Self]) -> Self {
        let value = op.map(|x| x.value).value(&[]);
        let propagated = match op {
            Op::Input(i) => return inputs[i as usize],
            Op::Constant(_) | Op::Tiny => return Self::exact(value),
            Op::Neg(a) => return Self { value, ..a },
            Op::SelectLess(a, b, then, otherwise) => return if a.value < b.value { then } else { otherwise },
            Op::Add(a, b) | Op::Sub(a, b) => a.bound + b.bound,
            Op::Mul(a, b) => a.bound * b.value.abs() + b.bound * a.value.abs(),
            Op::Div(a, b) => (a.bound + value.abs() * b.bound) / b.value.abs(),
            Op::Sqrt(a) => a.bound / (2.0 * value),
            Op::Call(function, a) => slope(function, a.value, value).abs() * a.bound,
            Op::Atan2(y, x) => {
                let square = y.value * y.value + x.value * x.value;
                (y.bound * x.value.abs() + x.bound * y.value.abs()) / square
            }
            Op::Pow(a, b) => value.abs() * ((b.value / a.value).abs() * a.bound + a.value.ln().abs() * b.bound),
        };
        Self { value, bound: propagated + value.abs() }
    }
}

/// The derivative of `value = function(x)`, up to its sign.
fn slope(function: Function, x: f64, value: f64) -> f64 {
    match function {
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
    }
}
