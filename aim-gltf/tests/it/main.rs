//! Reading, measuring, reaching and writing of glTF files.

mod facing;
mod ik;
mod look_at;
mod malformed;
mod mannequin;
mod names;
mod reach;
mod rigs;
mod sampling;
mod support;
mod surface;
mod write;
