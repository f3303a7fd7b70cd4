use aim_animation::glam::{DQuat, DVec3, Quat, Vec3};
use aim_animation::{Blender, Bone, Mask, Method, Motion, PoseError, Skeleton, Transform};

use crate::common::{Rng, angle_between};

fn skeleton(rng: &mut Rng) -> Skeleton {
    let bone = |parent, rest| Bone::new("b", parent).with_rest(rest);
    Skeleton::new([bone(None, rng.rigid()), bone(Some(0), rng.rigid()), bone(None, rng.rigid())]).unwrap()
}

fn pose(rng: &mut Rng) -> [Transform; 3] {
    [0; 3].map(|_| rng.transform())
}

#[test]
fn blends_of_two_poses_agree_with_their_definitions() {
    let mut rng = Rng(1);
    for case in 0..3000 {
        let skeleton = skeleton(&mut rng);
        let (a, b) = (pose(&mut rng), pose(&mut rng));
        let weight = rng.between(0.0, 1.0);
        let mask = Mask::new(&skeleton, 1.0).with_bone(2, 0.5).with_bone(1, 0.0);
        let method = [Method::Nlerp, Method::Slerp, Method::Log][case % 3];
        let blender = Blender::new(&skeleton).with_method(method).with_mask(&mask);
        let mut blended = a;
        blender.blend(&mut blended, &b, weight).unwrap();
        assert_eq!(blended[1], a[1], "masked out");
        for (bone, weight) in [(0, weight), (2, 0.5 * weight)] {
            let w = f64::from(weight);
            let lerp = |a: Vec3, b: Vec3| a.as_dvec3() * (1.0 - w) + b.as_dvec3() * w;
            let found = blended[bone];
            assert!(found.translation.as_dvec3().distance(lerp(a[bone].translation, b[bone].translation)) < 1e-6);
            assert!(found.scale.as_dvec3().distance(lerp(a[bone].scale, b[bone].scale)) < 1e-6);
            let [p, q] = [a, b].map(|pose| pose[bone].rotation.as_dquat().normalize());
            let truth = match method {
                Method::Nlerp => (p * (1.0 - w) + if p.dot(q) < 0.0 { -q } else { q } * w).normalize(),
                // The definition: p · (p⁻¹ q)^w along the shorter arc.
                Method::Slerp => p * power(p.conjugate() * q, w),
                Method::Log => {
                    let rest = skeleton.rest()[bone].rotation.as_dquat().normalize();
                    let [x, y] = [p, q].map(|rotation| vector(rest.conjugate() * rotation));
                    rest * DQuat::from_scaled_axis(x * (1.0 - w) + y * w)
                }
            };
            // Near half a turn, rounding decides which arc is the shorter one.
            if p.dot(q).abs() > 1e-4 {
                assert!(angle_between(found.rotation, truth) < 5e-6, "{method:?} {found:?} {truth}");
            }
        }
    }
}

/// Rotation vector of the shorter arc, radians.
fn vector(rotation: DQuat) -> DVec3 {
    let rotation = if rotation.w < 0.0 { -rotation } else { rotation };
    rotation.to_scaled_axis()
}

fn power(rotation: DQuat, exponent: f64) -> DQuat {
    DQuat::from_scaled_axis(vector(rotation) * exponent)
}

#[test]
fn weights_outside_zero_to_one_are_clamped() {
    let mut rng = Rng(2);
    let skeleton = skeleton(&mut rng);
    let (a, b) = (pose(&mut rng), pose(&mut rng));
    for method in [Method::Nlerp, Method::Slerp, Method::Log] {
        let blender = Blender::new(&skeleton).with_method(method);
        for (weight, end) in [(0.0, a), (f32::NAN, a), (-3.0, a), (1.0, b), (7.0, b)] {
            let mut blended = a;
            blender.blend(&mut blended, &b, weight).unwrap();
            for (found, end) in blended.iter().zip(&end) {
                assert_eq!((found.translation, found.scale), (end.translation, end.scale));
                assert!(angle_between(found.rotation, end.rotation.as_dquat()) < 2e-6, "{method:?} {weight}");
            }
        }
    }
}

