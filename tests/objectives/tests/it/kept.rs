//! Loops that remain loops in the derived code: over slices, up to numbers without a known bound, and until
//! convergence.

#[aim::differentiate(check = true)]
mod functions {
    use aim::glam::{DQuat, DVec3};

    #[differentiate(wrt(a, b))]
    pub(super) fn line(a: f64, b: f64, x: &[f64], y: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (x, y) in x.iter().zip(y) {
            let r = a * x + b - y;
            sum += r * r;
        }
        sum / x.len() as f64
    }

    #[differentiate(wrt(mean, width))]
    pub(super) fn likelihood(mean: f64, width: f64, x: &[f64]) -> f64 {
        x.iter().map(|x| 0.5 * ((x - mean) / width).powi(2) + width.ln()).sum()
    }

    /// Two loops: the second uses the results of the first, and those of its own previous iteration.
    #[differentiate(wrt(base, shock, decay))]
    pub(super) fn volatility(base: f64, shock: f64, decay: f64, scale: f64, returns: &[f64]) -> [f64; 2] {
        let mean = scale * returns.iter().map(|r| r * decay).sum::<f64>() / returns.len() as f64;
        let mut variance = base * base + 0.1;
        let mut sum = 0.0;
        for i in 1..returns.len() {
            variance = base + shock * (returns[i - 1] - mean).powi(2) + decay * variance;
            if returns[i] > 0.5 {
                continue;
            }
            sum += (returns[i] - mean).powi(2) * variance;
        }
        [sum, variance]
    }

    #[differentiate(wrt(x))]
    pub(super) fn iterated(x: f64, n: usize) -> f64 {
        let mut y = x;
        for _ in 0..n {
            y = 1.5 * y * (1.0 - y);
        }
        y
    }

    #[differentiate(wrt(k))]
    pub(super) fn smooth(k: f64, x: &[f64]) -> f64 {
        let rough: f64 = x.windows(2).map(|w| (w[1] - k * w[0]).powi(2)).sum();
        let late = x.iter().skip(1).enumerate().filter(|(_, x)| **x > 0.0).map(|(i, x)| k * x * i as f64).sum::<f64>();
        rough + late + x[0] * k + x[x.len() - 1] * k * k
    }

    /// Newton's method, iterated until it converges.
    #[differentiate(wrt(a))]
    pub(super) fn cube_root(a: f64) -> f64 {
        let mut x = 1.0;
        while (x * x * x - a).abs() > 1e-13 {
            x -= (x * x * x - a) / (3.0 * x * x);
        }
        // One more step, so that the derivative is that of a full step.
        x - (x * x * x - a) / (3.0 * x * x)
    }

    /// A loop with an early exit; unrolled, it would be thousands of operations.
    #[differentiate(wrt(price), budget = 50)]
    pub(super) fn bond_yield(price: f64, flows: &[[f64; 2]]) -> Option<f64> {
        let mut y = 0.05;
        for _ in 0..50 {
            let value: f64 = flows.iter().map(|[time, amount]| amount * (-y * time).exp()).sum();
            let slope: f64 = flows.iter().map(|[time, amount]| time * amount * (-y * time).exp()).sum();
            let step = (value - price) / slope;
            y += step;
            if step.abs() < 1e-12 {
                return Some(y);
            }
        }
        None
    }

    /// Unrolled, these loops would be too many operations.
    #[differentiate(wrt(a, b))]
    pub(super) fn quadrature(a: f64, b: f64) -> f64 {
        let mut sum = 0.0;
        for i in 0..40 {
            for j in 5..=60 {
                let (x, y) = ((i as f64 + 0.5) / 40.0, j as f64 / 60.0);
                sum += (a * x).sin() * (-b * x * y).exp() / (1.0 + x * a);
            }
        }
        sum / 2400.0
    }

