//! Root motion extracted from clips and applied again, against definitions in f64, for characters about 1.7 tall.

use aim_animation::glam::{Affine3A, DAffine3, DQuat, DVec3, Quat, Vec3};
use aim_animation::{
    Bone, Clip, Control, Looping, Marks, Motion, MotionError, Node, Parameter, Phase, Root, RootPath, Skeleton, Step,
    Track, Transform, Tree,
};

use crate::common::{Rng, angle_between, apart, exact};

/// Tolerance of a motion's positions and rotations, for a character 1.7 tall.
const MOST: f64 = 1.7e-5;

/// Returns a skeleton with a scaled root above the pelvis, as exporters write it, and a prop beside it.
fn skeleton() -> Skeleton {
    let armature = Transform { scale: Vec3::splat(0.5), ..Transform::from_rotation(Quat::from_rotation_x(-1.2)) };
    let bones = [
        Bone::new("armature", None).with_rest(armature),
        Bone::new("pelvis", Some(0)).with_rest(Transform::new(Vec3::new(0.2, 0.1, 1.9), Quat::from_rotation_y(0.4))),
        Bone::new("head", Some(1)).with_rest(Transform::from_translation(Vec3::Y)),
        Bone::new("prop", None).with_rest(Transform::from_translation(Vec3::X)),
    ];
    Skeleton::new(bones).unwrap()
}

const PELVIS: usize = 1;
const LENGTH: f32 = 1.3;

/// Returns a clip that places `PELVIS` in model space as `place` says. The keys are so dense that linear interpolation
/// between them does not matter.
fn clip_by(skeleton: &Skeleton, keys: u32, place: impl Fn(f64) -> DAffine3) -> Clip {
    let parent = exact(&skeleton.rest()[0]);
    #[expect(clippy::cast_possible_truncation, reason = "rounding is meant")]
    let times: Vec<f32> = (0..=keys).map(|key| LENGTH * (f64::from(key) / f64::from(keys)) as f32).collect();
    let local = times.iter().map(|time| (parent.inverse() * place(f64::from(*time))).to_scale_rotation_translation());
    let (rotations, places): (Vec<Quat>, Vec<Vec3>) = local.map(|(_, r, t)| (r.as_quat(), t.as_vec3())).unzip();
    Clip::new("clip")
        .with_translation(PELVIS, Track::linear(times.clone(), places).unwrap())
        .with_rotation(PELVIS, Track::linear(times, rotations).unwrap())
}

fn model(skeleton: &Skeleton, pose: &[Transform]) -> Vec<DAffine3> {
    (0..pose.len())
        .map(|bone| skeleton.ancestry(bone).fold(DAffine3::IDENTITY, |below, at| exact(&pose[at]) * below))
        .collect()
}

fn sampled(skeleton: &Skeleton, clip: &Clip, time: f32) -> Vec<Transform> {
    let mut pose = skeleton.rest().to_vec();
    clip.sample(time, &mut clip.cursor(), &mut pose);
    pose
}

fn rigid(transform: &Transform) -> DAffine3 {
    exact(transform)
}

/// Returns a screw motion by its definition: a rotation about a line and a translation along it.
fn screw(axis: DVec3, point: DVec3, rates: [f64; 2], time: f64) -> DAffine3 {
    let turn = DAffine3::from_quat(DQuat::from_axis_angle(axis, rates[0] * time));
    let to_line = DAffine3::from_translation(point);
    DAffine3::from_translation(axis * rates[1] * time) * to_line * turn * to_line.inverse()
}

