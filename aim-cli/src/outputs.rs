//! Checks of output paths: no command overwrites one of its inputs or a read-only file, or writes two outputs to one
//! file.

use std::fs;
use std::path::{Path, PathBuf};

use aim_gltf::Document;
use serde::Serialize;

use crate::args::Written;
use crate::failure::{Failure, Result};
use crate::files;

/// Input and output files of one run.
#[derive(Default)]
pub(crate) struct Outputs {
    /// Canonical paths, each with its description in messages.
    taken: Vec<(PathBuf, String)>,
}

impl Outputs {
    /// Starts with the given input files, each with its description in messages. They must not be overwritten.
    pub(crate) fn reading<'a>(inputs: impl IntoIterator<Item = (Option<&'a PathBuf>, &'a str)>) -> Self {
        let taken = inputs.into_iter().filter_map(|(path, what)| Some((place(path?), what.to_owned())));
        Self { taken: taken.collect() }
    }

    /// Adds the files that a model refers to as inputs.
    pub(crate) fn reading_parts_of(mut self, model: &Document) -> Self {
        let parts = model.external_files();
        self.taken.extend(parts.iter().map(|file| (place(file), "part of the model".to_owned())));
        self
    }

    /// Adds the output file that `option` writes.
    ///
    /// # Errors
    /// The file is already used as another input or output, it is read-only, or its folder does not exist.
    pub(crate) fn writes(&mut self, path: &Path, option: &str) -> Result {
        let at = place(path);
        if let Some((_, what)) = self.taken.iter().find(|(taken, _)| *taken == at) {
            return Err(Failure::in_file(path, format!("used twice: it is {what}; choose another path for {option}")));
        }
        // Renaming a new file into place would replace it all the same.
        if fs::metadata(&at).is_ok_and(|there| there.is_file() && there.permissions().readonly()) {
            return Err(Failure::in_file(
                path,
                format!("the file is read-only; make it writable, or choose another path for {option}"),
            ));
        }
        // Reported before the work instead of after it.
        if let Err(source) = at.parent().map_or(Ok(()), |folder| fs::metadata(folder.join(".")).map(drop)) {
            return Err(Failure::input(aim_gltf::Error::Write { path: path.to_owned(), source }.to_string()));
        }
        self.taken.push((at, format!("the output of {option}")));
        Ok(())
    }

    /// Adds the output files of a command that changes a model. Only `--out` may replace the model that was read.
    ///
    /// # Errors
    /// A file is used twice or read-only, its folder does not exist, or its extension is that of another format.
    pub(crate) fn write_model(mut self, targets: Targets<'_>, model: &Path) -> Result {
        let Targets { out, report, html } = targets;
        if out.is_none_or(|out| place(out) != place(model)) {
            self.taken.push((place(model), "the model".into()));
        }
        for (path, option) in [(out, "--out"), (report, "--report"), (html, "--html")] {
            path.map_or(Ok(()), |path| self.writes(path, option))?;
        }
        let kinds = [
            (out, "--out", "a binary glTF file", &["glb", "vrm"][..]),
            (report, "--report", "JSON", &["json"]),
            (html, "--html", "an HTML page", &["html", "htm"]),
        ];
        for (path, option, what, endings) in kinds {
            let wrong = |path: &&Path| !matches!(files::ending(path), ending if ending.is_empty() || endings.contains(&&*ending));
            if let Some(path) = path.filter(wrong) {
                let right = endings[0];
                return Err(Failure::in_file(
                    path,
                    format!("{option} writes {what}; use a name that ends in .{right}"),
                ));
            }
        }
        Ok(())
    }
}

/// Output files of a command that changes a model; `None` for those not requested.
#[derive(Clone, Copy)]
pub(crate) struct Targets<'a> {
    /// The model, as a binary glTF file.
    pub(crate) out: Option<&'a Path>,
    /// The report, as JSON.
    pub(crate) report: Option<&'a Path>,
    /// The report, as a page.
    pub(crate) html: Option<&'a Path>,
}

impl Targets<'_> {
    /// Writes the model, the report and the page: all of them or none.
    pub(crate) fn write(self, model: &[u8], report: &impl Serialize, page: impl FnOnce() -> String) -> Result {
        let report = match self.report {
            Some(path) => Some((path, files::to_json(report)?)),
            None => None,
        };
        let page = self.html.map(|path| (path, page()));
        let texts = report.iter().chain(&page).map(|(path, text)| (*path, text.as_bytes()));
        files::write_all(&self.out.map(|out| (out, model)).into_iter().chain(texts).collect::<Vec<_>>())
    }
}

impl Written {
    /// Returns the output files.
    pub(crate) fn targets(&self) -> Targets<'_> {
        Targets { out: Some(&self.out), report: self.report.as_deref(), html: self.html.as_deref() }
    }
}

/// Returns the canonical path of a file. If the file does not exist yet, only the links in its folder are resolved.
fn place(path: &Path) -> PathBuf {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    absolute.canonicalize().unwrap_or_else(|_| match (absolute.parent(), absolute.file_name()) {
        (Some(folder), Some(name)) => folder.canonicalize().unwrap_or_else(|_| folder.to_owned()).join(name),
        _ => absolute,
    })
}
