//! Runs the command like its users, and inspects its output and the files it leaves.

pub(crate) mod character;
pub(crate) mod forward;
pub(crate) mod gltf;
pub(crate) mod latex;
pub(crate) mod plot;
pub(crate) mod rig;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// Result of running the command.
#[derive(Debug)]
pub(crate) struct Ran {
    pub(crate) code: i32,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl Ran {
    /// Returns `true` if standard error holds nothing but warnings.
    pub(crate) fn only_warns(&self) -> bool {
        self.stderr.lines().all(|line| line.starts_with("warning: "))
    }
}

/// Returns the command, set to run in `folder` with empty standard input.
pub(crate) fn command(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_aim"));
    command.current_dir(folder).stdin(Stdio::null());
    command
}

/// Temporary folder of one test.
pub(crate) struct Place {
    folder: TempDir,
}

impl Place {
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder can be made") }
    }

    /// Returns a folder with the mannequin in the paper's axes as `m.glb` and its rig as `m.toml`.
    pub(crate) fn with_mannequin() -> Self {
        let place = Self::new();
        place.write("m.glb", &mannequin());
        place.write("m.toml", &std::fs::read(bundled_rig("mannequin")).expect("the rig is there"));
        place
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, bytes: &(impl AsRef<[u8]> + ?Sized)) {
        std::fs::write(self.path(name), bytes).expect("the temporary folder is writable");
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name} cannot be read: {error}"))
    }

    pub(crate) fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&self.read(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Returns the names in the folder, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).expect("the folder can be listed");
        let mut names: Vec<String> =
            entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Runs the command in this folder.
    pub(crate) fn run<I: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = I>) -> Ran {
        let output = command(self.folder.path()).args(arguments).output().expect("the command starts");
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the command prints UTF-8");
        let ran = Ran {
            code: output.status.code().expect("the command ends by itself"),
            stdout: text(output.stdout),
            stderr: text(output.stderr),
        };
        assert!(!ran.stderr.contains("panicked") && !ran.stdout.contains("panicked"), "{ran:?}");
        ran
    }

    /// Runs the command with arguments separated by spaces.
    pub(crate) fn aim(&self, arguments: &str) -> Ran {
        self.run(arguments.split_whitespace())
    }

    /// Runs the command and asserts that it succeeds: exit code 0, and nothing but warnings on standard error.
    #[track_caller]
    pub(crate) fn done(&self, arguments: &str) -> Ran {
        let ran = self.aim(arguments);
        assert!(ran.code == 0 && ran.only_warns(), "aim {arguments}: {ran:?}");
        ran
    }

    /// Runs the command and asserts that it refuses: exit code 2, one message with these words, and no new file.
    #[track_caller]
    pub(crate) fn refused(&self, arguments: &str, words: &[&str]) -> Ran {
        self.refuses(&arguments.split_whitespace().collect::<Vec<_>>(), words)
    }

    /// Like [`Place::refused`], with separate arguments.
    #[track_caller]
    pub(crate) fn refuses(&self, arguments: &[&str], words: &[&str]) -> Ran {
        let ran = self.refuses_after_words(arguments, words);
        assert_eq!(ran.stdout, "", "aim {arguments:?}");
        ran
    }

    /// Like [`Place::refuses`], for commands that may first print what they are about to do.
    #[track_caller]
    pub(crate) fn refuses_after_words(&self, arguments: &[&str], words: &[&str]) -> Ran {
        let before = self.names();
        let ran = self.run(arguments);
        assert_eq!(ran.code, 2, "aim {arguments:?}: {}", ran.stderr);
        let messages = ran.stderr.lines().filter(|line| line.starts_with("error")).count();
        assert_eq!(messages, 1, "one message for {arguments:?}: {}", ran.stderr);
        for word in words {
            assert!(ran.stderr.contains(word), "{arguments:?} is answered without {word:?}: {}", ran.stderr);
        }
        assert_eq!(self.names(), before, "aim {arguments:?} left something behind");
        ran
    }
}

/// Returns the mannequin in the paper's axes.
pub(crate) fn mannequin() -> Vec<u8> {
    aim_character::mannequin(|_| aim_character::PAPER_AXES).expect("the paper's axes are orthonormal")
}

/// Returns the mannequin with a change to its JSON.
pub(crate) fn changed(change: impl FnOnce(&mut Value)) -> Vec<u8> {
    let (mut json, bin) = gltf::take_apart(&mannequin());
    change(&mut json);
    gltf::put_together(&json, &bin)
}

/// Returns the path of a bundled rig.
pub(crate) fn bundled_rig(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../rigs").join(name).with_extension("toml")
}

/// Returns the paths of all bundled rigs.
pub(crate) fn bundled_rigs() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../rigs");
    let entries = std::fs::read_dir(folder).expect("the rigs are there");
    let mut rigs: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    rigs.sort();
    assert!(rigs.len() >= 8, "{rigs:?}");
    rigs
}

/// Returns all bundled rigs, or by default a representative few; the others differ from these only by their axes.
pub(crate) fn different_rigs() -> Vec<PathBuf> {
    if in_full() { bundled_rigs() } else { ["rigify", "thug", "turret"].map(bundled_rig).into() }
}

/// Returns `true` if tests should run all of their cases, as in `.ci/run`. Plain `cargo test` runs a part.
pub(crate) fn in_full() -> bool {
    std::env::var_os("AIM_TEST_SCALE").is_some_and(|scale| scale == "full")
}

/// Returns the folder with real characters. Tests that call this are ignored by default.
pub(crate) fn real_rigs() -> PathBuf {
    let folder = std::env::var_os("AIM_RIGS").expect("AIM_RIGS names a folder of real characters");
    let folder = PathBuf::from(folder);
    // A relative path is relative to the repository, but tests run in the crate's folder.
    let folder =
        if folder.is_relative() { Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(folder) } else { folder };
    assert!(folder.is_dir(), "AIM_RIGS names {}, which is no folder", folder.display());
    folder
}

/// Returns `true` if a program is installed.
pub(crate) fn installed(program: &str) -> bool {
    let found = Command::new(program)
        .arg("--version")
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .is_ok_and(|status| status.success());
    if !found {
        println!("SKIPPED what needs {program}: it is not installed");
    }
    found
}