/// A composite motion recovers a screw exactly; with the motion removed, the root stays where it began.
#[test]
fn a_composite_motion_recovers_screws() {
    let (mut rng, skeleton) = (Rng(1), skeleton());
    for case in 0..300 {
        let axis = rng.vector(1.0).normalize().as_dvec3();
        let point = rng.vector(1.5).as_dvec3();
        // Up to one and a half turns in the clip, and nearly straight motions.
        let turn = [rng.between(-7.0, 7.0), rng.between(-1e-3, 1e-3), rng.between(-2.0, 2.0)][case % 3];
        let rates = [f64::from(turn), f64::from(rng.between(-2.0, 2.0))];
        let angle = rates[0].abs() * f64::from(LENGTH);
        if (angle - std::f64::consts::TAU).abs() < 0.1 {
            continue;
        }
        let start = rigid(&rng.rigid());
        let clip = clip_by(&skeleton, 3000, |time| screw(axis, point, rates, time) * start);
        let path = RootPath::new(&clip, &skeleton, Root::Bone(PELVIS), 60.0).unwrap();
        let motion = Motion::composite(&path);
        // After nearly a whole turn, the radius is ill-conditioned.
        let certainty = if angle > 1.0 { (0.5 * angle).sin().abs() } else { 1.0 };
        let most = 0.5 * MOST / certainty;
        for _ in 0..20 {
            let time = rng.between(0.0, LENGTH);
            let truth = screw(axis, point, rates, f64::from(time));
            let found = motion.at(time);
            let root = start.translation;
            let (a, b) = (rigid(&found).transform_point3(root), truth.transform_point3(root));
            assert!(a.distance(b) < most, "case {case}: {:e}", a.distance(b));
            assert!(angle_between(found.rotation, DQuat::from_mat3(&truth.matrix3)) < MOST);
        }
        let found = motion.screw();
        let radius = (start.translation - point).reject_from(axis).length();
        let sign = rates[0].signum();
        if rates[0].abs() > 0.1 {
            assert!(found.axis.as_dvec3().distance(axis * sign) < 1e-4 / certainty);
            assert!((f64::from(found.turn_rad_s) - rates[0].abs()).abs() < 2e-5);
            assert!((f64::from(found.along_s) - rates[1] * sign).abs() < 1e-4 / certainty);
            let off = (found.point.unwrap().as_dvec3() - point).reject_from(axis).length();
            assert!(off < 1e-3 / certainty, "{off}");
        }
        let arc = radius * rates[0].abs();
        // A turn that cannot be told from none is treated as a translation.
        if rates[0].abs() > 0.1 {
            assert!((f64::from(found.arc_s) - arc).abs() < 1e-4 / certainty, "{} {arc}", found.arc_s);
        }
        assert!((f64::from(found.speed_s()) - arc.hypot(rates[1])).abs() < 1e-4 / certainty);
        for time in [0.3, 0.9] {
            let mut pose = sampled(&skeleton, &clip, time);
            motion.remove(time, &skeleton, &mut pose).unwrap();
            let found = model(&skeleton, &pose)[PELVIS];
            assert!(found.translation.distance(start.translation) < 2.0 * most, "in place");
        }
    }
}

/// A very slight curve is still recovered, and so is one of nearly a whole turn. After a whole turn the radius cannot
/// be determined, so the motion is straight.
#[test]
fn slight_curves_and_nearly_whole_turns_are_recovered() {
    let (skeleton, start) = (skeleton(), DAffine3::from_translation(DVec3::new(0.1, 0.9, 0.2)));
    let path = |point: DVec3, turn: f64, shift: f64| {
        let rates = [turn, shift].map(|whole| whole / f64::from(LENGTH));
        let clip = clip_by(&skeleton, 3000, |time| screw(DVec3::Y, point, rates, time) * start);
        let path = RootPath::new(&clip, &skeleton, Root::Bone(PELVIS), 240.0).unwrap();
        let middle = screw(DVec3::Y, point, rates, 0.5 * f64::from(LENGTH)) * start;
        (path, middle.translation)
    };
    let whole = std::f64::consts::TAU;
    for (point, turn, shift, most) in [
        (DVec3::X * 2000.0, 7.5e-4, 0.0, 3e-5),
        (DVec3::X * 100.0, 0.015, 0.0, 1e-3),
        (DVec3::X * 1.5, 0.4, 0.3, 1e-4),
        (DVec3::X * 1.5, whole - 0.05, 0.1, 5e-3),
        (DVec3::X * 1.5, -whole - 0.05, 0.1, 5e-3),
    ] {
        let (path, middle) = path(point, turn, shift);
        let found = rigid(&Motion::composite(&path).at(0.5 * LENGTH)).transform_point3(start.translation);
        assert!(found.distance(middle) < most, "turn {turn}: {} m", found.distance(middle));
        let straight = rigid(&Motion::linear(&path).at(0.5 * LENGTH)).transform_point3(start.translation);
        assert!(straight.distance(middle) > 2.0 * most, "turn {turn}: what is straight does not do");
    }
    for turn in [whole, -whole, whole + 0.01] {
        let (path, _) = path(DVec3::X * 1.5, turn, 0.7);
        assert_eq!(Motion::composite(&path).at(0.4), Motion::linear(&path).at(0.4), "turn {turn}");
    }
}

