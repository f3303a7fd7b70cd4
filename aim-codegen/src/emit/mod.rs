//! Back ends, one file each. A checked rig always has code: nothing here can fail.
//!
//! `rust` writes the items of a rig and `rust_kernels` the functions in them, from statements that `body` makes;
//! `fallback` stands in for them where the declaration is faulty. `c` and `wgsl` write text and say the same in it, which
//! is in `text`; `maxima` writes a batch file. Formulas for readers are `aim-symbolic`'s `print`.

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

/// A rig with the kernels that are emitted of it.
#[derive(Clone, Copy, Debug)]
pub struct Rig<'a> {
    /// The declaration.
    pub spec: &'a RigSpec,
    /// The kernels, those of one objective side by side.
    pub kernels: &'a [Kernel],
}

impl<'a> Rig<'a> {
    /// The functions that compute the kernels.
    #[must_use]
    pub fn functions(&self) -> Vec<Function<'a>> {
        functions(self.kernels)
    }
}
