//! Back ends, one file each. They take a checked rig and cannot fail.
//!
//! `rust` writes the items of a rig and `rust_kernels` the functions in them, both from statements that `body` makes;
//! `fallback` replaces them if the declaration is faulty. `c` and `wgsl` write source text; what the two languages
//! share is in `text`. `maxima` writes a batch file. Formulas for readers are in `aim-symbolic`'s `print`.

pub mod body;
pub mod c;
mod fallback;
pub mod maxima;
pub mod rust;
pub mod rust_kernels;
mod text;
pub mod wgsl;

pub use self::fallback::fallback;
pub use self::text::{Precision, Procedure};
use crate::RigSpec;
use crate::objective::{Function, Kernel, functions};

/// A rig with the kernels to emit for it.
#[derive(Clone, Copy, Debug)]
pub struct Rig<'a> {
    /// The checked declaration.
    pub spec: &'a RigSpec,
    /// The kernels, grouped by objective.
    pub kernels: &'a [Kernel],
}

impl<'a> Rig<'a> {
    /// Returns the functions that compute the kernels.
    #[must_use]
    pub fn functions(&self) -> Vec<Function<'a>> {
        functions(self.kernels)
    }
}
