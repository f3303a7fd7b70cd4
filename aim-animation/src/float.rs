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

/// The square root, to four digits: for what only has to be near.
pub(crate) fn root(number: f64) -> f32 {
    if !(number > 0.0) || !number.is_finite() {
        return narrow(number);
    }
    // Half of the exponent, and Newton's steps.
    let guess = f64::from_bits((number.to_bits() >> 1) + (0x3ff0_0000_0000_0000 >> 1));
    narrow((0..3).fold(guess, |root, _| 0.5 * (root + number / root)))
}
