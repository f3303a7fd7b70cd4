//! Layers on a figure, checked by forward kinematics and by their definitions in f64.

use aim_animation::glam::{Affine3A, DAffine3, DQuat, DVec3, Quat, Vec3};
use aim_animation::{
    AimLine, AimPoseError, AimPoseSet, AimPosesLayer, Bone, Clip, ClipControl, Figure, Instance, Layer, LimbError,
    LimbLayer, Mask, Model, Motion, PoseError, Recoil, Root, RootPath, Skeleton, TipTarget, Track, Transform,
};

use crate::common::{Rng, angle_between, apart, exact};

/// Hips, chest, and two arms of two bones and a hand, with random bone axes.
pub(crate) fn body(rng: &mut Rng) -> Skeleton {
    let at = |x, y, z| Vec3::new(x, y, z);
    let places = [
        ("hips", None, at(0.0, 1.0, 0.0)),
        ("chest", Some(0), at(0.0, 1.4, 0.0)),
        ("left_arm", Some(1), at(0.2, 1.4, 0.0)),
        ("left_forearm", Some(2), at(0.25, 1.13, -0.03)),
        ("left_hand", Some(3), at(0.22, 0.9, 0.1)),
        ("right_arm", Some(1), at(-0.2, 1.4, 0.0)),
        ("right_forearm", Some(5), at(-0.25, 1.13, -0.03)),
        ("right_hand", Some(6), at(-0.22, 0.9, 0.1)),
    ];
    let model: Vec<DAffine3> = places
        .iter()
        .map(|(_, _, place)| DAffine3::from_rotation_translation(rng.rotation().as_dquat(), place.as_dvec3()))
        .collect();
    let bones = places.iter().enumerate().map(|(bone, &(name, parent, _))| {
        let local = parent.map_or(model[bone], |parent| model[parent].inverse() * model[bone]);
        let (_, rotation, translation) = local.to_scale_rotation_translation();
        Bone::new(name, parent).with_rest(Transform::new(translation.as_vec3(), rotation.as_quat()))
    });
    Skeleton::new(bones).unwrap()
}

pub(crate) const LEFT: [usize; 3] = [2, 3, 4];
const RIGHT: [usize; 3] = [5, 6, 7];

/// Returns each bone's transform in model space, by forward kinematics in f64.
pub(crate) fn model(figure: &Figure) -> Vec<DAffine3> {
    let mut model: Vec<DAffine3> = Vec::new();
    for (local, parent) in figure.local().iter().zip(figure.skeleton().parents()) {
        model.push(parent.map_or(exact(local), |parent| model[parent] * exact(local)));
    }
    model
}

fn world(figure: &Figure, bone: usize) -> DAffine3 {
    exact(&figure.place) * model(figure)[bone]
}

pub(crate) fn assert_consistent(figure: &Figure) {
    for (bone, (found, expected)) in figure.model().iter().zip(model(figure)).enumerate() {
        assert!(apart(found, &expected) < 1e-5, "bone {bone}: {found:?}, not {expected:?}");
    }
}

#[test]
fn local_and_model_poses_stay_consistent() {
    let mut rng = Rng(1);
    for _ in 0..50 {
        let mut figure = Figure::new(body(&mut rng));
        assert_consistent(&figure);
        let rest = figure.local().to_vec();
        figure.place = rng.rigid();
        figure
            .edit(|local| {
                local.iter_mut().for_each(|bone| bone.rotation = rng.rotation());
                Ok::<(), PoseError>(())
            })
            .unwrap();
        assert_consistent(&figure);
        let (bone, turn, by) = (rng.below(8), rng.rotation(), rng.vector(0.5));
        let before = model(&figure);
        figure.turn(bone, turn);
        figure.shift(bone, by);
        assert_consistent(&figure);
        let (now, before) = (model(&figure)[bone], before[bone]);
        assert!(now.translation.distance(before.translation + by.as_dvec3()) < 1e-5, "{now:?}");
        let turned = turn.as_dquat().normalize() * DQuat::from_mat3(&before.matrix3);
        assert!(angle_between(DQuat::from_mat3(&now.matrix3).as_quat(), turned) < 1e-5, "{now:?}");
        figure.reset();
        assert_eq!(figure.local(), rest, "at rest again");
        assert_consistent(&figure);
    }
}

