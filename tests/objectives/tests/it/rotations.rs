//! Differences between orientations, and rotations about variable axes.

use aim_objectives::{At, Random, singular};

macro_rules! objectives {
    ($real:ident, $vec3:ident, $quat:ident, $mat3:ident) => {
        use aim::differentiate;
        use aim::glam::{$mat3, $quat, $vec3};

        /// The rotation from one orientation to another as axis times angle: the quaternion's logarithm.
        #[differentiate(wrt(q), budget = 137)]
        pub(super) fn logarithm(q: $quat, goal: $quat) -> $vec3 {
            let between = q * goal.conjugate();
            let v = between.xyz();
            2.0 * v.length().atan2(between.w) * v.normalize_or_zero()
        }

        /// The angle between two bones.
        #[differentiate(wrt(a, b), budget = 53)]
        pub(super) fn between(a: $vec3, b: $vec3) -> $real {
            a.normalize().dot(b.normalize()).clamp(-1.0, 1.0).acos()
        }

        /// The squared distance of a point from its goal after a rotation about a variable axis.
        #[differentiate(wrt(axis, angle), budget = 139)]
        pub(super) fn hinge(axis: $vec3, angle: $real, point: $vec3, goal: $vec3) -> $real {
            let turn = $quat::from_axis_angle(axis.normalize(), angle);
            (turn * point).distance_squared(goal)
        }

        /// The squared distance of a point from its goal after a rotation by a rotation vector, linearised for small
        /// angles.
        #[differentiate(wrt(turn), budget = 165)]
        pub(super) fn rotation_vector(turn: $vec3, point: $vec3, goal: $vec3) -> $real {
            let square = turn.length_squared();
            let turned = if square < 1e-6 {
                point + turn.cross(point)
            } else {
                let angle = square.sqrt();
                let axis = turn / angle;
                let along = axis * axis.dot(point);
                along + (point - along) * angle.cos() + axis.cross(point) * angle.sin()
            };
            turned.distance_squared(goal)
        }

        /// The cost of a matrix that takes a point to its goal and should be nearly a rotation.
        #[differentiate(wrt(m), budget = 199)]
        pub(super) fn fitted(m: $mat3, point: $vec3, goal: $vec3) -> $real {
            let off = m.transpose() * m - $mat3::IDENTITY;
            let stretch = off.x_axis.length_squared() + off.y_axis.length_squared() + off.z_axis.length_squared();
            (m * point - goal).length_squared() + 0.5 * stretch + 0.1 * (m.determinant() - 1.0).powi(2)
        }
    };
}

mod single {
    objectives!(f32, Vec3, Quat, Mat3);
}

mod double {
    objectives!(f64, DVec3, DQuat, DMat3);
}

/// The same functions by other formulas, with dual numbers.
mod dual {
    use aim_objectives::dual::{Number, Quaternion, Vector};

    pub(super) fn logarithm<D: Number>(q: Quaternion<D>, goal: Quaternion<D>) -> Vector<D> {
        let ([x, y, z, w], [a, b, c, d]) = (q.0, goal.0);
        // q goal*, written out.
        let v = Vector([x * d - w * a - y * c + z * b, y * d - w * b - z * a + x * c, z * d - w * c - x * b + y * a]);
        let along = w * d + x * a + y * b + z * c;
        let whole = (v.dot(v) + along.powi(2)).sqrt();
        v.unit().times((along / whole).acos() * 2.0)
    }

    /// By the sides of a triangle with two sides of length 1.
    pub(super) fn between<D: Number>(a: Vector<D>, b: Vector<D>) -> D {
        let (a, b) = (a.unit(), b.unit());
        (a - b).length().atan2((a + b).length()) * 2.0
    }

    pub(super) fn hinge<D: Number>(axis: Vector<D>, angle: D, point: Vector<D>, goal: Vector<D>) -> D {
        let off = point.about_axis(axis.unit(), angle) - goal;
        off.dot(off)
    }

    pub(super) fn rotation_vector<D: Number>(turn: Vector<D>, point: Vector<D>, goal: Vector<D>) -> D {
        hinge(turn, turn.length(), point, goal)
    }

