//! [`Frame`]: what the steps of one frame share.

use core::ops::Range;

use crate::Joint;
use crate::kinematics::chain::Chain;
use crate::limits::RangeOfMotion;
use crate::limits::reach::Reach;
use crate::rig::{ChainRig, PerJoint};
use crate::target::goal::Goal;

/// What the steps of one frame share.
pub(crate) struct Frame<'a, const C: usize> {
    pub(crate) rig: &'a ChainRig<'a, C>,
    pub(crate) chain: &'a Chain<C>,
    /// The ranges of motion.
    pub(crate) motions: &'a [RangeOfMotion],
    pub(crate) goal: &'a Goal,
    pub(crate) tolerance: f32,
    /// How far each joint can go in this frame.
    pub(crate) reaches: PerJoint<Reach, C>,
    /// The joints as the frame found them.
    pub(crate) start: PerJoint<Joint, C>,
}

impl<'a, const C: usize> Frame<'a, C> {
    pub(crate) fn new(
        rig: &'a ChainRig<'a, C>,
        chain: &'a Chain<C>,
        motions: &'a [RangeOfMotion],
        goal: &'a Goal,
        dt: f32,
        tolerance: f32,
        joints: &[Joint],
    ) -> Self {
        let mut start = rig.array(Joint::REST);
        start.copy_from_slice(joints);
        let mut reaches = rig.array(Reach::REST);
        let motion = motions.iter().zip(rig.joints);
        for ((reach, (motion, info)), joint) in reaches.iter_mut().zip(motion).zip(joints) {
            *reach = Reach::frame(motion, info.rate, joint, dt);
        }
        Self { rig, chain, motions, goal, tolerance, reaches, start }
    }

    /// The angle between the gaze and the goal, radians; `None` where it is undefined.
    pub(crate) fn angle(&self, joints: &[Joint]) -> Option<f32> {
        self.chain.gaze_of(self.rig, joints).angle_to(self.goal.aimed)
    }

    /// Moves these joints to rest as far as a frame lets them.
    pub(crate) fn go_to_rest(&self, joints: &mut [Joint], which: Range<usize>) {
        for index in which {
            joints[index] = self.reaches[index].towards_rest(&self.start[index]);
            joints[index].set_destination(None);
        }
    }
}
