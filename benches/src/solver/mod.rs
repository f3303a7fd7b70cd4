//! Requirements on the whole-chain solvers, measured: correctness against an independent reference, cost, and the
//! movement of a natural gaze.
//!
//! [`chain`] holds the character, [`workload`] its targets and motions, [`random_rigs`] all other rigs. [`model`] is
//! forward kinematics written from the definitions in double precision, and [`mod@reference`] finds on it the angles
//! that the solvers should find; neither shares code with the solvers. Each function of [`exact`] and [`natural`]
//! returns one or more rows of the table. [`compare`] compares the solvers with each other.

pub mod chain;
pub mod compare;
pub mod exact;
pub mod model;
pub mod natural;
pub mod numeric;
pub mod parallel;
pub mod quadratic;
pub mod random_rigs;
pub mod reference;
pub mod row;
pub mod sample;
pub mod workload;
