//! Attachments: things that a bone holds, and characters that hold on to a thing.

use aim_runtime::glam::Affine3A;
use aim_runtime::rotation::inverse;

/// The place of a thing that a bone holds, such as a gun in a hand, in the space of `bone`'s target: model or world.
/// `grip` is the thing in the space of the bone.
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

/// The place of a character's root in the world so that what it holds on to stays: someone hanging off a bridge.
///
/// `attachment` is the attachment point in the space of the model, `held` its place in the world. `None` if `attachment`
/// does not span space, or if the result is not finite.
#[must_use]
pub fn root_for(attachment: &Affine3A, held: &Affine3A) -> Option<Affine3A> {
    let root = *held * inverse(attachment)?;
    root.is_finite().then_some(root)
}
