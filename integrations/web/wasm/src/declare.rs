//! Rigs that are declared in TOML.

use std::sync::Arc;

use aim_character::InterpretedRig;

use crate::find::{Known, MOST_JOINTS, by_name};
use crate::{Bones, Found};

/// A rig of a declaration in TOML, as `aim rig` writes it; `file` is what its mistakes are told for.
///
/// # Errors
/// Says in a sentence what was expected; of a declaration with file, line and column.
pub fn declared(bones: &Bones, file: &str, text: &str, both_eyes: bool) -> Result<Found, String> {
    let spec = aim_codegen::declare::from_toml(file, text).map_err(|errors| errors.render())?;
    let joints = spec.joints.len();
    if joints > MOST_JOINTS {
        return Err(format!(
            "the rig has {joints} joints, and a gaze {MOST_JOINTS} at most: leave out some of the spine's or the neck's"
        ));
    }
    by_name(bones, &bones.skeleton()?, Arc::new(InterpretedRig::new(&spec)), Known::default(), both_eyes)
}
