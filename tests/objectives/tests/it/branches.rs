//! Nested branches, reused conditions, and branches that are infinite or NaN where they are not taken.

use aim_objectives::dual::Dual64;
use aim_objectives::{At, Random, singular};

macro_rules! objectives {
    ($real:ident, $vec3:ident, $quat:ident) => {
        use aim::differentiate;
        use aim::glam::{$quat, $vec3};

        /// A network of four layers with one neuron each.
        #[differentiate(wrt(x, w, b), budget(operations = 14, selects = 30))]
        pub(super) fn layers(x: $real, w: [$real; 4], b: [$real; 4]) -> $real {
            let x = (w[0] * x + b[0]).max(0.0);
            let x = (w[1] * x + b[1]).max(0.0);
            let x = (w[2] * x + b[2]).max(0.0);
            (w[3] * x + b[3]).max(0.0)
        }

        /// Quotients, logarithms and roots, guarded where they are undefined.
        #[differentiate(wrt(x, y))]
        pub(super) fn guarded(x: $real, y: $real) -> $real {
            let quotient = if y > 0.0 { x / y } else { 0.0 };
            let both =
                if x > 0.0 { if y > 0.0 { quotient * (x / y).ln() + x.sqrt() / y } else { x.ln() * y } } else { y * y };
            let grown = if x < 5.0 { x.exp() } else { x * x };
            both + if y > 1.0 && x < 5.0 { grown / y } else { quotient }
        }

        /// A product of rotations that depend on the arguments.
        #[differentiate(wrt(x, p))]
        pub(super) fn turned(x: $real, p: $vec3) -> $real {
            let q = if x > 0.3 { $quat::from_rotation_x(x) } else { $quat::from_rotation_y(2.0 * x) };
            let q = if p.x > 0.0 { q * $quat::from_rotation_z(x) } else { $quat::from_rotation_x(x) * q };
            let q = if p.y > 0.0 { q * $quat::from_rotation_y(x) } else { q };
            let q = if p.z > x { $quat::from_rotation_z(x) * q } else { q * $quat::from_rotation_x(x) };
            let q = if p.x > x && p.y < 0.8 { q.inverse() } else { q * q };
            (q * p).dot(q * $vec3::new(0.2, -0.5, 0.7) + p)
        }
    };
}

mod single {
    objectives!(f32, Vec3, Quat);
}

mod double {
    objectives!(f64, DVec3, DQuat);
}

/// The same functions by other formulas, with dual numbers.
mod dual {
    use aim_objectives::dual::{Number, Vector};

    pub(super) fn layers<D: Number>(x: D, w: [D; 4], b: [D; 4]) -> D {
        w.into_iter().zip(b).fold(x, |x, (w, b)| {
            let sum = w * x + b;
            if sum.re() > 0.0 { sum } else { D::from(0.0) }
        })
    }

    pub(super) fn guarded<D: Number>(x: D, y: D) -> D {
        let (positive_x, positive_y, below) = (x.re() > 0.0, y.re() > 0.0, x.re() < 5.0);
        let both = match (positive_x, positive_y) {
            (true, true) => (x * (x.ln() - y.ln()) + x.sqrt()) / y,
            (true, false) => x.ln() * y,
            (false, _) => y.powi(2),
        };
        let rest = if y.re() > 1.0 && below {
            x.exp() / y
        } else if positive_y {
            x / y
        } else {
            D::from(0.0)
        };
        both + rest
    }

    /// The rotations in the order in which they act, each an axis and an angle.
    pub(super) fn turned<D: Number>(x: D, p: Vector<D>) -> D {
        let [a, b, c] = p.0.map(|c| c.re());
        let mut turns = vec![if x.re() > 0.3 { (0, x) } else { (1, x * 2.0) }];
        if a > 0.0 {
            turns.insert(0, (2, x));
        } else {
            turns.push((0, x));
        }
        if b > 0.0 {
            turns.insert(0, (1, x));
        }
        if c > x.re() {
            turns.push((2, x));
        } else {
            turns.insert(0, (0, x));
        }
        let all: Vec<(usize, D)> = if a > x.re() && b < 0.8 {
            turns.into_iter().rev().map(|(axis, angle)| (axis, -angle)).collect()
        } else {
            turns.repeat(2)
        };
        let by = |v: Vector<D>| all.iter().fold(v, |v, &(axis, angle)| v.about(axis, angle));
        by(p).dot(by(Vector::constant([0.2, -0.5, 0.7])) + p)
    }
}

