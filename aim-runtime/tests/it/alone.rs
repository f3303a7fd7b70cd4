//! A rig of one joint, such as an eye: the gaze is the nearest one within range and rate, found by an independent
//! search, and never worse than that of the whole-chain solver.

#![allow(clippy::cast_possible_truncation, reason = "rounding to f32 is meant")]

use crate::common::*;
use aim_runtime::glam::{Affine3A, Mat3, Quat, Vec3};
use aim_runtime::{Behind, Joint, JointInfo, LimitsFrom, Pose, Settings, Solver, Status};

/// Returns the rig in a form that is solved as a whole chain: with ranges relative to the bind pose. Without a bind
/// pose these are relative to the animation, so the ranges are the same.
pub(crate) fn as_a_chain(rig: &NumericRig) -> NumericRig {
    let mut whole = rig.clone();
    whole.infos[0] = whole.infos[0].with_limits_from(LimitsFrom::BindPose);
    whole
}

/// Returns the angle between a target, given along forward, left and up, and the gaze at this heading and pitch,
/// radians.
fn off(target: [f64; 3], heading: f64, pitch: f64) -> f64 {
    let gaze = [pitch.cos() * heading.cos(), pitch.cos() * heading.sin(), pitch.sin()];
    let [x, y, z] = target;
    let along = gaze[0] * x + gaze[1] * y + gaze[2] * z;
    // Chord between unit vectors: accurate for small angles, too.
    let apart = [gaze[0] - x, gaze[1] - y, gaze[2] - z].map(|x| x * x).iter().sum::<f64>().sqrt();
    if along > 0.0 { 2.0 * (0.5 * apart).asin() } else { along.acos() }
}

/// Returns the smallest such angle within bounds, by a grid that is repeatedly narrowed around its best point.
fn least_off(target: [f64; 3], headings: [f64; 2], pitches: [f64; 2]) -> f64 {
    const STEPS: i32 = 10;
    let (mut best, mut at) = (f64::INFINITY, [headings, pitches].map(|[lo, hi]| 0.5 * (lo + hi)));
    let mut half = [headings, pitches].map(|[lo, hi]| 0.5 * (hi - lo));
    for _ in 0..12 {
        let middle = at;
        for (i, j) in (-STEPS..=STEPS).flat_map(|i| (-STEPS..=STEPS).map(move |j| (i, j))) {
            let part = |which: usize, k: i32| middle[which] + half[which] * f64::from(k) / f64::from(STEPS);
            let heading = part(0, i).clamp(headings[0], headings[1]);
            let pitch = part(1, j).clamp(pitches[0], pitches[1]);
            let angle = off(target, heading, pitch);
            if angle < best {
                (best, at) = (angle, [heading, pitch]);
            }
        }
        half = half.map(|half| half * 0.3);
    }
    best
}

