//! [`JointRange`]: the range of motion of a single joint in a pose, for drawings and tools. Solvers compute all joints'
//! ranges at once.

use glam::{Affine3A, Quat, Vec3A};

use super::chain::{Upright, upright};
use super::rotation::correction;
use crate::limits::RangeOfMotion;
use crate::limits::motion::range_in_pose;
use crate::{Description, Joint, JointInfo, Pose, math};

/// The range of motion of a joint in a pose, as intervals of its added angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointRange {
    info: JointInfo,
    range: RangeOfMotion,
    /// Orientation of the joint's upright frame in its bone's space.
    tilt: Quat,
}

impl JointRange {
    /// Returns least and most heading, radians: both 0 if the joint has no heading, infinite if it turns all the way
    /// round.
    #[must_use]
    pub fn heading(&self) -> [f32; 2] {
        self.range.heading.ends()
    }

    /// Returns least and most pitch at an added heading, radians. A [taper](JointInfo::pitch_taper) narrows the range
    /// as the heading grows.
    #[must_use]
    pub fn pitch_at(&self, heading_rad: f32) -> [f32; 2] {
        self.range.pitch_at(heading_rad).ends()
    }

    /// Returns the correction at these added angles, radians, in the form that solvers return:
    /// `local' = local · correction`. An [upright](JointInfo::upright) heading turns about the character's up.
    #[must_use]
    pub fn correction(&self, heading_rad: f32, pitch_rad: f32) -> Quat {
        correction(&self.info, &Joint::from_angles(heading_rad, pitch_rad), self.tilt)
    }
}

impl Description<'_> {
    /// Returns the range of motion of a joint in a pose, as used by the [default solver](Self::default_solver). `None`
    /// if the rig or the pose has no such joint, or if its transform is degenerate.
    ///
    /// ```
    /// use aim_runtime::glam::{Affine3A, Quat};
    /// use aim_runtime::{Axes, Description, JointInfo, Pose};
    ///
    /// let axes = Axes { up: [0.0, 1.0, 0.0], forward: [0.0, 0.0, 1.0], left: [1.0, 0.0, 0.0] };
    /// let neck = [JointInfo::new(axes, 3.0).with_heading(-1.0, 1.2).with_pitch(-0.5, 0.4).with_pitch_taper(0.5)];
    /// let range = Description::new(&neck).joint_range(0, &Pose::new([Affine3A::IDENTITY])).unwrap();
    /// assert_eq!((range.heading(), range.pitch_at(0.0), range.pitch_at(1.2)), ([-1.0, 1.2], [-0.5, 0.4], [-0.25, 0.2]));
    /// assert!(range.correction(1.2, 0.0).abs_diff_eq(Quat::from_rotation_y(1.2), 1e-6));
    /// ```
    #[must_use]
    pub fn joint_range<A: AsRef<[Affine3A]>>(&self, joint: usize, pose: &Pose<A>) -> Option<JointRange> {
        let pose = pose.slices();
        let info = self.joints.get(joint)?;
        let mut frames = [math::orthonormal(pose.joints.get(joint)?.matrix3)?];
        let mut tilts = [Quat::IDENTITY];
        let up = match pose.up.and_then(|up| math::direction(up.into())) {
            Some(up) => up,
            None => {
                let innermost = self.joints.len() - 1;
                let frame = math::orthonormal(pose.joints.get(innermost)?.matrix3)?;
                frame * Vec3A::from(self.joints[innermost].axes.up)
            }
        };
        upright(core::slice::from_ref(info), 0, Upright::About(up), &mut frames, &mut tilts);
        Some(JointRange { info: *info, range: range_in_pose(info, &pose, joint), tilt: tilts[0] })
    }
}
