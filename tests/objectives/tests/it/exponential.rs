//! The exponential and the logarithm of rotations in their usual forms, at the identity and near it.

use core::f64::consts::PI;

use aim::glam::{DMat3, DQuat, DVec3, Mat3, Quat, Vec3};

macro_rules! objectives {
    ($real:ident, $vec3:ident, $vec4:ident, $quat:ident, $mat3:ident) => {
        use aim::differentiate;
        use aim::glam::{$mat3, $quat, $vec3, $vec4};

        /// The rotation by axis and angle.
        #[differentiate(wrt(w))]
        pub(super) fn by_axis(w: $vec3, p: $vec3) -> $vec3 {
            $quat::from_axis_angle(w.normalize_or_zero(), w.length()) * p
        }

        /// The rotation by the constructor.
        #[differentiate(wrt(w))]
        pub(super) fn by_vector(w: $vec3, p: $vec3) -> $vec3 {
            $quat::from_scaled_axis(w) * p
        }

        /// Rodrigues' formula with an axis.
        #[differentiate(wrt(w))]
        pub(super) fn rodrigues(w: $vec3, p: $vec3) -> $vec3 {
            let angle = w.length();
            let axis = w.normalize_or_zero();
            p * angle.cos() + axis.cross(p) * angle.sin() + axis * (axis.dot(p) * (1.0 - angle.cos()))
        }

        /// Rodrigues' formula with quotients and nested cross products.
        #[differentiate(wrt(w))]
        pub(super) fn quotients(w: $vec3, p: $vec3) -> $vec3 {
            let angle = w.length();
            let once = w.cross(p);
            p + once * (angle.sin() / angle) + w.cross(once) * ((1.0 - angle.cos()) / (angle * angle))
        }

        /// The quaternion rotation written out with the half angle.
        #[differentiate(wrt(w))]
        pub(super) fn by_half(w: $vec3, p: $vec3) -> $vec3 {
            let angle = w.dot(w).sqrt();
            let v = w * ((0.5 * angle).sin() / angle);
            let twice = 2.0 * v.cross(p);
            p + (0.5 * angle).cos() * twice + v.cross(twice)
        }

        /// A squared distance, whose second derivatives have limits too.
        #[differentiate(wrt(w), hessian)]
        pub(super) fn distance(w: $vec3, p: $vec3, goal: $vec3) -> $real {
            ($quat::from_axis_angle(w.normalize_or_zero(), w.length()) * p).distance_squared(goal)
        }

        #[differentiate(wrt(q))]
        pub(super) fn scaled_axis(q: $quat) -> $vec3 {
            q.to_scaled_axis()
        }

        #[differentiate(wrt(q))]
        pub(super) fn axis_times_angle(q: $quat) -> $vec3 {
            let (axis, angle) = q.to_axis_angle();
            axis * angle
        }

        #[differentiate(wrt(q))]
        pub(super) fn arc_tangent(q: $quat) -> $vec3 {
            let v = q.xyz();
            2.0 * v.length().atan2(q.w) * v.normalize_or_zero()
        }

        /// A length times a direction, which is the vector itself.
        #[differentiate(wrt(v))]
        pub(super) fn itself(v: $vec3) -> $vec3 {
            v.length() * v.normalize_or_zero()
        }

        /// A vector whose length is compressed by tanh.
        #[differentiate(wrt(v))]
        pub(super) fn shortened(v: $vec3) -> $vec3 {
            v.length().tanh() * v.normalize_or_zero()
        }

        /// The logarithm of the exponential: the identity.
        #[differentiate(wrt(w))]
        pub(super) fn there_and_back(w: $vec3) -> $vec3 {
            $quat::from_scaled_axis(w).to_scaled_axis()
        }

        /// The same through a matrix.
        #[differentiate(wrt(w))]
        pub(super) fn by_matrix(w: $vec3) -> $vec3 {
            $quat::from_mat3(&$mat3::from_quat($quat::from_scaled_axis(w))).to_scaled_axis()
        }

        /// The logarithm of a rotation matrix.
        #[differentiate(wrt(tangent(m)), check = true)]
        pub(super) fn logarithm(m: $mat3) -> $vec3 {
            $quat::from_mat3(&m).to_scaled_axis()
        }

        /// The components of the quaternion of any matrix.
        #[differentiate(wrt(m), check = true)]
        pub(super) fn components(m: $mat3) -> [$real; 4] {
            $quat::from_mat3(&m).to_array()
        }

        /// The quaternion of a matrix in a product, and as a vector.
        #[differentiate(wrt(tangent(m), q), check = true)]
        pub(super) fn of_product(m: $mat3, q: $quat) -> $vec4 {
            let product = $quat::from_mat3(&m) * $quat::from_vec4($vec4::from(q));
            $vec4::from(product.lerp(q, 0.25))
        }
    };
}

