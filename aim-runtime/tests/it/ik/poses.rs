use core::f64::consts::PI;

use aim_runtime::glam::{Affine3A, Mat3A, Quat, Vec3};
use aim_runtime::ik::{Local, PoseError, add, attached, blend, difference, nlerp, root_for, slerp, to_local, to_model};

use crate::common::Rng;
use crate::common::exact::*;

const PARENTS: [Option<usize>; 5] = [None, Some(0), Some(1), Some(0), None];

fn any_local(rng: &mut Rng) -> Local {
    Local {
        translation: rng.direction(),
        rotation: any_turn(rng),
        scale: Vec3::splat(rng.between(0.5, 2.0) * if rng.below(4) == 0 { -1.0 } else { 1.0 }),
    }
}

fn any_turn(rng: &mut Rng) -> Quat {
    Quat::from_axis_angle(rng.direction(), rng.between(-3.1, 3.1))
}

fn same(a: &Affine3A, b: &Affine3A) -> bool {
    a.abs_diff_eq(*b, 1e-5)
}

#[test]
fn to_the_model_and_back() {
    let mut rng = Rng(1);
    for _ in 0..2000 {
        let local: [Local; 5] = core::array::from_fn(|_| any_local(&mut rng));
        let mut model = [Affine3A::IDENTITY; 5];
        to_model(&PARENTS, &local, &mut model).unwrap();
        let leaf = [0, 1, 2].map(|bone: usize| {
            Affine3A::from_scale_rotation_translation(local[bone].scale, local[bone].rotation, local[bone].translation)
        });
        assert!(same(&model[2], &(leaf[0] * leaf[1] * leaf[2])));
        let mut back = [Local::IDENTITY; 5];
        to_local(&PARENTS, &model, &mut back).unwrap();
        for (a, b) in local.iter().zip(&back) {
            assert!(same(&a.to_affine(), &b.to_affine()), "{a:?} {b:?}");
        }
    }
}

#[test]
fn what_does_not_fit() {
    let (local, mut model) = ([Local::IDENTITY; 2], [Affine3A::IDENTITY; 2]);
    assert_eq!(to_model(&[None], &local, &mut model), Err(PoseError::Lengths));
    assert_eq!(to_model(&[None, Some(1)], &local, &mut model), Err(PoseError::ParentAfter(1)));
    assert_eq!(to_model(&[Some(7), None], &local, &mut model), Err(PoseError::ParentAfter(0)));
    let flat = Affine3A { matrix3: Mat3A::ZERO, ..Affine3A::IDENTITY };
    let mut untouched = local;
    assert_eq!(to_local(&[None, Some(0)], &[flat, flat], &mut untouched), Err(PoseError::Flat(0)));
    assert_eq!(blend(&mut untouched, &local[..1], 1.0, None), Err(PoseError::Lengths));
    assert_eq!(add(&mut untouched, &local, 1.0, Some(&[1.0])), Err(PoseError::Lengths));
    assert_eq!(untouched, local);
    assert!(PoseError::ParentAfter(3).to_string().contains("bone 3"));
}

#[test]
fn between_rotations() {
    let mut rng = Rng(2);
    for _ in 0..20_000 {
        let (a, b, weight) = (any_turn(&mut rng), any_turn(&mut rng), rng.between(0.0, 1.0));
        let whole = angle_of(b * a.conjugate());
        for (between, is_even) in [(slerp as fn(_, _, _) -> _, true), (nlerp, false)] {
            let part: Quat = between(a, b, weight);
            assert!(is_sound(part));
            let [before, after] = [angle_of(part * a.conjugate()), angle_of(b * part.conjugate())];
            // On the short way, whichever of its two quaternions a rotation is given by.
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
fn blended_and_added() {
    let mut rng = Rng(3);
    for _ in 0..2000 {
        let [a, b]: [[Local; 3]; 2] = core::array::from_fn(|_| core::array::from_fn(|_| any_local(&mut rng)));
        let mut pose = a;
        blend(&mut pose, &b, 1.0, Some(&[1.0, 0.0, 0.5])).unwrap();
        assert!(same(&pose[0].to_affine(), &b[0].to_affine()) && pose[0].translation == b[0].translation);
        assert_eq!(pose[1], a[1], "masked out");
        assert!(pose[2].translation.distance(0.5 * (a[2].translation + b[2].translation)) < 1e-6);
        let mut pose = a;
        blend(&mut pose, &b, f32::NAN, None).unwrap();
        assert_eq!(pose, a);

        let differences: [Local; 3] = core::array::from_fn(|bone| difference(&a[bone], &b[bone]));
        let mut pose = a;
        add(&mut pose, &differences, 1.0, None).unwrap();
        for (sum, b) in pose.iter().zip(&b) {
            assert!(same(&sum.to_affine(), &b.to_affine()), "{sum:?} {b:?}");
        }
        let mut pose = a;
        add(&mut pose, &differences, 1.0, Some(&[0.0, 1.0, 0.0])).unwrap();
        assert_eq!((pose[0], pose[2]), (a[0], a[2]));
    }
}

#[test]
fn held_and_holding_on() {
    let mut rng = Rng(4);
    for _ in 0..2000 {
        let [hand, grip, bridge] = core::array::from_fn(|_| any_local(&mut rng).to_affine());
        let gun = attached(&hand, &grip);
        assert!(gun.transform_point3(Vec3::ZERO).distance(hand.transform_point3(grip.translation.into())) < 1e-5);
        let root = root_for(&gun, &bridge).unwrap();
        assert!(attached(&root, &gun).abs_diff_eq(bridge, 1e-4), "the grip stays on the bridge");
    }
    assert_eq!(root_for(&Affine3A { matrix3: Mat3A::ZERO, ..Affine3A::IDENTITY }, &Affine3A::IDENTITY), None);
}

#[test]
fn whatever_the_bits() {
    let mut rng = Rng(5);
    for _ in 0..100_000 {
        let n: [f32; 9] = numbers(&mut rng);
        let [a, b] = [0, 4].map(|at| Quat::from_slice(&n[at..]));
        assert!(is_sound(slerp(a, b, n[8])) && is_sound(nlerp(a, b, n[8])), "{a} {b} {}", n[8]);
        let local = Local { rotation: a, ..Local::IDENTITY };
        assert!(is_sound(difference(&local, &Local { rotation: b, ..local }).rotation));
        let mut pose = [local];
        blend(&mut pose, &[Local { rotation: b, ..local }], 0.5, None).unwrap();
        assert!(is_sound(pose[0].rotation));
    }
}