    /// A loop with an early exit that must be unrolled, because a list grows in it.
    #[differentiate(wrt(a))]
    pub(super) fn trail(a: f64) -> f64 {
        let mut trail = vec![a];
        for _ in 0..20 {
            let last = trail[trail.len() - 1];
            if last < 0.5 {
                break;
            }
            trail.push(0.7 * last);
        }
        trail.iter().sum()
    }

    #[differentiate(wrt(k))]
    pub(super) fn closed(k: f64, x: &[f64]) -> f64 {
        let around: f64 = x.iter().zip(x.iter().cycle().skip(1)).map(|(a, b)| (k * b - a).powi(2)).sum();
        let weighed: f64 = x.iter().zip([1.0, 4.0, 2.0].iter().cycle()).map(|(x, w)| w * (k * x).powi(3)).sum();
        around + weighed
    }

    #[differentiate(wrt(x), hessian)]
    pub(super) fn taken(x: [f64; 3]) -> f64 {
        x.iter().cycle().skip(2).take(7).enumerate().map(|(i, x)| i as f64 * x * x).sum()
    }

    /// Solves Kepler's equation.
    #[differentiate(wrt(mean, eccentricity))]
    pub(super) fn anomaly(mean: f64, eccentricity: f64) -> Option<f64> {
        if !(0.0..0.9).contains(&eccentricity) {
            return None;
        }
        let mut x = mean;
        let mut rounds = 0;
        loop {
            let step = (x - eccentricity * x.sin() - mean) / (1.0 - eccentricity * x.cos());
            x -= step;
            rounds += 1;
            if step.abs() < 1e-9 {
                break;
            }
        }
        if rounds > 1000 { None } else { Some(x) }
    }

    /// A return from inside the loop.
    #[differentiate(wrt(x, limit))]
    pub(super) fn crossing(x: &[f64; 2], limit: f64, values: &[f64]) -> f64 {
        let mut sum = 0.0;
        for (i, value) in values.iter().enumerate() {
            let next = sum + value * x[0] + x[1];
            if next > limit {
                return i as f64 + (limit - sum) / (next - sum);
            }
            if next < -4.0 {
                break;
            }
            sum = next;
        }
        sum
    }

    #[derive(Clone, Copy)]
    pub(super) struct State {
        pub(super) place: DVec3,
        pub(super) speed: DVec3,
        pub(super) is_down: bool,
        pub(super) hits: usize,
    }

    /// A bouncing ball whose state is a struct.
    #[differentiate(wrt(start, drag))]
    pub(super) fn ball(start: DVec3, drag: f64, turn: DQuat, steps: usize) -> DVec3 {
        let speed = turn * DVec3::new(0.0, 0.5, 0.25);
        let mut state = State { place: start, speed, is_down: false, hits: 0 };
        (0..steps).for_each(|_| {
            state.speed += DVec3::Y * -0.5 - state.speed * drag;
            state.place += 0.25 * state.speed;
            state.is_down = state.place.y < 0.0;
            if state.is_down {
                state.place.y = -state.place.y;
                state.speed.y *= -0.5;
                state.hits += 1;
            }
        });
        state.place * (1.0 + state.hits as f64) + if state.is_down { DVec3::X } else { DVec3::ZERO }
    }

    #[derive(Clone, Copy)]
    pub(super) struct Sample {
        pub(super) at: [f64; 2],
        pub(super) weight: Option<f64>,
        pub(super) is_used: bool,
    }

    /// A filtered sum inside a loop that is unrolled.
    #[differentiate(wrt(tangent(turn), bias))]
    pub(super) fn samples(turn: DQuat, bias: f64, samples: &[Sample]) -> f64 {
        let used = samples.iter().filter(|sample| sample.is_used);
        let mut total = bias;
        for axis in [DVec3::X, DVec3::Z] {
            let rotated = turn * axis;
            total += used
                .clone()
                .map(|sample| {
                    let r = rotated.x * sample.at[0] + rotated.y * sample.at[1] - bias;
                    sample.weight.unwrap_or(2.0) * r * r
                })
                .sum::<f64>();
        }
        let any = samples.iter().any(|sample| sample.at[0] > bias);
        let most = samples.iter().fold(f64::NEG_INFINITY, |most, sample| most.max(sample.at[1] * bias));
        if any { total + most } else { total }
    }

