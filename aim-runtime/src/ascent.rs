//! One frame of steepest ascent, joint by joint from the effector inward: each joint along its own unit gradient, as
//! far as its rate allows, and only as far as needed. Never leaves the joints' reach, never makes the aim worse.

use glam::Affine3A;

use crate::chain::{self, Chain, Ray};
use crate::goal::Goal;
use crate::limits::Reach;
use crate::{AimRig, Ascent, Joint, math, trig};

/// A joint that changes the angle to the target by less than this part of its own turning is left alone: its gradient
/// is noise, and a unit gradient would follow noise at full rate.
const IDLE: f32 = 1e-3;
/// Nearer than this to exactly behind, neither gradient nor residual has a direction to speak of.
pub(crate) const OPPOSITE_RAD: f32 = 1e-3;
/// More halvings than this leave nothing of a step.
const MOST_HALVINGS: u32 = 24;

/// Ascends towards `goal` for one frame; returns the remaining angle, radians. `None` where the aim is undefined: then
/// the joints are as they were.
///
/// The joints are expected within `reaches`. Those before the chain's first are not touched.
pub(crate) fn ascend<R: AimRig>(
    rig: &R,
    chain: &Chain<R>,
    goal: &Goal,
    joints: &mut [Joint],
    reaches: &[Reach],
    tolerance: f32,
    ascent: &Ascent,
) -> Option<f32> {
    let infos = rig.joint_infos();
    let target = goal.aimed;
    let turns = chain::turns(rig, joints);
    let turns = turns.as_ref();
    let mut remaining = chain.gaze(turns).angle_to(target)?;

    // Seen from the effector inward, what lies outward of a joint has not moved yet when its turn comes.
    let mut frames = rig.array(Affine3A::IDENTITY);
    let frames = frames.as_mut();
    chain.frames(turns, frames);
    let mut rigid_frames = rig.array(Affine3A::IDENTITY);
    let rigid_frames = rigid_frames.as_mut();
    chain.rigid_frames(turns, rigid_frames);

    let mut effector = chain.effector();
    let mut effector_to_joint = chain.links.as_ref()[chain.first];
    for index in chain.first..chain.count {
        if remaining <= tolerance {
            break;
        }
        let axes = &infos[index].axes;
        let reach = &reaches[index];
        let joint = &mut joints[index];
        let mut turn = turns[index];

        let rigid_frame = &rigid_frames[index];
        let rigid_effector = rigid_effector(rig, &effector_to_joint).turned(turn).through(rigid_frame);
        let seen = chain.seen_target(target, effector.turned(turn).through(&frames[index]), rigid_effector);
        let target_js = math::rigid_inverse(rigid_frame).transform_point3a(seen).to_array();
        let ((sin_p, cos_p), (sin_h, cos_h)) = (trig::sin_cos(joint.pitch), trig::sin_cos(joint.heading));
        let [_, by_pitch, by_heading] = rig.aim_gradient::<f32>(
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
                let candidate_turn = candidate.correction(axes);
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
            effector_to_joint = chain.links.as_ref()[index + 1] * (Affine3A::from_quat(turn) * effector_to_joint);
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
    if remaining > core::f32::consts::PI - OPPOSITE_RAD {
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

/// The effector as the rigid links have it, in the space that `effector_to_joint` leads to.
pub(crate) fn rigid_effector<R: AimRig>(rig: &R, effector_to_joint: &Affine3A) -> Ray {
    let forward = rig.effector().forward.into();
    Ray { origin: effector_to_joint.translation, direction: effector_to_joint.transform_vector3a(forward) }
}

/// The joints behind the chain's first moved a little towards rest, by the part of their angles that the ascent's
/// settings say, within their reach.
pub(crate) fn relax(chain_first: usize, keep: f32, dt: f32, joints: &mut [Joint], reaches: &[Reach]) {
    // Linear in time, so that it is the stated part at 60 frames a second and nearly the same speed at others.
    let keep = (1.0 - (1.0 - keep.max(0.0).min(1.0)) * 60.0 * dt).max(0.0);
    for (joint, reach) in joints.iter_mut().zip(reaches).skip(chain_first + 1) {
        *joint = reach.hold(&Joint { pitch: keep * joint.pitch, heading: keep * joint.heading, ..*joint });
    }
}
