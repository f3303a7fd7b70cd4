//! Attachments: objects held by a bone, and characters that hold on to an object.

use aim_runtime::glam::Affine3A;
use aim_runtime::rotation::inverse;

/// Returns the transform of an object held by a bone, such as a gun in a hand, in the space that `bone` maps to: model
/// or world.
///
/// `grip` is the object's transform in bone space.
///
/// ```
/// use aim_animation::attached;
/// use aim_animation::glam::{Affine3A, Vec3};
///
/// let [hand, grip] = [Vec3::Y, Vec3::Z * 0.1].map(Affine3A::from_translation);
/// assert_eq!(attached(&hand, &grip).translation, Vec3::new(0.0, 1.0, 0.1).into());
/// ```
#[must_use]
pub fn attached(bone: &Affine3A, grip: &Affine3A) -> Affine3A {
    *bone * *grip
}

/// Returns the world transform of a character's root that keeps an attachment point in place: someone hanging off a
/// bridge.
///
/// `attachment` is the attachment point in model space, `held` its transform in world space. Returns `None` if
/// `attachment` is singular or the result is not finite.
#[must_use]
pub fn root_for(attachment: &Affine3A, held: &Affine3A) -> Option<Affine3A> {
    let root = *held * inverse(attachment)?;
    root.is_finite().then_some(root)
}
