//! Derivatives by values with discrete parts: those parts are returned as given, in options and enums too.

#[aim::differentiate(check = true)]
mod functions {
    use aim::glam::{DQuat, DVec3};

    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub(super) enum Mode {
        Linear,
        Squared,
    }

    /// A type without `Copy`: its discrete parts must be rebuilt.
    #[derive(Debug, PartialEq)]
    pub(super) struct Gain {
        pub(super) factor: f64,
        pub(super) mode: Mode,
        pub(super) rounds: usize,
        pub(super) is_on: bool,
        pub(super) offset: Option<f64>,
    }

    #[differentiate(wrt(gain, x), hessian, hvp, gauss_newton)]
    pub(super) fn amplified(gain: &Gain, x: f64) -> f64 {
        if !gain.is_on {
            return x;
        }
        let mut y = gain.factor * x;
        for _ in 0..gain.rounds.min(3) {
            y += gain.offset.unwrap_or(0.5) * y;
        }
        match gain.mode {
            Mode::Linear => y,
            Mode::Squared => y * y,
        }
    }

    #[derive(Clone, Copy, Debug, PartialEq)]
    pub(super) enum Shape {
        Ball { centre: [f64; 2], radius: f64 },
        Line(f64, bool),
        Nothing,
    }

    impl Shape {
        fn distance(&self, x: f64, y: f64) -> f64 {
            match *self {
                Self::Ball { centre: [a, b], radius } => (x - a).hypot(y - b) - radius,
                Self::Line(height, true) => y - height,
                Self::Line(height, false) => 1.0 / (x - height),
                Self::Nothing => 3.0,
            }
        }
    }

    #[differentiate(wrt(shapes, at), jvp, vjp)]
    pub(super) fn distances(shapes: [Shape; 2], at: (f64, f64)) -> [f64; 2] {
        shapes.map(|shape| shape.distance(at.0, at.1))
    }

    #[differentiate(wrt(shape), hessian)]
    pub(super) fn distance(shape: Shape) -> f64 {
        shape.distance(0.7, -0.3)
    }

    #[differentiate(wrt(offset))]
    pub(super) fn shifted(offset: Option<(f64, u8)>, x: DVec3) -> DVec3 {
        match offset {
            Some((offset, power)) if power > 0 => x * offset.powi(2),
            Some((offset, _)) => x + DVec3::X * offset,
            None => x,
        }
    }

    /// A polynomial whose degree is an argument, by Horner's rule.
    #[differentiate(wrt(x, coefficients))]
    pub(super) fn polynomial(x: f64, coefficients: &[f64; 4], degree: usize) -> f64 {
        assert!(degree < coefficients.len(), "as many as there are");
        let mut value = 0.0;
        for k in (0..=degree).rev() {
            value = value * x + coefficients[k];
        }
        value
    }

    #[differentiate(wrt(x))]
    pub(super) fn monomial(x: f64, n: i32) -> f64 {
        x.powi(n)
    }

    /// The larger root of a x² + b x + c.
    #[differentiate(wrt(a, b, c), hessian, jvp, hvp)]
    pub(super) fn root(a: f64, b: f64, c: f64) -> Option<f64> {
        let square = b * b - 4.0 * a * c;
        (square > 0.0 && a != 0.0).then(|| (square.sqrt() - b) / (2.0 * a))
    }

    fn finite(x: f64) -> Result<f64, String> {
        if x.is_finite() && x.abs() < 10.0 { Ok(x) } else { Err(format!("{x} is too large")) }
    }

    #[differentiate(wrt(x, gain), vjp, gauss_newton)]
    pub(super) fn powers(x: f64, gain: Option<f64>) -> Result<[f64; 2], String> {
        let square = finite(x * x)?;
        let cube = finite(square * x)?;
        let Some(gain) = gain else { return Err("no gain".to_owned()) };
        Ok([square, gain * cube])
    }

    #[differentiate(wrt(v))]
    pub(super) fn off_zero(v: DVec3, home: DVec3) -> f64 {
        if v == DVec3::ZERO || v == home { 7.0 } else { 1.0 / v.length_squared() }
    }

    pub(super) struct Joint {
        pub(super) is_mirrored: bool,
        pub(super) turn: DQuat,
        pub(super) mode: Mode,
        pub(super) length: f64,
    }

    #[differentiate(wrt(tangent(joint)))]
    pub(super) fn tip(joint: &Joint, axis: DVec3) -> DVec3 {
        let side = if joint.is_mirrored { -axis } else { axis };
        let length = if joint.mode == Mode::Squared { joint.length * joint.length } else { joint.length };
        joint.turn * side * length
    }
}

