//! User functions and their derived companions: compared with central differences, and counted.

use aim::glam::{DAffine3, DMat3, DMat4, DQuat, DVec2, DVec3, EulerRot, Mat3, Quat, Vec3, Vec3A};
use aim::{DRigid, Rigid, differentiate};
use aim_tests::random::Random;

/// The paper's aim in six formulations. The result must not depend on the formulation.
mod paper {
    use super::*;

    /// The paper's formulation: the effector is transformed forward.
    #[differentiate(wrt(p, h), budget = 46)]
    pub(super) fn pushed(p: f64, h: f64, m: DRigid, target: DVec3) -> f64 {
        let turned = DAffine3::from_rotation_x(h) * DAffine3::from_rotation_z(p) * m;
        let origin = turned.transform_point3(DVec3::ZERO);
        let tip = turned.transform_point3(DVec3::Y);
        (target - origin).normalize().dot(tip - origin)
    }

    /// The target is pulled back into the effector's frame.
    #[differentiate(wrt(p, h), budget = 46)]
    pub(super) fn pulled(p: f64, h: f64, m: DRigid, target: DVec3) -> f64 {
        let back = DQuat::from_rotation_z(-p) * DQuat::from_rotation_x(-h);
        let d = back * target - m.translation;
        m.transform_vector3(DVec3::Y).dot(d) / d.length()
    }

    /// With quaternions about named axes.
    #[differentiate(wrt(p, h), budget = 46)]
    pub(super) fn quaternions(p: f64, h: f64, m: DRigid, target: DVec3) -> f64 {
        let added = DQuat::from_axis_angle(DVec3::X, h) * DQuat::from_axis_angle(DVec3::Z, p);
        let forward = added * m.matrix3.y_axis;
        let to_target = target - added * m.translation;
        forward.dot(to_target / to_target.length())
    }

    /// With matrices, and a link whose matrix need not be a rotation.
    #[differentiate(wrt(p, h), budget = 46)]
    pub(super) fn matrices(p: f64, h: f64, m: DMat3, t: DVec3, target: DVec3) -> f64 {
        let added = DMat3::from_rotation_x(h) * DMat3::from_rotation_z(p);
        let effector = added * m;
        let to_target = target - added * t;
        let forward = effector * DVec3::Y;
        forward.dot(to_target.normalize())
    }

    /// Heading first: the angles have other names and the other order.
    #[differentiate(wrt(heading, pitch), budget = 46)]
    pub(super) fn heading_first(heading: f64, pitch: f64, m: DRigid, target: DVec3) -> f64 {
        let by_pitch = DQuat::from_rotation_z(pitch);
        let by_heading = DQuat::from_rotation_x(heading);
        let origin = by_heading * (by_pitch * m.translation);
        let forward = by_heading * (by_pitch * (m.matrix3 * DVec3::Y));
        forward.dot((target - origin).normalize())
    }

    /// With other names, another order of terms, and lengths written out.
    #[differentiate(wrt(a, b), budget = 46)]
    pub(super) fn renamed(at: &DVec3, link: &DRigid, b: f64, a: f64) -> f64 {
        let q = DQuat::from_rotation_x(b).mul_quat(DQuat::from_rotation_z(a));
        let w = -(q * link.translation) + *at;
        let u = q.mul_vec3(link.matrix3.y_axis);
        w.dot(u) * w.dot(w).sqrt().recip()
    }
}

/// Returns the sixth-order central difference.
fn difference(f: impl Fn(f64) -> f64, x: f64) -> f64 {
    const H: f64 = 1e-3;
    let at = |k: f64| f(x + k * H) - f(x - k * H);
    (45.0 * at(1.0) - 9.0 * at(2.0) + at(3.0)) / (60.0 * H)
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-9 * (1.0 + expected.abs()), "{found} is not {expected}");
}

