//! Conversions between float widths, in one place.

/// The nearest `f32`.
#[expect(clippy::cast_possible_truncation, reason = "rounding to single precision is the purpose")]
pub(crate) fn narrow(value: f64) -> f32 {
    value as f32
}

/// An index as a number; exact below 2^52.
#[expect(clippy::cast_precision_loss, reason = "counts here are bounded by memory, far below 2^52")]
pub(crate) fn count(value: usize) -> f64 {
    value as f64
}

/// The next larger `f32` after a finite one that is not negative.
pub(crate) fn just_after(value: f32) -> f32 {
    // Adding zero turns −0 into 0, whose bits are the smallest.
    f32::from_bits((value + 0.0).to_bits() + 1)
}
