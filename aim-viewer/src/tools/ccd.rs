//! A chain whose tip reaches for the target.

use aim_runtime::Status;
use aim_runtime::glam::{Quat, Vec3};
use aim_runtime::ik::{Ccd, CcdJoint, CcdLimit, CcdStatus};

use super::{Body, Tried, error_deg};
use crate::character::Character;

/// Largest turn of each joint from the animation, radians, from the tip inward: forearm, upper arm, shoulder, chest.
const TURNS: [f32; 4] = [2.0, 2.0, 0.4, 0.4];

/// The joints of the chain, from the root outward: chest, shoulder and arm, or the rig's own chain if there is no hand.
#[derive(Debug)]
pub(super) struct Arm {
    joints: Vec<(usize, f32)>,
    tip: usize,
}

impl Arm {
    pub(super) fn new(character: &Character) -> Self {
        let skeleton = character.skeleton();
        if let Some(hand) = character.hand {
            let turns = skeleton.ancestry(hand).skip(1).zip(TURNS);
            let mut joints: Vec<_> = turns.collect();
            joints.reverse();
            return Self { joints, tip: hand };
        }
        let chain = &character.chain.joints;
        let joints = chain.iter().skip(1).map(|&joint| (joint, TURNS[2])).rev();
        // A rig with one joint leaves no joints, and nothing turns.
        Self { joints: joints.collect(), tip: chain[0] }
    }

    pub(super) fn reach(&self, body: &mut Body<'_>, target: Vec3) -> Tried {
        let joint =
            |&(bone, most_rad): &(usize, f32)| CcdJoint::new(body.origin(bone)).with_limit(CcdLimit::Ball { most_rad });
        let mut joints: Vec<CcdJoint> = self.joints.iter().map(joint).collect();
        let outcome = Ccd::new().solve(&mut joints, body.origin(self.tip), target);
        let mut carried = Quat::IDENTITY;
        for (joint, &(bone, _)) in joints.iter().zip(&self.joints) {
            // `turn` is relative to the animation and includes the turns of the joints inward of it: own turn = turn ·
            // carried⁻¹.
            body.turn(bone, joint.turn * carried.inverse());
            carried = joint.turn;
        }
        let tip = body.origin(self.tip);
        let root = self.joints.first().map_or(tip, |&(bone, _)| body.origin(bone));
        let status = match outcome.status {
            CcdStatus::Reached => Status::Reached,
            CcdStatus::Degenerate => Status::Degenerate,
            _ => Status::AtLimit,
        };
        let gaze = [tip, (target - tip).normalize_or_zero()];
        Tried { status, error_deg: error_deg([root, tip - root], target), gazes: vec![gaze] }
    }
}
