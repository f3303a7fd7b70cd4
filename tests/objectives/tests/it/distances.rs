//! Objectives of points, lines, planes and reaching limbs.

use aim_objectives::dual::Dual64;
use aim_objectives::{At, Function, Random, singular};

macro_rules! objectives {
    ($real:ident, $vec3:ident, $quat:ident) => {
        use aim::differentiate;
        use aim::glam::{$quat, $vec3};

        /// The squared distance |p − q|².
        #[differentiate(wrt(p, q), budget = 11)]
        pub(super) fn squared(p: $vec3, q: $vec3) -> $real {
            p.distance_squared(q)
        }

        /// The distance from a point to a line.
        #[differentiate(wrt(p, origin, direction), budget = 60)]
        pub(super) fn to_line(p: $vec3, origin: $vec3, direction: $vec3) -> $real {
            (p - origin).reject_from(direction).length()
        }

        /// The signed distance from a point to the plane through three points.
        #[differentiate(wrt(p, a, b, c), budget = 67)]
        pub(super) fn to_plane(p: $vec3, a: $vec3, b: $vec3, c: $vec3) -> $real {
            let normal = (b - a).cross(c - a).normalize_or_zero();
            normal.dot(p - a)
        }

        /// The distance from a point to a line segment.
        #[differentiate(wrt(p), budget = 68)]
        pub(super) fn to_segment(p: $vec3, a: $vec3, b: $vec3) -> $real {
            let (along, from_a) = (b - a, p - a);
            let t = from_a.dot(along) / along.length_squared();
            if t <= 0.0 {
                p.distance(a)
            } else if t >= 1.0 {
                p.distance(b)
            } else {
                (from_a - t * along).length()
            }
        }

        /// The least of three distances, smoothed.
        #[differentiate(wrt(p), budget = 67)]
        pub(super) fn smooth_nearest(p: $vec3, a: $vec3, b: $vec3, c: $vec3, sharpness: $real) -> $real {
            let (to_a, to_b, to_c) = (p.distance(a), p.distance(b), p.distance(c));
            let least = to_a.min(to_b).min(to_c);
            let sum = (sharpness * (least - to_a)).exp()
                + (sharpness * (least - to_b)).exp()
                + (sharpness * (least - to_c)).exp();
            least - sum.ln() / sharpness
        }

        /// The squared distance of a two-bone limb's hand from its goal.
        #[differentiate(wrt(lift, bend), budget = 26)]
        pub(super) fn reach(lift: $real, bend: $real, upper: $real, lower: $real, goal: $vec3) -> $real {
            let shoulder = $quat::from_rotation_z(lift);
            let elbow = shoulder * $quat::from_rotation_z(bend);
            let hand = shoulder * (upper * $vec3::X) + elbow * (lower * $vec3::X);
            goal.distance_squared(hand)
        }

        /// The position of the hand of a limb whose shoulder also turns.
        #[differentiate(wrt(turn, lift, bend), budget = 19)]
        pub(super) fn hand(turn: $real, lift: $real, bend: $real, upper: $real, lower: $real) -> $vec3 {
            let shoulder = $quat::from_rotation_y(turn) * $quat::from_rotation_z(lift);
            shoulder * ($vec3::new(upper, 0.0, 0.0) + $quat::from_rotation_z(bend) * $vec3::new(lower, 0.0, 0.0))
        }

        /// The elbow's angle for a hand at a point, by the law of cosines; straight or folded if the point is out of
        /// reach.
        #[differentiate(wrt(p, upper, lower), budget = 28)]
        pub(super) fn elbow(p: $vec3, upper: $real, lower: $real) -> $real {
            let cosine = (upper * upper + lower * lower - p.length_squared()) / (2.0 * upper * lower);
            cosine.clamp(-1.0, 1.0).acos()
        }

        /// A point that moves a distance towards another, or away from it.
        #[differentiate(wrt(p, far))]
        pub(super) fn pursuit(p: $vec3, far: $real, other: $vec3) -> $vec3 {
            p.move_towards(other, far)
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

    pub(super) fn squared<D: Number>(p: Vector<D>, q: Vector<D>) -> D {
        p.dot(p) + q.dot(q) - p.dot(q) * 2.0
    }

    pub(super) fn to_line<D: Number>(p: Vector<D>, origin: Vector<D>, direction: Vector<D>) -> D {
        direction.cross(p - origin).length() / direction.length()
    }

    pub(super) fn to_plane<D: Number>(p: Vector<D>, a: Vector<D>, b: Vector<D>, c: Vector<D>) -> D {
        let normal = (a - c).cross(b - c);
        (p - c).dot(normal) / normal.length()
    }

    pub(super) fn to_segment<D: Number>(p: Vector<D>, a: Vector<D>, b: Vector<D>) -> D {
        let along = (b - a).unit();
        let t = (p - a).dot(along);
        if t.re() < 0.0 {
            (p - a).length()
        } else if (p - b).dot(along).re() > 0.0 {
            (p - b).length()
        } else {
            along.cross(p - b).length()
        }
    }

    pub(super) fn smooth_nearest<D: Number>(p: Vector<D>, a: Vector<D>, b: Vector<D>, c: Vector<D>, sharpness: D) -> D {
        let sum: D = [a, b, c].into_iter().map(|q| (-(p - q).length() * sharpness).exp()).sum();
        -sum.ln() / sharpness
    }

    pub(super) fn reach<D: Number>(lift: D, bend: D, upper: D, lower: D, goal: Vector<D>) -> D {
        let hand = hand(D::from(0.0), lift, bend, upper, lower);
        (goal - hand).dot(goal - hand)
    }

    pub(super) fn pursuit<D: Number>(p: Vector<D>, far: D, other: Vector<D>) -> Vector<D> {
        let way = other - p;
        if way.length().re() <= far.re() { other } else { Vector(way.unit().0.map(|part| part * far)) + p }
    }

    pub(super) fn hand<D: Number>(turn: D, lift: D, bend: D, upper: D, lower: D) -> Vector<D> {
        let out = upper * lift.cos() + lower * (lift + bend).cos();
        Vector([out * turn.cos(), upper * lift.sin() + lower * (lift + bend).sin(), -out * turn.sin()])
    }

    /// By the half angle.
    pub(super) fn elbow<D: Number>(p: Vector<D>, upper: D, lower: D) -> D {
        let far = p.length();
        if far.re() >= (upper + lower).re() {
            return D::from(std::f64::consts::PI);
        }
        if far.re() <= (upper - lower).re().abs() {
            return D::from(0.0);
        }
        let sine = (far.powi(2) - (upper - lower).powi(2)).sqrt();
        let cosine = ((upper + lower).powi(2) - far.powi(2)).sqrt();
        sine.atan2(cosine) * 2.0
    }
}

#[test]
fn squared_distance() {
    let sample = |r: &mut Random| r.numbers(6, -2.0..2.0);
    At(sample).check(double::squared, double::squared_gradient, single::squared_gradient, dual::squared);
    let together = [1.0, 2.0, 3.0, 1.0, 2.0, 3.0];
    singular(&together, double::squared, double::squared_gradient, single::squared_gradient, &[0.0; 6]);
}

#[test]
fn point_to_line() {
    let sample = |r: &mut Random| [r.vector(0.0..2.0), r.vector(0.0..2.0), r.vector(0.5..2.0)].concat();
    At(|r: &mut Random| r.until(sample, |x| double::to_line.feed(x)[0] > 0.2)).check(
        double::to_line,
        double::to_line_gradient,
        single::to_line_gradient,
        dual::to_line,
    );
    // On the line, at its origin and elsewhere.
    for x in [0.0, 3.0] {
        let point = [x, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0];
        singular(&point, double::to_line, double::to_line_gradient, single::to_line_gradient, &[0.0; 9]);
    }
}

#[test]
fn point_to_plane() {
    let sample = |r: &mut Random| r.numbers(12, -2.0..2.0);
    let keep = |x: &[f64]| {
        let at = |k| aim::glam::DVec3::from_slice(&x[k..]);
        (at(6) - at(3)).cross(at(9) - at(3)).length() > 1.0
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::to_plane,
        double::to_plane_gradient,
        single::to_plane_gradient,
        dual::to_plane,
    );
    // Three points on a line span no plane.
    let flat = [1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 2.0, 0.0, 0.0];
    singular(&flat, double::to_plane, double::to_plane_gradient, single::to_plane_gradient, &[0.0; 12]);
}

#[test]
fn point_to_segment() {
    let sample = |r: &mut Random| [r.vector(0.0..2.0), r.vector(0.5..1.0), r.vector(1.5..2.5)].concat();
    let keep = |x: &[f64]| {
        let [p, a, b] = [0, 3, 6].map(|k| aim::glam::DVec3::from_slice(&x[k..]));
        let along = (b - a).normalize();
        let (before, after) = ((p - a).dot(along), (p - b).dot(along));
        double::to_segment.feed(x)[0] > 0.2 && before.abs() > 0.01 && after.abs() > 0.01
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::to_segment,
        double::to_segment_gradient,
        single::to_segment_gradient,
        dual::to_segment,
    );
    // On the segment, at an end, and level with an end, where both branches agree.
    let ends = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0];
    for (p, expected) in
        [([1.0, 0.0, 0.0], 0.0), ([0.0, 0.0, 0.0], 0.0), ([2.0, 0.0, 0.0], 0.0), ([2.0, 1.0, 0.0], 1.0)]
    {
        singular(
            &[&p[..], &ends].concat(),
            double::to_segment,
            double::to_segment_gradient,
            single::to_segment_gradient,
            &[0.0, expected, 0.0],
        );
    }
}

#[test]
fn smooth_minimum_of_distances() {
    let sample = |r: &mut Random| [r.numbers(12, -2.0..2.0), r.numbers(1, 0.5..4.0)].concat();
    let keep = |x: &[f64]| {
        let [p, a, b, c] = [0, 3, 6, 9].map(|k| aim::glam::DVec3::from_slice(&x[k..]));
        [a, b, c].into_iter().all(|q| p.distance(q) > 0.2)
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::smooth_nearest,
        double::smooth_nearest_gradient,
        single::smooth_nearest_gradient,
        dual::smooth_nearest,
    );
    // On all three points, and equally far from two, where the least distance changes.
    let on = [&[1.0; 12][..], &[2.0]].concat();
    let between = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, 1000.0, 0.0, 2.0];
    for point in [on, between.to_vec()] {
        singular(
            &point,
            double::smooth_nearest,
            double::smooth_nearest_gradient,
            single::smooth_nearest_gradient,
            &[0.0; 3],
        );
    }
}

