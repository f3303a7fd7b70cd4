//! The rigs under test as `build.rs` emits them; in one place, because they take long to compile.

#![allow(unnameable_types, unreachable_pub, reason = "emitted from a file, the rigs are public")]

use aim::AimRig;
use aim::wide::f32x8;
use aim_tests::compare::Outputs;
use aim_tests::kinematics::Case;

use crate::lanes::cases::{Seen, compare};

include!(concat!(env!("OUT_DIR"), "/rigs.rs"));

/// Returns the outputs of rig `number` for `cases`.
pub(crate) fn outputs(number: usize, cases: &[Case]) -> Vec<Outputs> {
    with_rig!(number, |rig| Outputs::of(rig, cases))
}

/// Compares rig `number` in lanes with the same rig in scalars.
pub(crate) fn compared(number: usize, name: &str, cases: &[Case]) -> Seen {
    with_rig!(number, |rig| compare::<f32x8>(name, rig, rig, cases))
}
