//! Logarithms near 1, inverse hyperbolic functions and roundings: values, slopes, and limits of quotients at 0.

use aim::differentiate;

macro_rules! functions {
    ($module:ident: $real:ident) => {
        #[differentiate(check = true)]
        mod $module {
            #[differentiate(wrt(x), hessian)]
            pub(super) fn ln_1p(x: $real) -> $real {
                x.ln_1p()
            }
            #[differentiate(wrt(x), hessian)]
            pub(super) fn asinh(x: $real) -> $real {
                x.asinh()
            }
            #[differentiate(wrt(x))]
            pub(super) fn exp_m1(x: $real) -> $real {
                x.exp_m1()
            }
            #[differentiate(wrt(x), hessian)]
            pub(super) fn acosh(x: $real) -> $real {
                x.acosh()
            }
            #[differentiate(wrt(x), hessian)]
            pub(super) fn atanh(x: $real) -> $real {
                x.atanh()
            }
            /// Odds of a probability p = 1/(1 + e⁻ʷ).
            #[differentiate(wrt(w, x))]
            pub(super) fn odds(w: $real, x: $real) -> $real {
                let p = 1.0 / (1.0 + (-w).exp());
                (1.0 - p) / (x + p)
            }
            /// A share that grows from x to 1 as e²ʷ falls from infinity to 0.
            #[differentiate(wrt(w, x))]
            pub(super) fn bound(w: $real, x: $real) -> $real {
                let a = (2.0 * w).exp();
                (x + 1.0 / a) / (1.0 + 1.0 / a)
            }
            #[differentiate(wrt(x))]
            pub(super) fn roundings(x: $real) -> [$real; 5] {
                [x.floor(), x.ceil(), x.round(), x.trunc(), x.fract()]
            }
            #[differentiate(wrt(x), hessian)]
            pub(super) fn ln_1p_over(x: $real) -> $real {
                x.ln_1p() / x
            }
            /// ln t / (t − 1), computed from the distance to 1.
            #[differentiate(wrt(t), hessian)]
            pub(super) fn ln_over_distance(t: $real) -> $real {
                let u = t - 1.0;
                u.ln_1p() / u
            }
            #[differentiate(wrt(x), hessian)]
            pub(super) fn asinh_over(x: $real) -> $real {
                x.asinh() / x
            }
            #[differentiate(wrt(x), hessian)]
            pub(super) fn atanh_over(x: $real) -> $real {
                x.atanh() / x
            }
            #[differentiate(wrt(x))]
            pub(super) fn softplus(x: $real) -> $real {
                x.max(0.0) + (-x.abs()).exp().ln_1p()
            }
        }
    };
}

functions!(single: f32);
functions!(double: f64);

type Second<T> = (T, (T,), [[T; 1]; 1]);

#[expect(clippy::cast_possible_truncation, reason = "the nearest number of single precision is wanted")]
fn single_of(x: f64) -> f32 {
    x as f32
}

/// Checks value, slope and second derivative to the precision of the type.
#[track_caller]
fn near(what: &str, x: f64, expected: [f64; 3], double: Second<f64>, single: Second<f32>) {
    let found = [double.0, double.1.0, double.2[0][0]];
    let of_single = [single.0, single.1.0, single.2[0][0]].map(f64::from);
    for (found, digits) in [(found, 4e-15), (of_single, 2e-6)] {
        for ((found, expected), digits) in found.iter().zip(expected).zip([digits, 4.0 * digits, 40.0 * digits]) {
            let size = expected.abs().max(f64::from(f32::MIN_POSITIVE));
            assert!((found - expected).abs() <= digits * size, "{what} of {x}: {found} instead of {expected}");
        }
    }
}

#[test]
fn no_digits_are_lost_beside_zero() {
    for size in [1e-30, 1e-12, 1e-6, 0.01, 0.2, 0.24, 0.26, 0.3, 0.45, 0.7, 0.9, 3.0, 1e3, 1e8, 1e18] {
        for sign in [1.0, -1.0] {
            let f = single_of(sign * size);
            let x = f64::from(f);
            if x > -0.95 {
                let slope = 1.0 / (1.0 + x);
                near(
                    "ln_1p",
                    x,
                    [x.ln_1p(), slope, -slope * slope],
                    double::ln_1p_hessian(x),
                    single::ln_1p_hessian(f),
                );
            }
            // For small x, `asinh` of std is only as accurate as its logarithm, so the series is the reference there.
            let asinh = if size < 0.01 { x - x.powi(3) / 6.0 } else { x.asinh() };
            let slope = 1.0 / x.hypot(1.0);
            near("asinh", x, [asinh, slope, -x * slope.powi(3)], double::asinh_hessian(x), single::asinh_hessian(f));
            if size < 0.95 {
                let slope = 1.0 / ((1.0 - x) * (1.0 + x));
                let expected = [x.atanh(), slope, 2.0 * x * slope * slope];
                near("atanh", x, expected, double::atanh_hessian(x), single::atanh_hessian(f));
            }
        }
    }
    for x in [1.0 + 2.0_f32.powi(-20), 1.01, 1.5, 3.0, 1e4].map(f64::from) {
        let slope = 1.0 / ((x - 1.0) * (x + 1.0)).sqrt();
        // Near 1, `acosh` of std loses digits: acosh(1 + e) = √(2e) (1 − e/12 + 3e²/160 − …).
        let e = x - 1.0;
        let acosh = if e < 1e-3 { (2.0 * e).sqrt() * (1.0 - e / 12.0 + 0.01875 * e * e) } else { x.acosh() };
        near(
            "acosh",
            x,
            [acosh, slope, -x * slope.powi(3)],
            double::acosh_hessian(x),
            single::acosh_hessian(single_of(x)),
        );
    }
}

