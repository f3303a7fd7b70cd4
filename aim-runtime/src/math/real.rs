//! The functions of the mathematical library that differentiated functions call.

use crate::Scalar;

/// A [`Scalar`] with the functions of a mathematical library, from `std` or `libm`. Sealed, as `Scalar` is.
///
/// Outside its domain a function is NaN; none panics.
pub trait Real: Scalar {
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// The sine of an angle in radians.
    fn sin(self) -> Self;
    /// The cosine of an angle in radians.
    fn cos(self) -> Self;
    /// The tangent of an angle in radians.
    fn tan(self) -> Self;
    /// The angle with this sine, in radians, −π/2…π/2.
    fn asin(self) -> Self;
    /// The angle with this cosine, in radians, 0…π.
    fn acos(self) -> Self;
    /// The angle of the point (`x`, `self`), in radians, −π…π.
    fn atan2(self, x: Self) -> Self;
    /// The exponential.
    fn exp(self) -> Self;
    /// The natural logarithm.
    fn ln(self) -> Self;
}

macro_rules! real {
    ($float:ident: $sin_cos:ident, $atan2:ident, $($function:ident $libm:ident),*) => {
        #[cfg(feature = "std")]
        impl Real for $float {
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                extern crate std;
                self.sin_cos()
            }

            #[inline]
            fn atan2(self, x: Self) -> Self {
                extern crate std;
                self.atan2(x)
            }

            $(
                #[inline]
                fn $function(self) -> Self {
                    extern crate std;
                    self.$function()
                }
            )*
        }

        #[cfg(not(feature = "std"))]
        impl Real for $float {
            #[inline]
            fn sin_cos(self) -> (Self, Self) {
                libm::$sin_cos(self)
            }

            #[inline]
            fn atan2(self, x: Self) -> Self {
                libm::$atan2(self, x)
            }

            $(
                #[inline]
                fn $function(self) -> Self {
                    libm::$libm(self)
                }
            )*
        }
    };
}

real!(f32: sincosf, atan2f, sin sinf, cos cosf, tan tanf, asin asinf, acos acosf, exp expf, ln logf);
real!(f64: sincos, atan2, sin sin, cos cos, tan tan, asin asin, acos acos, exp exp, ln log);
