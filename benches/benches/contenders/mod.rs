//! What the derived kernels are measured against, and the check that all give the same: a fast wrong answer wins nothing.

pub mod dual;
pub mod symbolic;
