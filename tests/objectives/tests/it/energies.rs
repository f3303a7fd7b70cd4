//! Costs of shapes and motions: springs, wells, pendulums, and shape-preserving trajectories.

use aim_objectives::dual::{Dual64, HyperDual64};
use aim_objectives::{At, Random, singular};

// This macro takes whole types and expressions, where others take names: the compiler passes the former on in invisible
// groups.
macro_rules! objectives {
    ($real:ty, $vec3:ty, $mat3:ty, $floor:expr) => {
        /// One term of a trajectory's cost: a point's coordinates along the chord of its neighbours and beside it.
        #[differentiate(wrt(before, here, after), budget = 58)]
        pub(super) fn shape(before: $vec3, here: $vec3, after: $vec3, along: $real, beside: $real) -> $real {
            let chord = (after - before).normalize();
            let step = here - before;
            let alpha = step.dot(chord);
            let beta = step.cross(chord).length();
            (along - alpha).powi(2) + (beside - beta).powi(2)
        }

        /// The energy of a spring between two points.
        #[differentiate(wrt(a, b), hessian, budget = 18)]
        pub(super) fn spring(a: $vec3, b: $vec3, rest: $real, stiffness: $real) -> $real {
            let stretch = a.distance(b) - rest;
            0.5 * stiffness * stretch * stretch
        }

        /// A potential well that attracts a point only when it is near.
        #[differentiate(wrt(p, width), hessian, budget = 19)]
        pub(super) fn well(p: $vec3, width: $real, centre: $vec3) -> $real {
            -(-(p - centre).length_squared() / (2.0 * width * width)).exp()
        }

        /// The quadratic form ½ x·A x − b·x.
        #[differentiate(wrt(x), hessian, budget = 48)]
        pub(super) fn quadratic(x: $vec3, a: $mat3, b: $vec3) -> $real {
            0.5 * x.dot(a * x) - b.dot(x)
        }

        /// The energy of a spherical pendulum of length 1 and mass 1.
        #[differentiate(wrt(theta, theta_rate, phi_rate), hessian, budget = 12)]
        pub(super) fn pendulum(theta: $real, theta_rate: $real, phi_rate: $real, gravity: $real) -> $real {
            let (sin, cos) = theta.sin_cos();
            0.5 * (theta_rate * theta_rate + (sin * phi_rate).powi(2)) - gravity * cos
        }

        /// Two pieces of a rope that resist bending and do not pass through the floor.
        #[differentiate(wrt(p), budget = 78)]
        pub(super) fn rope(p: [$real; 9], stiffness: $real) -> $real {
            let [ax, ay, az, bx, by, bz, cx, cy, cz] = p;
            let (a, b, c) = (<$vec3>::new(ax, ay, az), <$vec3>::new(bx, by, bz), <$vec3>::new(cx, cy, cz));
            let bend = (a - b).normalize_or_zero() + (c - b).normalize_or_zero();
            let floor = if by < 0.0 { by * by } else { 0.0 };
            stiffness * bend.length_squared() + $floor * floor + (a.y + b.y + c.y)
        }
    };
}

mod single {
    use aim::differentiate;
    use aim::glam::{Mat3, Vec3};
    objectives!(f32, Vec3, Mat3, 2.0 * 5.0);
}

mod double {
    use aim::differentiate;
    use aim::glam::{DMat3, DVec3};
    objectives!(f64, DVec3, DMat3, 2.0 * 5.0);
}

/// The same functions by other formulas, with dual numbers.
mod dual {
    use aim_objectives::dual::{Number, Vector};

    pub(super) fn shape<D: Number>(before: Vector<D>, here: Vector<D>, after: Vector<D>, along: D, beside: D) -> D {
        let (step, chord) = (here - before, after - before);
        let alpha = step.dot(chord) / chord.length();
        let beta = chord.cross(step).length() / chord.length();
        alpha.powi(2) + beta.powi(2) + along.powi(2) + beside.powi(2) - (alpha * along + beta * beside) * 2.0
    }

    pub(super) fn spring<D: Number>(a: Vector<D>, b: Vector<D>, rest: D, stiffness: D) -> D {
        let d = b - a;
        stiffness * (d.dot(d) + rest.powi(2)) / 2.0 - stiffness * rest * d.length()
    }

    pub(super) fn well<D: Number>(p: Vector<D>, width: D, centre: Vector<D>) -> D {
        let d = (centre - p).times(width.recip());
        let wells: D = d.0.into_iter().map(|c| -c.powi(2) / 2.0).sum();
        -wells.exp()
    }

    pub(super) fn quadratic<D: Number>(x: Vector<D>, a: [[D; 3]; 3], b: Vector<D>) -> D {
        let mut sum = -b.dot(x);
        for (k, column) in a.into_iter().enumerate() {
            sum += Vector(column).dot(x) * x.0[k] / 2.0;
        }
        sum
    }

    /// By the velocity in Cartesian coordinates.
    pub(super) fn pendulum<D: Number>(theta: D, theta_rate: D, phi_rate: D, gravity: D) -> D {
        let velocity = Vector([theta_rate * theta.cos(), theta.sin() * phi_rate, theta_rate * theta.sin()]);
        velocity.dot(velocity) / 2.0 - gravity * theta.cos()
    }

