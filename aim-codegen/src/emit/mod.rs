//! Back ends, one file each. A checked rig always has code: nothing here can fail.

pub(crate) mod body;
pub mod c;
mod inputs;
pub mod latex;
pub mod maxima;
pub mod rust;
pub mod trajectory;
pub mod wgsl;

use crate::{RigPrograms, RigSpec};

/// A rig with its derived programs: what every back end emits from.
#[derive(Clone, Debug)]
pub struct Rig<'a> {
    /// What was declared.
    pub spec: &'a RigSpec,
    /// What was derived from it.
    pub programs: &'a RigPrograms,
}