mod single {
    objectives!(f32, Vec3, Vec4, Quat, Mat3);
}

mod double {
    use aim::glam::DAffine3;

    objectives!(f64, DVec3, DVec4, DQuat, DMat3);

    /// The logarithm of the motion from one transform to another.
    #[differentiate(wrt(tangent(a), tangent(b)), check = true)]
    pub(super) fn between(a: DAffine3, b: DAffine3) -> [DVec3; 2] {
        let motion = a.inverse() * b;
        [DQuat::from_affine3(&motion).to_scaled_axis(), motion.translation]
    }
}

/// Returns the matrix [v]× of the cross product with v.
fn crossed(v: DVec3) -> DMat3 {
    DMat3::from_cols(DVec3::new(0.0, v.z, -v.y), DVec3::new(-v.z, 0.0, v.x), DVec3::new(v.y, -v.x, 0.0))
}

/// Returns R p and ∂(R p)/∂w = −R [p]× J by series, with R = Σ [w]×ᵏ/k! and the right Jacobian J = Σ (−[w]×)ᵏ/(k + 1)!.
fn by_series(w: DVec3, p: DVec3) -> (DVec3, DMat3) {
    let (mut rotation, mut jacobian) = (DMat3::ZERO, DMat3::ZERO);
    let (mut power, mut power_back, mut factorial) = (DMat3::IDENTITY, DMat3::IDENTITY, 1.0);
    for k in 0..30 {
        rotation += power * (1.0 / factorial);
        factorial *= f64::from(k + 1);
        jacobian += power_back * (1.0 / factorial);
        power *= crossed(w);
        power_back *= crossed(-w);
    }
    (rotation * p, rotation * crossed(p) * jacobian * -1.0)
}

#[track_caller]
fn near(what: &str, angle: f64, found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    let worst = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, |worst: f64, error| {
        // NaN is an error too.
        if error <= worst { worst } else { error }
    });
    assert!(worst <= tolerance, "{what} at {angle:e}: {worst:e}\nfound    {found:?}\nexpected {expected:?}");
}

fn numbers(value: DVec3, jacobian: DMat3) -> Vec<f64> {
    [&value.to_array()[..], &jacobian.to_cols_array()].concat()
}

const ANGLES: [f64; 13] = [0.0, 1e-200, 1e-20, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 0.1, 0.9999, 1.0001, 2.5, 3.1];

fn direction() -> DVec3 {
    DVec3::new(2.0, -1.0, 2.0) / 3.0
}

