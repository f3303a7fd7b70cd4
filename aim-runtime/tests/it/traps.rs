//! Typical faults of whole-chain solvers, each measured in some prototype.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "frames are counted")]

use crate::common::truth::seen64;
use crate::common::*;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Behind, Joint, Outcome, Pose, Role, Settings, Solver, Status};

const SOLVERS: [Solver; 2] = [Solver::Exact, Solver::Natural];
const TOLERANCE_RAD: f64 = 0.1 * core::f64::consts::PI / 180.0;

fn person() -> NumericRig {
    let mut rig = NumericRig::thug();
    for (info, role) in rig.infos.iter_mut().zip([Role::Eye, Role::Neck, Role::Chest]) {
        *info = info.with_role(role);
    }
    rig
}

/// Returns a target at this distance from the eye, this many degrees to the left and up.
fn at(heading_deg: f32, pitch_deg: f32, distance: f32) -> Vec3 {
    let turn = Quat::from_rotation_y(heading_deg * DEG) * Quat::from_rotation_x(pitch_deg * DEG);
    Vec3::new(-0.03, 1.68, -0.1) + turn * WORLD[0] * distance
}

fn angles(rig: &NumericRig) -> Vec<f32> {
    rig.joints.iter().flat_map(|joint| [joint.heading(), joint.pitch()]).collect()
}

/// Runs one frame; asserts that no rate is exceeded. Returns the outcome and the largest change of an angle.
fn frame(rig: &mut NumericRig, pose: &[Affine3A], target: Vec3, hz: f32, settings: &Settings) -> (Outcome, f32) {
    let before = angles(rig);
    let outcome = rig.aim_with(&Pose::new(pose.to_vec()), target, 1.0 / hz, settings);
    let mut largest = 0.0_f32;
    for (index, (new, old)) in angles(rig).iter().zip(&before).enumerate() {
        let free = rig.infos[index / 2].heading.is_some_and(|[lo, _]| lo == f32::NEG_INFINITY);
        let moved = (new - old).abs();
        let moved = if free { moved.min((moved - core::f32::consts::TAU).abs()) } else { moved };
        assert!(moved <= rig.infos[index / 2].rate / hz + 1e-6, "{settings:?}: from {old} to {new}");
        largest = largest.max(moved);
    }
    (outcome, largest)
}

/// Returns random angles within the ranges.
fn anywhere(rig: &NumericRig, rng: &mut Rng) -> Vec<Joint> {
    let mut pick = |[lo, hi]: [f32; 2]| rng.between(0.95 * lo, 0.95 * hi);
    rig.infos
        .iter()
        .map(|info| {
            let heading = pick(info.heading.unwrap_or_default());
            Joint::from_angles(heading, pick(info.pitch.unwrap_or_default()))
        })
        .collect()
}

/// One: The stereographic residual has a false zero where its denominator is clamped: a target nearly behind would be
///    solved by looking away from it.
#[test]
fn a_target_behind_is_not_solved_by_looking_away() {
    let mut rng = Rng(1);
    for solver in SOLVERS {
        let settings = Settings::default().with_solver(solver).with_behind(Behind::Off);
        for off in [172.0, 175.0, 178.0, 179.9, 180.0_f32] {
            for _ in 0..6 {
                // A joint that can look anywhere, with a random gaze.
                let mut rig = NumericRig::ball(THUG);
                rig.joints = vec![Joint::from_angles(rng.between(-3.0, 3.0), rng.between(-1.0, 1.0))];
                let pose = [bone(&THUG, Quat::IDENTITY, Vec3::ZERO)];
                let gaze = Vec3::from(gaze64(&rig, &pose, 0).1.map(|x| x as f32));
                let target = Quat::from_axis_angle(gaze.cross(rng.direction()).normalize(), off * DEG) * gaze * 2.0;
                // Straight up and down are out of its reach.
                if target.normalize().y.abs() > 0.95 {
                    continue;
                }
                for _ in 0..90 {
                    frame(&mut rig, &pose, target, 60.0, &settings);
                }
                assert!(remaining64(&rig, &pose, 0, target) < TOLERANCE_RAD, "{solver:?}, {off}: {:?}", rig.joints);

                // A rig that cannot look there: it gets as near as it can and is never reported as on target.
                let mut rig = person();
                rig.joints = anywhere(&rig, &mut rng);
                let pose = upright(&rig);
                let target = at(off * [1.0, -1.0][rng.below(2)], rng.between(-5.0, 5.0), 3.0);
                let mut outcome = frame(&mut rig, &pose, target, 60.0, &settings).0;
                for _ in 0..150 {
                    outcome = frame(&mut rig, &pose, target, 60.0, &settings).0;
                    assert_eq!(outcome.status, Status::AtLimit);
                }
                let snapped = rig.clone().snap_with(&Pose::new(pose), target, &settings);
                assert!(outcome.remaining < snapped.remaining + DEG, "{solver:?}, {off}: {outcome:?} {snapped:?}");
            }
        }
    }
}

