//! Reading and writing of glTF files.

mod bones;
mod compact;
mod look_at;
mod malformed;
mod mesh;
mod sampling;
mod support;
mod surface;
mod write;
