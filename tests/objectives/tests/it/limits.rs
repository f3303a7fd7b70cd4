//! Objectives that limit angles: hinges, barriers, smooth limits, displacement costs.

use aim_objectives::dual::{Dual64, HyperDual64};
use aim_objectives::{At, Random, singular};

macro_rules! objectives {
    ($real:ident, $vec2:ident, $vec3:ident, $quat:ident) => {
        use aim::differentiate;
        use aim::glam::{$quat, $vec2, $vec3};

        /// Zero inside a cone about the axis, the square of the excess outside.
        #[differentiate(wrt(p, h), budget(operations = 18, selects = 4, calls = 4))]
        pub(super) fn cone(p: $real, h: $real, axis: $vec3, cosine: $real) -> $real {
            let forward = $quat::from_rotation_y(h) * ($quat::from_rotation_x(-p) * $vec3::Z);
            let beyond = cosine - forward.dot(axis);
            if beyond > 0.0 { beyond * beyond } else { 0.0 }
        }

        /// The excess of the angle to the axis over a limit: a hinge with a kink at the limit, and another where the
        /// angle is 0.
        #[differentiate(wrt(v), budget = 46)]
        pub(super) fn beyond(v: $vec3, axis: $vec3, limit: $real) -> $real {
            (v.angle_between(axis) - limit).max(0.0)
        }

        /// A smooth hinge at both ends of a range, written so that nothing overflows.
        #[differentiate(wrt(angle, low, high), budget(operations = 20, selects = 20, calls = 4))]
        pub(super) fn softplus(angle: $real, low: $real, high: $real, sharpness: $real) -> $real {
            let (over, under) = (sharpness * (angle - high), sharpness * (low - angle));
            let above = over.max(0.0) + (1.0 + (-over.abs()).exp()).ln();
            let below = under.max(0.0) + (1.0 + (-under.abs()).exp()).ln();
            (above + below) / sharpness
        }

        /// A smooth step from 0 to 1 between two angles, flat outside.
        #[differentiate(wrt(x, low, high), budget(operations = 12, selects = 20))]
        pub(super) fn smoothstep(x: $real, low: $real, high: $real) -> $real {
            let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        }

        /// An angle that never leaves its range: a hyperbolic tangent, written so that nothing overflows.
        #[differentiate(wrt(x, most), budget(operations = 15, selects = 8, calls = 1))]
        pub(super) fn saturated(x: $real, most: $real) -> $real {
            let e = (-2.0 * (x / most).abs()).exp();
            most * x.signum() * (1.0 - e) / (1.0 + e)
        }

        /// A barrier that grows without bound towards the ends of both ranges.
        #[differentiate(wrt(p, h), hessian, budget = 13)]
        pub(super) fn barrier(p: $real, h: $real, pitch: $vec2, heading: $vec2) -> $real {
            -((p - pitch.x) * (pitch.y - p)).ln() - ((h - heading.x) * (heading.y - h)).ln()
        }

        /// The angle of a point whose lateral offset is a difference.
        #[differentiate(wrt(a, b))]
        pub(super) fn left(a: $real, b: $real, ahead: $real) -> $real {
            (a - b).atan2(a * ahead)
        }

        /// As [`left`], with the difference reversed.
        #[differentiate(wrt(a, b))]
        pub(super) fn right(a: $real, b: $real, ahead: $real) -> $real {
            (b - a).atan2(a * ahead)
        }

        /// As [`right`], with a multiple of the difference and another denominator.
        #[differentiate(wrt(a, b))]
        pub(super) fn wide(a: $real, b: $real, ahead: $real) -> $real {
            (3.0 * (b - a)).atan2(ahead - a * b)
        }

        /// The stiffness-weighted length of a displacement.
        #[differentiate(wrt(angles), budget = 21)]
        pub(super) fn displacement(angles: [$real; 4], stiffness: [$real; 4]) -> $real {
            let [a, b, c, d] = angles;
            let spine = stiffness[2] * c * c + stiffness[3] * d * d;
            (stiffness[0] * a * a + stiffness[1] * b * b + spine).sqrt()
        }

        /// The error of a heading against that of a place, along the shorter way, with a piecewise cost.
        #[differentiate(wrt(heading, place), budget = 18)]
        pub(super) fn heading_error(heading: $real, place: $vec2) -> $real {
            let off = heading - place.y.atan2(place.x);
            let wrapped = off.sin().atan2(off.cos());
            let size = wrapped.abs();
            if size < core::$real::consts::FRAC_PI_2 {
                0.5 * size * size
            } else if size <= 3.0 {
                size * size - core::$real::consts::FRAC_PI_2 * size
            } else {
                4.0
            }
        }
    };
}

mod single {
    objectives!(f32, Vec2, Vec3, Quat);
}

mod double {
    objectives!(f64, DVec2, DVec3, DQuat);
}

/// The same functions by other formulas, with dual numbers.
mod dual {
    use aim_objectives::dual::{Number, Vector};