fn vector(random: &mut Random) -> DVec3 {
    DVec3::new(random.within(1.5), random.within(1.5), random.within(1.5))
}

fn quaternion(random: &mut Random) -> DQuat {
    DQuat::from_xyzw(random.within(1.0), random.within(1.0), random.within(1.0), 1.2 + random.within(0.5)).normalize()
}

/// Returns `x` with component `k` replaced.
fn moved<const N: usize>(x: [f64; N], k: usize, to: f64) -> [f64; N] {
    core::array::from_fn(|i| if i == k { to } else { x[i] })
}

/// Checks every derivative of a function of numbers.
fn check<const N: usize>(f: impl Fn([f64; N]) -> f64, x: [f64; N], found: [f64; N]) {
    for k in 0..N {
        near(found[k], difference(|to| f(moved(x, k, to)), x[k]));
    }
}

#[test]
fn the_papers_aim_is_46_operations_however_it_is_stated() {
    let mut random = Random::new(3);
    for _ in 0..200 {
        let (p, h) = (random.within(3.0), random.within(3.0));
        let m = DRigid::from_rotation_translation(quaternion(&mut random), vector(&mut random));
        let target = 3.0 * vector(&mut random);
        let (matrix, t) = (m.matrix3, m.translation);
        let (value, expected) = paper::pushed_gradient(p, h, m, target);
        near(value, paper::pushed(p, h, m, target));
        check(|[p, h]| paper::pushed(p, h, m, target), [p, h], expected.into());
        let (heading_first, (by_heading, by_pitch)) = paper::heading_first_gradient(h, p, m, target);
        let (renamed, (by_a, by_b)) = paper::renamed_gradient(&target, &m, h, p);
        for (other, gradient) in [
            paper::pulled_gradient(p, h, m, target),
            paper::quaternions_gradient(p, h, m, target),
            paper::matrices_gradient(p, h, matrix, t, target),
            (heading_first, (by_pitch, by_heading)),
            (renamed, (by_a, by_b)),
        ] {
            near(other, value);
            near(gradient.0, expected.0);
            near(gradient.1, expected.1);
        }
    }
}

/// Every operation on numbers.
#[differentiate(wrt(x, y), hessian)]
fn numbers(x: f64, y: f64) -> f64 {
    const THIRD: f64 = 1.0 / 3.0;
    let (s, c) = (x * 0.5).sin_cos();
    let both = f64::atan2(s, 2.0 + c) + (y - core::f64::consts::FRAC_PI_4).tan().atan();
    let inside = 0.9 * s * y.cos();
    let root = (1.0 + x.powi(2) * y.powi(-2)).sqrt() + x.hypot(y);
    let grown = (inside.asin() - inside.acos()) * (THIRD * x).exp() / (2.0 + y).ln();
    both + root * grown + x.mul_add(y, 2.5).recip() + y.to_degrees().to_radians()
}

/// Branches: the derivative is that of the branch taken.
#[differentiate(wrt(x, y))]
fn choices(x: f64, y: f64, v: DVec3) -> f64 {
    let left = x < -0.5;
    let far = x > 0.5 || (y <= 0.2 && !left);
    let w = if far { v * x } else { v.cross(DVec3::new(y, x, 1.0)) };
    let turn = if far { DQuat::from_rotation_x(x) } else { DQuat::from_rotation_y(y) * DQuat::from_rotation_z(x) };
    let kept = if x == y {
        0.0
    } else if y != 2.0 && x >= -0.9 {
        x.abs() + y.signum() * x.min(y)
    } else {
        x.max(y).clamp(-0.5, 0.5)
    };
    kept * (turn * w).dot(v) + (turn * v).y
}

