//! Functions of a length at length 0: Hessians of energies and Jacobians of scaled directions have their limits there.

macro_rules! functions {
    ($real:ident, $vec3:ident:
        energies { $($energy:ident = |$l:ident, $k:ident| $of_length:expr, $curvature:expr;)* }
        fields { $($field:ident = |$v:ident, $r:ident, $m:ident| $of_vector:expr, $slope:expr;)* }
    ) => {
        use aim::glam::$vec3;

        $(mod $energy {
            use aim::glam::$vec3;

            #[aim::differentiate(wrt(v), hessian)]
            pub(super) fn energy(v: $vec3, $k: $real) -> $real {
                let $l = v.length();
                $of_length
            }
        })*

        $(mod $field {
            use aim::glam::$vec3;

            #[aim::differentiate(wrt($v))]
            pub(super) fn field($v: $vec3, $m: $real) -> $vec3 {
                let $r = $v.length();
                $of_vector
            }
        })*

        /// Returns each name with the derived matrix at `v` and the expected factor of the unit matrix there.
        pub(super) fn derived(v: $vec3, k: $real) -> Vec<(&'static str, [[$real; 3]; 3], $real)> {
            let mut all = Vec::new();
            $({
                let (_, _, rows) = $energy::energy_hessian(v, k);
                all.push((stringify!($energy), rows, (|$k: $real| { let _ = $k; $curvature })(k)));
            })*
            $({
                let (_, (by_v,)) = $field::field_jacobian(v, k);
                all.push((stringify!($field), by_v.to_cols_array_2d(), (|$m: $real| { let _ = $m; $slope })(k)));
            })*
            all
        }
    };
}

macro_rules! in_both_precisions {
    ($($all:tt)*) => {
        mod single {
            functions!(f32, Vec3: $($all)*);
        }

        mod double {
            functions!(f64, DVec3: $($all)*);
        }
    };
}

