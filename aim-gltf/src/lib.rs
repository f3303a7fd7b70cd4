//! glTF 2.0 characters in and out: skeletons, clips, bone axes measured, files written with further clips.
//!
//! Any `.glb`, `.gltf` or `.vrm` becomes a [`Document`]; a broken one becomes one [`Error`] that says what is wrong, and
//! nothing in here panics on a file. [`Measurement`] tells where a character faces and which way each bone's own axes
//! point. [`bake()`] aims a rig over a clip, [`Plausibility`] tells how that looks, [`reach()`] leads a hand through points. [`Document::with_clips`] writes
//! the file again, its old bytes first and unchanged. [`mannequin`] makes a walking figure by code, in any of the 48
//! bone conventions and all frames between them.
//!
//! World space is glTF's: right-handed, +Y up, in the file's units (metres, if the file keeps to the rules). Matrices
//! act on column vectors, `world ← node`. Angles whose names end in `_deg` are degrees, times are seconds.
//!
//! ```
//! use aim_gltf::{Channel, Clip, Document, Measurement, PAPER_AXES, Role, mannequin};
//! use glam::Quat;
//!
//! let document = Document::from_bytes(&mannequin(|_| PAPER_AXES)?)?;
//! let measured = Measurement::of(&document);
//! let head = measured.with_role(Role::Head).expect("the mannequin has one");
//! assert_eq!((head.up.as_str(), head.forward.as_str(), head.left.as_str()), ("+X", "+Y", "+Z"));
//!
//! // The walk twice, the head turned to its left: heading is about the bone's own up, +X.
//! let mut clip = document.clip("walk")?.repeated(2.4);
//! clip.name = "walk, looking left".into();
//! clip.set(Channel::rotation(head.node, [0.0].into(), &[Quat::from_rotation_x(0.5)]));
//! let glb = document.with_clips(&[clip])?;
//! assert_eq!(Document::from_bytes(&glb)?.clips().len(), 2);
//! # Ok::<(), aim_gltf::Error>(())
//! ```

mod accessor;
mod bake;
mod bind;
mod chain;
mod clip;
mod clues;
mod container;
mod document;
mod error;
mod facing;
mod file;
mod held;
mod humanoid;
mod live;
mod look_at;
mod mannequin;
mod material;
mod measure;
mod morph_eyes;
mod normals;
mod num;
mod plan;
mod plausibility;
mod raw;
mod reach;
mod roles;
mod skeleton;
mod skin;
mod stance;
mod surface;
mod trs;
mod uri;
mod write;

pub use bake::{Baked, Plan, Settle, bake};
pub use chain::{ChainNodes, Hold};
pub use clip::{Channel, Clip, Interpolation, Property};
pub use clues::Clue;
pub use document::Document;
pub use error::Error;
pub use facing::{Evidence, Stated};
pub use file::{write_file, write_files};
pub use held::{limbs_on, limbs_on_each};
pub use live::{AimedFrame, JointFrame, Live, Moment};
pub use look_at::{LookAt, LookAtKind, RangeMap};
pub use mannequin::{PAPER_AXES, mannequin};
pub use material::{Alpha, Material, Texture, Wrap};
pub use measure::{BoneAxes, BoneFrame, Handedness, MeasuredPose, Measurement, SignedAxis};
pub use plausibility::{Appearance, Criterion, Plausibility, Worst};
pub use reach::{Arrival, Goal, LimbFrame, LimbNodes, ReachPlan, Reached, reach};
pub use roles::Role;
pub use skeleton::{Node, Skeleton};
pub use surface::{Surface, Triangle};
pub use trs::Trs;
