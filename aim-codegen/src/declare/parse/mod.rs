//! First pass: what the user wrote → the neutral [`tree`](super::tree), with the place of every part.
//!
//! `item` reads a derive macro's input and `tokens` the settings in its attributes, `toml_file` a rig's file; `literal`
//! holds what both write alike. Nothing is judged here but the syntax of TOML.

pub(crate) mod item;
pub(crate) mod literal;
pub(crate) mod tokens;
#[cfg(feature = "toml")]
pub(crate) mod toml_file;
