//! Floating-point functions missing from `core`.

/// Returns the largest integer that is not greater than `number`. NaN and infinities are returned unchanged.
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

/// Rounds to single precision.
#[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
pub(crate) fn narrow(number: f64) -> f32 {
    number as f32
}

/// Returns the square root to at least four digits, for estimates. Zero, negative and non-finite numbers are returned
/// unchanged.
pub(crate) fn root(number: f64) -> f32 {
    if !(number > 0.0) || !number.is_finite() {
        return narrow(number);
    }
    // Halving the bits halves the exponent, for a first guess; then three Newton steps: r ← (r + number / r) / 2.
    let guess = f64::from_bits((number.to_bits() >> 1) + (0x3ff0_0000_0000_0000 >> 1));
    narrow((0..3).fold(guess, |root, _| 0.5 * (root + number / root)))
}

/// Returns e^(−x) for x ≥ 0, with an error of at most 1e-5: the Taylor polynomial at x / 2ⁿ, squared n times. 0 for
/// NaN; negative numbers are treated as 0.
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