    pub(super) fn cone<D: Number>(p: D, h: D, axis: Vector<D>, cosine: D) -> D {
        let forward = Vector([p.cos() * h.sin(), p.sin(), p.cos() * h.cos()]);
        let inside = forward.dot(axis) - cosine;
        if inside.re() < 0.0 { inside.powi(2) } else { D::from(0.0) }
    }

    pub(super) fn beyond<D: Number>(v: Vector<D>, axis: Vector<D>, limit: D) -> D {
        let angle = v.cross(axis).length().atan2(v.dot(axis));
        if angle.re() > limit.re() { angle - limit } else { D::from(0.0) }
    }

    pub(super) fn softplus<D: Number>(angle: D, low: D, high: D, sharpness: D) -> D {
        let soft = |x: D| (x * sharpness).exp().ln_1p() / sharpness;
        soft(angle - high) + soft(low - angle)
    }

    pub(super) fn smoothstep<D: Number>(x: D, low: D, high: D) -> D {
        if x.re() <= low.re() {
            return D::from(0.0);
        }
        if x.re() >= high.re() {
            return D::from(1.0);
        }
        // The step is odd about its middle.
        let s = (x - (low + high) / 2.0) / (high - low);
        s * 1.5 - s.powi(3) * 2.0 + 0.5
    }

    pub(super) fn saturated<D: Number>(x: D, most: D) -> D {
        (x / most).tanh() * most
    }

    pub(super) fn barrier<D: Number>(p: D, h: D, pitch: [D; 2], heading: [D; 2]) -> D {
        let one = |x: D, [low, high]: [D; 2]| (x - low).ln() + (high - x).ln();
        -(one(p, pitch) + one(h, heading))
    }

    pub(super) fn displacement<D: Number>(angles: [D; 4], stiffness: [D; 4]) -> D {
        let squares = angles.into_iter().zip(stiffness).map(|(angle, stiffness)| angle.powi(2) * stiffness);
        squares.sum::<D>().sqrt()
    }

    pub(super) fn heading_error<D: Number>(heading: D, [x, y]: [D; 2]) -> D {
        use std::f64::consts::{FRAC_PI_2, TAU};
        let off = heading - y.atan2(x);
        let turns = (off.re() / TAU).round();
        let size = (off - turns * TAU).powi(2).sqrt();
        if size.re() < FRAC_PI_2 {
            size.powi(2) / 2.0
        } else if size.re() <= 3.0 {
            (size - FRAC_PI_2) * size
        } else {
            D::from(4.0)
        }
    }
}

#[test]
fn cone_limit() {
    let sample = |r: &mut Random| [r.numbers(2, -2.0..2.0), r.vector(0.9..1.1), r.numbers(1, 0.0..0.9)].concat();
    // Keep away from the cone itself, where the second derivative jumps.
    let keep = |x: &[f64]| {
        let forward = [x[0].cos() * x[1].sin(), x[0].sin(), x[0].cos() * x[1].cos()];
        (forward[0] * x[2] + forward[1] * x[3] + forward[2] * x[4] - x[5]).abs() > 0.01
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::cone,
        double::cone_gradient,
        single::cone_gradient,
        dual::cone,
    );
    // Along the axis, on the cone, and opposite to the axis, where the cost is greatest.
    for (p, cosine) in [(0.0, 0.5), (0.0, 1.0), (std::f64::consts::PI, 0.5)] {
        let point = [p, 0.0, 0.0, 0.0, 1.0, cosine];
        singular(&point, double::cone, double::cone_gradient, single::cone_gradient, &[0.0, 0.0]);
    }
}

#[test]
fn angle_beyond_a_limit() {
    let sample = |r: &mut Random| [r.vector(0.5..2.0), r.vector(0.5..2.0), r.numbers(1, 0.3..1.5)].concat();
    let keep = |x: &[f64]| {
        let angle = aim::glam::DVec3::from_slice(x).angle_between(aim::glam::DVec3::from_slice(&x[3..]));
        (angle - x[6]).abs() > 0.02 && angle < 3.0
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::beyond,
        double::beyond_gradient,
        single::beyond_gradient,
        dual::beyond,
    );
    // Along the axis and opposite to it the angle has no derivative; it is taken as 0.
    for z in [1.0, -1.0] {
        let point = [0.0, 0.0, z, 0.0, 0.0, 1.0, 0.5];
        singular(&point, double::beyond, double::beyond_gradient, single::beyond_gradient, &[0.0; 3]);
    }
    // On the limit the derivative is that of `max`, which takes its receiver if both are equal.
    let edge = [0.0, 1.0, 0.0, 0.0, 0.0, 1.0, std::f64::consts::FRAC_PI_2];
    singular(&edge, double::beyond, double::beyond_gradient, single::beyond_gradient, &[0.0, 0.0, -1.0]);
}

