//! Declarations proposed for characters, and rigs interpreted on them.

mod declaration;
mod mixed_rigs;
