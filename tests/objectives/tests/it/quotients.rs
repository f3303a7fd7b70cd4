//! Quotients that are 0 / 0 at a point where they have a limit: value, slope and curvature there and near it.

macro_rules! quotients {
    ($real:ident: $($name:ident = |$x:ident| $body:expr;)*) => {
        $(mod $name {
            #[aim::differentiate(wrt(x), hessian)]
            pub(super) fn quotient($x: $real) -> $real {
                $body
            }
        })*

        /// Returns value, slope and curvature of the function with this name.
        pub(super) fn derived(name: &str, x: $real) -> Option<[$real; 3]> {
            let (value, (slope,), [[curvature]]) = match name {
                $(stringify!($name) => $name::quotient_hessian(x),)*
                _ => return None,
            };
            Some([value, slope, curvature])
        }
    };
}

macro_rules! in_both_precisions {
    ($($all:tt)*) => {
        mod single {
            quotients!(f32: $($all)*);
        }

        mod double {
            quotients!(f64: $($all)*);
        }
    };
}

in_both_precisions! {
    sinc = |x| x.sin() / x;
    versine = |x| (1.0 - x.cos()) / (x * x);
    cubic = |x| (x - x.sin()) / x.powi(3);
    tangent = |x| x.tan() / x;
    cotangent = |x| x / x.tan();
    arc_sine = |x| x.asin() / x;
    arc_tangent = |x| x.atan() / x;
    hyperbolic_sine = |x| x.sinh() / x;
    hyperbolic_versine = |x| (x.cosh() - 1.0) / (x * x);
    hyperbolic_tangent = |x| x.tanh() / x;
    half = |x| (0.5 * x).sin() / x;
    square_of_sinc = |x| { let s = x.sin(); s * s / (x * x) };
    ratio = |x| (3.0 * x).sin() / x.sin();
    linear = |x| (1.0 - x.cos()) / x;
    arc_cosine = |x| { let w = 1.0 - x; w.acos() / (1.0 - w * w).sqrt() };
    // Numerators in which no single term vanishes.
    exponential = |x| (x.exp() - 1.0) / x;
    occupation = |x| x / (x.exp() - 1.0);
    logarithm = |x| (1.0 + x).ln() / x;
    root = |x| ((1.0 + x).sqrt() - 1.0) / x;
    annuity = |x| (1.0 - (1.0 + x).powi(-5)) / x;
    bessel = |x| (x.sin() - x * x.cos()) / x.powi(3);
    translation = |x| { let a = x.sin() / x; (1.0 - a) / (x * x) };
    log_of_cosine = |x| x.cos().ln() / (x * x);
    // Compositions of functions.
    sine_of_sine = |x| x.sin().sin() / x;
    over_sine_of_sine = |x| x / x.sin().sin();
    versine_of_sine = |x| (1.0 - x.sin().cos()) / (x * x);
    sine_of_arc_tangent = |x| (1.5 * x.atan()).sin() / x;
}

/// Computed with 60 digits by `golden/quotients.py`.
const EXPECTED: &str = include_str!("golden/quotients.txt");

/// Parses the lines: the function, the point, the three expected numbers.
fn expected() -> impl Iterator<Item = (&'static str, f64, [f64; 3])> {
    EXPECTED.lines().map(|line| {
        let mut words = line.split(' ');
        let name = words.next().expect("a name");
        let numbers: Vec<f64> = words.map(|word| word.parse().expect("a number")).collect();
        (name, numbers[0], [numbers[1], numbers[2], numbers[3]])
    })
}

/// Returns the largest relative error over all functions and points, and where it occurs.
fn worst(derived: impl Fn(&str, f64) -> [f64; 3]) -> (f64, String) {
    let mut worst = (0.0, String::new());
    for (name, x, expected) in expected() {
        let found = derived(name, x);
        for (found, expected) in found.into_iter().zip(expected) {
            let error = (found - expected).abs() / (1.0 + expected.abs());
            // NaN counts as the largest error.
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
    assert_eq!(at_zero, 27);
}
