//! Programs and expressions as text.

mod latex;
mod maxima;
mod plain;
mod source;

pub use latex::{program as latex, scalar as latex_scalar};
pub use maxima::program as maxima;
pub use plain::{program as plain, scalar as plain_scalar};
pub use source::{Dialect, steps};
