//! Options that override the measured facing.

use std::path::Path;

use aim_character::{Clue, Measurement, SignedAxis, Stated, evidence};
use aim_gltf::{Document, LookAt};
use clap::Args;

use crate::failure::{Failure, Result};

/// World axes of the file that the user states to be the character's forward and up.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct Facing {
    /// The axis that the character faces (+Z, -X …); measured if not given.
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    pub(crate) forward: Option<SignedAxis>,
    /// The character's up axis; measured if not given.
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true)]
    pub(crate) up: Option<SignedAxis>,
}

impl Facing {
    /// Measures a document with the stated axes, and prints a warning for each invalid number in its look-at settings.
    ///
    /// # Errors
    /// The stated forward lies along the character's up.
    pub(crate) fn measure(self, file: &Path, document: &Document) -> Result<Measurement> {
        let [up, forward] = [self.up, self.forward].map(|axis| axis.map(SignedAxis::vector));
        let measurement = Measurement::stated(document, Stated { up, forward });
        for doubt in LookAt::doubts(document) {
            eprintln!("warning: {}: {doubt}", file.display());
        }
        let is_followed = |said: &aim_character::Evidence| said.clue == Clue::Stated && said.forward.is_some();
        match self.forward {
            Some(axis) if !measurement.evidence.iter().any(is_followed) => {
                let up = SignedAxis::of(measurement.up);
                Err(Failure::in_file(
                    file,
                    format!(
                        "--forward {axis} is parallel to the character's up axis, {up}; give another axis, or set the up axis with --up"
                    ),
                ))
            }
            stated => {
                if let Some(axis) = stated {
                    warn_of_evidence(axis, file, document, &measurement);
                }
                Ok(measurement)
            }
        }
    }
}

/// Prints a warning if most of the file's evidence, by weight, contradicts the stated forward.
fn warn_of_evidence(stated: SignedAxis, file: &Path, document: &Document, measurement: &Measurement) {
    let weight = |agrees: bool| -> f64 {
        let told = measurement.evidence.iter().filter(|said| said.clue != Clue::Stated && said.forward.is_some());
        told.filter(|said| said.agrees == agrees).map(|said| said.weight).sum()
    };
    if weight(false) > weight(true) {
        let against = evidence::against(measurement, document).join("; ");
        eprintln!(
            "warning: {}: --forward {stated} contradicts most of the evidence: {against}; omit it if the character faces \
             another way",
            file.display()
        );
    }
}