#[test]
fn two_bone_reach() {
    let sample = |r: &mut Random| [r.numbers(2, -3.0..3.0), r.numbers(2, 0.3..1.0), r.numbers(3, -2.0..2.0)].concat();
    At(sample).check(double::reach, double::reach_gradient, single::reach_gradient, dual::reach);
    // Stretched out, with the hand on the goal.
    let there = [0.0, 0.0, 1.0, 0.5, 1.5, 0.0, 0.0];
    singular(&there, double::reach, double::reach_gradient, single::reach_gradient, &[0.0; 2]);
}

#[test]
fn hand_of_a_limb() {
    let sample = |r: &mut Random| [r.numbers(3, -3.0..3.0), r.numbers(2, 0.3..1.0)].concat();
    At(sample).check(double::hand, double::hand_jacobian, single::hand_jacobian, dual::hand::<Dual64>);
    let stretched = [0.0, 0.0, 0.0, 1.0, 0.5];
    let expected = [0.0, 0.0, -1.5, 0.0, 1.5, 0.0, 0.0, 0.5, 0.0];
    singular(&stretched, double::hand, double::hand_jacobian, single::hand_jacobian, &expected);
}

#[test]
fn elbow_by_the_law_of_cosines() {
    let sample = |r: &mut Random| [r.vector(0.05..2.2), r.numbers(2, 0.3..1.0)].concat();
    let keep = |x: &[f64]| {
        let cosine = (x[3] * x[3] + x[4] * x[4] - x[..3].iter().map(|x| x * x).sum::<f64>()) / (2.0 * x[3] * x[4]);
        (cosine.abs() - 1.0).abs() > 0.1
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::elbow,
        double::elbow_gradient,
        single::elbow_gradient,
        dual::elbow,
    );
    // Fully stretched, out of reach, and folded.
    for x in [1.5, 4.0, 0.5, 0.25, 0.0] {
        let point = [x, 0.0, 0.0, 1.0, 0.5];
        singular(&point, double::elbow, double::elbow_gradient, single::elbow_gradient, &[0.0; 5]);
    }
}

#[test]
fn pursuit_and_flight() {
    let sample = |r: &mut Random| [r.vector(0.3..2.0), r.numbers(1, -6.0..6.0), r.vector(0.3..2.0)].concat();
    let keep = |x: &[f64]| {
        let apart = (0..3).map(|k| (x[k] - x[4 + k]).powi(2)).sum::<f64>().sqrt();
        apart > 0.2 && (apart - x[3]).abs() > 0.1
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::pursuit,
        double::pursuit_jacobian,
        single::pursuit_jacobian,
        dual::pursuit::<Dual64>,
    );
}
