#![doc = include_str!("../README.md")]
//!
#![doc = include_str!("../docs/concepts.md")]
//!
//! # Feature flags
//!
//! - `std` (default): takes square roots from the standard library. Without it, enable `libm`.
//! - `libm`: takes square roots from the `libm` crate, for `no_std`.
//! - `serde`: `Serialize` and `Deserialize` for [`Transform`], [`Looping`] and [`Control`].
//! - `f64`: double-precision types in the re-exported [`glam`].
#![no_std]
#![cfg_attr(docsrs, feature(doc_cfg))]
#![allow(
    clippy::neg_cmp_op_on_partial_ord,
    clippy::manual_clamp,
    reason = "NaN has to take the safe way: `!(a > b)` catches it, and `max` before `min` drops it"
)]

#[cfg(not(any(feature = "std", feature = "libm")))]
compile_error!("aim-animation needs square roots: enable the feature `std` or `libm`");

extern crate alloc;

mod aim_chain;
mod attach;
mod blend;
mod bounds;
mod clip;
mod control;
mod cursor;
mod fade;
mod figure;
mod float;
mod gizmo;
mod inertia;
mod instance;
mod layer;
mod limb;
mod marks;
mod mask;
mod mesh;
mod model;
mod motion;
mod packed;
mod plant;
mod playable;
mod pose;
mod reach;
mod reduce;
mod seam;
mod skeleton;
mod skew;
mod space;
mod step;
mod track;
mod transform;
mod tree;

pub use aim_chain::{AimChain, AimChainError, AimFrame, Corrections};
pub use aim_runtime::glam;
pub use attach::{attached, root_for};
pub use blend::{Blender, Method};
pub use bounds::{Aabb, BoneBoxes, Hit, OrientedBox, Ray};
pub use clip::{BoneTracks, Clip, Event, EventError};
pub use control::Control;
pub use cursor::Cursor;
pub use figure::{Figure, Layer};
pub use gizmo::{GizmoKind, GizmoLine, Gizmos};
pub use inertia::{Inertia, Transition};
pub use instance::{ClipControl, Instance, InstanceLayer};
#[cfg(feature = "std")]
pub use layer::AimLayer;
pub use layer::{AimLine, AimPoseError, AimPoseSet, AimPosesLayer, LimbLayer, Recoil, Space, TipTarget};
pub use limb::LimbError;
pub use marks::{Marks, MarksError, Phase};
pub use mask::Mask;
pub use mesh::{Influence, Mesh, MeshError, MeshPose, Morph, Skin, SkinError, matrix_rows, normal_matrix};
pub use model::Model;
pub use motion::{Motion, MotionError, Root, RootPath, Screw};
pub use packed::{PackedClip, PackedError};
pub use plant::{Ground, Plant, Stance, StanceLayer};
pub use pose::PoseError;
pub use reach::{Reach, ReachError, ReachGoal, ReachOutcome, ReachState};
pub use reduce::{ErrorPlace, Packed, Reduced, Reduction, ReductionError};
pub use seam::{Gap, Seam};
pub use skeleton::{Bone, Skeleton, SkeletonError};
pub use skew::{Skew, SkewedTransform};
pub use space::{BlendLine, BlendPlane, SpaceError};
pub use step::{Looping, Piece, Step};
pub use track::{BezierKey, Continuity, Curve, HermiteKey, Track, TrackError, Value};
pub use transform::Transform;
pub use tree::{Node, Parameter, Scratch, Tree, TreeError};
