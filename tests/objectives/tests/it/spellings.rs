//! Limits of expressions of several numbers, and of lengths and angles in other spellings than `v.length()`.

macro_rules! functions {
    ($real:ident, $vec2:ident, $vec3:ident, $quat:ident:
        numbers { $($number:ident = |$x:ident, $k:ident| $body:expr, [$value:expr, $slope:expr];)* }
        angles { $($angle:ident = |$t:ident| $of_angle:expr, $limit:expr;)* }
        roots {
            $($root:ident = |$u:ident, $m:ident| $of_root:expr, $end:expr,
                [$there:expr, $slope_there:expr, $curvature_there:expr];)*
        }
    ) => {
        use aim::differentiate;
        use aim::glam::{$quat, $vec2, $vec3};

        $(mod $number {
            #[aim::differentiate(wrt(x))]
            pub(super) fn number($x: $real, $k: $real) -> $real {
                $body
            }
        })*

        $(mod $angle {
            use aim::differentiate;
            use aim::glam::{$quat, $vec3};

            #[differentiate(wrt(tangent(q)))]
            pub(super) fn of_quaternion(q: $quat) -> $real {
                let $t = q.to_scaled_axis().length();
                $of_angle
            }

            #[differentiate(wrt(v))]
            pub(super) fn of_components(v: [$real; 3]) -> $real {
                let [x, y, z] = v;
                let $t = (x * x + y * y + z * z).sqrt();
                $of_angle
            }

            #[differentiate(wrt(v))]
            pub(super) fn of_scaled(v: $vec3) -> $real {
                let $t = (v * (1.0 + v.length_squared())).length();
                $of_angle
            }

            #[differentiate(wrt(v))]
            pub(super) fn of_saturated(v: $vec3) -> $real {
                let $t = (v.normalize() * v.length().tanh()).length();
                $of_angle
            }
        })*

        /// Returns each name with value and slope at `x`, and the expected ones at 0.
        pub(super) fn numbers(x: $real, k: $real) -> Vec<(&'static str, [$real; 4])> {
            vec![$({
                let (value, (slope,)) = $number::number_gradient(x, k);
                let [at_zero, slope_at_zero] = (|$k: $real| { let _ = $k; [$value, $slope] })(k);
                (stringify!($number), [value, slope, at_zero, slope_at_zero])
            }),*]
        }

        /// Returns each name with the values and slopes by the first component at angle 0, and the expected value.
        pub(super) fn angles() -> Vec<(&'static str, [($real, $real); 4], $real)> {
            vec![$({
                let by_turn = $angle::of_quaternion_gradient($quat::IDENTITY);
                let by_components = $angle::of_components_gradient([0.0; 3]);
                let by_scaled = $angle::of_scaled_gradient($vec3::ZERO);
                let by_saturated = $angle::of_saturated_gradient($vec3::ZERO);
                let found = [
                    (by_turn.0, by_turn.1.0.x),
                    (by_components.0, by_components.1.0[0]),
                    (by_scaled.0, by_scaled.1.0.x),
                    (by_saturated.0, by_saturated.1.0.x),
                ];
                (stringify!($angle), found, $limit)
            }),*]
        }

        $(mod $root {
            #[aim::differentiate(wrt(x), hessian)]
            pub(super) fn root(x: $real, k: $real) -> $real {
                let ($u, $m) = (x, k);
                $of_root
            }
        })*

        /// Returns each name with value, slope and curvature at the end of the domain, and the expected ones.
        pub(super) fn roots(m: $real) -> Vec<(&'static str, [$real; 3], [$real; 3])> {
            vec![$({
                let (value, (slope,), [[curvature]]) = $root::root_hessian($end, m);
                let $m = m;
                (stringify!($root), [value, slope, curvature], [$there, $slope_there, $curvature_there])
            }),*]
        }

        /// The energy of a rotation whose angle saturates.
        #[differentiate(wrt(v), hessian)]
        pub(super) fn saturated_turn(v: $vec3, p: $vec3) -> $real {
            ($quat::from_axis_angle(v.normalize(), v.length().tanh()) * p).dot(p)
        }

        #[differentiate(wrt(a, b), hessian)]
        pub(super) fn angle_times_sine(a: $vec3, b: $vec3, k: $real) -> $real {
            let angle = a.angle_between(b);
            angle * (k * angle).sin()
        }

        /// The squared distance in a hyperbolic space, beside a variable factor.
        #[differentiate(wrt(v), hessian)]
        pub(super) fn weighted_distance(v: $vec3, k: $real) -> $real {
            k * (1.0 + v.length_squared()).acosh().powi(2)
        }

        /// The root of x² is |x|, not x: no limit at 0.
        #[differentiate(wrt(x))]
        pub(super) fn of_size(x: $real) -> $real {
            (1.0 + x * x).acosh() / x
        }

        /// The logarithm of a rotation, without its factor 2.
        #[differentiate(wrt(tangent(q)))]
        pub(super) fn half_log(q: $quat) -> $vec3 {
            q.xyz().normalize() * q.w.acos()
        }

        #[differentiate(wrt(tangent(q)))]
        pub(super) fn clamped_log(q: $quat) -> $vec3 {
            q.xyz().normalize() * (2.0 * q.w.clamp(-1.0, 1.0).acos())
        }

        #[differentiate(wrt(tangent(q)), hessian)]
        pub(super) fn squared_angle(q: $quat, r: $quat) -> $real {
            (2.0 * (r.conjugate() * q).w.min(1.0).acos()).powi(2)
        }

        /// The translation part of the logarithm of a rigid motion.
        #[differentiate(wrt(tangent(q), p))]
        pub(super) fn log_translation(q: $quat, p: $vec3) -> $vec3 {
            let w = q.to_scaled_axis();
            let t = w.length();
            let half = 0.5 * t;
            let c = (1.0 - half / half.tan()) / (t * t);
            p - 0.5 * w.cross(p) + c * w.cross(w.cross(p))
        }

        /// The squared distance in the Poincaré disc.
        #[differentiate(wrt(u, w), hessian)]
        pub(super) fn squared_distance(u: $vec2, w: $vec2) -> $real {
            let d = 2.0 * (u - w).length_squared() / ((1.0 - u.length_squared()) * (1.0 - w.length_squared()));
            (1.0 + d).acosh().powi(2)
        }
    };
}

