#![doc = include_str!("../README.md")]
#![no_std]
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    clippy::manual_clamp,
    reason = "NaN has to take the safe way: `!(a > b)` catches it, and `max` before `min` drops it"
)]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("aim-animation needs square roots: enable the feature `std` or `libm`");

extern crate alloc;

mod attach;
mod blend;
mod mask;
mod pose;
mod skeleton;
mod skew;
mod transform;

pub use aim_runtime::glam;
pub use attach::{attached, root_for};
pub use blend::{Blender, Method};
pub use mask::Mask;
pub use pose::PoseError;
pub use skeleton::{Bone, Skeleton, SkeletonError};
pub use skew::{Skew, SkewedTransform};
pub use transform::Transform;
