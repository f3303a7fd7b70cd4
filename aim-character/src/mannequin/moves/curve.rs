//! Interpolation curves over time.

/// Returns the quintic smoothstep 6u⁵ − 15u⁴ + 10u³, with zero velocity and acceleration at both ends. `u` is clamped
/// to 0…1.
pub(super) fn ease(u: f64) -> f64 {
    let u = u.clamp(0.0, 1.0);
    u * u * u * (10.0 - u * (15.0 - 6.0 * u))
}

/// Interpolates (time, value) keys by [`ease`], with zero velocity at each; constant outside.
pub(super) fn through(keys: &[(f64, f64)], at: f64) -> f64 {
    let next = keys.partition_point(|key| key.0 <= at);
    match (next.checked_sub(1).map(|k| keys[k]), keys.get(next)) {
        (Some((t, a)), Some(&(end, b))) => a + (b - a) * ease((at - t) / (end - t)),
        (Some((_, value)), None) | (None, Some(&(_, value))) => value,
        (None, None) => 0.0,
    }
}

/// Interpolates (time, value, velocity) keys by cubic Hermite polynomials; constant outside.
pub(super) fn moving(keys: &[[f64; 3]], at: f64) -> f64 {
    let next = keys.partition_point(|key| key[0] <= at).clamp(1, keys.len() - 1);
    let ([t, a, out], [end, b, into]) = (keys[next - 1], keys[next]);
    let (span, u) = (end - t, ((at - t) / (end - t)).clamp(0.0, 1.0));
    let v = 1.0 - u;
    v * v * (1.0 + 2.0 * u) * a + u * u * (1.0 + 2.0 * v) * b + span * u * v * (v * out - u * into)
}
