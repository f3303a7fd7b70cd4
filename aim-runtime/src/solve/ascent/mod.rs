//! The paper's solver: one frame of steepest ascent, joint by joint from the effector inward. Each joint moves along
//! its own unit gradient, as far as its rate allows and only as far as needed. The ascent never leaves the joints'
//! reach and never makes the aim worse. Its settings are [`Ascent`].

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

/// Least ratio of the change of the angle to the target to a joint's own turn. The gradient of a joint below it is
/// noise, which a unit gradient would follow at full rate.
const IDLE: f32 = 1e-3;
/// Angle from exactly behind, radians, below which neither gradient nor residual has a reliable direction.
const OPPOSITE_RAD: f32 = 1e-3;
/// Largest number of halvings; further ones leave nothing of a step.
const MOST_HALVINGS: u32 = 24;

/// Angle to the target below which the supporting joints relax, radians.
const AIMED_RAD: f32 = 1.0 * PI / 180.0;
/// Gain of an ascent, relative to the largest possible one of its fastest joint, below which it counts as stuck.
const STUCK: f32 = 0.1;

/// Moves `joints` by one frame: relaxes the supporting joints, continues a turn-round, or ascends and then handles an
/// ascent that ends short of the goal. Returns whether the goal is within reach; `None` if the aim is undefined.
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
    // Find where the joints would settle without rate limits: from here, and then from rest.
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

/// Finishes an ascent that stopped short of a goal within reach: moves all the way if this frame is long enough, or
/// towards the goal if the ascent is stuck.
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
        // The same part of the way for every joint, so that movements that compensate each other stay in step.
        straight[index] = reaches[index].part_way(&start[index], &settled[index], &motions[index], part);
    }
    if frame.angle(&straight).is_some_and(|angle| angle < remaining) {
        joints[chain.clone()].copy_from_slice(&straight[chain]);
    } else if is_stuck {
        frame.turn_round_to(settled, joints);
    }
}

/// Ascends towards `goal` for one frame. Returns the remaining angle, radians, or `None`, with the joints unchanged, if
/// the aim is undefined.
///
/// The joints must be within the frame's reach. Joints outward of the chain's first are not touched.
fn ascend<const C: usize>(frame: &Frame<'_, C>, joints: &mut [Joint], ascent: &Ascent) -> Option<f32> {
    let Frame { rig, chain, goal, tolerance, ref reaches, .. } = *frame;
    let infos = rig.joints;
    let target = goal.aim_point;
    let turns = chain.corrections(rig, joints);
    let mut remaining = chain.gaze(&turns).angle_to(target)?;

    // Computed once: the joints inward of a joint, which carry its frame, have not moved yet when its turn comes.
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
        let seen = chain.rigid_target(target, effector.turned(turn).through(&frames[index]), rigid_effector);
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

/// Returns the unit step (pitch, heading) of a joint and its length in radians; `None` if it cannot improve the aim.
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
    // Drop a blocked angle before normalising, so that the other gets the full rate.
    let [by_pitch, by_heading] = gradient;
    let by_pitch = if reach.pitch_at(joint.heading).blocks(joint.pitch, by_pitch) { 0.0 } else { by_pitch };
    let by_heading = if reach.heading.blocks(joint.heading, by_heading) { 0.0 } else { by_heading };
    let norm = math::sqrt(by_pitch * by_pitch + by_heading * by_heading);
    // The aim is the cosine of the angle; dividing its gradient by the sine gives that of the angle.
    let (sin, _) = trig::sin_cos(remaining);
    if !(norm.is_finite() && norm > IDLE * sin) {
        return None;
    }
    let needed = if ascent.finish { remaining * sin / norm } else { f32::INFINITY };
    Some(([by_pitch / norm, by_heading / norm], reach.step.min(needed)))
}

/// Moves the joints inward of the chain's first towards rest, keeping the part `keep` of their angles per frame of 1/60
/// s, within their reach.
fn relax(chain_first: usize, keep: f32, dt: f32, joints: &mut [Joint], reaches: &[Reach]) {
    // Linear in time: exactly `keep` at 60 frames a second, and nearly the same speed at other rates.
    let keep = (1.0 - (1.0 - keep.max(0.0).min(1.0)) * 60.0 * dt).max(0.0);
    for (joint, reach) in joints.iter_mut().zip(reaches).skip(chain_first + 1) {
        *joint = reach.hold(&Joint { pitch: keep * joint.pitch, heading: keep * joint.heading, ..*joint });
    }
}
