//! The functions of the mathematical library that differentiated functions call.

use crate::Scalar;

/// A [`Scalar`] with the functions of a mathematical library, from `std` or `libm`. Sealed, as `Scalar` is; the vectors of
/// the feature `wide` call them lane by lane.
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
    /// The hyperbolic sine.
    fn sinh(self) -> Self;
    /// The hyperbolic cosine.
    fn cosh(self) -> Self;
    /// The hyperbolic tangent.
    fn tanh(self) -> Self;
    /// The largest whole number that is not above.
    fn floor(self) -> Self;
    /// The power; NaN of a negative number but for whole exponents.
    fn powf(self, exponent: Self) -> Self;
}

macro_rules! real {
    ($float:ident: $($function:ident($($x:ident)?) -> $result:ty = $libm:ident),*) => {
        impl Real for $float {
            $(
                #[inline]
                fn $function(self $(, $x: Self)?) -> $result {
                    #[cfg(feature = "std")]
                    {
                        extern crate std;
                        self.$function($($x)?)
                    }
                    #[cfg(not(feature = "std"))]
                    {
                        libm::$libm(self $(, $x)?)
                    }
                }
            )*
        }
    };
}

real!(
    f32: sin_cos() -> (Self, Self) = sincosf, sin() -> Self = sinf, cos() -> Self = cosf, tan() -> Self = tanf,
    asin() -> Self = asinf, acos() -> Self = acosf, atan2(x) -> Self = atan2f, exp() -> Self = expf, ln() -> Self = logf,
    sinh() -> Self = sinhf, cosh() -> Self = coshf, tanh() -> Self = tanhf, floor() -> Self = floorf,
    powf(exponent) -> Self = powf
);
real!(
    f64: sin_cos() -> (Self, Self) = sincos, sin() -> Self = sin, cos() -> Self = cos, tan() -> Self = tan,
    asin() -> Self = asin, acos() -> Self = acos, atan2(x) -> Self = atan2, exp() -> Self = exp, ln() -> Self = log,
    sinh() -> Self = sinh, cosh() -> Self = cosh, tanh() -> Self = tanh, floor() -> Self = floor,
    powf(exponent) -> Self = pow
);
