//! [`Scalar`]: the number type of derived code, `f32` or `f64`, and with the feature `wide` vectors of them.

use core::ops::{Add, Div, Mul, Neg, Sub};

#[cfg(feature = "wide")]
mod lanes;

mod sealed {
    #[expect(unnameable_types, reason = "being unnameable is what seals")]
    pub trait Sealed {}
    impl Sealed for f32 {}
    impl Sealed for f64 {}
}

/// The number type of emitted kernels: `f32` and `f64`. Sealed, because kernels rely on IEEE 754 arithmetic.
///
/// With the feature `wide` also `f32x4`, `f32x8`, `f32x16`, `f64x2`, `f64x4` and `f64x8` of the crate `wide`. Each lane
/// is then a separate character, and one call of a kernel, or of a differentiated function with `lanes`, computes them
/// all. Guards and branches are selects, so each lane gives bit for bit the result of the scalar function,
/// independently of the other lanes. (Only the bits of a NaN may differ; finite inputs produce none.)
///
/// ```
/// # #[cfg(any(feature = "std", feature = "libm"))] {
/// use aim_model::Scalar;
///
/// /// The length of a vector, of numbers of one character or of several.
/// fn length<S: Scalar>([x, y, z]: [S; 3]) -> S {
///     (x * x + y * y + z * z).sqrt()
/// }
/// assert_eq!((length([2.0_f32, 3.0, 6.0]), length([2.0_f64, 3.0, 6.0])), (7.0, 7.0));
/// # }
/// ```
pub trait Scalar:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + sealed::Sealed
{
    /// 0.
    const ZERO: Self;
    /// The smallest length that a kernel divides by: its square is still a normal number.
    const TINY: Self;
    /// Returns the value of this type nearest to `value`.
    fn constant(value: f64) -> Self;
    /// Returns the square root, correctly rounded; NaN below 0.
    fn sqrt(self) -> Self;
    /// Returns `then` if `a < b`, else `otherwise`, which is also the result if either is NaN.
    fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self;
}

macro_rules! scalar {
    ($float:ident, $tiny:literal, $libm_sqrt:ident) => {
        impl Scalar for $float {
            const ZERO: Self = 0.0;
            const TINY: Self = $tiny;

            #[inline(always)]
            #[allow(
                clippy::cast_possible_truncation,
                trivial_numeric_casts,
                reason = "rounding the constant to this type is the purpose"
            )]
            fn constant(value: f64) -> Self {
                value as Self
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                #[cfg(feature = "std")]
                {
                    extern crate std;
                    self.sqrt()
                }
                #[cfg(not(feature = "std"))]
                {
                    libm::$libm_sqrt(self)
                }
            }

            #[inline(always)]
            fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
                if a < b { then } else { otherwise }
            }
        }
    };
}

// The square roots of the smallest normal numbers, 2^-126 and 2^-1022.
scalar!(f32, 1.084_202_2e-19, sqrtf);
scalar!(f64, 1.491_668_146_240_041_3e-154, sqrt);
