//! The paper's solver: one frame of steepest ascent, joint by joint from the effector inward, each joint along its own
//! unit gradient, as far as its rate allows, and only as far as needed. Never leaves the joints' reach, never makes the
//! aim worse. Its settings ([`Ascent`]) are read here and nowhere else.

use core::f32::consts::PI;

use glam::Affine3A;

use super::exact::settle::{settle, settle_from_rest};
use super::frame::Frame;
use super::turn_round::TURN_BACK_RAD;
use crate::kinematics::chain::rigid_effector;
use crate::kinematics::rotation::joint_turn;
use crate::limits::reach::Reach;
use crate::math::trig;
use crate::target::goal::Goal;
use crate::{Ascent, Joint, math};

/// A joint that changes the angle to the target by less than this part of its own turning is left alone: its gradient
/// is noise, and a unit gradient would follow noise at full rate.
const IDLE: f32 = 1e-3;
/// Nearer than this to exactly behind, neither gradient nor residual has a direction to speak of.
const OPPOSITE_RAD: f32 = 1e-3;
/// More halvings than this leave nothing of a step.
const MOST_HALVINGS: u32 = 24;

/// How near the aim has to be to 1 for the supporting joints to relax, radians.
const AIMED_RAD: f32 = 1.0 * PI / 180.0;
/// An ascent that gains less than this part of what its fastest joint could is as good as stuck.
const STUCK: f32 = 0.1;

/// Moves `joints` by one frame: relaxes the supporting joints, goes on turning round, or ascends and goes on where the
/// ascent ends short of the goal. Returns whether the goal is within reach; `None` where the aim is undefined.
pub(crate) fn advance<const C: usize>(
    frame: &Frame<'_, C>,
    joints: &mut [Joint],
    dt: f32,
    ascent: &Ascent,
) -> Option<bool> {
    let Frame { rig, chain, motions, goal, tolerance, .. } = *frame;
    if let Some(keep) = ascent.relax {
        if frame.angle(joints).is_some_and(|angle| angle <= tolerance.max(AIMED_RAD)) {
            relax(chain.first, keep, dt, joints, &frame.reaches);
        }
    }
    if ascent.finish || ascent.turn_back {
        if let Some(within_reach) = frame.keep_turning_round(joints) {
            return Some(within_reach);
        }
    }
    let before = frame.angle(joints)?;
    let remaining = ascend(frame, joints, ascent)?;
    if remaining <= tolerance {
        return Some(true);
    }
    // Where would the joints get from here, had they the time; and where from rest?
    let mut settled = rig.array(Joint::REST);
    settled.copy_from_slice(joints);
    let from_here = settle(rig, chain, motions, goal, &mut settled).unwrap_or(f32::INFINITY);
    if from_here <= tolerance {
        if ascent.finish {
            finish_at(frame, &settled, joints, before, remaining);
        }
        return Some(true);
    }
    let from_rest = settle_from_rest(rig, chain, motions, goal, &mut settled, tolerance).unwrap_or(f32::INFINITY);
    let within_reach = from_rest <= tolerance;
    let turns_back = ascent.turn_back && from_rest + TURN_BACK_RAD < from_here;
    if turns_back || (ascent.finish && within_reach) {
        frame.turn_round_to(&settled, joints);
    }
    Some(within_reach)
}

/// The end of an ascent that stopped short of a goal within reach: all the way if this frame is enough for it, or
/// towards it where the ascent is stuck.
fn finish_at<const C: usize>(
    frame: &Frame<'_, C>,
    settled: &[Joint],
    joints: &mut [Joint],
    before: f32,
    remaining: f32,
) {
    let Frame { ref reaches, ref start, motions, chain, .. } = *frame;
    let chain = chain.first..chain.count;
    let part = chain
        .clone()
        .map(|index| reaches[index].part_of_way(&start[index], &settled[index], &motions[index]))
        .fold(1.0, f32::min);
    let fastest = reaches[chain.start..].iter().fold(0.0_f32, |step, reach| step.max(reach.step));
    let is_stuck = before - remaining < STUCK * fastest.min(before);
    if part < 1.0 && !is_stuck {
        return;
    }
    let mut straight = frame.rig.array(Joint::REST);
    for index in chain.clone() {
        // The same part of its way for each, so that what makes up for each other moves together.
        straight[index] = reaches[index].part_way(&start[index], &settled[index], &motions[index], part);
    }
    if frame.angle(&straight).is_some_and(|angle| angle < remaining) {
        joints[chain.clone()].copy_from_slice(&straight[chain]);
    } else if is_stuck {
        frame.turn_round_to(settled, joints);
    }
}

