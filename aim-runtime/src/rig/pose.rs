//! [`Pose`]: where the animation put the joints in this frame.

use glam::{Affine3A, Vec3};

/// The animated transforms of a rig's joints, read after the animation system ran.
///
/// All in one common space, the same as the target's: global (model or world) transforms, not local ones; from the
/// effector inward; **without** earlier corrections, which are added to the animation and never to themselves. A call
/// cannot tell when that is not so; in debug builds [`check::Frame`](crate::check::Frame) can. Uniform
/// scale and mirrors are taken out exactly. Non-uniform scale is followed by forward kinematics; only the search
/// direction is then approximate. A transform that is not finite or does not span space makes the call
/// [`Degenerate`](crate::Status::Degenerate), and so does another number of joints than the rig has.
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
    /// The direction that is up for the character, of any length but zero: upright headings turn about it. Without it
    /// they turn about the innermost joint's animated up.
    pub up: Option<Vec3>,
    /// Each joint's transform in the bind pose, from the effector inward, where the character is now: the bind pose carried along
    /// with the character, or rather with the bone on which the innermost joint hangs. Joints count by how they stand to the
    /// next one inward, the innermost by how it stands in the pose's space.
    pub bind: Option<A>,
    /// The other eye's animated transform, in the joints' space.
    pub other_eye: Option<Affine3A>,
}

impl<A> Pose<A> {
    /// A pose of these joints, an array from the effector inward. `Pose::from` takes the rig's named pose (`HeroPose { .. }`).
    #[must_use]
    pub const fn new(joints: A) -> Self {
        Self { joints, up: None, bind: None, other_eye: None }
    }

    /// With the direction that is [up](Self::up) for the character, in the pose's space.
    #[must_use]
    pub fn with_up(mut self, up: Vec3) -> Self {
        self.up = Some(up);
        self
    }

    /// With the joints' bind pose, in the same space: what ranges [from the bind pose](crate::LimitsFrom::BindPose) are counted
    /// from. A rig's named pose is given as `HeroPose { .. }.into()`.
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

    /// With the other eye, which is aimed too: joint 0's partner on the same parent, whatever the axes of its bone.
    ///
    /// In the animation it counts as looking in parallel with joint 0. Then an eye in the middle leads, and each eye
    /// converges on the target from its own origin, within its own range (joint 0's, mirrored) and rate. Eyes converge
    /// on nothing nearer than 10 cm where they are 6 cm apart: a target nearer than that is looked at as if it were there.
    /// They never diverge. Where the rig's effector is not joint 0's own forward from its own origin, or joint 0's heading
    /// is upright, joint 0 leads alone and the other eye only follows: it turns in parallel.
    ///
    /// Each call with the other eye moves it; its correction is
    /// [`Outcome::other_eye_correction`](crate::Outcome::other_eye_correction). A call without it forgets it. A transform
    /// that is not finite or does not span space makes the call [`Degenerate`](crate::Status::Degenerate).
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
    /// The pose by slices, as the solvers read it.
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

/// A [`Pose`] of any number of joints.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PoseSlices<'a> {
    pub(crate) joints: &'a [Affine3A],
    pub(crate) up: Option<Vec3>,
    pub(crate) bind: Option<&'a [Affine3A]>,
    pub(crate) other_eye: Option<&'a Affine3A>,
}
