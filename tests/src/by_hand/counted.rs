//! [`Counted`]: a number type that counts its operations.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use aim_symbolic::{Count, Function, Number};

thread_local! {
    static COUNT: Cell<Count> = const { Cell::new(Count { add: 0, mul: 0, div: 0, sqrt: 0, select: 0, call: 0, series: 0 }) };
}

/// A number whose operations are counted, separately for each thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counted(pub f64);

/// Returns the operations that `work` performs on this thread.
pub fn count<R>(work: impl FnOnce() -> R) -> Count {
    COUNT.set(Count::default());
    work();
    COUNT.get()
}

fn note(kind: impl FnOnce(&mut Count) -> &mut usize, times: usize) {
    let mut count = COUNT.get();
    *kind(&mut count) += times;
    COUNT.set(count);
}

impl Add for Counted {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        note(|count| &mut count.add, 1);
        Self(self.0 + other.0)
    }
}

impl Sub for Counted {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        note(|count| &mut count.add, 1);
        Self(self.0 - other.0)
    }
}

impl Mul for Counted {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        note(|count| &mut count.mul, 1);
        Self(self.0 * other.0)
    }
}

impl Div for Counted {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        note(|count| &mut count.div, 1);
        Self(self.0 / other.0)
    }
}

impl Neg for Counted {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Number for Counted {
    fn constant(value: f64) -> Self {
        Self(value)
    }

    fn tiny() -> Self {
        Self(<f64 as Number>::tiny())
    }

    fn sqrt(self) -> Self {
        note(|count| &mut count.sqrt, 1);
        Self(self.0.sqrt())
    }

    fn call(self, function: Function) -> Self {
        note(|count| &mut count.call, 1);
        Self(self.0.call(function))
    }

    fn atan2(self, x: Self) -> Self {
        note(|count| &mut count.call, 1);
        Self(self.0.atan2(x.0))
    }

    fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
        // A comparison and a select, as counted in derived programs.
        note(|count| &mut count.select, 2);
        if a.0 < b.0 { then } else { otherwise }
    }
}
