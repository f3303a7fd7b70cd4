//! Compiles rigs in the `build.rs` of the crate that uses them.
//!
//! ```toml
//! [build-dependencies]
//! aim-codegen = { version = "0.1", features = ["toml"] }
//! ```
//!
//! ```no_run
//! // build.rs, in `main`:
//! aim_codegen::build::rigs("rigs"); // each rigs/*.toml
//! ```
//!
//! ```ignore
//! // src/main.rs: a struct for each rig, under its name
//! aim::include_rigs!("rigs");
//! ```
//!
//! Cargo reruns the build script when a file in `rigs` changes, appears or disappears. Mistakes in a declaration fail
//! the build with the messages that the derive macro would give: all of them, each with file, line, column and a help
//! line.

use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::{env, fs, io, process};

use proc_macro2::TokenStream;
use quote::quote;

use crate::declare::{self, Diagnostics};
use crate::{RigSpec, format_rust, rust_of};

/// Compiles the rigs of a folder's `*.toml` files, or the rig of one file, for `aim::include_rigs!`.
///
/// `path` is relative to the package. The code is written to `OUT_DIR` under the name of the folder or file:
/// `include_rigs!("rigs")` for `rigs("rigs")`, `include_rigs!("hero")` for `rigs("rigs/hero.toml")`. For other options
/// see [`Rigs`].
///
/// If there are errors, prints all of them and exits the build script with code 1.
pub fn rigs(path: impl AsRef<Path>) {
    Rigs::new(path).build();
}

/// Builder form of [`rigs`], with options.
///
/// ```no_run
/// // build.rs of a package that calls aim-rig's library `look`
/// aim_codegen::build::Rigs::new("rigs").crate_path("::look").build();
/// ```
#[derive(Clone, Debug)]
#[must_use = "nothing happens before `build`"]
pub struct Rigs {
    path: PathBuf,
    krate: String,
}

impl Rigs {
    /// Selects the rigs of a folder's `*.toml` files, or the rig of one file; `path` is relative to the package.
    pub fn new(path: impl AsRef<Path>) -> Self {
        Self { path: path.as_ref().to_owned(), krate: "::aim".to_owned() }
    }

    /// Sets the path of the facade crate in the code that includes the rigs; `::aim` by default.
    pub fn crate_path(self, path: &str) -> Self {
        Self { krate: path.to_owned(), ..self }
    }

    /// Writes the code to `OUT_DIR` and tells Cargo which files it depends on. For use in build scripts.
    ///
    /// If there are errors, prints all of them and exits the process with code 1.
    pub fn build(self) {
        println!("cargo::rerun-if-changed={}", self.path.display());
        let written = env::var_os("OUT_DIR")
            .ok_or_else(|| failure("cargo set no OUT_DIR", "call this from a package's `build.rs`"))
            .and_then(|out| self.write_to(Path::new(&out)));
        if let Err(errors) = written {
            eprint!("{errors}");
            process::exit(1);
        }
    }

    /// Writes the code to `folder` and returns the file's path. A file that already has this content is left untouched.
    ///
    /// # Errors
    ///
    /// Returns all error messages, ready to print; nothing is written in that case.
    pub fn write_to(&self, folder: &Path) -> Result<PathBuf, String> {
        let code = self.code()?;
        let mut name = self.path.file_stem().map_or_else(|| OsString::from("rigs"), OsStr::to_owned);
        name.push(".rs");
        let file = folder.join(name);
        write(&file, &code).map_err(|error| {
            failure(&format!("{} cannot be written: {error}", file.display()), "make room for it, or let it be written")
        })?;
        Ok(file)
    }

