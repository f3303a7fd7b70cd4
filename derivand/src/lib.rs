// The README's examples need the feature `f64`, which the workspace's tests enable.
#![cfg_attr(any(not(doctest), feature = "f64"), doc = include_str!("../README.md"))]
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[doc(inline)]
pub use aim_derive::differentiate_by_derivand as differentiate;
pub use aim_model::{Real, Scalar};
#[cfg(feature = "glam")]
pub use glam;
#[cfg(feature = "wide")]
pub use wide;

/// An affine transform that the caller guarantees to be rigid: a rotation and a translation, without scale, shear or
/// mirroring. `differentiate` relies on this for `Rigid` and `Affine3A` alike.
///
/// ```
/// use derivand::glam::Vec3;
/// use derivand::{Rigid, differentiate};
///
/// #[differentiate(wrt(grip))]
/// fn height(grip: Vec3, hand: Rigid) -> f32 {
///     hand.transform_point3(grip).y
/// }
///
/// assert_eq!(height_gradient(Vec3::Y, Rigid::from_translation(Vec3::Y)), (2.0, (Vec3::Y,)));
/// ```
#[cfg(feature = "glam")]
pub type Rigid = glam::Affine3A;

/// A rigid transform in double precision; see [`Rigid`].
#[cfg(feature = "f64")]
pub type DRigid = glam::DAffine3;

/// Items that derived code refers to. Not meant for hand-written code.
#[doc(hidden)]
pub mod __private {
    pub use aim_model::{Real, Scalar, differences, number_constant};
}

/// Runs the examples of the book's page as tests.
#[cfg(doctest)]
#[doc = include_str!("../../docs/differentiating.md")]
mod page {}
