//! Characters that are known only at run time.
//!
//! [`Measurement`] tells where a character faces and which way each bone's own axes point. [`propose`] finds a rig for it,
//! [`Fit`] holds a declared one against it, [`declaration`] writes one down for its user, and [`InterpretedRig`] runs it.
//! [`Live`] aims it over its animation frame by frame, [`bake()`] over a clip, [`Plausibility`] tells how that looks, and
//! [`reach()`] leads a hand through points. [`mannequin`] makes a walking figure by code, in any of the 48 bone conventions
//! and all frames between them.
//!
//! World space is glTF's: right-handed, +Y up, in the file's units (metres, if the file keeps to the rules). Matrices act on
//! column vectors, `world ← node`. Angles whose names end in `_deg` are degrees, times are seconds.
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

/// The rig of the mannequin that [`mannequin`] makes with [`PAPER_AXES`]: the file that
/// `aim::rigs::Mannequin` is compiled from, as text.
pub const MANNEQUIN_RIG: &str = include_str!("../rigs/mannequin.toml");