    /// Returns the code of all rigs, in the order of their file names.
    fn code(&self) -> Result<String, String> {
        let krate: TokenStream = syn::parse_str::<syn::Path>(&self.krate).map(|path| quote!(#path)).map_err(|_| {
            failure(&format!("`{}` is not the path of a library", self.krate), "write it as in `crate_path(\"::aim\")`")
        })?;
        let files = self.files()?;
        let mut errors = Vec::new();
        let mut rigs: Vec<(&Path, RigSpec)> = Vec::new();
        for file in &files {
            match read(file) {
                Ok(spec) => match rigs.iter().find(|(_, other)| other.name == spec.name) {
                    Some((other, _)) => errors.push(failure(
                        &format!("{} and {} both declare the rig `{}`", other.display(), file.display(), spec.name),
                        "each becomes a struct of that name: change one `name`",
                    )),
                    None => rigs.push((file, spec)),
                },
                Err(error) => errors.push(error),
            }
        }
        if !errors.is_empty() {
            return Err(errors.join("\n"));
        }
        Ok(rigs.iter().map(|(file, spec)| source(file, spec, &krate)).collect())
    }

    fn files(&self) -> Result<Vec<PathBuf>, String> {
        let unreadable = |error: io::Error| {
            failure(
                &format!("{} cannot be read: {error}", self.path.display()),
                "give a folder of rigs or a rig's TOML file, from the package's own folder",
            )
        };
        if !fs::metadata(&self.path).map_err(unreadable)?.is_dir() {
            return Ok(vec![self.path.clone()]);
        }
        let mut files = Vec::new();
        for entry in fs::read_dir(&self.path).map_err(unreadable)? {
            let file = entry.map_err(unreadable)?.path();
            if file.extension().is_some_and(|extension| extension == "toml") {
                files.push(file);
            }
        }
        files.sort();
        if files.is_empty() {
            let message = format!("there is no rig in the folder {}", self.path.display());
            return Err(failure(&message, "put a `.toml` file there for each rig; `aim rig MODEL` proposes one"));
        }
        Ok(files)
    }
}

fn read(file: &Path) -> Result<RigSpec, String> {
    let text = fs::read_to_string(file).map_err(|error| {
        failure(&format!("{} cannot be read: {error}", file.display()), "a rig file is text in UTF-8")
    })?;
    declare::from_toml(&file.display().to_string(), &text).map_err(|errors: Diagnostics| errors.render())
}

fn source(file: &Path, spec: &RigSpec, krate: &TokenStream) -> String {
    format!("// The rig {} of {}.\n{}", spec.name, file.display(), format_rust(rust_of(spec, krate.clone())))
}

/// Writes the file atomically, and only if its content differs, so that unchanged code is not compiled again.
fn write(file: &Path, code: &str) -> io::Result<()> {
    if fs::read(file).is_ok_and(|found| found == code.as_bytes()) {
        return Ok(());
    }
    let unfinished = file.with_extension("rs.unfinished");
    fs::write(&unfinished, code)?;
    fs::rename(&unfinished, file)
}