#[test]
fn layers_are_applied_in_order_from_the_rest_pose() {
    let mut figure = Figure::new(body(&mut Rng(2)));
    let rest = figure.local()[1].rotation;
    let turn = |by: Quat| {
        move |figure: &mut Figure, dt_s: f32| {
            assert_eq!(dt_s, 0.02);
            figure.turn(0, by);
            Ok(())
        }
    };
    let [a, b] = [Quat::from_rotation_x(0.5), Quat::from_rotation_y(0.7)];
    let expected = (b * a).as_dquat() * figure.local()[0].rotation.as_dquat();
    for _ in 0..3 {
        figure.run(0.02, &mut [&mut turn(a), &mut turn(b)]).unwrap();
        assert!(angle_between(figure.local()[0].rotation, expected) < 1e-6);
        assert_eq!(figure.local()[1].rotation, rest);
    }
    let fail = |_: &mut Figure, _: f32| Err(PoseError::Flat(3));
    let mut is_run = false;
    let mut last = |_: &mut Figure, _: f32| {
        is_run = true;
        Ok(())
    };
    assert_eq!(figure.run(0.02, &mut [&mut { fail }, &mut last]), Err(PoseError::Flat(3)));
    assert!(!is_run, "what comes after an error is not run");
}

#[test]
fn an_instance_is_a_layer() {
    let skeleton = body(&mut Rng(3));
    let stride = [0.0, 1.4].map(|z| skeleton.rest()[0].translation + Vec3::Z * z);
    let walk = Clip::new("walk").with_translation(0, Track::linear([0.0, 1.0], stride).unwrap());
    let path = RootPath::new(&walk, &skeleton, Root::Shadow { bone: 0, up: Vec3::Y }, 30.0).unwrap();
    let kind = Model::new(skeleton.clone(), [walk]).with_motion(0, Motion::linear(&path));
    let mut hero = Instance::new(&kind);
    hero.play(ClipControl::new(0));
    hero.advance(&kind, 0.5);
    let mut figure = Figure::new(skeleton.clone());
    figure.run(0.5, &mut [&mut hero.layer(&kind)]).unwrap();
    let mut local = skeleton.rest().to_vec();
    hero.pose(&kind, &mut local).unwrap();
    assert_eq!((figure.place, figure.local()), (hero.place, &local[..]));
    assert_consistent(&figure);
}

#[test]
fn limbs_meet_targets_in_any_space() {
    let mut rng = Rng(4);
    let mut met = 0;
    for _ in 0..300 {
        let skeleton = body(&mut rng);
        let mut figure = Figure::new(skeleton.clone());
        figure.place = rng.rigid();
        let mut hand = LimbLayer::new(&skeleton, LEFT).unwrap();
        let point = model(&figure)[2].translation.as_vec3() + rng.vector(0.28);
        let rotation = rng.rotation();
        let target_model = DAffine3::from_rotation_translation(rotation.as_dquat(), point.as_dvec3());
        // The same target in the space of the model, of the world and of the other hand.
        let from = |space: DAffine3| {
            let seen = space.inverse() * target_model;
            (seen.translation.as_vec3(), DQuat::from_mat3(&seen.matrix3).as_quat())
        };
        let (in_model, in_world) = (from(DAffine3::IDENTITY), from(exact(&figure.place).inverse()));
        let in_hand = from(model(&figure)[7]);
        let targets = [
            TipTarget::model(in_model.0).with_rotation(in_model.1),
            TipTarget::world(in_world.0).with_rotation(in_world.1),
            TipTarget::bone(7, in_hand.0).with_rotation(in_hand.1),
        ];
        for target in targets {
            hand.set_target(target);
            figure.run(0.01, &mut [&mut hand]).unwrap();
            assert_consistent(&figure);
            let tip = model(&figure)[4];
            let off = tip.translation.distance(point.as_dvec3());
            assert!((off - f64::from(hand.error())).abs() < 1e-5, "{off} is told as {}", hand.error());
            let turned = DQuat::from_mat3(&tip.matrix3);
            assert!(angle_between(rotation, turned) < 1e-4, "{:?}", target.space);
            met += usize::from(off < 1e-5);
        }
    }
    assert!(met > 700, "{met} of 900 within reach");
}

