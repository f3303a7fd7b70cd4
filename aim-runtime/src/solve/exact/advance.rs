//! One frame of the exact solver: the optimum within this frame's reach, or round the other way.

use super::Solver;
use super::settle::{Blocked, Search, search, settle_from_elsewhere};
use crate::Joint;
use crate::rig::Memory;
use crate::solve::frame::Frame;
use crate::solve::turn_round::turn_back_margin;

/// Moves all joints at once to the optimum within their reach, or round the other way where their ranges block the one
/// they are on. Returns whether the goal is within reach.
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
        // On the way it may be undefined, and yet be reached from elsewhere.
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
    // Where would the joints get from here, had they the time; and where from elsewhere?
    let mut settled = advanced;
    let stays = advanced.iter().zip(&*frame.start).all(|(new, old)| new.is_near(old, 1e-4));
    let pace = advanced.iter().zip(&*frame.start).zip(&*frame.reaches);
    let in_haste = pace.into_iter().any(|((new, old), reach)| !new.is_near(old, 0.99 * reach.step));
    let from_here = if solver.is_spent() && !stays && !in_haste {
        // Nothing but the ranges holds them up.
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
    // For a target that stands still, joints turn back for less.
    let below = from_here - turn_back_margin(memory.still_s);
    let blocked = Blocked { tolerance, below, is_news: was_reached };
    let from_elsewhere = settle_from_elsewhere(rig, chain, motions, goal, &mut settled, blocked, memory);
    let from_elsewhere = from_elsewhere.unwrap_or(f32::INFINITY);
    let within_reach = from_elsewhere <= tolerance;
    if within_reach || from_elsewhere < below {
        frame.turn_round_to(&settled, joints);
    }
    Some(within_reach)
}
