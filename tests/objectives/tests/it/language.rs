//! Expressions whose meaning in Rust depends on their place, module or trait: companions compute the same.

use aim::glam::{DMat3, DQuat, DVec2, DVec3, DVec4};

#[aim::differentiate(check = true)]
mod functions {
    use aim::glam::{DMat2, DMat3, DMat4, DQuat, DVec2, DVec3, DVec4};
    use core::ops::{Add, Mul};

    use consts::*;

    mod consts {
        pub(super) const GAIN: f64 = 1.5;
        pub(super) static NODES: [(f64, f64); 2] = [(0.25, 0.5), (0.75, 0.5)];
    }

    mod shapes {
        use super::{DVec3, Pair};

        #[derive(Clone, Copy)]
        pub(crate) struct Ball {
            pub(crate) at: DVec3,
            pub(crate) radius: f64,
        }

        impl Default for Ball {
            fn default() -> Self {
                Self { at: DVec3::Y, radius: super::GAIN }
            }
        }

        impl Ball {
            pub(super) fn distance(&self, p: DVec3) -> f64 {
                p.distance(self.at) - self.radius
            }
        }

        pub(super) fn pair(p: DVec3) -> Pair {
            Pair { a: p.x, ..Default::default() }
        }
    }

    #[derive(Clone, Copy)]
    struct Pair {
        a: f64,
        b: f64,
    }

    impl Default for Pair {
        fn default() -> Self {
            Self { a: 2.0, b: 3.0 }
        }
    }

    impl Add for Pair {
        type Output = Self;
        fn add(self, other: Self) -> Self {
            Self { a: self.a + other.a, b: self.b + other.b }
        }
    }

    impl Mul<Pair> for f64 {
        type Output = Pair;
        fn mul(self, pair: Pair) -> Pair {
            Pair { a: self * pair.a, b: self * self * pair.b }
        }
    }

    impl core::iter::Sum for Pair {
        fn sum<I: Iterator<Item = Self>>(pairs: I) -> Self {
            pairs.fold(Self { a: 0.0, b: 0.0 }, Self::add)
        }
    }

    #[differentiate(wrt(x))]
    pub(super) fn defaults(x: f64) -> f64 {
        let pair = Pair { a: x, ..Default::default() };
        let sum: Pair = [0.5 * x, 2.0].iter().map(|&k| k * pair).sum();
        let none: Pair = [pair; 0].into_iter().sum();
        sum.a * sum.b + none.a
    }

    #[differentiate(wrt(ball, p), hessian)]
    pub(super) fn scene(ball: shapes::Ball, p: DVec3) -> f64 {
        let still = shapes::Ball { radius: p.x, ..Default::default() };
        let near = [ball, still].iter().map(|ball| ball.distance(p)).reduce(f64::min).unwrap();
        near * GAIN + shapes::pair(p).b * NODES.iter().map(|&(t, w)| w * (p * t).length_squared()).sum::<f64>()
    }

    /// The logarithm of a determinant, by Cholesky factorisation.
    #[differentiate(wrt(a))]
    pub(super) fn log_determinant(a: [[f64; 3]; 3]) -> f64 {
        let mut l = [[0.0f64; 3]; 3];
        for i in 0..3 {
            for j in 0..=i {
                let s: f64 = (0..j).map(|k| l[i][k] * l[j][k]).sum();
                let a = if i == j { a[i][i] + 8.0 } else { a[i][j] };
                l[i][j] = if i == j { (a - s).sqrt() } else { (a - s) / l[j][j] };
            }
        }
        2.0 * (0..3).map(|i| l[i][i].ln()).sum::<f64>()
    }

    fn root(x: f64) -> Option<f64> {
        if x > 0.0 { Some(x.abs().sqrt()) } else { None }
    }

    fn ray(from: DVec3, along: DVec3, radius: f64) -> Option<f64> {
        let (b, c) = (from.dot(along), from.length_squared() - radius * radius);
        let root = root(b * b - along.length_squared() * c)?;
        if root > b { Some((root - b) / along.length_squared()) } else { None }
    }

