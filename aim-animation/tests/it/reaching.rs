//! A limb led through points in space, checked by forward kinematics in f64 and against a separate solution of its
//! tip's trajectory.

use aim_animation::glam::{Affine3A, DAffine3, DQuat, DVec3, Quat, Vec3};
use aim_animation::{Bone, Clip, Reach, ReachError, ReachGoal, Skeleton, Track, Transform};
use aim_runtime::ik::CcdLimit;
use aim_runtime::trajectory::{Ends, Node, Status, Trajectory, Waypoint};

use crate::common::{Rng, exact};

const RATE: f32 = 60.0;
const LENGTH: f32 = 1.1;

/// Bone indices of the limbs. The arm is: clavicle, upper arm, a twist bone that is never turned, forearm, hand,
/// finger; it hangs on a chest that moves.
const ARM: [usize; 3] = [3, 5, 6];
const WITH_CLAVICLE: [usize; 4] = [2, 3, 5, 6];
const FROM_CHEST: [usize; 5] = [1, 2, 3, 5, 6];

fn skeleton(armature: Transform) -> Skeleton {
    let at = |x: f32, y: f32, z: f32| Transform::from_translation(Vec3::new(x, y, z));
    let bent = |transform: Transform, angle: f32| Transform { rotation: Quat::from_rotation_z(angle), ..transform };
    Skeleton::new([
        Bone::new("armature", None).with_rest(armature),
        Bone::new("chest", Some(0)).with_rest(at(0.0, 1.2, 0.0)),
        Bone::new("clavicle", Some(1)).with_rest(at(0.05, 0.2, 0.0)),
        Bone::new("upper_arm", Some(2)).with_rest(bent(at(0.14, 0.0, 0.0), -0.6)),
        Bone::new("twist", Some(3)).with_rest(Transform::new(Vec3::X * 0.14, Quat::from_rotation_x(0.3))),
        Bone::new("forearm", Some(4)).with_rest(bent(at(0.14, 0.0, 0.0), 1.1)),
        Bone::new("hand", Some(5)).with_rest(Transform::new(Vec3::X * 0.25, Quat::from_rotation_y(0.4))),
        Bone::new("finger", Some(6)).with_rest(at(0.1, 0.0, 0.0)),
    ])
    .unwrap()
}

/// Returns a clip that swings the arm while the chest turns.
fn swing() -> Clip {
    let track = |angles: [f32; 5], turn: fn(f32) -> Quat| {
        Track::catmull_rom([0.0, 0.25, 0.5, 0.8, LENGTH], angles.map(turn)).unwrap()
    };
    let upper = |angle: f32| Quat::from_rotation_y(-angle) * Quat::from_rotation_z(0.4 * angle - 0.6);
    Clip::new("swing")
        .with_rotation(1, track([0.0, 0.2, 0.3, 0.1, 0.0], Quat::from_rotation_y))
        .with_rotation(3, track([0.0, 0.5, 1.1, 0.4, 0.0], upper))
        .with_rotation(5, track([1.1, 1.3, 0.7, 0.9, 1.1], Quat::from_rotation_z))
        .with_rotation(7, track([0.0, 0.5, 0.1, 0.2, 0.0], Quat::from_rotation_z))
}