/// At the end of the clip every motion is where the root is, even if the root turned by more than half a circle and
/// about no fixed axis.
#[test]
fn every_motion_ends_where_the_root_is() {
    let (skeleton, length) = (skeleton(), f64::from(LENGTH));
    for (about_y, about_x) in [(4.0, 0.8), (-5.0, 1.5), (2.0, -1.0), (7.0, 0.3)] {
        let place = |time: f64| {
            let turn =
                DQuat::from_rotation_y(about_y * time / length) * DQuat::from_rotation_x(about_x * time / length);
            DAffine3::from_rotation_translation(turn, DVec3::new(time, 0.9, 2.0 * time * time))
        };
        let clip = clip_by(&skeleton, 3000, place);
        let path = RootPath::new(&clip, &skeleton, Root::Bone(PELVIS), 60.0).unwrap();
        for motion in [Motion::linear(&path), Motion::composite(&path), Motion::variable(&path)] {
            let found = rigid(&motion.at(LENGTH)) * place(0.0);
            let off = found.translation.distance(place(length).translation);
            let turned = DQuat::from_mat3(&found.matrix3).angle_between(DQuat::from_mat3(&place(length).matrix3));
            assert!(off < 1e-4 && turned < 1e-4, "{about_y} {about_x}: {off} m, {turned}");
        }
    }
}

/// A straight movement is a screw without rotation, along its own direction.
#[test]
fn a_straight_movement_is_a_screw_without_rotation() {
    let skeleton = skeleton();
    let way = DVec3::new(0.6, 0.0, -0.8);
    let clip = clip_by(&skeleton, 10, |time| DAffine3::from_translation(way * (1.5 * time)));
    let motion = Motion::composite(&RootPath::new(&clip, &skeleton, Root::Bone(PELVIS), 30.0).unwrap());
    let found = motion.screw();
    assert!(found.axis.as_dvec3().distance(way) < 1e-5 && found.point.is_none(), "{found:?}");
    assert_eq!((found.turn_rad_s, found.arc_s), (0.0, 0.0));
    assert!((found.along_s - 1.5).abs() < 1e-5 && (found.speed_s() - 1.5).abs() < 1e-5, "{found:?}");
    let still = clip_by(&skeleton, 10, |_| DAffine3::from_translation(DVec3::Y));
    let still = Motion::composite(&RootPath::new(&still, &skeleton, Root::Bone(PELVIS), 30.0).unwrap()).screw();
    assert_eq!((still.axis, still.speed_s()), (Vec3::ZERO, 0.0));
}

/// A linear motion recovers a root that moves in a straight line and turns at a constant rate.
#[test]
fn a_linear_motion_recovers_straight_lines() {
    let (mut rng, skeleton) = (Rng(2), skeleton());
    for case in 0..200 {
        let velocity = rng.vector(2.0).as_dvec3();
        let axis = rng.vector(1.0).normalize().as_dvec3();
        // Includes whole turns.
        let whole = std::f64::consts::TAU / f64::from(LENGTH);
        let rate = [0.0, f64::from(rng.between(-7.0, 7.0)), whole, -whole][case % 4];
        let start = rng.rigid();
        let place = |time: f64| {
            let rotation = DQuat::from_axis_angle(axis, rate * time) * start.rotation.as_dquat().normalize();
            DAffine3::from_rotation_translation(rotation, start.translation.as_dvec3() + velocity * time)
        };
        let clip = clip_by(&skeleton, 3000, place);
        let path = RootPath::new(&clip, &skeleton, Root::Bone(PELVIS), 60.0).unwrap();
        let motion = Motion::linear(&path);
        if case % 4 != 1 {
            // Without a turn, and for whole turns, which leave the radius undetermined, the composite motion is the
            // same.
            assert!(Motion::composite(&path).at(0.8).to_affine().abs_diff_eq(motion.at(0.8).to_affine(), 1e-5));
        }
        let truth = |time: f64| place(time) * place(0.0).inverse();
        for _ in 0..20 {
            let time = rng.between(0.0, LENGTH);
            assert!(apart(&motion.at(time).to_affine(), &truth(f64::from(time))) < MOST, "case {case}");
        }
        let mut pose = sampled(&skeleton, &clip, 0.7);
        motion.remove(0.7, &skeleton, &mut pose).unwrap();
        let found = model(&skeleton, &pose)[PELVIS];
        assert!(found.abs_diff_eq(place(0.0) * DAffine3::from_scale(DVec3::splat(0.5)), 2.0 * MOST), "in place");
    }
}

