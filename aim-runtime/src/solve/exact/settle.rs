//! Finds the angles at which joints without rate limits come to rest. Serves `snap`, and distinguishes a target out of
//! reach from one that only takes longer.

use super::{Solver, full_reaches};
use crate::Joint;
use crate::kinematics::chain::Chain;
use crate::limits::Interval;
use crate::limits::RangeOfMotion;
use crate::limits::motion::wrap;
use crate::rig::{ChainRig, Memory};
use crate::target::goal::Goal;

/// Termination criterion of a search that leaves a gap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Search {
    /// Ends at the best result.
    Thorough,
    /// Ends when a round gains little, or too little for the angle to fall below this one.
    Quick {
        /// The angle, radians.
        below: f32,
    },
}

impl Search {
    /// Returns `true` if the search ends after a round with this gain and remaining angle.
    pub(crate) fn is_over(self, gained: f32, remaining: f32) -> bool {
        /// Smallest gain of a round for the search to continue (0.11°).
        const LITTLE_RAD: f32 = 2e-3;
        /// Smallest gain of a round for the search to continue, relative to the remaining angle.
        const LITTLE: f32 = 0.1;
        /// Number of further rounds with the same gain that are assumed possible.
        const HOPE: f32 = 3.0;
        match self {
            Self::Thorough => false,
            Self::Quick { below } => gained < LITTLE_RAD.min(LITTLE * remaining) || remaining - HOPE * gained > below,
        }
    }
}

/// Moves `joints` from their present angles to the best aim at the goal with the least displacement, within their
/// ranges. Returns the remaining angle, radians, or `None` if the aim is undefined. The work is bounded.
pub(crate) fn settle<const C: usize>(
    rig: &ChainRig<'_, C>,
    chain: &Chain<C>,
    motions: &[RangeOfMotion],
    goal: &Goal,
    joints: &mut [Joint],
) -> Option<f32> {
    search(rig, chain, motions, goal, joints, Search::Thorough)
}

/// [`settle`] with a choice of the effort spent if a gap remains.
pub(crate) fn search<const C: usize>(
    rig: &ChainRig<'_, C>,
    chain: &Chain<C>,
    motions: &[RangeOfMotion],
    goal: &Goal,
    joints: &mut [Joint],
    search: Search,
) -> Option<f32> {
    let remaining = Solver::new(rig, chain, goal).settle(joints, &full_reaches(rig, motions), search)?;
    for (joint, motion) in joints.iter_mut().zip(motions) {
        wrap(motion, joint);
    }
    Some(remaining)
}

/// Starts as parts of the ranges: heading on the target's side, negative for the other side, and pitch.
const STARTS: [[f32; 2]; 10] = [
    [0.7, 0.0],
    [-0.7, 0.0],
    [0.0, 0.7],
    [0.0, -0.7],
    [1.0, 1.0],
    [1.0, -1.0],
    [-1.0, 1.0],
    [-1.0, -1.0],
    [0.5, 0.5],
    [-0.5, -0.5],
];

/// [`settle`] from rest, so that the result does not depend on the present angles.
///
/// The path of steepest descent may end at a limit although another path leads to the target: over the top instead of
/// round the side for a target behind, or with two hinges bent the wrong way. If the target is not reached, the search
/// therefore also starts to either side, up and down, and from the corners of the ranges, and the best result wins.
pub(crate) fn settle_from_rest<const C: usize>(
    rig: &ChainRig<'_, C>,
    chain: &Chain<C>,
    motions: &[RangeOfMotion],
    goal: &Goal,
    joints: &mut [Joint],
    tolerance: f32,
) -> Option<f32> {
    at_rest(joints);
    let mut best = settle(rig, chain, motions, goal, joints).unwrap_or(f32::INFINITY);
    if best <= tolerance || goal.behind {
        return best.is_finite().then_some(best);
    }
    let mut started = rig.array(Joint::REST);
    for number in 0..STARTS.len() {
        started.copy_from_slice(joints);
        start(number, motions, goal, &mut started[chain.first..chain.count], chain.first);
        let found = search(rig, chain, motions, goal, &mut started, Search::Quick { below: best });
        if found.is_some_and(|angle| angle < 0.999 * best) {
            if let Some(angle) = settle(rig, chain, motions, goal, &mut started) {
                best = angle;
                joints.copy_from_slice(&started);
            }
        }
        if best <= tolerance {
            break;
        }
    }
    best.is_finite().then_some(best)
}

/// The state of joints that are blocked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blocked {
    /// Angle within which the target counts as reached, radians.
    pub(crate) tolerance: f32,
    /// Remaining angle that another solution has to beat, radians.
    pub(crate) below: f32,
    /// `true` if the joints were not blocked in the last frame.
    pub(crate) is_newly_blocked: bool,
}

