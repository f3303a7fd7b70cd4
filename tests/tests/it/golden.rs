//! The output of the derive and of the C and WGSL back ends equals golden files, and is the same in every run.
//!
//! `AIM_BLESS=1 cargo test -p aim-tests --test it golden` rewrites `tests/expected`. The test `expanded` checks that
//! the Rust files compile and match the real derive.

use std::path::Path;
use std::process::Command;
use std::{env, fs};

use aim_codegen::emit::{self, Rig};
use aim_codegen::{declare, kernels};
use aim_tests::rigs;
use aim_tests::scale::sampled;

/// Environment variable with the file to which the second process writes its expansions.
const SECOND_PROCESS: &str = "AIM_EXPANSIONS_TO";

/// Returns the expansion of a declaration, formatted by rustfmt.
fn expansion(declaration: &str) -> String {
    let tokens = format!("#[derive(AimRig)] {declaration}").parse().expect("a declaration is made of tokens");
    aim_codegen::format_rust(aim_codegen::derive(tokens))
}

/// Returns the output of a back end for `rigs/thug.toml`.
fn of_the_thug(emit: impl Fn(&Rig<'_>) -> String) -> String {
    let spec = declare::from_toml("rigs/thug.toml", include_str!("../../../rigs/thug.toml"))
        .unwrap_or_else(|errors| panic!("{}", errors.render()));
    emit(&Rig { spec: &spec, kernels: &kernels(&spec) })
}

fn compare(file: &str, found: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("expected").join(file);
    if env::var_os("AIM_BLESS").is_some_and(|bless| bless == "1") {
        fs::write(&path, found).expect("the folder of the expected files is writable");
        return;
    }
    let expected = fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    if let Some((line, (was, is))) =
        expected.lines().chain([""]).zip(found.lines().chain([""])).enumerate().find(|(_, (was, is))| was != is)
    {
        panic!(
            "tests/expected/{file} differs from what is emitted, first in line {}:\n  expected {was}\n  emitted  {is}\n\
             If the emitted code is meant to be so: AIM_BLESS=1 cargo test -p aim-tests --test it golden",
            line + 1
        );
    }
    assert_eq!(expected, found, "tests/expected/{file} differs in its end");
}

macro_rules! golden {
    ($name:ident $($declaration:tt)*) => {
        #[test]
        fn $name() {
            let file = concat!(stringify!($name), ".rs");
            let header = "// What the derive makes of a declaration in tests/src/declarations.rs; rewritten by\n\
                          // AIM_BLESS=1 cargo test -p aim-tests --test it golden\n";
            compare(file, &(header.to_owned() + &expansion(stringify!($($declaration)*))));
        }
    };
}

aim_tests::declarations!(golden);

#[test]
fn thug_in_c() {
    compare("thug.c", &of_the_thug(emit::c::emit));
}

#[test]
fn thug_in_wgsl() {
    compare("thug.wgsl", &of_the_thug(emit::wgsl::emit));
}

/// Returns the contents of all golden files, and every language's output for the rigs of every convention; by default
/// for every fifth rig, which includes chains of every length.
fn everything() -> String {
    let mut all = String::new();
    macro_rules! append {
        ($name:ident $($declaration:tt)*) => { all += &expansion(stringify!($($declaration)*)); };
    }
    aim_tests::declarations!(append);
    for spec in sampled(rigs::rigs()) {
        let kernels = kernels(&spec);
        let rig = Rig { spec: &spec, kernels: &kernels };
        let item = emit::rust::Item::of(&spec, quote::quote!(::aim));
        all += &emit::rust::emit_with_struct(&rig, &item).to_string();
        all += &emit::c::emit(&rig);
        all += &emit::wgsl::emit(&rig);
        all += &emit::maxima::emit(&rig);
    }
    all
}

#[test]
fn a_second_process_writes_the_same_bytes() {
    if let Some(file) = env::var_os(SECOND_PROCESS) {
        fs::write(file, everything()).expect("the first process has made the folder");
        return;
    }
    let here = everything();
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let file = folder.path().join("expansions");
    // Another process has different hash seeds and addresses.
    let child = Command::new(env::current_exe().expect("a test knows its own file"))
        .args(["--exact", "golden::a_second_process_writes_the_same_bytes"])
        .env(SECOND_PROCESS, &file)
        .output()
        .expect("the test can be started once more");
    assert!(child.status.success(), "{}", String::from_utf8_lossy(&child.stdout));
    assert!(fs::read_to_string(&file).expect("the second process wrote it") == here, "two processes differ");
}
