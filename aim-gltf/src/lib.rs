//! glTF 2.0 characters: reads skeletons, clips and meshes, and writes files back with added clips.
//!
//! Any `.glb`, `.gltf` or `.vrm` file loads as a [`Document`]; an invalid one returns an [`Error`] that says what is
//! wrong. No file content makes this crate panic. [`Document::with_clips`] writes the file again: the old bytes come
//! first, unchanged, and the new data is appended.
//!
//! World space is glTF's: right-handed, +Y up, in the file's units (metres, if the file follows the specification).
//! Matrices act on column vectors, `world ← node`. Times are in seconds.
//!
//! ```
//! use aim_animation::glam::Quat;
//! use aim_animation::{Clip, Track};
//! use aim_gltf::Document;
//!
//! let document = Document::from_bytes(br#"{ "asset": { "version": "2.0" }, "nodes": [{ "name": "head" }] }"#)?;
//! let head = document.skeleton().find("head")?;
//! let turned = Track::constant(Quat::from_rotation_y(0.5))?;
//! let glb = document.with_clips(&[Clip::new("looking left").with_rotation(head, turned)])?;
//! assert_eq!(Document::from_bytes(&glb)?.clips().len(), 1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod accessor;
mod bones;
mod clip;
mod compact;
mod container;
mod document;
mod error;
mod file;
mod humanoid;
mod look_at;
mod material;
mod members;
mod mesh;
mod morph_eyes;
mod normals;
mod raw;
mod references;
mod skeleton;
mod skin;
mod surface;
mod uri;
mod write;

pub use compact::{ChannelSize, ClipSize};
pub use container::to_glb;
pub use document::Document;
pub use error::Error;
pub use file::{write_file, write_files};
pub use look_at::{LookAt, LookAtKind, RangeMap};
pub use material::{Alpha, Material, Texture, Wrap};
pub use morph_eyes::{MorphBind, MorphEye, MorphWay};
pub use skeleton::{Node, Skeleton};
pub use skin::{SkinnedPoint, carrier};
pub use surface::{Surface, Triangle};
