//! One frame of the exact solver: moves to the optimum within the frame's reach, or turns round.

use super::Solver;
use super::settle::{Blocked, Search, search, settle_from_other_starts};
use crate::Joint;
use crate::rig::Memory;
use crate::solve::frame::Frame;
use crate::solve::turn_round::turn_back_margin;

/// Moves all joints at once to the optimum within their reach, or the other way round if their ranges block the present
/// way. Returns whether the goal is within reach; `None` if the aim is undefined.
pub(crate) fn advance<const C: usize>(
    frame: &Frame<'_, C>,
    joints: &mut [Joint],
    dt: f32,
    memory: &mut Memory,
) -> Option<bool> {
    let Frame { rig, chain, motions, goal, tolerance, .. } = *frame;
    let mut advanced = rig.array(Joint::REST);
    advanced.copy_from_slice(joints);
    let mut solver = Solver::new(rig, chain, goal);
    let remaining = match solver.advance(&mut advanced, &frame.reaches, dt, memory) {
        Some(remaining) => remaining,
        // The aim may be undefined along the way, but the goal reachable from another start.
        None => frame.angle(joints).map(|_| f32::INFINITY)?,
    };
    let was_reached = memory.blocked_s == 0.0;
    memory.blocked_s = if remaining <= tolerance { 0.0 } else { memory.blocked_s + dt };
    if remaining <= tolerance {
        joints.copy_from_slice(&advanced);
        joints.iter_mut().for_each(|joint| joint.set_destination(None));
        return Some(true);
    }
    if let Some(within_reach) = frame.keep_turning_round(joints) {
        return Some(within_reach);
    }
    // Find where the joints would settle without rate limits: from here, and then from other starts.
    let mut settled = advanced;
    let stays = advanced.iter().zip(&*frame.start).all(|(new, old)| new.is_near(old, 1e-4));
    let pace = advanced.iter().zip(&*frame.start).zip(&*frame.reaches);
    let in_haste = pace.into_iter().any(|((new, old), reach)| !new.is_near(old, 0.99 * reach.step));
    let from_here = if solver.is_stalled() && !stays && !in_haste {
        // No rate limits the joints, only their ranges.
        remaining
    } else {
        let quick = Search::Quick { below: f32::INFINITY };
        search(rig, chain, motions, goal, &mut settled, quick).unwrap_or(f32::INFINITY)
    };
    joints.copy_from_slice(&advanced);
    if from_here <= tolerance {
        if stays {
            frame.turn_round_to(&settled, joints);
        }
        return Some(true);
    }
    // The longer the target has stood still, the smaller an improvement makes the joints turn back.
    let below = from_here - turn_back_margin(memory.still_s);
    let blocked = Blocked { tolerance, below, is_newly_blocked: was_reached };
    let from_other_starts = settle_from_other_starts(rig, chain, motions, goal, &mut settled, blocked, memory);
    let from_other_starts = from_other_starts.unwrap_or(f32::INFINITY);
    let within_reach = from_other_starts <= tolerance;
    if within_reach || from_other_starts < below {
        frame.turn_round_to(&settled, joints);
    }
    Some(within_reach)
}
