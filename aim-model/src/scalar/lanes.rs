//! [`Scalar`] for the vectors of `wide`: every lane computes what the scalar would, bit for bit, whatever the others hold.

use super::{Scalar, sealed::Sealed};

macro_rules! lanes {
    ($($vector:ident of $float:ident),* $(,)?) => {$(
        impl Sealed for wide::$vector {}

        impl Scalar for wide::$vector {
            const ZERO: Self = Self::splat(<$float as Scalar>::ZERO);
            const TINY: Self = Self::splat(<$float as Scalar>::TINY);

            #[inline(always)]
            fn constant(value: f64) -> Self {
                Self::splat(<$float as Scalar>::constant(value))
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                // Without vector instructions and without `std`, `wide` has a square root of its own, which goes wrong
                // for subnormal numbers (1.7.1).
                #[cfg(any(
                    feature = "std",
                    target_feature = "sse2",
                    target_feature = "simd128",
                    all(target_feature = "neon", target_arch = "aarch64"),
                ))]
                {
                    Self::sqrt(self)
                }
                #[cfg(not(any(
                    feature = "std",
                    target_feature = "sse2",
                    target_feature = "simd128",
                    all(target_feature = "neon", target_arch = "aarch64"),
                )))]
                {
                    Self::new(self.to_array().map(<$float as Scalar>::sqrt))
                }
            }

            #[inline(always)]
            fn select_less(a: Self, b: Self, then: Self, otherwise: Self) -> Self {
                // The comparison is ordered: false where either is NaN. By bits, because a guard's other choice is zero:
                // that leaves a comparison and an `and`.
                a.simd_lt(b).bitselect(then, otherwise)
            }
        }
    )*};
}

lanes!(f32x4 of f32, f32x8 of f32, f32x16 of f32, f64x2 of f64, f64x4 of f64, f64x8 of f64);