#[test]
fn limbs_fade_without_jumps_in_place_or_speed() {
    let skeleton = body(&mut Rng(5));
    let mut figure = Figure::new(skeleton.clone());
    let mut hand = LimbLayer::new(&skeleton, LEFT).unwrap().with_fade(0.3);
    let rest = model(&figure)[4].translation;
    let target = Vec3::new(0.4, 1.3, 0.2);
    let (dt, mut ways) = (1.0 / 240.0, Vec::new());
    for frame in 0..400 {
        match frame {
            20 => hand.set_target(TipTarget::model(target)),
            // Interrupted half-way, then set again.
            60 => hand.release(),
            75 => hand.set_target(TipTarget::model(target)),
            250 => hand.release(),
            _ => {}
        }
        figure.run(dt, &mut [&mut hand]).unwrap();
        ways.push(model(&figure)[4].translation);
    }
    let distance = f64::from(target.distance(rest.as_vec3()));
    assert!(ways[10].distance(rest) < 1e-6 && ways[390].distance(rest) < 1e-6, "left to the animation");
    assert!(ways[240].distance(target.as_dvec3()) < 1e-5, "there in time");
    // From rest, the quintic needs 5.8 · distance / time²; reversing a movement needs more.
    let bound = 12.0 * distance / (0.3 * 0.3);
    for (frame, w) in ways.windows(3).enumerate() {
        let acceleration = (w[2] - 2.0 * w[1] + w[0]).length() / f64::from(dt * dt);
        assert!(acceleration < bound, "{acceleration} of {bound} in frame {frame}");
    }
    // Without a fade the change is immediate; half of the weight covers half of the distance.
    hand.fade_s = 0.0;
    hand.weight = 0.5;
    hand.set_target(TipTarget::model(target));
    figure.run(dt, &mut [&mut hand]).unwrap();
    let half = rest.lerp(target.as_dvec3(), 0.5);
    assert!(model(&figure)[4].translation.distance(half) < 1e-5);
}

#[test]
fn limbs_of_more_than_two_bones_reach_their_target() {
    let skeleton = body(&mut Rng(6));
    let mut figure = Figure::new(skeleton.clone());
    let mut arm = LimbLayer::new(&skeleton, [1, 2, 3, 4]).unwrap();
    arm.set_target(TipTarget::model(Vec3::new(0.3, 1.5, 0.4)));
    figure.run(0.01, &mut [&mut arm]).unwrap();
    assert!(model(&figure)[4].translation.distance(DVec3::new(0.3, 1.5, 0.4)) < 1e-4);
    assert_eq!(LimbLayer::new(&skeleton, [2, 6]).unwrap_err(), LimbError::Bone(1));
    assert_eq!(LimbLayer::new(&skeleton, [2]).unwrap_err(), LimbError::Bone(1));
    assert_eq!(LimbLayer::new(&skeleton, [0, 99]).unwrap_err(), LimbError::Bone(1));
    let flat = Skeleton::new([Bone::new("a", None), Bone::new("b", Some(0))]).unwrap();
    assert_eq!(LimbLayer::new(&flat, [0, 1]).unwrap_err(), LimbError::Length);
}

/// Poses of chest and hips on a grid of headings and pitches; the hips sink when aiming down.
fn aiming(skeleton: &Skeleton) -> (Clip, Vec<f32>) {
    let (mut times, mut turns, mut sinks) = (Vec::new(), Vec::new(), Vec::new());
    for (row, pitch) in [-0.6_f32, 0.0, 0.5].into_iter().enumerate() {
        for (column, heading) in [-0.9_f32, -0.2, 0.4, 0.9].into_iter().enumerate() {
            times.push(f32::from(u8::try_from(4 * row + column).unwrap()));
            turns.push(Quat::from_rotation_y(heading) * Quat::from_rotation_x(pitch) * skeleton.rest()[1].rotation);
            sinks.push(skeleton.rest()[0].translation - Vec3::Y * 0.2 * (pitch + 0.6));
        }
    }
    let clip = Clip::new("aim").with_rotation(1, Track::linear(times.clone(), turns).unwrap());
    (clip.with_translation(0, Track::linear(times.clone(), sinks).unwrap()), times)
}

/// Returns the angle by which an aim line misses a point, radians.
fn missed(figure: &Figure, line: &AimLine, target: Vec3) -> f64 {
    let bone = world(figure, line.bone);
    let to_target = target.as_dvec3() - bone.transform_point3(line.origin.as_dvec3());
    bone.transform_vector3(line.forward.as_dvec3()).angle_between(to_target)
}

fn straight_body() -> Skeleton {
    let at = |y| Transform::from_translation(Vec3::Y * y);
    let bone = |name, parent, y| Bone::new(name, parent).with_rest(at(y));
    Skeleton::new([bone("hips", None, 1.0), bone("chest", Some(0), 0.4), bone("head", Some(1), 0.3)]).unwrap()
}

