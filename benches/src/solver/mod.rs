//! What the whole-chain solvers have to hold, measured: correctness against an independent reference, cost, and how a
//! natural gaze moves.
//!
//! [`chain`] is the character and [`workload`] what it looks at, [`random_rigs`] are all the other rigs. [`model`] is the
//! rig as the definitions have it, in double precision, and [`mod@reference`] finds on it what the solvers should have found;
//! neither shares code with them. Each function of [`exact`] and [`natural`] is a row or a few of the table.
//! [`compare`] sets the solvers beside each other.

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