in_both_precisions! {
    energies {
        spring = |l, k| { let t = k * l; 0.5 * t * t }, k * k;
        gaussian = |l, k| (-l * l / (2.0 * k * k)).exp(), -1.0 / (k * k);
        sine = |l, k| k * l * l.sin(), 2.0 * k;
        saturated = |l, k| l * (k * l).tanh(), 2.0 * k;
        arc = |l, k| { let t = (k * l).atan(); 0.5 * t * t }, k * k;
        chain = |l, k| (k * l).cosh(), k * k;
        fair = |l, k| k * (l - (1.0 + l).ln()), k;
        kernel = |l, k| { let q = l / k; 1.0 - 1.5 * q * q + 0.75 * q * q * q }, -3.0 / (k * k);
        compact = |l, k| { let q = 0.5 * l; (1.0 - q).powi(4) * (4.0 * q + 1.0) * k }, -5.0 * k;
        softened = |l, k| (k * k + l * l).sqrt(), 1.0 / k;
        pseudo_huber = |l, k| l.hypot(k), 1.0 / k;
        fair_by_scale = |l, k| k * k * (l / k - (1.0 + l / k).ln()), 1.0;
        matern_3_2 = |l, k| { let s = 2.0 * l / k; (1.0 + s) * (-s).exp() }, -4.0 / (k * k);
        matern_5_2 = |l, k| (1.0 + 2.0 * l / k + 4.0 * l * l / (3.0 * k * k)) * (-2.0 * l / k).exp(), -4.0 / (3.0 * k * k);
        spline = |l, k| {
            let q = l / k;
            if q < 1.0 {
                1.0 - 1.5 * q * q + 0.75 * q.powi(3)
            } else if q < 2.0 {
                0.25 * (2.0 - q).powi(3)
            } else {
                0.0
            }
        }, -3.0 / (k * k);
        ranges = |l, k| match l {
            0.0..1.0 => k * (1.0 - 1.5 * l * l + 0.75 * l.powi(3)),
            1.0..2.0 => k * 0.25 * (2.0 - l).powi(3),
            _ => 0.0,
        }, -3.0 * k;
        wendland = |l, k| { let q = l / k; 0.25 * (1.0 - q).max(0.0).powi(4) * (4.0 * q + 1.0) }, -5.0 / (k * k);
        falloff = |l, k| { let t = (l / k).min(1.0); 1.0 - t * t * (3.0 - 2.0 * t) }, -6.0 / (k * k);
        ring = |l, k| if l > 1.0 && l < 2.0 { k * (2.0 - l).powi(3) } else { k - l * l }, -2.0;
        truncated = |l, k| l.min(k).powi(2), 2.0;
        artanh = |l, k| (k * l).atanh().powi(2), 2.0 * k * k;
        arsinh = |l, k| (l / k).asinh().powi(2), 2.0 / (k * k);
        logarithmic = |l, k| (k * l).ln_1p().powi(2), 2.0 * k * k;
        weighted_artanh = |l, k| k * l.atanh().powi(2), 2.0 * k;
        weighted_arsinh = |l, k| k * l.asinh().powi(2), 2.0 * k;
        weighted_logarithm = |l, k| k * l.ln_1p().powi(2), 2.0 * k;
        ratio = |l, k| k * (0.5 * ((1.0 + l) / (1.0 - l)).ln()).powi(2), 2.0 * k;
        arcosh = |l, _k| l.cosh().acosh().powi(2), 2.0;
        hyperbolic = |l, k| (1.0 + k * l * l).acosh().powi(2), 4.0 * k;
    }
    fields {
        drag = |v, l, m| v.normalize() * (m * l + l * l), m;
        friction = |v, l, m| v.normalize() * (m * l).tanh(), m;
        exponential = |v, l, m| v.normalize() * (m * (l.exp() - 1.0)), m;
        lens = |v, r, m| { let t = r.atan2(m); v.normalize() * (t + m * t.powi(3)) }, 1.0 / m;
        logarithm = |v, l, m| v * (m * (1.0 + l).ln() / l), m;
        limited = |v, l, m| v.normalize() * l.min(m), 1.0;
        proportional = |v, l, m| v.normalize() * (2.0 * l).min(m), 2.0;
        branched = |v, l, m| v.normalize() * if l < m { l } else { m }, 1.0;
        sliding = |v, l, m| -v.normalize() * if l < m { let y = l / m; y * (2.0 - y) } else { 1.0 }, -2.0 / m;
        nested = |v, l, m| v.normalize() * (0.5 * (m * l).atan()).tan(), 0.5 * m;
        scaled = |v, _l, m| v.normalize() * (v * m).length(), m;
        squares = |v, _l, m| v.normalize() * (m * (v.x * v.x + v.y * v.y + v.z * v.z).sqrt()), m;
        opposite = |v, l, m| { let w = -v; w.normalize() * (m * l) }, -m;
    }
}

#[test]
fn functions_of_a_length_have_their_limits_where_it_is_0() {
    use aim::glam::{DVec3, Vec3};
    let near = |name: &str, found: f64, expected: f64, tolerance: f64| {
        assert!(
            (found - expected).abs() <= tolerance * (1.0 + expected.abs()),
            "{name}: {found} instead of {expected}"
        );
    };
    for (name, rows, expected) in double::derived(DVec3::ZERO, 1.3) {
        for (i, j) in (0..9).map(|n| (n / 3, n % 3)) {
            near(name, rows[i][j], if i == j { expected } else { 0.0 }, 1e-12);
        }
    }
    for (name, rows, expected) in single::derived(Vec3::ZERO, 1.3) {
        for (i, j) in (0..9).map(|n| (n / 3, n % 3)) {
            near(name, rows[i][j].into(), if i == j { expected.into() } else { 0.0 }, 1e-5);
        }
    }
    // Near 0 they approach the limit.
    for size in [1e-3, 1e-5, 1e-8, 1e-12] {
        for (name, rows, expected) in double::derived(DVec3::new(0.6, -0.48, 0.64) * size, 1.3) {
            for (i, j) in (0..9).map(|n| (n / 3, n % 3)) {
                near(
                    &format!("{name} at {size:e}"),
                    rows[i][j],
                    if i == j { expected } else { 0.0 },
                    10.0 * size + 1e-6,
                );
            }
        }
    }
}