/// [`settle_from_rest`] for joints that are blocked frame after frame, spread over time. Repeats the full search when
/// the target has moved far since the last one. Otherwise searches from rest when the joints have just become blocked
/// and now and then, or from one of many other starts in turn, unless that start cannot be worth it. Returns `None` in
/// frames without a search.
pub(crate) fn settle_from_other_starts<const C: usize>(
    rig: &ChainRig<'_, C>,
    chain: &Chain<C>,
    motions: &[RangeOfMotion],
    goal: &Goal,
    joints: &mut [Joint],
    blocked: Blocked,
    memory: &mut Memory,
) -> Option<f32> {
    /// Movement of a target, relative to its distance, after which the full search is repeated (17°).
    const FAR: f32 = 0.3;
    /// Number of blocked frames in which the search is frequent.
    const BUSY: u16 = 128;
    /// Number of starts that are tried in turn.
    const MOST_STARTS: usize = 128;
    let Blocked { tolerance, below, is_newly_blocked } = blocked;
    let target = chain.base.matrix3.transpose() * goal.aim_point;
    let moved = target - memory.searched_target();
    if memory.turn == 0 || !(moved.dot(moved) < FAR * FAR * target.dot(target)) {
        // Joints that have been blocked all the while keep their place in the schedule.
        memory.turn = if is_newly_blocked { 1 } else { memory.turn.max(1) };
        memory.set_searched_target(target);
        return settle_from_rest(rig, chain, motions, goal, joints, tolerance);
    }
    let turn = memory.turn;
    memory.turn = turn.checked_add(1).unwrap_or(BUSY);
    // Search in three of four frames at first; later, only every sixth frame counts.
    let stride = if turn < BUSY { 1 } else { 6 };
    let (number, is_turn) = (turn / stride, turn % stride == 0);
    if is_newly_blocked || (is_turn && number % 4 == 0) {
        at_rest(joints);
    } else if !is_turn || number % 4 == 2 || goal.behind {
        return None;
    } else {
        // Begin with the starts that were not part of the full search.
        let number = (usize::from(number / 2) + STARTS.len()) % MOST_STARTS;
        start(number, motions, goal, &mut joints[chain.first..chain.count], chain.first);
        // First find the solution nearest to the start: with the usual displacement, all starts would converge to the
        // same one.
        let mut solver = Solver::new(rig, chain, goal);
        for (index, joint) in joints.iter().enumerate().skip(chain.first) {
            solver.prefer(index, [joint.pitch, joint.heading]);
        }
        let nearest = solver.settle(joints, &full_reaches(rig, motions), Search::Quick { below })?;
        if nearest > tolerance && nearest >= below {
            return Some(nearest);
        }
    }
    search(rig, chain, motions, goal, joints, Search::Quick { below })
}

/// Puts `joints`, the first of which has index `first`, at the start with this number: one of the regular starts, or a
/// pseudo-random point of the ranges.
fn start(number: usize, motions: &[RangeOfMotion], goal: &Goal, joints: &mut [Joint], first: usize) {
    for (index, joint) in joints.iter_mut().enumerate() {
        let motion = &motions[first + index];
        let ends = |range: Interval| [range.lo().max(-2.0), range.hi().min(2.0)];
        let ([right, left], [down, up]) = (ends(motion.heading), ends(motion.pitch));
        (joint.heading, joint.pitch) = match STARTS.get(number) {
            Some([heading, pitch]) => {
                let part = |part: f32, [lo, hi]: [f32; 2]| if part < 0.0 { -part * lo } else { part * hi };
                (part(heading * goal.side.sign(), [right, left]), part(*pitch, [down, up]))
            }
            None => (
                right + pseudo_random(number, 2 * index) * (left - right),
                down + pseudo_random(number, 2 * index + 1) * (up - down),
            ),
        };
    }
}

/// Returns a pseudo-random number in 0…1 for a coordinate of a start.
fn pseudo_random(number: usize, coordinate: usize) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "small numbers")]
    let mut bits = (number as u32).wrapping_mul(0x9e37_79b9) ^ (coordinate as u32).wrapping_mul(0x85eb_ca6b);
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x7feb_352d);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x846c_a68b);
    #[expect(clippy::cast_precision_loss, reason = "24 bits")]
    let pseudo_random = (bits >> 8) as f32 / (1_u32 << 24) as f32;
    pseudo_random
}

/// Sets every angle to 0; the rest of a joint's state is kept.
pub(crate) fn at_rest(joints: &mut [Joint]) {
    for joint in joints {
        (joint.heading, joint.pitch) = (0.0, 0.0);
    }
}
