//! The rigs that are compiled in.

use std::sync::Arc;

use aim::rigs::{Mixamo, Rigify, Rocketbox, UnrealMannequin, Vrm};
use aim::{AimRig, Rig};

use crate::find::{Known, by_name};
use crate::{Bones, Found};

/// A bundled rig on bones of the names that it declares. With `both_eyes` the other eye is aimed itself, where there is one; else it
/// turns as the first does.
///
/// # Errors
/// Says in a sentence what was expected.
pub fn preset(bones: &Bones, name: &str, both_eyes: bool) -> Result<Found, String> {
    fn of<R: AimRig>() -> Arc<dyn Rig> {
        Arc::new(R::RIG)
    }
    let rig = match name {
        "vrm" => of::<Vrm>(),
        "mixamo" => of::<Mixamo>(),
        "rocketbox" => of::<Rocketbox>(),
        "rigify" => of::<Rigify>(),
        "unreal" => of::<UnrealMannequin>(),
        _ => {
            return Err(format!(
                "there is no preset \"{name}\": give \"vrm\", \"mixamo\", \"rocketbox\", \"rigify\", \"unreal\", or \"measure\""
            ));
        }
    };
    by_name(bones, &bones.skeleton()?, rig, Known::default(), both_eyes)
}