#[test]
fn the_gaze_is_the_nearest_within_range_and_rate() {
    let mut rng = Rng(77);
    let settings = Settings::default().with_solver(Solver::Exact).with_behind(Behind::Off);
    let tolerance = f64::from(0.1 * DEG);
    let [mut reached, mut limited, mut hurried] = [0; 3];
    for case in 0..600 {
        let axes = random::axes(&mut rng);
        let mut range = |most: f32| [-rng.between(0.02, most), rng.between(0.02, most)];
        let ([right, left], [down, up]) = (range(1.2), range(0.9));
        let rate = rng.of_any_size(0.3, 20.0);
        let info = JointInfo::new(axes, rate).with_heading(right, left).with_pitch(down, up);
        let mut rig = NumericRig::new(vec![info]);
        rig.joints[0] = Joint::from_angles(rng.between(right, left), rng.between(down, up));
        let scale = rng.of_any_size(0.01, 100.0);
        let mirror = if rng.once_in(2) { -1.0 } else { 1.0 };
        let linear = Mat3::from_quat(Quat::from_axis_angle(rng.direction(), rng.between(-3.0, 3.0)))
            * Mat3::from_diagonal(Vec3::new(scale, scale, mirror * scale));
        let place = rng.direction() * scale;
        let pose = Pose::new(vec![Affine3A::from_mat3_translation(linear, place)]);
        for frame in 0..12 {
            // In front, some far out of range.
            let (azimuth, elevation) = (rng.between(-1.3, 1.3), rng.between(-1.0, 1.0));
            let local = [azimuth.cos() * elevation.cos(), azimuth.sin() * elevation.cos(), elevation.sin()];
            let [forward, left_axis, up_axis] = [axes.forward, axes.left, axes.up].map(Vec3::from);
            let direction = forward * local[0] + left_axis * local[1] + up_axis * local[2];
            let target = place + linear * direction * rng.between(0.3, 5.0);
            let local = local.map(f64::from);
            // Keep only the angles, so that the state holds nothing from earlier targets.
            let before = Joint::from_angles(rig.joints[0].heading(), rig.joints[0].pitch());
            rig.joints[0] = before;
            let step = rate / 60.0;
            let within = |lo: f32, hi: f32, at: f32| [lo.max(at - step), hi.min(at + step)].map(f64::from);
            let headings = within(right, left, before.heading());
            let pitches = within(down, up, before.pitch());
            let aside = f64::from(azimuth) - f64::from(azimuth).clamp(headings[0], headings[1]);

            let mut whole = as_a_chain(&rig);
            let outcome = rig.aim_with(&pose, target, 1.0 / 60.0, &settings);
            let by_whole = whole.aim_with(&pose, target, 1.0 / 60.0, &settings);
            let what = format!("case {case}, frame {frame}: {outcome:?}");
            let [heading, pitch] = [rig.joints[0].heading(), rig.joints[0].pitch()].map(f64::from);
            let holds = |[lo, hi]: [f64; 2], angle: f64| lo - 1e-6 <= angle && angle <= hi + 1e-6;
            assert!(holds(headings, heading) && holds(pitches, pitch), "{what}");
            let remaining = off(local, heading, pitch);
            assert!((remaining - f64::from(outcome.remaining)).abs() < 3e-6, "{what}: {remaining}");
            assert!((remaining.cos() - f64::from(outcome.aim)).abs() < 3e-6, "{what}");
            assert!(outcome.remaining <= by_whole.remaining + 1e-4, "{what} {by_whole:?}");
            assert_eq!(outcome.status == Status::Reached, remaining <= tolerance, "{what}");
            if aside.abs() > 1.0 {
                continue;
            }
            let best = least_off(local, headings, pitches);
            // General axes are orthogonal only to f32 precision, so they are solved like whole chains, by linear steps.
            let cardinal = axes.forward.into_iter().chain(axes.up).all(|x| x == x.round());
            let exact = if cardinal { 1e-5 } else { 2e-2 };
            assert!(remaining < best + exact, "{what}: {remaining} for {best}");
            let ever = least_off(local, [right, left].map(f64::from), [down, up].map(f64::from));
            if outcome.status == Status::Reached {
                reached += 1;
            } else if (ever - tolerance).abs() > 1e-5 {
                let status = if ever < tolerance { Status::RateLimited } else { Status::AtLimit };
                assert_eq!(outcome.status, status, "{what}: {ever}");
                *(if ever < tolerance { &mut hurried } else { &mut limited }) += 1;
            }
            let turned = rig.corrections().next().unwrap().1 * forward;
            let gaze = forward * (pitch.cos() * heading.cos()) as f32
                + left_axis * (pitch.cos() * heading.sin()) as f32
                + up_axis * pitch.sin() as f32;
            assert!(turned.distance(gaze) < 1e-5, "{what}");
        }
    }
    assert!(reached.min(limited).min(hurried) > 50, "{reached}, {limited}, {hurried}");
}

/// A static target is looked at without any movement, and a rate is no way out of a range.
#[test]
fn a_static_target_leaves_the_joint_still() {
    let mut rig = NumericRig::new(vec![NumericRig::thug().infos[0]]);
    let pose = Pose::new(vec![Affine3A::IDENTITY]);
    for target in [[0.2, 1.0, 0.3], [0.9, 1.0, 0.1], [0.1, 1.0, -2.0]].map(Vec3::from) {
        for _ in 0..60 {
            rig.aim(&pose, target, 1.0 / 60.0);
        }
        let before = rig.joints.clone();
        rig.aim(&pose, target, 1.0 / 60.0);
        let angles = |joints: &[Joint]| (joints[0].heading(), joints[0].pitch());
        assert_eq!(angles(&rig.joints.clone()), angles(&before));
    }
    // Outside its range the joint returns at its rate.
    rig.joints[0] = Joint::from_angles(1.5, 0.0);
    let outcome = rig.aim(&pose, Vec3::Y, 1.0 / 60.0);
    let heading = rig.joints[0].heading();
    assert!(
        (1.5 - heading - 450.0 * DEG / 60.0).abs() < 1e-6 && outcome.recovering.contains(0),
        "{heading} {outcome:?}"
    );
}

/// Storing and restoring the state does not change what follows.
#[test]
fn restoring_a_state_at_a_limit_changes_nothing() {
    let mut rig = NumericRig::new(vec![NumericRig::thug().infos[0]]);
    let pose = Pose::new(vec![Affine3A::IDENTITY]);
    let mut at_end = 0;
    for step in 0..2000_u16 {
        let t = f32::from(step);
        let target = Vec3::new(0.3 * (0.05 * t).sin(), 1.0, 2.5 * (0.021 * t).sin());
        let mut anew = rig.clone();
        anew.joints[0] = Joint::from_angles(rig.joints[0].heading(), rig.joints[0].pitch());
        let [kept, taken] = [&mut rig, &mut anew].map(|rig| {
            let outcome = rig.aim(&pose, target, 1.0 / 60.0);
            (outcome, rig.joints[0].heading(), rig.joints[0].pitch())
        });
        let apart = (kept.1 - taken.1).abs().max((kept.2 - taken.2).abs());
        assert!(apart < 1e-6 && (kept.0.remaining - taken.0.remaining).abs() < 2e-6, "{step}: {kept:?}, {taken:?}");
        assert_eq!((kept.0.status, kept.0.at_limit), (taken.0.status, taken.0.at_limit), "{step}");
        at_end += i32::from(kept.0.status == Status::AtLimit);
    }
    assert!(at_end > 500, "{at_end}");
}
