//! Where the joints come to rest if they have all the time they need. It serves `snap`, and tells a target out of reach
//! from one that only takes longer.

use super::{Solver, unhurried};
use crate::Joint;
use crate::kinematics::chain::Chain;
use crate::limits::Interval;
use crate::limits::RangeOfMotion;
use crate::limits::motion::wrap;
use crate::rig::{ChainRig, Memory};
use crate::target::goal::Goal;

/// How a search ends where a gap remains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Search {
    /// At the best there is.
    Thorough,
    /// When little more is gained, or when too little to come below this angle.
    Quick {
        /// The angle, radians.
        below: f32,
    },
}

impl Search {
    /// Whether it ends with a round that gained so much and left so much.
    pub(crate) fn is_over(self, gained: f32, remaining: f32) -> bool {
        /// This little is too little (0.11°), or this part of what remains.
        const LITTLE_RAD: f32 = 2e-3;
        const LITTLE: f32 = 0.1;
        /// So many more such rounds are hoped for.
        const HOPE: f32 = 3.0;
        match self {
            Self::Thorough => false,
            Self::Quick { below } => gained < LITTLE_RAD.min(LITTLE * remaining) || remaining - HOPE * gained > below,
        }
    }
}

/// Moves `joints` to where they aim best at the goal with the least displacement, from where they are, within their
/// ranges; returns the remaining angle, radians, or `None` where the aim is undefined. Bounded work.
pub(crate) fn settle<const C: usize>(
    rig: &ChainRig<'_, C>,
    chain: &Chain<C>,
    motions: &[RangeOfMotion],
    goal: &Goal,
    joints: &mut [Joint],
) -> Option<f32> {
    search(rig, chain, motions, goal, joints, Search::Thorough)
}

/// [`settle`], which takes less trouble where a gap remains.
pub(crate) fn search<const C: usize>(
    rig: &ChainRig<'_, C>,
    chain: &Chain<C>,
    motions: &[RangeOfMotion],
    goal: &Goal,
    joints: &mut [Joint],
    search: Search,
) -> Option<f32> {
    let remaining = Solver::new(rig, chain, goal).settle(joints, &unhurried(rig, motions), search)?;
    for (joint, motion) in joints.iter_mut().zip(motions) {
        wrap(motion, joint);
    }
    Some(remaining)
}

/// Starts as parts of the ranges, heading on the target's side and pitch; then the other side.
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

/// [`settle`] from rest, so that the result does not depend on where the joints are.
///
/// The way that the gradient starts out on may end at a limit although another leads to the target: over the top
/// instead of round the side for a target behind, or with two hinges bent the wrong way. So where the target is not
/// reached the joints are also started to either side, up and down, and from the corners of their ranges, and the best
/// result wins.
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

/// What is known of joints that are blocked.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Blocked {
    /// Nearer than this the target counts as reached, radians.
    pub(crate) tolerance: f32,
    /// What is worth going elsewhere for, radians.
    pub(crate) below: f32,
    /// Whether they were not in the frame before.
    pub(crate) is_news: bool,
}

/// [`settle_from_rest`] for joints that are blocked frame after frame: all of it where the target is not where it was
/// when that was done last; else from rest where that they are is news and now and then, and from one of many other
/// places in turn, as far as that promises to be worth it.
pub(crate) fn settle_from_elsewhere<const C: usize>(
    rig: &ChainRig<'_, C>,
    chain: &Chain<C>,
    motions: &[RangeOfMotion],
    goal: &Goal,
    joints: &mut [Joint],
    blocked: Blocked,
    memory: &mut Memory,
) -> Option<f32> {
    /// How far a target goes, as a part of its distance, before all is searched again (17°).
    const FAR: f32 = 0.3;
    /// For how many frames the search is busy.
    const BUSY: u16 = 128;
    /// So many places are started from in turn.
    const MOST_STARTS: usize = 128;
    let Blocked { tolerance, below, is_news } = blocked;
    let target = chain.base.matrix3.transpose() * goal.aimed;
    let moved = target - memory.searched();
    if memory.turn == 0 || !(moved.dot(moved) < FAR * FAR * target.dot(target)) {
        // Where the joints have been blocked all the way here they were busy enough.
        memory.turn = if is_news { 1 } else { memory.turn.max(1) };
        memory.set_searched(target);
        return settle_from_rest(rig, chain, motions, goal, joints, tolerance);
    }
    let turn = memory.turn;
    memory.turn = turn.checked_add(1).unwrap_or(BUSY);
    // Three frames in four at first, then one in six of those.
    let stride = if turn < BUSY { 1 } else { 6 };
    let (number, is_turn) = (turn / stride, turn % stride == 0);
    if is_news || (is_turn && number % 4 == 0) {
        at_rest(joints);
    } else if !is_turn || number % 4 == 2 || goal.behind {
        return None;
    } else {
        // Those that were never started from first.
        let number = (usize::from(number / 2) + STARTS.len()) % MOST_STARTS;
        start(number, motions, goal, &mut joints[chain.first..chain.count], chain.first);
        // What is nearest to there first: on the way to the least displacement all starts would meet.
        let mut solver = Solver::new(rig, chain, goal);
        for (index, joint) in joints.iter().enumerate().skip(chain.first) {
            solver.prefer(index, [joint.pitch, joint.heading]);
        }
        let nearest = solver.settle(joints, &unhurried(rig, motions), Search::Quick { below })?;
        if nearest > tolerance && nearest >= below {
            return Some(nearest);
        }
    }
    search(rig, chain, motions, goal, joints, Search::Quick { below })
}

/// Puts joints, the first of which has this index, where the search of this number starts: the regular starts first,
/// then anywhere.
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
                right + scattered(number, 2 * index) * (left - right),
                down + scattered(number, 2 * index + 1) * (up - down),
            ),
        };
    }
}

/// A number in 0…1 for each of a start's coordinates, none like another.
fn scattered(number: usize, coordinate: usize) -> f32 {
    #[expect(clippy::cast_possible_truncation, reason = "small numbers")]
    let mut bits = (number as u32).wrapping_mul(0x9e37_79b9) ^ (coordinate as u32).wrapping_mul(0x85eb_ca6b);
    bits = (bits ^ (bits >> 16)).wrapping_mul(0x7feb_352d);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x846c_a68b);
    #[expect(clippy::cast_precision_loss, reason = "24 bits")]
    let scattered = (bits >> 8) as f32 / (1_u32 << 24) as f32;
    scattered
}

/// Every angle 0; what else a joint knows stays.
pub(crate) fn at_rest(joints: &mut [Joint]) {
    for joint in joints {
        (joint.heading, joint.pitch) = (0.0, 0.0);
    }
}
