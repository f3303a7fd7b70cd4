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

pub use definitions::{Defined, defined, rewriting};
pub use expression::{Notation, Told, condition, definition, node, program as told, rotation, scalar, vector};
pub use formula::{Face, Formula, Sign};
pub use latex::formula as latex;
pub use mathml::formula as mathml;
pub use maxima::program as maxima;
pub use source::{Dialect, steps};
pub use steps::{Printer, Written};
pub use text::formula as text;