#[test]
fn differences_are_added() {
    let mut rng = Rng(3);
    for _ in 0..1000 {
        let skeleton = skeleton(&mut rng);
        let (a, b) = (pose(&mut rng), pose(&mut rng));
        let mut differences = a;
        let blender = Blender::new(&skeleton);
        blender.difference(&a, &b, &mut differences).unwrap();
        let mut sum = a;
        blender.add(&mut sum, &differences, 1.0).unwrap();
        for (found, b) in sum.iter().zip(&b) {
            assert!(found.translation.distance(b.translation) < 1e-6 && found.scale.distance(b.scale) < 1e-5);
            assert!(angle_between(found.rotation, b.rotation.as_dquat()) < 2e-6);
        }
        let mask = Mask::subtree(&skeleton, 2);
        let mut masked = a;
        blender.with_mask(&mask).add(&mut masked, &differences, 1.0).unwrap();
        assert_eq!((masked[0], masked[1], masked[2]), (a[0], a[1], sum[2]));
        // Half of a difference is, by slerp, half of its angle applied after the animated rotation.
        let mut half = a;
        blender.with_method(Method::Slerp).add(&mut half, &differences, 0.5).unwrap();
        let truth = a[0].rotation.as_dquat() * power(differences[0].rotation.as_dquat().normalize(), 0.5);
        assert!(angle_between(half[0].rotation, truth) < 5e-6);
    }
}

/// Compares weighted sums with their definition in f64, for poses in any order.
#[test]
fn weighted_sums() {
    let mut rng = Rng(4);
    for case in 0..2000 {
        let skeleton = skeleton(&mut rng);
        let poses: Vec<[Transform; 3]> = (0..1 + case % 6).map(|_| pose(&mut rng)).collect();
        let weights: Vec<f32> = poses.iter().map(|_| rng.between(0.0, 1.0)).collect();
        let method = if case % 2 == 0 { Method::Nlerp } else { Method::Log };
        let blender = Blender::new(&skeleton).with_method(method);
        let mut inputs: Vec<(&[Transform], f32)> = poses.iter().map(|p| &p[..]).zip(weights.iter().copied()).collect();
        let mut sum = [Transform::IDENTITY; 3];
        blender.sum(&inputs, &mut sum).unwrap();
        let total: f64 = weights.iter().map(|w| f64::from(*w)).sum();
        let mut certain = [1.0; 3];
        for bone in 0..3 {
            let mean = |part: fn(&Transform) -> Vec3| {
                let parts = inputs.iter().map(|(pose, w)| part(&pose[bone]).as_dvec3() * f64::from(*w));
                parts.sum::<DVec3>() / total
            };
            assert!(sum[bone].translation.as_dvec3().distance(mean(|t| t.translation)) < 1e-5);
            assert!(sum[bone].scale.as_dvec3().distance(mean(|t| t.scale)) < 1e-5);
            let rest = skeleton.rest()[bone].rotation.as_dquat().normalize();
            let rotations = inputs.iter().map(|(pose, w)| (pose[bone].rotation.as_dquat(), f64::from(*w)));
            let (truth, certainty) = if method == Method::Nlerp {
                let alike = |q: DQuat| if q.dot(rest) < 0.0 { -q } else { q };
                let sum = rotations.fold(DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0), |sum, (q, w)| sum + alike(q) * w);
                (sum, sum.length() / total)
            } else {
                let vectors = rotations.map(|(q, w)| vector(rest.conjugate() * q) * w);
                (rest * DQuat::from_scaled_axis(vectors.sum::<DVec3>() / total), 1.0)
            };
            assert!(angle_between(sum[bone].rotation, truth) < 5e-6 / certainty, "{method:?}");
            let side = sum[bone].rotation.as_dquat().dot(rest);
            assert!(method == Method::Log || side > -1e-6, "not in the hemisphere of the rest pose");
            certain[bone] = certainty;
        }
        inputs.reverse();
        if inputs.len() > 2 {
            inputs.swap(0, 1);
        }
        let mut other = [Transform::IDENTITY; 3];
        blender.sum(&inputs, &mut other).unwrap();
        for ((a, b), certainty) in sum.iter().zip(&other).zip(certain) {
            assert!(a.translation.distance(b.translation) < 1e-6 && a.scale.distance(b.scale) < 1e-6);
            // If rotations nearly cancel, normalising the short sum magnifies rounding errors.
            let apart = f64::from((a.rotation - b.rotation).length());
            assert!(apart < 1e-6 / certainty.min(1.0), "{a:?} {b:?}");
        }
    }
}