/// Root transforms that preserve relative lengths: identity, rigid, in centimetres, mirrored.
fn armatures() -> [(&'static str, Transform); 4] {
    let turned = Transform::new(Vec3::new(3.0, -1.0, 2.0), Quat::from_rotation_y(0.8) * Quat::from_rotation_x(-1.5));
    [
        ("identity", Transform::IDENTITY),
        ("placed", turned),
        ("centimetres", Transform { scale: Vec3::splat(100.0), ..turned }),
        ("mirrored", Transform { scale: Vec3::new(-1.0, 1.0, 1.0), ..turned }),
    ]
}

fn model(skeleton: &Skeleton, pose: &[Transform]) -> Vec<DAffine3> {
    let mut model: Vec<DAffine3> = Vec::new();
    for (at, parent) in pose.iter().zip(skeleton.parents()) {
        model.push(parent.map_or(DAffine3::IDENTITY, |parent| model[parent]) * exact(at));
    }
    model
}

fn sampled(skeleton: &Skeleton, clip: &Clip, time: f32) -> (Vec<Transform>, Vec<Affine3A>) {
    let mut local = skeleton.rest().to_vec();
    clip.sample(time, &mut clip.cursor(), &mut local);
    let mut in_model = vec![Affine3A::IDENTITY; local.len()];
    skeleton.to_model(&local, &mut in_model).unwrap();
    (local, in_model)
}

/// Returns the position of the hand in model space at a time, by forward kinematics in f64.
fn tip(skeleton: &Skeleton, clip: &Clip, time: f32) -> DVec3 {
    model(skeleton, &sampled(skeleton, clip, time).0)[6].translation
}

fn orientation(at: &DAffine3) -> DQuat {
    let [x, y, z] = [at.matrix3.x_axis, at.matrix3.y_axis, at.matrix3.z_axis].map(DVec3::normalize);
    DQuat::from_mat3(&aim_animation::glam::DMat3::from_cols(x, y, if x.cross(y).dot(z) < 0.0 { -z } else { z }))
}

/// Returns the limb's length at rest, in units of the model.
fn length(skeleton: &Skeleton, limb: &[usize]) -> f64 {
    let at = model(skeleton, skeleton.rest());
    limb.windows(2).map(|pair| at[pair[1]].translation.distance(at[pair[0]].translation)).sum()
}

/// At any time of a clip, also between its samples, the tip is on the goal, the hand keeps its animated orientation,
/// bones keep their lengths, and nothing else moves.
#[test]
fn goals_are_met_between_samples() {
    let mut rng = Rng(1);
    for (name, armature) in armatures() {
        let (skeleton, clip) = (skeleton(armature), swing());
        for (limb, most) in [(&ARM[..], 2e-5), (&WITH_CLAVICLE, 4e-5), (&FROM_CHEST, 4e-5)] {
            let (reach, size) = (Reach::new(&clip, &skeleton, limb, RATE).unwrap(), length(&skeleton, limb));
            let mut state = reach.state();
            for _ in 0..40 {
                let time = rng.between(0.1, 1.0);
                let (mut local, mut in_model) = sampled(&skeleton, &clip, time);
                let (before, animated) = (local.clone(), model(&skeleton, &local));
                // Towards the first joint, so that the goal is within reach.
                let inward = (animated[limb[0]].translation - animated[6].translation) * 0.3;
                let aside = rng.vector(0.2).as_dvec3() * inward.length();
                let goal = ReachGoal::new(time, (animated[6].translation + inward + aside).as_vec3());
                let outcome = reach.aim(&mut state, &[goal], 0.0).unwrap();
                assert_eq!((outcome.trajectory.status, outcome.out_of_reach), (Status::Met, 0.0), "{name}");
                let error = reach.apply(&mut state, time, &mut local, &mut in_model).unwrap();
                let after = model(&skeleton, &local);
                let off = after[6].translation.distance(goal.target.as_dvec3());
                assert!(off < most * size && f64::from(error) < most * size, "{name} {limb:?}: {off} {error}");
                let turned = orientation(&after[6]).angle_between(orientation(&animated[6]));
                assert!(turned < 1e-3, "{name} {limb:?}: the hand is turned by {turned}");
                for (bone, (now, was)) in local.iter().zip(&before).enumerate() {
                    assert_eq!((now.translation, now.scale), (was.translation, was.scale), "{name}: bone {bone}");
                    assert!(limb.contains(&bone) || now == was, "{name}: bone {bone} is none of the limb");
                    assert!((now.rotation.length() - 1.0).abs() < 1e-5);
                }
                for (found, truth) in in_model.iter().zip(&after) {
                    assert!(
                        Vec3::from(found.translation).as_dvec3().distance(truth.translation) < 1e-5 * size.max(3.0)
                    );
                }
            }
        }
    }
}

/// At samples, the tip follows the trajectory solver for all of its settings; between them, the cubic whose velocities
/// come from parabolas through three samples.
#[test]
fn the_path_is_that_of_the_trajectory() {
    let (skeleton, clip) = (skeleton(Transform::IDENTITY), swing());
    let size = length(&skeleton, &ARM);
    for (ends, weight, smoothing) in
        [(Ends::Fixed, f32::INFINITY, 0.04), (Ends::Fixed, 0.02, 0.1), (Ends::Free, f32::INFINITY, 0.04)]
    {
        let reach = Reach::new(&clip, &skeleton, ARM, RATE).unwrap().with_ends(ends).with_smoothing(smoothing);
        let mut state = reach.state();
        let goal_time = 0.4321;
        let goal =
            ReachGoal::new(goal_time, (tip(&skeleton, &clip, goal_time) + DVec3::new(-0.07, 0.06, -0.04)).as_vec3());
        reach.aim(&mut state, &[goal.with_weight(weight)], 0.0).unwrap();

        // The same computed directly: uniform sample times, with the one nearest to the goal moved onto it.
        let count = reach.trajectory().points.len();
        let mut times: Vec<f32> = (0..count).map(|k| LENGTH * k as f32 / (count - 1) as f32).collect();
        let near =
            (0..count).min_by(|&a, &b| (times[a] - goal_time).abs().total_cmp(&(times[b] - goal_time).abs())).unwrap();
        times[near] = goal_time;
        let roots: Vec<DVec3> = times
            .iter()
            .map(|&time| model(&skeleton, &sampled(&skeleton, &clip, time).0)[ARM[0]].translation)
            .collect();
        let seen = |point: DVec3, k: usize| ((point - roots[k]) / size).as_vec3();
        let rest: Vec<Vec3> = (0..count).map(|k| seen(tip(&skeleton, &clip, times[k]), k)).collect();
        let waypoint = Waypoint::new(near, seen(goal.target.as_dvec3(), near)).with_weight(weight);
        let (mut through, mut nodes) = (rest.clone(), vec![Node::default(); count]);
        let trajectory = Trajectory::new(&rest).with_times(&times).with_ends(ends).with_smoothing(smoothing);
        trajectory.deform(&[waypoint], &mut through, &mut nodes);
        let offsets: Vec<DVec3> =
            rest.iter().zip(&through).map(|(a, b)| (b.as_dvec3() - a.as_dvec3()) * size).collect();
        assert!(offsets[near].length() > 1e-3);

        let shown = |time: f32| {
            let (mut local, mut in_model) = sampled(&skeleton, &clip, time);
            reach.apply(&mut state.clone(), time, &mut local, &mut in_model).unwrap();
            model(&skeleton, &local)[6].translation - tip(&skeleton, &clip, time)
        };
        let slope = |a: usize, b: usize| (offsets[b] - offsets[a]) / f64::from(times[b] - times[a]);
        let velocity = |k: usize| match k {
            0 => DVec3::ZERO,
            k if k + 1 == count => DVec3::ZERO,
            // Derivative, at the middle point, of the parabola through three points.
            k => {
                let [before, after] = [times[k] - times[k - 1], times[k + 1] - times[k]].map(f64::from);
                slope(k - 1, k) + (slope(k, k + 1) - slope(k - 1, k)) * before / (before + after)
            }
        };
        for k in 0..count - 1 {
            let off = shown(times[k]).distance(offsets[k]);
            assert!(off < 1e-5, "{ends:?} sample {k}: off by {off}");
            let interval = f64::from(times[k + 1] - times[k]);
            let middle = (offsets[k] + offsets[k + 1]) / 2.0 + (velocity(k) - velocity(k + 1)) * interval / 8.0;
            let off = shown(0.5 * (times[k] + times[k + 1])).distance(middle);
            assert!(off < 1e-5, "{ends:?} after sample {k}: off by {off}");
        }
        if ends == Ends::Fixed {
            assert!(shown(0.0).length() < 1e-6 && shown(LENGTH).length() < 1e-6, "the ends stay");
        }
    }
}

/// Goals fade in and out without a jump, half of the weight covers half of the distance, and weight 0 changes no bit.
#[test]
fn changed_goals_fade_in() {
    let (skeleton, clip) = (skeleton(Transform::IDENTITY), swing());
    let reach = Reach::new(&clip, &skeleton, ARM, RATE).unwrap();
    let mut state = reach.state();
    let time = 0.5;
    let shown = |state: &aim_animation::ReachState| {
        let (mut local, mut in_model) = sampled(&skeleton, &clip, time);
        reach.apply(&mut state.clone(), time, &mut local, &mut in_model).unwrap();
        model(&skeleton, &local)[6].translation
    };
    let animated = tip(&skeleton, &clip, time);
    let goals = [DVec3::new(-0.1, 0.05, -0.05), DVec3::new(0.0, -0.08, -0.1)].map(|off| animated + off);
    let [first, second] = goals.map(|goal| [ReachGoal::new(time, goal.as_vec3())]);
    assert!(shown(&state).distance(animated) < 1e-6);

    let dt = 1.0 / 240.0;
    let mut last = animated;
    // Fade in; change the goal midway and back, twice; fade out.
    for (goals, frames) in [(&first[..], 30), (&second[..], 30), (&first[..], 20), (&second[..], 80), (&[][..], 80)] {
        reach.aim(&mut state, goals, 0.25).unwrap();
        for _ in 0..frames {
            let now = shown(&state);
            // The largest speed of a smoothstep is 1.5 times its mean.
            assert!(now.distance(last) <= 1.6 * 0.25 * f64::from(dt) / 0.25, "jumps by {}", now.distance(last));
            last = now;
            state.advance(dt);
        }
        let wanted = if goals.is_empty() { animated } else { goals[0].target.as_dvec3() };
        assert_eq!(state.is_settled(), frames == 80);
        assert!(!state.is_settled() || shown(&state).distance(wanted) < 1e-5);
    }

    reach.aim(&mut state, &first, 0.0).unwrap();
    state.weight = 0.5;
    assert!(shown(&state).distance((animated + goals[0]) / 2.0) < 1e-5);
    for weight in [0.0, -1.0, f32::NAN] {
        state.weight = weight;
        let (mut local, mut in_model) = sampled(&skeleton, &clip, time);
        let before = (local.clone(), in_model.clone());
        assert_eq!(reach.apply(&mut state, time, &mut local, &mut in_model), Ok(0.0));
        assert_eq!((local, in_model), before);
    }
}

/// If a goal is out of reach, the limb gets as near as it can and the remaining distance is reported.
#[test]
fn a_goal_out_of_reach_is_approached() {
    let (skeleton, clip) = (skeleton(Transform::IDENTITY), swing());
    let size = length(&skeleton, &ARM);
    let reach = Reach::new(&clip, &skeleton, ARM, RATE).unwrap();
    let mut state = reach.state();
    let (mut local, mut in_model) = sampled(&skeleton, &clip, 0.5);
    let root = model(&skeleton, &local)[ARM[0]].translation;
    let way = DVec3::new(0.6, 0.0, 0.8);
    let goal = ReachGoal::new(0.5, (root + way * 2.0 * size).as_vec3());
    let outcome = reach.aim(&mut state, &[goal], 0.0).unwrap();
    assert!((f64::from(outcome.out_of_reach) - size).abs() < 1e-5 * size, "{outcome:?}");
    reach.apply(&mut state, 0.5, &mut local, &mut in_model).unwrap();
    let off = model(&skeleton, &local)[6].translation.distance(root + way * size);
    assert!(off < 2e-3 * size, "{off} from where the stretched arm ends");
}

/// Outcomes are in units of the model: in centimetres, distances are 100 times as large and the distortion, which is a
/// squared length, 100² times.
#[test]
fn outcomes_are_in_units_of_the_model() {
    let outcomes = [1.0, 100.0].map(|scale: f32| {
        let skeleton = skeleton(Transform { scale: Vec3::splat(scale), ..Transform::IDENTITY });
        let reach = Reach::new(&swing(), &skeleton, ARM, RATE).unwrap();
        let goal = tip(&skeleton, &swing(), 0.5).as_vec3() + Vec3::new(-0.02, 0.05, 0.03) * scale;
        let goal = ReachGoal::new(0.5, goal).with_weight(0.01);
        reach.aim(&mut reach.state(), &[goal], 0.0).unwrap().trajectory
    });
    let [metres, centimetres] = outcomes;
    assert!(metres.missed > 1e-3 && metres.distortion > 1e-9, "{metres:?}");
    let ratio = [centimetres.missed / metres.missed, (centimetres.distortion / metres.distortion).sqrt()];
    assert!(ratio.iter().all(|ratio| (ratio - 100.0).abs() < 1.0), "{ratio:?} {metres:?}");
    // The error is at most the goal's distance from the animation, and the distortion at most its square.
    assert!(metres.missed < 0.062 && metres.distortion < 0.0039, "{metres:?}");
}

/// Near an end of the clip, the neighbouring sample moves instead of the end itself. Without any sample between the
/// ends, no goal can be met.
#[test]
fn fixed_ends_do_not_move() {
    let (skeleton, clip) = (skeleton(Transform::IDENTITY), swing());
    let reach = Reach::new(&clip, &skeleton, ARM, RATE).unwrap();
    let mut state = reach.state();
    for (time, end) in [(LENGTH - 0.3 / RATE, LENGTH), (0.3 / RATE, 0.0)] {
        let goal = ReachGoal::new(time, tip(&skeleton, &clip, time).as_vec3() + Vec3::new(-0.01, 0.0, 0.01));
        reach.aim(&mut state, &[goal], 0.0).unwrap();
        for (at, is_met) in [(time, true), (end, false)] {
            let (mut local, mut in_model) = sampled(&skeleton, &clip, at);
            reach.apply(&mut state, at, &mut local, &mut in_model).unwrap();
            let found = model(&skeleton, &local)[6].translation;
            let wanted = if is_met { goal.target.as_dvec3() } else { tip(&skeleton, &clip, at) };
            assert!(found.distance(wanted) < 1e-4, "{} m off at {at}", found.distance(wanted));
        }
    }
    let coarse = Reach::new(&clip, &skeleton, ARM, 0.1).unwrap();
    let goal = ReachGoal::new(0.5 * LENGTH, Vec3::ZERO);
    assert_eq!(coarse.aim(&mut coarse.state(), &[goal], 0.0), Err(ReachError::Time(0)));
}

/// A goal beyond reach, or nearer to the first joint than the folded limb can come, is replaced by the nearest
/// reachable point: the movement is the same at all times.
#[test]
fn goals_beyond_reach_count_as_the_nearest_point() {
    let (skeleton, clip) = (skeleton(Transform::IDENTITY), swing());
    let reach = Reach::new(&clip, &skeleton, ARM, RATE).unwrap();
    let at = model(&skeleton, &sampled(&skeleton, &clip, 0.5).0);
    let joints = ARM.map(|bone| at[bone].translation);
    let (upper, lower) = (joints[0].distance(joints[1]), joints[1].distance(joints[2]));
    let way = (joints[2] - joints[0]).normalize();
    for (distance, reached) in
        [(3.0 * (upper + lower), upper + lower), (1.2 * (upper + lower), upper + lower), (1e-3, upper - lower)]
    {
        let poses = [distance, reached].map(|distance| {
            let mut state = reach.state();
            let goal = ReachGoal::new(0.5, (joints[0] + way * distance).as_vec3());
            let outcome = reach.aim(&mut state, &[goal], 0.0).unwrap();
            let beyond = (distance - reached).abs();
            assert!((f64::from(outcome.out_of_reach) - beyond).abs() < 1e-5, "{outcome:?} {beyond}");
            [0.3, 0.42, 0.6].map(|time| {
                let (mut local, mut in_model) = sampled(&skeleton, &clip, time);
                reach.apply(&mut state, time, &mut local, &mut in_model).unwrap();
                model(&skeleton, &local)[6].translation
            })
        });
        for (one, other) in poses[0].iter().zip(&poses[1]) {
            assert!(one.distance(*other) < 1e-3, "{distance}: {one} {other}");
        }
    }
}

/// Under a non-uniform scale, rotations shear and lengths depend on the limb's direction. The solver iterates until the
/// tip is where it reports it.
#[test]
fn goals_are_met_under_uneven_scales() {
    let mut rng = Rng(7);
    let uneven =
        Transform { scale: Vec3::new(1.05, 0.97, 1.0), ..Transform::from_rotation(Quat::from_rotation_z(0.4)) };
    let (skeleton, clip) = (skeleton(uneven), swing());
    let reach = Reach::new(&clip, &skeleton, ARM, RATE).unwrap();
    let mut state = reach.state();
    let mut offs = Vec::new();
    for _ in 0..60 {
        let time = rng.between(0.1, 1.0);
        let (mut local, mut in_model) = sampled(&skeleton, &clip, time);
        let animated = model(&skeleton, &local);
        let inward = (animated[ARM[0]].translation - animated[6].translation) * 0.3;
        let goal = ReachGoal::new(time, (animated[6].translation + inward).as_vec3() + rng.vector(0.03));
        reach.aim(&mut state, &[goal], 0.0).unwrap();
        let error = reach.apply(&mut state, time, &mut local, &mut in_model).unwrap();
        let off = model(&skeleton, &local)[6].translation.distance(goal.target.as_dvec3());
        assert!((off - f64::from(error)).abs() < 1e-4, "{off} off, {error} told");
        offs.push(off);
    }
    offs.sort_by(f64::total_cmp);
    println!("{:.1e} m off in the middle, {:.1e} m at most", offs[30], offs[59]);
    assert!(offs[59] < 1e-5, "{offs:?}");
}

/// In a longer limb, a hinge stays within its limits and turns about its bone's own axis.
#[test]
fn hinges_of_longer_limbs_keep_their_limits() {
    let (skeleton, clip) = (skeleton(Transform::IDENTITY), swing());
    let elbow = CcdLimit::Hinge { axis: Vec3::Z, least_rad: -0.2, most_rad: 0.1 };
    let reach = Reach::new(&clip, &skeleton, WITH_CLAVICLE, RATE).unwrap().with_limit(2, elbow);
    let (mut rng, mut state) = (Rng(4), reach.state());
    let mut most = 0.0_f32;
    for _ in 0..50 {
        let (mut local, mut in_model) = sampled(&skeleton, &clip, 0.5);
        let before = local[5].rotation;
        let goal = ReachGoal::new(0.5, tip(&skeleton, &clip, 0.5).as_vec3() + rng.vector(0.3));
        reach.aim(&mut state, &[goal], 0.0).unwrap();
        reach.apply(&mut state, 0.5, &mut local, &mut in_model).unwrap();
        let turn = before.conjugate() * local[5].rotation;
        assert!(turn.x.abs() < 1e-4 && turn.y.abs() < 1e-4, "about its own z axis: {turn}");
        let angle = 2.0 * turn.z.atan2(turn.w);
        assert!((-0.2 - 1e-3..=0.1 + 1e-3).contains(&angle), "{angle}");
        most = most.max(angle.abs());
    }
    assert!(most > 0.15, "it bends as far as it may: {most}");
}

#[test]
fn invalid_limbs_and_goals_are_refused() {
    let (skeleton, clip) = (skeleton(Transform::IDENTITY), swing());
    let error = |limb: &[usize]| Reach::new(&clip, &skeleton, limb, RATE).err();
    assert_eq!(error(&[]), Some(ReachError::Limb(0)));
    assert_eq!(error(&[6]), Some(ReachError::Limb(1)));
    assert_eq!(error(&[6, 5]), Some(ReachError::Limb(1)));
    assert_eq!(error(&[3, 3]), Some(ReachError::Limb(1)));
    assert_eq!(error(&[3, 5, 60]), Some(ReachError::Limb(2)));
    assert_eq!(Reach::new(&Clip::new("still"), &skeleton, ARM, RATE).err(), Some(ReachError::Length));
    for rate in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(Reach::new(&clip, &skeleton, ARM, rate).err(), Some(ReachError::Length));
    }
    let flat = Bone::new("a", None);
    let flat = Skeleton::new([flat, Bone::new("b", Some(0))]).unwrap();
    assert_eq!(Reach::new(&clip, &flat, [0, 1], RATE).err(), Some(ReachError::Place));
    // Only one of the bones has a length.
    let long = |length: f32| Transform::from_translation(Vec3::X * length);
    let limb = |lengths: [f32; 2]| {
        let bones = [("a", None, 0.0), ("b", Some(0), lengths[0]), ("c", Some(1), lengths[1])];
        let limb = Skeleton::new(bones.map(|(name, on, length)| Bone::new(name, on).with_rest(long(length)))).unwrap();
        Reach::new(&clip, &limb, [0, 1, 2], RATE).err()
    };
    assert_eq!(limb([0.3, 0.0]), Some(ReachError::Place));
    assert_eq!(limb([0.0, 0.3]), Some(ReachError::Place));
    assert_eq!(limb([1e38, 3e38]), Some(ReachError::Place));

    let reach = Reach::new(&clip, &skeleton, ARM, RATE).unwrap();
    let mut state = reach.state();
    let goal = |at_s: f32| ReachGoal::new(at_s, Vec3::new(0.3, 1.4, 0.2));
    reach.aim(&mut state, &[goal(0.5)], 0.0).unwrap();
    let (mut local, mut in_model) = sampled(&skeleton, &clip, 0.5);
    reach.apply(&mut state, 0.5, &mut local, &mut in_model).unwrap();
    for (goals, expected) in [
        (vec![goal(0.5), goal(-0.1)], ReachError::Time(1)),
        (vec![goal(LENGTH + 0.1)], ReachError::Time(0)),
        (vec![goal(f32::NAN)], ReachError::Time(0)),
        (vec![goal(0.5), goal(0.7), goal(0.501)], ReachError::Together(2)),
    ] {
        assert_eq!(reach.aim(&mut state, &goals, 0.0), Err(expected), "{expected}");
        let (mut again, mut in_model) = sampled(&skeleton, &clip, 0.5);
        reach.apply(&mut state, 0.5, &mut again, &mut in_model).unwrap();
        assert_eq!(again, local, "nothing has changed");
    }
    let other = Reach::new(&clip, &skeleton, ARM, 30.0).unwrap();
    assert_eq!(other.aim(&mut state, &[], 0.0), Err(ReachError::State));
    assert!(other.apply(&mut state, 0.5, &mut local, &mut in_model).is_err());
    assert!(reach.apply(&mut state, 0.5, &mut local[1..], &mut in_model).is_err());
}
