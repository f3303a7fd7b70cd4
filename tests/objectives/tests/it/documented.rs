//! Checks every number in the tables of `docs/singularities.md`.

macro_rules! objectives {
    ($real:ident, $vec3:ident) => {
        use aim::differentiate;
        use aim::glam::$vec3;

        #[differentiate(wrt(x), hessian)]
        fn sinc(x: $real) -> $real {
            x.sin() / x
        }

        #[differentiate(wrt(x), hessian)]
        fn versine(x: $real) -> $real {
            (1.0 - x.cos()) / (x * x)
        }

        #[differentiate(wrt(x), hessian)]
        fn cubic(x: $real) -> $real {
            (x - x.sin()) / x.powi(3)
        }

        #[differentiate(wrt(x), hessian)]
        fn tangent(x: $real) -> $real {
            x.tan() / x
        }

        #[differentiate(wrt(x), hessian)]
        fn arc_sine(x: $real) -> $real {
            x.asin() / x
        }

        #[differentiate(wrt(x), hessian)]
        fn arc_tangent(x: $real) -> $real {
            x.atan() / x
        }

        #[differentiate(wrt(x), hessian)]
        fn hyperbolic_sine(x: $real) -> $real {
            x.sinh() / x
        }

        #[differentiate(wrt(x), hessian)]
        fn hyperbolic_tangent(x: $real) -> $real {
            x.tanh() / x
        }

        #[differentiate(wrt(x), hessian)]
        fn arc_cosine(x: $real) -> $real {
            x.acos() / (1.0 - x * x).sqrt()
        }

        #[differentiate(wrt(x), hessian)]
        fn cancelled(x: $real) -> $real {
            x * x / x
        }

        #[differentiate(wrt(x), hessian)]
        fn exponential(x: $real) -> $real {
            (x.exp() - 1.0) / x
        }

        #[differentiate(wrt(x), hessian)]
        fn of_logarithm(x: $real) -> $real {
            (1.0 + x).ln() / x
        }

        #[differentiate(wrt(x), hessian)]
        fn bessel(x: $real) -> $real {
            (x.sin() - x * x.cos()) / x.powi(3)
        }

        #[differentiate(wrt(x), hessian)]
        fn cube_root(x: $real) -> $real {
            ((1.0 + x).cbrt() - 1.0) / x
        }

        #[differentiate(wrt(x), hessian)]
        fn rise(x: $real) -> $real {
            (x.hypot(1.0) - 1.0) / x
        }

        #[differentiate(wrt(x), hessian)]
        fn size(x: $real) -> $real {
            x.abs()
        }

        #[differentiate(wrt(x), hessian)]
        fn sign(x: $real) -> $real {
            x.signum()
        }

        #[differentiate(wrt(x), hessian)]
        fn largest(x: $real) -> $real {
            x.max(0.0)
        }

        #[differentiate(wrt(x), hessian)]
        fn smallest(x: $real) -> $real {
            x.min(0.0)
        }

        #[differentiate(wrt(x), hessian)]
        fn clamped(x: $real) -> $real {
            x.clamp(0.0, 1.0)
        }

        #[differentiate(wrt(x), hessian)]
        fn root_of_square(x: $real) -> $real {
            (x * x).sqrt()
        }

        #[differentiate(wrt(x), hessian)]
        fn root(x: $real) -> $real {
            x.sqrt()
        }

        #[differentiate(wrt(x), hessian)]
        fn length(x: $real) -> $real {
            $vec3::new(x, 0.0, 0.0).length()
        }

        #[differentiate(wrt(x), hessian)]
        fn direction(x: $real) -> $real {
            $vec3::new(x, 0.0, 0.0).normalize().x
        }

        #[differentiate(wrt(x), hessian)]
        fn logarithm(x: $real) -> $real {
            x.ln()
        }

        #[differentiate(wrt(x), hessian)]
        fn asin(x: $real) -> $real {
            x.asin()
        }

        #[differentiate(wrt(x), hessian)]
        fn acos(x: $real) -> $real {
            x.acos()
        }

        #[differentiate(wrt(x), hessian)]
        fn angle(x: $real) -> $real {
            x.atan2(0.0)
        }

        #[differentiate(wrt(x), hessian)]
        fn power(x: $real) -> $real {
            x.powf(1.5)
        }

        #[differentiate(wrt(x), hessian)]
        fn remainder(x: $real) -> $real {
            x.rem_euclid(1.0)
        }

        /// Returns value, slope and curvature of this expression by its derived function.
        pub(super) fn derived(expression: &str, x: $real) -> Option<[$real; 3]> {
            let (value, (slope,), [[curvature]]) = match expression {
                "x.sin() / x" => sinc_hessian(x),
                "(1.0 - x.cos()) / (x * x)" => versine_hessian(x),
                "(x - x.sin()) / x.powi(3)" => cubic_hessian(x),
                "x.tan() / x" => tangent_hessian(x),
                "x.asin() / x" => arc_sine_hessian(x),
                "x.atan() / x" => arc_tangent_hessian(x),
                "x.sinh() / x" => hyperbolic_sine_hessian(x),
                "x.tanh() / x" => hyperbolic_tangent_hessian(x),
                "x.acos() / (1.0 - x * x).sqrt()" => arc_cosine_hessian(x),
                "x * x / x" => cancelled_hessian(x),
                "(x.exp() - 1.0) / x" => exponential_hessian(x),
                "(1.0 + x).ln() / x" => of_logarithm_hessian(x),
                "(x.sin() - x * x.cos()) / x.powi(3)" => bessel_hessian(x),
                "((1.0 + x).cbrt() - 1.0) / x" => cube_root_hessian(x),
                "(x.hypot(1.0) - 1.0) / x" => rise_hessian(x),
                "x.abs()" => size_hessian(x),
                "x.signum()" => sign_hessian(x),
                "x.max(0.0)" => largest_hessian(x),
                "x.min(0.0)" => smallest_hessian(x),
                "x.clamp(0.0, 1.0)" => clamped_hessian(x),
                "(x * x).sqrt()" => root_of_square_hessian(x),
                "x.sqrt()" => root_hessian(x),
                "Vec3::new(x, 0.0, 0.0).length()" => length_hessian(x),
                "Vec3::new(x, 0.0, 0.0).normalize().x" => direction_hessian(x),
                "x.ln()" => logarithm_hessian(x),
                "x.asin()" => asin_hessian(x),
                "x.acos()" => acos_hessian(x),
                "x.atan2(0.0)" => angle_hessian(x),
                "x.powf(1.5)" => power_hessian(x),
                "x.rem_euclid(1.0)" => remainder_hessian(x),
                _ => return None,
            };
            Some([value, slope, curvature])
        }
    };
}