/// `q` and `-q` give the same sum, even half a turn away from the rest pose.
#[test]
fn both_signs_of_a_quaternion_give_the_same_sum() {
    let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
    let blender = Blender::new(&skeleton);
    let mut rng = Rng(5);
    let sum = |rotations: &[(Quat, f32)]| {
        let poses: Vec<[Transform; 1]> = rotations.iter().map(|(q, _)| [Transform::from_rotation(*q)]).collect();
        let inputs: Vec<_> = poses.iter().zip(rotations).map(|(pose, (_, w))| (&pose[..], *w)).collect();
        let mut out = [Transform::IDENTITY];
        blender.sum(&inputs, &mut out).unwrap();
        out[0].rotation
    };
    for case in 0..2000 {
        let axis = rng.vector(1.0).normalize();
        let q = if case % 2 == 0 { rng.rotation() } else { Quat::from_xyzw(axis.x, axis.y, axis.z, 0.0) };
        let (v, w) = (rng.between(0.1, 1.0), rng.between(0.1, 1.0));
        for other in [q, -q] {
            let mean = sum(&[(q, v), (other, w)]);
            assert!(angle_between(mean, q.as_dquat()) < 1e-6, "{q} {other} {mean}");
            assert!((mean - sum(&[(other, w), (q, v)])).length() < 1e-6);
            // Half a turn from the rest pose, the first nonzero component is positive.
            let first = mean.to_array().into_iter().find(|part| part.abs() > 1e-6).unwrap();
            assert!(case % 2 == 0 || first > 0.0, "{mean}");
        }
        // Without any weight the sum is the rest pose.
        assert_eq!(sum(&[(q, 0.0), (-q, f32::NAN)]), Quat::IDENTITY);
    }
    // Inputs of weight 0 have no effect, even if they are not finite.
    let nonsense = Quat::from_xyzw(f32::INFINITY, f32::NAN, 0.0, 0.0);
    assert_eq!(sum(&[(Quat::IDENTITY, 0.5), (nonsense, 0.0)]), Quat::IDENTITY);
    let nowhere = [Transform::from_translation(Vec3::splat(f32::NAN))];
    let mut out = nowhere;
    blender.sum(&[(&[Transform::IDENTITY], 0.5), (&nowhere, 0.0)], &mut out).unwrap();
    assert_eq!(out, [Transform::IDENTITY]);
    assert_eq!(sum(&[]), Quat::IDENTITY);
}

#[test]
fn masks_weight_each_bone() {
    let mut rng = Rng(6);
    let skeleton = skeleton(&mut rng);
    let mask = Mask::subtree(&skeleton, 0);
    assert_eq!(mask.weights(), [1.0, 1.0, 0.0]);
    assert_eq!(mask.clone().inverted().weights(), [0.0, 0.0, 1.0]);
    let mask = mask.with_bone(1, 2.0).with_subtree(&skeleton, 2, f32::NAN).with_bone(9, 1.0);
    assert_eq!(mask.weights(), [1.0, 1.0, 0.0]);
    assert_eq!(Mask::subtree(&skeleton, 9).weights(), [0.0; 3]);
    // With a mask, the sum fades to the rest pose.
    let a = pose(&mut rng);
    let mut out = a;
    Blender::new(&skeleton).with_mask(&mask).sum(&[(&a, 0.3)], &mut out).unwrap();
    assert!(out[0].translation.distance(a[0].translation) < 1e-6);
    assert_eq!(out[2].translation, skeleton.rest()[2].translation);
}

#[test]
fn poses_of_other_lengths_are_refused() {
    let mut rng = Rng(7);
    let skeleton = skeleton(&mut rng);
    let other = Skeleton::new([]).unwrap();
    let (mut a, b) = (pose(&mut rng), pose(&mut rng));
    let before = a;
    let short = Err(PoseError::Length { bones: 3, found: 2 });
    let blender = Blender::new(&skeleton);
    assert_eq!(blender.blend(&mut a, &b[..2], 1.0), short);
    assert_eq!(blender.add(&mut a[..2], &b, 1.0), short);
    assert_eq!(blender.sum(&[(&b[..2], 1.0)], &mut a), short);
    assert_eq!(blender.difference(&b, &b, &mut a[..2]), short);
    let mask = Mask::new(&other, 1.0);
    let foreign = Err(PoseError::Length { bones: 3, found: 0 });
    assert_eq!(blender.with_mask(&mask).blend(&mut a, &b, 1.0), foreign);
    assert_eq!(a, before);
}

/// Weights too small to be normalised without losing all precision count as 0.
#[test]
fn denormal_weights_count_as_zero() {
    let skeleton = Skeleton::new([Bone::new("b", None)]).unwrap();
    let turned = [Transform::new(Vec3::X, Quat::from_rotation_y(1.0))];
    for (weight, expected) in [(1e-20, turned[0]), (3e-39, skeleton.rest()[0]), (1e-45, skeleton.rest()[0])] {
        let mut pose = [Transform::IDENTITY];
        Blender::new(&skeleton).sum(&[(&turned[..], weight)], &mut pose).unwrap();
        assert!(pose[0].translation.distance(expected.translation) < 1e-6, "{weight}: {pose:?}");
        assert!(pose[0].rotation.angle_between(expected.rotation) < 1e-3, "{weight}: {pose:?}");
        let delta = Motion::blend([(turned[0], weight)]);
        assert!(delta.translation.distance(expected.translation) < 1e-6, "{weight}: {delta:?}");
    }
}
