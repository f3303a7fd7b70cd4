//! Characters that play several clips at once, compared with weighted sums in f64 and with each clip played alone.

use aim_animation::glam::{Affine3A, DQuat, DVec3, Quat, Vec3};
use aim_animation::{
    Bone, Clip, ClipControl, Control, Instance, Looping, Mask, Model, Motion, PoseError, Root, RootPath, Skeleton,
    Track, Transform,
};

use crate::common::{Rng, angle_between, apart, exact};

const LENGTHS: [f32; 3] = [1.0, 0.7, 1.3];

fn skeleton() -> Skeleton {
    let bone = |name, parent, y| Bone::new(name, parent).with_rest(Transform::from_translation(Vec3::Y * y));
    Skeleton::new([bone("hips", None, 0.9), bone("spine", Some(0), 0.3), bone("arm", Some(1), 0.2)]).unwrap()
}

/// Two clips that walk ahead and one that stays in place; only the last has tracks for the arm.
fn model(rng: &mut Rng) -> Model {
    let skeleton = skeleton();
    let clip = |number: usize, rng: &mut Rng| {
        let length = LENGTHS[number];
        let times = [0.0, 0.5 * length, length];
        let ahead = [1.4, 3.0, 0.0][number] * length;
        let places = [0.0, 0.4, 1.0].map(|part| Vec3::new(0.0, 0.9 + 0.1 * part * (1.0 - part), ahead * part));
        let turns = [0.0; 3].map(|_: f32| Quat::from_scaled_axis(rng.vector(0.5)));
        let clip = Clip::new("clip")
            .with_translation(0, Track::linear(times, places).unwrap())
            .with_rotation(1, Track::linear(times, turns).unwrap())
            .with_event(0.3 * length, ["left", "right", "wave"][number])
            .unwrap();
        if number == 2 { clip.with_rotation(2, Track::linear(times, turns).unwrap()) } else { clip }
    };
    let clips = [clip(0, rng), clip(1, rng), clip(2, rng)];
    let root = Root::Shadow { bone: 0, up: Vec3::Y };
    let motion = |clip: &Clip| Motion::variable(&RootPath::new(clip, &skeleton, root, 60.0).unwrap());
    let motions = [motion(&clips[0]), motion(&clips[1])];
    let arm = Mask::subtree(&skeleton, 2);
    let [walk, run] = motions;
    Model::new(skeleton, clips).with_motion(0, walk).with_motion(1, run).with_mask(arm)
}

/// Returns the pose of one clip at a time, without its root motion.
fn alone(model: &Model, clip: usize, time: f32) -> Vec<Transform> {
    let mut pose = model.skeleton().rest().to_vec();
    let clips = &model.clips()[clip];
    clips.sample(time, &mut clips.cursor(), &mut pose);
    if clip < 2 {
        // The root moves along z, linearly between the samples.
        pose[0].translation.z = 0.0;
    }
    pose
}

#[test]
fn poses_are_weighted_sums() {
    let mut rng = Rng(1);
    let model = model(&mut rng);
    for case in 0..300 {
        let mut hero = Instance::new(&model);
        let weights = [0; 3].map(|_| if rng.below(4) == 0 { 0.0 } else { rng.between(0.0, 1.0) });
        let masked = rng.below(2) == 0;
        for (clip, weight) in weights.into_iter().enumerate() {
            let control = Control::new().with_speed(rng.between(-2.0, 2.0)).at(rng.between(0.0, 0.7));
            let playing = ClipControl::new(clip).with_control(control).with_weight(weight);
            hero.play(if clip == 2 && masked { playing.with_mask(0) } else { playing });
        }
        let mut pose = vec![Transform::IDENTITY; 3];
        for _ in 0..3 {
            hero.advance(&model, 0.1);
            hero.pose(&model, &mut pose).unwrap();
        }
        let poses: Vec<Vec<Transform>> =
            hero.controls().iter().map(|playing| alone(&model, playing.clip, playing.control.time_s())).collect();
        for bone in 0..3 {
            let weight = |clip: usize| {
                let mask = if clip == 2 && masked && bone != 2 { 0.0 } else { 1.0 };
                f64::from(weights[clip]) * mask
            };
            let total: f64 = (0..3).map(weight).sum();
            let rest = &model.skeleton().rest()[bone];
            let (place, turn) = if total > 0.0 {
                let place = (0..3).map(|clip| poses[clip][bone].translation.as_dvec3() * weight(clip)).sum::<DVec3>();
                let none = DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0);
                // All rotations here are within half a turn of the rest pose's, which is the identity.
                let turns = (0..3).fold(none, |sum, clip| {
                    let turn = poses[clip][bone].rotation.as_dquat();
                    sum + if turn.w < 0.0 { -turn } else { turn } * weight(clip)
                });
                (place / total, turns)
            } else {
                (rest.translation.as_dvec3(), DQuat::IDENTITY)
            };
            assert!(pose[bone].translation.as_dvec3().distance(place) < 1e-5, "case {case}, bone {bone}");
            assert!(angle_between(pose[bone].rotation, turn) < 1e-5, "case {case}, bone {bone}");
        }
    }
}

