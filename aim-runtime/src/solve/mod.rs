//! The solvers: from a pose and a target to joint angles within range and rate, and an outcome measured by forward
//! kinematics.
//!
//! [`follow`] serves frames that need no search, by the specialised solvers [`single`](exact::single) and
//! [`following`](exact::following). For every other frame, [`solve`] prepares the pose ([`Chain`]), determines the goal
//! ([`Goal`](crate::target::goal::Goal)), moves the joints by one of the solvers ([`exact`], [`natural`], [`ascent`]),
//! moves both eyes if the pose has them ([`eyes`]), and judges the result ([`judge`]). [`turn_round`] decides when
//! blocked joints turn the other way round.

pub(crate) mod ascent;
mod call;
pub(crate) mod exact;
pub(crate) mod eyes;
mod frame;
pub(crate) mod judge;
mod natural;
mod task;
mod turn_round;

use glam::{Affine3A, Quat};

pub(crate) use self::call::{Call, LONGEST_FRAME_S};
use self::call::{solver, upright_axis};
use self::exact::settle::{settle, settle_from_rest};

use self::exact::{following, single};
use self::eyes::{Eyes, other_eye_correction};
use self::frame::Frame;
use self::judge::degenerate;
use self::task::{SolveOutput, Task};
use crate::kinematics::chain::{Chain, corrections_of, tilts};
use crate::limits::RangeOfMotion;
use crate::limits::motion::{find_motions, mirror};
use crate::limits::reach::Reach;
use crate::rig::{ChainRig, HeadGoal, Memory, PoseSlices, StateSlices, Support};
use crate::target::behind::Front;
use crate::target::goal::{Goal, Movement, Scene, Seen};
use crate::{Behind, Description, Joint, JointInfo, Outcome, Rig, Role, Settings, Solver};

/// Number of times that a snap of two eyes is repeated, so that the ranges left by convergence are those at the final head
/// pose.
const SNAP_ROUNDS: usize = 4;

/// Serves a frame that needs no search: moves `state` and writes the joints' corrections. Returns `None`, with nothing
/// changed, if the frame needs one.
#[inline(always)]
pub(crate) fn follow<K: Rig + ?Sized>(
    kernels: &K,
    rig: &Description<'_>,
    state: &mut StateSlices<'_>,
    pose: &PoseSlices<'_>,
    call: &Call<'_>,
    corrections: &mut [Quat],
) -> Option<Outcome> {
    let solver = call.settings.solver.unwrap_or(rig.default_solver());
    // Of the rigs for the natural solver, only a single eye or a single joint without a role is served here.
    let is_alone = matches!(rig.joints, [JointInfo { role: Role::Eye | Role::None, .. }]);
    if solver == Solver::Natural && !is_alone || cfg!(aim_natural) {
        return None;
    }
    if !call.dt.is_some_and(|dt| dt > 0.0)
        || pose.other_eye.is_some()
        || solver == Solver::Ascent
        || call.settings.behind == Behind::Plane
        || !state.memory.is_undisturbed()
    {
        return None;
    }
    if let Some(outcome) = single::aim(rig, state, pose, call, corrections) {
        return Some(outcome);
    }
    // Excluded from small builds, because this path is monomorphised for each number of joints.
    let follows = solver == Solver::Exact && cfg!(not(aim_small));
    if follows { following::aim(kernels, rig, state, pose, call, corrections) } else { None }
}

/// Serves any call: moves `state` and writes one correction for each joint.
#[inline(never)]
pub(crate) fn solve<const C: usize>(
    rig: &ChainRig<'_, C>,
    state: &mut StateSlices<'_>,
    pose: &PoseSlices<'_>,
    call: &Call<'_>,
    corrections: &mut [Quat],
) -> Outcome {
    let mut motions = find_motions(rig, pose);
    let mut joints = rig.array_from(state.joints, Joint::REST);
    let before = *state.memory;
    let output = SolveOutput { joints: &mut joints, memory: state.memory, corrections, eyes: None };
    let outcome = match pose.other_eye {
        Some(other_eye) => aim_eyes(rig, pose, other_eye, &mut motions, call, output),
        None => {
            output.memory.forget_eyes();
            solve_chain(rig, pose, &mut motions, call, output)
        }
    };
    if outcome.is_some() && call.dt != Some(0.0) {
        joints.copy_to(state.joints);
    } else {
        *state.memory = before;
    }
    match outcome {
        Some(outcome) => outcome,
        None => {
            corrections.copy_from_slice(&tilts(rig, pose.joints, upright_axis(pose, solver(rig, call.settings))));
            let other_eye = state.memory.other_eye();
            let held = other_eye.and_then(|angles| other_eye_correction(rig, pose, angles, *corrections.first()?));
            corrections_of(rig, state.joints, corrections);
            Outcome { other_eye_correction: held, ..degenerate(rig, &find_motions(rig, pose), state.joints) }
        }
    }
}

