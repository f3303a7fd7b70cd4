use aim_animation::glam::{Affine3A, DAffine3, DMat3, DVec3, Mat3A, Quat, Vec3};
use aim_animation::{Skew, SkewedTransform, Transform};

use crate::common::{Rng, apart, exact};

#[test]
fn composition_and_decomposition_are_inverse() {
    let mut rng = Rng(1);
    for _ in 0..5000 {
        let mut transform = rng.transform();
        transform.scale *= Vec3::new(1.0, rng.between(0.1, 1.5), rng.between(-1.5, -0.1));
        let affine = transform.to_affine();
        assert!(apart(&affine, &exact(&transform)) < 5e-6);
        let parts = Transform::from_affine(&affine).unwrap();
        assert!(parts.is_sound());
        assert!(apart(&parts.to_affine(), &exact(&transform)) < 1e-5, "{transform:?} {parts:?}");
        assert!(parts.scale.y > 0.0 && parts.scale.z > 0.0, "a mirror is one along x");
    }
}

/// Decomposing a skewed map gives the lengths of its columns as scale and the rotation of its polar decomposition.
#[test]
fn skew_is_dropped_evenly() {
    let mut rng = Rng(2);
    for _ in 0..2000 {
        let skew = Skew { xy: rng.between(-1.0, 1.0), xz: rng.between(-1.0, 1.0), yz: rng.between(-1.0, 1.0) };
        let transform = Transform { scale: Vec3::new(1.0, 2.0, 0.3), ..rng.rigid() };
        let affine = SkewedTransform { transform, skew }.to_affine();
        let parts = Transform::from_affine(&affine).unwrap();
        let frame = Mat3A::from_quat(parts.rotation);
        let unit = [affine.matrix3.x_axis, affine.matrix3.y_axis, affine.matrix3.z_axis].map(|c| c.normalize());
        let stretch = frame.transpose() * Mat3A::from_cols(unit[0], unit[1], unit[2]);
        assert!(stretch.abs_diff_eq(stretch.transpose(), 1e-5), "{stretch}");
        assert!(parts.scale.abs_diff_eq(transform.scale, 1e-5));
    }
}

#[test]
fn a_skewed_transform_keeps_the_skew() {
    let mut rng = Rng(3);
    for case in 0..5000 {
        let affine = Affine3A {
            matrix3: Mat3A::from_cols(rng.vector(1.0).into(), rng.vector(1.0).into(), rng.vector(1.0).into()),
            translation: rng.vector(10.0).into(),
        };
        let exact = DAffine3::from_cols_array(&affine.to_cols_array().map(f64::from));
        let volume = exact.matrix3.determinant().abs();
        if volume < 0.01 {
            continue;
        }
        let parts = SkewedTransform::from_affine(&affine).unwrap();
        assert!(apart(&parts.to_affine(), &exact) < 1e-5, "case {case}: {parts:?}");
        assert_eq!(parts.transform.scale.x < 0.0, exact.matrix3.determinant() < 0.0);
        // Skew by its definition: the tangent of the angle by which y deviates from perpendicular to x.
        let DMat3 { x_axis, y_axis, .. } = exact.matrix3;
        let lean = DVec3::dot(x_axis.normalize(), y_axis.normalize()).asin().tan();
        let xy = f64::from(parts.skew.xy) * f64::from(parts.transform.scale.x.signum());
        assert!((xy - lean).abs() < 1e-4 * (1.0 + lean.abs()), "{xy} {lean}");
    }
    let square = SkewedTransform { transform: rng.rigid(), skew: Skew::NONE };
    assert_eq!(square.to_affine(), square.transform.to_affine());
    let [a, b] = [Skew { xy: 1.0, ..Skew::NONE }, Skew { yz: -2.0, ..Skew::NONE }];
    assert_eq!((a.lerp(b, 0.0), a.lerp(b, 1.0)), (a, b));
    assert_eq!(a.lerp(b, 0.5), Skew { xy: 0.5, xz: 0.0, yz: -1.0 });
}

#[test]
fn hidden_bones_decompose_and_invalid_maps_do_not() {
    let turn = Quat::from_rotation_y(0.7);
    for scale in [Vec3::new(0.0, 1.0, 2.0), Vec3::new(1.0, 0.0, 2.0), Vec3::new(3.0, 1.0, 0.0)] {
        let hidden = Transform { scale, ..Transform::from_rotation(turn) };
        let parts = Transform::from_affine(&hidden.to_affine()).unwrap();
        assert!(parts.scale.abs_diff_eq(scale, 1e-6) && parts.rotation.dot(turn).abs() > 1.0 - 1e-6, "{parts:?}");
    }
    let gone = Transform { scale: Vec3::ZERO, ..Transform::from_translation(Vec3::X) };
    assert_eq!(Transform::from_affine(&gone.to_affine()), Some(gone));
    let mut broken = Affine3A::IDENTITY;
    broken.translation.x = f32::NAN;
    assert_eq!(Transform::from_affine(&broken), None);
    assert_eq!(SkewedTransform::from_affine(&gone.to_affine()), None);
    assert!(!Transform { rotation: Quat::from_xyzw(0.0, 0.0, 0.0, 0.0), ..gone }.is_sound());
}

#[test]
fn rigid_products_and_inverses_are_exact() {
    let mut rng = Rng(4);
    for _ in 0..2000 {
        let [a, b] = [rng.rigid(), rng.rigid()];
        assert!(apart(&a.rigid_product(&b).to_affine(), &(exact(&a) * exact(&b))) < 2e-6);
        assert!(apart(&a.rigid_inverse().to_affine(), &exact(&a).inverse()) < 2e-6);
        assert!(apart(&a.rigid_product(&a.rigid_inverse()).to_affine(), &DAffine3::IDENTITY) < 2e-6);
    }
}

/// `Transform::turn` multiplies the map by the rotation from the right, even if the scale mirrors.
#[test]
fn turn_rotates_in_the_bones_own_space() {
    let mut rng = Rng(5);
    for case in 0..2000 {
        let sign = |bit: usize| if case >> bit & 1 == 1 { -1.0 } else { 1.0 };
        let mut transform = rng.rigid();
        transform.scale = Vec3::new(sign(0), sign(1), sign(2)) * rng.between(0.2, 3.0);
        let rotation = rng.rotation();
        let truth = exact(&transform) * exact(&Transform::from_rotation(rotation));
        transform.turn(rotation);
        assert!(apart(&transform.to_affine(), &truth) < 5e-6);
    }
}