/// Two: Active sets without a line search get stuck, or come to rest far from the least displacement: the final angles
///    must be the same from any state as from rest.
#[test]
fn active_sets_do_not_stick() {
    let mut rng = Rng(2);
    for solver in SOLVERS {
        let settings = Settings::default().with_solver(solver);
        for case in 0..150 {
            let mut rig = person();
            // This test requires the exact optimum for each bone, so without upright tilts.
            for info in &mut rig.infos {
                *info = info.with_upright(0.0);
            }
            let pose = animated(&rig, &mut rng, 0.1);
            rig.joints = anywhere(&rig, &mut rng);
            let target = ahead(&rig, &pose, 0, rng.between(0.5, 5.0));
            let mut from_rest = rig.clone();
            from_rest.reset();
            let snapped = from_rest.snap_with(&Pose::new(pose.clone()), target, &settings);
            assert_eq!(snapped.status, Status::Reached, "{solver:?}, case {case}");
            rig.joints = anywhere(&rig, &mut rng);
            for _ in 0..240 {
                frame(&mut rig, &pose, target, 60.0, &settings);
            }
            assert!(remaining64(&rig, &pose, 0, target) < TOLERANCE_RAD, "{solver:?}, case {case}");
            if solver == Solver::Exact {
                for (a, b) in angles(&rig).iter().zip(angles(&from_rest)) {
                    assert!((a - b).abs() < 0.1 * DEG, "case {case}: {:?} {:?}", angles(&rig), angles(&from_rest));
                }
            }
        }
    }
}

/// Three: With an orbiting target, the head stays at the limit where the target went out of reach, although it is
///    within reach again on the other side.
#[test]
fn an_orbiting_target_is_followed_on_the_other_side() {
    for settings in SOLVERS.into_iter().flat_map(|solver| {
        [Behind::Off, Behind::Clip].map(|behind| Settings::default().with_solver(solver).with_behind(behind))
    }) {
        for seconds in [4.0, -8.0, 20.0_f32] {
            let mut rig = person();
            let pose = upright(&rig);
            let (mut blocked, mut longest) = (0, 0);
            for step in 0..(1.4 * seconds.abs() * 60.0) as u16 {
                let turn = Quat::from_rotation_y(core::f32::consts::TAU * f32::from(step) / 60.0 / seconds);
                let target = Vec3::new(-0.03, 1.6, -0.1) + turn * (WORLD[0] * 2.0);
                let (outcome, _) = frame(&mut rig, &pose, target, 60.0, &settings);
                let is_blocked = outcome.status != Status::Reached
                    && rig.clone().snap_with(&Pose::new(pose.clone()), target, &settings).status == Status::Reached;
                blocked = if is_blocked { blocked + 1 } else { 0 };
                longest = longest.max(blocked);
            }
            // From one side to the other the neck takes 120° at 170°/s and the spine 40° at 70°/s, plus the target's
            // movement meanwhile.
            assert!(longest <= 50, "{settings:?}, {seconds} s: {longest} frames");
        }
    }
}

/// Four: Overhead, where heading has no effect, a trembling target made the head turn at its full rate.
#[test]
fn a_jittering_target_overhead_does_not_turn_the_head() {
    let mut rng = Rng(4);
    for settings in SOLVERS.into_iter().flat_map(|solver| {
        [Behind::Off, Behind::Clip].map(|behind| Settings::default().with_solver(solver).with_behind(behind))
    }) {
        for _ in 0..4 {
            let mut rig = person();
            let pose = animated(&rig, &mut rng, 0.1);
            let target = Vec3::new(-0.03, 1.68, -0.1) + (Vec3::Y + 0.05 * rng.direction()).normalize() * 2.0;
            for step in 0..300 {
                let noise = Vec3::new(rng.between(-1.0, 1.0), rng.between(-1.0, 1.0), rng.between(-1.0, 1.0)) * 1e-3;
                let (_, moved) = frame(&mut rig, &pose, target + noise, 60.0, &settings);
                assert!(step < 240 || moved <= 0.2 * DEG, "{settings:?}, {step}: {}", moved / DEG);
            }
        }
    }
}

/// Five: A single linear step while the neck returns to its share loses the target by 0.1° at 60 Hz and 0.34° at 30 Hz.
///    If neck and spine return each at its own pace, they leave more to the eye than it can turn and lose it by degrees.
///
///    A natural gaze still loses it if the eye is in a corner of its range while a moving trunk rolls the head: from
///    one start in 800, by less than 2°.
#[test]
fn the_target_is_kept_while_the_neck_returns() {
    let mut rng = Rng(5);
    for solver in SOLVERS {
        let settings = Settings::default().with_solver(solver);
        let (cases, most) = if solver == Solver::Natural { (1000, 10) } else { (100, 0) };
        let mut lost = Vec::new();
        for hz in [30.0, 60.0, 144.0] {
            for case in 0..cases {
                let mut rig = person();
                let pose = upright(&rig);
                rig.joints = anywhere(&rig, &mut rng);
                let target = ahead(&rig, &pose, 0, rng.between(0.5, 5.0));
                let (mut arrived, mut worst, mut last) = (false, 0.0_f64, 0.0);
                for _ in 0..(3.0 * hz) as u16 {
                    let (outcome, _) = frame(&mut rig, &pose, target, hz, &settings);
                    arrived |= outcome.status == Status::Reached;
                    last = angle_to64(seen64(&rig, &pose, 0), target).to_degrees();
                    worst = if arrived { worst.max(last) } else { worst };
                }
                assert!(arrived && last < 0.05, "{solver:?}, {hz} Hz, case {case}: {last}");
                assert!(worst < 2.0, "{solver:?}, {hz} Hz, case {case}: {worst}");
                if worst > 0.05 {
                    lost.push((hz, case, worst));
                }
            }
        }
        assert!(lost.len() <= most, "{solver:?}: {lost:?}");
    }
}