macro_rules! in_both_precisions {
    ($($all:tt)*) => {
        mod single {
            functions!(f32, Vec2, Vec3, Quat: $($all)*);
        }

        mod double {
            functions!(f64, DVec2, DVec3, DQuat: $($all)*);
        }
    };
}

in_both_precisions! {
    numbers {
        vortex = |x, k| (1.0 - (-k * x * x).exp()) / (x * x), [k, 0.0];
        circulation = |x, k| (1.0 - (-k * x * x).exp()) / x, [0.0, k];
        logarithm = |x, k| (1.0 + k * x * x).ln() / x, [0.0, k];
        gaussian = |x, k| (1.0 - (-x * x / k).exp()) / x, [0.0, 1.0 / k];
        conic = |x, k| (1.0 - (1.0 - k * x * x).sqrt()) / x, [0.0, 0.5 * k];
        sag = |x, k| (1.0 - (1.0 - x * x * k * k).sqrt()) / x, [0.0, 0.5 * k * k];
        cube_root = |x, _k| ((1.0 + x).cbrt() - 1.0) / x, [1.0 / 3.0, -1.0 / 9.0];
        cube_root_of_8 = |x, _k| ((8.0 + x).cbrt() - 2.0) / x, [1.0 / 12.0, -1.0 / 288.0];
        third_power = |x, _k| ((1.0 + x).powf(1.0 / 3.0) - 1.0) / x, [1.0 / 3.0, -1.0 / 9.0];
        power = |x, k| ((1.0 + x).powf(k) - 1.0) / x, [k, 0.5 * k * (k - 1.0)];
        annuity = |x, k| (1.0 - (1.0 + x).powf(-k)) / x, [k, -0.5 * k * (k + 1.0)];
        box_cox = |x, k| ((2.0 + k).powf(x) - 1.0) / x, [(2.0 + k).ln(), 0.5 * (2.0 + k).ln().powi(2)];
        nested = |x, k| { let b = (1.0 - (-3.0 * x).exp()) / x; k * (b - 3.0) / x }, [-4.5 * k, 4.5 * k];
        log_of_length = |x, _k| x.hypot(1.0).ln() / (x * x), [0.5, 0.0];
        rise = |x, _k| (x.hypot(1.0) - 1.0) / x, [0.0, 0.5];
        common = |x, _k| { let u = x.sin(); (u - u * x.cos()) / x.powi(3) }, [0.5, 0.0];
    }
    angles {
        exponential = |t| t.exp_m1() / t, 1.0;
        decay = |t| (1.0 - (-t).exp()) / t, 1.0;
        ln = |t| (1.0 + t).ln() / t, 1.0;
        translation = |t| { let half = 0.5 * t; (1.0 - half / half.tan()) / (t * t) }, 1.0 / 12.0;
        bessel = |t| (t.sin() - t * t.cos()) / t.powi(3), 1.0 / 3.0;
        half_cotangent = |t| 0.5 * t * t.sin() / (1.0 - t.cos()), 1.0;
        product = |t| { let u = t.sin(); (u - u * t.cos()) / t.powi(3) }, 0.5;
    }
    roots {
        arcosh = |x, _k| (1.0 + x).acosh().powi(2), 0.0, [0.0, 2.0, -2.0 / 3.0];
        weighted_arcosh = |x, k| k * x.acosh().powi(2), 1.0, [0.0, 2.0 * k, -2.0 / 3.0 * k];
        quotient_of_arcosh = |x, _k| (1.0 + x).acosh().powi(2) / x, 0.0, [2.0, -1.0 / 3.0, 8.0 / 45.0];
        arccos = |x, k| k * x.acos().powi(2), 1.0, [0.0, -2.0 * k, 2.0 / 3.0 * k];
        arcsin = |x, _k| x.sqrt().asin().powi(2), 0.0, [0.0, 1.0, 2.0 / 3.0];
        cosine = |x, k| (k * x).sqrt().cos(), 0.0, [1.0, -0.5 * k, k * k / 12.0];
        cubed = |x, _k| x.sqrt().cosh().powi(3), 0.0, [1.0, 1.5, 1.75];
        product_of_roots = |x, _k| x.sqrt() * x.sqrt().sin(), 0.0, [0.0, 1.0, -1.0 / 3.0];
        chebyshev = |x, _k| (3.0 * x.acos()).cos(), 1.0, [1.0, 9.0, 24.0];
        order = |x, k| (k * x.acos()).cos(), 1.0, [1.0, k * k, k * k * (k * k - 1.0) / 3.0];
        sine = |x, _k| x.acos().sin().powi(2), 1.0, [0.0, -2.0, -2.0];
    }
}

