//! Tests of other aiming solvers, under their names, and cases in which those solvers fail. Run under identity,
//! translated, rotated, scaled, stretched and mirrored parents, for rigs of a hundredth to a hundred times their size,
//! with every solver. The corrections are checked by independent forward kinematics in f64.
#![allow(clippy::cast_possible_truncation, clippy::cast_precision_loss, reason = "frames are counted, f64 is rounded")]

mod continuity;
mod effectors;
mod holes;
mod jobs;
mod named;

use crate::common::truth::{animated64, seen64};
use crate::common::*;
use aim_runtime::glam::{Affine3A, Quat, Vec3};
use aim_runtime::{Joint, Outcome, Pose, Role, Settings, Solver, Status};

const TOLERANCE_RAD: f64 = 0.1 * core::f64::consts::PI / 180.0;
const SCALES: [f32; 3] = [0.01, 1.0, 100.0];
const SOLVERS: [Solver; 3] = [Solver::Exact, Solver::Natural, Solver::Ascent];
const DT: f32 = 1.0 / 60.0;

/// Returns every parent at every scale: a name, the transform, and `true` if it preserves shapes.
fn worlds() -> impl Iterator<Item = (String, Affine3A, bool)> {
    parents().into_iter().flat_map(|(name, parent, similar)| {
        SCALES
            .into_iter()
            .map(move |scale| (format!("{name} × {scale}"), Affine3A::from_scale(Vec3::splat(scale)) * parent, similar))
    })
}

fn moved(parent: &Affine3A, pose: &[Affine3A]) -> Vec<Affine3A> {
    pose.iter().map(|joint| *parent * *joint).collect()
}

/// Returns eye, neck and spine with roles, so that the natural solver can share turns.
fn person() -> NumericRig {
    let mut rig = NumericRig::thug();
    for (info, role) in rig.infos.iter_mut().zip([Role::Eye, Role::Neck, Role::Chest]) {
        *info = info.with_role(role);
    }
    rig
}

fn offset_ball(origin: [f32; 3]) -> NumericRig {
    let mut rig = NumericRig::ball(THUG);
    rig.effector.origin = origin;
    rig
}

/// Returns the ball's single bone, at the world's origin.
fn alone() -> [Affine3A; 1] {
    [bone(&THUG, Quat::IDENTITY, Vec3::ZERO)]
}

/// Aims frame by frame for some seconds, or until nothing changes any more.
fn aim_for(rig: &mut NumericRig, pose: &[Affine3A], target: Vec3, seconds: f32, settings: &Settings) -> Outcome {
    let pose = Pose::new(pose.to_vec());
    let (mut outcome, mut unchanged) = (rig.aim_with(&pose, target, DT, settings), 0);
    for _ in 1..(seconds * 60.0) as usize {
        let before = rig.joints.clone();
        outcome = rig.aim_with(&pose, target, DT, settings);
        assert_within_limits(rig, &before, DT, "on the way");
        let angles = |joints: &[Joint]| joints.iter().map(|j| [j.heading(), j.pitch()]).collect::<Vec<_>>();
        unchanged = if angles(&before) == angles(&rig.joints) { unchanged + 1 } else { 0 };
        if unchanged > if outcome.status == Status::Reached { 1 } else { 30 } {
            break;
        }
    }
    outcome
}

/// Asserts that no angle has left its range or moved faster than its rate.
fn assert_within_limits(rig: &NumericRig, before: &[Joint], dt: f32, case: &str) {
    for (index, ((info, old), new)) in rig.infos.iter().zip(before).zip(&rig.joints).enumerate() {
        for (range, old, new) in [(info.heading, old.heading(), new.heading()), (info.pitch, old.pitch(), new.pitch())]
        {
            let [lo, hi] = range.unwrap_or([0.0, 0.0]);
            assert!((lo..=hi).contains(&new), "{case}: joint {index} is at {new}");
            assert!((new - old).abs() <= info.rate * dt + 1e-6, "{case}: joint {index} from {old} to {new}");
        }
    }
    assert!(sound(rig), "{case}");
}

/// Aims with every solver, by snap and frame by frame, and checks each outcome.
fn solve_by_every_solver(
    rig: &NumericRig,
    pose: &[Affine3A],
    target: Vec3,
    case: &str,
) -> Vec<(NumericRig, Outcome, String)> {
    let mut ways = Vec::new();
    for solver in SOLVERS {
        let settings = Settings::default().with_solver(solver);
        let (mut snapped, mut stepped) = (rig.clone(), rig.clone());
        let snap = snapped.snap_with(&Pose::new(pose.to_vec()), target, &settings);
        let step = aim_for(&mut stepped, pose, target, 4.0, &settings);
        ways.push((snapped, snap, format!("{case}, {solver:?}, snap")));
        ways.push((stepped, step, format!("{case}, {solver:?}, frames")));
    }
    for (rig, outcome, case) in &ways {
        assert_true_outcome(rig, pose, 0, target, outcome, case);
    }
    ways
}

/// Asserts that the outcome of a call is right.
fn assert_true_outcome(
    rig: &NumericRig,
    pose: &[Affine3A],
    effector: usize,
    target: Vec3,
    outcome: &Outcome,
    case: &str,
) {
    assert!(sound(rig), "{case}");
    if outcome.status == Status::Degenerate {
        return;
    }
    let left = angle_to64(seen64(rig, pose, effector), target);
    assert!((left - f64::from(outcome.remaining)).abs() < 3e-5, "{case}: {left} but {outcome:?}");
    assert_eq!(outcome.status == Status::Reached, outcome.remaining <= TOLERANCE_RAD as f32, "{case}");
    assert!((outcome.aim - outcome.remaining.cos()).abs() < 2e-6, "{case}");
}

fn assert_reached(rig: &NumericRig, pose: &[Affine3A], target: Vec3, case: &str) {
    for (_, outcome, case) in solve_by_every_solver(rig, pose, target, case) {
        assert_eq!(outcome.status, Status::Reached, "{case}: {outcome:?}");
    }
}