    pub(super) fn fitted<D: Number>(m: [[D; 3]; 3], point: Vector<D>, goal: Vector<D>) -> D {
        let columns = m.map(Vector);
        let image = columns[0].times(point.0[0]) + columns[1].times(point.0[1]) + columns[2].times(point.0[2]);
        let off = goal - image;
        let mut stretch = D::from(0.0);
        for (i, v) in columns.into_iter().enumerate() {
            for (k, w) in columns.into_iter().enumerate() {
                stretch += (v.dot(w) - f64::from(i == k)).powi(2);
            }
        }
        let volume = columns[0].dot(columns[1].cross(columns[2]));
        off.dot(off) + stretch / 2.0 + (volume - 1.0).powi(2) / 10.0
    }
}

#[test]
fn orientation_error() {
    let sample = |r: &mut Random| [r.quaternion(0.5..2.0), r.quaternion(0.9..1.1)].concat();
    // Keep away from the identity and from a whole turn.
    let keep = |x: &[f64]| {
        let v = aim::glam::DQuat::from_slice(x) * aim::glam::DQuat::from_slice(&x[4..]).conjugate();
        v.xyz().length() > 0.2
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::logarithm,
        double::logarithm_jacobian,
        single::logarithm_jacobian,
        dual::logarithm,
    );
    // At the identity the derivative is twice that of the vector part of q goal* by q, component by component, since
    // the logarithm is twice the vector part to first order. A whole turn has no direction, and its derivatives are 0.
    let goal = [0.5, -0.5, 0.5, 0.5];
    let [x, y, z, w] = goal;
    let by_vector_part = [w, z, -y, -z, w, x, y, -x, w, -x, -y, -z].map(|c| 2.0 * c);
    for (sign, expected) in [(1.0, by_vector_part), (-1.0, [0.0; 12])] {
        let there = [goal.map(|x| sign * x), goal].concat();
        singular(&there, double::logarithm, double::logarithm_jacobian, single::logarithm_jacobian, &expected);
    }
}

#[test]
fn angle_between_bones() {
    let sample = |r: &mut Random| [r.vector(0.5..2.0), r.vector(0.5..2.0)].concat();
    let keep = |x: &[f64]| {
        let angle = aim::glam::DVec3::from_slice(x).angle_between(aim::glam::DVec3::from_slice(&x[3..]));
        (0.2..2.9).contains(&angle)
    };
    At(|r: &mut Random| r.until(sample, keep)).check(
        double::between,
        double::between_gradient,
        single::between_gradient,
        dual::between,
    );
    // For parallel and opposite vectors the angle has a kink: the derivative is 0.
    for b in [[2.0, 0.0, 0.0], [-2.0, 0.0, 0.0]] {
        let point = [&[3.0, 0.0, 0.0][..], &b].concat();
        singular(&point, double::between, double::between_gradient, single::between_gradient, &[0.0; 6]);
    }
}

#[test]
fn turn_about_a_variable_axis() {
    let sample =
        |r: &mut Random| [r.vector(0.5..2.0), r.numbers(1, -3.0..3.0), r.vector(0.0..2.0), r.vector(0.0..2.0)].concat();
    At(sample).check(double::hinge, double::hinge_gradient, single::hinge_gradient, dual::hinge);
    // With angle 0 the axis does not matter; with the point on the axis the angle does not.
    let still = [0.0, 0.0, 2.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    singular(&still, double::hinge, double::hinge_gradient, single::hinge_gradient, &[0.0; 4]);
    let on_axis = [0.0, 0.0, 2.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0];
    singular(&on_axis, double::hinge, double::hinge_gradient, single::hinge_gradient, &[0.0; 4]);
}

#[test]
fn turn_by_a_rotation_vector() {
    let sample = |r: &mut Random| [r.vector(0.1..3.0), r.vector(0.0..2.0), r.vector(0.0..2.0)].concat();
    At(sample).check(
        double::rotation_vector,
        double::rotation_vector_gradient,
        single::rotation_vector_gradient,
        dual::rotation_vector,
    );
    // Unrotated: 2 (point × (point − goal)), by the branch for small angles.
    let none = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 3.0];
    singular(
        &none,
        double::rotation_vector,
        double::rotation_vector_gradient,
        single::rotation_vector_gradient,
        &[0.0, 6.0, -4.0],
    );
}

#[test]
fn matrix_fitted_to_a_rotation() {
    let sample = |r: &mut Random| [r.numbers(9, -1.0..1.0), r.vector(0.0..2.0), r.vector(0.0..2.0)].concat();
    At(sample).check(double::fitted, double::fitted_gradient, single::fitted_gradient, dual::fitted);
    let identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let there = [&identity[..], &[1.0, 2.0, 3.0, 1.0, 2.0, 3.0]].concat();
    singular(&there, double::fitted, double::fitted_gradient, single::fitted_gradient, &[0.0; 9]);
}

