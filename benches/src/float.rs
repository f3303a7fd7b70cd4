//! The two number types, with the sine and cosine that the runtime's `Scalar` does not have.

use aim::Scalar;

/// A number type of the benchmarks: `f32` or `f64`.
pub trait Float: Scalar + std::fmt::Debug + Into<f64> {
    /// Step of the central differences, radians: near the cube root of the type's precision, where their error is
    /// smallest.
    const STEP: Self;

    /// Returns the sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
}

impl Float for f32 {
    const STEP: Self = 5e-3;

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }
}

impl Float for f64 {
    const STEP: Self = 6e-6;

    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        self.sin_cos()
    }
}

/// Returns `[sin p, cos p, sin h, cos h]` of `[pitch, heading]`.
#[inline(always)]
pub(crate) fn sin_cos<S: Float>([pitch, heading]: [S; 2]) -> [S; 4] {
    let ((sin_p, cos_p), (sin_h, cos_h)) = (pitch.sin_cos(), heading.sin_cos());
    [sin_p, cos_p, sin_h, cos_h]
}
