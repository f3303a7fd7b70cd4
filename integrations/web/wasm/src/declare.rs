//! Rigs declared in TOML.

use std::sync::Arc;

use aim_character::InterpretedRig;

use crate::find::{Known, MOST_JOINTS, by_name};
use crate::{Bones, Found};

/// Fits a rig declared in TOML, as `aim rig` writes it, to the bones. `file` is the file name that error messages show.
///
/// # Errors
/// Returns a message that says what was expected. For an error in the declaration it has file, line and column.
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