    /// A value of the previous iteration, if there was one.
    #[differentiate(wrt(gain, decay))]
    pub(super) fn controlled(gain: f64, decay: f64, errors: &[f64]) -> f64 {
        let mut last: Option<f64> = None;
        let mut sum = 0.0;
        for error in errors {
            let change = match last {
                Some(last) => error - last * decay,
                None => 0.0,
            };
            sum += gain * change * change + error;
            last = Some(*error * gain);
        }
        sum + last.unwrap_or(0.0)
    }

    fn friction(reynolds: f64) -> f64 {
        let mut x = 8.0;
        loop {
            let next = 2.0 * (reynolds / x).ln() - 0.8;
            if (next - x).abs() < 1e-12 {
                return 1.0 / (next * next);
            }
            x = next;
        }
    }

    #[differentiate(wrt(reynolds))]
    pub(super) fn resistance(reynolds: f64) -> f64 {
        let laminar = 64.0 / reynolds;
        if reynolds < 2300.0 { laminar } else { friction(reynolds) }
    }

    /// A loop that would not terminate on the path that is not taken.
    #[differentiate(wrt(x))]
    pub(super) fn guarded(x: f64) -> f64 {
        if x < 1.0 {
            return x;
        }
        let mut y = x;
        while y > 1.0 {
            y = y * y - 1.25 * y.powi(3) * 0.5;
        }
        y
    }
}

use functions::{Sample, State};

/// Returns the central difference (f(x + h) − f(x − h)) / 2h.
pub(crate) fn difference(f: impl Fn(f64) -> f64, x: f64) -> f64 {
    let h = 1e-6;
    (f(x + h) - f(x - h)) / (2.0 * h)
}

pub(crate) fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-7 * (1.0 + expected.abs()), "{found}, expected {expected}");
}

#[test]
fn slices_of_any_length() {
    let (x, y) = ([0.1, 0.5, 0.9, -1.0, 2.0], [0.3, 0.2, 0.1, 1.0]);
    for n in 1..=5 {
        let x = &x[..n];
        let (value, (by_a, by_b)) = functions::line_gradient(0.3, 0.2, x, &y);
        assert_near(value, functions::line(0.3, 0.2, x, &y));
        assert_near(by_a, difference(|a| functions::line(a, 0.2, x, &y), 0.3));
        assert_near(by_b, difference(|b| functions::line(0.3, b, x, &y), 0.2));
        let (value, (by_k,)) = functions::smooth_gradient(0.3, x);
        assert_near(value, functions::smooth(0.3, x));
        assert_near(by_k, difference(|k| functions::smooth(k, x), 0.3));
        let (values, (by_base, by_shock, by_decay)) = functions::volatility_jacobian(0.3, 0.2, 0.4, 0.7, x);
        let expected = functions::volatility(0.3, 0.2, 0.4, 0.7, x);
        for k in 0..2 {
            assert_near(values[k], expected[k]);
            assert_near(by_base[k], difference(|b| functions::volatility(b, 0.2, 0.4, 0.7, x)[k], 0.3));
            assert_near(by_shock[k], difference(|s| functions::volatility(0.3, s, 0.4, 0.7, x)[k], 0.2));
            assert_near(by_decay[k], difference(|d| functions::volatility(0.3, 0.2, d, 0.7, x)[k], 0.4));
        }
    }
    // Nothing to sum.
    assert_eq!(functions::likelihood_gradient(0.3, 0.2, &[]), (0.0, (0.0, 0.0)));
    let many: Vec<f64> = (0..100_000).map(|k| f64::from(k) * 1e-5).collect();
    let (value, (by_mean, _)) = functions::likelihood_gradient(0.3, 0.2, &many);
    assert_near(value, functions::likelihood(0.3, 0.2, &many));
    assert_near(by_mean, -many.iter().map(|x| (x - 0.3) / 0.04).sum::<f64>());
}

