//! Roots of expressions with a square as a factor: the result is |x|, not x.

macro_rules! functions {
    ($($name:ident = |$x:ident, $y:ident| $body:expr;)*) => {
        $(mod $name {
            #[aim::differentiate(wrt(x, y))]
            pub(super) fn function($x: f64, $y: f64) -> f64 {
                $body
            }
        })*

        /// Each function by name, with its derived gradient.
        const FUNCTIONS: &[Function] = &[$((stringify!($name), $name::function, $name::function_gradient),)*];
    };
}

type Function = (&'static str, fn(f64, f64) -> f64, fn(f64, f64) -> (f64, (f64, f64)));

functions! {
    sign = |x, y| y * x / (x * x).sqrt();
    hyperbola = |x, y| x * (1.0 + y / (x * x)).sqrt();
    sagitta = |x, y| x - x * (1.0 - y * y / (x * x)).sqrt();
    root_of_equation = |x, y| -x / (2.0 * y) * (1.0 + (1.0 - 0.4 * y / (x * x)).sqrt());
    over_the_factor = |x, y| (x * x + x * x * y).sqrt() / x;
    under_the_factor = |x, y| x / (x * x + x * x * y * y).sqrt();
    sine_by_cosine = |x, y| y * x.sin() / (1.0 - x.cos().powi(2)).sqrt();
    chord = |x, y| y * (1.0 - x.cos()).sqrt() / x.abs();
    signed_chord = |x, y| y * (1.0 - x.cos()).sqrt() / x;
    scaled_chord = |x, y| (1.0 - (y * x).cos()).sqrt() / x;
    root_of_size = |x, y| y * x / x.abs().sqrt();
    power = |x, y| (x * x + y * x * x).powf(1.5) / x.powi(3);
    refraction = |x, y| { let t = (1.0 - (1.0 - y * y) / (x * x)).sqrt(); (y - x * t) / (y + x * t) };
    root_of_square = |x, y| (x * x * y).sqrt() / x;
    length = |x, y| x.hypot(x * y) / x;
    fourth_root = |x, y| (x.powi(4) * y).sqrt().sqrt() / x;
    root_of_quotient = |x, y| (y / (x * x)).sqrt() * x;
    root_of_length = |x, y| (x.hypot(1.0) * y).sqrt();
    root_of_lengths = |x, y| (x.hypot(1.0) / y.hypot(x)).sqrt();
    root_of_root = |x, y| ((x * x).sqrt() * y).sqrt();
    over_root_of_sine = |x, y| x.hypot(y) / x.hypot(y).sin().sqrt();
}

#[test]
fn what_comes_out_of_a_root_is_not_negative() {
    for &(name, function, gradient) in FUNCTIONS {
        for x in [-2.3, -1.3, -1.1, 1.1, 1.3, 2.3_f64] {
            for y in [0.3, 0.7] {
                let (value, (by_x, by_y)) = gradient(x, y);
                let step = 1e-6;
                let expected = [
                    function(x, y),
                    (function(x + step, y) - function(x - step, y)) / (2.0 * step),
                    (function(x, y + step) - function(x, y - step)) / (2.0 * step),
                ];
                for (found, expected) in [value, by_x, by_y].into_iter().zip(expected) {
                    let error = (found - expected).abs();
                    assert!(
                        error <= 1e-8 * (1.0 + expected.abs()),
                        "{name} of {x}, {y}: {found} instead of {expected}"
                    );
                }
            }
        }
    }
}

macro_rules! roots {
    ($($name:ident = |$x:ident, $y:ident| $body:expr;)*) => {
        $(mod $name {
            #[aim::differentiate(wrt(x, y), hessian)]
            pub(super) fn function($x: f64, $y: f64) -> f64 {
                $body
            }
        })*

        /// Each root by name, with its derivatives.
        const ROOTS: &[(&str, Hessian)] = &[$((stringify!($name), $name::function_hessian),)*];
    };
}

type Hessian = fn(f64, f64) -> (f64, (f64, f64), [[f64; 2]; 2]);

roots! {
    root_of_scaled = |x, y| (x.exp() * y).sqrt();
    root_of_scaled_square = |x, y| (x * x * y).sqrt();
    root_of_scaled_size = |x, y| (x.abs() * y * y).sqrt();
    root_of_scaled_length = |x, y| (x.hypot(x) * y).sqrt();
    root_of_product = |x, y| (x * y).sqrt();
}

#[test]
fn the_slopes_of_a_root_are_0_where_it_is_0() {
    for &(name, hessian) in ROOTS {
        for x in [0.0, 0.7] {
            let (value, (by_x, by_y), second) = hessian(x, 0.0);
            let [[xx, xy], [yx, yy]] = second;
            let all = [value, by_x, by_y, xx, xy, yx, yy];
            assert_eq!(all, [0.0; 7], "{name} of {x} and 0");
        }
    }
}

/// The length of a chord over that of a vector: k² comes out of the root as |k|, whatever the sign of k.
#[aim::differentiate(wrt(v), hessian)]
fn chord_over_length(v: aim::glam::DVec3, k: f64) -> f64 {
    ((1.0 - (k * v.length()).cos()) * 2.0).sqrt() / v.length()
}

#[test]
fn the_root_of_a_square_has_its_limit_for_either_sign() {
    for k in [1.3, -1.3_f64] {
        let (value, (slope,), second) = chord_over_length_hessian(aim::glam::DVec3::ZERO, k);
        assert!((value - k.abs()).abs() <= 1e-15, "{value}");
        assert_eq!(slope, aim::glam::DVec3::ZERO);
        for (i, j) in (0..9).map(|n| (n / 3, n % 3)) {
            let expected = if i == j { -k.abs().powi(3) / 12.0 } else { 0.0 };
            assert!((second[i][j] - expected).abs() <= 1e-15, "{second:?}");
        }
    }
}

/// A sum of four squares, which is not the square of a vector, beside one of three under a root.
#[aim::differentiate(wrt(x))]
fn four_squares(x: f64, y: f64, z: f64, w: f64, s: f64, t: f64) -> f64 {
    let three = x * x + y * y + z * z;
    (9.0 - three.sqrt()).sqrt() + x * (s * x + t) / (three + w * w) / s
}

#[test]
fn each_of_four_squares_counts() {
    let (x, y, z, w, s, t) = (0.3, 0.5, -0.4, 0.7, 0.9, -0.6);
    let (_, (found,)) = four_squares_gradient(x, y, z, w, s, t);
    const H: f64 = 1e-5;
    let at = |x| four_squares(x, y, z, w, s, t);
    let expected = (at(x + H) - at(x - H)) / (2.0 * H);
    assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
}
