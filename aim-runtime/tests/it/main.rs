//! Tests of the solvers through their public interface. `common` holds rigs, poses and the f64 references that results
//! are checked against.

mod alone;
mod behind;
mod budgets;
mod check;
mod common;
mod conventions;
mod degenerate;
mod eyes;
mod fixed;
mod glances;
mod ik;
mod natural;
mod oracle;
mod peers;
mod postures;
mod properties;
mod ranges;
mod reach;
mod rotations;
mod sequences;
mod shaken;
mod snap;
mod specialised;
mod targets;
mod traps;
mod two_bone;
