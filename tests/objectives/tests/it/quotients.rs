//! Quotients that are 0 / 0 at a point where they have a limit: value, slope and curvature there and on the way to it.

macro_rules! objectives {
    ($real:ident) => {
        use aim::differentiate;

        #[differentiate(wrt(x), hessian)]
        pub(super) fn sinc(x: $real) -> $real {
            x.sin() / x
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn versine(x: $real) -> $real {
            (1.0 - x.cos()) / (x * x)
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn cubic(x: $real) -> $real {
            (x - x.sin()) / x.powi(3)
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn tangent(x: $real) -> $real {
            x.tan() / x
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn cotangent(x: $real) -> $real {
            x / x.tan()
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn arc_sine(x: $real) -> $real {
            x.asin() / x
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn arc_tangent(x: $real) -> $real {
            x.atan() / x
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn hyperbolic_sine(x: $real) -> $real {
            x.sinh() / x
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn hyperbolic_versine(x: $real) -> $real {
            (x.cosh() - 1.0) / (x * x)
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn hyperbolic_tangent(x: $real) -> $real {
            x.tanh() / x
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn half(x: $real) -> $real {
            (0.5 * x).sin() / x
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn square_of_sinc(x: $real) -> $real {
            let s = x.sin();
            s * s / (x * x)
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn ratio(x: $real) -> $real {
            (3.0 * x).sin() / x.sin()
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn linear(x: $real) -> $real {
            (1.0 - x.cos()) / x
        }

        #[differentiate(wrt(x), hessian)]
        pub(super) fn arc_cosine(x: $real) -> $real {
            let w = 1.0 - x;
            w.acos() / (1.0 - w * w).sqrt()
        }

        /// The function of this name: its value, slope and curvature.
        pub(super) fn derived(name: &str, x: $real) -> Option<[$real; 3]> {
            let (value, (slope,), [[curvature]]) = match name {
                "sinc" => sinc_hessian(x),
                "versine" => versine_hessian(x),
                "cubic" => cubic_hessian(x),
                "tangent" => tangent_hessian(x),
                "cotangent" => cotangent_hessian(x),
                "arc_sine" => arc_sine_hessian(x),
                "arc_tangent" => arc_tangent_hessian(x),
                "hyperbolic_sine" => hyperbolic_sine_hessian(x),
                "hyperbolic_versine" => hyperbolic_versine_hessian(x),
                "hyperbolic_tangent" => hyperbolic_tangent_hessian(x),
                "half" => half_hessian(x),
                "square_of_sinc" => square_of_sinc_hessian(x),
                "ratio" => ratio_hessian(x),
                "linear" => linear_hessian(x),
                "arc_cosine" => arc_cosine_hessian(x),
                _ => return None,
            };
            Some([value, slope, curvature])
        }
    };
}

mod single {
    objectives!(f32);
}

mod double {
    objectives!(f64);
}

/// Computed with 60 digits by `golden/quotients.py`.
const EXPECTED: &str = include_str!("golden/quotients.txt");

/// Each line: the function, the place, the three expected numbers.
fn expected() -> impl Iterator<Item = (&'static str, f64, [f64; 3])> {
    EXPECTED.lines().map(|line| {
        let mut words = line.split(' ');
        let name = words.next().expect("a name");
        let numbers: Vec<f64> = words.map(|word| word.parse().expect("a number")).collect();
        (name, numbers[0], [numbers[1], numbers[2], numbers[3]])
    })
}

/// The largest error relative to the numbers, of all functions and places but those left out.
fn worst(derived: impl Fn(&str, f64) -> [f64; 3]) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for (name, x, expected) in expected() {
        let found = derived(name, x);
        for (found, expected) in found.into_iter().zip(expected) {
            let error = (found - expected).abs() / (1.0 + expected.abs());
            // What is no number is the largest error of all.
            if error > worst.0 || error.is_nan() {
                worst = (error, format!("{name} at {x:e}: {found:e} instead of {expected:e}"));
            }
        }
    }
    worst
}

#[test]
fn quotients_have_their_limits_in_double_precision() {
    let (error, place) = worst(|name, x| double::derived(name, x).expect("a function of that name"));
    assert!(error < 1e-12, "{error:e}: {place}");
}

#[test]
fn quotients_have_their_limits_in_single_precision() {
    #[expect(clippy::cast_possible_truncation, reason = "single precision is what is tested")]
    let (error, place) =
        worst(|name, x| single::derived(name, x as f32).expect("a function of that name").map(f64::from));
    assert!(error < 1e-5, "{error:e}: {place}");
}

#[test]
fn every_quotient_is_expected_at_its_singular_point() {
    let at_zero = expected().filter(|(_, x, _)| *x == 0.0).count();
    assert_eq!(at_zero, 15);
}