#[test]
fn the_exponential_has_its_derivative_at_no_turn_and_beside_it() {
    type Jacobian<V, M> = fn(V, V) -> (V, (M,));
    type Form = (&'static str, Jacobian<DVec3, DMat3>, Jacobian<Vec3, Mat3>);
    let forms: [Form; 5] = [
        ("by_axis", double::by_axis_jacobian, single::by_axis_jacobian),
        ("by_vector", double::by_vector_jacobian, single::by_vector_jacobian),
        ("rodrigues", double::rodrigues_jacobian, single::rodrigues_jacobian),
        ("quotients", double::quotients_jacobian, single::quotients_jacobian),
        ("by_half", double::by_half_jacobian, single::by_half_jacobian),
    ];
    let p = DVec3::new(0.3, -0.7, 0.5);
    for angle in ANGLES {
        let w = angle * direction();
        let (value, jacobian) = by_series(w, p);
        let expected = numbers(value, jacobian);
        for (name, double, single) in forms {
            let (value, (jacobian,)) = double(w, p);
            near(name, angle, &numbers(value, jacobian), &expected, 1e-12);
            let (value, (jacobian,)) = single(w.as_vec3(), p.as_vec3());
            near(name, angle, &numbers(value.as_dvec3(), jacobian.as_dmat3()), &expected, 1e-5);
        }
    }
}

#[test]
fn second_derivatives_of_a_turned_distance_are_those_of_the_series() {
    let (p, goal) = (DVec3::new(0.3, -0.7, 0.5), DVec3::new(-0.2, 0.4, 0.9));
    for angle in ANGLES {
        let w = angle * direction();
        // The gradient of |R p − g|² is −2 g · ∂(R p); its differences are taken here.
        let gradient = |w: DVec3| by_series(w, p).1.transpose() * goal * -2.0;
        let by_differences = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| {
            let step = 1e-3;
            let at = |k: f64| gradient(w + axis * (k * step));
            ((at(1.0) - at(-1.0)) * 45.0 - (at(2.0) - at(-2.0)) * 9.0 + (at(3.0) - at(-3.0))) / (60.0 * step)
        });
        let expected: Vec<f64> = by_differences.iter().flat_map(|column| column.to_array()).collect();
        let (_, (slope,), hessian) = double::distance_hessian(w, p, goal);
        near("slope", angle, &slope.to_array(), &gradient(w).to_array(), 1e-12);
        near("curvature", angle, &hessian.concat(), &expected, 1e-9);
        let (_, _, hessian) = single::distance_hessian(w.as_vec3(), p.as_vec3(), goal.as_vec3());
        let hessian: Vec<f64> = hessian.concat().into_iter().map(f64::from).collect();
        near("curvature", angle, &hessian, &expected, 1e-5);
    }
}

/// Returns the derivative of 2 atan2(|v|, w)/|v| v by x, y, z and w of a unit quaternion that rotates by `angle`. For
/// small angles it is a series in the sine s = |v|: asin s / s = 1 + s²/6 + ….
fn logarithm_by_series(angle: f64, direction: DVec3) -> Vec<f64> {
    let (half, cos) = ((0.5 * angle).sin(), (0.5 * angle).cos());
    let v = half * direction;
    // With r = |v|, f = atan2(r, w)/r: ∂f/∂r /r = (w − f)/r² on the unit sphere, and ∂f/∂w = −1.
    let s = half * half;
    let (f, slope) = if angle < 0.1 {
        let terms = [1.0, 1.0 / 6.0, 3.0 / 40.0, 15.0 / 336.0, 105.0 / 3456.0, 945.0 / 42240.0];
        let f: f64 = terms.iter().rev().fold(0.0, |sum, c| sum * s + c);
        // cos = 1 − s/2 − s²/8 − s³/16 − 5 s⁴/128 − …
        let rest = [-2.0 / 3.0, -0.2, -3.0 / 28.0, -0.069_444_444_444_444_44, -0.049_715_909_090_909_09];
        (f, rest.iter().rev().fold(0.0, |sum, c| sum * s + c))
    } else {
        let f = 0.5 * angle / half;
        (f, (cos - f) / s)
    };
    let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| 2.0 * (f * axis + slope * v.dot(axis) * v));
    let value = 2.0 * f * v;
    [value, columns[0], columns[1], columns[2], -2.0 * v].iter().flat_map(|v| v.to_array()).collect()
}

