//! The rig of a character that is known only at run time: [`propose`] finds one for a file, [`Fit`] holds a declared one
//! against it, [`declaration`] writes one down for its user, and [`InterpretedRig`] runs it.
//!
//! ```
//! use aim_character::{InterpretedRig, propose};
//! use aim_gltf::{ChainNodes, Document, Live, Measurement, Moment, PAPER_AXES, mannequin};
//! use aim_runtime::{DynAim, Settings};
//! use glam::DVec3;
//!
//! let document = Document::from_bytes(&mannequin(|_| PAPER_AXES)?)?;
//! let measurement = Measurement::of(&document);
//! let spec = propose(&document, &measurement, None)?.spec;
//! assert_eq!(spec.joints.len(), 7); // an eye, the head, the neck, four bones of the spine
//!
//! // A frame: the animation, then the aim on top of it.
//! let (skeleton, mut aim) = (document.skeleton(), DynAim::new(InterpretedRig::new(&spec)));
//! let chain = ChainNodes::find(skeleton, spec.joints.iter().map(|joint| &joint.bones[..]), None)?;
//! let live = Live::new(&aim.rig, &document, &measurement, &chain, false);
//! let mut pose = skeleton.pose(document.clip("walk")?, 0.5);
//! let world = skeleton.world_f64(&pose);
//! let target = DVec3::new(1.0, 1.7, 2.0);
//! let joints = live.animated(skeleton, &mut pose, &world);
//! let outcome = aim.snap(&joints, target.as_vec3(), &Settings::default());
//! let moment = Moment { t: 0.5, target, world: &world, joints: &joints, outcome, effector: 0 };
//! let frame = live.aimed(&aim, skeleton, &mut pose, &moment);
//! assert!(frame.error_deg < 0.1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod declaration;
mod error;
pub mod evidence;
mod fit;
mod interpreted;
mod parts;
mod proposal;
mod tape;

pub use error::Error;
pub use fit::{Fit, JointFit, NAMES, NEAR_DEG, chain_nodes, hold, range_in_frame};
pub use interpreted::InterpretedRig;
pub use proposal::{Proposal, propose};

/// The rig of the mannequin that [`aim_gltf::mannequin`] makes with [`aim_gltf::PAPER_AXES`]: the file that
/// `aim::rigs::Mannequin` is compiled from, as text.
pub const MANNEQUIN_RIG: &str = include_str!("../../rigs/mannequin.toml");