/// A saturated length does not overflow, however long it is: ∇∇(l·tanh k l) → (1 − n nᵀ)/l, and so does ∇(n·tanh k l).
#[test]
fn a_saturated_length_has_its_derivatives_far_out() {
    use aim::glam::{DVec3, Vec3};
    let n = DVec3::new(0.6, -0.48, 0.64);
    for size in [15.0, 16.0, 60.0, 100.0, 1e3, 1e6] {
        let single = single::derived(Vec3::new(0.6, -0.48, 0.64) * size, 1.3);
        let double = double::derived(n * f64::from(size), 1.3);
        for ((name, single, _), (_, double, _)) in single.into_iter().zip(double) {
            if !["saturated", "friction"].contains(&name) {
                continue;
            }
            for (i, j) in (0..9).map(|number| (number / 3, number % 3)) {
                let expected = (f64::from(u8::from(i == j)) - n[i] * n[j]) / f64::from(size);
                let near = |found: f64, tolerance: f64| (found - expected).abs() * f64::from(size) < tolerance;
                assert!(near(double[i][j], 1e-12), "{name} at {size}: {} instead of {expected}", double[i][j]);
                assert!(near(single[i][j].into(), 1e-5), "{name} at {size}: {} instead of {expected}", single[i][j]);
            }
        }
    }
}

/// Rotations, lenses and angles as usually written by hand.
mod as_written {
    use core::f64::consts::{PI, TAU};

    use aim::differentiate;
    use aim::glam::{DQuat, DVec2, DVec3};

    #[differentiate(wrt(q))]
    pub(super) fn fisheye(q: DVec2, z: f64, k: f64) -> DVec2 {
        let r = q.length();
        let t = r.atan2(z);
        let d = t + k * t * t * t;
        q * (d / r)
    }

