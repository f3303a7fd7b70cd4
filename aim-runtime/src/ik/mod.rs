//! Inverse kinematics besides the rig solvers: reaching, pointing and looking.
//!
//! Each solver is a struct of settings with a method `solve`. Its outcome reports, measured by forward kinematics,
//! whether the goal was met and if not, why. Points, directions and transforms are in one space of the caller's choice.
//! The results are rotations in that space that go *before* the bone's animated rotation, `turn * animated`, so they do
//! not depend on a bone convention. No solver allocates or panics, and the returned rotations are unit and finite for
//! every input.
//!
//! | to | use |
//! |---|---|
//! | put a hand or a foot on a point | [`TwoBone`] |
//! | put the end of a longer chain on a point | [`Ccd`] |
//! | point one bone along a direction | [`OneBone`] |
//! | turn a head relative to its neck | [`LookAt`] |
//! | move a limb through points at given times | [`trajectory`](crate::trajectory) |
//! | blend an animator's aim poses | [`AimPoses`] |
//! | aim eyes, neck and spine together | [`AimRig`](crate::AimRig) |
//!
//! Poses, blending and attachments are in the crate `aim-animation`. Rotation arithmetic is in
//! [`rotation`](crate::rotation).

mod aim_poses;
mod ccd;
mod look_at;
mod one_bone;
mod triangles;
mod two_bone;

pub use aim_poses::{AimPose, AimPoses, AimPosesOutcome, AimPosesStatus, Blend};
pub use ccd::{Ccd, CcdJoint, CcdLimit, CcdOutcome, CcdStatus};
pub use look_at::{Beyond, LookAt, LookAtOutcome, LookAtStatus, Path};
pub use one_bone::{OneBone, OneBoneOutcome, OneBoneStatus, Roll};
pub use triangles::{grid, triangulated};
pub use two_bone::{Bend, Hinge, Limb, TwoBone, TwoBoneOutcome, TwoBoneStatus};
