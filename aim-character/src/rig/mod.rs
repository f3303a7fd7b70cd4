//! Rigs of characters.
//!
//! `proposal.rs` proposes a rig for a file (with the shares and limits of human joints in `parts.rs`), `declaration.rs`
//! writes a rig as source text, `fit.rs` checks a rig against a character, and `interpreted.rs` runs one; its kernels
//! are the programs of `tape.rs`.

pub mod declaration;
pub(crate) mod fit;
pub(crate) mod interpreted;
mod parts;
pub(crate) mod proposal;
mod tape;
