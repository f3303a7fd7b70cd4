//! [`Pose`]: where the animation put the joints this frame.

use glam::{Affine3A, Vec3};

mod sealed {
    #[expect(unnameable_types, reason = "being unnameable is what seals")]
    pub trait Sealed {}
    impl<T> Sealed for super::Pose<T> {}
    impl<T> Sealed for super::DetailedPose<T> {}
}

/// The animated transforms of a rig's joints, read after the animation system ran.
///
/// All in one common space (model or world space, the same as the target's), from the effector inward, **without**
/// earlier corrections: corrections are added to the animation, never to themselves. Any uniform scale and mirror is
/// taken out exactly. Non-uniform scale is followed by forward kinematics; only the search direction is then
/// approximate. A transform that is not finite or does not span space makes the call
/// [`Degenerate`](crate::Status::Degenerate).
///
/// For a derived rig of `N` joints `T` is `[Affine3A; N]`: a wrong number of joints does not compile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose<T> {
    /// Each joint's transform, from the effector inward.
    pub joints: T,
}

impl<T> Pose<T> {
    /// With the direction that is up for the character, in the pose's space: what level headings turn about.
    #[must_use]
    pub fn with_up(self, up: Vec3) -> DetailedPose<T> {
        DetailedPose::from(self).with_up(up)
    }

    /// With the joints' bind pose: what absolute ranges are counted from.
    #[must_use]
    pub fn with_bind(self, bind: T) -> DetailedPose<T> {
        DetailedPose::from(self).with_bind(bind)
    }

    /// With the other eye, which is aimed too: joint 0's partner on the same parent, whatever the axes of its bone.
    ///
    /// In the animation it counts as looking in parallel with joint 0. Then an eye in the middle leads, and each eye
    /// converges on the target from its own origin, within its own range (joint 0's, mirrored) and rate. Eyes converge
    /// on nothing nearer than 10 cm where they are 6 cm apart: a target nearer than that is looked at as if it were there.
    /// They never diverge. Where the rig's effector is not joint 0's own forward from its own origin, or joint 0's heading
    /// is level, joint 0 leads alone and the other eye only follows: it turns in parallel.
    ///
    /// Each call with the pair moves it; its correction is [`AimRig::pair_correction`](crate::AimRig::pair_correction). A
    /// call without it forgets the other eye. A transform that is not finite or does not span space makes the call
    /// [`Degenerate`](crate::Status::Degenerate).
    #[must_use]
    pub fn with_pair(self, pair: Affine3A) -> DetailedPose<T> {
        DetailedPose::from(self).with_pair(pair)
    }
}

/// A [`Pose`] with more than the joints: made by [`Pose::with_up`], [`with_bind`](Pose::with_bind) and
/// [`with_pair`](Pose::with_pair).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct DetailedPose<T> {
    /// Each joint's transform, from the effector inward.
    pub joints: T,
    /// The direction that is up for the character, of any length but zero. Without it level headings turn about the
    /// innermost joint's animated up.
    pub up: Option<Vec3>,
    /// Each joint's transform in the bind pose, from the effector inward, in a space of its own: only how the joints
    /// stand to each other counts, and how the innermost stands in the pose's space.
    pub bind: Option<T>,
    /// The other eye's animated transform, in the joints' space.
    pub pair: Option<Affine3A>,
}

impl<T> From<Pose<T>> for DetailedPose<T> {
    fn from(pose: Pose<T>) -> Self {
        Self { joints: pose.joints, up: None, bind: None, pair: None }
    }
}

impl<T> DetailedPose<T> {
    /// See [`Pose::with_up`].
    #[must_use]
    pub fn with_up(mut self, up: Vec3) -> Self {
        self.up = Some(up);
        self
    }

    /// See [`Pose::with_bind`].
    #[must_use]
    pub fn with_bind(mut self, bind: T) -> Self {
        self.bind = Some(bind);
        self
    }

    /// See [`Pose::with_pair`].
    #[must_use]
    pub fn with_pair(mut self, pair: Affine3A) -> Self {
        self.pair = Some(pair);
        self
    }
}

/// What [`AimRig::aim`](crate::AimRig::aim) takes as a pose: [`Pose`] or [`DetailedPose`]. Sealed, so that poses can
/// grow.
pub trait ChainPose<A>: sealed::Sealed {
    /// Each joint's animated transform, from the effector inward.
    fn joints(&self) -> &A;

    /// The direction that is up for the character.
    fn up(&self) -> Option<Vec3> {
        None
    }

    /// Each joint's transform in the bind pose.
    fn bind(&self) -> Option<&A> {
        None
    }

    /// The other eye's animated transform.
    fn pair(&self) -> Option<&Affine3A> {
        None
    }
}

impl<A: AsRef<[Affine3A]>> ChainPose<A> for Pose<A> {
    fn joints(&self) -> &A {
        &self.joints
    }
}

impl<A: AsRef<[Affine3A]>> ChainPose<A> for DetailedPose<A> {
    fn joints(&self) -> &A {
        &self.joints
    }

    fn up(&self) -> Option<Vec3> {
        self.up
    }

    fn bind(&self) -> Option<&A> {
        self.bind.as_ref()
    }

    fn pair(&self) -> Option<&Affine3A> {
        self.pair.as_ref()
    }
}

/// What a call reads of a pose.
#[derive(Clone, Copy, Debug)]
#[allow(dead_code, reason = "not every solver reads all of it")]
pub(crate) struct Animated<'a> {
    pub(crate) joints: &'a [Affine3A],
    pub(crate) up: Option<Vec3>,
    pub(crate) bind: Option<&'a [Affine3A]>,
    pub(crate) pair: Option<&'a Affine3A>,
}

impl<'a> Animated<'a> {
    pub(crate) fn new<A: AsRef<[Affine3A]> + 'a>(pose: &'a impl ChainPose<A>) -> Self {
        Self { joints: pose.joints().as_ref(), up: pose.up(), bind: pose.bind().map(A::as_ref), pair: pose.pair() }
    }
}
