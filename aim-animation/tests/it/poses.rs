use aim_animation::glam::{Affine3A, DAffine3, DMat3, Mat3A, Quat, Vec3};
use aim_animation::{Bone, PoseError, Skeleton, Transform, attached, root_for};

use crate::common::{Rng, apart, exact};

/// Returns two trees whose bones are given children first.
pub(crate) fn skeleton() -> Skeleton {
    let parents = [Some(1), Some(3), Some(3), None, None, Some(2)];
    Skeleton::new(parents.into_iter().enumerate().map(|(i, parent)| Bone::new(format!("b{i}"), parent))).unwrap()
}

/// Returns each bone's transform in model space by its definition: the product of the transforms from the root outward.
fn model_exact(skeleton: &Skeleton, local: &[Transform]) -> Vec<DAffine3> {
    let product = |bone| skeleton.ancestry(bone).fold(DAffine3::IDENTITY, |below, at| exact(&local[at]) * below);
    (0..skeleton.len()).map(product).collect()
}

#[test]
fn conversion_to_model_space_is_invertible() {
    let (mut rng, skeleton) = (Rng(1), skeleton());
    for _ in 0..2000 {
        let local: Vec<Transform> = (0..6).map(|_| rng.transform()).collect();
        let mut model = [Affine3A::IDENTITY; 6];
        skeleton.to_model(&local, &mut model).unwrap();
        for (affine, truth) in model.iter().zip(model_exact(&skeleton, &local)) {
            assert!(apart(affine, &truth) < 5e-5, "{affine} {truth}");
        }
        let mut back = [Transform::IDENTITY; 6];
        skeleton.to_local(&model, &mut back).unwrap();
        for (a, b) in local.iter().zip(&back) {
            assert!(apart(&b.to_affine(), &exact(a)) < 5e-5, "{a:?} {b:?}");
        }
    }
}

#[test]
fn only_the_subtree_of_a_bone_is_recomputed() {
    let (mut rng, skeleton) = (Rng(2), skeleton());
    let mut local: Vec<Transform> = (0..6).map(|_| rng.transform()).collect();
    let mut model = [Affine3A::IDENTITY; 6];
    skeleton.to_model(&local, &mut model).unwrap();
    for bone in 0..6 {
        local[bone] = rng.transform();
        skeleton.to_model_below(bone, &local, &mut model).unwrap();
        let mut all = [Affine3A::IDENTITY; 6];
        skeleton.to_model(&local, &mut all).unwrap();
        assert_eq!(model, all);
    }
    skeleton.to_model_below(99, &local, &mut model).unwrap();
}

/// `turn_in_model` turns a bone's axes in model space, even under scaled and mirrored parents.
#[test]
fn turned_in_the_space_of_the_model() {
    let (mut rng, skeleton) = (Rng(3), skeleton());
    for case in 0..3000 {
        let mut local: Vec<Transform> = (0..6).map(|_| rng.transform()).collect();
        let bone = case % 6;
        // The bone's own scale may be non-uniform.
        local[bone].scale *= Vec3::new(1.0, 0.2, -4.0);
        let mut model = [Affine3A::IDENTITY; 6];
        skeleton.to_model(&local, &mut model).unwrap();
        let (rotation, before) = (rng.rotation(), local.clone());
        skeleton.turn_in_model(bone, rotation, &model, &mut local).unwrap();
        assert_eq!((local[bone].translation, local[bone].scale), (before[bone].translation, before[bone].scale));
        let (was, is) = (model_exact(&skeleton, &before)[bone], model_exact(&skeleton, &local)[bone]);
        let truth = DMat3::from_quat(rotation.as_dquat().normalize()) * was.matrix3;
        assert!(is.matrix3.abs_diff_eq(truth, 1e-4), "case {case}: {is} {truth}");
        assert!(is.translation.abs_diff_eq(was.translation, 1e-5));
    }
}

