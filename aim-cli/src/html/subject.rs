//! [`BakePage`]: what the page about a bake is of.

use aim_character::{Baked, Measurement};
use aim_codegen::RigSpec;
use aim_gltf::Document;

use crate::bake_report::BakeReport;

/// Subject of a page: `report` describes `baked`, which is `document` aimed by `spec`.
pub(crate) struct BakePage<'a> {
    pub(crate) spec: &'a RigSpec,
    pub(crate) report: &'a BakeReport,
    pub(crate) document: &'a Document,
    /// Of the document.
    pub(crate) measurement: &'a Measurement,
    pub(crate) baked: &'a Baked,
}