/// Ascends towards `goal` for one frame; returns the remaining angle, radians. `None` where the aim is undefined: then
/// the joints are as they were.
///
/// The joints are expected within the frame's reach. Those before the chain's first are not touched.
fn ascend<const C: usize>(frame: &Frame<'_, C>, joints: &mut [Joint], ascent: &Ascent) -> Option<f32> {
    let Frame { rig, chain, goal, tolerance, ref reaches, .. } = *frame;
    let infos = rig.joints;
    let target = goal.aimed;
    let turns = chain.corrections(rig, joints);
    let mut remaining = chain.gaze(&turns).angle_to(target)?;

    // Seen from the effector inward, what lies outward of a joint has not moved yet when its turn comes.
    let mut frames = rig.array(Affine3A::IDENTITY);
    chain.frames(&turns, &mut frames);
    let mut rigid_frames = rig.array(Affine3A::IDENTITY);
    chain.rigid_frames(&turns, &mut rigid_frames);

    let mut effector = chain.effector();
    let mut effector_to_joint = chain.links[chain.first];
    for index in chain.first..chain.count {
        if remaining <= tolerance {
            break;
        }
        let info = &infos[index];
        let reach = &reaches[index];
        let joint = &mut joints[index];
        let mut turn = turns[index];

        let rigid_frame = &rigid_frames[index];
        let rigid_effector = rigid_effector(&rig.effector, &effector_to_joint).turned(turn).through(rigid_frame);
        let seen = chain.seen_target(target, effector.turned(turn).through(&frames[index]), rigid_effector);
        let target_js = math::rigid_inverse(rigid_frame).transform_point3a(seen).to_array();
        let ((sin_p, cos_p), (sin_h, cos_h)) = (trig::sin_cos(joint.pitch), trig::sin_cos(joint.heading));
        let [_, by_pitch, by_heading] = rig.kernels.aim_gradient(
            index,
            &effector_to_joint.to_cols_array(),
            &target_js,
            &[sin_p, cos_p, sin_h, cos_h],
        );

        if let Some((direction, longest)) = step(goal, joint, reach, remaining, [by_pitch, by_heading], ascent) {
            let mut length = longest;
            for _ in 0..=ascent.halvings.min(MOST_HALVINGS) {
                let candidate = reach.hold(&Joint {
                    pitch: joint.pitch + length * direction[0],
                    heading: joint.heading + length * direction[1],
                    ..*joint
                });
                let candidate_turn = joint_turn(info, &candidate);
                let angle = effector.turned(candidate_turn).through(&frames[index]).angle_to(target);
                if let Some(angle) = angle.filter(|&angle| angle < remaining) {
                    (*joint, turn, remaining) = (candidate, candidate_turn, angle);
                    break;
                }
                length *= 0.5;
            }
        }

        if index + 1 < chain.count {
            effector = chain.outward(index, effector.turned(turn));
            effector_to_joint = chain.links[index + 1] * (Affine3A::from_quat(turn) * effector_to_joint);
        }
    }
    Some(remaining)
}

/// The unit step (pitch, heading) of a joint, and its length in radians.
fn step(
    goal: &Goal,
    joint: &Joint,
    reach: &Reach,
    remaining: f32,
    gradient: [f32; 2],
    ascent: &Ascent,
) -> Option<([f32; 2], f32)> {
    if remaining > PI - OPPOSITE_RAD {
        return [[0.0, goal.side.sign()], [0.0, -goal.side.sign()], [1.0, 0.0], [-1.0, 0.0]]
            .into_iter()
            .find(|&[pitch, heading]| {
                !(reach.pitch_at(joint.heading).blocks(joint.pitch, pitch)
                    || reach.heading.blocks(joint.heading, heading))
            })
            .map(|direction| (direction, reach.step));
    }
    // An angle that cannot follow the gradient leaves it before it is made a unit: the other then gets the full rate.
    let [by_pitch, by_heading] = gradient;
    let by_pitch = if reach.pitch_at(joint.heading).blocks(joint.pitch, by_pitch) { 0.0 } else { by_pitch };
    let by_heading = if reach.heading.blocks(joint.heading, by_heading) { 0.0 } else { by_heading };
    let norm = math::sqrt(by_pitch * by_pitch + by_heading * by_heading);
    // The aim is a cosine: its gradient over the sine is that of the angle.
    let (sin, _) = trig::sin_cos(remaining);
    if !(norm.is_finite() && norm > IDLE * sin) {
        return None;
    }
    let needed = if ascent.finish { remaining * sin / norm } else { f32::INFINITY };
    Some(([by_pitch / norm, by_heading / norm], reach.step.min(needed)))
}

/// The joints behind the chain's first moved a little towards rest, by the part of their angles that the ascent's
/// settings say, within their reach.
fn relax(chain_first: usize, keep: f32, dt: f32, joints: &mut [Joint], reaches: &[Reach]) {
    // Linear in time, so that it is the stated part at 60 frames a second and nearly the same speed at others.
    let keep = (1.0 - (1.0 - keep.max(0.0).min(1.0)) * 60.0 * dt).max(0.0);
    for (joint, reach) in joints.iter_mut().zip(reaches).skip(chain_first + 1) {
        *joint = reach.hold(&Joint { pitch: keep * joint.pitch, heading: keep * joint.heading, ..*joint });
    }
}
