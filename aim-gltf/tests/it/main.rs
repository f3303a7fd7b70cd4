//! Reading and writing of glTF files.

mod look_at;
mod malformed;
mod sampling;
mod support;
mod surface;
mod write;
