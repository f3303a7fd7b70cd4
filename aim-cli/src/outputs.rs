//! What a command may write where: nothing over what it reads, no two things in one file.

use std::path::{Path, PathBuf};

use aim_gltf::Document;

use crate::failure::{Failure, Result};

/// The files of one call.
#[derive(Default)]
pub(crate) struct Outputs {
    taken: Vec<(PathBuf, String)>,
}

impl Outputs {
    /// Nothing may be written over this file; `what` it is, for the message.
    pub(crate) fn reads(&mut self, path: &Path, what: &str) {
        self.taken.push((place(path), what.to_owned()));
    }

    /// Nothing may be written over what a model refers to.
    pub(crate) fn reads_parts_of(&mut self, model: &Document) {
        for file in model.external_files() {
            self.reads(&file, "a part of the model");
        }
    }

    /// This file is going to be written because of `option`.
    ///
    /// # Errors
    /// It is one of the others.
    pub(crate) fn writes(&mut self, path: &Path, option: &str) -> Result {
        let at = place(path);
        if let Some((_, what)) = self.taken.iter().find(|(taken, _)| *taken == at) {
            return Err(Failure::in_file(path, format!("is used twice: it is {what}; give {option} another name")));
        }
        self.taken.push((at, format!("what {option} writes")));
        Ok(())
    }

    /// The model that is written to `--out`, which may take the place of the one that was read, and what `--report` and
    /// `--html` tell of it.
    ///
    /// # Errors
    /// One of them is one of the others, or the model called as a text file would be.
    pub(crate) fn writes_model(
        &mut self,
        out: &Path,
        model: &Path,
        report: Option<&Path>,
        html: Option<&Path>,
    ) -> Result {
        if out.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gltf")) {
            return Err(Failure::in_file(out, "would be a binary file; give --out a name that ends in .glb"));
        }
        if place(out) != place(model) {
            self.reads(model, "the model itself");
        }
        for (path, option) in [(Some(out), "--out"), (report, "--report"), (html, "--html")] {
            path.map_or(Ok(()), |path| self.writes(path, option))?;
        }
        Ok(())
    }
}

/// Where a file is, links followed; of one that is not there yet, where its folder is.
fn place(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    absolute.canonicalize().unwrap_or_else(|_| match (absolute.parent(), absolute.file_name()) {
        (Some(folder), Some(name)) => folder.canonicalize().unwrap_or_else(|_| folder.to_owned()).join(name),
        _ => absolute,
    })
}