    #[differentiate(wrt(w))]
    pub(super) fn rodrigues(w: [f64; 3], p: [f64; 3]) -> [f64; 3] {
        let t = (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]).sqrt();
        let c = t.cos();
        let d = (w[0] / t * p[0] + w[1] / t * p[1] + w[2] / t * p[2]) * (1.0 - c);
        [
            p[0] * c + (w[1] / t * p[2] - w[2] / t * p[1]) * t.sin() + w[0] / t * d,
            p[1] * c + (w[2] / t * p[0] - w[0] / t * p[2]) * t.sin() + w[1] / t * d,
            p[2] * c + (w[0] / t * p[1] - w[1] / t * p[0]) * t.sin() + w[2] / t * d,
        ]
    }

    #[differentiate(wrt(w, u))]
    pub(super) fn screw(w: DVec3, u: DVec3) -> DVec3 {
        let square = w.dot(w);
        let angle = square.sqrt();
        let a = angle.sin() / angle;
        let b = (1.0 - angle.cos()) / square;
        let c = (1.0 - a) / square;
        u + w.cross(u) * b + w.cross(w.cross(u)) * c
    }

    #[differentiate(wrt(angle, t))]
    pub(super) fn weight(angle: f64, t: f64) -> f64 {
        (t * angle).sin() / angle.sin()
    }

    #[differentiate(wrt(q))]
    pub(super) fn turn(q: DQuat) -> DVec3 {
        let v = DVec3::new(q.x, q.y, q.z);
        let n = v.length();
        let angle = if q.w < 0.0 { 2.0 * (-n).atan2(-q.w) } else { 2.0 * n.atan2(q.w) };
        v * (angle / n)
    }

    #[differentiate(wrt(b), hessian)]
    pub(super) fn bend(b: DVec3) -> f64 {
        let angle = DVec3::X.dot(b.normalize()).acos();
        angle * angle
    }

    #[differentiate(wrt(x, y))]
    pub(super) fn box_cox(x: f64, y: f64) -> f64 {
        let u = x * y.ln();
        y.ln() * (u.exp() - 1.0) / u
    }

    #[differentiate(wrt(v))]
    pub(super) fn pull(v: DVec3, to: DVec3) -> DVec3 {
        (to - v).normalize() * v.distance(to)
    }

    #[differentiate(wrt(tangent(q)))]
    pub(super) fn half(q: DQuat, p: DVec3) -> DVec3 {
        let (axis, angle) = q.to_axis_angle();
        DQuat::from_axis_angle(axis, 0.5 * angle) * p
    }

    #[differentiate(wrt(tangent(q)))]
    pub(super) fn shortest(q: DQuat, most: f64) -> DVec3 {
        let (axis, angle) = q.to_axis_angle();
        axis * (2.0 * if angle > PI { angle - TAU } else { angle }).min(most)
    }

    #[differentiate(wrt(v))]
    pub(super) fn arc(v: DVec3, to: DVec3, p: DVec3) -> DVec3 {
        DQuat::from_axis_angle(v.cross(to).normalize(), v.angle_between(to)) * p
    }

    #[differentiate(wrt(v))]
    pub(super) fn arc_of_directions(v: DVec3, to: DVec3, p: DVec3) -> DVec3 {
        let (from, to) = (v.normalize(), to.normalize());
        DQuat::from_axis_angle(from.cross(to).normalize(), from.angle_between(to)) * p
    }

    #[differentiate(wrt(w))]
    pub(super) fn integrated(w: DVec3, p: DVec3, dt: f64) -> DVec3 {
        let (s, c) = (0.5 * (w * dt).length()).sin_cos();
        let u = w.normalize() * s;
        DQuat::from_xyzw(u.x, u.y, u.z, c) * p
    }

    #[differentiate(wrt(v))]
    pub(super) fn soft(v: DVec3, p: DVec3, most: f64) -> DVec3 {
        let r = v.length();
        DQuat::from_axis_angle(v / r, most * (r / most).tanh()) * p
    }

    #[differentiate(wrt(p))]
    pub(super) fn equidistant(p: DVec3) -> DVec2 {
        p.truncate().normalize() * p.angle_between(DVec3::Z)
    }

    #[differentiate(wrt(s))]
    pub(super) fn tilt(s: DVec2, p: DVec3) -> DVec3 {
        DQuat::from_axis_angle(DVec3::new(-s.y, s.x, 0.0).normalize(), s.length()) * p
    }

    #[differentiate(wrt(v), hessian)]
    pub(super) fn cosine(v: DVec3, to: DVec3) -> f64 {
        1.0 - v.angle_between(to).cos()
    }

    #[differentiate(wrt(v), hessian)]
    pub(super) fn never_negative(v: DVec3) -> f64 {
        let length = v.length().max(0.0);
        length * length
    }
}

#[test]
fn what_people_write_by_hand_has_its_limits() {
    use aim::glam::{DMat3, DQuat, DVec2, DVec3};
    let p = DVec3::new(1.0, 2.0, 3.0);
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found} instead of {expected}");

    assert_eq!(as_written::fisheye_jacobian(DVec2::ZERO, 2.0, 0.1), (DVec2::ZERO, ([DVec2::X * 0.5, DVec2::Y * 0.5],)));
    // ∂(w × p)/∂w
    let across = [[0.0, 3.0, -2.0], [-3.0, 0.0, 1.0], [2.0, -1.0, 0.0]];
    assert_eq!(as_written::rodrigues_jacobian([0.0; 3], p.to_array()), (p.to_array(), (across,)));
    let (moved, (by_turn, by_shift)) = as_written::screw_jacobian(DVec3::ZERO, p);
    let half = DMat3::from_cols(DVec3::X.cross(p), DVec3::Y.cross(p), DVec3::Z.cross(p)) * 0.5;
    assert_eq!((moved, by_turn, by_shift), (p, half, DMat3::IDENTITY));
    let (weight, (by_angle, by_t)) = as_written::weight_gradient(0.0, 0.3);
    [(weight, 0.3), (by_angle, 0.0), (by_t, 1.0)].into_iter().for_each(|(found, expected)| near(found, expected));
    let (_, (by_q,)) = as_written::turn_jacobian(DQuat::IDENTITY);
    assert_eq!(by_q, [DVec3::X * 2.0, DVec3::Y * 2.0, DVec3::Z * 2.0, DVec3::ZERO]);
    let (_, _, curvature) = as_written::bend_hessian(DVec3::X);
    assert_eq!(curvature, [[0.0; 3], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]);
    let (value, (by_x, by_y)) = as_written::box_cox_gradient(0.0, 2.5);
    let log = 2.5_f64.ln();
    [(value, log), (by_x, 0.5 * log * log), (by_y, 0.4)]
        .into_iter()
        .for_each(|(found, expected)| near(found, expected));
    let (_, _, curvature) = as_written::never_negative_hessian(DVec3::ZERO);
    assert_eq!(curvature, [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 2.0]]);
}