    #[differentiate(wrt(from, along))]
    pub(super) fn hit(from: DVec3, along: DVec3) -> f64 {
        assert!(along != DVec3::ZERO, "a ray has a direction");
        let Some(near) = ray(from, along, 2.0) else { return from.length() };
        match ray(from, along, 3.0) {
            Some(far) if far > 2.0 * near => far - near,
            Some(far) => far * near,
            None => unreachable!("the larger one is hit, too"),
        }
    }

    #[derive(Clone, Copy)]
    pub(super) struct Spring {
        pub(super) rest: f64,
        pub(super) most: Option<f64>,
    }

    #[differentiate(wrt(x), lanes)]
    pub(super) fn optional(x: f64, spring: &Spring, away: Option<(DVec3, bool)>) -> f64 {
        let off = match spring.most {
            Some(most) if x > most => most - spring.rest,
            _ => x - spring.rest,
        };
        let Some((from, true)) = away else { return off * off };
        off * off + (DVec3::X * x).distance(from)
    }

    #[differentiate(wrt(x))]
    pub(super) fn iterators(x: [f64; 5], y: f64) -> [f64; 4] {
        let (mut level, mut error) = (y, 0.0);
        x.iter().for_each(|&v| {
            error += (v - level).powi(2);
            level += 0.3 * (v - level);
        });
        let best = x.iter().map(|v| (v - y).powi(2)).min_by(|a, b| a.partial_cmp(b).unwrap()).unwrap();
        let most = x.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0.0, |(i, v)| i as f64 * v);
        let pooled: f64 = x.chunks(2).map(|pair| pair.iter().product::<f64>()).sum();
        [
            error,
            best,
            most,
            [[pooled, y], [x[0], x[1]]].iter().flatten().zip(core::iter::zip(x, x)).map(|(v, (a, b))| v * a * b).sum(),
        ]
    }

    #[differentiate(wrt(v, w))]
    pub(super) fn shifted(v: DVec2, w: DVec4) -> (DVec2, DVec4) {
        ((v + 0.5) * 2.0 / (1.0 + v * v) + (1.0 - v), (w - 0.25) / (2.0 + w * w) + 1.0 / (w * w + 1.0))
    }

    #[differentiate(wrt(w))]
    pub(super) fn in_order(w: DVec4) -> DVec4 {
        DVec4 { w: w.x, z: w.y, y: w.z, x: w.w * w.w }
    }

    #[differentiate(wrt(tangent(q), tangent(m)))]
    pub(super) fn turned(q: DQuat, other: DQuat, m: DMat3) -> (f64, [f64; 9], [[f64; 3]; 3]) {
        (q.angle_between(other), m.to_cols_array(), (m * m).to_cols_array_2d())
    }

    #[differentiate(wrt(angle, eye, p))]
    #[expect(deprecated, reason = "still in use")]
    pub(super) fn seen(angle: f64, eye: DVec3, p: DVec3) -> (DVec3, DVec3) {
        let at = eye + DVec3::new(0.1, -0.2, 1.5);
        let (right, left) = (DMat4::look_at_rh(eye, at, DVec3::Y), DMat4::look_at_lh(eye, at, DVec3::Y));
        let open = 1.0 + 0.2 * angle.sin();
        let q = eye + DVec3::new(0.1, 0.2, 4.0) + 0.1 * p;
        (
            DMat4::perspective_rh(open, 1.5, 0.1, 100.0).project_point3(right.transform_point3(q)),
            (DMat4::perspective_lh(open, 1.5, 0.1, 100.0) * left).project_point3(q),
        )
    }

    #[differentiate(wrt(x, p))]
    pub(super) fn by_parts(x: [[f64; 3]; 3], p: DVec3) -> [f64; 4] {
        let m = DMat3::from_cols_array_2d(&x);
        let (a, b, c) = (m * p).into();
        let flat = DMat2::from_cols_array_2d(&[[a, b], [c, p.x]]);
        let homogeneous =
            DMat4::from_mat3(m) * DMat4::from_cols_array_2d(&[[a; 4], [b, c, 1.0, 0.0], [0.5; 4], [a, b, c, 2.0]]);
        let [low, high] = flat.col(1).into();
        let (row, col) = (homogeneous.row(1), homogeneous.col(3));
        [flat.row(0).dot(flat.col(0)), low * high, row.dot(col), row.w]
    }

    #[differentiate(wrt(p))]
    pub(super) fn folded(p: DVec3) -> f64 {
        let (mut p, mut size) = (p, 1.0);
        for _ in 0..3 {
            p = p.abs() - 1.0;
            if p.x < p.y {
                core::mem::swap(&mut p.x, &mut p.y);
            }
            let mut longer = 2.0 * size;
            core::mem::swap(&mut size, &mut longer);
            p *= 2.0 + if (-0.5..0.5).contains(&p.z) { longer } else { 0.0 };
        }
        p.length() / size + if (..=p.x).contains(&p.y) { p.z } else { 0.0 }
    }
}

