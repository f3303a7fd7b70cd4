//! `aim explain`: writes the derivation as a document.

use aim_codegen::kernels;

use crate::args::{self, Paper};
use crate::commands::check::{all_passed, verdicts};
use crate::commands::count::Counts;
use crate::explain::{self, Explained};
use crate::failure::{Failure, Result};
use crate::files;
use crate::outputs::Outputs;

pub(super) fn run(arguments: &args::Explain) -> Result {
    let paper = paper(arguments)?;
    let spec = files::load_rig(&arguments.rig)?;
    if let Some(path) = &arguments.output {
        Outputs::reading([(Some(&arguments.rig), "the rig")]).writes(path, "-o")?;
    }
    let kernels = kernels(&spec);
    let verdicts = verdicts(&spec, &kernels, arguments.samples);
    let document = explain::document(&Explained {
        spec: &spec,
        kernels: &kernels,
        counts: &Counts::of(&spec, &kernels),
        verdicts: &verdicts,
        samples: arguments.samples,
    });
    let text = match paper {
        Paper::Html => explain::html(&document),
        Paper::Latex => explain::latex(&document),
    };
    match &arguments.output {
        Some(path) => files::write(path, text.as_bytes())?,
        None => files::print(&text)?,
    }
    // The document is written even if a check failed, and shows which one.
    all_passed(&arguments.rig, &spec, &verdicts)
}

/// Returns the output format: `--format` if given, else by the file extension, else HTML.
fn paper(arguments: &args::Explain) -> Result<Paper> {
    let (format, Some(path)) = (arguments.format, &arguments.output) else {
        return Ok(arguments.format.unwrap_or(Paper::Html));
    };
    match (format, &*files::ending(path)) {
        (Some(paper), _) => Ok(paper),
        (None, "html" | "htm") => Ok(Paper::Html),
        (None, "tex") => Ok(Paper::Latex),
        (None, _) => Err(Failure::in_file(
            path,
            "unknown extension; use a name that ends in .html or .tex with -o, or add --format",
        )),
    }
}