/// One clip moves the character by its root motion, several by the weighted mean; a clip whose mask excludes the root
/// has no influence on it.
#[test]
fn the_place_moves_by_the_clips_motion() {
    let model = model(&mut Rng(2));
    let gone = |controls: &[ClipControl], seconds: u16| {
        let mut hero = Instance::new(&model);
        hero.place = Transform::new(Vec3::new(1.0, 0.0, 2.0), Quat::from_rotation_y(1.0));
        for control in controls {
            hero.play(*control);
        }
        for _ in 0..100 * seconds {
            hero.advance(&model, 0.01);
        }
        let ahead = hero.place.rotation.inverse() * (hero.place.translation - Vec3::new(1.0, 0.0, 2.0));
        assert!(
            ahead.with_z(0.0).length() < 1e-4 && hero.place.rotation.angle_between(Quat::from_rotation_y(1.0)) < 1e-4
        );
        ahead.z
    };
    let (walk, run, wave) = (ClipControl::new(0), ClipControl::new(1), ClipControl::new(2));
    // After seven seconds both clips are at their end.
    for (controls, way) in [
        (&[walk][..], 9.8),
        (&[run], 21.0),
        (&[walk.with_control(Control::new().with_speed(-2.0))], -19.6),
        (&[walk.with_weight(0.5), run.with_weight(0.25)], (2.0 * 9.8 + 21.0) / 3.0),
        // A clip without root motion counts in the mean, unless its mask excludes the root.
        (&[walk, wave], 4.9),
        (&[walk, wave.with_mask(0)], 9.8),
        (&[walk, wave.with_weight(0.0)], 9.8),
        (&[walk, ClipControl::new(3)], 9.8),
        (&[wave], 0.0),
        (&[], 0.0),
        (&[walk.with_control(Control::new().with_looping(Looping::Once))], 1.4),
    ] {
        let found = gone(controls, 7);
        assert!((found - way).abs() < 1e-3, "{controls:?}: {found} instead of {way}");
    }
}

/// A clip counts in the root motion by its weight for the moving bone, not for the first bone of the skeleton.
#[test]
fn masks_of_the_moving_bone_count() {
    let bones = [Bone::new("prop", None), Bone::new("hips", None), Bone::new("arm", Some(1))];
    let skeleton = Skeleton::new(bones).unwrap();
    let walk = Clip::new("walk").with_translation(1, Track::linear([0.0, 1.0], [Vec3::ZERO, 1.4 * Vec3::Z]).unwrap());
    let wave = Clip::new("wave").with_rotation(2, Track::constant(Quat::from_rotation_x(1.0)).unwrap());
    let path = RootPath::new(&walk, &skeleton, Root::Shadow { bone: 1, up: Vec3::Y }, 60.0).unwrap();
    let (body, arm) = (Mask::subtree(&skeleton, 1), Mask::subtree(&skeleton, 2));
    let model = Model::new(skeleton, [walk, wave]).with_motion(0, Motion::linear(&path));
    let model = model.with_mask(body).with_mask(arm);
    let mut hero = Instance::new(&model);
    hero.play(ClipControl::new(0).with_mask(0));
    hero.play(ClipControl::new(1).with_mask(1));
    hero.advance(&model, 0.5);
    assert!((hero.place.translation.z - 0.7).abs() < 1e-5, "{:?}", hero.place);
}

