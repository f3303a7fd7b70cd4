//! [`Frame`]: the inputs shared by the steps of one frame.

use core::ops::Range;

use crate::Joint;
use crate::kinematics::chain::Chain;
use crate::limits::RangeOfMotion;
use crate::limits::reach::Reach;
use crate::rig::{ChainRig, PerJoint};
use crate::target::goal::Goal;

/// The inputs shared by the steps of one frame.
pub(crate) struct Frame<'a, const C: usize> {
    pub(crate) rig: &'a ChainRig<'a, C>,
    pub(crate) chain: &'a Chain<C>,
    /// The joints' ranges of motion.
    pub(crate) motions: &'a [RangeOfMotion],
    pub(crate) goal: &'a Goal,
    /// The angle at which the goal counts as reached, radians.
    pub(crate) tolerance: f32,
    /// The angles that each joint can reach in this frame.
    pub(crate) reaches: PerJoint<Reach, C>,
    /// The joints at the start of the frame.
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

    /// Returns the angle between the gaze and the goal, radians; `None` if it is undefined.
    pub(crate) fn angle(&self, joints: &[Joint]) -> Option<f32> {
        self.chain.gaze_of(self.rig, joints).angle_to(self.goal.aim_point)
    }

    /// Moves these joints towards rest as far as one frame allows.
    pub(crate) fn go_to_rest(&self, joints: &mut [Joint], which: Range<usize>) {
        for index in which {
            joints[index] = self.reaches[index].towards_rest(&self.start[index]);
            joints[index].set_destination(None);
        }
    }
}