/// A walk that bobs, sways and turns.
fn walk(time: f64) -> DAffine3 {
    let phase = std::f64::consts::TAU * time / f64::from(LENGTH);
    let heading = 0.4 + 0.9 * time + 0.1 * (phase.cos() - 1.0);
    let place = DVec3::new(0.3 + 1.2 * time + 0.05 * phase.sin(), 0.95 + 0.03 * (2.0 * phase).cos(), 1.1 * time * time);
    // Lean about a level axis, applied before the heading.
    let lean = DQuat::from_axis_angle(DVec3::new(0.8, 0.0, 0.6), 0.2 * phase.sin());
    DAffine3::from_rotation_translation(DQuat::from_rotation_y(heading) * lean, place)
}

fn kinds(path: &RootPath) -> [Motion; 3] {
    [Motion::linear(path), Motion::composite(path), Motion::variable(path)]
}

/// Placement and remaining pose together reproduce the source clip: over loops, backwards, at any speed, with
/// interruptions.
#[test]
fn motion_and_remaining_pose_reproduce_the_clip() {
    let (mut rng, skeleton) = (Rng(3), skeleton());
    let clip = clip_by(&skeleton, 60, walk);
    for root in [Root::Bone(PELVIS), Root::Shadow { bone: PELVIS, up: Vec3::Y * 3.0 }] {
        let path = RootPath::new(&clip, &skeleton, root, 120.0).unwrap();
        let whole = rigid(&path.at(LENGTH)) * rigid(&path.at(0.0)).inverse();
        for (kind, motion) in kinds(&path).into_iter().enumerate() {
            for looping in [Looping::Once, Looping::Repeat, Looping::PingPong] {
                let mut control = Control::new().with_looping(looping).at(rng.between(0.0, LENGTH));
                let mut place = rigid(&motion.at(control.time_s()));
                // Number of rounds completed so far, to place the source clip.
                let mut rounds = 0_i32;
                for frame in 0..120 {
                    control.speed = rng.between(-3.0, 4.0);
                    let step = control.advance(rng.between(0.0, 0.5), LENGTH);
                    if looping == Looping::Repeat {
                        let ends = i32::try_from(step.ends_passed()).unwrap();
                        rounds += if control.speed < 0.0 { -ends } else { ends };
                    }
                    place *= rigid(&motion.delta(&step));
                    let mut pose = sampled(&skeleton, &clip, step.to_s());
                    let source = model(&skeleton, &pose);
                    motion.remove(step.to_s(), &skeleton, &mut pose).unwrap();
                    let before = (0..rounds.abs())
                        .fold(DAffine3::IDENTITY, |at, _| if rounds < 0 { at * whole.inverse() } else { at * whole });
                    for (found, source) in model(&skeleton, &pose).iter().zip(&source) {
                        let (found, truth) = (place * *found, before * *source);
                        // Rounding errors accumulate per frame and grow with the distance from the origin.
                        let most = MOST * (1.0 + f64::from(frame) * 0.1) * (1.0 + truth.translation.length());
                        assert!(found.abs_diff_eq(truth, most), "{root:?} {kind} {looping:?} {frame}: {found} {truth}");
                    }
                }
            }
        }
    }
}

/// A single frame is equally exact, no matter how many ends of the clip it passes.
#[test]
fn a_single_long_step_is_exact() {
    let (mut rng, skeleton) = (Rng(4), skeleton());
    let clip = clip_by(&skeleton, 60, walk);
    let path = RootPath::new(&clip, &skeleton, Root::Shadow { bone: PELVIS, up: Vec3::Y }, 120.0).unwrap();
    for motion in kinds(&path) {
        for _ in 0..300 {
            let mut control = Control::new().at(rng.between(0.0, LENGTH)).with_speed(rng.between(-2.0, 2.0));
            let step: Step = control.advance(3.0, LENGTH);
            let rounds = if control.speed < 0.0 { -1.0 } else { 1.0 } * f64::from(step.ends_passed());
            let whole = rigid(&motion.at(LENGTH));
            let power = (0..step.ends_passed()).fold(DAffine3::IDENTITY, |power, _| power * whole);
            let power = if rounds < 0.0 { power.inverse() } else { power };
            let truth = rigid(&motion.at(step.from_s())).inverse() * power * rigid(&motion.at(step.to_s()));
            assert!(apart(&motion.delta(&step).to_affine(), &truth) < MOST);
        }
    }
}