#[test]
fn numbers_that_vanish_beside_others_have_their_limits() {
    let near = |name: &str, x: f64, found: f64, expected: f64, tolerance: f64| {
        assert!((found - expected).abs() <= tolerance, "{name} at {x:e}: {found} instead of {expected}");
    };
    for k in [0.7, -0.7] {
        for x in [0.0, 1e-12, -1e-9, 1e-6, -1e-4] {
            for (name, [value, slope, at_zero, slope_at_zero]) in double::numbers(x, k) {
                near(name, x, value, at_zero, 1e-13 + 4.0 * x.abs());
                near(name, x, slope, slope_at_zero, 1e-12 + 8.0 * x.abs());
            }
        }
    }
    for k in [0.7, -0.7] {
        for x in [0.0, 1e-9, -1e-5] {
            for (name, [value, slope, at_zero, slope_at_zero]) in single::numbers(x, k) {
                near(name, x.into(), value.into(), at_zero.into(), 1e-6 + 4.0 * f64::from(x.abs()));
                near(name, x.into(), slope.into(), slope_at_zero.into(), 1e-5 + 8.0 * f64::from(x.abs()));
            }
        }
    }
}

#[test]
fn the_root_of_a_square_is_not_negative() {
    for single in [-0.1_f32, -0.3, 0.2] {
        let x = f64::from(single);
        let expected = (1.0 + x * x).acosh() / x;
        let (value, single) = (double::of_size_gradient(x).0, single::of_size_gradient(single).0);
        assert!((value - expected).abs() < 1e-13 && (f64::from(single) - expected).abs() < 1e-5, "{value} at {x}");
    }
}