use functions::{Gain, Joint, Mode, Shape};

fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{found}, expected {expected}");
}

#[test]
fn parts_of_a_struct() {
    let gain = |factor, mode, rounds, is_on, offset| Gain { factor, mode, rounds, is_on, offset };
    // y = 1.5 · 2 (1 + 0.25)², squared.
    let squared = gain(1.5, Mode::Squared, 2, true, Some(0.25));
    let (value, (by_gain, by_x)) = functions::amplified_gradient(&squared, 2.0);
    let y = 3.0 * 1.25_f64.powi(2);
    assert_near(value, y * y);
    assert_near(by_x, 2.0 * y * y / 2.0);
    assert_eq!((by_gain.mode, by_gain.rounds, by_gain.is_on), (Mode::Squared, 2, true));
    assert_near(by_gain.factor, 2.0 * y * y / 1.5);
    assert_near(by_gain.offset.expect("as it was given"), 2.0 * y * 2.0 * 3.0 * 1.25);

    let off = gain(1.5, Mode::Linear, 7, false, None);
    let (value, (by_gain, by_x)) = functions::amplified_gradient(&off, 2.0);
    assert_eq!((value, by_gain, by_x), (2.0, gain(0.0, Mode::Linear, 7, false, None), 1.0));

    // Three numbers vary: the factor, the offset and x.
    let (_, (by_gain, _), second) = functions::amplified_hessian(&squared, 2.0);
    assert_eq!(by_gain.mode, Mode::Squared);
    assert_near(second[0][0], 2.0 * y * y / 1.5 / 1.5);
    assert_near(second[2][2], 2.0 * y * y / 2.0 / 2.0);
    assert_near(second[0][2], 4.0 * y * y / 1.5 / 2.0);
    // The discrete parts of a direction are ignored.
    let along = gain(0.0, Mode::Linear, 0, false, Some(1.0));
    let (slope, (by_gain, by_x)) = functions::amplified_hvp(&squared, 2.0, along, 0.0);
    assert_near(slope, 2.0 * y * 2.0 * 3.0 * 1.25);
    assert_near(by_gain.offset.unwrap_or_default(), second[1][1]);
    assert_near(by_x, second[1][2]);
    let (_, (by_gain, _), normal) = functions::amplified_gauss_newton(&squared, 2.0);
    assert_eq!(by_gain.rounds, 2);
    assert_near(normal[0][2], (2.0 * y * y / 1.5) * y * y);
}

#[test]
fn fields_of_variants() {
    let ball = Shape::Ball { centre: [0.1, 0.2], radius: 0.5 };
    let (values, rows) = functions::distances_jacobian([ball, Shape::Line(0.4, true)], (1.1, 0.2));
    assert_near(values[0], 0.5);
    assert_near(values[1], -0.2);
    let (by_shapes, by_at) = rows;
    assert_eq!(by_shapes[0], [Shape::Ball { centre: [-1.0, 0.0], radius: -1.0 }, Shape::Line(0.0, true)]);
    assert_eq!(by_shapes[1], [Shape::Ball { centre: [0.0, 0.0], radius: 0.0 }, Shape::Line(-1.0, true)]);
    assert_eq!(by_at, [(1.0, 0.0), (0.0, 1.0)]);

    // No division where the shape is no line.
    let shapes = [Shape::Nothing, Shape::Line(1.1, true)];
    let (values, (by_shapes, by_at)) = functions::distances_jacobian(shapes, (1.1, 0.2));
    assert_eq!(values[0], 3.0);
    assert_eq!(by_shapes, [[Shape::Nothing, Shape::Line(0.0, true)], [Shape::Nothing, Shape::Line(-1.0, true)]]);
    assert_eq!(by_at, [(0.0, 0.0), (0.0, 1.0)]);
    let (_, along) = functions::distances_jvp(shapes, (1.1, 0.2), [ball, Shape::Line(2.0, false)], (0.0, 1.0));
    assert_eq!(along, [0.0, -1.0]);

    // Four numbers vary; the derivatives by the other variants' numbers are 0.
    let (_, slope, second) = functions::distance_hessian(Shape::Line(-0.3, false));
    assert_eq!(slope, (Shape::Line(1.0, false),));
    for (i, row) in second.iter().enumerate() {
        for (k, entry) in row.iter().enumerate() {
            assert_near(*entry, if i == 3 && k == 3 { 2.0 } else { 0.0 });
        }
    }
}

