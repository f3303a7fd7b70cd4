//! Output of programs and expressions as source text and as formulas.

mod definitions;
mod expression;
mod formula;
mod latex;
mod mathml;
mod maxima;
mod source;
mod steps;
mod text;

pub use definitions::{NamedParts, name_parts, rewriting};
pub use expression::{
    Notation, ProgramFormulas, condition, definition, node, program as program_formulas, rotation, scalar, vector,
};
pub use formula::{Formula, Sign, Typeface};
pub use latex::formula as latex;
pub use mathml::formula as mathml;
pub use maxima::program as maxima;
pub use source::{Dialect, steps};
pub use steps::{Printer, ProgramWriter};
pub use text::formula as text;