/// A shadow root takes heading and position on the ground; leaning and bobbing remain in the pose.
#[test]
fn a_shadow_root_follows_the_ground() {
    let skeleton = skeleton();
    let clip = clip_by(&skeleton, 2000, walk);
    let path = RootPath::new(&clip, &skeleton, Root::Shadow { bone: PELVIS, up: Vec3::Y * 1e-20 }, 200.0).unwrap();
    let rest = model(&skeleton, skeleton.rest())[PELVIS];
    let (_, rest, _) = rest.to_scale_rotation_translation();
    for time in [0.0, 0.31, 0.62, 1.1, LENGTH] {
        let (found, source) = (path.at(time), walk(f64::from(time)));
        let place = source.translation * DVec3::new(1.0, 0.0, 1.0);
        assert!(found.translation.as_dvec3().distance(place) < 3e-5, "{time}");
        // Swing-twist decomposition: without the twist about the vertical, the turn from the rest pose is about a level
        // axis.
        let twist = found.rotation.as_dquat().normalize();
        assert!(twist.x.abs() < 1e-7 && twist.z.abs() < 1e-7);
        let left = twist.conjugate() * DQuat::from_mat3(&source.matrix3) * rest.conjugate();
        assert!(left.y.abs() < 1e-4, "{left}");
    }
    // Upside down the heading is undefined; the last one is kept.
    let angle = |time: f64| (time * 4.0).min(std::f64::consts::PI);
    let flip =
        |time: f64| DAffine3::from_quat(DQuat::from_rotation_y(0.5) * DQuat::from_rotation_x(angle(time)) * rest);
    let clip = clip_by(&skeleton, 500, flip);
    let path = RootPath::new(&clip, &skeleton, Root::Shadow { bone: PELVIS, up: Vec3::Y }, 200.0).unwrap();
    for time in [0.7, 1.0, LENGTH] {
        assert!(angle_between(path.at(time).rotation, DQuat::from_rotation_y(0.5)) < 1e-3, "{time}");
    }
}

/// Sampling the clip with its motion removed equals removing the motion from each sample.
#[test]
fn motion_removed_from_the_clip_keeps_the_root_in_place() {
    let skeleton = skeleton();
    let clip = clip_by(&skeleton, 60, walk);
    let path = RootPath::new(&clip, &skeleton, Root::Shadow { bone: PELVIS, up: Vec3::Y }, 120.0).unwrap();
    for motion in kinds(&path) {
        // At least the requested rate: 13.65 intervals are rounded up to 14.
        let coarse = motion.removed_from(&clip, &skeleton, 10.5);
        assert_eq!(coarse.bone(0).unwrap().translation.as_ref().unwrap().times().len(), 15);
        let whole = motion.removed_from(&clip, &skeleton, 10.0);
        assert_eq!(whole.bone(0).unwrap().translation.as_ref().unwrap().times().len(), 14);
        let stripped = motion.removed_from(&clip, &skeleton, 1000.0);
        assert_eq!((stripped.length_s(), stripped.name()), (clip.length_s(), "clip"));
        for time in [0.0, 0.123, 0.77, LENGTH] {
            let mut pose = sampled(&skeleton, &clip, time);
            motion.remove(time, &skeleton, &mut pose).unwrap();
            let found = model(&skeleton, &sampled(&skeleton, &stripped, time));
            for (found, truth) in found.iter().zip(model(&skeleton, &pose)) {
                assert!(found.abs_diff_eq(truth, 5e-5), "{time}: {found} {truth}");
            }
        }
    }
}

