//! Linear axes of charts and plots, and round values for their ticks.

/// A linear map from values to coordinates of a drawing, given by its two ends.
#[derive(Clone, Copy)]
pub(crate) struct Axis {
    /// Values at the two ends.
    pub(crate) values: [f64; 2],
    /// Coordinates of the two ends in the drawing.
    pub(crate) places: [f64; 2],
}

impl Axis {
    /// Returns the coordinate of a value. Values beyond the ends are extrapolated.
    pub(crate) fn at(&self, value: f64) -> f64 {
        let [(lo, hi), (from, to)] = [self.values, self.places].map(|[a, b]| (a, b));
        from + (value - lo) / (hi - lo) * (to - from)
    }

    /// Returns the last value minus the first.
    pub(crate) fn span(&self) -> f64 {
        self.values[1] - self.values[0]
    }
}

/// Returns about `wanted` round numbers from `low` to `high`: multiples of 1, 2 or 5 times a power of ten. Empty if the
/// interval is empty or not finite.
pub(crate) fn nice(low: f64, high: f64, wanted: f64) -> Vec<f64> {
    let rough = (high - low) / wanted;
    if !(rough > 0.0 && rough.is_finite()) {
        return Vec::new();
    }
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().map(|step| step * power).find(|step| *step >= rough * 0.999);
    multiples(low, high, step.unwrap_or(10.0 * power))
}

/// Returns the multiples of `step` from `low` to `high`, at most 64 of them.
pub(crate) fn multiples(low: f64, high: f64, step: f64) -> Vec<f64> {
    let first = (low / step - 1e-9).ceil();
    let all = std::iter::successors(Some(first), |k| Some(k + 1.0)).map(|k| k * step);
    all.take_while(|tick| *tick <= high + 1e-9 * step).take(64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round() {
        assert_eq!(multiples(-180.0, 180.0, 90.0), [-180.0, -90.0, 0.0, 90.0, 180.0]);
        assert_eq!(nice(0.0, 10.0, 12.0).len(), 11);
        assert!(nice(0.0, 0.0, 5.0).is_empty() && nice(0.0, f64::NAN, 5.0).is_empty());
    }
}
