//! Arithmetic of rotations, checked against definitions in f64.

use core::f64::consts::PI;

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::rotation::{exp, gram_schmidt, inverse, log, nearest_orthogonal, nlerp, shortest, slerp};

use crate::common::Rng;
use crate::common::exact::*;

fn any_turn(rng: &mut Rng) -> Quat {
    Quat::from_axis_angle(rng.direction(), rng.between(-3.1, 3.1))
}

#[test]
fn interpolation_has_constant_speed() {
    let mut rng = Rng(2);
    for _ in 0..20_000 {
        let (a, b, weight) = (any_turn(&mut rng), any_turn(&mut rng), rng.between(0.0, 1.0));
        let whole = angle_of(b * a.conjugate());
        for (between, is_even) in [(slerp as fn(_, _, _) -> _, true), (nlerp, false)] {
            let part: Quat = between(a, b, weight);
            assert!(is_sound(part));
            let [before, after] = [angle_of(part * a.conjugate()), angle_of(b * part.conjugate())];
            // Along the shorter arc, whichever of its two quaternions represents a rotation.
            assert!((before + after - whole).abs() < 2e-5 && whole < PI + 1e-6, "{before} + {after} of {whole}");
            assert!(angle_of(between(a, -b, weight) * part.conjugate()) < 1e-5 || whole > 3.1);
            if is_even {
                assert!((before - whole * f64::from(weight)).abs() < 2e-5);
            }
            assert!(angle_of(between(a, b, 0.0) * a.conjugate()) < 1e-6);
            assert!(angle_of(between(a, b, 1.0) * b.conjugate()) < 2e-6);
        }
    }
}

#[test]
fn exp_and_log_are_inverse() {
    let mut rng = Rng(3);
    for case in 0..20_000 {
        let angle = if case % 2 == 0 { rng.between(0.0, 3.1) } else { 10.0_f32.powf(rng.between(-12.0, 0.0)) };
        let vector = rng.direction() * angle;
        let rotation = exp(vector);
        // The definition: axis · sin(angle / 2), cos(angle / 2).
        let half = length(exact(vector)) / 2.0;
        let axis = if half > 0.0 { exact(vector).map(|c| c / (2.0 * half) * half.sin()) } else { [0.0; 3] };
        let truth = [axis[0], axis[1], axis[2], half.cos()];
        for (part, truth) in rotation.to_array().into_iter().zip(truth) {
            assert!((f64::from(part) - truth).abs() < 1e-6, "{rotation}: {truth}");
        }
        let error = (log(rotation) - vector).length();
        assert!(error < 1e-6 * (1.0 + angle) && error < 1e-5 * angle, "{vector}: off by {error}");
        assert!((log(-rotation) - log(rotation)).length() == 0.0);
    }
    // More than half a turn equals the remaining turn in the other direction.
    assert!((log(exp(Vec3::X * 4.0)) + Vec3::X * (core::f32::consts::TAU - 4.0)).length() < 1e-5);
    assert_eq!((log(Quat::IDENTITY), exp(Vec3::ZERO)), (Vec3::ZERO, Quat::IDENTITY));
}

/// The polar factor F is the rotation for which Fᵀ·M is symmetric and positive definite.
#[test]
fn the_nearest_rotation_is_the_polar_factor() {
    let mut rng = Rng(4);
    for case in 0..5000 {
        let turn = Mat3A::from_quat(any_turn(&mut rng));
        let mirrored = case % 3 == 0;
        let frame = if mirrored { turn * Mat3A::from_diagonal(Vec3::new(1.0, -1.0, 1.0)) } else { turn };
        let near = |m: &Mat3A, other: &Mat3A, by: f32| m.abs_diff_eq(*other, by);
        let scaled = frame * Mat3A::from_diagonal(Vec3::new(0.01, 1.0, 30.0));
        assert!(near(&nearest_orthogonal(scaled).unwrap(), &frame, 1e-6), "exact columns stay");
        assert!(near(&gram_schmidt(scaled).unwrap(), &frame, 1e-6));
        let skewed = Mat3A::from_cols(
            (frame.x_axis + frame.y_axis * rng.between(-0.7, 0.7)).normalize(),
            (frame.y_axis + frame.z_axis * rng.between(-0.7, 0.7)).normalize(),
            (frame.z_axis + frame.x_axis * rng.between(-0.7, 0.7)).normalize(),
        );
        let nearest = nearest_orthogonal(skewed).unwrap();
        let stretch = nearest.transpose() * skewed;
        assert!(near(&stretch, &stretch.transpose(), 2e-6), "{stretch}");
        assert!(near(&(nearest.transpose() * nearest), &Mat3A::IDENTITY, 1e-6));
        assert_eq!(nearest.determinant() < 0.0, mirrored);
    }
    assert_eq!(nearest_orthogonal(Mat3A::from_cols_array(&[1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0])), None);
}

#[test]
fn random_bits_are_harmless() {
    let mut rng = Rng(5);
    for _ in 0..100_000 {
        let n: [f32; 12] = numbers(&mut rng);
        let [a, b] = [0, 4].map(|at| Quat::from_slice(&n[at..]));
        assert!(is_sound(slerp(a, b, n[8])) && is_sound(nlerp(a, b, n[8])), "{a} {b} {}", n[8]);
        let [u, v] = [0, 3].map(|at| Vec3::from_slice(&n[at..]));
        assert!(is_sound(exp(u)), "{u}");
        assert!(is_sound(shortest(u, v)), "{u} {v}");
        assert!(log(a).length() < 1e-5 + core::f32::consts::PI, "{a}");
        let transform = Affine3A::from_cols_array(&n);
        assert!(inverse(&transform).is_none_or(|inverse| inverse.is_finite()), "{transform}");
        assert!(nearest_orthogonal(transform.matrix3).is_none_or(|frame| frame.is_finite()), "{transform}");
    }
}