/// Moves both eyes and the chain.
#[inline(never)]
fn aim_eyes<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &PoseSlices<'_>,
    other_eye: &Affine3A,
    motions: &mut [RangeOfMotion],
    call: &Call<'_>,
    output: SolveOutput<'_, C>,
) -> Option<Outcome> {
    let mut eye_motions = [motions[0]; 2];
    mirror(rig, pose, &mut eye_motions[1]);
    let own = output.joints[0].angles();
    let [other, leading] = output.memory.eyes().unwrap_or([[0.0; 2], own]);
    let eyes = Eyes::new(rig, pose, other_eye, &eye_motions, call, [own, other]);
    let joints = eyes.lead(&mut output.joints[0], leading);
    let pose = PoseSlices { joints: &joints, ..*pose };
    let output = SolveOutput { eyes: Some(&eyes), ..output };
    if call.dt.is_some() {
        solve_chain(rig, &pose, motions, call, output)
    } else {
        snap_eyes(&eyes, motions, output, |motions, output| solve_chain(rig, &pose, motions, call, output))
    }
}

/// Runs a snap of the chain with `solve`. The range that convergence leaves depends on the final head pose: a frame
/// takes it from the last frame, a snap iterates.
#[cold]
fn snap_eyes<const C: usize>(
    eyes: &Eyes<'_, C>,
    motions: &mut [RangeOfMotion],
    SolveOutput { joints, memory, corrections, .. }: SolveOutput<'_, C>,
    solve: impl Fn(&mut [RangeOfMotion], SolveOutput<'_, C>) -> Option<Outcome>,
) -> Option<Outcome> {
    let before = (*joints, *memory);
    joints.fill(Joint::REST);
    let mut outcome = None;
    for _ in 0..SNAP_ROUNDS {
        eyes.converge(motions, || eyes.distance(joints));
        (*joints, *memory) = before;
        outcome = Some(solve(motions, SolveOutput { joints, memory, corrections, eyes: Some(eyes) })?);
    }
    outcome
}

/// Moves a chain by the selected solver.
#[inline(always)]
fn solve_chain<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &PoseSlices<'_>,
    motions: &mut [RangeOfMotion],
    call: &Call<'_>,
    output: SolveOutput<'_, C>,
) -> Option<Outcome> {
    let SolveOutput { joints, memory, corrections, eyes } = output;
    if moves_by_regions(rig, call.settings) {
        let about = upright_axis(pose, Solver::Natural);
        if call.dt.is_some() {
            return natural::aim(rig, pose, motions, call, about, SolveOutput { joints, memory, corrections, eyes });
        }
        // A snap that is undefined from rest may be defined from another start, which the search below may find.
        let before = *joints;
        let output = SolveOutput { joints, memory, corrections, eyes };
        let outcome = natural::aim(rig, pose, motions, call, about, output);
        if outcome.is_some() {
            return outcome;
        }
        *joints = before;
    }
    if cfg!(aim_natural) {
        return None;
    }
    let output = SolveOutput { joints, memory, corrections, eyes };
    match call.dt {
        Some(dt) => {
            if let Some(eyes) = eyes {
                eyes.converge(motions, || eyes.distance(output.joints));
            }
            aim_joints(rig, pose, motions, call, dt, output)
        }
        None => snap_joints(rig, pose, motions, call, output),
    }
}

/// Returns `true` if the natural solver moves the joints by regions. The exact solver serves an eye without support, a
/// single joint without a role, and rigs with axes that are not mutually perpendicular.
fn moves_by_regions<const C: usize>(rig: &ChainRig<'_, C>, settings: &Settings) -> bool {
    let count = rig.joints.len();
    let first = settings.effector.min(count.saturating_sub(1));
    let is_alone = count == first + 1 && matches!(rig.joints[first].role, Role::Eye | Role::None);
    solver(rig, settings) == Solver::Natural && rig.is_square && !is_alone
}

/// Returns `true` if the joints of a natural gaze have the indices that chains of
/// [`EXACT_JOINTS`](crate::rig::EXACT_JOINTS) expect, or if the gaze is not natural.
#[cfg(not(aim_small))]
pub(crate) fn has_known_layout(rig: &Description<'_>, settings: &Settings) -> bool {
    rig.is_eye_head_chest() && settings.effector == 0
        || settings.solver.unwrap_or(rig.default_solver()) != Solver::Natural
}

/// Clears the memory of a natural gaze.
fn forget_natural(joints: &mut [Joint], memory: &mut Memory) {
    if memory.support != Support::None {
        joints.iter_mut().for_each(|joint| joint.set_destination(None));
        memory.set_head_goal(HeadGoal::default());
        memory.set_extra_turn([0.0; 2]);
        (memory.blocked_s, memory.caution) = (0.0, 0);
        memory.support = Support::None;
    }
}

