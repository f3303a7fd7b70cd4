//! [`BakePage`]: the input of the page about a bake.

use aim_animation::Clip;
use aim_character::{Baked, Measurement};
use aim_codegen::RigSpec;
use aim_gltf::Document;

use crate::bake_report::BakeReport;

/// Input of the page about a bake: `report` describes `baked`, which is `document` aimed by `spec`.
pub(crate) struct BakePage<'a> {
    pub(crate) spec: &'a RigSpec,
    pub(crate) report: &'a BakeReport,
    pub(crate) document: &'a Document,
    /// Measurement of `document`.
    pub(crate) measurement: &'a Measurement,
    /// The clip that was aimed over; `None` for the rest pose.
    pub(crate) source: Option<&'a Clip>,
    pub(crate) baked: &'a Baked,
}