/// Under a parent of non-uniform scale no rotation is exact; the result is better than all nearby rotations.
#[test]
fn turned_under_a_parent_of_uneven_scale() {
    let mut rng = Rng(4);
    let skeleton = Skeleton::new([Bone::new("parent", None), Bone::new("bone", Some(0))]).unwrap();
    for _ in 0..200 {
        let mut local = [Transform { scale: Vec3::new(1.0, 1.3, 0.8), ..rng.rigid() }, rng.rigid()];
        let mut model = [Affine3A::IDENTITY; 2];
        skeleton.to_model(&local, &mut model).unwrap();
        let rotation = rng.rotation();
        let parent = model[0].matrix3;
        let wanted = parent.inverse() * Mat3A::from_quat(rotation) * parent * Mat3A::from_quat(local[1].rotation);
        // Only the directions of the columns count.
        let wanted = [wanted.x_axis, wanted.y_axis, wanted.z_axis].map(|column| column.normalize());
        let agreement = |turn: Quat| {
            let turn = Mat3A::from_quat(turn);
            [turn.x_axis, turn.y_axis, turn.z_axis].iter().zip(wanted).map(|(a, b)| a.dot(b)).sum::<f32>()
        };
        skeleton.turn_in_model(1, rotation, &model, &mut local).unwrap();
        let found = agreement(local[1].rotation);
        for _ in 0..50 {
            let near = Quat::from_scaled_axis(rng.vector(0.2));
            assert!(agreement(near * local[1].rotation) <= found + 1e-5);
        }
    }
}

#[test]
fn poses_that_do_not_fit_are_refused() {
    let skeleton = Skeleton::new([Bone::new("a", None), Bone::new("b", Some(0))]).unwrap();
    let (mut local, mut model) = ([Transform::IDENTITY; 2], [Affine3A::IDENTITY; 2]);
    let length = PoseError::Length { bones: 2, found: 1 };
    assert_eq!(skeleton.to_model(&local[..1], &mut model), Err(length));
    assert_eq!(skeleton.to_model(&local, &mut model[..1]), Err(length));
    assert_eq!(skeleton.to_model_below(0, &local, &mut model[..1]), Err(length));
    assert_eq!(skeleton.to_local(&model[..1], &mut local), Err(length));
    assert_eq!(skeleton.turn_in_model(0, Quat::IDENTITY, &model[..1], &mut local), Err(length));
    let flat = Affine3A { matrix3: Mat3A::ZERO, ..Affine3A::IDENTITY };
    local[1].translation.x = 7.0;
    let before = local;
    assert_eq!(skeleton.to_local(&[flat, Affine3A::IDENTITY], &mut local), Err(PoseError::Flat(0)));
    assert_eq!(local, before);
    skeleton.turn_in_model(1, Quat::from_rotation_x(1.0), &[flat, flat], &mut local).unwrap();
    assert_eq!(local, before, "nothing to turn in");
    // A leaf may have scale 0.
    skeleton.to_local(&[Affine3A::IDENTITY, flat], &mut local).unwrap();
    assert_eq!(local[1].scale, Vec3::ZERO);
    assert!(PoseError::Flat(3).to_string().contains("bone 3") && length.to_string().contains("2 bones"));
}

#[test]
fn attachments_follow_and_hold() {
    let mut rng = Rng(5);
    for _ in 0..2000 {
        let [hand, grip, bridge] = [0; 3].map(|_| rng.transform().to_affine());
        let gun = attached(&hand, &grip);
        assert!(gun.transform_point3(Vec3::ZERO).distance(hand.transform_point3(grip.translation.into())) < 1e-5);
        let root = root_for(&gun, &bridge).unwrap();
        assert!(attached(&root, &gun).abs_diff_eq(bridge, 1e-4), "the grip stays on the bridge");
    }
    assert_eq!(root_for(&Affine3A { matrix3: Mat3A::ZERO, ..Affine3A::IDENTITY }, &Affine3A::IDENTITY), None);
}