#[test]
fn quotients_have_limits_at_zero() {
    for (found, expected) in [
        (double::ln_1p_over_hessian(0.0), (1.0, (-0.5,), [[2.0 / 3.0]])),
        (double::ln_over_distance_hessian(1.0), (1.0, (-0.5,), [[2.0 / 3.0]])),
        (double::asinh_over_hessian(0.0), (1.0, (0.0,), [[-1.0 / 3.0]])),
        (double::atanh_over_hessian(0.0), (1.0, (0.0,), [[2.0 / 3.0]])),
    ] {
        let off =
            (found.0 - expected.0).abs() + (found.1.0 - expected.1.0).abs() + (found.2[0][0] - expected.2[0][0]).abs();
        assert!(off < 1e-14, "{found:?} instead of {expected:?}");
    }
    assert_eq!(single::ln_1p_over_gradient(0.0), (1.0, (-0.5,)));
    // At 0 the slope is not checked; far away nothing overflows.
    for (x, value, slope) in [
        (0.0, core::f64::consts::LN_2, 0.0),
        (1e3, 1e3, 1.0),
        (-1e3, 0.0, 0.0),
        (-40.0, 4.248354255291589e-18, 4.248354255291589e-18),
    ] {
        let found = double::softplus_gradient(x);
        assert!((found.0 - value).abs() <= 1e-14 * value, "{x}: {found:?}");
        assert!(x == 0.0 || (found.1.0 - slope).abs() <= 1e-14 * slope, "{x}: {found:?}");
    }
}

#[test]
fn roundings_are_flat() {
    let below_half = 0.5_f64.next_down();
    for x in [0.0, 0.3, below_half, 0.5, 0.7, 1.0, 1.5, 2.5, 1e6 + 0.5, 4503599627370497.5, 1e20] {
        for x in [x, -x] {
            let (values, (slopes,)) = double::roundings_jacobian(x);
            assert_eq!(values, double::roundings(x), "{x}");
            assert_eq!(slopes, [0.0, 0.0, 0.0, 0.0, 1.0], "{x}");
            let x = single_of(x);
            assert_eq!(single::roundings_jacobian(x), (single::roundings(x), ([0.0, 0.0, 0.0, 0.0, 1.0],)), "{x}");
        }
    }
}

#[test]
fn what_is_finite_is_not_multiplied_by_what_overflows() {
    assert_eq!(single::odds_gradient(-100.0, 2.0), (0.5, (0.0, -0.25)));
    assert_eq!(double::odds_gradient(-800.0, 2.0), (0.5, (0.0, -0.25)));
    assert_eq!(single::bound_gradient(100.0, 2.0).0, 2.0);
    assert_eq!(double::bound_gradient(400.0, 2.0).0, 2.0);
}

#[test]
fn nothing_overflows_far_out() {
    for x in [-1e300, -1e5, -1420.0, -177.5, -40.0, -1.5, -0.5, -1e-9, 0.0, 1e-9, 2.0, 80.0] {
        let (value, (slope,)) = double::exp_m1_gradient(x);
        assert!((value - x.exp_m1()).abs() <= 1e-14 * x.exp_m1().abs(), "{x}: {value}");
        assert!((slope - x.exp()).abs() <= 1e-14 * x.exp(), "{x}: {slope}");
        if x > -1e30 {
            #[expect(clippy::cast_possible_truncation, reason = "rounding is what is meant")]
            let (value, (slope,)) = single::exp_m1_gradient(x as f32);
            assert!((f64::from(value) - x.exp_m1()).abs() <= 1e-5 * x.exp_m1().abs(), "{x}: {value}");
            assert!((f64::from(slope) - x.exp()).abs() <= 1e-5 * x.exp() + 1e-37, "{x}: {slope}");
        }
    }
    for x in [1e20, -1e160, 1e300_f64] {
        let (value, (slope,), _) = double::asinh_hessian(x);
        assert!((value - x.asinh()).abs() <= 1e-14 * x.abs().asinh(), "{x}: {value}");
        assert!((slope - 1.0 / x.abs()).abs() <= 1e-12 / x.abs(), "{x}: {slope}");
    }
    let (value, (slope,), _) = single::asinh_hessian(1e20);
    assert!((value - 46.744_85).abs() < 1e-4 && (slope - 1e-20).abs() < 1e-25, "{value}, {slope}");
}