/// Methods of vectors, differentiated by a vector.
#[differentiate(wrt(v, s), hessian)]
fn vectors(v: DVec3, s: f64, w: &DVec3) -> f64 {
    let along = v.project_onto(*w) - v.reject_from(*w).lerp(*w, s);
    let unit = v.normalize_or_zero();
    let reflected = v.reflect(w.normalize());
    let boxed = v.abs().min(*w).max(DVec3::splat(-0.3)) * *w / DVec3::new(1.0, 2.0, 3.0);
    along.distance(w.cross(v))
        + unit.dot(reflected) * v.length_squared()
        + v.angle_between(*w)
        + boxed.element_sum()
        + (v + 1.0).length_recip()
        + along.distance_squared(v.with_x(s)) * v[1]
}

/// Differentiated by a quaternion, off the unit sphere too: glam's own formula is differentiated.
#[differentiate(wrt(q))]
fn spun(q: DQuat, r: DQuat, v: DVec3) -> f64 {
    let both = r * q * r.conjugate();
    (both * v).dot(v) + (q * v).x + q.inverse().mul_vec3(v).z + q.length_squared() + both.w * q.xyz().dot(v)
}

/// Differentiated by an arbitrary matrix.
#[differentiate(wrt(m))]
fn mixed(m: DMat3, x: f64, v: DVec3) -> f64 {
    let turned = DMat3::from_axis_angle(DVec3::new(0.6, 0.0, -0.8), x) * m * DMat3::from_rotation_y(x);
    let back = m.transpose() * (turned * v);
    back.dot(v) + m.determinant() + (m.inverse() * v).y + (2.0 * m - DMat3::IDENTITY).x_axis.dot(m.col(1))
}

/// A rotation about a variable axis, by both of glam's formulas.
#[differentiate(wrt(axis, x))]
fn about(axis: DVec3, x: f64, v: DVec3) -> f64 {
    let unit = axis.normalize();
    let (q, m) = (DQuat::from_axis_angle(unit, x), DMat3::from_axis_angle(unit, -2.0 * x));
    (q * v).dot(m * v) + q.w + m.z_axis.x
}

/// Rigid transforms and their inverses.
#[differentiate(wrt(x, p))]
fn rigid(x: f64, p: DVec3, m: DAffine3, n: DRigid) -> DVec3 {
    let turn = DAffine3::from_axis_angle(DVec3::NEG_Y, x);
    let both = m * turn * n.inverse();
    let euler = DQuat::from_euler(EulerRot::ZYX, x, 0.3, p.x);
    both.transform_point3(p) + both.inverse().transform_vector3(euler * p) + both.matrix3.y_axis * both.translation.x
}

/// Plane vectors, conversions to and from them, and an array.
#[differentiate(wrt(v, weights, x))]
fn plane(v: DVec2, weights: [f64; 3], x: f64) -> DVec2 {
    let [a, b, c] = weights;
    let turned = DVec2::from_angle(x) * a + v.perp() * b;
    turned.lerp(v.normalize(), c) * v.perp_dot(turned) + v.extend(x).cross(DVec3::X).truncate() * weights[1]
}

/// Vectors of four components, and a normalisation that may fail.
#[differentiate(wrt(v, w))]
fn projected(v: DVec3, w: DVec3, m: DMat4) -> DVec3 {
    let seen = m * v.extend(1.0);
    let way = match w.try_normalize() {
        Some(way) => way,
        None => DVec3::X,
    };
    let four = seen.reject_from(w.extend(v.x)) * seen.max_element() - seen.midpoint(w.extend(2.0));
    let bent = v.normalize().refract(way, 0.7) + v.move_towards(w, 0.3) + v.copysign(w) + v.normalize_or(w);
    bent + four.truncate() * four.min_element() / seen.element_product() + v.exp().rem_euclid(DVec3::splat(0.4))
}

/// Methods of plane vectors, and powers.
#[differentiate(wrt(v, w))]
fn flat(v: DVec2, w: DVec2) -> DVec2 {
    let powers = v.exp().powf(1.3) * w.abs().extend(1.0).powf(0.4).truncate();
    powers * v.recip() * w.signum() + v.copysign(w) * w.element_product() + v.exp().rem_euclid(DVec2::splat(0.4))
}