/// Formats an error without a source location like those that have one.
fn failure(message: &str, help: &str) -> String {
    format!("error: {message}\n  = help: {help}\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAMP: &str = "name = 'Lamp'\naxes = { up = '+Z', forward = '+X' }\n[[joint]]\nname = 'arm'\nheading = 'free'\nrate = '90deg'\n";

    /// Creates an empty folder for one test, with these files in `rigs`.
    fn folder(test: &str, files: &[(&str, &str)]) -> PathBuf {
        let folder = env::temp_dir().join(format!("aim-build-{}-{test}", process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(folder.join("rigs")).expect("a folder for the test");
        for (name, text) in files {
            fs::write(folder.join("rigs").join(name), text).expect("a file for the test");
        }
        folder
    }

    fn files_in(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(folder)
            .expect("the folder is there")
            .map(|entry| entry.expect("it can be listed").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_folder_is_compiled_to_one_file_that_is_rewritten_only_on_change() {
        let place =
            folder("whole", &[("lamp.toml", LAMP), ("b.toml", &LAMP.replace("Lamp", "Beam")), ("notes.txt", "!")]);
        let rigs = Rigs::new(place.join("rigs"));
        let file = rigs.write_to(&place).expect("good rigs");
        assert_eq!(
            (file.clone(), files_in(&place)),
            (place.join("rigs.rs"), vec!["rigs".to_owned(), "rigs.rs".to_owned()])
        );
        let code = fs::read_to_string(&file).expect("the code");
        let (beam, lamp) = (code.find("pub struct Beam").expect("a rig"), code.find("pub struct Lamp").expect("a rig"));
        assert!(beam < lamp, "in the order of the files");
        let written = fs::metadata(&file).and_then(|data| data.modified()).expect("a time");
        rigs.write_to(&place).expect("good rigs");
        assert_eq!(fs::metadata(&file).and_then(|data| data.modified()).expect("a time"), written);
        let changed = LAMP.replace("+X", "-X");
        fs::write(place.join("rigs/lamp.toml"), changed).expect("a change");
        rigs.write_to(&place).expect("good rigs");
        assert_ne!(fs::read_to_string(&file).expect("the code"), code);
        let single = Rigs::new(place.join("rigs/lamp.toml")).crate_path("::look").write_to(&place).expect("a good rig");
        assert_eq!(single, place.join("lamp.rs"));
        assert!(fs::read_to_string(&single).expect("the code").contains("::look::__private::AimRig"));
        fs::remove_dir_all(place).expect("the test's own folder");
    }

    #[test]
    fn all_errors_of_all_files_are_reported_and_nothing_is_written() {
        let place = folder(
            "mistakes",
            &[
                ("a.toml", &LAMP.replace("+X", "-Z")),
                ("b.toml", &LAMP.replace("90deg", "90").replace("arm", "fn")),
                ("c.toml", LAMP),
                ("d.toml", LAMP),
                ("e.toml", "name = \"Lamp\nbones"),
            ],
        );
        let errors = Rigs::new(place.join("rigs")).write_to(&place).expect_err("bad rigs");
        for expected in [
            "error: `up` and `forward` are parallel\n",
            "a.toml:2:31\n",
            "error: the name `fn` is a keyword of WGSL\n",
            "b.toml:4:8\n",
            "error: `90` has no unit\n",
            "b.toml:6:8\n",
            "d.toml both declare the rig `Lamp`\n  = help: each becomes a struct of that name",
            "e.toml:1:13\n",
        ] {
            assert!(errors.contains(expected), "{expected:?} is not in:\n{errors}");
        }
        assert_eq!(errors.matches("error: ").count(), errors.matches("= help: ").count(), "{errors}");
        assert_eq!(files_in(&place), ["rigs"]);
        fs::remove_dir_all(place).expect("the test's own folder");
    }

    #[test]
    fn unreadable_and_unwritable_paths_are_reported() {
        let place = folder("unreadable", &[]);
        let error_of = |rigs: &Rigs| rigs.write_to(&place).expect_err("nothing to write");
        assert!(error_of(&Rigs::new(place.join("rigs"))).contains("there is no rig in the folder"));
        assert!(error_of(&Rigs::new(place.join("rig"))).contains("give a folder of rigs or a rig's TOML file"));
        fs::write(place.join("rigs/a.toml"), [0xff]).expect("a file for the test");
        assert!(error_of(&Rigs::new(place.join("rigs"))).contains("a rig file is text in UTF-8"));
        fs::write(place.join("rigs/a.toml"), LAMP).expect("a file for the test");
        assert!(
            error_of(&Rigs::new(place.join("rigs")).crate_path("a b")).contains("`a b` is not the path of a library")
        );
        let nowhere = Rigs::new(place.join("rigs")).write_to(&place.join("none")).expect_err("no such folder");
        assert!(nowhere.contains("cannot be written"), "{nowhere}");
        fs::remove_dir_all(place).expect("the test's own folder");
    }
}