#[test]
fn as_many_rounds_as_it_takes() {
    for a in [0.2, 1.0, 5.0, 1000.0_f64] {
        let (value, (slope,)) = functions::cube_root_gradient(a);
        assert_near(value, a.cbrt());
        assert_near(slope, a.cbrt() / (3.0 * a));
    }
    for (mean, e) in [(0.3, 0.2), (2.0, 0.8), (-1.0, 0.5)] {
        let (value, (by_mean, by_e)) = functions::anomaly_gradient(mean, e).expect("it is an orbit");
        let (x, slope) = (value, 1.0 / (1.0 - e * value.cos()));
        assert_near(x - e * x.sin(), mean);
        assert!((by_mean - slope).abs() < 1e-4 && (by_e - x.sin() * slope).abs() < 1e-4, "{by_mean}, {by_e}");
    }
    assert!(functions::anomaly_gradient(1.0, 2.0).is_none());
    for n in [0, 1, 7, 300] {
        let (value, (slope,)) = functions::iterated_gradient(0.3, n);
        assert_near(value, functions::iterated(0.3, n));
        assert_near(slope, difference(|x| functions::iterated(x, n), 0.3));
    }
    for x in [0.5, 0.99, 1.1] {
        let (value, (slope,)) = functions::guarded_gradient(x);
        assert_near(value, functions::guarded(x));
        assert_near(slope, difference(functions::guarded, x));
    }
}

#[test]
fn ways_out() {
    let values = [0.5, 0.25, 1.0, -3.0, 2.0, -40.0, 3.0];
    for limit in [0.1, 0.7, 1.2, 1.9, 5.0, 100.0] {
        for x in [[1.0, 0.1], [0.5, 0.4], [1.5, -0.2]] {
            let (value, (by_x, by_limit)) = functions::crossing_gradient(&x, limit, &values);
            assert_near(value, functions::crossing(&x, limit, &values));
            assert_near(by_limit, difference(|limit| functions::crossing(&x, limit, &values), limit));
            assert_near(by_x[0], difference(|a| functions::crossing(&[a, x[1]], limit, &values), x[0]));
            assert_near(by_x[1], difference(|b| functions::crossing(&[x[0], b], limit, &values), x[1]));
        }
    }
}

#[test]
fn structs_go_from_round_to_round() {
    use aim::glam::{DQuat, DVec3};
    let turn = DQuat::from_rotation_z(0.3);
    for steps in [0, 1, 5, 40] {
        let start = DVec3::new(0.1, 0.6, -0.2);
        let (value, (by_start, by_drag)) = functions::ball_jacobian(start, 0.05, turn, steps);
        assert!((value - functions::ball(start, 0.05, turn, steps)).length() < 1e-12);
        for k in 0..3 {
            assert_near(by_drag[k], difference(|drag| functions::ball(start, drag, turn, steps)[k], 0.05));
            let moved = |y: f64| functions::ball(DVec3::new(0.1, y, -0.2), 0.05, turn, steps)[k];
            assert_near(by_start.col(1)[k], difference(moved, 0.6));
        }
    }
    let sample = |x, y, weight, is_used| Sample { at: [x, y], weight, is_used };
    let samples = [sample(0.5, 0.2, None, true), sample(1.0, -0.3, Some(0.5), true), sample(9.0, 9.0, None, false)];
    for bias in [0.2, 3.0, 20.0] {
        let (value, (_, by_bias)) = functions::samples_gradient(turn, bias, &samples);
        assert_near(value, functions::samples(turn, bias, &samples));
        assert_near(by_bias, difference(|bias| functions::samples(turn, bias, &samples), bias));
    }
    let _ = State { place: DVec3::X, speed: DVec3::X, is_down: true, hits: 0 };
}

