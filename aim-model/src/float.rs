//! [`Float`]: the operations on `f32` and `f64` that ranges need.

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};

mod sealed {
    #[expect(unnameable_types, reason = "being unnameable is what seals")]
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// A floating-point number: `f32` in the runtime, `f64` for parsing declarations and writing reports. Sealed.
pub trait Float:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + sealed::Sealed
{
    /// 0.
    const ZERO: Self;
    /// 1/2.
    const HALF: Self;
    /// 1.
    const ONE: Self;
    /// 2π.
    const TAU: Self;
    /// ∞.
    const INFINITY: Self;

    /// Returns the smaller of two numbers, or `other` if either is NaN. Compiles to one comparison with the same result
    /// on every machine.
    #[must_use]
    fn min(self, other: Self) -> Self;
    /// Returns the larger of two numbers, or `other` if either is NaN.
    #[must_use]
    fn max(self, other: Self) -> Self;
    /// Returns 1 with the sign of the number; NaN for NaN.
    #[must_use]
    fn signum(self) -> Self;
    /// Returns `true` if the number is neither infinite nor NaN.
    fn is_finite(self) -> bool;
}

macro_rules! float {
    ($float:ident) => {
        impl Float for $float {
            const ZERO: Self = 0.0;
            const HALF: Self = 0.5;
            const ONE: Self = 1.0;
            const TAU: Self = core::$float::consts::TAU;
            const INFINITY: Self = $float::INFINITY;

            #[inline(always)]
            fn min(self, other: Self) -> Self {
                if self < other { self } else { other }
            }

            #[inline(always)]
            fn max(self, other: Self) -> Self {
                if self > other { self } else { other }
            }

            #[inline(always)]
            fn signum(self) -> Self {
                <$float>::signum(self)
            }

            #[inline(always)]
            fn is_finite(self) -> bool {
                <$float>::is_finite(self)
            }
        }
    };
}

float!(f32);
float!(f64);
