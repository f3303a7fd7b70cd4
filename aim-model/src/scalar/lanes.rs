//! [`Scalar`] and [`Real`] for the vectors of `wide`: each lane gives bit for bit the scalar result, independently of
//! the other lanes.

use super::{Scalar, sealed::Sealed};
use crate::Real;

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
                // Without vector instructions and without `std`, `wide` falls back to its own square root, which is
                // wrong for subnormal numbers (1.7.1).
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
                // The comparison is ordered: false if either is NaN. A bitwise select, because the alternative of a
                // guard is zero: the compiler reduces it to a comparison and an `and`.
                a.simd_lt(b).bitselect(then, otherwise)
            }
        }

        // Lane by lane, because the functions of `wide` round differently.
        impl Real for wide::$vector {
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                let both = self.to_array().map(Real::sin_cos);
                (Self::new(both.map(|(sin, _)| sin)), Self::new(both.map(|(_, cos)| cos)))
            }

            lane_by_lane!($float: sin, cos, tan, asin, acos, exp, ln, sinh, cosh, tanh, floor);
            lane_by_lane!($float: atan2(x), powf(exponent));
        }
    )*};
}

macro_rules! lane_by_lane {
    ($float:ident: $($function:ident),*) => {$(
        #[inline]
        fn $function(self) -> Self {
            Self::new(self.to_array().map(<$float as Real>::$function))
        }
    )*};
    ($float:ident: $($function:ident($other:ident)),*) => {$(
        #[inline]
        fn $function(self, $other: Self) -> Self {
            let (these, others) = (self.to_array(), $other.to_array());
            Self::new(core::array::from_fn(|lane| <$float as Real>::$function(these[lane], others[lane])))
        }
    )*};
}

lanes!(f32x4 of f32, f32x8 of f32, f32x16 of f32, f64x2 of f64, f64x4 of f64, f64x8 of f64);
