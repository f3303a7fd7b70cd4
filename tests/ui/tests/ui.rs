//! Compares the error messages for wrong declarations word for word, and checks that no other errors are reported.
//!
//! rustc's own part of the messages changes between versions, so the errors are only compared with the toolchain that
//! wrote them. `AIM_BLESS=1 cargo test -p aim-ui` rewrites them.
//!
//! rustc is called directly, with the library that cargo has built for this test: a nested cargo would build it and all
//! its dependencies again.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

/// The rustc version that wrote the `.stderr` files.
const WRITTEN_WITH: &str = "rustc 1.95.";

fn rustc() -> Command {
    Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// Returns the folder of libraries that this test is linked with.
fn libraries() -> PathBuf {
    let test = env::current_exe().expect("the test is a file");
    test.parent().expect("it lies in a folder").to_owned()
}

/// Returns rustc's output for a program that uses `aim`, a library in the folder of libraries.
fn compile(aim: &Path, program: &Path, arguments: &[&str]) -> Output {
    rustc()
        .args(["--edition=2024", "--crate-name=case", "--crate-type=bin", "--color=never", "--diagnostic-width=140"])
        .arg(format!("-Ldependency={}", libraries().display()))
        .arg("--extern")
        .arg(format!("aim={}", aim.display()))
        .args(arguments)
        .arg(program)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("rustc can be started")
}

/// Creates a folder for this test.
fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("ui").join(name);
    fs::create_dir_all(&folder).expect("a folder for what is compiled");
    folder
}

/// Returns the newest `aim` that supports all cases. The folder may also hold builds with other features or toolchains.
fn library(scratch: &Path) -> PathBuf {
    let mut found: Vec<_> = fs::read_dir(libraries())
        .expect("the folder of libraries can be listed")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| {
            let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
            name.starts_with("libaim-") && name.ends_with(".rlib")
        })
        .collect();
    found.sort_by_key(|path| path.metadata().and_then(|of| of.modified()).expect("the library's age"));
    let probe = scratch.join("probe.rs");
    fs::write(&probe, "use aim::{AimRig as _, DRigid as _};\nfn main() {}\n").expect("a program to try");
    let output = scratch.join("probe.rmeta").display().to_string();
    let fits = |path: &PathBuf| compile(path, &probe, &["--emit=metadata", "-o", &output]).status.success();
    found.into_iter().rev().find(fits).expect("cargo has built the library")
}

/// Returns the programs in a folder.
fn programs(folder: &str) -> Vec<PathBuf> {
    let mut found: Vec<_> = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(folder))
        .expect("the folder can be listed")
        .map(|entry| Path::new(folder).join(entry.expect("an entry").file_name()))
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .collect();
    found.sort();
    assert!(!found.is_empty(), "no programs in {folder}");
    found
}

/// Returns the errors themselves, without rustc's count of them and its further hints.
fn errors_of(output: Output) -> String {
    let text = String::from_utf8(output.stderr).expect("text");
    let words = ["error: aborting due to", "Some errors have detailed", "For more information about"];
    let lines = text.lines().map(str::trim_end).filter(|line| !words.iter().any(|words| line.starts_with(words)));
    format!("{}\n", lines.collect::<Vec<_>>().join("\n").trim_end())
}

#[test]
fn errors() {
    let version = rustc().arg("--version").output().expect("rustc tells its version");
    let version = String::from_utf8_lossy(&version.stdout);
    if !version.starts_with(WRITTEN_WITH) {
        eprintln!("skipped: the expected errors are those of {WRITTEN_WITH}x, this is {version}");
        return;
    }
    let scratch = scratch("err");
    let aim = library(&scratch);
    let output = scratch.join("case.rmeta").display().to_string();
    let mut wrong = Vec::new();
    for program in programs("err") {
        let compiled = compile(&aim, &program, &["--emit=metadata", "-o", &output]);
        if compiled.status.success() {
            wrong.push(format!("{} compiles", program.display()));
            continue;
        }
        let found = errors_of(compiled);
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(program.with_extension("stderr"));
        if env::var_os("AIM_BLESS").is_some() {
            fs::write(file, found).expect("the expectation can be written");
            continue;
        }
        let expected = fs::read_to_string(&file).unwrap_or_default().replace("\r\n", "\n");
        if found != expected {
            wrong.push(format!("{}\n--- expected\n{expected}--- found\n{found}", program.display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn accepted() {
    let scratch = scratch("ok");
    let aim = library(&scratch);
    for program in programs("ok") {
        let built = scratch.join(program.file_stem().expect("a name"));
        let compiled = compile(&aim, &program, &["-o", &built.display().to_string()]);
        assert!(compiled.status.success(), "{}: {}", program.display(), String::from_utf8_lossy(&compiled.stderr));
        let ran = Command::new(&built).output().expect("the program can be started");
        assert!(ran.status.success(), "{}: {}", program.display(), String::from_utf8_lossy(&ran.stderr));
    }
}