#[test]
fn functions_of_angles_have_their_limits_in_every_spelling() {
    for (name, found, expected) in double::angles() {
        for (value, slope) in found {
            assert!((value - expected).abs() < 1e-14 && slope == 0.0, "{name}: {found:?} instead of {expected}");
        }
    }
    for (name, found, expected) in single::angles() {
        for (value, slope) in found {
            assert!((value - expected).abs() < 1e-6 && slope == 0.0, "{name}: {found:?} instead of {expected}");
        }
    }
}

#[test]
fn even_functions_of_roots_have_their_derivatives_where_the_root_is_zero() {
    for (name, found, expected) in double::roots(1.3) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12, "{name}: {found} instead of {expected}");
        }
    }
    for (name, found, expected) in single::roots(1.3) {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-4, "{name}: {found} instead of {expected}");
        }
    }
}

#[test]
fn functions_of_functions_that_vanish_have_their_hessians() {
    use aim::glam::{DVec3, Vec3};
    let (p, k) = (DVec3::new(0.3, -0.5, 0.8), 1.3);
    // p · R p = p² cos θ + (n · p)² (1 − cos θ), whose second derivatives by the rotation vector are p pᵀ − p².
    let rows = double::saturated_turn_hessian(DVec3::ZERO, p).2;
    let single = single::saturated_turn_hessian(Vec3::ZERO, p.as_vec3()).2;
    let distances = double::weighted_distance_hessian(DVec3::ZERO, k).2;
    let single_distances = single::weighted_distance_hessian(Vec3::ZERO, 1.3).2;
    for (i, j) in (0..9).map(|n| (n / 3, n % 3)) {
        let unit = if i == j { 1.0 } else { 0.0 };
        let expected = p[i] * p[j] - unit * p.length_squared();
        assert!((rows[i][j] - expected).abs() < 1e-14, "{rows:?}");
        assert!((f64::from(single[i][j]) - expected).abs() < 1e-6, "{single:?}");
        assert!((distances[i][j] - 4.0 * k * unit).abs() < 1e-14, "{distances:?}");
        assert!((f64::from(single_distances[i][j]) - 4.0 * k * unit).abs() < 1e-6, "{single_distances:?}");
    }
    // k θ² near 0, and θ is the part of b − a across a, over |a|.
    let a = DVec3::new(2.0, 0.0, 0.0);
    let rows = double::angle_times_sine_hessian(a, a, k).2;
    let single = single::angle_times_sine_hessian(a.as_vec3(), a.as_vec3(), 1.3).2;
    assert!((rows[1][1] - 0.5 * k).abs() < 1e-14 && (rows[1][4] + 0.5 * k).abs() < 1e-14, "{rows:?}");
    assert!((f64::from(single[1][1]) - 0.5 * k).abs() < 1e-6, "{single:?}");
    assert_eq!((rows[0][0], rows[1][2], single[0][0]), (0.0, 0.0, 0.0));
}

