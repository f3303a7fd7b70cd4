//! The rig of a character that is known only at run time: [`propose`] finds one for a file, [`Fit`] holds a declared one
//! against it, [`declaration`] writes one down for its user, and [`InterpretedRig`] runs it.
//!
//! ```
//! use aim_character::{InterpretedRig, propose};
//! use aim_gltf::{Document, Measurement, PAPER_AXES, mannequin};
//! use aim_runtime::AimRig;
//!
//! let document = Document::from_bytes(&mannequin(|_| PAPER_AXES)?)?;
//! let proposal = propose(&document, &Measurement::of(&document), None)?;
//! let rig = InterpretedRig::new(&proposal.spec);
//! assert_eq!(rig.joint_infos().len(), 3); // an eye, the neck, the spine
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod declaration;
mod error;
pub mod evidence;
mod fit;
mod interpreted;
mod proposal;

pub use error::Error;
pub use fit::{Fit, JointFit, NAMES, NEAR_DEG};
pub use interpreted::InterpretedRig;
pub use proposal::{Proposal, propose};
