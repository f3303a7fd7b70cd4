//! Reaching and looking: what a character needs beside the solvers that aim a rig.
//!
//! Each solver is a struct of settings with a `solve`, whose outcome says by forward kinematics what was met, and if not,
//! why. They take points, directions and transforms in one space of the caller's choice and give world turns: what goes
//! *before* a bone's animated rotation in that space, `turn * animated`. So no convention of bones matters to them.
//! None allocates or panics, and for every input the turns are unit and finite.
//!
//! | to | use |
//! |---|---|
//! | put a hand or a foot on a point | [`TwoBone`] |
//! | put the end of a longer chain on a point | [`Ccd`] |
//! | point one bone along a direction | [`OneBone`] |
//! | turn a head alone, as it sits on its neck | [`LookAt`] |
//! | lead a limb through points at given times | [`trajectory`](crate::trajectory) |
//! | aim as an animator posed it | [`AimPoses`] |
//! | aim eyes, neck and spine together | [`AimRig`](crate::AimRig) |
//!
//! Poses, blending and attachments are in the crate `aim-animation`; arithmetic of rotations is in
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