/// Moves `joints` by a frame of `dt` seconds; `None` if there is nothing to aim.
fn aim_joints<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &PoseSlices<'_>,
    motions: &[RangeOfMotion],
    call: &Call<'_>,
    dt: f32,
    SolveOutput { joints, memory, corrections, eyes }: SolveOutput<'_, C>,
) -> Option<Outcome> {
    let settings = call.settings;
    let solver = solver(rig, settings);
    let about = upright_axis(pose, solver);
    let chain = Chain::new(rig, pose.joints, settings.effector, about)?;
    let goal = goal(rig, &chain, pose, motions, call, memory)?;
    let frame = Frame::new(rig, &chain, motions, &goal, dt, settings.effective_tolerance(), joints);

    for (joint, reach) in joints.iter_mut().zip(&*frame.reaches) {
        *joint = reach.hold(joint);
    }
    let mut within_reach = true;
    frame.go_to_rest(joints, 0..chain.first);
    forget_natural(joints, memory);
    match goal.movement {
        Movement::Rest => frame.go_to_rest(joints, chain.first..chain.count),
        Movement::Stay => {}
        Movement::Aim => {
            within_reach = match solver {
                Solver::Ascent => ascent::advance(&frame, joints, dt, &settings.ascent)?,
                Solver::Exact | Solver::Natural => exact::advance::advance(&frame, joints, dt, memory)?,
            };
        }
    }
    if dt == 0.0 {
        joints.copy_from_slice(&frame.start);
    } else {
        joints.iter_mut().for_each(|joint| joint.velocity = [0.0; 2]);
    }
    let task = Task { rig, motions, goal: &goal, space: chain.space(), settings, within_reach, well_within: false };
    task.finish_chain(&chain, SolveOutput { joints, memory, corrections, eyes })
}

/// Puts `joints` on the target regardless of rates; `None` if there is nothing to aim.
fn snap_joints<const C: usize>(
    rig: &ChainRig<'_, C>,
    pose: &PoseSlices<'_>,
    motions: &[RangeOfMotion],
    call: &Call<'_>,
    SolveOutput { joints, memory, corrections, eyes }: SolveOutput<'_, C>,
) -> Option<Outcome> {
    let settings = call.settings;
    let solver = solver(rig, settings);
    let about = upright_axis(pose, solver);
    let tolerance = settings.effective_tolerance();
    let chain = Chain::new(rig, pose.joints, settings.effector, about)?;
    let goal = goal(rig, &chain, pose, motions, call, memory)?;
    // A target on the animated effector has no direction, even if the joints could give it one.
    chain.animated_gaze().angle_to(goal.aim_point)?;
    joints.iter_mut().for_each(|joint| joint.velocity = [0.0; 2]);
    forget_natural(joints, memory);

    let mut from_here = rig.array(Joint::REST);
    from_here.copy_from_slice(joints);
    from_here[..chain.first].fill(Joint::REST);
    joints.fill(Joint::REST);
    if goal.movement == Movement::Stay {
        joints.copy_from_slice(&from_here);
    }
    for (joint, motion) in joints.iter_mut().zip(motions) {
        *joint = Reach::range(motion).hold(joint);
    }
    if goal.movement == Movement::Aim {
        // The aim may be undefined at rest but defined at the present angles, or the reverse.
        let from_rest = settle_from_rest(rig, &chain, motions, &goal, joints, tolerance).unwrap_or(f32::INFINITY);
        if from_rest > tolerance {
            let from_here_rad = settle(rig, &chain, motions, &goal, &mut from_here);
            if from_here_rad.is_some_and(|from_here_rad| from_here_rad < 0.999 * from_rest) {
                joints.copy_from_slice(&from_here);
            }
        }
        // Joints outward of the aimed one rest, as far as their ranges allow.
        for (joint, motion) in joints[..chain.first].iter_mut().zip(motions) {
            *joint = Reach::range(motion).hold(joint);
        }
    }
    let task =
        Task { rig, motions, goal: &goal, space: chain.space(), settings, within_reach: false, well_within: false };
    task.finish_chain(&chain, SolveOutput { joints, memory, corrections, eyes })
}

/// Determines the goal of a chain.
fn goal<const C: usize>(
    rig: &ChainRig<'_, C>,
    chain: &Chain<C>,
    pose: &PoseSlices<'_>,
    motions: &[RangeOfMotion],
    call: &Call<'_>,
    memory: &Memory,
) -> Option<Goal> {
    let gaze = chain.animated_gaze();
    let scene = Scene {
        space: chain.space(),
        gaze,
        front: Front::new(&(chain.base.matrix3 * rig.joints[chain.count - 1].planes.basis), gaze),
        rig: rig.description,
        first: chain.first,
        motions,
        bearings: None,
        has_two_eyes: pose.other_eye.is_some(),
    };
    Goal::new(&scene, call.target_ps.into(), call.settings, Seen::of(memory, call.dt.is_some()))
}