    pub(super) fn rope<D: Number>(p: [[D; 3]; 3], stiffness: D) -> D {
        let [a, b, c] = p.map(Vector);
        let cosine = (b - a).unit().dot((c - b).unit());
        let [a, b, c] = p.map(|p| p[1]);
        let floor = if b.re() < 0.0 { b.powi(2) } else { D::from(0.0) };
        stiffness * (-cosine + 1.0) * 2.0 + floor * 10.0 + a + b + c
    }
}

#[test]
fn shape_of_a_trajectory() {
    let sample =
        |r: &mut Random| [r.vector(0.0..1.0), r.vector(0.0..1.0), r.vector(0.0..1.0), r.numbers(2, 0.0..1.0)].concat();
    let keep = |x: &[f64]| {
        let [before, here, after] = [0, 3, 6].map(|k| aim::glam::DVec3::from_slice(&x[k..]));
        let chord = after - before;
        chord.length() > 0.3 && (here - before).cross(chord).length() > 0.2 * chord.length()
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::shape,
        double::shape_gradient,
        single::shape_gradient,
        dual::shape,
    );
    // On a straight trajectory the offset has no direction; the component along it has its ordinary derivative.
    let straight = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.5, 0.25];
    let expected = [-1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    singular(&straight, double::shape, double::shape_gradient, single::shape_gradient, &expected);
    // The point coincides with the one before it.
    let stopped = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.25];
    singular(&stopped, double::shape, double::shape_gradient, single::shape_gradient, &[0.0; 9]);
}

#[test]
fn spring_between_points() {
    let sample = |r: &mut Random| [r.numbers(6, -1.0..1.0), r.numbers(2, 0.5..2.0)].concat();
    let keep = |x: &[f64]| aim::glam::DVec3::from_slice(x).distance(aim::glam::DVec3::from_slice(&x[3..])) > 0.3;
    let at = At(|r: &mut Random| r.until(sample, keep));
    at.check(double::spring, double::spring_gradient, single::spring_gradient, dual::spring);
    at.check_second(double::spring_gradient, double::spring_hessian, single::spring_hessian, dual::spring);
    // With both ends in one place the force vanishes.
    let together = [1.0, 2.0, 3.0, 1.0, 2.0, 3.0, 0.5, 4.0];
    singular(&together, double::spring, double::spring_gradient, single::spring_gradient, &[0.0; 6]);
    let hessian = double::spring_hessian;
    let numbers = aim_objectives::Function::feed(&hessian, &together);
    assert!(numbers.iter().all(|x| x.is_finite()), "{numbers:?}");
}

#[test]
fn gaussian_attraction() {
    let at = At(|r: &mut Random| [r.vector(0.0..2.0), r.numbers(1, 0.5..2.0), r.vector(0.0..2.0)].concat());
    at.check(double::well, double::well_gradient, single::well_gradient, dual::well);
    at.check_second(double::well_gradient, double::well_hessian, single::well_hessian, dual::well);
    // At its centre, and so far away that the well vanishes.
    for x in [0.0, 1e4] {
        let point = [x, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0];
        singular(&point, double::well, double::well_gradient, single::well_gradient, &[0.0; 4]);
    }
}

#[test]
fn hessian_of_a_quadratic() {
    let at = At(|r: &mut Random| [r.numbers(3, -2.0..2.0), r.numbers(9, -1.0..1.0), r.vector(0.0..1.0)].concat());
    at.check(double::quadratic, double::quadratic_gradient, single::quadratic_gradient, dual::quadratic);
    at.check_second(double::quadratic_gradient, double::quadratic_hessian, single::quadratic_hessian, dual::quadratic);
}

#[test]
fn spherical_pendulum() {
    let at = At(|r: &mut Random| [r.numbers(3, -3.0..3.0), vec![9.81]].concat());
    at.check(double::pendulum, double::pendulum_gradient, single::pendulum_gradient, dual::pendulum::<Dual64>);
    at.check_second(
        double::pendulum_gradient,
        double::pendulum_hessian,
        single::pendulum_hessian,
        dual::pendulum::<HyperDual64>,
    );
    // At the pole, where a rotation about the vertical does not move the mass.
    let hanging = [0.0, 0.0, 2.0, 9.81];
    singular(&hanging, double::pendulum, double::pendulum_gradient, single::pendulum_gradient, &[0.0; 3]);
}

#[test]
fn bending_of_a_rope() {
    let sample = |r: &mut Random| [r.numbers(9, -1.0..1.0), r.numbers(1, 0.5..2.0)].concat();
    let keep = |x: &[f64]| {
        let [a, b, c] = [0, 3, 6].map(|k| aim::glam::DVec3::from_slice(&x[k..]));
        a.distance(b) > 0.3 && b.distance(c) > 0.3 && b.y.abs() > 0.01
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::rope,
        double::rope_gradient,
        single::rope_gradient,
        dual::rope::<Dual64>,
    );
    // Pieces of length 0 have no direction, so nothing bends. The floor's penalty has slope 0 at the floor.
    let rest = [&[0.0; 9][..], &[1.0]].concat();
    let expected = [0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0];
    singular(&rest, double::rope, double::rope_gradient, single::rope_gradient, &expected);
}
