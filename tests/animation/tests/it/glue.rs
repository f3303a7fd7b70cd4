use aim::animation::{AimChain, AimChainError, AimFrame, Bone, Corrections, Skeleton, Transform};
use aim::glam::{Affine3A, DAffine3, DMat3, DQuat, DVec3, Quat, Vec3};
use aim::{Aim, AimRig, DynAim, Rig, Settings, Status};
use aim_animation_tests::{Hero, gait, skeleton};

/// A rig with a misspelt bone name: the skeleton has a bone `spine`, but no `spine_O3`.
#[derive(AimRig)]
#[aim(axes(up = +Y, forward = +Z, left = +X))]
struct Misspelt {
    #[joint(role = neck, heading = -60deg..=60deg, rate = 170deg)]
    neck: aim::Joint,
    #[joint(role = chest, heading = -20deg..=20deg, rate = 70deg, bone = "spine_O3")]
    spine: aim::Joint,
}

/// Returns each bone in model space, by the definition.
pub(crate) fn model(skeleton: &Skeleton, local: &[Transform]) -> Vec<DAffine3> {
    let mut model: Vec<DAffine3> = Vec::new();
    for (at, parent) in local.iter().zip(skeleton.parents()) {
        let own = DAffine3::from_scale_rotation_translation(
            at.scale.as_dvec3(),
            at.rotation.as_dquat().normalize(),
            at.translation.as_dvec3(),
        );
        model.push(parent.map_or(own, |parent| model[parent] * own));
    }
    model
}