#[test]
fn methods_of_glam_are_what_they_are_there() {
    let mut random = Random::new(11);
    let mut judged = 0;
    while judged < 60 {
        let [v, w] = [0; 2].map(|_| vector(&mut random));
        let m = DMat4::from_cols_array(&core::array::from_fn(|_| random.within(1.0)));
        let at = [v, w].map(|v| v.to_array()).concat().try_into().expect("six numbers");
        let of = |at: [f64; 6]| (DVec3::from_slice(&at[..3]), DVec3::from_slice(&at[3..]));
        // Keep away from the kinks of the methods.
        let wraps = (v.exp() / 0.4).to_array().into_iter().all(|x| (x - x.round()).abs() > 0.05);
        let (normal, seen) = (w.normalize(), (m * v.extend(1.0)).to_array());
        let bends = 1.0 - 0.49 * (1.0 - normal.dot(v.normalize()).powi(2)) > 0.02;
        let four = (m * v.extend(1.0)).reject_from(w.extend(v.x)) * (m * v.extend(1.0)).max_element()
            - (m * v.extend(1.0)).midpoint(w.extend(2.0));
        let apart = |mut all: [f64; 4]| {
            all.sort_by(f64::total_cmp);
            all.windows(2).all(|pair| pair[1] - pair[0] > 0.02)
        };
        let is_large = v.abs().min(w.abs()).min_element() > 0.1 && seen.iter().all(|x| x.abs() > 0.1);
        if !(wraps && bends && is_large && apart(seen) && apart(four.to_array()) && v.distance(w) > 0.35) {
            continue;
        }
        judged += 1;
        let (value, (by_v, by_w)): (DVec3, (DMat3, DMat3)) = projected_jacobian(v, w, m);
        for k in 0..3 {
            near(value[k], projected(v, w, m)[k]);
            let slopes = [by_v.row(k).to_array(), by_w.row(k).to_array()].concat().try_into().expect("six numbers");
            check(|at| projected(of(at).0, of(at).1, m)[k], at, slopes);
        }
        let (v, w) = (v.truncate(), w.truncate());
        let (value, (by_v, by_w)) = flat_jacobian(v, w);
        for k in 0..2 {
            near(value[k], flat(v, w)[k]);
            let of = |[a, b, c, d]: [f64; 4]| flat(DVec2::new(a, b), DVec2::new(c, d))[k];
            check(of, [v.x, v.y, w.x, w.y], [by_v[0][k], by_v[1][k], by_w[0][k], by_w[1][k]]);
        }
    }
}

#[test]
fn numbers_and_choices() {
    let mut random = Random::new(5);
    for _ in 0..200 {
        let (x, y) = (random.within(1.0), 0.2 + random.within(1.0).abs());
        let (value, gradient) = numbers_gradient(x, y);
        near(value, numbers(x, y));
        check(|[x, y]| numbers(x, y), [x, y], gradient.into());
        let (second_value, second_gradient, hessian) = numbers_hessian(x, y);
        near(second_value, value);
        near(second_gradient.0, gradient.0);
        near(second_gradient.1, gradient.1);
        check(|[x, y]| numbers_gradient(x, y).1.0, [x, y], hessian[0]);
        check(|[x, y]| numbers_gradient(x, y).1.1, [x, y], hessian[1]);

        let v = vector(&mut random);
        let y = random.within(1.0);
        // Keep away from where the branches meet.
        if [x - 0.5, x + 0.5, y - 0.2, x - y, x + 0.9, x, y].iter().all(|d| d.abs() > 0.01) {
            let (value, gradient) = choices_gradient(x, y, v);
            near(value, choices(x, y, v));
            check(|[x, y]| choices(x, y, v), [x, y], gradient.into());
        }
    }
}

