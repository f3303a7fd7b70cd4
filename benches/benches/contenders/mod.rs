//! Implementations that the derived kernels are compared with. The benchmarks check that all of them return the same
//! values before any of them is timed.

pub mod dual;
pub mod symbolic;
