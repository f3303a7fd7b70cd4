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

/// e^(−x) for x ≥ 0, to 1e-5: by its series at x / 2ⁿ, squared n times. 0 for NaN.
pub(crate) fn decay(x: f32) -> f32 {
    if !(x < 87.0) {
        return 0.0;
    }
    let (mut x, mut squarings) = (x.max(0.0), 0_u8);
    while x > 0.25 {
        (x, squarings) = (0.5 * x, squarings + 1);
    }
    let series = 1.0 - x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0))));
    (0..squarings).fold(series, |power, _| power * power)
}