#[track_caller]
fn same(found: &[f64], expected: &[f64]) {
    let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs() / (1.0 + b.abs())).fold(0.0, f64::max);
    assert!(found.len() == expected.len() && off < 1e-13, "{found:?} instead of {expected:?}");
}

#[test]
fn companions_compute_what_rust_means() {
    use functions::*;
    let mut random = aim_objectives::Random::new(7);
    for _ in 0..200 {
        let [a, b, c, d, e] = <[f64; 5]>::try_from(random.numbers(5, -2.0..2.0)).expect("five");
        let (p, q) = (DVec3::new(a, b, c), DVec3::new(d, e, a * e));
        same(&[defaults_gradient(a).0], &[defaults(a)]);
        let m = [[a, b, c], [b, d, e], [c, e, a]];
        same(&by_parts_jacobian(m, q).0, &by_parts(m, q));
        same(&[folded_gradient(p).0], &[folded(p)]);
        same(&[log_determinant_gradient(m).0], &[log_determinant(m)]);
        same(&[hit_gradient(p, q).0], &[hit(p, q)]);
        let spring = Spring { rest: b, most: (c > 0.0).then_some(d) };
        for away in [None, Some((q, false)), Some((q, true))] {
            let (value, (slope,)) = optional_gradient(a, &spring, away);
            same(&[value], &[optional(a, &spring, away)]);
            let number = |truth: bool| if truth { 1.0 } else { 0.0 };
            let most = (number(spring.most.is_some()), spring.most.unwrap_or(0.0));
            let (from, on) = away.unwrap_or_default();
            let away = (number(away.is_some()), (from.to_array(), number(on)));
            assert_eq!(optional_gradient_lanes(a, &(b, most), away), (value, (slope,)));
        }
        same(&iterators_jacobian([a, b, c, d, e], b).0, &iterators([a, b, c, d, e], b));
        let ((v, w), _) = shifted_jacobian(DVec2::new(a, b), DVec4::new(a, c, d, e));
        let expected = shifted(DVec2::new(a, b), DVec4::new(a, c, d, e));
        same(&[v.x, v.y, w.x, w.y, w.z, w.w], &[expected.0.to_array().as_slice(), &expected.1.to_array()].concat());
        same(&in_order_jacobian(DVec4::new(a, b, c, d)).0.to_array(), &in_order(DVec4::new(a, b, c, d)).to_array());
        let (q0, q1) = (DQuat::from_scaled_axis(p), DQuat::from_scaled_axis(q));
        let (found, _) = turned_jacobian(q0, q1, DMat3::from_quat(q0));
        let expected = turned(q0, q1, DMat3::from_quat(q0));
        assert!((found.0 - expected.0).abs() < 1e-7, "{found:?} instead of {expected:?}");
        same(&found.1, &expected.1);
        same(found.2.as_flattened(), expected.2.as_flattened());
        let ((right, left), _) = seen_jacobian(a, p, q);
        let expected = seen(a, p, q);
        same(&right.to_array(), &expected.0.to_array());
        same(&left.to_array(), &expected.1.to_array());
    }
}