#[test]
fn network_of_layers() {
    let sample = |r: &mut Random| [r.numbers(5, -1.5..1.5), r.numbers(4, -1.0..1.0)].concat();
    // Keep away from the kinks of the layers.
    let keep = |x: &[f64]| {
        let mut sum = x[0];
        (0..4).all(|i| {
            sum = x[1 + i] * sum.max(if i == 0 { sum } else { 0.0 }) + x[5 + i];
            sum.abs() > 0.02
        })
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::layers,
        double::layers_gradient,
        single::layers_gradient,
        dual::layers::<Dual64>,
    );
}

#[test]
fn branches_that_are_not_finite() {
    let sample = |r: &mut Random| vec![r.within(-1.0..6.0), r.within(-2.0..3.0)];
    let keep = |x: &[f64]| [x[0], x[0] - 5.0, x[1] - 1.0].iter().all(|d| d.abs() > 0.2) && x[1].abs() > 0.4;
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::guarded,
        double::guarded_gradient,
        single::guarded_gradient,
        dual::guarded::<Dual64>,
    );
    // For y = 0 there is no division; for x ≤ 0 there is no logarithm or root; for large x the exponential is infinite.
    for (point, expected) in [
        ([2.0, 0.0], [0.0, 2.0_f64.ln()]),
        ([0.0, -1.0], [0.0, -2.0]),
        ([0.0, 0.0], [0.0, 0.0]),
        ([-1.0, 0.0], [0.0, 0.0]),
        ([1e3, -1.0], [-1e-3, 1e3_f64.ln()]),
    ] {
        singular(&point, double::guarded, double::guarded_gradient, single::guarded_gradient, &expected);
    }
}

#[test]
fn branching_turns() {
    let sample = |r: &mut Random| [r.numbers(1, -1.0..1.0), r.numbers(3, -1.0..1.2)].concat();
    let keep = |x: &[f64]| {
        let edges = [x[0] - 0.3, x[1], x[2], x[3] - x[0], x[1] - x[0], x[2] - 0.8];
        edges.iter().all(|d| d.abs() > 0.01)
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::turned,
        double::turned_gradient,
        single::turned_gradient,
        dual::turned::<Dual64>,
    );
}

#[aim::differentiate]
mod not_a_number {
    #[differentiate(wrt(a, b))]
    pub(super) fn compared(a: f64, b: f64) -> [f64; 6] {
        let truth = |holds: bool| if holds { 1.0 } else { 0.0 };
        [truth(a < b), truth(a > b), truth(a != b), truth(a == b), truth(a <= b), truth(a >= b)]
    }

    #[differentiate(wrt(a, b))]
    pub(super) fn best(a: f64, b: f64) -> [f64; 2] {
        [a.max(b), a.min(b)]
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "this is what it is about")]
    #[differentiate(wrt(x))]
    pub(super) fn cast(x: f64) -> f64 {
        x + (x as usize) as f64
    }
}

/// Checks the guide's table of comparisons with NaN.
#[test]
fn what_is_not_a_number_is_not_below_and_not_above() {
    use not_a_number::{best_jacobian, cast_gradient, compared, compared_jacobian};
    for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN)] {
        assert_eq!(compared_jacobian(a, b).0, [0.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
        assert_eq!(compared(a, b), [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
        assert_eq!(best_jacobian(a, b).0.map(f64::is_nan), [a.is_nan(); 2]);
    }
    assert!(cast_gradient(f64::NAN).0.is_nan());
}