#[test]
fn soft_limits() {
    let sample = |r: &mut Random| {
        let (angle, low, high) = (r.within(-2.0..2.0), r.within(-1.0..-0.2), r.within(0.2..1.0));
        vec![angle, low, high, r.within(0.5..6.0)]
    };
    At(sample).check(double::softplus, double::softplus_gradient, single::softplus_gradient, dual::softplus::<Dual64>);
    // At a range's end half of the slope remains; far away the other side vanishes, and nothing overflows.
    let away = 1.0 / (1.0 + 40.0_f64.exp());
    for (angle, above, below) in [(1.0, 0.5, away), (-1.0, away, 0.5), (1e4, 1.0, 0.0), (-1e4, 0.0, 1.0)] {
        let point = [angle, -1.0, 1.0, 20.0];
        let expected = [above - below, below, -above];
        singular(&point, double::softplus, double::softplus_gradient, single::softplus_gradient, &expected);
    }
}

#[test]
fn smooth_step() {
    let sample = |r: &mut Random| vec![r.within(-1.5..1.5), r.within(-1.0..-0.2), r.within(0.2..1.0)];
    let keep = |x: &[f64]| (x[0] - x[1]).abs() > 0.01 && (x[0] - x[2]).abs() > 0.01;
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::smoothstep,
        double::smoothstep_gradient,
        single::smoothstep_gradient,
        dual::smoothstep::<Dual64>,
    );
    // The step is flat at its ends and beyond.
    for x in [-3.0, -1.0, 2.0, 3.0] {
        let point = [x, -1.0, 2.0];
        singular(&point, double::smoothstep, double::smoothstep_gradient, single::smoothstep_gradient, &[0.0; 3]);
    }
}

#[test]
fn saturated_angle() {
    let sample = |r: &mut Random| r.until(|r| vec![r.within(-4.0..4.0), r.within(0.5..2.0)], |x| x[0].abs() > 0.01);
    At(sample).check(
        double::saturated,
        double::saturated_gradient,
        single::saturated_gradient,
        dual::saturated::<Dual64>,
    );
    // In the middle, where both branches agree, and far out, where the slope vanishes.
    for (x, expected) in [(0.0, [1.0, 0.0]), (1e4, [0.0, 1.0]), (-1e4, [0.0, -1.0])] {
        let point = [x, 1.0];
        singular(&point, double::saturated, double::saturated_gradient, single::saturated_gradient, &expected);
    }
}

/// Directly behind, the angle of 0 is π and that of −0 is −π. A difference of equal numbers is 0, in whichever order
/// the derivatives compute it.
#[test]
fn what_is_right_behind_is_on_the_side_that_is_written() {
    for gradient in [double::left_gradient, double::right_gradient, double::wide_gradient] {
        assert_eq!(gradient(1.5, 1.5, -2.0).0, std::f64::consts::PI);
    }
    for gradient in [single::left_gradient, single::right_gradient, single::wide_gradient] {
        assert_eq!(gradient(1.5, 1.5, -2.0).0, std::f32::consts::PI);
    }
}

#[test]
fn log_barrier() {
    let sample = |r: &mut Random| [r.numbers(2, -0.9..0.9), vec![-1.0, 1.1, -1.2, 1.0]].concat();
    At(sample).check(double::barrier, double::barrier_gradient, single::barrier_gradient, dual::barrier::<Dual64>);
    At(sample).check_second(
        double::barrier_gradient,
        double::barrier_hessian,
        single::barrier_hessian,
        dual::barrier::<HyperDual64>,
    );
}

#[test]
fn stiffness_weighted_displacement() {
    let sample = |r: &mut Random| [r.numbers(4, -1.0..1.0), r.numbers(4, 0.5..4.0)].concat();
    At(|r: &mut Random| r.until(sample, |x| x[..4].iter().any(|x| x.abs() > 0.2))).check(
        double::displacement,
        double::displacement_gradient,
        single::displacement_gradient,
        dual::displacement::<Dual64>,
    );
    let rest = [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0, 4.0];
    singular(&rest, double::displacement, double::displacement_gradient, single::displacement_gradient, &[0.0; 4]);
}

#[test]
fn wrapped_heading_error() {
    let sample = |r: &mut Random| vec![r.within(-7.0..7.0), r.within(-2.0..2.0), r.within(-2.0..2.0)];
    let keep = |x: &[f64]| {
        let off = x[0] - x[2].atan2(x[1]);
        let size = off.sin().atan2(off.cos()).abs();
        // Keep away from the place itself, from both kinks, and from directly behind.
        let edges = [0.0, std::f64::consts::FRAC_PI_2, 3.0, std::f64::consts::PI];
        x[1].hypot(x[2]) > 0.3 && edges.iter().all(|edge| (size - edge).abs() > 0.015)
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::heading_error,
        double::heading_error_gradient,
        single::heading_error_gradient,
        dual::heading_error::<Dual64>,
    );
    // With the right heading, and at the place itself, which has no heading.
    for point in [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0]] {
        singular(
            &point,
            double::heading_error,
            double::heading_error_gradient,
            single::heading_error_gradient,
            &[0.0; 3],
        );
    }
}
