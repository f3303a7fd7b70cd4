//! Conversions between number types.

/// Rounds to the nearest `f32`.
#[expect(clippy::cast_possible_truncation, reason = "rounding to single precision is the purpose")]
pub(crate) fn narrow(value: f64) -> f32 {
    value as f32
}

/// Converts a count or an index to `f64`; exact below 2^52.
#[expect(clippy::cast_precision_loss, reason = "counts here are bounded by memory, far below 2^52")]
pub(crate) fn count(value: usize) -> f64 {
    value as f64
}
