//! Programs and expressions as text and as formulas.

mod definitions;
mod expression;
mod formula;
mod latex;
mod mathml;
mod maxima;
mod source;
mod steps;

pub use definitions::{Defined, defined, rewriting};
pub use expression::{Notation, Told, definition, node, program as told, rotation, scalar, vector};
pub use formula::{Face, Formula, Sign};
pub use latex::formula as latex;
pub use mathml::formula as mathml;
pub use maxima::program as maxima;
pub use source::{Dialect, steps};
pub use steps::{Printer, Written};
