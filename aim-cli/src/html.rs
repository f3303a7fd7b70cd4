//! `report.html`: one self-contained page.

use aim_codegen::RigSpec;
use aim_gltf::{Baked, Document};

use crate::report::Report;

/// The page.
pub(crate) fn page(_spec: &RigSpec, report: &Report, _document: &Document, _baked: &Baked) -> String {
    format!("<!doctype html><title>{}</title>", report.rig)
}
