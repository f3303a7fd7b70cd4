//! Bones that are children of a joint but must not follow its correction, such as clavicles parented to a neck that
//! turns.

use glam::{Affine3A, Quat};

use super::chain::inverse;
use crate::Description;

impl Description<'_> {
    /// Returns the joint that carries bones held on `joint`: the nearest joint inward that is not an eye, a head or a
    /// neck.
    ///
    /// `None` if there is no such joint; held bones then keep their animated place.
    #[must_use]
    pub fn carrier(&self, joint: usize) -> Option<usize> {
        (joint.saturating_add(1)..self.joints.len()).find(|&inward| !self.joints[inward].role.is_of_head())
    }

    /// Returns the correction for bones that are children of `joint`'s bone but are [held](crate::Rig::held_bone) on
    /// its [carrier](Self::carrier). Multiply the child's animated local transform by it on the *left*, translation
    /// included: `local' = held_correction · local`.
    ///
    /// `joints` are the transforms of the frame's [pose](crate::Pose), `corrections` the results of that frame. If the
    /// carrier is the next joint inward, the result is the inverse of the joint's correction. In general it is K = C⁻¹
    /// · L⁻¹ · K′ · L, where C is the joint's correction, L its animated transform relative to the next joint inward,
    /// and K′ the K of that joint, which is the identity for the carrier.
    ///
    /// Returns the identity if `joint` is not a joint of the rig, or if the slices are too short. A transform without
    /// an inverse, which no solver aims, is treated as the identity.
    ///
    /// ```
    /// # use aim_runtime::{Axes, Description, JointInfo, Role};
    /// # use glam::{Affine3A, Quat, Vec3};
    /// # let axes = Axes { up: [0.0, 1.0, 0.0], forward: [0.0, 0.0, 1.0], left: [1.0, 0.0, 0.0] };
    /// # let joint = |role| JointInfo::new(axes, 1.0).with_heading(-1.0, 1.0).with_role(role);
    /// # let joints = [joint(Role::Neck), joint(Role::Chest)];
    /// # let rig = Description::new(&joints);
    /// // A neck above a chest, both turned, and a clavicle that hangs on the neck.
    /// let (neck, chest) = (Affine3A::from_translation(Vec3::Y), Affine3A::IDENTITY);
    /// let corrections = [Quat::from_rotation_y(0.7), Quat::from_rotation_y(0.2)];
    /// let clavicle = Affine3A::from_translation(Vec3::new(0.1, -0.1, 0.0));
    /// let held = rig.held_correction(0, &[neck, chest], &corrections) * clavicle;
    /// // In the chest's space it is where the animation has it.
    /// let turned_neck = chest.inverse() * neck * Affine3A::from_quat(corrections[0]);
    /// assert!((turned_neck * held).abs_diff_eq(chest.inverse() * neck * clavicle, 1e-6));
    /// ```
    #[must_use]
    pub fn held_correction(&self, joint: usize, joints: &[Affine3A], corrections: &[Quat]) -> Affine3A {
        let carrier = self.carrier(joint).unwrap_or(self.joints.len());
        let (Some(pose), Some(turns)) = (joints.get(joint..carrier), corrections.get(joint..carrier)) else {
            return Affine3A::IDENTITY;
        };
        let mut held = Affine3A::IDENTITY;
        let mut inward: Option<&Affine3A> = None;
        for (animated, turn) in pose.iter().zip(turns).rev() {
            if let Some(inward) = inward {
                // L: the joint relative to the next one inward.
                let link = inverse(inward) * *animated;
                let moved = inverse(&link) * held * link;
                if moved.is_finite() {
                    held = moved;
                }
            }
            held = Affine3A::from_quat(turn.conjugate()) * held;
            inward = Some(animated);
        }
        held
    }
}