#[test]
fn directions_times_lengths_under_other_names_have_their_limits() {
    use aim::glam::{DMat3, DQuat, DVec2, DVec3};
    let p = DVec3::new(1.0, 2.0, 3.0);
    let by_turn = DMat3::from_cols(DVec3::X.cross(p), DVec3::Y.cross(p), DVec3::Z.cross(p));
    let near = |found: DMat3, expected: DMat3| {
        assert!(found.abs_diff_eq(expected, 1e-12), "{found} instead of {expected}");
    };

    near(as_written::pull_jacobian(p, p).1.0, -DMat3::IDENTITY);
    near(as_written::half_jacobian(DQuat::IDENTITY, p).1.0, by_turn * 0.5);
    near(as_written::shortest_jacobian(DQuat::IDENTITY, 3.0).1.0, DMat3::IDENTITY * 2.0);
    // v turns about v × w / |v| to the direction of w, so a point turns by the opposite of v's change.
    let by_change = |e: DVec3| p.cross(DVec3::Z.cross(e)) * 0.5;
    let arc = DMat3::from_cols(by_change(DVec3::X), by_change(DVec3::Y), by_change(DVec3::Z));
    near(as_written::arc_jacobian(DVec3::Z * 2.0, DVec3::Z * 5.0, p).1.0, arc);
    near(as_written::arc_of_directions_jacobian(DVec3::Z * 2.0, DVec3::Z * 5.0, p).1.0, arc);
    near(as_written::integrated_jacobian(DVec3::ZERO, p, 0.3).1.0, by_turn * 0.3);
    near(as_written::soft_jacobian(DVec3::ZERO, p, 0.3).1.0, by_turn);
    assert_eq!(as_written::equidistant_jacobian(DVec3::Z).1.0, [DVec2::X, DVec2::Y, DVec2::ZERO]);
    let (_, (by_stick,)) = as_written::tilt_jacobian(DVec2::ZERO, p);
    assert_eq!(by_stick, [DVec3::Y.cross(p), -DVec3::X.cross(p)]);
    let (_, _, curvature) = as_written::cosine_hessian(DVec3::X, DVec3::X);
    assert_eq!(curvature, [[0.0; 3], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
}

#[test]
fn logarithms_and_powers_of_small_numbers_have_their_slopes() {
    assert_eq!(small::log_gradient(1e-20).1.0, 1e20);
    assert_eq!(small::of_decays_gradient(45.0).1.0, -1.0);
    for (found, expected) in
        [(small::power_gradient(1e-20).1.0, 3e13), (small::cube_root_gradient(1e-30).1.0, 1e20 / 3.0)]
    {
        assert!((found / expected - 1.0).abs() < 1e-5, "{found} instead of {expected}");
    }
}

mod small {
    use aim::differentiate;

    #[differentiate(wrt(x))]
    pub(super) fn log(x: f32) -> f32 {
        x.ln()
    }

    #[differentiate(wrt(x))]
    pub(super) fn of_decays(x: f32) -> f32 {
        ((-x).exp() + (-2.0 * x).exp()).ln()
    }

    #[differentiate(wrt(x))]
    pub(super) fn power(x: f32) -> f32 {
        x.powf(0.3)
    }

    #[differentiate(wrt(x))]
    pub(super) fn cube_root(x: f32) -> f32 {
        x.cbrt()
    }
}
