//! The sections on the numerical check of the derivation and on operation counts.

use aim_codegen::{Kernel, RigSpec};

use super::document::{Block, Inline, Kind, Section, Table, code, text};
use crate::commands::check::{TOLERANCE_F32, TOLERANCE_F64, Verdict};
use crate::commands::count::{Counts, Row, numbers};
use crate::words::{counted, scientific};

/// Input of a document; all of it belongs to one rig.
pub(crate) struct Explained<'a> {
    pub(crate) spec: &'a RigSpec,
    pub(crate) kernels: &'a [Kernel],
    pub(crate) counts: &'a Counts,
    /// Results of comparing the derived programs with central differences.
    pub(crate) verdicts: &'a [Verdict],
    /// Number of poses in that comparison.
    pub(crate) samples: u32,
}

/// Returns the section on the comparison with central differences.
pub(super) fn section(subject: &Explained<'_>) -> Section {
    let rows = subject.verdicts.iter().map(|verdict| {
        let result = if verdict.passed() { Inline::from("agrees") } else { Inline::Strong("FAILED".into()) };
        vec![
            text![verdict.name.clone()],
            text![scientific(verdict.double)],
            text![scientific(verdict.single)],
            text![result],
        ]
    });
    let head = ["derived program", "largest deviation, f64", "largest deviation, f32", "verdict"];
    let caption = format!("{} compared with central differences", counted(subject.samples as usize, "random pose"));
    Section {
        id: "check",
        title: "Numerical check".into(),
        blocks: vec![
            Block::Paragraph(text![
                "The result of the derivation is also tested numerically. For random poses within the rig’s ranges, the objective \
                 is evaluated as stated, without rewriting, by moving the effector through all joints, and its derivatives by \
                 central differences of sixth order. The derived programs must agree, both in double precision and in the \
                 single precision of the emitted code. Deviations are relative to the larger of 1 and the expected value; they \
                 may be at most ",
                scientific(TOLERANCE_F64),
                " and ",
                scientific(TOLERANCE_F32),
                ", respectively. ",
                code("aim check"),
                " runs the same comparison with any number of poses.",
            ]),
            Block::Table(Table::new(Kind::Numbers, caption, &head, rows.collect())),
        ],
    }
}

/// Returns the section with the table of `aim count`.
pub(super) fn counts(subject: &Explained<'_>) -> Section {
    let head = ["", "total", "add", "mul", "div", "sqrt", "pow", "select"];
    let rows = subject.counts.rows().iter().map(|Row { title, count, .. }| {
        let numbers = numbers(*count).map(|(_, number)| text![number.to_string()]);
        std::iter::once(text![title.clone()]).chain(numbers).collect()
    });
    Section {
        id: "counts",
        title: "Operation counts".into(),
        blocks: vec![
            Block::Paragraph(text![
                "The operation counts of the emitted code, as printed by ",
                code("aim count"),
                "; the first four rows belong to the joint next to the effector. Sines and cosines are inputs, subtractions count \
                 as additions, comparisons and selects are not in the total, and negations are free.",
            ]),
            Block::Table(Table::new(Kind::Numbers, "Operations", &head, rows.collect())),
        ],
    }
}
