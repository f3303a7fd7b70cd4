//! First pass: parses the user's text into the neutral [`tree`](super::tree), with the place of every part.
//!
//! `item` reads a derive macro's input and `tokens` the settings in its attributes; `toml_file` reads a rig's file;
//! `literal` holds the syntax that both share. Only the syntax of TOML is checked here.

pub(crate) mod item;
pub(crate) mod literal;
pub(crate) mod tokens;
#[cfg(feature = "toml")]
pub(crate) mod toml_file;