#[test]
fn what_was_nothing_and_what_is_returned() {
    let errors = [0.5, -0.25, 1.0];
    for n in 0..=3 {
        let errors = &errors[..n];
        let (value, (by_gain, by_decay)) = functions::controlled_gradient(0.7, 0.9, errors);
        assert_near(value, functions::controlled(0.7, 0.9, errors));
        assert_near(by_gain, difference(|gain| functions::controlled(gain, 0.9, errors), 0.7));
        assert_near(by_decay, difference(|decay| functions::controlled(0.7, decay, errors), 0.9));
    }
    for reynolds in [1.0, 100.0, 5e3, 1e6] {
        let (value, (slope,)) = functions::resistance_gradient(reynolds);
        assert_near(value, functions::resistance(reynolds));
        // The derivative of the iterations lacks a small remainder, hence the tolerance.
        let h = 1e-3 * reynolds;
        let expected = (functions::resistance(reynolds + h) - functions::resistance(reynolds - h)) / (2.0 * h);
        assert!((slope - expected).abs() < 1e-4 * expected.abs(), "{reynolds}: {slope}, not {expected}");
    }
}

#[test]
fn loops_of_known_length_that_are_better_not_written_out() {
    let flows: Vec<[f64; 2]> = (1..=10).map(|year| [f64::from(year), if year == 10 { 105.0 } else { 5.0 }]).collect();
    for price in [60.0, 100.0, 140.0] {
        let (value, (slope,)) = functions::bond_yield_gradient(price, &flows).expect("it converges");
        assert_near(value, functions::bond_yield(price, &flows).expect("it converges"));
        assert_near(slope, difference(|price| functions::bond_yield(price, &flows).expect("it converges"), price));
    }
    assert!(functions::bond_yield_gradient(-1.0, &flows).is_none() && functions::bond_yield(-1.0, &flows).is_none());
    let (value, (by_a, by_b)) = functions::quadrature_gradient(1.3, 0.7);
    assert_near(value, functions::quadrature(1.3, 0.7));
    assert_near(by_a, difference(|a| functions::quadrature(a, 0.7), 1.3));
    assert_near(by_b, difference(|b| functions::quadrature(1.3, b), 0.7));
    for a in [0.3, 0.6, 5.0, 2000.0] {
        let (value, (slope,)) = functions::trail_gradient(a);
        assert_near(value, functions::trail(a));
        assert_near(slope, functions::trail(a) / a);
    }
}

#[test]
fn around_and_around() {
    for count in 0..8 {
        let x: Vec<f64> = (0..count).map(|i| f64::from(i * i) - 3.0).collect();
        let (value, (slope,)) = functions::closed_gradient(0.7, &x);
        assert_near(value, functions::closed(0.7, &x));
        assert_near(slope, difference(|k| functions::closed(k, &x), 0.7));
    }
    let x = [1.0, -2.0, 3.0];
    let (value, (slopes,)) = functions::taken_gradient(x);
    assert_near(value, functions::taken(x));
    // 2 (0 + 3 + 6) x₂, 2 (1 + 4) x₀, 2 (2 + 5) x₁
    assert_eq!(slopes, [10.0 * x[0], 14.0 * x[1], 18.0 * x[2]]);
    assert_eq!(functions::taken_hessian(x).2[2], [0.0, 0.0, 18.0]);
}

use std::f64::consts::{PI, TAU as TURN};

const FRAC_PI_2: f64 = std::f64::consts::FRAC_PI_2;

/// Uses constants that are imported elsewhere.
#[aim::differentiate(wrt(x))]
fn turned(x: f64) -> f64 {
    (PI * x).sin() + FRAC_PI_2
}

#[test]
fn constants_from_elsewhere() {
    let (value, (slope,)) = turned_gradient(0.25);
    assert!((value - turned(0.25)).abs() < 1e-15 && (slope - PI * (PI / 4.0).cos()).abs() < 1e-14);
    assert!((TURN - 2.0 * PI).abs() < 1e-15);
}
