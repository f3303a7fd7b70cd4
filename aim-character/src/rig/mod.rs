//! The rig of a character: `proposal.rs` proposes one (`parts.rs` knows what people can), `declaration.rs` writes one down,
//! `fit.rs` holds one against a character, and `interpreted.rs` runs one, its kernels as a `tape.rs`.

pub mod declaration;
pub(crate) mod fit;
pub(crate) mod interpreted;
mod parts;
pub(crate) mod proposal;
mod tape;
