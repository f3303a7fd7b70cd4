use aim_animation::glam::{Quat, Vec3};
use aim_animation::{Bone, Skeleton, SkeletonError, Transform};

use crate::common::Rng;

/// Returns a random forest with its bones in shuffled order.
fn forest(rng: &mut Rng, len: usize) -> Vec<Bone> {
    let mut order: Vec<usize> = (0..len).collect();
    for i in (1..len).rev() {
        order.swap(i, rng.below(i + 1));
    }
    let mut bones = vec![Bone::new("", None); len];
    for (i, &source) in order.iter().enumerate() {
        let parent = (i > 0 && rng.below(5) > 0).then(|| order[rng.below(i)]);
        bones[source] = Bone::new(format!("b{source}"), parent).with_rest(rng.transform());
    }
    bones
}

#[test]
fn parents_may_come_in_any_order() {
    let mut rng = Rng(1);
    for len in 0..60 {
        let bones = forest(&mut rng, len);
        let skeleton = Skeleton::new(bones.clone()).unwrap();
        assert_eq!((skeleton.len(), skeleton.is_empty()), (len, len == 0));
        for (source, given) in bones.iter().enumerate() {
            let bone = skeleton.bone_of(source).unwrap();
            assert_eq!(skeleton.source_of(bone), Some(source));
            assert_eq!(skeleton.name(bone), Some(given.name.as_str()));
            assert_eq!(skeleton.find(&given.name), Some(bone));
            assert_eq!(skeleton.rest()[bone], given.rest);
            let parent = skeleton.parents()[bone];
            assert_eq!(parent, given.parent.map(|parent| skeleton.bone_of(parent).unwrap()));
            assert!(parent.is_none_or(|parent| parent < bone));
            // By definition: all bones that have this one among their ancestors.
            let below = |&other: &usize| skeleton.ancestry(other).any(|at| at == bone);
            let subtree: Vec<usize> = (0..len).filter(below).collect();
            assert_eq!(skeleton.subtree(bone).collect::<Vec<_>>(), subtree);
            let children: Vec<usize> = (0..len).filter(|&other| skeleton.parents()[other] == Some(bone)).collect();
            assert_eq!(skeleton.children(bone).collect::<Vec<_>>(), children);
            assert_eq!(skeleton.names()[bone], given.name);
        }
        // Sorting a sorted skeleton changes nothing.
        let again = (0..len).map(|bone| {
            Bone::new(skeleton.name(bone).unwrap(), skeleton.parents()[bone]).with_rest(skeleton.rest()[bone])
        });
        let again = Skeleton::new(again).unwrap();
        assert!((0..len).all(|bone| again.source_of(bone) == Some(bone)));
    }
}

#[test]
fn invalid_skeletons_are_refused() {
    let bone = |parent| Bone::new("b", parent);
    assert_eq!(Skeleton::new([bone(None), bone(Some(2))]), Err(SkeletonError::Parent { bone: 1, parent: 2 }));
    assert_eq!(Skeleton::new([bone(Some(0))]), Err(SkeletonError::Cycle(0)));
    // Bone 1 hangs on the cycle of 2 and 3, but is not part of it.
    let cycle = Skeleton::new([bone(None), bone(Some(2)), bone(Some(3)), bone(Some(2))]);
    assert!(matches!(cycle, Err(SkeletonError::Cycle(2 | 3))), "{cycle:?}");
    let bad = [
        Transform::from_translation(Vec3::X * f32::NAN),
        Transform::from_rotation(Quat::from_xyzw(0.0, 0.0, 0.0, 2.0)),
        Transform { scale: Vec3::splat(f32::INFINITY), ..Transform::IDENTITY },
    ];
    for rest in bad {
        assert_eq!(Skeleton::new([bone(None), bone(None).with_rest(rest)]), Err(SkeletonError::Rest(1)));
    }
    assert!(SkeletonError::Cycle(7).to_string().contains("bone 7"));
}

#[test]
fn repeated_names_are_found_in_order() {
    let skeleton = Skeleton::new(["a", "b", "a"].map(|name| Bone::new(name, None))).unwrap();
    assert_eq!((skeleton.find("a"), skeleton.find("b"), skeleton.find("c")), (None, Some(1), None));
    assert_eq!(skeleton.named("a").collect::<Vec<_>>(), [0, 2]);
    assert_eq!((skeleton.name(3), skeleton.bone_of(3), skeleton.source_of(3)), (None, None, None));
    assert!(skeleton.subtree(3).is_empty() && skeleton.ancestry(3).next().is_none());
}

/// A skeleton as deep as a linked list needs no recursion.
#[test]
fn very_deep_skeletons_do_not_overflow() {
    let len = 200_000;
    let bones = (0..len).map(|bone| Bone::new("", (bone + 1 < len).then_some(bone + 1)));
    let skeleton = Skeleton::new(bones).unwrap();
    assert_eq!(skeleton.source_of(0), Some(len - 1));
    assert_eq!(skeleton.subtree(0), 0..len);
}
