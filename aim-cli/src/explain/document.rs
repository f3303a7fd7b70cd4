//! Parts of a document, independent of the language it is written in.

use aim_symbolic::print::Formula;

/// A part of a line.
#[derive(Clone, Debug)]
pub(super) enum Inline {
    Text(String),
    Strong(String),
    /// A title.
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

/// Code in a line.
pub(super) fn code(text: impl Into<String>) -> Inline {
    Inline::Code(text.into())
}

/// A line of text, code and formulas.
macro_rules! text {
    ($($part:expr),* $(,)?) => { vec![$($crate::explain::document::Inline::from($part)),*] };
}
pub(super) use text;

/// A line of an equation array.
#[derive(Clone, Debug)]
pub(super) struct Equation {
    pub(super) left: Formula,
    pub(super) right: Formula,
    /// The number of the same equation in the paper.
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
    /// One formula becomes another: each with how often that happened.
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
    pub(super) times: usize,
    /// Letters with the formulas they stand for.
    pub(super) letters: Vec<(Formula, Formula)>,
}

/// Layout of a table's columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// The first column names the row.
    Facts,
    /// Numbers but for the first column, which names the row.
    Numbers,
    /// Code, formula, meaning.
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
    /// A table whose columns are called `head`.
    pub(super) fn new(kind: Kind, caption: impl Into<String>, head: &[&str], rows: Vec<Vec<Text>>) -> Self {
        Self { kind, caption: caption.into(), head: head.iter().map(|name| text![*name]).collect(), rows }
    }
}

/// Meaning of a line; the page decides its look.
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
    /// From the first to the last, where its head is.
    pub(super) points: Vec<[f64; 2]>,
    pub(super) ink: Ink,
}

#[derive(Clone, Debug)]
pub(super) struct Label {
    pub(super) at: [f64; 2],
    pub(super) text: String,
    pub(super) ink: Ink,
}

/// A drawing, y downwards; labels are centred on their points.
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
    /// Its name in links.
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
    /// True if it differs from `other` at most in its count.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        (&self.from, &self.to, &self.letters) == (&other.from, &other.to, &other.letters)
    }
}