#[test]
fn by_vectors_quaternions_and_matrices() {
    let mut random = Random::new(6);
    for _ in 0..100 {
        let (v, w, x) = (vector(&mut random), vector(&mut random), random.within(1.0));
        let of = |[a, b, c, s]: [f64; 4]| (DVec3::new(a, b, c), s);
        let at = [v.x, v.y, v.z, x];
        let kinks = (v.abs() - w).abs().min((v.abs() + 0.3).abs()).min(v.abs()).min((w + 0.3).abs());
        if kinks.min_element() > 0.02 && v.cross(w).length() > 0.3 {
            let (value, (by_v, by_s), hessian) = vectors_hessian(v, x, &w);
            near(value, vectors(v, x, &w));
            check(|at| vectors(of(at).0, of(at).1, &w), at, [by_v.x, by_v.y, by_v.z, by_s]);
            let gradient = |at| {
                let (_, (by_v, by_s)) = vectors_gradient(of(at).0, of(at).1, &w);
                [by_v.x, by_v.y, by_v.z, by_s]
            };
            for (k, row) in hessian.into_iter().enumerate() {
                check(|at| gradient(at)[k], at, row);
            }
        }

        let r = quaternion(&mut random);
        // Not of length 1.
        let q = [random.within(1.0), random.within(1.0), random.within(1.0), random.within(1.0)];
        let by_hand = |q: [f64; 4]| {
            // glam's operators, without its assertions of unit length.
            let q = DQuat::from_array(q);
            spun(q, r, w)
        };
        let (value, (by_q,)) = spun_gradient(DQuat::from_array(q), r, w);
        near(value, by_hand(q));
        check(by_hand, q, by_q.to_array());

        let m: [f64; 9] = core::array::from_fn(|k| random.within(1.0) + if k % 4 == 0 { 2.5 } else { 0.0 });
        let (value, (by_m,)) = mixed_gradient(DMat3::from_cols_array(&m), x, w);
        near(value, mixed(DMat3::from_cols_array(&m), x, w));
        check(|m| mixed(DMat3::from_cols_array(&m), x, w), m, by_m.to_cols_array());

        let (value, (by_axis, by_x)) = about_gradient(v, x, w);
        near(value, about(v, x, w));
        if v.length() > 0.3 {
            check(|at| about(of(at).0, of(at).1, w), at, [by_axis.x, by_axis.y, by_axis.z, by_x]);
        }
    }
}

#[test]
fn of_vectors_there_are_jacobians() {
    let mut random = Random::new(7);
    for _ in 0..100 {
        let (x, p) = (random.within(3.0), vector(&mut random));
        let [m, n] = [0; 2].map(|_| DRigid::from_rotation_translation(quaternion(&mut random), vector(&mut random)));
        let (value, (by_x, by_p)): (DVec3, (DVec3, DMat3)) = rigid_jacobian(x, p, m, n);
        for k in 0..3 {
            near(value[k], rigid(x, p, m, n)[k]);
            let of = |[x, a, b, c]: [f64; 4]| rigid(x, DVec3::new(a, b, c), m, n)[k];
            check(of, [x, p.x, p.y, p.z], [by_x[k], by_p.x_axis[k], by_p.y_axis[k], by_p.z_axis[k]]);
        }

        let (v, weights) = (DVec2::new(p.x, p.y), [p.z, x, 0.5 * x]);
        if v.length() < 0.2 {
            continue;
        }
        let (value, (by_v, by_weights, by_x)): (DVec2, ([DVec2; 2], [DVec2; 3], DVec2)) = plane_jacobian(v, weights, x);
        for k in 0..2 {
            near(value[k], plane(v, weights, x)[k]);
            let of = |[x, a, b, p, q, r]: [f64; 6]| plane(DVec2::new(a, b), [p, q, r], x)[k];
            let [p, q, r] = weights;
            let [by_p, by_q, by_r] = by_weights.map(|by| by[k]);
            check(of, [x, v.x, v.y, p, q, r], [by_x[k], by_v[0][k], by_v[1][k], by_p, by_q, by_r]);
        }
    }
}

