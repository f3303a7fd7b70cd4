//! `aim rig`: proposes a rig declaration for a file.

use aim_character::{declaration, evidence, propose};

use crate::args::{self, Notation};
use crate::failure::{Failure, Result};
use crate::files;

pub(super) fn run(arguments: &args::Rig) -> Result {
    let file = &arguments.file;
    let document = files::load_model(file)?;
    let measurement = arguments.facing.measure(file, &document)?;
    let named = (!arguments.chain.is_empty()).then_some(&arguments.chain[..]);
    let mut proposal = propose(&document, &measurement, named).map_err(|error| Failure::in_file(file, error))?;
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    proposal.spec.name = declaration::type_name(&stem);
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let doubt = evidence::doubt(&measurement).map_or(String::new(), |doubt| format!(" {doubt}"));
    let about = format!("Measured from {name}. {}{doubt}", evidence::facing(&measurement, &document));
    let mut toml = declaration::toml(&proposal, &about);
    if aim_codegen::declare::from_toml(&name, &toml).is_err() {
        // The file may be named like a keyword of some language.
        proposal.spec.name += "Rig";
        toml = declaration::toml(&proposal, &about);
    }
    // The proposal must pass the same checks as any other declaration.
    aim_codegen::declare::from_toml(&name, &toml).map_err(|errors| {
        Failure::in_file(file, format!("cannot propose a valid declaration: {}; rename the bones", errors.render()))
    })?;
    files::print(&match arguments.format {
        Notation::Toml => toml,
        Notation::Rust => declaration::rust(&proposal, &about),
        Notation::Bevy => declaration::bevy(&proposal, &about, &document, &measurement),
    })
}