#[aim::differentiate(check = true)]
mod arcs {
    use aim::glam::{DMat4, DQuat, DVec2, DVec3};

    #[differentiate(wrt(from, to))]
    pub(super) fn arc(from: DVec3, to: DVec3, v: DVec3) -> DVec3 {
        DQuat::from_rotation_arc(from.normalize(), to.normalize()) * v
    }

    #[differentiate(wrt(from, to))]
    pub(super) fn arc_of_lines(from: DVec3, to: DVec3, v: DVec3) -> DVec3 {
        DQuat::from_rotation_arc_colinear(from.normalize(), to.normalize()) * v
    }

    #[differentiate(wrt(v, angle))]
    pub(super) fn bases(v: DVec3, angle: f64) -> DVec3 {
        let (axis, length) = v.normalize_and_length();
        let (x, y) = axis.any_orthonormal_pair();
        let turned = x.rotate_axis(axis, angle) + y * length + axis.any_orthonormal_vector() * angle;
        turned + 0.1 * v.any_orthogonal_vector()
    }

    #[differentiate(wrt(v, w))]
    pub(super) fn by_component(v: DVec3, w: DVec2) -> DVec3 {
        let (sin, cos) = v.sin_cos();
        let (unit, size) = w.normalize_and_length();
        let more = (w.exp2() + w.cos() * w.saturate() + DVec2::splat(0.25).step(w) * unit * size).extend(w.sin().x);
        sin * v.saturate()
            + cos.exp2()
            + (cos * cos + 0.5).log2()
            + (sin * sin + 1.0).sqrt()
            + (v * v + 1.0).ln()
            + more
    }

    #[differentiate(wrt(angle, v))]
    #[allow(deprecated, reason = "older versions of glam have no other function")]
    pub(super) fn seen(angle: f64, v: DVec3) -> DVec3 {
        let open = DMat4::perspective_infinite_rh(0.4 + angle * angle, 1.5, 0.1).project_point3(v - 9.0);
        open + DMat4::perspective_infinite_lh(0.4 + angle * angle, 1.5, 0.1).project_point3(v + 9.0)
    }
}

/// Values are glam's, also where the directions are the same.
#[test]
fn the_shortest_arc_is_that_of_glam() {
    use aim::glam::{DMat3, DVec3};

    let (one, other, v) = (DVec3::new(0.5, -1.0, 2.0), DVec3::new(-1.0, 0.3, 0.2), DVec3::new(0.7, 0.1, -0.4));
    for to in [one, 3.0 * one, other, -other] {
        let (value, (by_from, by_to)) = arcs::arc_jacobian(one, to, v);
        assert!(value.distance(arcs::arc(one, to, v)) < 1e-14, "{to}");
        let size = |m: DMat3| m.to_cols_array().into_iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        assert!(size(by_from) + size(by_to) < 10.0, "{to}: {by_from}, {by_to}");
    }
    let (value, _) = arcs::arc_of_lines_jacobian(one, other, v);
    assert!(value.distance(arcs::arc_of_lines(one, other, v)) < 1e-14);
    let (value, _) = arcs::seen_jacobian(0.3, v);
    assert!(value.distance(arcs::seen(0.3, v)) < 1e-13);
    // Opposite directions have no shortest arc.
    assert_eq!(arcs::arc_jacobian(one, -one, v), (v, (DMat3::ZERO, DMat3::ZERO)));
}

/// Axes among the arguments have length 1, also at the points of `check`.
#[allow(dead_code, reason = "the check calls it")]
mod axes {
    use aim::differentiate;
    use aim::glam::{DMat3, DQuat, DVec3};

    #[differentiate(check = true)]
    mod hinges {
        use super::{DMat3, DQuat, DVec3};

        pub(super) struct Hinge {
            pub(super) at: DVec3,
            pub(super) axis: DVec3,
        }

        #[differentiate(wrt(angles, p))]
        pub(super) fn turned(angles: [f64; 3], p: DVec3, hinge: Hinge, (open, axes): (bool, [DVec3; 2])) -> DVec3 {
            let q = DQuat::from_axis_angle(hinge.axis, angles[0]) * (p - hinge.at) + hinge.at;
            let q = if open { q.rotate_axis(axes[0], angles[1]) } else { q };
            DMat3::from_axis_angle(axes[1], angles[2]) * q
        }
    }
}