#[test]
fn events_of_all_clips_are_reported() {
    let model = model(&mut Rng(3));
    let mut hero = Instance::new(&model);
    let numbers = [0, 2, 1].map(|clip| hero.play(ClipControl::new(clip)));
    assert_eq!(numbers, [0, 1, 2]);
    let mut told = Vec::new();
    for _ in 0..5 {
        hero.advance(&model, 0.1);
        told.extend(hero.events(&model).map(|(number, event)| (number, event.name.clone())));
    }
    let told: Vec<(usize, &str)> = told.iter().map(|(number, name)| (*number, &name[..])).collect();
    // Events at 0.21, 0.3 and 0.39 s.
    assert_eq!(told, [(2, "right"), (0, "left"), (1, "wave")]);
    assert_eq!(hero.steps().len(), 3);
    assert!(hero.steps().iter().all(|step| (step.to_s() - step.from_s() - 0.1).abs() < 1e-5));
    // Stopped clips no longer play; the others go on.
    hero.stop(1);
    hero.stop(2);
    assert_eq!(hero.controls().iter().map(|playing| playing.clip).collect::<Vec<_>>(), [0, 1]);
    hero.controls_mut()[1].control.speed = 0.0;
    hero.advance(&model, 0.25);
    let times: Vec<f32> = hero.controls().iter().map(|playing| playing.control.time_s()).collect();
    assert!((times[0] - 0.75).abs() < 1e-5 && (times[1] - 0.5).abs() < 1e-5, "{times:?}");
}

/// Attached objects follow their bone in world space.
#[test]
fn attached_objects_follow_their_bones() {
    let mut rng = Rng(4);
    let model = model(&mut rng);
    let mut hero = Instance::new(&model);
    hero.place = rng.rigid();
    hero.play(ClipControl::new(2));
    hero.advance(&model, 0.4);
    let grips = [rng.rigid(), rng.rigid(), rng.rigid()];
    let numbers = [(2, grips[0]), (9, grips[1]), (0, grips[2])].map(|(bone, grip)| hero.attach(bone, grip.to_affine()));
    assert_eq!(numbers, [0, 1, 2]);
    let (mut local, mut posed) = (vec![Transform::IDENTITY; 3], [Affine3A::IDENTITY; 3]);
    hero.pose(&model, &mut local).unwrap();
    model.skeleton().to_model(&local, &mut posed).unwrap();
    let bones = [0, 1, 2].map(|bone| exact(&local[bone]));
    let [arm, hips] = [bones[0] * bones[1] * bones[2] * exact(&grips[0]), bones[0] * exact(&grips[2])];
    let things: Vec<(usize, Affine3A)> = hero.things(&posed).collect();
    // The second object is not attached to anything.
    assert_eq!(things.iter().map(|(number, _)| *number).collect::<Vec<_>>(), [0, 2]);
    for ((_, thing), truth) in things.iter().zip([arm, hips]) {
        assert!(apart(thing, &(exact(&hero.place) * truth)) < 1e-5);
    }
    hero.detach(0);
    hero.detach(2);
    assert_eq!(hero.things(&posed).collect::<Vec<_>>(), [(1, things[1].1)]);
}

#[test]
fn poses_of_other_lengths_are_refused() {
    let model = model(&mut Rng(5));
    let other =
        Model::new(Skeleton::new([Bone::new("b", None)]).unwrap(), []).with_motion(0, model.motion(0).unwrap().clone());
    assert!(other.motion(0).is_none() && other.clips().is_empty() && other.masks().is_empty());
    let mut hero = Instance::new(&model);
    hero.play(ClipControl::new(0).with_mask(3).with_weight(f32::NAN));
    hero.play(ClipControl::new(0).with_mask(3));
    let mut pose = vec![Transform::IDENTITY; 3];
    hero.pose(&model, &mut pose).unwrap();
    assert_eq!(pose, model.skeleton().rest(), "a mask that is not there has no weight");
    assert_eq!(hero.pose(&model, &mut pose[..2]), Err(PoseError::Length { bones: 3, found: 2 }));
    assert_eq!(hero.pose(&other, &mut pose[..1]), Err(PoseError::Length { bones: 1, found: 3 }));
}
