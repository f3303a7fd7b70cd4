//! Round numbers along an axis.

/// Round numbers between two, about `wanted` of them.
pub(crate) fn nice(low: f64, high: f64, wanted: f64) -> Vec<f64> {
    let rough = (high - low) / wanted;
    if !(rough > 0.0 && rough.is_finite()) {
        return Vec::new();
    }
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0].into_iter().map(|step| step * power).find(|step| *step >= rough * 0.999);
    multiples(low, high, step.unwrap_or(10.0 * power))
}

/// The multiples of `step` between two, 64 at most.
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