#[test]
fn the_logarithm_has_its_derivative_at_the_identity_and_beside_it() {
    type Jacobian<V, Q> = fn(Q) -> (V, ([V; 4],));
    type Form = (&'static str, Jacobian<DVec3, DQuat>, Jacobian<Vec3, Quat>);
    let forms: [Form; 3] = [
        ("scaled_axis", double::scaled_axis_jacobian, single::scaled_axis_jacobian),
        ("axis_times_angle", double::axis_times_angle_jacobian, single::axis_times_angle_jacobian),
        ("arc_tangent", double::arc_tangent_jacobian, single::arc_tangent_jacobian),
    ];
    for angle in ANGLES {
        let q = DQuat::from_axis_angle(direction(), angle);
        let expected = logarithm_by_series(angle, direction());
        for (name, double, single) in forms {
            let (value, (columns,)) = double(q);
            let found: Vec<f64> = [value].into_iter().chain(columns).flat_map(|v| v.to_array()).collect();
            near(name, angle, &found, &expected, 1e-12);
            let (value, (columns,)) = single(q.as_quat());
            let found: Vec<f64> = [value].into_iter().chain(columns).flat_map(|v| v.as_dvec3().to_array()).collect();
            near(name, angle, &found, &expected, 2e-5);
        }
    }
}

#[test]
fn products_of_a_length_and_a_direction_have_the_vectors_derivative() {
    for v in [DVec3::ZERO, 1e-9 * direction(), direction()] {
        let (value, (jacobian,)) = double::itself_jacobian(v);
        near("itself", v.length(), &numbers(value, jacobian), &numbers(v, DMat3::IDENTITY), 1e-12);
    }
    let (value, (jacobian,)) = double::shortened_jacobian(DVec3::ZERO);
    near("shortened", 0.0, &numbers(value, jacobian), &numbers(DVec3::ZERO, DMat3::IDENTITY), 1e-12);
    for angle in &ANGLES[..12] {
        let w = *angle * direction();
        let (value, (jacobian,)) = double::there_and_back_jacobian(w);
        near("there and back", *angle, &numbers(value, jacobian), &numbers(w, DMat3::IDENTITY), 1e-12);
        let (value, (jacobian,)) = single::there_and_back_jacobian(w.as_vec3());
        near(
            "there and back",
            *angle,
            &numbers(value.as_dvec3(), jacobian.as_dmat3()),
            &numbers(w, DMat3::IDENTITY),
            1e-5,
        );
    }
}

#[test]
fn the_logarithm_of_a_matrix_is_that_of_its_quaternion() {
    // Every component of the quaternion is the largest in one of them.
    let directions = [DVec3::new(6.0, -2.0, 3.0), DVec3::new(-2.0, 6.0, 3.0), DVec3::new(-2.0, 3.0, 6.0)];
    for (angle, direction) in ANGLES.into_iter().flat_map(|angle| directions.map(|direction| (angle, direction / 7.0)))
    {
        let w = angle * direction;
        let (value, (jacobian,)) = double::by_matrix_jacobian(w);
        near("by matrix", angle, &numbers(value, jacobian), &numbers(w, DMat3::IDENTITY), 1e-12);
        let (value, (jacobian,)) = single::by_matrix_jacobian(w.as_vec3());
        let found = numbers(value.as_dvec3(), jacobian.as_dmat3());
        near("by matrix", angle, &found, &numbers(w, DMat3::IDENTITY), 1e-5);
    }
    // In a rotation's own frame, ω changes the logarithm φ by ω + φ × ω / 2 + …, of which the last remains for half a turn.
    for direction in directions.map(|direction| direction / 7.0) {
        let w = PI * direction;
        let (value, (jacobian,)) = double::logarithm_jacobian(DMat3::from_quat(DQuat::from_scaled_axis(w)));
        let along = DMat3::from_cols(direction * direction.x, direction * direction.y, direction * direction.z);
        near("half a turn", PI, &numbers(value, jacobian), &numbers(w, along + 0.5 * crossed(w)), 1e-12);
    }
    let (value, (jacobian,)) = double::logarithm_jacobian(DMat3::IDENTITY);
    near("logarithm", 0.0, &numbers(value, jacobian), &numbers(DVec3::ZERO, DMat3::IDENTITY), 0.0);
}