#[test]
fn aim_poses_of_a_clip_meet_targets_with_their_translations() {
    let skeleton = straight_body();
    let (clip, times) = aiming(&skeleton);
    // A barrel beside the chest.
    let line = AimLine { bone: 1, origin: Vec3::new(-0.2, 0.1, 0.5), forward: Vec3::Z };
    let set = AimPoseSet::from_clip(&clip, &skeleton, &times, line).unwrap();
    let mut layer = AimPosesLayer::new(set.clone());
    let mut figure = Figure::new(skeleton.clone());
    let mut rng = Rng(7);
    for _ in 0..200 {
        figure.place = Transform::new(rng.vector(3.0), Quat::from_rotation_y(rng.between(-3.0, 3.0)));
        let [heading, pitch] = [rng.between(-0.7, 0.7), rng.between(-0.4, 0.35)];
        let ahead = Quat::from_rotation_y(heading) * Quat::from_rotation_x(pitch) * (Vec3::Z * rng.between(4.0, 20.0));
        layer.target = figure.place.to_affine().transform_point3(ahead + Vec3::Y * 1.4);
        figure.run(0.01, &mut [&mut layer]).unwrap();
        assert_consistent(&figure);
        let off = missed(&figure, &line, layer.target);
        assert!(off < 2e-3, "{off} rad aside, {:?}", layer.outcome());
    }
    // A target on the aim line of one pose gives exactly that pose, including the sunken hips.
    let (pose, mut local) = (6, skeleton.rest().to_vec());
    clip.sample(times[pose], &mut clip.cursor(), &mut local);
    figure.place = Transform::IDENTITY;
    figure
        .edit(|own| {
            own.copy_from_slice(&local);
            Ok::<(), PoseError>(())
        })
        .unwrap();
    let bone = world(&figure, 1);
    let muzzle = bone.transform_point3(line.origin.as_dvec3());
    layer.target = (muzzle + bone.transform_vector3(DVec3::Z) * 1e4).as_vec3();
    figure.run(0.01, &mut [&mut layer]).unwrap();
    assert!(figure.local()[0].translation.distance(local[0].translation) < 2e-3, "{:?}", figure.local()[0]);
    assert!(figure.local()[0].translation.y < 0.9, "the hips sink");
    // A masked set does not move the hips, and the line still meets the target; at weight 0 nothing changes.
    let mask = Mask::new(&skeleton, 1.0).with_bone(0, 0.0);
    let mut masked = AimPosesLayer::new(set.with_mask(&mask));
    masked.target = layer.target;
    figure.run(0.01, &mut [&mut masked]).unwrap();
    assert_eq!(figure.local()[0], skeleton.rest()[0]);
    assert!(missed(&figure, &line, layer.target) < 2e-3);
    masked.weight = 0.0;
    figure.run(0.01, &mut [&mut masked]).unwrap();
    assert_eq!(figure.local(), skeleton.rest());
}

#[test]
fn poses_that_cannot_aim_are_refused() {
    let skeleton = straight_body();
    let (clip, times) = aiming(&skeleton);
    let line = AimLine { bone: 1, origin: Vec3::ZERO, forward: Vec3::Z };
    let made = |times: &[f32], line| AimPoseSet::from_clip(&clip, &skeleton, times, line).map(|_| ());
    assert_eq!(made(&times, AimLine { bone: 9, ..line }), Err(AimPoseError::Bone(9)));
    assert_eq!(made(&times, AimLine { forward: Vec3::ZERO, ..line }), Err(AimPoseError::Direction(0)));
    assert_eq!(made(&[0.0, 1.0, 0.0], line), Err(AimPoseError::Direction(2)));
    assert_eq!(made(&times[..2], line), Err(AimPoseError::Flat));
    assert_eq!(made(&[], line), Err(AimPoseError::Flat));
}

