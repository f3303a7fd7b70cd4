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
    let caption = format!("{} against central differences", counted(subject.samples as usize, "random pose"));
    Section {
        id: "check",
        title: "The numerical check".into(),
        blocks: vec![
            Block::Paragraph(text![
                "A derivation can be followed; its result can also be tried. For poses at random within the rig’s ranges, the \
                 objective is computed from its statement, nothing rewritten, the effector pushed forward through all joints, \
                 and its derivatives by moving each angle a little both ways (central differences of sixth order). The derived \
                 programs have to agree, in double precision and in the single precision that ships. Deviations are relative \
                 to the larger of 1 and the expected value; they may be ",
                scientific(TOLERANCE_F64),
                " and ",
                scientific(TOLERANCE_F32),
                " at most. ",
                code("aim check"),
                " does the same with as many poses as one likes.",
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
        title: "What it costs".into(),
        blocks: vec![
            Block::Paragraph(text![
                "The operations of what is emitted, as ",
                code("aim count"),
                " tells them; the first four are of the joint next to the effector. Sines and cosines are given, subtractions count \
                 as additions, comparisons and selects are not in the total, and negations are free.",
            ]),
            Block::Table(Table::new(Kind::Numbers, "Operations", &head, rows.collect())),
        ],
    }
}
