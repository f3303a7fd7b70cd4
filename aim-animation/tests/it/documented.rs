//! The tables of `docs/animation-coverage.md`: what they name is there, and each row is judged by a test.

use std::path::{Path, PathBuf};
use std::{fs, iter};

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/..");

/// The words between backticks.
fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// All Rust files of a folder, one text.
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

/// True if `file::test` is a test of that file.
fn is_test(named: &str) -> bool {
    let (file, test) = named.rsplit_once("::").expect("`file::test`");
    let file = if file.contains('/') { file.to_owned() } else { format!("aim-animation/tests/it/{file}") };
    let Ok(text) = fs::read_to_string(Path::new(ROOT).join(file).with_extension("rs")) else { return false };
    let function = format!("fn {test}(");
    // Other attributes may stand between.
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
                let is_there = ["struct", "enum", "fn", "trait"].iter().any(|kind| {
                    let begins = format!("pub {kind} {part}");
                    let of = |text: &str| {
                        source.match_indices(text).any(|(at, found)| ends_there(&source[at + found.len()..]))
                    };
                    of(&begins) || of(&begins.replace("pub fn", "pub const fn"))
                });
                // A variant stands alone on its line.
                let is_variant = source.lines().any(|line| {
                    let rest = line.trim().strip_prefix(part);
                    rest.is_some_and(|rest| matches!(rest.chars().next(), Some(',' | '(' | ' ')))
                });
                assert!(
                    is_there || is_variant && part.starts_with(char::is_uppercase),
                    "{name} of {what} is not there"
                );
            }
        }
        for test in tests {
            assert!(is_test(test), "{test} of {what} is no test");
        }
    }
    assert!(rows > 90, "only {rows} rows are read");
}

/// True where a name does not go on.
fn ends_there(rest: &str) -> bool {
    !rest.starts_with(|next: char| next.is_alphanumeric() || next == '_')
}