#[test]
fn options() {
    use aim::glam::DVec3;
    let x = DVec3::new(1.0, 2.0, 3.0);
    let (_, (by_offset,)) = functions::shifted_jacobian(Some((0.5, 1)), x);
    assert_eq!(by_offset, [x]);
    let (value, (by_offset,)) = functions::shifted_jacobian(None, x);
    assert_eq!((value, by_offset), (x, [DVec3::ZERO]));
}

#[test]
fn parts_have_no_tangent() {
    use aim::glam::{DQuat, DVec3};
    let joint = Joint { is_mirrored: true, turn: DQuat::IDENTITY, mode: Mode::Squared, length: 3.0 };
    let (value, (by_joint,)) = functions::tip_jacobian(&joint, DVec3::Y);
    assert_eq!(value, DVec3::Y * -9.0);
    // −9 ω × Y by the rotation ω, then the derivative by the length.
    assert_eq!(by_joint, [DVec3::Z * -9.0, DVec3::ZERO, DVec3::X * 9.0, DVec3::Y * -6.0]);
}

#[test]
fn whole_numbers_that_are_bounded() {
    let coefficients = [1.0, -2.0, 0.5, 3.0];
    for degree in 0..4 {
        let (value, (by_x, by_coefficients)) = functions::polynomial_gradient(2.0, &coefficients, degree);
        assert_near(value, functions::polynomial(2.0, &coefficients, degree));
        assert_near(by_x, [0.0, -2.0, 0.0, 36.0][degree]);
        for (k, slope) in by_coefficients.into_iter().enumerate() {
            assert_near(slope, if k <= degree { [1.0, 2.0, 4.0, 8.0][k] } else { 0.0 });
        }
    }
}

#[test]
fn powers_that_arguments_say() {
    for x in [-2.0, -1.0, 0.0, 0.5, 3.0_f64] {
        for n in -2..5 {
            let (value, (slope,)) = functions::monomial_gradient(x, n);
            if x != 0.0 || n >= 0 {
                assert_near(value, x.powi(n));
                assert_near(slope, if n == 0 { 0.0 } else { f64::from(n) * x.powi(n - 1) });
            }
        }
    }
}

#[test]
fn results_that_may_be_nothing() {
    assert_eq!(functions::root_gradient(1.0, 1.0, 1.0), None);
    // (x − 1)(x − 3), and by the rule for implicit functions: −1, −x and −x² over 2x − 4.
    let (value, (by_a, by_b, by_c)) = functions::root_gradient(1.0, -4.0, 3.0).expect("there is one");
    assert_eq!((value, by_a, by_b, by_c), (3.0, -4.5, -1.5, -0.5));
    let (_, slope, second) = functions::root_hessian(1.0, -4.0, 3.0).expect("there is one");
    assert_eq!(slope, (by_a, by_b, by_c));
    assert_near(second[2][2], -0.25);
    assert_eq!(functions::root_jvp(1.0, -4.0, 3.0, 1.0, 0.0, 1.0), Some((3.0, -5.0)));
    assert!(functions::root_hvp(1.0, 1.0, 1.0, 1.0, 0.0, 0.0).is_none());

    let (values, (by_x, by_gain)) = functions::powers_jacobian(2.0, Some(0.5)).expect("these are small");
    assert_eq!((values, by_x, by_gain), ([4.0, 4.0], [4.0, 6.0], [Some(0.0), Some(8.0)]));
    for (x, gain) in [(3.0, Some(1.0)), (4.0, Some(1.0)), (f64::NAN, Some(1.0)), (1.0, None)] {
        assert!(functions::powers_jacobian(x, gain).is_none() && functions::powers(x, gain).is_err(), "{x}, {gain:?}");
    }
    assert_eq!(functions::powers_vjp(2.0, Some(0.5), [1.0, 2.0]), Some(([4.0, 4.0], (16.0, Some(16.0)))));
    let (_, by, normal) = functions::powers_gauss_newton(2.0, Some(0.5)).expect("these are small");
    assert_eq!((by, normal), ((40.0, Some(32.0)), [[52.0, 48.0], [48.0, 64.0]]));
}

#[test]
fn vectors_that_are_compared() {
    use aim::glam::DVec3;
    let home = DVec3::new(1.0, 2.0, 3.0);
    assert_eq!(functions::off_zero_gradient(DVec3::ZERO, home), (7.0, (DVec3::ZERO,)));
    assert_eq!(functions::off_zero_gradient(home, home), (7.0, (DVec3::ZERO,)));
    assert_eq!(functions::off_zero_gradient(DVec3::Y * 2.0, home), (0.25, (DVec3::Y * -0.25,)));
}
