//! No panic, and unit rotations and finite numbers where they are promised, whatever the bits.

use aim_animation::glam::{Affine3A, Quat, Vec3};
use aim_animation::{Blender, Bone, Method, Skeleton, SkewedTransform, Transform};
use proptest::prelude::*;

fn any_float() -> impl Strategy<Value = f32> {
    prop_oneof![any::<u32>().prop_map(f32::from_bits), -2.0_f32..2.0, Just(0.0), Just(f32::NAN), Just(f32::INFINITY)]
}

fn any_transform() -> impl Strategy<Value = Transform> {
    prop::array::uniform10(any_float()).prop_map(|n| Transform {
        translation: Vec3::from_slice(&n),
        rotation: Quat::from_slice(&n[3..]),
        scale: Vec3::from_slice(&n[7..]),
    })
}

fn is_unit(rotation: Quat) -> bool {
    (rotation.length() - 1.0).abs() < 1e-5
}

proptest! {
    #[test]
    fn affine_maps(n in prop::array::uniform12(any_float())) {
        let affine = Affine3A::from_cols_array(&n);
        if let Some(parts) = Transform::from_affine(&affine) {
            prop_assert!(parts.is_sound() && is_unit(parts.rotation), "{parts:?}");
        }
        if let Some(parts) = SkewedTransform::from_affine(&affine) {
            prop_assert!(parts.transform.is_sound(), "{parts:?}");
        }
    }

    #[test]
    fn skeletons(parents in prop::collection::vec(prop::option::of(0_usize..12), 0..12), rest in any_transform()) {
        let bones = parents.iter().map(|&parent| Bone::new("b", parent).with_rest(rest));
        if let Ok(skeleton) = Skeleton::new(bones) {
            let local = skeleton.rest().to_vec();
            let mut model = vec![Affine3A::IDENTITY; local.len()];
            skeleton.to_model(&local, &mut model).unwrap();
            let mut back = local.clone();
            if skeleton.to_local(&model, &mut back).is_ok() {
                prop_assert!(back.iter().all(Transform::is_sound), "{back:?}");
            }
        }
    }

    #[test]
    fn blends(poses in prop::array::uniform3(any_transform()), weight in any_float(), which in 0_usize..3) {
        let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
        let method = [Method::Nlerp, Method::Slerp, Method::Log][which];
        let blender = Blender::new(&skeleton).with_method(method);
        let [a, b, c] = poses.map(|bone| [bone]);
        let mut out = a;
        blender.sum(&[(&a, weight), (&b, 1.0), (&c, 0.5)], &mut out).unwrap();
        prop_assert!(is_unit(out[0].rotation), "{out:?}");
        blender.blend(&mut out, &b, weight).unwrap();
        prop_assert!(is_unit(out[0].rotation), "{out:?}");
        blender.add(&mut out, &c, weight).unwrap();
        prop_assert!(is_unit(out[0].rotation), "{out:?}");
        out[0].turn(b[0].rotation);
        prop_assert!(is_unit(out[0].rotation), "{out:?}");
    }

    #[test]
    fn turns(transforms in prop::array::uniform2(any_transform()), rotation in any_transform()) {
        let skeleton = Skeleton::new([Bone::new("a", None), Bone::new("b", Some(0))]).unwrap();
        let mut local = transforms;
        let mut model = [Affine3A::IDENTITY; 2];
        skeleton.to_model(&local, &mut model).unwrap();
        skeleton.turn_in_model(1, rotation.rotation, &model, &mut local).unwrap();
        let turned = local[1].rotation;
        prop_assert!(turned.to_array().map(f32::to_bits) == transforms[1].rotation.to_array().map(f32::to_bits)
            || is_unit(turned), "{turned}");
    }
}
