//! Measuring and aiming characters that are known only at run time.
//!
//! [`Measurement`] finds the direction a character faces and the directions of each bone's local axes. [`propose`]
//! proposes a rig for it, [`Fit`] checks a declared rig against it, [`declaration`] writes a rig as TOML or Rust
//! source, and [`InterpretedRig`] runs one. [`Live`] aims the character over its animation frame by frame, [`bake()`]
//! does so for a whole clip, [`Plausibility`] rates how the result looks, and [`reach()`] moves a hand through given
//! points. [`mannequin`] generates a walking figure whose bones have any of the 48 cardinal conventions, or any
//! orthonormal frames between them.
//!
//! World space is that of glTF: right-handed, +Y up, in the file's units (metres, if the file follows the
//! specification). Matrices act on column vectors, `world ← node`. Angles whose names end in `_deg` are in degrees,
//! times in seconds.
//!
//! ```
//! use aim_character::{ChainNodes, InterpretedRig, Live, Measurement, Moment, PAPER_AXES, mannequin, propose};
//! use aim_gltf::Document;
//! use aim_runtime::{DynAim, Settings};
//! use aim_runtime::glam::DVec3;
//!
//! let document = Document::from_bytes(&mannequin(|_| PAPER_AXES)?)?;
//! let measurement = Measurement::of(&document);
//! let spec = propose(&document, &measurement, None)?.spec;
//! assert_eq!(spec.joints.len(), 7); // an eye, the head, the neck, four bones of the spine
//!
//! // A frame: the animation, then the aim on top of it.
//! let (skeleton, mut aim) = (document.skeleton(), DynAim::new(InterpretedRig::new(&spec)));
//! let chain = ChainNodes::find(skeleton, spec.joints.iter().map(|joint| &joint.bones[..]), None)?;
//! let live = Live::new(&aim.rig, &document, &measurement, &chain, false)?;
//! let mut pose = skeleton.pose(document.clip("walk")?, 0.5);
//! let world = skeleton.world_f64(&pose);
//! let target = DVec3::new(1.0, 1.7, 2.0);
//! let joints = live.animated(&mut pose, &world);
//! let outcome = aim.snap(&joints.pose(), target.as_vec3(), &Settings::default());
//! let moment = Moment { t: 0.5, target, world: &world, joints: &joints, outcome, effector: 0 };
//! let frame = live.aimed(&aim, skeleton, &mut pose, &moment);
//! assert!(frame.error_deg < 0.1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bake;
mod error;
mod mannequin;
mod measure;
mod num;
mod rig;
mod skin;

pub use bake::chain::{ChainNodes, Hold};
pub use bake::eye_maps::range_maps;
pub use bake::live::{AimedFrame, JointFrame, Live, Moment};
pub use bake::plausibility::{Appearance, Criterion, Plausibility, Worst};
pub use bake::reach::{Arrival, Goal, LimbFrame, LimbNodes, ReachPlan, Reached, reach};
pub use bake::seam::{MendedLoop, in_place, mended_loop, on_the_spot, root_path};
pub use bake::{Baked, Plan, Settle, bake};
pub use error::Error;
pub use mannequin::{Mannequin, PAPER_AXES, Vrm, mannequin};
pub use measure::clues::Clue;
pub use measure::evidence;
pub use measure::facing::{Evidence, Stated};
pub use measure::limbs::{limbs_on, limbs_on_each};
pub use measure::roles::Role;
pub use measure::{BoneAxes, BoneFrame, Handedness, MeasuredPose, Measurement, SignedAxis};
pub use rig::declaration;
pub use rig::fit::{Fit, JointFit, NAMES, NEAR_DEG, chain_nodes, hold, range_in_frame};
pub use rig::interpreted::InterpretedRig;
pub use rig::proposal::{Proposal, propose};
pub use skin::Palette;

/// Text of the rig file of the mannequin that [`mannequin`] generates with [`PAPER_AXES`]; `aim::rigs::Mannequin` is
/// compiled from the same file.
pub const MANNEQUIN_RIG: &str = include_str!("../rigs/mannequin.toml");
