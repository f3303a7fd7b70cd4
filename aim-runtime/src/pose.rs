//! [`Pose`]: where the animation put the joints this frame.

use glam::Affine3A;

mod sealed {
    #[expect(unnameable_types, reason = "being unnameable is what seals")]
    pub trait Sealed {}
    impl<T> Sealed for super::Pose<T> {}
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

/// What [`AimRig::aim`](crate::AimRig::aim) takes as a pose. Sealed, so that richer poses can be added.
pub trait ChainPose<A>: sealed::Sealed {
    /// Each joint's animated transform, from the effector inward.
    fn joints(&self) -> &A;
}

impl<A: AsRef<[Affine3A]>> ChainPose<A> for Pose<A> {
    fn joints(&self) -> &A {
        &self.joints
    }
}
