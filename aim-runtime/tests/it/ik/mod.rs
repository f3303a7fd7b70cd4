//! Solvers other than the aim solvers, checked by forward kinematics in f64.

mod aim_poses;
mod ccd;
mod conventions;
mod look_at;
mod one_bone;
mod two_bone_cases;
