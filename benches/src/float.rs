//! The two number types, with the sine and cosine that the runtime's `Scalar` does without.

use aim::Scalar;

/// f32 or f64.
pub trait Float: Scalar + std::fmt::Debug + Into<f64> {
    /// A step for central differences: near the cube root of the type's rounding, where their error is least.
    const STEP: Self;

    /// Sine and cosine of an angle in radians.
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

/// sin p, cos p, sin h, cos h.
#[inline(always)]
pub(crate) fn sin_cos<S: Float>([pitch, heading]: [S; 2]) -> [S; 4] {
    let ((sin_p, cos_p), (sin_h, cos_h)) = (pitch.sin_cos(), heading.sin_cos());
    [sin_p, cos_p, sin_h, cos_h]
}
