//! Checks the tables of `docs/animation-coverage.md`: every item that they name exists, and every row names an existing
//! test.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::{fs, iter};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// Returns the text between each pair of backticks.
fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// Returns the text of all Rust files in a folder, concatenated.
fn sources(folder: &str) -> String {
    let mut open = vec![PathBuf::from(ROOT).join(folder)];
    let files = iter::from_fn(|| {
        while let Some(path) = open.pop() {
            if path.is_dir() {
                open.extend(fs::read_dir(&path).unwrap().map(|entry| entry.unwrap().path()));
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                return Some(fs::read_to_string(path).unwrap());
            }
        }
        None
    });
    files.collect()
}

/// Returns `true` if `file::test` is a test of that file.
fn is_test(named: &str) -> bool {
    let (file, test) = named.rsplit_once("::").expect("`file::test`");
    let file = if file.contains('/') { file.to_owned() } else { format!("aim-animation/tests/it/{file}") };
    let Ok(text) = fs::read_to_string(Path::new(ROOT).join(file).with_extension("rs")) else { return false };
    let function = format!("fn {test}(");
    // Other attributes may stand between `#[test]` and the function.
    let mut tests = text.split("#[test]").skip(1);
    tests.any(|rest| {
        let mut lines = rest.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with("#["));
        lines.next().is_some_and(|line| line.starts_with(&function))
    })
}

#[test]
fn every_row_names_an_interface_and_a_test() {
    let page = fs::read_to_string(Path::new(ROOT).join("docs/animation-coverage.md")).unwrap();
    let source = sources("aim-animation/src") + &sources("aim-runtime/src");
    let declared: HashSet<&str> = ["struct", "enum", "trait", "fn", "const fn"]
        .iter()
        .flat_map(|kind| {
            source.split(&format!("pub {kind} ")).skip(1).map(|rest| name_and_rest(rest).0).collect::<Vec<_>>()
        })
        .collect();
    // Each enum variant is on its own line.
    let variants: HashSet<&str> = source
        .lines()
        .map(|line| name_and_rest(line.trim()))
        .filter(|(_, rest)| rest.starts_with([',', '(', ' ']))
        .map(|(name, _)| name)
        .collect();
    let mut rows = 0;
    for line in page.lines().filter(|line| line.starts_with("| ")) {
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").collect();
        let [_, what, interface, tests] = cells[..] else { panic!("four columns: {line}") };
        if interface.trim() == "API" {
            continue;
        }
        rows += 1;
        let (names, tests) = (quoted(interface), quoted(tests));
        assert!(!names.is_empty() && !tests.is_empty(), "a row without an interface or a test: {what}");
        for name in names {
            for part in name.split("::") {
                let is_variant = part.starts_with(char::is_uppercase) && variants.contains(part);
                assert!(declared.contains(part) || is_variant, "{name} of {what} is not there");
            }
        }
        for test in tests {
            assert!(is_test(test), "{test} of {what} is no test");
        }
    }
    assert!(rows > 90, "only {rows} rows are read");
}

/// Splits a text after the identifier that it begins with.
fn name_and_rest(text: &str) -> (&str, &str) {
    text.split_at(text.find(|next: char| !next.is_alphanumeric() && next != '_').unwrap_or(text.len()))
}