/// Six: For an inverted range, its middle counts; the angle moves there at its rate and is reported as recovering.
#[test]
fn an_inverted_range_counts_as_its_middle() {
    for solver in SOLVERS {
        let settings = Settings::default().with_solver(solver);
        let mut rig = person();
        let pose = upright(&rig);
        rig.snap_with(&Pose::new(pose.clone()), at(80.0, 5.0, 3.0), &settings);
        assert!(rig.joints[1].heading() > 20.0 * DEG);
        rig.infos[1].heading = Some([4.0 * DEG, -8.0 * DEG]);
        rig.infos[1].pitch = Some([f32::NAN, 0.1]);
        for _ in 0..120 {
            let before = rig.joints[1].heading();
            let (outcome, moved) = frame(&mut rig, &pose, at(80.0, 5.0, 3.0), 60.0, &settings);
            let heading = rig.joints[1].heading();
            let out = (heading + 2.0 * DEG).abs();
            assert_eq!(outcome.recovering.contains(1), out > 0.0 || rig.joints[1].pitch() != 0.0, "{heading}");
            assert!(out == 0.0 || before - heading > 169.0 * DEG / 60.0, "at its rate: {moved}");
            assert!(sound(&rig));
        }
        assert_eq!(rig.joints[1].heading(), -2.0 * DEG);
        assert_eq!(rig.joints[1].pitch(), 0.0);
    }
}

/// Seven: Half-angle polynomials are accurate to ±180° of the whole angle: ranges beyond that, and headings that turn
///    endlessly, are wrapped into this interval.
#[test]
fn ranges_beyond_half_a_turn_are_wrapped() {
    for solver in SOLVERS {
        let settings = Settings::default().with_solver(solver);
        for range in [[-270.0 * DEG, 270.0 * DEG], [-1e3, 1e3], [f32::NEG_INFINITY, f32::INFINITY]] {
            let mut rig = NumericRig::ball(THUG);
            rig.infos[0].heading = Some(range);
            rig.infos[0].rate = 4.0;
            let pose = [bone(&THUG, Quat::IDENTITY, Vec3::ZERO)];
            let (mut reached, frames) = (0, 900_u16);
            for step in 0..frames {
                let turn = Quat::from_rotation_y(1.5 * f32::from(step) / 60.0);
                let target = turn * WORLD[0] * 2.0 + Vec3::Y * 0.3;
                let (outcome, _) = frame(&mut rig, &pose, target, 60.0, &settings);
                let left = remaining64(&rig, &pose, 0, target);
                assert!(
                    (left - f64::from(outcome.remaining)).abs() < 2e-5,
                    "{solver:?}, {range:?}: {left} {outcome:?}"
                );
                reached += u16::from(outcome.status == Status::Reached);
                let heading = rig.joints[0].heading();
                let most = if range[1] == f32::INFINITY { core::f32::consts::PI } else { core::f32::consts::TAU };
                assert!(heading.abs() <= most + 1e-6, "{solver:?}, {range:?}: {heading}");
            }
            // A free heading never loses the target; the others turn back at their limit.
            let least = if range[1] == f32::INFINITY { frames - 60 } else { frames / 3 };
            assert!(reached >= least, "{solver:?}, {range:?}: {reached} of {frames}");
        }
    }
}

/// Stiffnesses matter by their ratios alone.
#[test]
fn only_ratios_of_stiffness_matter() {
    let mut rng = Rng(8);
    for solver in SOLVERS {
        let settings = Settings::default().with_solver(solver);
        for case in 0..40 {
            let mut rigs = [1e-3, 1.0, 1e3].map(|by| {
                let mut rig = person();
                rig.infos.iter_mut().for_each(|info| *info = info.with_stiffness(info.stiffness * by));
                rig
            });
            let pose = animated(&rigs[0], &mut rng, 0.1);
            let target = at(rng.between(-90.0, 90.0), rng.between(-30.0, 30.0), 2.0);
            for _ in 0..90 {
                rigs.iter_mut().for_each(|rig| {
                    frame(rig, &pose, target, 60.0, &settings);
                });
                let [a, b, c] = rigs.each_ref().map(angles);
                for ((a, b), c) in a.iter().zip(&b).zip(&c) {
                    assert!((a - b).abs() < 1e-4 && (b - c).abs() < 1e-4, "{solver:?}, case {case}: {a} {b} {c}");
                }
            }
        }
    }
}