/// Returns six kinds of parent transforms.
pub(crate) fn parents() -> [(&'static str, Transform); 6] {
    let turned = Transform::from_rotation(Quat::from_euler(aim::glam::EulerRot::XYZ, 0.3, -0.9, 0.4));
    [
        ("identity", Transform::IDENTITY),
        ("translated", Transform::from_translation(Vec3::new(3.0, -1.0, 2.0))),
        ("rotated", turned),
        ("scaled", Transform { scale: Vec3::splat(0.01), ..turned }),
        ("uneven", Transform { scale: Vec3::new(1.0, 1.2, 0.9), ..turned }),
        ("mirrored", Transform { scale: Vec3::new(-1.0, 1.0, 1.0), ..turned }),
    ]
}

pub(crate) struct Character {
    pub(crate) skeleton: Skeleton,
    pub(crate) local: Vec<Transform>,
    pub(crate) model: Vec<Affine3A>,
}

impl Character {
    pub(crate) fn new(armature: Transform, seconds: f32) -> Self {
        let skeleton = skeleton(armature);
        let mut local = skeleton.rest().to_vec();
        let clip = gait(&skeleton, "walk", 1.0, 0.0);
        clip.sample(seconds, &mut clip.cursor(), &mut local);
        let mut model = vec![Affine3A::IDENTITY; skeleton.len()];
        skeleton.to_model(&local, &mut model).unwrap();
        Self { skeleton, local, model }
    }

    pub(crate) fn bone(&self, name: &str) -> usize {
        self.skeleton.find(name).unwrap()
    }

    /// Returns the angle between an eye's direction and the direction to the target, in the space of the targets.
    fn error(&self, place: &Affine3A, eye: &str, target: Vec3) -> f64 {
        let at = DAffine3::from_cols_array(&place.to_cols_array().map(f64::from))
            * model(&self.skeleton, &self.local)[self.bone(eye)];
        at.transform_vector3(DVec3::Y).angle_between(target.as_dvec3() - at.translation)
    }
}

/// Returns a target a little up and to the left of a character on this armature.
fn target_for(character: &Character, place: &Affine3A) -> Vec3 {
    let armature = *place * character.model[0];
    armature.transform_point3(Vec3::new(0.7, 1.9, 2.0))
}

/// With every kind of parent, in model space and placed in a world, both eyes reach the target, as checked by
/// independent forward kinematics.
#[test]
fn both_eyes_reach_the_target() {
    let placed = Affine3A::from_scale_rotation_translation(Vec3::splat(1.5), Quat::from_rotation_y(2.0), Vec3::NEG_X);
    for place in [Affine3A::IDENTITY, placed] {
        for (name, armature) in parents() {
            let mut character = Character::new(armature, 0.0);
            let chain = AimChain::named(&character.skeleton, Hero::RIG).unwrap();
            let right = character.bone("right_eye");
            let chain = chain.with_other_eye(right).unwrap();
            let (mut frame, mut aim) = (chain.frame(), DynAim::new(Hero::RIG));
            frame.place = place;
            let target = target_for(&character, &place);
            let mut outcome = None;
            for step in 0..120_u8 {
                // The animation continues beneath the aim.
                character = Character::new(armature, 0.3 + 0.002 * f32::from(step));
                chain.gather(&mut frame, &mut character.local, &mut character.model).unwrap();
                assert_eq!(frame.model(), character.model, "the pose as it was gathered");
                outcome = Some(aim.aim(&frame.pose(), target, 1.0 / 60.0, &Settings::default()));
                let corrections = Corrections { joints: aim.corrections(), other_eye: aim.other_eye_correction() };
                chain.apply(&frame, corrections, &mut character.local, &mut character.model).unwrap();
            }
            let outcome = outcome.unwrap();
            let error = character.error(&place, "left_eye", target);
            assert!((error - f64::from(outcome.remaining)).abs() < 2e-4, "{name}: {error} {outcome:?}");
            if name != "uneven" {
                assert_eq!(outcome.status, Status::Reached, "{name}");
                let other = character.error(&place, "right_eye", target);
                assert!(error < 2e-3 && other < 2e-3, "{name}: {error} {other}");
            }
            // The returned model transforms are correct.
            for (found, truth) in character.model.iter().zip(model(&character.skeleton, &character.local)) {
                let found = DAffine3::from_cols_array(&found.to_cols_array().map(f64::from));
                assert!(found.abs_diff_eq(truth, 1e-5), "{name}");
            }
        }
    }
}

/// A joint mirrored by its own scale still aims correctly.
#[test]
fn joints_that_are_mirrored_themselves() {
    for mirror in [Vec3::new(-1.0, 1.0, 1.0), Vec3::new(1.0, -1.0, 1.0), Vec3::new(1.0, 1.0, -1.0), Vec3::NEG_ONE] {
        let mut character = Character::new(Transform::IDENTITY, 0.3);
        let spine = character.bone("spine");
        character.local[spine].scale = mirror;
        // The target is placed where the eye can turn to, whichever axes are mirrored.
        character.skeleton.to_model(&character.local, &mut character.model).unwrap();
        let chain = AimChain::named(&character.skeleton, Hero::RIG).unwrap();
        let target = character.model[spine].transform_point3(Vec3::new(0.8, 2.0, 0.7));
        let (mut frame, mut aim) = (chain.frame(), DynAim::new(Hero::RIG));
        chain.gather(&mut frame, &mut character.local, &mut character.model).unwrap();
        let outcome = aim.snap(&frame.pose(), target, &Settings::default());
        chain.apply(&frame, Corrections::from(&aim), &mut character.local, &mut character.model).unwrap();
        assert_eq!(outcome.status, Status::Reached, "{mirror}");
        assert!(aim.corrections().iter().all(|correction| correction.w < 0.99999), "{mirror}: every joint turns");
        let error = character.error(&Affine3A::IDENTITY, "left_eye", target);
        assert!(error < 2e-3, "{mirror}: {error}");
    }
}

fn aimed(character: &mut Character, chain: &AimChain) -> AimFrame {
    let (mut frame, mut aim) = (chain.frame(), DynAim::new(Hero::RIG));
    let target = target_for(character, &frame.place);
    chain.gather(&mut frame, &mut character.local, &mut character.model).unwrap();
    aim.snap(&frame.pose(), target, &Settings::default());
    let corrections = Corrections { joints: aim.corrections(), other_eye: aim.other_eye_correction() };
    chain.apply(&frame, corrections, &mut character.local, &mut character.model).unwrap();
    frame
}

/// The up direction is the model's below a lean of 45°, the trunk's own from 75° on, and a smooth blend between.
#[test]
fn who_lies_down_has_an_up_of_its_own() {
    let place = Affine3A::from_rotation_translation(Quat::from_rotation_z(0.7), Vec3::X);
    for lean_deg in [0.0_f64, 20.0, 44.9, 50.0, 60.0, 72.0, 75.1, 90.0, 170.0] {
        // Lean in an arbitrary direction, facing an arbitrary one.
        let lean = DQuat::from_axis_angle(DVec3::new(0.6, 0.0, -0.8), lean_deg.to_radians());
        let mut character = Character::new(Transform::IDENTITY, 0.0);
        let hips = character.bone("hips");
        let chain = AimChain::named(&character.skeleton, Hero::RIG).unwrap().with_standing_up(Vec3::Y, hips).unwrap();
        let rest = character.skeleton.rest()[hips].rotation.as_dquat();
        character.local[hips].rotation = (lean * DQuat::from_rotation_y(2.0) * rest).as_quat();
        character.skeleton.to_model(&character.local, &mut character.model).unwrap();
        let mut frame = chain.frame();
        frame.place = place;
        chain.gather(&mut frame, &mut character.local, &mut character.model).unwrap();
        let along = ((lean_deg - 45.0) / 30.0).clamp(0.0, 1.0);
        let share = along * along * (3.0 - 2.0 * along);
        let up = DVec3::Y.lerp(lean * DVec3::Y, share).normalize();
        let found = frame.pose().up.unwrap().as_dvec3();
        let wanted = DQuat::from_rotation_z(0.7) * up;
        assert!(found.abs_diff_eq(wanted, 1e-6), "{lean_deg}°: {found} is not {wanted}");
    }
}

/// Hips that lean below an upright chest belong to a character that sits, whose up direction is the model's.
#[test]
fn who_sits_does_not_lie() {
    for (chest_lean_deg, sits) in [(0.0_f64, true), (40.0, true), (80.0, false)] {
        let mut character = Character::new(Transform::IDENTITY, 0.0);
        let hips = character.bone("hips");
        let chain = AimChain::named(&character.skeleton, Hero::RIG).unwrap().with_standing_up(Vec3::Y, hips).unwrap();
        let chest = *chain.joints().last().unwrap();
        let at_rest = Quat::from_affine3(&character.model[chest].into());
        character.local[hips].rotation = Quat::from_rotation_x(-80_f32.to_radians()) * character.local[hips].rotation;
        character.skeleton.to_model(&character.local, &mut character.model).unwrap();
        let parent = character.skeleton.parents()[chest].unwrap();
        let carried = Quat::from_affine3(&character.model[parent].into());
        let lean = DQuat::from_rotation_x(-chest_lean_deg.to_radians()).as_quat();
        character.local[chest].rotation = carried.inverse() * lean * at_rest;
        character.skeleton.to_model(&character.local, &mut character.model).unwrap();
        let up = chain.up(&character.model).unwrap();
        assert_eq!(up.abs_diff_eq(Vec3::Y, 1e-6), sits, "{chest_lean_deg}°: {up}");
    }
}

/// A given bind pose is equivalent to the same pose at rest.
#[test]
fn a_bind_pose_beside_the_rest_pose() {
    for (name, armature) in parents() {
        let bound = Character::new(armature, 0.6);
        let at_rest = bound.skeleton.parents().iter().zip(bound.skeleton.names()).zip(&bound.local);
        let at_rest = at_rest.map(|((parent, name), local)| Bone::new(name.clone(), *parent).with_rest(*local));
        let at_rest = Skeleton::new(at_rest.collect::<Vec<_>>()).unwrap();
        let [given, known] = [&bound.skeleton, &at_rest].map(|skeleton| {
            let chain = AimChain::named(skeleton, Hero::RIG).unwrap();
            chain.with_other_eye(bound.bone("right_eye")).unwrap()
        });
        assert_ne!(given, known, "{name}");
        let [given, known] = [given.with_bind(&bound.model).unwrap(), known].map(|chain| {
            let mut character = Character::new(armature, 0.2);
            let mut frame = chain.frame();
            chain.gather(&mut frame, &mut character.local, &mut character.model).unwrap();
            frame
        });
        assert_eq!(given, known, "{name}");
    }
}

/// A following eye looks in joint 0's direction.
#[test]
fn the_other_eye_follows() {
    for (name, armature) in parents() {
        if name == "uneven" {
            continue;
        }
        let mut character = Character::new(armature, 0.0);
        let right = character.bone("right_eye");
        let chain = AimChain::named(&character.skeleton, Hero::RIG).unwrap().with_following_eye(right).unwrap();
        aimed(&mut character, &chain);
        let model = model(&character.skeleton, &character.local);
        let [left, right] = ["left_eye", "right_eye"].map(|eye| model[character.bone(eye)].matrix3);
        let scale = left.determinant().abs().cbrt();
        // Both have the same axes at rest and at the beginning of the gait.
        assert!((left * scale.recip()).abs_diff_eq(right * scale.recip(), 1e-5), "{name}");
        let turned = character.local[character.bone("left_eye")].rotation;
        assert!(turned.angle_between(character.skeleton.rest()[5].rotation) > 0.05, "{name}: it has turned");
    }
}

/// A clavicle under the neck keeps its place relative to the chest, or, without a carrier, in the animation.
#[test]
fn what_is_held_stays() {
    for (name, armature) in parents() {
        for carrier in [Some(2), None] {
            let mut character = Character::new(armature, 0.3);
            let clavicle = character.bone("left_clavicle");
            // Mirrored bones are held as well; a bone's own scale is kept.
            character.local[clavicle].scale = Vec3::new(1.1, -1.1, 1.1);
            character.skeleton.to_model(&character.local, &mut character.model).unwrap();
            // The rig itself names the clavicle.
            let chain = match carrier {
                Some(_) => AimChain::named(&character.skeleton, Hero::RIG).unwrap(),
                None => AimChain::new(&character.skeleton, [5, 3, 2]).unwrap().with_held(clavicle, 1, None).unwrap(),
            };
            let before = model(&character.skeleton, &character.local);
            aimed(&mut character, &chain);
            let after = model(&character.skeleton, &character.local);
            let on = |model: &[DAffine3], bone: usize| match carrier {
                Some(_) => model[character.bone("spine")].inverse() * model[bone],
                None => model[bone],
            };
            assert_eq!(character.local[clavicle].scale, Vec3::new(1.1, -1.1, 1.1));
            for bone in [clavicle, character.bone("left_arm")] {
                let (was, is) = (on(&before, bone), on(&after, bone));
                // Under uneven scale, a rotation can only approximate.
                let most = if name == "uneven" { 0.1 } else { 1e-4 };
                assert!(was.abs_diff_eq(is, most), "{name} {carrier:?}: {was} {is}");
            }
            let neck = character.bone("neck");
            assert!(!before[neck].abs_diff_eq(after[neck], 1e-3 * before[neck].matrix3.x_axis.length()), "{name}");
        }
    }
}

/// If the animation lets one eye drift, the other eye is made parallel before it is aimed.
#[test]
fn eyes_are_parallel_when_gathered() {
    for (name, armature) in parents() {
        if name == "uneven" {
            continue;
        }
        let mut character = Character::new(armature, 0.3);
        let right = character.bone("right_eye");
        let chain = AimChain::named(&character.skeleton, Hero::RIG).unwrap().with_other_eye(right).unwrap();
        let mut frame = chain.frame();
        let before = model(&character.skeleton, &character.local);
        chain.gather(&mut frame, &mut character.local, &mut character.model).unwrap();
        let after = model(&character.skeleton, &character.local);
        let drift = |model: &[DAffine3]| {
            let [a, b] = [5, right].map(|eye| model[eye].transform_vector3(DVec3::Y));
            a.angle_between(b)
        };
        assert!(drift(&before) > 0.05 && drift(&after) < 1e-5, "{name}");
        let pose = frame.pose();
        let found = pose.other_eye.unwrap();
        let truth = after[right];
        assert!(found.translation.as_dvec3().distance(truth.translation) < 1e-5, "{name}");
    }
}

/// The gathered pose: each joint in the space of the targets, without its own uneven scale; ranges relative to a rest
/// pose that the parent carries.
#[test]
fn what_is_gathered() {
    let mut character = Character::new(Transform::IDENTITY, 0.3);
    character.local[1].rotation = Quat::from_rotation_y(0.8) * character.local[1].rotation;
    character.local[3].scale = Vec3::new(1.5, 2.0, -3.0);
    character.skeleton.to_model(&character.local, &mut character.model).unwrap();
    let chain = AimChain::new(&character.skeleton, [5, 3, 2]).unwrap().with_up(Vec3::Y);
    let mut frame = chain.frame();
    frame.place = Affine3A::from_rotation_translation(Quat::from_rotation_x(0.2), Vec3::X);
    chain.gather(&mut frame, &mut character.local, &mut character.model).unwrap();
    let place = DAffine3::from_rotation_translation(DQuat::from_rotation_x(f64::from(0.2_f32)), DVec3::X);
    let now = model(&character.skeleton, &character.local);
    let rest = model(&character.skeleton, character.skeleton.rest());
    let pose = frame.pose();
    let close = |found: &Affine3A, truth: DAffine3| {
        let found = DAffine3::from_cols_array(&found.to_cols_array().map(f64::from));
        assert!(found.abs_diff_eq(truth, 1e-5), "{found} {truth}");
    };
    // The neck's own scale is removed, its mirroring is not.
    let unscaled = DMat3::from_diagonal(DVec3::new(1.0 / 1.5, 0.5, 1.0 / 3.0));
    close(&pose.joints[1], place * now[3] * DAffine3::from_mat3(unscaled));
    close(&pose.joints[2], place * now[2]);
    // The hips carry the rest pose.
    for (joint, bone) in [5, 3, 2].into_iter().enumerate() {
        close(&pose.bind.unwrap()[joint], place * now[1] * rest[1].inverse() * rest[bone]);
    }
    assert!(pose.up.unwrap().distance(Quat::from_rotation_x(0.2) * Vec3::Y) < 1e-6);
    let of_array = frame.pose_of::<3>().unwrap();
    assert_eq!((&of_array.joints[..], of_array.bind.as_ref().map(|bind| &bind[..])), (pose.joints, pose.bind));
    assert!(frame.pose_of::<2>().is_none());
}

/// A derived rig and the same rig behind a trait object give the same results.
#[test]
fn derived_and_dynamic() {
    let mut character = Character::new(Transform::IDENTITY, 0.2);
    let chain = AimChain::named(&character.skeleton, Hero::RIG).unwrap();
    let mut frame = chain.frame();
    chain.gather(&mut frame, &mut character.local, &mut character.model).unwrap();
    let rig: &dyn Rig = Hero::RIG;
    let (mut one, mut other) = (Aim::<Hero>::new(), DynAim::new(rig));
    for _ in 0..20 {
        let aimed = one.aim(&frame.pose_of().unwrap(), Vec3::new(1.0, 2.0, 3.0), 0.02, &Settings::default());
        let outcome = other.aim(&frame.pose(), Vec3::new(1.0, 2.0, 3.0), 0.02, &Settings::default());
        assert_eq!((&aimed.corrections[..], aimed.outcome), (other.corrections(), outcome));
    }
}

#[test]
fn what_is_no_chain() {
    let skeleton = skeleton(Transform::IDENTITY);
    let chain = |joints: &[usize]| AimChain::new(&skeleton, joints);
    assert_eq!(chain(&[]).unwrap_err(), AimChainError::Empty);
    assert_eq!(chain(&[5, 10]).unwrap_err(), AimChainError::Joint(1));
    assert_eq!(chain(&[5, 2, 3]).unwrap_err(), AimChainError::Order(2));
    assert_eq!(chain(&[5, 5]).unwrap_err(), AimChainError::Order(1));
    let good = chain(&[5, 3, 2]).unwrap();
    assert_eq!(good.joints(), [5, 3, 2]);
    for eye in [3, 10] {
        assert_eq!(good.clone().with_other_eye(eye).unwrap_err(), AimChainError::OtherEye);
        assert_eq!(good.clone().with_following_eye(eye).unwrap_err(), AimChainError::OtherEye);
    }
    for (bone, joint, carrier) in
        [(10, 1, None), (3, 2, None), (9, 1, None), (7, 3, None), (7, 1, Some(1)), (7, 1, Some(3))]
    {
        assert_eq!(good.clone().with_held(bone, joint, carrier).unwrap_err(), AimChainError::Held);
    }
    assert_eq!(good.clone().with_standing_up(Vec3::Y, 10).unwrap_err(), AimChainError::Trunk);
    assert!(good.clone().with_bind(&[Affine3A::IDENTITY; 9]).is_err());
    let nameless = Skeleton::new([]).unwrap();
    let unknown = |skeleton: &Skeleton, rig| match AimChain::named(skeleton, rig).unwrap_err() {
        AimChainError::Names { joint, names } => (joint, names),
        error => panic!("{error}"),
    };
    assert_eq!(unknown(&nameless, Hero::RIG), (0, vec!["left_eye".into()]));
    // A declared bone name is used even if it is misspelt; the field's name is no fallback.
    assert_eq!(unknown(&skeleton, Misspelt::RIG), (1, vec!["spine_O3".into()]));
    let (mut local, mut model) = (skeleton.rest().to_vec(), vec![Affine3A::IDENTITY; 10]);
    let mut foreign = chain(&[5]).unwrap().frame();
    assert!(good.gather(&mut foreign, &mut local, &mut model).is_err());
    assert!(good.gather(&mut good.frame(), &mut local[..9], &mut model).is_err());
    let none = Corrections { joints: &[], other_eye: None };
    assert!(good.apply(&good.frame(), none, &mut local, &mut model[..9]).is_err());
    // No corrections, no change.
    let mut frame = good.frame();
    good.gather(&mut frame, &mut local, &mut model).unwrap();
    good.apply(&frame, none, &mut local, &mut model).unwrap();
    assert_eq!(local, skeleton.rest());
}

/// If two bones share a name, the one that forms a chain with the others counts. A mesh often has the name of the bone
/// that moves it, as a sibling in the hierarchy.
#[test]
fn names_that_repeat() {
    let character = Character::new(Transform::IDENTITY, 0.0);
    let (skeleton, neck, eye) = (&character.skeleton, character.bone("neck"), character.bone("left_eye"));
    let bones = |more: &[(&str, Option<usize>)]| {
        let own = (0..skeleton.len()).map(|bone| Bone::new(skeleton.name(bone).unwrap(), skeleton.parents()[bone]));
        let more = more.iter().map(|(name, parent)| Bone::new(*name, *parent));
        Skeleton::new(own.chain(more)).unwrap()
    };
    // A mesh at the root, and an eye on another neck that carries nothing.
    let repeated = bones(&[("neck", Some(0)), ("left_eye", Some(0)), ("left_eye", None)]);
    let chain = AimChain::named(&repeated, Hero::RIG).unwrap();
    let sources: Vec<Option<usize>> = chain.joints().iter().map(|&bone| repeated.source_of(bone)).collect();
    assert_eq!(sources[..2], [Some(eye), Some(neck)]);
    // Two eyes on one neck are ambiguous.
    let error = AimChain::named(&bones(&[("left_eye", Some(neck))]), Hero::RIG).unwrap_err();
    assert!(matches!(error, AimChainError::Names { joint: 0, .. }), "{error:?}");
}

/// A chain reduced to the fewest bones gathers and applies the same as on all of them.
#[test]
fn reduced_to_the_fewest_bones() {
    for (name, armature) in parents() {
        let mut character = Character::new(armature, 0.3);
        let (right, hips) = (character.bone("right_eye"), 1);
        let whole = AimChain::named(&character.skeleton, Hero::RIG).unwrap();
        let whole = whole.with_other_eye(right).unwrap().with_standing_up(Vec3::Y, hips).unwrap();
        let (reduced, bones) = whole.reduced();
        assert!(bones.len() < character.skeleton.len(), "{name}: {bones:?}");
        assert_eq!(reduced.skeleton().len(), bones.len());
        assert_eq!(reduced.other_eye().map(|bone| bones[bone]), Some(right));
        let of = |chain: &AimChain| chain.joints().to_vec();
        assert_eq!(of(&reduced).iter().map(|&bone| bones[bone]).collect::<Vec<_>>(), of(&whole));

        let mut few = Character {
            local: bones.iter().map(|&bone| character.local[bone]).collect(),
            model: bones.iter().map(|&bone| character.model[bone]).collect(),
            skeleton: reduced.skeleton().clone(),
        };
        let [all_poses, few_poses] = [aimed(&mut character, &whole), aimed(&mut few, &reduced)];
        assert_eq!(all_poses.pose(), few_poses.pose(), "{name}");
        for (at, &bone) in bones.iter().enumerate() {
            assert_eq!(
                (few.local[at], few.model[at]),
                (character.local[bone], character.model[bone]),
                "{name}: {bone}"
            );
        }
    }
}
