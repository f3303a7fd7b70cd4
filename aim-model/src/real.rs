//! [`Real`]: the mathematical functions that differentiated code calls.

use crate::Scalar;

/// A [`Scalar`] with the elementary functions of `std` or `libm`. Sealed like `Scalar`. The vectors of the feature
/// `wide` apply the functions lane by lane.
///
/// Outside its domain a function returns NaN; no function panics.
pub trait Real: Scalar {
    /// Returns the sine and the cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Returns the sine of an angle in radians.
    fn sin(self) -> Self;
    /// Returns the cosine of an angle in radians.
    fn cos(self) -> Self;
    /// Returns the tangent of an angle in radians.
    fn tan(self) -> Self;
    /// Returns the arcsine in radians, −π/2…π/2.
    fn asin(self) -> Self;
    /// Returns the arccosine in radians, 0…π.
    fn acos(self) -> Self;
    /// Returns the angle of the point (`x`, `self`) in radians, −π…π.
    fn atan2(self, x: Self) -> Self;
    /// Returns e raised to the power of `self`.
    fn exp(self) -> Self;
    /// Returns the natural logarithm.
    fn ln(self) -> Self;
    /// Returns the hyperbolic sine.
    fn sinh(self) -> Self;
    /// Returns the hyperbolic cosine.
    fn cosh(self) -> Self;
    /// Returns the hyperbolic tangent.
    fn tanh(self) -> Self;
    /// Returns the largest integer that is not greater than `self`.
    fn floor(self) -> Self;
    /// Raises `self` to the power `exponent`. A negative base gives NaN unless the exponent is an integer.
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
