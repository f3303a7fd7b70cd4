//! [`Pose`]: the animated transforms of the joints in one frame.

use glam::{Affine3A, Vec3};

/// The animated transforms of a rig's joints, read after the animation system ran.
///
/// Requirements:
///
/// - Global transforms (model or world space), not local ones, in the same space as the target.
/// - In order from the effector inward, one for each joint of the rig.
/// - **Without** earlier corrections: corrections are added to the animation, never to themselves.
///
/// A call cannot detect a violation; in debug builds [`check::Frame`](crate::check::Frame) can. Uniform scale and
/// mirrors are compensated exactly. Non-uniform scale and shear are exact in the forward kinematics; only the search
/// direction is approximate. If a transform is not finite or has linearly dependent axes, or if the number of joints
/// differs from the rig's, the call is [`Degenerate`](crate::Status::Degenerate).
///
/// `A` is `[Affine3A; N]` for a derived rig of `N` joints, so that a wrong number of joints does not compile, and
/// `&[Affine3A]` for a rig known only at run time.
///
/// ```
/// use aim_runtime::Pose;
/// use aim_runtime::glam::{Affine3A, Vec3};
///
/// // An eye and a neck, from the effector inward, in model space.
/// let at = |y| Affine3A::from_translation(Vec3::Y * y);
/// let pose = Pose::new([at(1.7), at(1.5)]).with_up(Vec3::Y).with_other_eye(at(1.7) * Affine3A::from_translation(Vec3::X * 0.06));
/// assert_eq!((pose.joints[1], pose.up, pose.bind), (at(1.5), Some(Vec3::Y), None));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct Pose<A> {
    /// Each joint's transform, from the effector inward.
    pub joints: A,
    /// The character's up direction, of any length but zero; upright headings turn about it. `None`: the animated up of
    /// the innermost joint.
    pub up: Option<Vec3>,
    /// Each joint's transform in the bind pose, from the effector inward, placed where the character is now: the bind
    /// pose moves with the bone that is the parent of the innermost joint. Ranges from the bind pose use each joint's
    /// orientation relative to the next joint inward, and for the innermost joint its orientation in the pose's space. A
    /// natural gaze takes the eye's rest from it, so that an animation that moves the eyes does not move the head.
    pub bind: Option<A>,
    /// Animated transform of the other eye, in the space of the joints; `None` to aim joint 0 alone.
    pub other_eye: Option<Affine3A>,
}

impl<A> Pose<A> {
    /// Creates a pose from an array of transforms, from the effector inward. `Pose::from` accepts the rig's named pose
    /// (`HeroPose { .. }`).
    #[must_use]
    pub const fn new(joints: A) -> Self {
        Self { joints, up: None, bind: None, other_eye: None }
    }

    /// Sets the direction that is [up](Self::up) for the character, in the pose's space.
    #[must_use]
    pub fn with_up(mut self, up: Vec3) -> Self {
        self.up = Some(up);
        self
    }

    /// Sets the joints' [bind pose](Self::bind), in the same space, from which ranges with
    /// [`LimitsFrom::BindPose`](crate::LimitsFrom::BindPose) are counted. Pass a rig's named pose as
    /// `HeroPose { .. }.into()`.
    ///
    /// ```
    /// use aim_runtime::Pose;
    /// use aim_runtime::glam::{Affine3A, Quat, Vec3};
    ///
    /// // A neck and a chest, bound upright; the character stands elsewhere and has turned, and it bends.
    /// let place = Affine3A::from_rotation_translation(Quat::from_rotation_y(1.0), Vec3::new(3.0, 0.0, 2.0));
    /// let bound = [1.5, 1.3].map(|y| Affine3A::from_translation(Vec3::Y * y));
    /// let bent = [0.2, 0.1].map(Affine3A::from_rotation_x);
    /// let animated = [0, 1].map(|joint| place * bound[joint] * bent[joint]);
    /// let pose = Pose::new(animated).with_bind(bound.map(|joint| place * joint));
    /// # assert!(pose.bind.is_some());
    /// ```
    #[must_use]
    pub fn with_bind(mut self, bind: A) -> Self {
        self.bind = Some(bind);
        self
    }

    /// Adds the other eye, which is then aimed too: the partner of joint 0 on the same parent bone. The axes of its
    /// bone do not matter.
    ///
    /// The animated other eye is assumed to look parallel to joint 0. A virtual eye midway between the two leads; each
    /// eye converges on the target from its own origin, within its own rate and its own range (joint 0's, mirrored).
    /// The eyes never diverge, and for eyes 6 cm apart they converge on nothing nearer than 10 cm: a nearer target is
    /// looked at as if it were at that distance. If the rig's effector is not joint 0's own forward from its own
    /// origin, or joint 0's heading is upright, joint 0 leads alone and the other eye turns in parallel.
    ///
    /// Each call with the other eye moves it and returns its correction in
    /// [`Outcome::other_eye_correction`](crate::Outcome::other_eye_correction). A call without it clears its state. If
    /// the transform is not finite or has linearly dependent axes, the call is
    /// [`Degenerate`](crate::Status::Degenerate).
    ///
    /// ```
    /// # mod turret { include!(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/turret.rs")); }
    /// # use turret::Turret;
    /// use aim_runtime::glam::{Affine3A, Vec3};
    /// use aim_runtime::{Aim, Pose, Settings};
    ///
    /// // Eyes, 6 cm apart, that look at a fingertip: each turns towards the nose.
    /// let [left, right] = [0.03, -0.03].map(|x| Affine3A::from_translation(Vec3::X * x));
    /// let pose = Pose::new([left]).with_other_eye(right);
    /// let aimed = Aim::<Turret>::new().snap(&pose, Vec3::new(0.0, 0.0, 0.3), &Settings::default());
    /// let gazes = [aimed.corrections[0], aimed.outcome.other_eye_correction.unwrap()].map(|turn| turn * Vec3::Z);
    /// assert!(gazes[0].x < -0.09 && gazes[1].x > 0.09);
    /// ```
    #[must_use]
    pub fn with_other_eye(mut self, other_eye: Affine3A) -> Self {
        self.other_eye = Some(other_eye);
        self
    }
}

impl<A: AsRef<[Affine3A]>> Pose<A> {
    /// Returns the pose as slices, in the form that the solvers read.
    #[inline]
    pub(crate) fn slices(&self) -> PoseSlices<'_> {
        PoseSlices {
            joints: self.joints.as_ref(),
            up: self.up,
            bind: self.bind.as_ref().map(A::as_ref),
            other_eye: self.other_eye.as_ref(),
        }
    }
}

/// A [`Pose`] with any number of joints, as slices.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PoseSlices<'a> {
    pub(crate) joints: &'a [Affine3A],
    pub(crate) up: Option<Vec3>,
    pub(crate) bind: Option<&'a [Affine3A]>,
    pub(crate) other_eye: Option<&'a Affine3A>,
}
