//! Code that the tests share: the rigs under test, independent forward kinematics, a seeded generator, comparisons.

pub mod by_hand;
pub mod c;
pub mod compare;
mod declarations;
pub mod kinematics;
pub mod oracle;
pub mod page;
pub mod problems;
pub mod random;
pub mod requested;
pub mod rigs;
pub mod scale;
pub mod wgsl;
