//! Dependencies point one way, and deriving a rig compiles no parser but syn.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;

fn cargo(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO"))
        .args(arguments)
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
        .output()
        .expect("the cargo that built this test can be started");
    assert!(output.status.success(), "cargo {arguments:?}:\n{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("cargo writes UTF-8")
}

/// Returns the dependencies of each package without dev-dependencies: names, with ` [build]` for build dependencies and
/// `?` for optional ones.
fn declared() -> BTreeMap<String, BTreeSet<String>> {
    // `--no-deps` reads only the workspace's manifests: no registry, no network.
    let metadata: Value = serde_json::from_str(&cargo(&["metadata", "--no-deps", "--format-version", "1"]))
        .expect("cargo metadata writes JSON");
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let dependency = |value: &Value| {
        let kind = match value["kind"].as_str() {
            None => "",
            Some("build") => " [build]",
            Some(_) => return None,
        };
        let optional = if value["optional"] == true { "?" } else { "" };
        Some(text(&value["name"]) + kind + optional)
    };
    list(&metadata["packages"])
        .iter()
        .map(|package| (text(&package["name"]), list(&package["dependencies"]).iter().filter_map(dependency).collect()))
        .collect()
}

fn set(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

#[test]
fn point_one_way() {
    let declared = declared();
    assert_eq!(declared["aim-model"], set(&["libm?", "serde?", "wide?"]));
    assert_eq!(declared["aim-symbolic"], set(&["rustc-hash"]));
    // Dependencies for reading TOML and writing files stay optional: the derive does neither.
    let needed = |package: &str| -> BTreeSet<String> {
        declared[package].iter().filter(|name| !name.ends_with('?')).cloned().collect()
    };
    assert_eq!(needed("aim-codegen"), set(&["aim-model", "aim-symbolic", "proc-macro2", "quote", "strsim", "syn"]));
    assert_eq!(declared["aim-derive"], set(&["aim-codegen"]));
    let runtime = &declared["aim-runtime"];
    assert!(
        runtime.is_subset(&set(&["aim-model", "glam", "libm?", "serde?", "wide?"])) && runtime.contains("glam"),
        "{runtime:?}"
    );
    assert_eq!(declared["aim-animation"], set(&["aim-runtime", "serde?"]));
    assert_eq!(declared["derivand"], set(&["aim-derive", "aim-model", "glam?", "wide?"]));
    assert_eq!(declared["aim-rig"], set(&["aim-animation?", "aim-derive", "aim-runtime", "aim-codegen [build]?"]));
    let ours = |package: &str| -> BTreeSet<String> {
        declared[package].iter().filter(|name| name.starts_with("aim-")).cloned().collect()
    };
    // The file format crate does not depend on a solver.
    assert_eq!(ours("aim-gltf"), set(&["aim-animation"]));
    assert_eq!(
        ours("aim-character"),
        set(&["aim-animation", "aim-codegen", "aim-gltf", "aim-model", "aim-runtime", "aim-symbolic"])
    );
    // The window is a feature; without it the command has few dependencies.
    let command = set(&[
        "aim-animation",
        "aim-character",
        "aim-codegen",
        "aim-gltf",
        "aim-runtime",
        "aim-symbolic",
        "aim-viewer?",
    ]);
    assert!(ours("aim-cli").is_subset(&command), "{:?}", ours("aim-cli"));
}

/// Returns every package that is compiled when `package` is built with these features, itself included.
fn compiled(package: &str, features: &[&str]) -> BTreeSet<String> {
    let mut arguments = vec!["tree", "--package", package, "--edges", "normal,build", "--prefix", "none"];
    arguments.extend(["--format", "{p}"]);
    arguments.extend(features);
    cargo(&arguments).lines().filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect()
}

const MACRO_SIDE: [&str; 10] = [
    "aim-derive",
    "aim-codegen",
    "aim-model",
    "aim-symbolic",
    "rustc-hash",
    "strsim",
    "syn",
    "quote",
    "proc-macro2",
    "unicode-ident",
];

#[test]
fn of_the_derive_are_the_macro_crates_and_ours() {
    assert_eq!(compiled("aim-derive", &[]), set(&MACRO_SIDE));
}

#[test]
fn of_the_facade_are_those_of_the_derive_and_glam() {
    let facade = |more: &[&str]| -> BTreeSet<String> { set(&MACRO_SIDE).into_iter().chain(set(more)).collect() };
    assert_eq!(compiled("aim-rig", &[]), facade(&["aim-rig", "aim-runtime", "glam"]));
    assert_eq!(
        compiled("aim-rig", &["--no-default-features", "--features", "libm"]),
        facade(&["aim-rig", "aim-runtime", "glam", "libm"])
    );
    // The two checks above can fail: with the bundled rigs the build script reads TOML, and lanes use `wide`.
    assert!(compiled("aim-rig", &["--features", "rigs"]).contains("toml"));
    assert!(compiled("aim-rig", &["--features", "wide"]).contains("wide"));
}
