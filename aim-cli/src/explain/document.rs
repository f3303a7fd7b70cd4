//! Parts of a document, independent of the output format.

use aim_symbolic::print::Formula;

/// A part of a line of text.
#[derive(Clone, Debug)]
pub(super) enum Inline {
    Text(String),
    Strong(String),
    /// Title of a publication.
    Emphasis(String),
    Code(String),
    Math(Formula),
}

pub(super) type Text = Vec<Inline>;

impl From<&str> for Inline {
    fn from(text: &str) -> Self {
        Self::Text(text.to_owned())
    }
}

impl From<String> for Inline {
    fn from(text: String) -> Self {
        Self::Text(text)
    }
}

impl From<Formula> for Inline {
    fn from(formula: Formula) -> Self {
        Self::Math(formula)
    }
}

/// Returns inline code.
pub(super) fn code(text: impl Into<String>) -> Inline {
    Inline::Code(text.into())
}

/// Builds a line of text, code and formulas.
macro_rules! text {
    ($($part:expr),* $(,)?) => { vec![$($crate::explain::document::Inline::from($part)),*] };
}
pub(super) use text;

/// A line of an equation array.
#[derive(Clone, Debug)]
pub(super) struct Equation {
    pub(super) left: Formula,
    pub(super) right: Formula,
    /// Number of the same equation in the paper.
    pub(super) paper: Option<u8>,
}

impl From<(Formula, Formula)> for Equation {
    fn from((left, right): (Formula, Formula)) -> Self {
        Self { left, right, paper: None }
    }
}

#[derive(Clone, Debug)]
pub(super) enum Block {
    Paragraph(Text),
    Equations(Vec<Equation>),
    /// Formulas that became others, each with the number of occurrences.
    Rewritings(Vec<Rewriting>),
    Table(Table),
    Drawings(Vec<Drawing>),
    /// A part that a first reading can skip.
    Fold(Text, Vec<Self>),
    Heading(Text),
}

/// One formula that became another.
#[derive(Clone, Debug)]
pub(super) struct Rewriting {
    pub(super) from: Formula,
    pub(super) to: Formula,
    /// Number of occurrences.
    pub(super) times: usize,
    /// Letters, with the formulas they stand for.
    pub(super) letters: Vec<(Formula, Formula)>,
}

/// Layout of a table's columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The first column names the row.
    Facts,
    /// All columns hold numbers except the first, which names the row.
    Numbers,
    /// The columns hold code, a formula and its meaning.
    Code,
}

#[derive(Clone, Debug)]
pub(super) struct Table {
    pub(super) kind: Kind,
    pub(super) caption: String,
    pub(super) head: Vec<Text>,
    pub(super) rows: Vec<Vec<Text>>,
}

impl Table {
    /// Creates a table with the column names `head`.
    pub(super) fn new(kind: Kind, caption: impl Into<String>, head: &[&str], rows: Vec<Vec<Text>>) -> Self {
        Self { kind, caption: caption.into(), head: head.iter().map(|name| text![*name]).collect(), rows }
    }
}

/// Meaning of a line in a drawing; the output format decides its look.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ink {
    /// One of the bone's own axes.
    Axis(usize),
    /// A direction of the character.
    Direction,
    Heading,
    Pitch,
}

#[derive(Clone, Debug)]
pub(super) struct Arrow {
    /// Points of the line from its start to the tip of its head.
    pub(super) points: Vec<[f64; 2]>,
    pub(super) ink: Ink,
}

#[derive(Clone, Debug)]
pub(super) struct Label {
    pub(super) at: [f64; 2],
    pub(super) text: String,
    pub(super) ink: Ink,
}

/// A drawing with y pointing downwards; labels are centred on their points.
#[derive(Clone, Debug)]
pub(super) struct Drawing {
    pub(super) size: [f64; 2],
    /// Description for readers who cannot see it.
    pub(super) told: String,
    pub(super) caption: Text,
    pub(super) arrows: Vec<Arrow>,
    pub(super) labels: Vec<Label>,
}

#[derive(Clone, Debug)]
pub(super) struct Section {
    /// Target of links to the section.
    pub(super) id: &'static str,
    pub(super) title: String,
    pub(super) blocks: Vec<Block>,
}

/// A whole document.
#[derive(Clone, Debug)]
pub(crate) struct Explanation {
    pub(super) title: String,
    pub(super) lead: Vec<Block>,
    pub(super) sections: Vec<Section>,
}

impl Rewriting {
    /// Returns `true` if the two differ at most in their counts.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        (&self.from, &self.to, &self.letters) == (&other.from, &other.to, &other.letters)
    }
}
