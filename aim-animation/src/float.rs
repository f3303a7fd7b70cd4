//! What `core` lacks of `f64`.

/// The largest whole number that is not larger.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    reason = "what has digits behind the point fits"
)]
pub(crate) fn floor(number: f64) -> f64 {
    if number.abs() >= 4.5e15 || number.is_nan() {
        return number;
    }
    let whole = number as i64 as f64;
    if whole > number { whole - 1.0 } else { whole }
}

/// Rounded to single precision.
#[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
pub(crate) fn narrow(number: f64) -> f32 {
    number as f32
}
