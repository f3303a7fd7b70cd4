#![doc = include_str!("../README.md")]
#![cfg_attr(docsrs, feature(doc_cfg))]

#[cfg(feature = "assets")]
mod asset;
mod binding;
mod character;
mod event;
mod find;
#[cfg(feature = "gizmos")]
mod gizmos;
#[cfg(feature = "measure")]
mod measure;
mod names;
mod outcome;
mod place;
mod plugin;
mod report;
mod settings;
#[cfg(feature = "measure")]
mod skin;
mod solve;
mod target;

pub use aim;
#[cfg(feature = "assets")]
pub use asset::{AimRigAsset, AimRigError, AimRigLoader};
pub use binding::{AimBinding, AimedBone};
pub use character::{AimCharacter, SharedRig};
pub use event::{AimLost, AimOutOfReach, AimReached, AimTurnBody};
#[cfg(feature = "gizmos")]
pub use gizmos::AimGizmos;
pub use outcome::{AimOutcome, AimStatus, Unbound};
pub use plugin::{AimPlugin, AimSystems};
pub use settings::{AimSettings, AimSnap};
pub use target::{AimAt, AimTarget, WeightedTarget};