mod single {
    objectives!(f32, Vec3);
}

mod double {
    objectives!(f64, DVec3);
}

const PAGE: &str = include_str!("../../../../docs/singularities.md");

/// Returns the rows of the table under this heading: the expression and the other cells.
fn rows(heading: &str) -> Vec<(&'static str, Vec<&'static str>)> {
    let table = PAGE.split(heading).nth(1).expect("the page has the heading").split("\n## ").next().expect("the first");
    let rows = table.lines().filter_map(|line| line.strip_prefix("| `")?.split_once("` | "));
    rows.map(|(expression, cells)| (expression, cells.split('|').map(str::trim).collect())).collect()
}

fn number(cell: &str) -> f64 {
    if cell == "none" { f64::NAN } else { cell.parse().unwrap_or_else(|_| panic!("“{cell}” is no number")) }
}

#[track_caller]
fn near(what: &str, found: f64, expected: f64, tolerance: f64) {
    let same = (found - expected).abs() <= tolerance * (1.0 + expected.abs()) || found.is_nan() && expected.is_nan();
    assert!(same, "{what}: {found} instead of {expected}");
}

fn single_of(x: f64) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "single precision is what is tested")]
    let x = x as f32;
    x
}

#[test]
fn limits_are_as_documented() {
    let rows = rows("## Limits");
    assert_eq!(rows.len(), 15);
    for (expression, cells) in rows {
        let x = number(cells[0]);
        let double = double::derived(expression, x).expect("each expression is a function here");
        let single = single::derived(expression, single_of(x)).expect("each expression is a function here");
        for (place, expected) in cells[1..4].iter().map(|cell| number(cell)).enumerate() {
            near(expression, double[place], expected, 1e-12);
            near(expression, single[place].into(), expected, 1e-5);
        }
    }
}

