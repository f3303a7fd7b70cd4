//! What the tests share: the rigs they run over, independent forward kinematics, a seeded generator.

pub mod kinematics;
pub mod random;
pub mod rigs;
