//! Where the joints come to rest if they have all the time they need. It serves `snap`, and tells a target out of reach
//! from one that only takes longer.

use crate::chain::Chain;
use crate::exact::{Solver, unhurried};
use crate::goal::Goal;
use crate::limits;
use crate::motion::Motion;
use crate::{AimRig, Joint};

/// Moves `joints` to where they aim best at the goal with the least displacement, from where they are, within their
/// ranges; returns the remaining angle, radians, or `None` where the aim is undefined. Bounded work.
pub(crate) fn settle<R: AimRig>(
    rig: &R,
    chain: &Chain<R>,
    motions: &[Motion],
    goal: &Goal,
    joints: &mut [Joint],
) -> Option<f32> {
    let remaining = Solver::new(rig, chain, goal).settle(joints, unhurried(rig, motions).as_ref())?;
    for (joint, motion) in joints.iter_mut().zip(motions) {
        limits::wrap(motion, joint);
    }
    Some(remaining)
}

/// [`settle`] from rest, so that the result does not depend on where the joints are.
///
/// The way that the gradient starts out on may end at a limit although another leads to the target: over the top
/// instead of round the side for a target behind, or with two hinges bent the wrong way. So where the target is not
/// reached the joints are also started to either side, up and down, and from the corners of their ranges, and the best
/// result wins.
pub(crate) fn settle_from_rest<R: AimRig>(
    rig: &R,
    chain: &Chain<R>,
    motions: &[Motion],
    goal: &Goal,
    joints: &mut [Joint],
    tolerance: f32,
) -> Option<f32> {
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
    at_rest(joints);
    let mut best = settle(rig, chain, motions, goal, joints).unwrap_or(f32::INFINITY);
    if best <= tolerance || goal.behind {
        return best.is_finite().then_some(best);
    }
    let mut started = rig.joints();
    let started = started.as_mut();
    for [heading, pitch] in STARTS {
        started.copy_from_slice(joints);
        for index in chain.first..chain.count {
            let motion = &motions[index];
            let part = |part: f32, lo: f32, hi: f32| part * if part < 0.0 { -lo.max(-2.0) } else { hi.min(2.0) };
            started[index].heading = part(heading * goal.side.sign(), motion.heading.lo(), motion.heading.hi());
            started[index].pitch = part(pitch, motion.pitch.lo(), motion.pitch.hi());
        }
        let angle = settle(rig, chain, motions, goal, started);
        if let Some(angle) = angle.filter(|&angle| angle < 0.999 * best) {
            best = angle;
            joints.copy_from_slice(started);
        }
        if best <= tolerance {
            break;
        }
    }
    best.is_finite().then_some(best)
}

/// Every angle 0; what else a joint knows stays.
pub(crate) fn at_rest(joints: &mut [Joint]) {
    for joint in joints {
        (joint.heading, joint.pitch) = (0.0, 0.0);
    }
}