#[test]
fn conventions_are_as_documented_on_both_sides() {
    let rows = rows("## Conventions");
    assert_eq!(rows.len(), 15);
    for (expression, cells) in rows {
        let at = number(cells[0]);
        for (side, cell) in [-1.0, 0.0, 1.0].into_iter().zip(&cells[1..4]) {
            let x = at + side * 1e-6;
            let found = double::derived(expression, x).expect("each expression is a function here")[1];
            near(&format!("{expression} at {x}"), found, number(cell), 1e-6);
            // In single precision, 1 + 10⁻⁶ is rounded.
            if side == 0.0 || at == 0.0 {
                let found = single::derived(expression, single_of(x)).expect("each expression is a function here")[1];
                near(&format!("{expression} at {x} in f32"), found.into(), number(cell), 1e-5);
            }
        }
    }
}

/// The slope of asin at 1 − e is 1/√(e (2 − e)), where 1 − x² loses the digits of e.
#[test]
fn arcs_keep_their_digits_near_one() {
    for exponent in 1..=12 {
        let x = 1.0 - 10f64.powi(-exponent);
        let slope = |e: f64| 1.0 / (e * (2.0 - e)).sqrt();
        for (expression, sign) in [("x.asin()", 1.0), ("x.acos()", -1.0)] {
            for x in [x, -x] {
                let expected = sign * slope(1.0 - x.abs());
                let [_, found, curvature] = double::derived(expression, x).expect("each expression is a function here");
                near_by_digits(&format!("{expression} at {x}"), found, expected, 1e-15);
                let expected = sign * x * expected.abs().powi(3);
                near_by_digits(&format!("{expression}, twice, at {x}"), curvature, expected, 3e-15);
            }
            let x = single_of(x);
            let found = single::derived(expression, x).expect("each expression is a function here")[1];
            if x < 1.0 {
                let expected = sign * slope(1.0 - f64::from(x));
                near_by_digits(&format!("{expression} at {x} in f32"), found.into(), expected, 5e-7);
            }
        }
    }
}

/// The other ways to write difference quotients and `ln(1 + eˣ)`, which the guide advises.
mod advised {
    use aim::differentiate;

    #[differentiate(wrt(a, b))]
    pub(super) fn of_exponentials(a: f64, b: f64) -> f64 {
        b.exp() * (a - b).exp_m1() / (a - b)
    }

    #[differentiate(wrt(a, b))]
    pub(super) fn logarithmic_mean(a: f64, b: f64) -> f64 {
        let u = (a - b) / b;
        b * u / u.ln_1p()
    }

    #[differentiate(wrt(x))]
    pub(super) fn softplus(x: f64) -> f64 {
        x.max(0.0) + (-x.abs()).exp().ln_1p()
    }
}

#[test]
fn difference_quotients_have_their_limits_as_advised() {
    let e = 0.7f64.exp();
    let near_pair = |what: &str, found: (f64, (f64, f64)), value: f64, slopes: [f64; 2]| {
        near_by_digits(what, found.0, value, 1e-12);
        near_by_digits(what, found.1.0, slopes[0], 1e-7);
        near_by_digits(what, found.1.1, slopes[1], 1e-7);
    };
    for off in [0.0, 1e-12, 1e-8] {
        let found = advised::of_exponentials_gradient(0.7 + off, 0.7);
        near_pair(&format!("exponentials {off} apart"), found, e * (1.0 + off / 2.0), [e / 2.0; 2]);
        let found = advised::logarithmic_mean_gradient(3.0 + off, 3.0);
        near_pair(&format!("logarithms {off} apart"), found, 3.0 + off / 2.0, [0.5; 2]);
    }
    assert_eq!(advised::softplus_gradient(800.0), (800.0, (1.0,)));
    assert_eq!(advised::softplus_gradient(-800.0), (0.0, (0.0,)));
}

#[track_caller]
fn near_by_digits(what: &str, found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{what}: {found} instead of {expected}");
}