/// Walk and run in step, blended by weight: the character moves at the weighted mean, whatever the frame rate.
#[test]
fn blended_motion_is_the_weighted_mean() {
    let skeleton = Skeleton::new([Bone::new("root", None)]).unwrap();
    let straight = |length: f32, speed: f32| {
        let track = Track::linear([0.0, length], [Vec3::ZERO, Vec3::Z * (length * speed)]).unwrap();
        Clip::new("").with_translation(0, track)
    };
    let clips = [straight(1.0, 1.5), straight(0.5, 4.5)];
    let marks = [1.0, 0.5].map(|length| Marks::new(length, [0.0, 0.5 * length]).unwrap());
    let motions =
        clips.each_ref().map(|clip| Motion::linear(&RootPath::new(clip, &skeleton, Root::Bone(0), 30.0).unwrap()));
    let weight = |input| (Node::source(input), Parameter::Input(input));
    let tree = Tree::new(&skeleton, Node::sum([weight(0), weight(1)])).unwrap();
    let (mut scratch, mut phase, mut shares) = (tree.scratch(), Phase::new(), [0.0; 2]);
    let (mut place, mut rng) = (Transform::IDENTITY, Rng(5));
    let mut truth = 0.0;
    for _ in 0..500 {
        let run = rng.between(0.0, 1.0);
        let dt = rng.between(0.0, 0.05);
        tree.shares(0, &[1.0 - run, run], &mut scratch, &mut shares).unwrap();
        phase.advance(dt, &[(&marks[0], shares[0]), (&marks[1], shares[1])]);
        let deltas = [0, 1].map(|k| (motions[k].delta(&phase.step(&marks[k])), shares[k]));
        place = place.rigid_product(&Motion::blend(deltas));
        // A cycle of the blend lasts the weighted mean of the durations and covers the weighted mean of the distances.
        let (run, dt) = (f64::from(run), f64::from(dt));
        truth += dt * (1.5 * (1.0 - run) + 2.25 * run) / (1.0 - run + 0.5 * run);
    }
    assert!((f64::from(place.translation.z) - truth).abs() < 1e-3, "{place:?} {truth}");
    assert_eq!(Motion::blend([(place, 0.0), (place, f32::NAN)]), Transform::IDENTITY);
    let half = Motion::blend([
        (Transform::from_rotation(Quat::from_rotation_z(0.4)), 0.2),
        (Transform::from_rotation(Quat::from_rotation_z(-0.1)), 0.2),
    ]);
    assert!(angle_between(half.rotation, DQuat::from_rotation_z(0.15)) < 1e-6);
}

#[test]
fn invalid_paths_are_refused_and_static_clips_have_no_axis() {
    let skeleton = skeleton();
    let clip = clip_by(&skeleton, 10, walk);
    let bone = Root::Bone(PELVIS);
    let refused = |clip: &Clip, root, rate| RootPath::new(clip, &skeleton, root, rate).unwrap_err();
    assert_eq!(refused(&Clip::new("still"), bone, 30.0), MotionError::Length);
    for rate in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(refused(&clip, bone, rate), MotionError::Length);
    }
    assert_eq!(refused(&clip, Root::Bone(4), 30.0), MotionError::Bone(4));
    for up in [Vec3::ZERO, Vec3::splat(f32::NAN)] {
        assert_eq!(refused(&clip, Root::Shadow { bone: PELVIS, up }, 30.0), MotionError::Up);
    }
    let far = Clip::new("").with_length(1.0).with_scale(0, Track::constant(Vec3::splat(1e15)).unwrap());
    let farther = far.with_translation(1, Track::constant(Vec3::splat(1e15)).unwrap());
    assert_eq!(refused(&farther, bone, 30.0), MotionError::Place);
    let path = RootPath::new(&clip, &skeleton, bone, 30.0).unwrap();
    let motion = Motion::composite(&path);
    assert!(motion.remove(0.0, &skeleton, &mut [Transform::IDENTITY]).is_err());
    assert_eq!(motion.at(f32::NAN), motion.at(0.0));
    assert_eq!((motion.at(9.0), motion.length_s()), (motion.at(LENGTH), LENGTH));
    // A clip without movement has a screw without an axis.
    let still = Clip::new("still").with_length(1.0);
    let screw = Motion::composite(&RootPath::new(&still, &skeleton, bone, 30.0).unwrap()).screw();
    assert_eq!((screw.axis, screw.point, screw.speed_s()), (Vec3::ZERO, None, 0.0));
    assert!(Affine3A::IDENTITY.abs_diff_eq(motion.at(0.0).to_affine(), 1e-6));
}