/// In single precision, with arguments by reference and one that is not used.
#[differentiate(wrt(q, v, x))]
fn single(q: Quat, v: &Vec3, x: &f32, m: Rigid, _: f32) -> Vec3A {
    let a = Vec3A::from(*v) * *x;
    m.transform_point3a(q * a).normalize()
}

#[test]
fn single_precision() {
    let q = Quat::from_rotation_x(0.3);
    let m = Rigid::from_rotation_translation(Quat::from_rotation_y(1.0), Vec3::new(0.1, 0.2, 0.3));
    let v = Vec3::new(0.5, -0.2, 0.8);
    let (value, (by_q, by_v, by_x)) = single_jacobian(q, &v, &1.5, m, 0.0);
    assert!((value - single(q, &v, &1.5, m, 0.0)).length() < 1e-6);
    let by_v: Mat3 = by_v;
    let by_q: [Vec3A; 4] = by_q;
    let difference = |q: Quat, v: Vec3, x: f32| (single(q, &v, &x, m, 0.0) - value) / 1e-3;
    assert!((difference(q, v, 1.501) - by_x).length() < 1e-2);
    assert!((difference(q, v + Vec3::new(0.0, 1e-3, 0.0), 1.5) - by_v * Vec3A::Y).length() < 1e-2);
    let moved = Quat::from_xyzw(q.x, q.y, q.z + 1e-3, q.w);
    assert!((difference(moved, v, 1.5) - by_q[2]).length() < 1e-2);
}

#[test]
fn degenerate_geometry_is_finite() {
    #[differentiate(wrt(v))]
    fn direction(v: Vec3, w: Vec3) -> f32 {
        v.normalize().dot(w) + v.length() + v.distance(Vec3::ZERO)
    }
    let (value, (by_v,)) = direction_gradient(Vec3::ZERO, Vec3::X);
    assert_eq!((value, by_v), (0.0, Vec3::ZERO));
    #[differentiate(wrt(x))]
    fn root(x: f64) -> f64 {
        x.sqrt()
    }
    assert_eq!(root_gradient(0.0), (0.0, (0.0,)));
}

/// Attributes and visibility of the function are kept.
mod kept {
    use aim::differentiate;

    /// The function itself stays as written.
    #[differentiate(wrt(x), crate = ::aim)]
    #[cfg(test)]
    #[must_use]
    #[inline(always)]
    pub(crate) const fn still(x: f32) -> f32 {
        3.0 * x
    }

    #[differentiate(wrt(x))]
    #[cfg(any())]
    fn absent(x: f32) -> f32 {
        x
    }

    pub(super) struct Associated;

    impl Associated {
        #[differentiate(wrt(r#try))]
        pub(super) fn square(r#try: f64) -> f64 {
            r#try * r#try
        }
    }
}

#[test]
fn attributes_are_kept() {
    const SIX: f32 = kept::still(2.0);
    assert_eq!((SIX, kept::still_gradient(2.0)), (6.0, (6.0, (3.0,))));
    assert_eq!(kept::Associated::square_gradient(3.0), (9.0, (6.0,)));
    assert_eq!(kept::Associated::square(3.0), 9.0);
}

/// The square of a length is smooth where the length is 0; differentiated twice.
#[differentiate(wrt(a), hessian)]
fn squared_distance(a: Vec3, b: Vec3) -> f32 {
    0.5 * a.distance(b).powi(2)
}

#[test]
fn the_square_of_a_length_is_smooth() {
    let (value, (gradient,), hessian) = squared_distance_hessian(Vec3::X, Vec3::X);
    assert_eq!((value, gradient), (0.0, Vec3::ZERO));
    assert_eq!(hessian, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(squared_distance(Vec3::X, Vec3::X), value);
}