/// The angle between a rotation and itself has no slope; the derivative is 0.
#[test]
fn no_angle_between() {
    let (value, (by_q, _)) = functions::turned_jacobian(DQuat::IDENTITY, DQuat::IDENTITY, DMat3::IDENTITY);
    assert_eq!((value.0, by_q[0]), (0.0, DVec3::ZERO));
}

/// Traits of the module that are implemented for types of glam.
#[allow(dead_code, reason = "the check calls it")]
mod traits_of_glam {
    use aim::differentiate;
    use aim::glam::{DMat3, DVec3};

    #[differentiate(check = true)]
    mod ellipsoid {
        use super::{DMat3, DVec3};

        #[derive(Clone, Copy)]
        pub(super) struct Geodetic {
            pub(super) latitude: f64,
            pub(super) height: f64,
        }

        impl From<Geodetic> for DVec3 {
            fn from(of: Geodetic) -> Self {
                let (sin, cos) = of.latitude.sin_cos();
                Self::new(cos, 0.0, 0.99 * sin) + of.height * Self::new(cos, 0.0, sin)
            }
        }

        trait Crossed {
            const SIGN: f64;
            fn crossed(self) -> DMat3;
            fn twice(self, other: Self) -> Self;
            fn squared(self) -> DMat3
            where
                Self: Sized,
            {
                let once = Self::SIGN * self.crossed();
                once * once
            }
        }

        impl Crossed for DVec3 {
            const SIGN: f64 = -1.0;
            fn crossed(self) -> DMat3 {
                DMat3::from_cols(Self::new(0.0, self.z, -self.y), Self::new(-self.z, 0.0, self.x), self.cross(Self::Z))
            }
            fn twice(self, other: Self) -> Self {
                self.squared() * other
            }
        }

        #[differentiate(wrt(place, station))]
        pub(super) fn across(place: Geodetic, station: Geodetic, p: DVec3) -> DVec3 {
            let to: DVec3 = place.into();
            let away = to - DVec3::from(station);
            away.crossed() * p + p.twice(away) + DVec3::from([1.0, 2.0, away.x])
        }
    }
}

/// Masks: comparisons of vectors, number by number.
#[allow(dead_code, reason = "the check calls it")]
mod masks {
    use aim::differentiate;
    use aim::glam::{DMat3, DVec2, DVec3, DVec4, Vec3, Vec4Swizzles};

    #[differentiate(wrt(a, b), check = true)]
    pub(super) fn selected(a: DVec3, b: DVec3, w: DVec4) -> DVec3 {
        let less = a.cmplt(b);
        let least = DVec3::select(less, a, b * b);
        let more = DVec4::select(w.cmpge(DVec4::ZERO), w, w * a.x).xyz();
        let plane = DVec2::select(a.truncate().cmple(b.truncate()), a.truncate(), b.truncate() * a.y);
        let all = if less.all() { a.dot(b) } else { 0.0 };
        let any = if a.cmpgt(b).any() { a.x * b.y } else { 2.0 * a.x };
        let second = if less.test(1) && !less.x { b.z } else { -b.z };
        let turned = if (less & !b.cmpgt(a)).any() { 1e6 } else { a.z * a.z };
        least + more + plane.extend(all + any) + (second + turned) * DMat3::from_cols(a, b, a).diagonal()
    }

    #[differentiate(wrt(a), check = true)]
    pub(super) fn clamped(a: Vec3) -> Vec3 {
        Vec3::select(a.cmpne(Vec3::ONE), a.min(Vec3::ONE), a)
    }
}