#[test]
fn recoil_is_critically_damped_at_any_frame_rate() {
    let skeleton = body(&mut Rng(8));
    let grip = Affine3A::from_rotation_translation(Quat::from_rotation_y(0.4), Vec3::new(0.02, 0.1, 0.0));
    let (push, climb) = (Vec3::new(0.0, 0.0, -2.0), Vec3::new(-6.0, 0.5, 0.0));
    for frames in [1_u8, 7, 60] {
        let mut recoil = Recoil::new(&skeleton, RIGHT, grip).unwrap();
        let mut figure = Figure::new(skeleton.clone());
        let gun = |figure: &Figure| {
            let hand = model(figure)[7];
            hand * DAffine3::from_rotation_translation(
                DQuat::from_mat3(&grip.matrix3.as_dmat3()),
                Vec3::from(grip.translation).as_dvec3(),
            )
        };
        let held = gun(&figure);
        // Two shots at once; kicks that are not finite are ignored.
        recoil.kick(push * 0.25, climb * 0.75);
        recoil.kick(Vec3::NAN, Vec3::INFINITY);
        recoil.kick(push * 0.75, climb * 0.25);
        for _ in 0..frames {
            figure.run(0.08 / f32::from(frames), &mut [&mut recoil]).unwrap();
        }
        // x = v·t·e^(−ωt), in the gun's own space before the recoil.
        let (t, rate) = (0.08_f64, 15.0_f64);
        let factor = t * (-rate * t).exp();
        let [offset, turn] = [push, climb].map(|v| v.as_dvec3() * factor);
        let expected = held * DAffine3::from_rotation_translation(DQuat::from_scaled_axis(turn), offset);
        let found = gun(&figure);
        assert!(found.translation.distance(expected.translation) < 2e-4, "{found:?}, not {expected:?}");
        let turned = DQuat::from_mat3(&expected.matrix3);
        assert!(angle_between(DQuat::from_mat3(&found.matrix3).as_quat(), turned) < 1e-3, "in {frames} frames");
    }
}

#[test]
fn a_figure_hung_on_a_grip_stays_on_it() {
    let mut rng = Rng(9);
    for _ in 0..50 {
        let skeleton = body(&mut rng);
        let mut figure = Figure::new(skeleton.clone());
        let turns: Vec<Quat> = (0..8).map(|_| rng.rotation()).collect();
        figure
            .edit(|local| {
                local.iter_mut().zip(&turns).for_each(|(bone, turn)| bone.rotation = *turn);
                Ok::<(), PoseError>(())
            })
            .unwrap();
        let (grip, bar) = (rng.rigid().to_affine(), rng.rigid());
        let kind = Model::new(skeleton, []);
        let mut hero = Instance::new(&kind);
        let hand = hero.attach(7, grip);
        assert!(figure.hang(7, &grip, &bar.to_affine()) && hero.hang(hand, figure.model(), &bar.to_affine()));
        assert_eq!(figure.place, hero.place);
        let grip = DAffine3::from_mat3_translation(grip.matrix3.as_dmat3(), Vec3::from(grip.translation).as_dvec3());
        assert!(apart(&(world(&figure, 7) * grip).as_affine3a(), &exact(&bar)) < 2e-5);
        let before = figure.place;
        assert!(
            !figure.hang(9, &Affine3A::IDENTITY, &bar.to_affine()) && !hero.hang(1, figure.model(), &bar.to_affine())
        );
        assert!(!figure.hang(7, &Affine3A::from_scale(Vec3::splat(f32::NAN)), &bar.to_affine()));
        assert_eq!((figure.place, hero.place), (before, before));
    }
}

#[test]
fn layers_of_another_skeleton_are_refused() {
    let (skeleton, other) = (body(&mut Rng(10)), straight_body());
    let mut figure = Figure::new(other.clone());
    let (clip, times) = aiming(&skeleton);
    let line = AimLine { bone: 1, origin: Vec3::ZERO, forward: Vec3::Z };
    let mut limb = LimbLayer::new(&skeleton, LEFT).unwrap();
    limb.set_target(TipTarget::model(Vec3::ZERO));
    let mut recoil = Recoil::new(&skeleton, LEFT, Affine3A::IDENTITY).unwrap();
    recoil.kick(Vec3::ONE, Vec3::ONE);
    let mut poses = AimPosesLayer::new(AimPoseSet::from_clip(&clip, &skeleton, &times, line).unwrap());
    let refused = PoseError::Length { bones: 8, found: 3 };
    for layer in [&mut limb as &mut dyn Layer, &mut recoil, &mut poses] {
        assert_eq!(figure.run(0.1, &mut [layer]), Err(refused));
    }
    let kind = Model::new(skeleton.clone(), []);
    let mut hero = Instance::new(&kind);
    assert_eq!(figure.run(0.1, &mut [&mut hero.layer(&kind)]), Err(refused));
    assert_eq!(figure.local(), other.rest(), "nothing is written");
}