#[test]
fn angles_by_the_scalar_part_have_their_slopes_at_the_identity() {
    use aim::glam::{DMat3, DQuat, DVec3, Mat3, Quat, Vec3};
    let unit = |size| DMat3::from_diagonal(DVec3::splat(size));
    assert_eq!(double::half_log_jacobian(DQuat::IDENTITY), (DVec3::ZERO, (unit(0.5),)));
    assert_eq!(double::clamped_log_jacobian(DQuat::IDENTITY), (DVec3::ZERO, (unit(1.0),)));
    assert_eq!(single::half_log_jacobian(Quat::IDENTITY), (Vec3::ZERO, (Mat3::from_diagonal(Vec3::splat(0.5)),)));
    assert_eq!(single::clamped_log_jacobian(Quat::IDENTITY), (Vec3::ZERO, (Mat3::IDENTITY,)));
    let twice = DMat3::from_diagonal(DVec3::splat(2.0));
    assert_eq!(double::squared_angle_hessian(DQuat::IDENTITY, DQuat::IDENTITY).2, twice.to_cols_array_2d());
    assert_eq!(single::squared_angle_hessian(Quat::IDENTITY, Quat::IDENTITY).2, twice.as_mat3().to_cols_array_2d());
}

#[test]
fn the_logarithm_of_a_rigid_motion_has_its_slopes_at_the_identity() {
    use aim::glam::{DMat3, DQuat, DVec3, Mat3, Quat, Vec3};
    let p = DVec3::new(0.3, 0.4, 0.5);
    // ∂(−½ w × p)/∂w
    let by_turn = DMat3::from_cols(DVec3::X.cross(p), DVec3::Y.cross(p), DVec3::Z.cross(p)) * -0.5;
    let (value, (turn, shift)) = double::log_translation_jacobian(DQuat::IDENTITY, p);
    assert!(value.abs_diff_eq(p, 1e-14) && turn.abs_diff_eq(by_turn, 1e-14), "{value} {turn}");
    assert!(shift.abs_diff_eq(DMat3::IDENTITY, 1e-14), "{shift}");
    let (value, (turn, shift)) = single::log_translation_jacobian(Quat::IDENTITY, p.as_vec3());
    assert!(value.abs_diff_eq(Vec3::new(0.3, 0.4, 0.5), 1e-6) && turn.abs_diff_eq(by_turn.as_mat3(), 1e-6), "{turn}");
    assert!(shift.abs_diff_eq(Mat3::IDENTITY, 1e-6), "{shift}");
}

/// The Hessian where the points meet is twice the metric, 4/(1 − |u|²)².
#[test]
fn the_squared_distance_in_the_poincare_disc_has_its_hessian() {
    use aim::glam::{DVec2, Vec2};
    for u in [DVec2::ZERO, DVec2::new(0.3, 0.2)] {
        let expected = 8.0 / (1.0 - u.length_squared()).powi(2);
        let (value, _, rows) = double::squared_distance_hessian(u, u);
        let single = single::squared_distance_hessian(u.as_vec2(), u.as_vec2()).2;
        assert_eq!(value, 0.0);
        for (i, j) in (0..16).map(|n| (n / 4, n % 4)) {
            let expected = if i == j {
                expected
            } else if i % 2 == j % 2 {
                -expected
            } else {
                0.0
            };
            assert!((rows[i][j] - expected).abs() < 1e-13 * (1.0 + expected.abs()), "{} at {u}", rows[i][j]);
            assert!((f64::from(single[i][j]) - expected).abs() < 1e-5 * (1.0 + expected.abs()), "{}", single[i][j]);
        }
    }
    let near = Vec2::new(0.3, 0.2);
    assert!(single::squared_distance_hessian(near, near + 1e-4).2[0][0] > 10.0);
}
